"""Run the checks of the rubric against one submission, and judge them in order."""

from collections.abc import Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import takewhile
from queue import SimpleQueue

from grader.judge.budget import Budget
from grader.judge.failures import Broke, NotYet
from grader.judge.jobs import Job, Key, jobs_of
from grader.judge.lab import Observation
from grader.judge.passed import PassedPrograms, program_key
from grader.judge.result import CheckResult
from grader.judge.running import Opener, Outcome, Runner
from grader.judge.submission import CannotGrade
from grader.judge.task import Task
from grader.judge.verdict import make_result, refuse, word_failure
from grader.source.flaws import Flaw


@dataclass(frozen=True)
class EarlyOutcome:
    """The outcome of a check, with the budget before and after it."""

    before: Budget
    outcome: Outcome
    after: Budget


class CheckLoop:
    """The checks of one grade, and the outcome of each."""

    def __init__(
        self, grading: Task, budget: Budget, unusable: Mapping[str, Broke | NotYet]
    ) -> None:
        options = grading.options
        self.grading, self.submission, self.rubric = grading, grading.submission, grading.rubric
        self.budget = budget
        self.runner = Runner(grading, grading.sandbox.open_child, self.budget)
        sandboxes = [grading.sandbox, *grading.sandbox.beside(options.jobs - 1)]
        self.at_once = len(sandboxes)  # checks at a time
        self.free: SimpleQueue[Opener] = SimpleQueue()  # openers that no check uses now
        for each in sandboxes:
            self.free.put(each.open_child)
        self.late = False  # whether a check ran out of time
        self.outcomes: dict[Key, Outcome] = {}
        self.unusable = unusable  # by module: why it cannot be imported
        self.passed: PassedPrograms | None = None
        if options.trusted and not grading.surveys_all:
            self.passed = options.passed

    def run(self) -> None:
        """Run every check, and judge them in the order of the rubric.

        The whole needs the results of the TODOs before it; bonus tasks, after it, need nothing.
        """
        todos = list(filter(self.grading.options.wants, self.rubric.todos))
        before = len(list(takewhile(lambda todo: todo.function, todos)))
        for group in (todos[:before], todos[before:]):
            self.runner.replaceable = self.replaceable
            self._run_group([job for todo in group for job in jobs_of(todo)])
        for outcome in self.outcomes.values():
            lab = outcome.lab
            if lab is not None and (why := self.runner.find_wrong_check(outcome.job, lab)):
                raise CannotGrade(why)

    def _run_group(self, jobs: list[Job]) -> None:
        """Run the checks of TODOs that do not depend on each other."""
        parts = {job.part: job for job in jobs}
        keys = {part: self._program_key(job) for part, job in parts.items()}
        known = {part for part, key in keys.items() if self.passed and self.passed.holds(key)}
        with self._run_ahead([job for job in jobs if job.part not in known]) as ahead:
            for job in jobs:
                self._judge(job, job.part in known, ahead.get(job.key))
        for part, key in keys.items():
            results = [self.outcomes[job.key].result for job in jobs if job.part == part]
            if self.passed and key and {(r.state, r.meaning) for r in results} == {("passed", "")}:
                self.passed.add(key)

    def _judge(self, job: Job, known: bool, ahead: "Future[EarlyOutcome | None] | None") -> None:
        """Judge a check; skip the run if the program is `known` to have passed it."""
        result = self._find_blocked(job)
        if result is None and known:
            result = make_result(job, "passed")
        outcome = Outcome(job, result) if result else self._find_outcome(job, ahead)
        self.outcomes[job.key] = outcome
        outcome.failed = outcome.result.failed and self._flaw_of(job) is None
        if self.grading.options.progress is not None:
            self.grading.options.progress(outcome.result)

    def _find_blocked(self, job: Job) -> CheckResult | None:
        """Return a check's result if it need not run."""
        if flaw := self._flaw_of(job):
            return refuse(job, flaw)
        todo, begun = job.todo, self.submission.begun
        waiting = [each for each in job.check.needs if not begun.get(each, True)]
        todos = [each.id for each in self.rubric.main_todos if each.function]
        if todo.function and not begun.get(todo.id, True):
            where = self.submission.where.get(todo.id)
            meaning = self.submission.remarks.get(todo.id, "")
            return make_result(job, "not started", where=where, meaning=meaning)
        if not todo.function and not any(begun.get(each, True) for each in todos):
            return make_result(job, "not started")
        if (why := self.unusable.get(job.module)) is not None:
            return word_failure(self.submission, job, why)
        if waiting:
            return make_result(job, "waiting", got=f"waiting for TODO {', '.join(waiting)}")
        if self.budget.cut:
            return make_result(job, "error", got=self.budget.cut)
        return None

    def _flaw_of(self, job: Job) -> Flaw | None:
        """Return the reason why Python refuses the code of a check's TODO."""
        if job.todo.function:
            return self.submission.flaws.get(job.todo.id)
        return self.submission.outside.get(job.module)

    # ------------------------------------------------------------ side by side

    @contextmanager
    def _run_ahead(self, jobs: list[Job]) -> "Iterator[dict[Key, Future[EarlyOutcome | None]]]":
        """Run checks side by side, while the loop judges them in order."""
        jobs = [job for job in jobs if self._find_blocked(job) is None]
        if min(len(jobs), self.at_once) < 2:
            yield {}
            return
        with ThreadPoolExecutor(self.at_once) as pool:
            futures = {job.key: pool.submit(self._run_beside, job) for job in order_starts(jobs)}
            try:
                yield futures
            finally:
                for future in futures.values():
                    future.cancel()

    def _run_beside(self, job: Job) -> EarlyOutcome | None:
        """Run a check beside others, unless one of them ran out of time.

        Then each check may change the budget of the next, which would have to run again.
        """
        if self.late:
            return None
        early = self._run_early(job)
        lab = early.outcome.lab
        self.late |= lab is not None and lab.late
        return early

    def _run_early(self, job: Job) -> EarlyOutcome:
        """Run a check with a copy of the budget, once an opener is free."""
        opener = self.free.get()
        try:
            before = self.budget.copy()
            runner = replace(self.runner, open_child=opener, budget=before.copy())
            return EarlyOutcome(before, runner.run(job), runner.budget)
        finally:
            self.free.put(opener)

    def _find_outcome(self, job: Job, ahead: "Future[EarlyOutcome | None] | None") -> Outcome:
        """Return the outcome of a check, and charge the budget.

        If the budget was different when the check began, it runs again: marks do not depend on how
        many run at a time.
        """
        id = job.todo.id
        early = ahead.result() if ahead is not None else None
        if early is None or early.before.allowance(id) != self.budget.allowance(id):
            early = self._run_early(job)
        self.budget.add(id, early.before, early.after)
        return early.outcome

    # ------------------------------------------------------------ outcomes

    def list_outcomes(self, todo: str) -> list[Outcome]:
        return [each for each in self.outcomes.values() if each.job.todo.id == todo]

    def list_observations(self, todo: str) -> list[Observation]:
        """Return the answers to all checks of a TODO, which distinguish known mistakes."""
        found: list[Observation] = []
        for outcome in self.list_outcomes(todo):
            found += outcome.observations
            if outcome.answers is not outcome.observations:
                found += [each for each in outcome.answers if each not in found]
        return found

    def replace_answers(self, answers: Mapping[Key, list[Observation]]) -> None:
        """Replace the answers of some checks; other observations of their TODOs do not count."""
        for key, some in answers.items():
            self.outcomes[key].answers = some
        for todo in {todo for todo, _ in answers}:
            for outcome in self.list_outcomes(todo):
                outcome.observations = outcome.answers

    @property
    def failed(self) -> dict[Key, Outcome]:
        """Return the checks that failed in their turn and can run again."""
        return {key: outcome for key, outcome in self.outcomes.items() if outcome.failed}

    @property
    def replaceable(self) -> frozenset[str]:
        """Return the failed TODOs; `whole` runs with right versions of them.

        Return none if all started TODOs have failed: the program would have nothing of its own.
        """
        failed = {id for (id, _), each in self.outcomes.items() if each.result.state != "passed"}
        begun = [todo.id for todo in self.rubric.main_todos if self.submission.begun.get(todo.id)]
        return frozenset(failed if any(id not in failed for id in begun) else ())

    # ------------------------------------------------------------ programs that have passed

    def _program_key(self, job: Job) -> str:
        """Return a key of the program that a check and others of its TODO run; see PassedPrograms.

        Empty if nothing may be remembered or a file was too long to read.
        """
        if self.passed is None or self.submission.unread:
            return ""
        right = self.runner.find_pieces(job.todo, job.module, differing=False)
        return program_key(job.todo, job.module, self.submission, right, self.grading.options.seed)


def order_starts(jobs: list[Job]) -> list[Job]:
    """Return the checks in the order in which they start.

    Properties take the longest, so they start second in their TODO. The first check tells students
    of an endless loop.
    """
    first: dict[str, int] = {}
    for number, job in enumerate(jobs):
        first.setdefault(job.todo.id, number)
    places = {
        job.key: first[job.todo.id] if job.check.kind == "property" else number
        for number, job in enumerate(jobs)
    }
    return sorted(jobs, key=lambda job: places[job.key])
