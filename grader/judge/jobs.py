"""Find the functions of the checks that the rubric names."""

from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from types import ModuleType
from typing import Any

from grader.judge.rubric import Check, Todo
from grader.judge.submission import CannotGrade

Key = tuple[str, str]  # the ids of a TODO and of a check


@dataclass(frozen=True)
class Job:
    """A check of a TODO, and the function that runs it."""

    todo: Todo
    check: Check
    function: Any

    @property
    def key(self) -> Key:
        return self.todo.id, self.check.id

    @property
    def module(self) -> str:
        return self.check.module or self.todo.module

    @property
    def part(self) -> tuple[str, str]:
        """Return the TODO and the program: jobs that share both run the same code."""
        return self.todo.id, self.module

    @property
    def title(self) -> str:
        return (self.function.__doc__ or self.check.id).strip().splitlines()[0].rstrip(".")


def jobs_of(todo: Todo) -> Iterator[Job]:
    """Yield the checks of a TODO in the order of the rubric."""
    checks = load_checks(todo)
    for check in todo.checks:
        if not hasattr(checks, check.id):
            raise CannotGrade(f"checks/{todo.folder} has no check named {check.id}")
        yield Job(todo, check, getattr(checks, check.id))


def load_checks(todo: Todo) -> ModuleType:
    """Import the checks of a TODO."""
    return import_module(f"grader.checks.{todo.folder}.checks")
