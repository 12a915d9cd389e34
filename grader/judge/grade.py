"""Grade one submission, from a path to a Result."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING

from msgspec import structs

from grader.judge.budget import Budget
from grader.judge.failures import Broke, Failing, NotYet
from grader.judge.jobs import Key
from grader.judge.lab import Lab, Observation
from grader.judge.reference import Reference
from grader.judge.result import MAX_FILE, CheckResult, Result, TodoResult, state_of
from grader.judge.rubric import Rubric, Todo, load_rubric
from grader.judge.submission import attempt, take_in
from grader.judge.task import DEFAULT_OPTIONS, Options, Task, sandbox_for
from grader.judge.wall.children import Child, Worker, start_worker
from grader.judge.wall.isolation import load_everything
from grader.judge.wall.workplace import work_folder
from grader.protocol import cut
from grader.source.given import GivenChange
from grader.text import defuse

if TYPE_CHECKING:
    from grader.judge.explain.blame import GivenCause
    from grader.judge.explain.misconceptions import Mistake
    from grader.judge.explain.names import Names
    from grader.judge.explain.reasons import Reasons
    from grader.judge.loop import CheckLoop

IMPORT_CPU = 10  # s of processor time for importing a program


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
    with ExitStack() as at_end, work_folder() as work:
        submission = take_in(path, work / "submission")
        used = worker or start_worker(options.spawn, count=options.jobs)
        if worker is None:
            at_end.callback(used.close)
        sandbox = sandbox_for(submission, work, used, options)
        try:
            yield Grading(options, rubric, reference, submission, sandbox)
        finally:
            if worker is None:
                used.hang_up()  # its processes end while the files are removed


@contextmanager
def open_tree(tree: Path) -> Iterator[Callable[[int], Child]]:
    """Yield a function that opens children of an unchanged tree, without grading it."""
    with work_folder() as work:
        worker = start_worker()
        try:
            taken_in = take_in(tree, work / "tree")
            yield sandbox_for(taken_in, work, worker, Options(trusted=True)).open_child
        finally:
            worker.close()


@dataclass
class Grading(Task):
    """One run of the checks against one submission."""

    loop: "CheckLoop" = field(init=False)  # once it runs

    def run(self) -> Result:
        """Run the checks, return points lost to edits of given code, and word the failures."""
        if self.options.isolation == "none":
            load_everything()
        # hypothesis takes 0.1 s to load: meanwhile, children compile and import the submission.
        with suppress(RuntimeError):  # the page for a browser has no threads
            Thread(target=import_module, args=("grader.judge.loop",), daemon=True).start()
        self.sandbox.compile()
        budget = Budget()
        unusable = self.try_imports(budget)
        from grader.judge.loop import CheckLoop

        self.loop = CheckLoop(self, budget, unusable)
        self.loop.run()
        if not self.loop.failed:
            return self.make_result(None)
        from grader.judge.explain.reasons import Reasons  # a check that passes needs none

        causes = self.put_given_code_back()
        return self.make_result(Reasons(self, self.loop, causes))

    def try_imports(self, budget: Budget) -> dict[str, Broke | NotYet]:
        """Return why programs cannot be imported, found once instead of in every check."""
        unusable: dict[str, Broke | NotYet] = {}
        todos = filter(self.options.wants, self.rubric.todos)
        for module in dict.fromkeys(each for todo in todos for each in todo.modules):
            lab = Lab(module, lambda: self.sandbox.open_child(IMPORT_CPU), [])
            lab.ran(f"import {module}")
            with lab.opened():
                try:
                    lab.probe()
                except (Broke, NotYet) as failure:
                    unusable[module] = failure
            budget.charge(f"import {module}", lab.connection)
        return unusable

    @property
    def failing(self) -> dict[Key, Failing]:
        """Return the failed checks, for replays."""
        return {key: each.failing for key, each in self.loop.outcomes.items() if each.failing}

    @property
    def observations(self) -> dict[str, list[Observation]]:
        """Return all answers of the submission, by TODO."""
        return {todo.id: self.loop.list_observations(todo.id) for todo in self.rubric.todos}

    def make_result(self, reasons: "Reasons | None") -> Result:
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

    def put_given_code_back(self) -> "Mapping[Key, GivenCause]":
        """Run failed checks with changed given code undone; return the changes that matter.

        A TODO's own check that passes then counts as passed.
        """
        from grader.judge.explain.blame import CauseSearch, find_changes, undo

        loop, failed = self.loop, self.loop.failed
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
        for key, cause in search.causes.items():
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
        return search.causes

    def pass_spoilt_scenes(self, todo: Todo) -> list[CheckResult]:
        """Return a TODO's results; scenes that other TODOs spoil pass if all other checks do.

        A TODO spoils a scene if it is wrong and no right version could replace it, as in a
        program without its function. The other checks run no such TODO, and for the
        whole program also need none.
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
            return results  # none of its own checks passes
        return [pass_for_others(*pair) for pair in zip(spoilt, results, strict=True)]


def make_todo_result(
    todo: Todo, checks: list[CheckResult], reasons: "Reasons | None", unfinished: set[str]
) -> TodoResult:
    """Return the result of a TODO; messages do not change its points."""
    points = sum(check.points for check in checks)
    worded: list[CheckResult] = checks
    mistake: Mistake | None = None
    if reasons is not None:
        worded, mistake = attempt(lambda: reasons.word(todo, checks, unfinished), (worded, mistake))
    named = mistake.id if mistake is not None else None
    state = state_of(worded)
    return TodoResult(todo.id, todo.title, state, points, todo.max_points, named, worded)


def keeps_points(todo: Todo, names: "Names") -> bool:
    """Return whether a TODO has a function of its own, with the handed-out signature."""
    return bool(todo.path) and todo.path not in names.changed(todo.module)


def charge_whole(loop: "CheckLoop", cause: "GivenCause") -> None:
    """Fail a check of the whole program because a TODO needs changed given code.

    If some check of the whole program has not passed, change nothing.
    """
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
    """Give points for guards, which a stub passes too, only if another check passes."""
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
    """Count a failed check as passed if its scene runs other TODOs that are wrong.

    `wrong` names these TODOs; without any, the check is returned unchanged.
    """
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
