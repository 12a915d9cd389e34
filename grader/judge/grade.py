"""Grading one submission, from a path to a Result."""

import os
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path

import msgspec

from grader.judge import misconceptions
from grader.judge.blame import Blame, Blamed, Key
from grader.judge.budget import Budget
from grader.judge.children import Child, Worker, start_worker
from grader.judge.course import FULL, Course
from grader.judge.diagnosis import Diagnosis
from grader.judge.failures import KEPT, MOST_NAMES, REMEMBERS, Broke, Failing, NotYet
from grader.judge.isolation import Isolation, load_everything
from grader.judge.lab import Lab, Observation
from grader.judge.names import Names
from grader.judge.reference import Reference
from grader.judge.result import MAX_FILE, CheckResult, Result, TodoResult, state_of
from grader.judge.rubric import CHECKS, Rubric, Todo, load_rubric
from grader.judge.sandbox import Sandbox
from grader.judge.submission import Submission, load_given, take_in
from grader.judge.workplace import work_folder
from grader.protocol import cut
from grader.source.given import Changed, changes, restored
from grader.source.regions import python_files, read_source, regions_in, shape_of
from grader.text import harmless

KIT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Options:
    """How to grade; without any, as a student's copy does that has no reference.

    `reference`: a complete tree, whose functions stand in for a submission's unfinished ones;
    `shipped_reference()` is the one that `make grade` takes. With None, checks that need an
    unfinished TODO wait for it.
    `course`: what is asked, and for how many points; without one, all that there is.
    `isolation`: "auto" confines as well as this machine can and refuses to grade where files would
    be open, "strict" also where some may be read or the network is open, "none" confines nothing.
    `trusted`: it is one's own work, and graded with what confinement there is.
    `only`: the ids of the TODOs to grade, such as "4" or "7a"; empty for all.
    `seed`: an instructor's secret, for other examples in the property checks than the fixed ones.
    `spawn`: start each child anew, as on platforms without fork. Slower, and the same marks.
    `progress`: told of each check as it ends. What it raises ends the grade.
    """

    reference: Path | None = None
    isolation: Isolation = "auto"
    only: frozenset[str] = frozenset()
    seed: int | None = None
    spawn: bool = False
    progress: Callable[[CheckResult], None] | None = None
    trusted: bool = False
    course: Course = FULL

    def wants(self, todo: Todo) -> bool:
        return not self.only or todo.id in self.only


DEFAULT_OPTIONS = Options()


def shipped_reference() -> Path | None:
    """The solution beside the grader, where the whole kit is checked out."""
    folder = KIT / "solution"
    return folder if (folder / "mini_engine").is_dir() else None


def grade(
    path: Path | str, options: Options = DEFAULT_OPTIONS, worker: Worker | None = None
) -> Result:
    """Grade the submission at `path`, a folder or a Python file.

    A full grade takes seconds; the same submission and options always give the same marks. What
    cannot be imported or does not end is graded, with the reason. Raises CannotGrade, with a
    sentence that says what to do, when there is nothing to grade or not as the options ask.

    A `worker` that is handed in, from `start_worker`, serves more than one grade and stays open.
    """
    with grading(Path(path), options, worker) as ours:
        return ours.run()


@contextmanager
def grading(
    path: Path, options: Options, worker: Worker | None = None, rubric: Rubric | None = None
) -> Iterator["Grading"]:
    """All that it takes to grade the submission at `path`, by another rubric where one is given."""
    rubric = rubric or options.course.rubric
    reference = Reference(options.reference, load_rubric())
    with work_folder() as work:
        submission = take_in(path, work / "submission", load_rubric(), load_stubs())
        ours = worker or start_worker(options.spawn)
        try:
            sandbox = sandbox_for(submission, work, ours, options)
            yield Grading(options, rubric, reference, submission, sandbox)
        finally:
            if worker is None:
                ours.close()


@contextmanager
def opened(tree: Path) -> Iterator[Callable[[int], Child]]:
    """A way to open children of a tree as it is, without grading it."""
    with work_folder() as work:
        worker = start_worker()
        try:
            taken_in = take_in(tree, work / "tree", load_rubric(), {})
            yield sandbox_for(taken_in, work, worker, Options(trusted=True)).open_child
        finally:
            worker.close()


