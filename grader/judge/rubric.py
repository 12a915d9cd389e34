"""Read the rubric: the TODOs, their checks, and their points."""

from functools import cache
from pathlib import Path

import msgspec
from msgspec import Struct, structs

from grader.judge.result import Kind, is_bonus

CHECKS = Path(__file__).parents[1] / "checks"


class Check(Struct, frozen=True, forbid_unknown_fields=True):
    id: str  # the name of a function in the TODO's file of checks
    points: int
    kind: Kind
    module: str = ""  # the program that it imports, if not the TODO's module
    guard: bool = False  # a stub may pass it too: it counts once another check of the TODO passes
    needs: list[str] = []  # TODOs that must pass first
    runs: list[str] = []  # other TODOs that its scene runs, which it does not test
    cpu_seconds: int = 5  # for one child; the reference needs about a twentieth
    hidden: bool = False  # whether the students' copy lacks it, as it needs the right code


class Todo(Struct, frozen=True, forbid_unknown_fields=True):
    id: str
    title: str
    module: str  # the program that its checks import
    function: str  # the function with the TODO, as module:name; empty for the whole
    folder: str  # in checks/, with its checks and known mistakes
    checks: list[Check]
    hints: list[str] = []  # a question, the idea, nearly the code; the whole has none
    hidden_points: int = 0  # in a student's copy: the points of the checks that it lacks

    @property
    def path(self) -> str:
        """Return the function's name, such as World.step; empty for the TODO `whole`."""
        return self.function.partition(":")[2]

    @property
    def modules(self) -> list[str]:
        """Return the programs that its checks import."""
        return list(dict.fromkeys(check.module or self.module for check in self.checks))

    @property
    def function_name(self) -> str:
        return self.path.rpartition(".")[2]

    @property
    def bonus(self) -> bool:
        """Return whether it is a bonus task: full marks need none of its points."""
        return is_bonus(self.id)

    @property
    def max_points(self) -> int:
        return sum(check.points for check in self.checks)


class Rubric(Struct, frozen=True, forbid_unknown_fields=True):
    todos: list[Todo]

    @property
    def main_todos(self) -> list[Todo]:
        """Return the TODOs of the assignment itself, without the bonus tasks."""
        return [todo for todo in self.todos if not todo.bonus]

    @property
    def modules(self) -> list[str]:
        """Return the programs that its TODOs are in."""
        return list(dict.fromkeys(todo.module for todo in self.todos))

    @property
    def max_points(self) -> int:
        return sum(todo.max_points for todo in self.main_todos)

    @property
    def hidden_points(self) -> int:
        """Return the points of the checks that a student's copy lacks."""
        return sum(todo.hidden_points for todo in self.main_todos)


@cache
def load_rubric() -> Rubric:
    return msgspec.toml.decode((CHECKS / "rubric.toml").read_bytes(), type=Rubric)


def drop_hidden(rubric: Rubric) -> Rubric:
    """Return the rubric of the students' copy, without hidden checks."""
    todos = []
    for todo in rubric.todos:
        shown = [check for check in todo.checks if not check.hidden]
        points = sum(check.points for check in todo.checks if check.hidden)
        todos.append(structs.replace(todo, checks=shown, hidden_points=points))
    return Rubric(todos)
