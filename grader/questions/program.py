"""Hold a student's program for questions: its right TODOs, its text, and ways to run it.

The program is not imported here: it runs in sandboxed children, as in grading.
"""

import re
import textwrap
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from grader.judge.course import Course
from grader.judge.grade import grading
from grader.judge.lab import Lab
from grader.judge.result import Result
from grader.judge.rubric import load_rubric
from grader.judge.submission import Submission
from grader.judge.task import Options
from grader.judge.wall.children import Worker
from grader.judge.wall.sandbox import Sandbox
from grader.player.replay import MAX_DEATHS
from grader.source.definitions import Program as Modules
from grader.source.regions import python_files, read_source

QUESTION_CPU_SECONDS = 3  # budget of a child; usual ones need a twentieth
FUNCTIONS = {todo.id: todo.function for todo in load_rubric().todos if todo.function}


class CannotAsk(Exception):
    """Raised if a question cannot be asked, for example if the two ways to its answer differ."""


@dataclass(frozen=True)
class Text:
    """A function's source in a file of a tree."""

    file: str
    first: int  # its lines, counted from 1
    last: int
    source: str  # moved to the left edge


@dataclass(eq=False)  # compared by identity, so that results can be cached
class Tree:
    """The submission or the reference: its text, and children that run it, changed or not."""

    submission: Submission
    sandbox: Sandbox
    deaths: int = 0  # of children that ended before they had answered

    @cached_property
    def texts(self) -> dict[str, str]:
        folder = self.submission.folder
        return {
            path.relative_to(folder).as_posix(): read_source(path) for path in python_files(folder)
        }

    @cached_property
    def modules(self) -> Modules:
        return Modules({Path(name): text for name, text in self.texts.items()})

    def find_function(self, target: str) -> Text | None:
        """Find the definition of `module:name`; None if it is not clear."""
        found = self.modules.definition(*target.split(":"))
        if found is None or found.function is None:
            return None
        file = self.modules.paths[found.module].as_posix()
        source = self.modules.source(found.module, found.function)
        return Text(file, found.function.lineno, found.function.end_lineno, source)

    def replace_function(self, target: str, source: str) -> dict[str, str]:
        """Return the file with a function's source replaced."""
        text = self.find_function(target)
        if text is None:
            raise CannotAsk(f"there is no {target.partition(':')[2]} to be found in its text")
        lines = self.texts[text.file].splitlines()
        head = lines[text.first - 1]
        indent = head[: len(head) - len(head.lstrip())]
        new = textwrap.indent(source, indent).splitlines()
        return {text.file: "\n".join([*lines[: text.first - 1], *new, *lines[text.last :]]) + "\n"}

    def replace_constant(self, name: str, value: str) -> dict[str, str]:
        """Return the files with a constant's value replaced."""
        line = re.compile(rf"^{name}\s*=.*$", re.MULTILINE)
        changed = {
            file: line.sub(f"{name} = {value}", text)
            for file, text in self.texts.items()
            if line.search(text)
        }
        if not changed:
            raise CannotAsk(f"there is no constant {name} in its text")
        return changed

    @contextmanager
    def lab(self, module: str, changes: Mapping[str, str] | None = None) -> Iterator[Lab]:
        """Open a lab of this tree, with these files changed, if any."""
        if self.deaths >= MAX_DEATHS:
            raise CannotAsk("its process ended too often")
        sandbox = self.sandbox.changed(changes) if changes else self.sandbox
        lab = Lab(module, lambda: sandbox.open_child(QUESTION_CPU_SECONDS), [])
        lab.ran("a question")
        with lab.opened():
            try:
                yield lab
            finally:
                self.deaths += lab.ended


@dataclass
class Program:
    """A student's program, and the reference, if there is one."""

    own: Tree
    reference: Tree | None
    right: frozenset[str]  # the TODOs that pass all their checks
    given: frozenset[str] = frozenset()  # those that the course hands out done

    def can_show(self, todos: Iterable[str]) -> bool:
        """Return whether these TODOs, and those they need, are right."""
        return (self.right | self.given).issuperset(todos)


@contextmanager
def open_program(
    path: Path, options: Options, worker: Worker | None = None, result: Result | None = None
) -> Iterator[Program]:
    """Open a program for questions; grade its TODOs unless `result` is given."""
    asked = list_askable(options.course)
    with grading(path, replace(options, only=asked), worker) as run:
        found = result or run.run()
        right = {todo.id for todo in found.todos if todo.state == "passed" and todo.id in asked}
        own = Tree(run.submission, run.sandbox)
        given = frozenset(todo.id for todo in options.course.given_todos if not todo.bonus)
        known = options.reference is not None
        reference = Tree(run.right_submission, run.right_sandbox) if known else None
        yield Program(own, reference, frozenset(right), given)


def list_askable(course: Course) -> frozenset[str]:
    """Return the TODOs of a course that questions can be about: those of its programs, no bonus."""
    return frozenset(todo.id for todo in course.rubric.main_todos if todo.function)
