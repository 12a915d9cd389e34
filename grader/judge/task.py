"""The task of a grade: its options, submission and reference, and ways to open children."""

import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from grader.judge.course import FULL, Course
from grader.judge.lab import Lab
from grader.judge.passed import PassedPrograms
from grader.judge.reference import Reference
from grader.judge.result import CheckResult
from grader.judge.rubric import Check, Rubric, Todo, load_rubric
from grader.judge.submission import Submission, plain_files, take_in
from grader.judge.wall.children import Child, Worker
from grader.judge.wall.isolation import Isolation
from grader.judge.wall.sandbox import Sandbox

if TYPE_CHECKING:
    from grader.judge.explain.names import Names

KIT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Options:
    """Options of a grade; the defaults are those of a student's copy, which has no reference.

    `reference`: a complete tree, whose functions replace a submission's unfinished ones;
    `shipped_reference()` is the one of `make grade`. With None, checks that need an unfinished TODO
    wait for it.
    `course`: the TODOs and their points; by default all of them.
    `isolation`: "auto" confines as well as this machine can, and refuses to grade if files would be
    open to writing; "strict" also if some can be read or the network is open; "none" confines
    nothing.
    `trusted`: it is the user's own work, graded with the isolation available.
    `mends`: name the line in which one change makes a failed check pass, which takes seconds; only
    for `trusted` work. `only`: the ids of the TODOs to grade, such as "4" or "7a"; empty for all.
    `seed`: an instructor's secret, which changes the examples and numbers of the checks. `spawn`:
    start a new process for each child, as on platforms without fork. It changes no mark.
    `progress`: called with each check as it ends. An exception in it ends the grade. `jobs`: how
    many checks run at a time. It changes no mark. `passed`: programs that have passed and need not
    run again; only for `trusted` work.
    """

    reference: Path | None = None
    isolation: Isolation = "auto"
    only: frozenset[str] = frozenset()
    seed: int | None = None
    spawn: bool = False
    progress: Callable[[CheckResult], None] | None = None
    trusted: bool = False
    mends: bool = False
    course: Course = FULL
    passed: PassedPrograms | None = None
    jobs: int = 1

    def wants(self, todo: Todo) -> bool:
        return not self.only or todo.id in self.only


DEFAULT_OPTIONS = Options()


def shipped_reference() -> Path | None:
    """Return the solution beside the grader; None in a copy without one."""
    folder = KIT / "solution"
    return folder if (folder / "mini_engine").is_dir() else None


@dataclass
class Task:
    """A submission, and everything needed to grade it."""

    options: Options
    rubric: Rubric
    reference: Reference
    submission: Submission
    sandbox: Sandbox
    surveys_all: bool = False  # run each check to its end, to collect all that it may ask

    def was_replaced(self, todo: str) -> bool:
        """Return whether a right version of a TODO replaced it."""
        return bool(self.reference.pieces) and todo in self.submission.functions

    @cached_property
    def names(self) -> "Names":
        from grader.judge.explain.names import Names  # only a check that fails needs it

        return Names(self.submission)

    def new_lab(self, todo: Todo, check: Check) -> Lab:
        """Return a lab for one check, with the reference's code in the other TODOs."""
        module = check.module or todo.module
        pieces = self.reference.for_the_others(todo, module, self.rubric, self.submission)
        return Lab(module, lambda: self.sandbox.open_child(check.cpu_seconds), pieces)

    def open_right(self, cpu_seconds: int) -> Child:
        """Return a child of the reference itself, to see what should happen."""
        return self.right_sandbox.open_child(cpu_seconds)

    @cached_property
    def right_sandbox(self) -> Sandbox:
        """Return the sandbox of the reference, taken in when it is first needed."""
        folder = self.right_submission.folder
        return sandbox_for(self.right_submission, folder.parent, self.sandbox.worker, self.options)

    @cached_property
    def right_submission(self) -> Submission:
        """Return the reference, taken in like a submission."""
        assert self.options.reference is not None
        work = Path(tempfile.mkdtemp(dir=self.sandbox.work))  # an unguessable name
        return take_in(self.options.reference, work / "tree")


def sandbox_for(tree: Submission, work: Path, worker: Worker, options: Options) -> Sandbox:
    """Return the sandbox of a tree, which cannot reach the grader and the reference."""
    hidden = [str(KIT / "grader"), str(options.reference or KIT / "solution")]
    wanted = filter(options.wants, load_rubric().todos)
    return Sandbox(
        tree.folder,
        work,
        worker,
        options.isolation,
        hidden,
        loads=["numpy"] if tree.uses_numpy else [],
        trusted=options.trusted,
        shown=as_in_reference(tree.folder, options.reference),
        programs=sorted({module for todo in wanted for module in todo.modules}),
    )


def as_in_reference(tree: Path, reference: Path | None) -> list[str]:
    """Return the handed-out folders of a tree that hold no program, such as engines to import.

    Children need no copy of them, since their files are exactly those of the reference.
    """
    if reference is None or os.name != "posix":  # Windows may not allow a link
        return []
    programs = load_rubric().modules
    folders = [each.name for each in sorted(tree.iterdir()) if each.is_dir()]
    return [
        name
        for name in folders
        if name not in programs and has_same_files(tree / name, reference / name)
    ]


def has_same_files(folder: Path, other: Path) -> bool:
    """Return whether a folder holds the same files as another folder, which may be missing."""
    return other.is_dir() and contents(folder) == contents(other)


def contents(folder: Path) -> dict[Path, bytes]:
    return {path.relative_to(folder): path.read_bytes() for path in plain_files(folder)}
