"""Grade one submission, from a path to a Result."""

import os
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import structs

from grader.judge.course import FULL, Course
from grader.judge.explain.blame import CauseSearch, GivenCause, find_changes, undo
from grader.judge.explain.misconceptions import Mistake
from grader.judge.explain.names import Names
from grader.judge.failures import Failing
from grader.judge.jobs import Key
from grader.judge.lab import Lab, Observation
from grader.judge.passed import PassedPrograms
from grader.judge.reference import Reference
from grader.judge.result import MAX_FILE, CheckResult, Result, TodoResult, state_of
from grader.judge.rubric import Check, Rubric, Todo, load_rubric
from grader.judge.submission import Submission, attempt, handed_out, take_in
from grader.judge.wall.children import Child, Worker, start_worker
from grader.judge.wall.isolation import Isolation, load_everything
from grader.judge.wall.sandbox import Sandbox
from grader.judge.wall.workplace import work_folder
from grader.protocol import cut
from grader.source.given import GivenChange
from grader.source.regions import python_files, shape_of
from grader.text import defuse

if TYPE_CHECKING:
    from grader.judge.explain.reasons import Reasons
    from grader.judge.loop import CheckLoop

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


def grade(
    path: Path | str, options: Options = DEFAULT_OPTIONS, worker: Worker | None = None
) -> Result:
    """Grade the submission at `path`, a folder or a Python file.

    A full grade takes seconds; the same submission and options always give the same marks. A
    program that cannot be imported or does not end is graded, with the reason. Raises CannotGrade,
    with a sentence that says what to do, if there is nothing to grade or isolation is missing.

    A `worker` from `start_worker` can serve several grades, and stays open.
    """
    with grading(Path(path), options, worker) as run:
        return run.run()


@contextmanager
def grading(
    path: Path, options: Options, worker: Worker | None = None, rubric: Rubric | None = None
) -> Iterator["Grading"]:
    """Take in the submission at `path`, and prepare to grade it by a rubric."""
    rubric = rubric or options.course.rubric
    reference = Reference(options.reference, load_rubric())
    with work_folder() as work:
        submission = take_in(path, work / "submission", load_rubric(), load_stubs())
        used = worker or start_worker(options.spawn)
        if options.jobs > 1:
            used.helpers(options.jobs - 1)  # they load meanwhile
        try:
            sandbox = sandbox_for(submission, work, used, options)
            yield Grading(options, rubric, reference, submission, sandbox)
        finally:
            if worker is None:
                used.close()


@contextmanager
def open_tree(tree: Path) -> Iterator[Callable[[int], Child]]:
    """Yield a function that opens children of a tree as it is, without grading it."""
    with work_folder() as work:
        worker = start_worker()
        try:
            taken_in = take_in(tree, work / "tree", load_rubric(), {})
            yield sandbox_for(taken_in, work, worker, Options(trusted=True)).open_child
        finally:
            worker.close()


def sandbox_for(tree: Submission, work: Path, worker: Worker, options: Options) -> Sandbox:
    """Return the sandbox of a tree, which cannot reach the grader and the reference."""
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
    """Return the handed-out folders of a tree that hold no program, such as engines to import.

    Children need no copy of them, since their files are exactly those of the reference.
    """
    if reference is None or os.name != "posix":  # Windows may not allow a link
        return []
    programs = {todo.module for todo in load_rubric().todos}
    folders = [each.name for each in sorted(tree.iterdir()) if each.is_dir()]
    return [
        name
        for name in folders
        if name not in programs and has_same_files(tree / name, reference / name)
    ]


