"""Grading one submission, from a path to a Result."""

import os
import shutil
import stat
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from grader.judge import misconceptions
from grader.judge.children import Child, SpawnWorker, WarmWorker, start_worker
from grader.judge.isolation import STRICT, Isolation, unconfined
from grader.judge.lab import Broke, Lab, NotYet, Observation
from grader.judge.reference import Reference
from grader.judge.result import CheckResult, Result, TodoResult, state_of
from grader.judge.rubric import CHECKS, Rubric, Todo, load_rubric
from grader.judge.submission import CannotGrade, Submission, take_in
from grader.protocol import ChildSetup, Limits
from grader.todo_regions import shape_of

if TYPE_CHECKING:
    from grader.judge.plugin import GradingPlugin

KIT = Path(__file__).parents[2]
FAILED = ("not yet", "error")  # what a known mistake may be the reason of


@dataclass(frozen=True)
class Options:
    """How to grade; the defaults are what `make grade` uses."""

    reference: Path | None = None
    isolation: Isolation = "auto"
    only: frozenset[str] = frozenset()  # TODO ids; empty for all
    seed: int | None = None  # an instructor's secret, instead of the fixed examples
    spawn: bool = False  # start each child anew, as on platforms without fork
    progress: Callable[[CheckResult], None] | None = None  # told of each check as it ends
    replays: Path | None = None  # a folder for the replays of failed checks; None for none


def shipped_reference() -> Path | None:
    """The solution beside the grader, where the whole kit is checked out."""
    folder = KIT / "solution"
    return folder if (folder / "mini_engine").is_dir() else None


def grade(path: Path, options: Options, worker: WarmWorker | SpawnWorker | None = None) -> Result:
    """Grade the submission at `path`; raises CannotGrade when there is nothing to grade.

    A `worker` that is handed in serves more than one grade and stays open.
    """
    rubric = load_rubric()
    reference = Reference(options.reference, rubric)
    with work_folder() as work:
        submission = take_in(path, work / "submission", rubric, load_stubs())
        ours = worker or start_worker(options.spawn)
        try:
            return Grading(options, rubric, reference, submission, ours, work).run()
        finally:
            if worker is None:
                ours.close()


@contextmanager
def opened(tree: Path) -> Iterator[Callable[[int], Child]]:
    """A way to open children of a tree as it is, without grading it."""
    rubric = load_rubric()
    with work_folder() as work:
        worker = start_worker()
        try:
            taken_in = take_in(tree, work / "tree", rubric, {})
            alone = Reference(None, rubric)
            yield Grading(Options(), rubric, alone, taken_in, worker, work).open_child
        finally:
            worker.close()


@cache
def load_stubs() -> dict[str, str]:
    """The shapes of the starter's stubs: of each region, and of the function around it."""
    stubs = msgspec.json.decode((CHECKS / "stubs.json").read_bytes(), type=dict[str, str])
    return {name: shape_of(source) for name, source in stubs.items()}


@contextmanager
def work_folder() -> Iterator[Path]:
    """A folder of our own, removed afterwards even where a submission made parts read-only."""
    work = Path(tempfile.mkdtemp(prefix="grader-")).resolve()
    try:
        yield work
    finally:
        for folder, _, _ in os.walk(work):
            os.chmod(folder, stat.S_IRWXU)
        shutil.rmtree(work, ignore_errors=True)