def sandbox_for(tree: Submission, work: Path, worker: Worker, options: Options) -> Sandbox:
    """The sandbox of a tree: the grader and the reference are out of its children's reach."""
    hidden = [str(KIT / "grader"), str(options.reference or KIT / "solution")]
    return Sandbox(
        tree.folder,
        work,
        worker,
        options.isolation,
        hidden,
        loads=["numpy"] if tree.uses_numpy else [],
        trusted=options.trusted,
        shown=as_in_reference(tree.folder, options.reference),
    )


def as_in_reference(tree: Path, reference: Path | None) -> list[str]:
    """The folders of a tree that hold no program and are just as the reference has them.

    They were handed out to be used. A folder of the student's own, which a program may write to, is
    never among them.
    """
    if reference is None or os.name != "posix":  # Windows may not allow a link
        return []
    programs = {todo.module for todo in load_rubric().todos}
    folders = [each.name for each in sorted(tree.iterdir()) if each.is_dir()]
    return [
        name for name in folders if name not in programs and alike(tree / name, reference / name)
    ]


def alike(folder: Path, other: Path) -> bool:
    """Whether a folder holds the same Python files as another, and nothing else."""
    ours = {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    return ours == {p.relative_to(other): p.read_bytes() for p in python_files(other)}


@cache
def load_stubs() -> dict[str, str]:
    """The shapes of the starter's stubs: of each region, and of the function around it."""
    stubs = msgspec.json.decode((CHECKS / "stubs.json").read_bytes(), type=dict[str, str])
    return {name: shape_of(source) for name, source in stubs.items()}


@dataclass
class Grading:
    """One run of the checks against one submission."""

    options: Options
    rubric: Rubric
    reference: Reference
    submission: Submission
    sandbox: Sandbox
    observations: dict[str, list[Observation]] = field(default_factory=dict)  # answers, by TODO
    blamed: dict[Key, Blamed] = field(default_factory=dict)  # what fails for changed given code
    remembered: dict[Key, list[str]] = field(default_factory=dict)  # the names that kept something
    surveys_all: bool = False  # ask each check to its end, to have all that it may ask
    failing: dict[Key, Failing] = field(default_factory=dict)  # what a replay shows once more

    def run(self) -> Result:
        if self.options.isolation == "none":
            load_everything()
        # Here for the time it takes, 0.2 s: pytest and hypothesis load while the worker loads.
        from grader.judge.loop import CheckLoop

        budget = Budget()
        loop = CheckLoop(
            self.submission,
            self.rubric,
            self.reference,
            self.sandbox.open_child,
            self.find_unusable(budget),
            self.options.wants,
            self.options.seed,
            self.options.progress,
            observations=self.observations,
            surveys_all=self.surveys_all,
            budget=budget,
            open_right=self.open_right if self.options.reference else None,
        )
        loop.run()
        seen = dict(loop.seen)
        failed = {key: check for key, check in loop.results.items() if check.failed}
        if failed and (changed := self.changed_given()):
            blame = Blame(changed, self.open_with, loop.again, lambda: bool(loop.budget.cut))
            blame.look_into(failed)
            self.blamed = blame.found
            seen |= blame.seen
            for id in {id for id, _ in blame.seen}:
                answers = [each for key, each in seen.items() if key[0] == id]
                self.observations[id] = [each for some in answers for each in some]
        self.remembered = loop.remembered
        self.failing = loop.failing
        return self.result(loop.results, seen)

    def open_right(self, cpu_seconds: int) -> Child:
        """A child of the reference itself, to see what should happen."""
        return self.right_sandbox.open_child(cpu_seconds)

    @cached_property
    def right_sandbox(self) -> Sandbox:
        """That of the reference, taken in when it is first needed."""
        folder = self.right_submission.folder
        return sandbox_for(self.right_submission, folder.parent, self.sandbox.worker, self.options)

    @cached_property
    def right_submission(self) -> Submission:
        """The reference, taken in like a submission."""
        assert self.options.reference is not None
        work = Path(tempfile.mkdtemp(dir=self.sandbox.work))  # a name that nobody can guess
        return take_in(self.options.reference, work / "tree", self.rubric, {})

    def changed_given(self) -> list[Changed]:
        """What this submission has otherwise than it was handed out."""
        folder, given = self.submission.folder, load_given()
        own = {name: folder / name for name in given if (folder / name).is_file()}
        return changes({name: read_source(path) for name, path in own.items()}, given)

    def open_with(self, undone: Sequence[Changed]) -> Callable[[int], Child]:
        """A way to open children of the submission with some given code put back."""
        folder, files = self.submission.folder, {each.file for each in undone}
        mine = {name: [each for each in undone if each.file == name] for name in files}
        texts = {name: restored(read_source(folder / name), mine[name]) for name in files}
        return self.sandbox.changed(texts).open_child

    def find_unusable(self, budget: Budget) -> dict[str, Broke | NotYet]:
        """The modules that cannot be imported, each tried once instead of in every check."""
        modules = dict.fromkeys(
            check.module or todo.module
            for todo in filter(self.options.wants, self.rubric.todos)
            for check in todo.checks
        )
        unusable: dict[str, Broke | NotYet] = {}
        for module in modules:
            lab = Lab(module, lambda: self.sandbox.open_child(10), [])
            lab.ran(f"import {module}")
            with lab.opened():
                try:
                    lab.probe()
                except (Broke, NotYet) as failure:
                    unusable[module] = failure
            budget.charge(f"import {module}", lab.connection)
        return unusable

    def mended(self, todo: Todo, check: CheckResult) -> bool:
        """Whether a check passes once given code is put back."""
        blamed = self.blamed.get((todo.id, check.id))
        return blamed is not None and blamed.mended

    def result(
        self,
        results: Mapping[tuple[str, str], CheckResult],
        seen: Mapping[tuple[str, str], list[Observation]],
    ) -> Result:
        """The marks; `results` are what came of the checks, by TODO and check.

        Where no known mistake explains all answers, `seen` tells what is wrong in those of each.
        """
        todos = []
        for todo in filter(self.options.wants, self.rubric.todos):
            checks = count_guards(todo, [results[todo.id, each.id] for each in todo.checks])
            mistake = None
            if any(check.failed and not self.mended(todo, check) for check in checks):
                mistake = misconceptions.named(todo.id, self.observations.get(todo.id, []))
            if mistake is not None:
                checks = [with_meaning(check, mistake.meaning) for check in checks]
            else:
                asked = {each.id: seen.get((todo.id, each.id), []) for each in checks}
                checks = told_in_part(todo.id, checks, asked)
                kept = {each.id: self.remembered.get((todo.id, each.id), []) for each in checks}
                checks = [with_memory(each, kept[each.id]) for each in checks]
            checks = [self.with_hint(todo, each) for each in checks]
            checks = [
                self.blamed[todo.id, check.id].told(check)
                if (todo.id, check.id) in self.blamed
                else check
                for check in checks
            ]
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
            submission=cut(harmless(self.submission.name), MAX_FILE),
            points=0,
            max_points=0,
            bonus=0,
            isolation=self.sandbox.layers,
            todos=[],
        )
        return nothing.with_todos(todos).in_bounds()

    def with_hint(self, todo: Todo, check: CheckResult) -> CheckResult:
        """With what a name or an argument has to do with a failure: before any other meaning."""
        if not check.failed:
            return check
        modules = {each.id: each.module or todo.module for each in todo.checks}
        hint = self.names.hint(todo, modules[check.id], check)
        return with_meaning(check, hint) if hint else check

    @cached_property
    def names(self) -> Names:
        return Names(self.submission.folder)


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