def has_same_files(folder: Path, other: Path) -> bool:
    """Return whether a folder holds the same Python files as another, and nothing else."""
    files = {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    return files == {p.relative_to(other): p.read_bytes() for p in python_files(other)}


@cache
def load_stubs() -> dict[str, str]:
    """Return the shapes of the stubs' regions, and of the functions around them."""
    return {name: shape_of(source) for name, source in handed_out().stubs.items()}


@dataclass
class Grading:
    """One run of the checks against one submission."""

    options: Options
    rubric: Rubric
    reference: Reference
    submission: Submission
    sandbox: Sandbox
    surveys_all: bool = False  # run each check to its end, to collect all that it may ask
    loop: "CheckLoop" = field(init=False)  # once it runs

    def run(self) -> Result:
        """Run the checks, give back points that changed given code cost, and word the failures."""
        if self.options.isolation == "none":
            load_everything()
        # Imported here to save 0.2 s: hypothesis loads while the worker loads.
        from grader.judge.explain.reasons import Reasons
        from grader.judge.loop import CheckLoop

        self.loop = CheckLoop(self)
        self.loop.run()
        causes = self.put_given_code_back()
        return self.make_result(Reasons(self, self.loop, causes))

    @property
    def failing(self) -> dict[Key, Failing]:
        """Return the failed checks, for replays."""
        return {key: each.failing for key, each in self.loop.outcomes.items() if each.failing}

    @property
    def observations(self) -> dict[str, list[Observation]]:
        """Return all answers of the submission, by TODO."""
        return {todo.id: self.loop.list_observations(todo.id) for todo in self.rubric.todos}

    def make_result(self, reasons: "Reasons") -> Result:
        """Return the marks, and the reasons of the checks that failed."""
        todos = [todo for todo in self.rubric.todos if self.options.wants(todo)]
        checks = {todo.id: count_guards(todo, self.pass_spoilt_scenes(todo)) for todo in todos}
        unfinished = {id for id, some in checks.items() if state_of(some) != "passed"}
        nothing = Result(
            schema=1,
            submission=cut(defuse(self.submission.name), MAX_FILE),
            points=0,
            max_points=0,
            bonus=0,
            isolation=self.sandbox.layers,
            todos=[],
        )
        results = [make_todo_result(todo, checks[todo.id], reasons, unfinished) for todo in todos]
        return nothing.with_todos(results).in_bounds()

    def put_given_code_back(self) -> Mapping[Key, GivenCause]:
        """Run failed checks with changed given code undone; return the changes that matter.

        If a TODO's own check passes then, it counts as passed.
        """
        loop, failed = self.loop, self.loop.failed
        if not failed:
            return {}
        unusable = loop.unusable.values()
        given = attempt(lambda: find_changes(self.submission, unusable), list[GivenChange]())
        if not given:
            return {}
        search = CauseSearch(
            given,
            lambda undone: self.sandbox.changed(undo(self.submission, undone)).open_child,
            lambda key, open_child: loop.runner.run_again(failed[key].job, open_child),
            lambda: bool(loop.budget.cut),
        )
        search.look_into({key: each.result for key, each in failed.items()})
        loop.replace_answers(search.answers)
        costly = []
        for key, cause in search.found.items():
            outcome = failed[key]
            if not cause.mended or not keeps_points(outcome.job.todo, self.names):
                continue
            check, job = outcome.result, outcome.job
            hint = "" if cause.is_all else self.names.hint(job.todo, job.module, check)
            passed = as_passed(check, f"{cause.in_words} {hint}".rstrip())
            outcome.result = structs.replace(passed, where=cause.place(check))
            outcome.failing = None
            if not cause.is_experiment:
                costly.append(cause)
        if costly:
            charge_whole(loop, costly[0])
        return search.found

    def pass_spoilt_scenes(self, todo: Todo) -> list[CheckResult]:
        """Return the results of a TODO; a scene spoilt by another TODO counts like the rest.

        Another TODO spoils a scene if it is wrong and no right version could replace it, as in a
        program without its function. For the whole, the rest are the checks without such TODOs.
        """
        results = [self.loop.outcomes[todo.id, each.id].result for each in todo.checks]
        wrong = {id for (id, _) in self.loop.failed if not self.was_replaced(id)}
        spoilt = [
            sorted(wrong & {*check.runs, *(() if todo.function else check.needs)})
            for check in todo.checks
        ]
        rest = [r for r, ids in zip(results, spoilt, strict=True) if not ids]
        guards = {check.id for check in todo.checks if check.guard}
        if {each.id for each in rest} <= guards or any(r.state != "passed" for r in rest):
            return results  # nothing of its own is right
        return [pass_for_others(*pair) for pair in zip(spoilt, results, strict=True)]

    def was_replaced(self, todo: str) -> bool:
        """Return whether a right version of a TODO replaced it."""
        return bool(self.reference.pieces) and todo in self.submission.functions

    @cached_property
    def names(self) -> Names:
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
        return take_in(self.options.reference, work / "tree", self.rubric, {})


def make_todo_result(
    todo: Todo, checks: list[CheckResult], reasons: "Reasons", unfinished: set[str]
) -> TodoResult:
    """Return the result of a TODO; messages do not change its points."""
    points = sum(check.points for check in checks)
    nothing: tuple[list[CheckResult], Mistake | None] = (checks, None)
    worded, mistake = attempt(lambda: reasons.word(todo, checks, unfinished), nothing)
    named = mistake.id if mistake is not None else None
    state = state_of(worded)
    return TodoResult(todo.id, todo.title, state, points, todo.max_points, named, worded)


def keeps_points(todo: Todo, names: Names) -> bool:
    """Return whether a TODO's function has the handed-out signature and only its own code."""
    return bool(todo.path) and todo.path not in names.changed(todo.module)


def charge_whole(loop: "CheckLoop", cause: GivenCause) -> None:
    """Subtract a point of the whole for changed given code that a TODO needs, unless it lost
    one."""
    whole = loop.list_outcomes("whole")
    passed = [each for each in whole if each.result.state == "passed"]
    if not passed or len(passed) < len(whole):
        return
    check = passed[0].result
    passed[0].result = structs.replace(
        check,
        state="not yet",
        points=0,
        ran="the checks of the TODOs with your own code around them",
        expected="the code around the TODOs as it was handed out",
        got="; ".join(each.how for each in cause.changes),
        meaning=cause.in_words,
        where=cause.place(check),
    )


def count_guards(todo: Todo, checks: list[CheckResult]) -> list[CheckResult]:
    """Give no points for checks that a stub passes as well, unless another one passes too."""
    guards = {check.id for check in todo.checks if check.guard}
    if any(check.state == "passed" and check.id not in guards for check in checks):
        return checks
    waits = "waiting for another check of this TODO to pass"
    return [
        structs.replace(check, state="waiting", points=0, got=waits)
        if check.state == "passed"
        else check
        for check in checks
    ]


def pass_for_others(wrong: list[str], check: CheckResult) -> CheckResult:
    """Return a check as passed if it failed for other TODOs, which are wrong; else unchanged."""
    if not wrong or not check.failed:
        return check
    meaning = (
        f"A scene that also runs TODO {', '.join(wrong)}, which is not right yet, cannot be "
        "judged. It counts as passed, because all else here passes."
    )
    return as_passed(check, meaning)


def as_passed(check: CheckResult, meaning: str) -> CheckResult:
    """Return a failed check as passed, with a sentence on the reason."""
    return structs.replace(
        check, state="passed", points=check.max_points, expected="", got="", meaning=meaning
    )