@dataclass
class Grading:
    """One run of the checks against one submission."""

    options: Options
    rubric: Rubric
    reference: Reference
    submission: Submission
    worker: WarmWorker | SpawnWorker
    work: Path
    layers: list[str] = field(default_factory=list)  # what shuts its children in
    observations: dict[str, list[Observation]] = field(default_factory=dict)  # answers, by TODO

    def run(self) -> Result:
        # Imported here: pytest and hypothesis load while the worker loads its libraries.
        from grader.judge.plugin import GradingPlugin, run_pytest

        unusable = self.find_unusable()
        plugin = GradingPlugin(
            self.submission,
            self.rubric,
            self.reference,
            self.open_child,
            unusable,
            self.options.only,
            self.options.seed,
            self.options.progress,
            observations=self.observations,
        )
        run_pytest(plugin, self.rubric)
        result = self.result(plugin)
        folder = self.options.replays
        if folder is None or not (plugin.failing or any(folder.glob("*.html"))):
            return result
        from grader.judge.replay import Replays  # only where wanted: it loads what makes pages

        known = frozenset(self.submission.functions)
        replays = Replays(folder, self.open_child, self.expected_children(), known)
        return replays.of(result, plugin.failing)

    # ------------------------------------------------------------ children

    def open_child(self, cpu_seconds: int, compiles: bool = False) -> Child:
        scratch = Path(tempfile.mkdtemp(dir=self.work))
        bytecode = shared_bytecode(self.work, scratch)
        child = self.worker.open(
            ChildSetup(
                submission=str(self.submission.folder),
                scratch=str(scratch),
                limits=Limits(cpu_seconds=cpu_seconds),
                confine=self.options.isolation != "none",
                hidden=[str(KIT / "grader"), str(self.options.reference or KIT / "solution")],
                bytecode=str(bytecode),
                compiles=compiles,
                loads=["numpy"] if self.submission.uses_numpy else [],
            )
        )
        self.layers = self.layers_around(child)
        return child

    def expected_children(self) -> Callable[[int], Child] | None:
        """A way to open children of the reference itself, to see what should happen."""
        if self.options.reference is None:
            return None
        work = Path(tempfile.mkdtemp(dir=self.work))  # a name that no submission can guess
        tree = take_in(self.options.reference, work / "tree", self.rubric, {})
        return replace(self, submission=tree, work=work).open_child

    def layers_around(self, child: Child) -> list[str]:
        """What shuts this child in; CannotGrade, with nothing run, if that is not enough."""
        if self.options.isolation == "none":
            return ["processes"]
        layers = ["processes", *child.ready.layers, *self.worker.layers]
        open_to_it = [what for what in unconfined(layers) if what in STRICT]
        if self.options.isolation == "strict" and open_to_it:
            child.end()
            raise CannotGrade(
                f"--isolation=strict: this machine cannot confine {' and '.join(open_to_it)} "
                f"(it has {', '.join(layers)}). Use a Linux with Landlock, or --isolation=auto."
            )
        return layers

    def find_unusable(self) -> dict[str, Broke | NotYet]:
        """The modules that cannot be imported, each tried once instead of in every check."""
        modules = dict.fromkeys(
            check.module or todo.module
            for todo in self.rubric.todos
            for check in todo.checks
            if not self.options.only or todo.id in self.options.only
        )
        unusable: dict[str, Broke | NotYet] = {}
        for module in modules:
            lab = Lab(module, lambda: self.open_child(10, compiles=True), [])
            lab.ran(f"import {module}")
            with lab.opened():
                try:
                    lab.probe()
                except (Broke, NotYet) as failure:
                    unusable[module] = failure
        return unusable

    # ------------------------------------------------------------ the result

    def result(self, plugin: "GradingPlugin") -> Result:
        todos = []
        for todo in self.rubric.todos:
            if not plugin.wanted(todo):
                continue
            checks = count_guards(todo, [plugin.results[todo.id, c.id] for c in todo.checks])
            mistake = None
            if any(check.state in FAILED for check in checks):
                mistake = misconceptions.named(todo.id, self.observations.get(todo.id, []))
            if mistake is not None:
                checks = [with_meaning(check, mistake.meaning) for check in checks]
            todos.append(
                TodoResult(
                    todo.id,
                    todo.title,
                    state_of(checks),
                    sum(check.points for check in checks),
                    todo.max_points,
                    mistake.id if mistake is not None else None,
                    checks,
                )
            )
        nothing = Result(
            schema=1,
            submission=self.submission.name,
            points=0,
            max_points=0,
            bonus=0,
            isolation=self.layers,
            todos=[],
        )
        return nothing.with_todos(todos)


def shared_bytecode(work: Path, scratch: Path) -> Path:
    """A folder of compiled files in which all copies of one submission find the same.

    Python looks under it for the path of the source, and each child's copy has a path of its own:
    so each gets a link to what they share.
    """
    bytecode = work / "bytecode"
    shared = bytecode / "shared"
    shared.mkdir(parents=True, exist_ok=True)
    link = bytecode / scratch.relative_to(scratch.anchor)
    link.parent.mkdir(parents=True, exist_ok=True)
    with suppress(OSError):  # Windows may not allow it: then each compiles for itself
        link.symlink_to(shared, target_is_directory=True)
    return bytecode


def count_guards(todo: Todo, checks: list[CheckResult]) -> list[CheckResult]:
    """A check that a stub passes as well earns nothing alone: another one must pass, too."""
    guards = {check.id for check in todo.checks if check.guard}
    if any(check.state == "passed" and check.id not in guards for check in checks):
        return checks
    return [
        msgspec.structs.replace(
            check, state="waiting", points=0, got="waiting for another check of this TODO to pass"
        )
        if check.state == "passed"
        else check
        for check in checks
    ]


def with_meaning(check: CheckResult, meaning: str) -> CheckResult:
    return msgspec.structs.replace(check, meaning=meaning) if check.state in FAILED else check