def told_in_part(
    todo: str, checks: list[CheckResult], asked: dict[str, list[Observation]]
) -> list[CheckResult]:
    """Each failed check with what its own answers tell, unless it says so itself."""
    if not any(check.failed for check in checks):
        return checks
    if any(check.meaning == REMEMBERS for check in checks):  # then no number means anything
        return checks
    diagnosis = Diagnosis(todo, [each for answers in asked.values() for each in answers])
    return [
        check if check.meaning else with_meaning(check, diagnosis.of(asked[check.id]))
        for check in checks
    ]


def with_memory(check: CheckResult, names: list[str]) -> CheckResult:
    """A failed check with the names in which something is kept from call to call, if there are any.

    That alone is no mistake, but answers that hang on it are, and look like any others. What given
    code without a TODO keeps, such as the frames that are left, is nobody's mistake.
    """
    names = [name for name in names if f"{name.partition('.')[0]}.py" not in untouched()]
    if not names or not check.failed:
        return check
    shown = ", ".join(name.rpartition(".")[2] for name in names[:MOST_NAMES])
    return with_meaning(check, f"{check.meaning} {KEPT.format(names=shown)}".strip())


@cache
def untouched() -> frozenset[str]:
    """The files that were handed out without anything to do in them."""
    return frozenset(name for name, text in load_given().items() if not regions_in(text))


def with_meaning(check: CheckResult, meaning: str) -> CheckResult:
    return msgspec.structs.replace(check, meaning=meaning) if check.failed else check
