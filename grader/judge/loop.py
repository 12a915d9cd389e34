"""Run the checks that the rubric names against one submission, and judge them in order."""

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from importlib import import_module
from itertools import groupby
from queue import SimpleQueue
from types import ModuleType
from typing import Any

from hypothesis.errors import Flaky
from msgspec import UNSET, structs

from grader.judge.budget import LITTLE_CPU, Budget, for_words
from grader.judge.children import Child
from grader.judge.drawing import Example, kept_examples
from grader.judge.failures import REMEMBERS, Broke, Failing, NotYet, secret_of
from grader.judge.lab import Lab, Observation
from grader.judge.numbers import readable, tidied
from grader.judge.passed import PassedPrograms, program_key
from grader.judge.reference import Reference
from grader.judge.result import CheckResult, State, Where, in_bounds
from grader.judge.rubric import Check, Rubric, Todo
from grader.judge.submission import CannotGrade, Submission, load_given
from grader.protocol import CodeLine, Piece, cut
from grader.source.flaws import Flaw

DIGITS = re.compile(r"[-\d.e]+")  # what differs between two examples of one question
# An import of a name that a file of theirs does not define.
LACKING = re.compile(r"^ImportError: cannot import name .* from '[\w.]+' \((?P<file>[\w/]+\.py)\)")
INSTEAD = "The handed-out code stood in for it, so that the rest could be checked."
UNREAD = 3  # files of which is told that they were too long to look into
COST = {"unit": 0, "scene": 1, "property": 2}  # kinds of checks, the longest last
SURVEY = 2  # s of processor time, for that
GIVEN_PRINTS = ("Fixed steps:", "Pendulum length", "Bodies:", "Box stack")  # as they end
MOST_PRINTED, MAX_PRINTED = 3, 60  # lines of what a submission printed, and letters of each
BRIEF = 1.0  # s of processor time: a check that took less is asked to its end where it failed


Opener = Callable[[int], Child]  # takes the budget in CPU seconds


@dataclass(frozen=True)
class Job:
    """A check that is to run, and the function that does it."""

    todo: Todo
    check: Check
    function: Any

    @property
    def key(self) -> tuple[str, str]:
        return self.todo.id, self.check.id

    @property
    def module(self) -> str:
        return self.check.module or self.todo.module

    @property
    def title(self) -> str:
        return (self.function.__doc__ or self.check.id).strip().splitlines()[0].rstrip(".")


@dataclass(frozen=True)
class Way:
    """The way in which a check runs.

    `isolated`: with the reference in the other TODOs' places. `right`: on the reference itself.
    `surveys`: on to its end where it fails.
    `watched`: noting what the submission remembers. `opener`: in children that others open.
    `words`: in children with so many processor seconds, which decide about words alone and cost
    nothing of the time that decides about marks.
    """

    isolated: bool = False
    right: bool = False
    surveys: bool = False
    watched: bool = False
    opener: Opener | None = None
    words: int = 0


ALONE, ISOLATED = Way(), Way(isolated=True)


@dataclass(frozen=True)
class Outcome:
    """The result of a check that ran, and what was seen of it."""

    result: CheckResult
    lab: Lab  # whose observations count
    answers: list[Observation]  # to all that the check asks; see _survey
    elsewhere: str | None  # the TODO in which it fails first, or nothing where that is unknown
    failed: Lab | None = None  # the one that is told of
    failing: Failing | None = None  # to be seen once more


@dataclass(frozen=True)
class Ahead:
    """The outcome of a check that a helper ran, with the budget before and after it."""

    before: Budget
    outcome: Outcome
    after: Budget


@dataclass
class CheckLoop:
    """One run of the checks: what they are given, and what came of each."""

    submission: Submission
    rubric: Rubric
    reference: Reference
    open_child: Opener
    unusable: dict[str, Broke | NotYet]  # module -> why it cannot be imported
    wanted: Callable[[Todo], bool]
    seed: int | None = None
    progress: Callable[[CheckResult], None] | None = None
    results: dict[tuple[str, str], CheckResult] = field(default_factory=dict)
    observations: dict[str, list[Observation]] = field(default_factory=dict)
    seen: dict[tuple[str, str], list[Observation]] = field(default_factory=dict)  # see _survey
    remembered: dict[tuple[str, str], list[str]] = field(default_factory=dict)  # by failed check
    trespasses: dict[tuple[str, str], str] = field(default_factory=dict)  # by failed check
    failed: dict[tuple[str, str], Job] = field(default_factory=dict)  # that can be asked again
    shows_output: bool = False  # whether to tell what the submission printed
    surveys_all: bool = False  # whether checks that pass are surveyed as well
    failing: dict[tuple[str, str], Failing] = field(default_factory=dict)  # to be seen once more
    budget: Budget = field(default_factory=Budget)
    open_right: Opener | None = None  # a child of the reference itself
    elsewhere: dict[tuple[str, str], str] = field(default_factory=dict)  # TODOs it fails in first
    wrong: str = ""  # which check fails the right code, and how
    passed: PassedPrograms | None = None  # which need not run again
    helpers: Sequence[Opener] = ()  # ways to open children beside those of `open_child`

    def run(self) -> None:
        """Run every check, and judge them in the order of the rubric.

        The whole hangs on what came of the TODOs, so it is begun when they have ended.
        """
        todos = filter(self.wanted, self.rubric.todos)
        for _, group in groupby(todos, lambda todo: bool(todo.function)):
            self._run_group({todo.id: list(jobs_of(todo)) for todo in group})
        if self.wrong:
            raise CannotGrade(self.wrong)

    def _run_group(self, group: dict[str, list[Job]]) -> None:
        """Run the checks of some TODOs, which do not hang on each other."""
        keys = {id: self._program_key(jobs[0].todo) for id, jobs in group.items()}
        known = {id for id, key in keys.items() if self.passed and self.passed.holds(key)}
        jobs = [job for some in group.values() for job in some]
        with self._ahead([job for job in jobs if job.todo.id not in known]) as ahead:
            for job in jobs:
                self.judge(job, job.todo.id in known, ahead.get(job.key))
        for id, some in group.items():
            ends = {(self.results[job.key].state, self.results[job.key].meaning) for job in some}
            if self.passed and keys[id] and ends == {("passed", "")}:
                self.passed.add(keys[id])

    def judge(self, job: Job, known: bool = False, ahead: "Future[Ahead] | None" = None) -> None:
        """Judge a check; where the program is `known` to have passed it, without running it."""
        result = self._blocked(job)
        if result is None and known:
            result = self._result(job, "passed")
        if result is None:
            outcome = self._outcome(job, ahead)
            self._count(job, outcome)
            result = outcome.result
        self.results[job.key] = result
        if result.failed and self._flaw_of(job) is None:
            self.failed[job.key] = job
        if self.progress is not None:
            self.progress(result)

    # ------------------------------------------------------------ side by side

    @contextmanager
    def _ahead(self, jobs: list[Job]) -> Iterator[dict[tuple[str, str], "Future[Ahead]"]]:
        """Let helpers run checks, the last one first, while the loop begins with the first.

        Each has a copy of the budget. Where the loop's turns out to have been another one, the
        check is run once more: marks do not hang on how many run at a time.
        """
        jobs = [job for job in jobs if self.helpers and self._blocked(job) is None]
        if len(jobs) < 2:
            yield {}
            return
        free: SimpleQueue[Opener] = SimpleQueue()
        for opener in self.helpers:
            free.put(opener)

        def run(job: Job) -> Ahead:
            opener = free.get()
            try:
                before = self.budget.copy()
                apart = replace(self, open_child=opener, budget=before.copy())
                return Ahead(before, apart._run(job), apart.budget)
            finally:
                free.put(opener)

        with ThreadPoolExecutor(len(self.helpers)) as pool:
            futures = {job.key: pool.submit(run, job) for job in reversed(jobs)}
            try:
                yield futures
            finally:
                for future in futures.values():
                    future.cancel()

    def _outcome(self, job: Job, ahead: "Future[Ahead] | None") -> "Outcome":
        """Return what came of a check: that of a helper, if one has begun it."""
        if ahead is None or ahead.cancel():
            return self._run(job)
        done, id = ahead.result(), job.todo.id
        if done.before.allowance(id) != self.budget.allowance(id):
            return self._run(job)
        self.budget.add(id, done.before, done.after)
        return done.outcome

    def _count(self, job: Job, outcome: "Outcome") -> None:
        """Note what came of a check beside its result."""
        lab, answers = outcome.lab, outcome.answers
        self.seen[job.key] = answers
        of_todo = self.observations.setdefault(job.todo.id, [])
        of_todo.extend(lab.observations)
        if answers is not lab.observations:
            of_todo.extend(each for each in answers if each not in of_todo)
        if outcome.elsewhere is not None:
            self.elsewhere[job.key] = outcome.elsewhere
        if outcome.failed is not None:
            self._blame(job, outcome.failed)
            self.remembered[job.key] = outcome.failed.remembers
            self.trespasses[job.key] = outcome.failed.trespass
        if outcome.failing is not None:
            self.failing[job.key] = outcome.failing

    # ------------------------------------------------------------ one check

    def _program_key(self, todo: Todo) -> str:
        """Return a key of the program that a TODO's checks run; see PassedPrograms.

        Empty if nothing may be remembered or a file was too long to read.
        """
        if self.passed is None or self.submission.unread:
            return ""
        modules = dict.fromkeys(check.module or todo.module for check in todo.checks)
        right = [
            piece for module in modules for piece in self._right(todo, module, differing=False)
        ]
        return program_key(todo, self.submission, right, self.seed)

    def _right(self, todo: Todo, module: str, differing: bool = True) -> list[Piece]:
        """Return the right versions of other TODOs; see Reference.for_the_others."""
        failed = self.replaceable()
        return self.reference.for_the_others(
            todo, module, self.rubric, self.submission, failed, differing
        )

    def _blocked(self, job: Job) -> CheckResult | None:
        """Return the result of a check that need not run."""
        if flaw := self._flaw_of(job):
            return self._refused(job, flaw)
        todo, begun = job.todo, self.submission.begun
        waiting = [each for each in job.check.needs if not begun.get(each, True)]
        todos = [each.id for each in self.rubric.counted if each.function]
        none_begun = not any(begun.get(each, True) for each in todos)
        if todo.function and not begun.get(todo.id, True):
            where, words = self.submission.where.get(todo.id), self.submission.remarks.get(todo.id)
            return self._result(job, "not started", where=where, meaning=words or "")
        if not todo.function and none_begun:
            return self._result(job, "not started")
        why = self.unusable.get(job.module)
        if why is not None:
            return self._failure(job, why)
        if waiting:
            return self._result(job, "waiting", got=f"waiting for TODO {', '.join(waiting)}")
        if self.budget.cut:
            return self._result(job, "error", got=self.budget.cut)
        return None

    def _run(self, job: Job) -> "Outcome":
        """Run a check with the reference in the other TODOs' places, then the program as it is.

        What is told of a failure comes from the program as it is. Where the reference was sent, a
        submission could have read it, and any word or number of its answers could spell it out;
        whether it was put in place is for the child to say, and so no matter. Nobody waits twice
        for one whose time was over: then nothing is told but that.

        Nothing of the loop changes but its budget.
        """
        lab, again = self._attempt(job, ISOLATED)
        alone, elsewhere = lab, None
        if lab.failure is not None and lab.connection.pieces and not lab.late:
            alone, again = self._attempt(job, ALONE)
        if alone.failure is None:
            lab = alone
        elif lab.failure is not None and fails_elsewhere(lab.failure, alone.failure):
            elsewhere = self._todo_of(alone.failure)
        if alone.failure is not None and alone.connection.pieces:
            answers: list[Observation] = []
        else:
            answers = self._survey(job, alone)
        if alone.failure is None:
            passed = self._result(job, "passed", meaning=" ".join(lab.notes))
            return Outcome(passed, lab, answers, elsewhere)
        failing = None
        if not alone.ended:
            secret = secret_of(self.seed, job.todo, job.check)
            pieces = alone.connection.pieces
            failing = Failing(job.todo, job.check, again, pieces, secret)
        result = self._failure(job, alone.failure)
        if self.shows_output and not alone.played and not result.got.startswith("BdbQuit"):
            result = structs.replace(result, printed=last_lines(alone.connection.output) or UNSET)
        return Outcome(in_bounds(result), lab, answers, elsewhere, alone, failing)

    def _survey(self, job: Job, alone: Lab) -> list[Observation]:
        """Ask the program as it is all that a failed check asks, and not just so far.

        By that, what is wrong can be told from what is right. Not worth its time for a property,
        which asks much, nor where a program was played.
        """
        wanted = isinstance(alone.failure, NotYet) or self.surveys_all
        brief = alone.connection.cpu < BRIEF and not alone.played and self.budget.has_more
        is_property = job.check.kind == "property"
        if not wanted or not brief or not alone.observations or is_property:
            return alone.observations
        survey = self._ask(job, job.function, Way(surveys=True, watched=True, words=SURVEY))
        alone.remembers = survey.remembers
        return survey.observations

    def _blame(self, job: Job, lab: Lab) -> None:
        """Note a check that the right code fails as well: that is not the submission's fault.

        Asked only where it may be so: of an error that nobody foresaw, and of a submission that
        has the right code in this place.
        """
        likely = lab.unforeseen or self.reference.is_that_of(self.submission, job.todo)
        cut = lab.ended and not lab.unforeseen  # out of time or memory: that may be the machine
        if self.open_right is None or self.wrong or cut or not likely:
            return
        with kept_examples(job.function, self.seed):
            right = self._ask(job, job.function, Way(right=True))
        failure = right.failure
        if failure is None or (right.ended and not right.unforeseen):
            return
        expected = f"; expected: {failure.expected}" if isinstance(failure, NotYet) else ""
        self.wrong = (
            f"the check {job.check.id} in checks/{job.todo.folder} is wrong: the right code fails "
            f"it too. It ran: {failure.ran}{expected}; got: {failure.got}"
        )

    def _attempt(self, job: Job, way: Way) -> tuple[Lab, Example]:
        """Return a lab in which the check ran, and what ran there last.

        A property draws the same for all, so it asks at once what another submission has passed.
        Only where that fails need hypothesis look for the simplest example.
        """
        known = passed_before.get((job.function, self.seed))
        if known is not None:
            example = partial(each_of, known)
            lab = self._ask(job, example, way)
            if lab.failure is None or lab.ended:
                return lab, example
        with kept_examples(job.function, self.seed) as examples:
            lab = self._ask(job, job.function, way)
        if not examples:
            return lab, job.function
        if lab.failure is None:
            passed_before[job.function, self.seed] = examples
        elif isinstance(lab.failure, NotYet) and lab.failure is not lab.overstepped:
            lab = self._alone(lab, self._ask(job, examples[-1], replace(way, watched=True)))
        return lab, examples[-1]

    def _alone(self, lab: Lab, alone: Lab) -> Lab:
        """Return the lab to tell of: its last example was asked alone, in another child.

        Where that differs, the answer hangs on what was asked before, and no number of it means
        anything.
        """
        first, second = lab.failure, alone.failure
        assert isinstance(first, NotYet)
        lab.remembers = alone.remembers
        if alone.ended or (
            second is not None and (first.ran, first.got) == (second.ran, second.got)
        ):
            return lab
        if isinstance(second, NotYet):
            second.meaning = REMEMBERS
            return alone
        first.meaning = REMEMBERS
        return lab

    def again(self, key: tuple[str, str], open_child: Opener) -> Lab:
        """Ask a check that failed once more, of children that others open.

        Its observations are those of the program as it is.
        """
        job = self.failed[key]
        with kept_examples(job.function, self.seed):
            lab = self._ask(job, job.function, Way(isolated=True, opener=open_child))
            if lab.connection.pieces:
                alone = self._ask(job, job.function, Way(opener=open_child))
                lab.observations = alone.observations
            return lab

    def are_mended(self, todo: Todo, failed: Collection[str], open_child: Opener) -> bool:
        """Return whether failed checks of a TODO pass in other children, which have little time,
        and those that have passed still do.
        """
        jobs = [
            job
            for job in jobs_of(todo)
            if job.check.id in failed or self.results[job.key].state == "passed"
        ]
        jobs.sort(key=lambda job: (job.check.id not in failed, COST[job.check.kind]))
        return all(self._passes(job, open_child) for job in jobs)

    def _passes(self, job: Job, open_child: Opener) -> bool:
        """Ask first, and alone, what has failed of a check: most changes mend nothing."""
        way = Way(isolated=True, opener=open_child, words=LITTLE_CPU)
        failing = self.failing.get(job.key)
        with kept_examples(job.function, self.seed):
            first = failing is None or self._ask(job, failing.again, way).failure is None
            return first and self._ask(job, job.function, way).failure is None

    def _ask(self, job: Job, example: Example, way: Way) -> Lab:
        """Return a lab in which the check ran."""
        secret = secret_of(self.seed, job.todo, job.check)
        pieces = self._right(job.todo, job.module) if way.isolated else []
        lab = Lab(job.module, lambda: self._child_for(job, way), pieces, secret=secret)
        lab.surveys, lab.connection.watched = way.surveys, way.watched
        little = self.budget.why_little(job.todo.id)
        with lab.opened():
            try:
                example(lab=lab)
                lab.failure = lab.overstepped
            except (NotYet, Broke) as failure:
                lab.failure = failure
                if isinstance(failure, NotYet) and not way.surveys:
                    lab.trespass = name_trespass(lab)
                    failure.got += f"; {lab.trespass}" if lab.trespass else ""
            except Flaky:  # the lab kept the first failure, if it saw one
                lab.failure = lab.failure or Broke(lab.running, "another answer each time")
            except Exception as error:  # an answer that our own arithmetic cannot stand
                name = type(error).__name__
                lab.failure = Broke(lab.running, f"an answer that makes no sense ({name}: {error})")
                lab.unforeseen = True
            lab.remembers = lab.connection.remembered()
        if way.words:
            self.budget.charge_for_words(lab.connection)
        elif not way.right:
            self.budget.charge(job.todo.id, lab.connection)
            if lab.ended and lab.failure is not None:
                lab.failure.got += little
        return lab

    def _child_for(self, job: Job, way: Way) -> Child:
        if way.right and self.open_right is not None:
            return self.open_right(job.check.cpu_seconds)
        open_child = way.opener or self.open_child
        if way.words:
            return for_words(open_child)(way.words)
        child = open_child(self.budget.cpu_for(job.todo.id, job.check.cpu_seconds))
        child.rest_seconds = self.budget.rest_for(job.todo.id)
        return child

    def _todo_of(self, failure: NotYet | Broke) -> str:
        """Return the TODO in whose function an error was raised; empty where that is unknown."""
        raised = failure.raised if isinstance(failure, Broke) else None
        names = [frame.function for frame in reversed(raised.frames)] if raised else []
        by_name = {
            todo.function.rpartition(":")[2].rpartition(".")[2]: todo.id
            for todo in self.rubric.todos
        }
        return next((by_name[name] for name in names if name in by_name), "")

    def replaceable(self) -> frozenset[str]:
        """Return the TODOs that have failed: the whole runs with right versions of them.

        Return none if all that was begun has failed: such a program shows nothing of its own.
        """
        failed = {id for (id, _), result in self.results.items() if result.state != "passed"}
        begun = [todo.id for todo in self.rubric.counted if self.submission.begun.get(todo.id)]
        return frozenset(failed if any(id not in failed for id in begun) else ())

    # ------------------------------------------------------------ code that is no Python

    def _flaw_of(self, job: Job) -> Flaw | None:
        """Return why the code that a check is about cannot run at all."""
        if job.todo.function:
            return self.submission.flaws.get(job.todo.id)
        return self.submission.outside.get(job.module)

    def _refused(self, job: Job, flaw: Flaw) -> CheckResult:
        what = f"This part of TODO {job.todo.id} is" if job.todo.function else "This code is"
        return self._result(
            job,
            "error",
            ran=f"reading {flaw.file}",
            expected="code that Python accepts",
            got=flaw.words,
            meaning=f"{what} no Python, so none of it runs. {flaw.advice} {INSTEAD}",
            where=Where(flaw.file, flaw.line),
        )

    # ------------------------------------------------------------ results

    def _failure(self, job: Job, failure: NotYet | Broke) -> CheckResult:
        where = self.submission.where.get(job.todo.id)
        unread = self.submission.unread[:UNREAD] if job.todo.function and where is None else []
        got = "; ".join([failure.got, *unread])
        if isinstance(failure, NotYet):
            expected, got = readable(failure.expected, got)
            ran, meaning = tidied(failure.ran), failure.meaning
            words = {"ran": ran, "expected": expected, "got": got, "meaning": meaning}
            return self._result(job, "not yet", where=where, **words)
        lines = failure.raised.frames if failure.raised is not None else []
        if lines := [each for each in lines if self.submission.holds(each.file)]:
            last = lines[-1]
            own = [each for each in lines if not self._is_given(job.todo, each)]
            found = LACKING.search(failure.got)
            if found and self.submission.holds(found["file"]):
                where = Where(found["file"], 1)
            elif own or where is None:
                frame = (own or lines)[-1]
                where = Where(frame.file, frame.line)
            got += f" (in {last.file}, line {last.line}: {last.text})"
        words = {"ran": failure.ran, "expected": "an answer", "got": got}
        return self._result(job, "error", where=where, **words)

    def _is_given(self, todo: Todo, frame: CodeLine) -> bool:
        """Return whether a line is as handed out: an error there comes from elsewhere."""
        text = load_given().get(frame.file)
        if text is None or frame.function == todo.function.rpartition(":")[2].rpartition(".")[2]:
            return False
        return frame.text.strip() in map(str.strip, text.splitlines())

    def _result(self, job: Job, state: State, **words: Any) -> CheckResult:
        most, kind = job.check.points, job.check.kind
        points = most if state == "passed" else 0
        return in_bounds(CheckResult(job.check.id, job.title, kind, state, points, most, **words))


def fails_elsewhere(isolated: NotYet | Broke, alone: NotYet | Broke) -> bool:
    """Return whether a check that fails for its own TODO fails in another question before it.

    In the same question it may raise an error that comes before what it fails with isolated.
    """
    if DIGITS.sub("", isolated.ran) != DIGITS.sub("", alone.ran):
        return True
    raised = [each.raised if isinstance(each, Broke) else None for each in (isolated, alone)]
    errors = [(each.error, each.frames[-1:]) if each is not None else None for each in raised]
    return errors[1] is not None and errors[0] != errors[1]


def name_trespass(lab: Lab) -> str:
    """Return what a failed check saw changed that must stay; empty if nothing was."""
    said = lab.overstepped.got if lab.overstepped is not None else ""
    return said if " changed " in said else ""


def last_lines(output: str) -> str:
    """Return the last lines that were printed, on one line; what failed came last."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    lines = [cut(each, MAX_PRINTED) for each in lines if not each.startswith(GIVEN_PRINTS)]
    shown = " | ".join(lines[-MOST_PRINTED:])
    return f"… | {shown}" if len(lines) > MOST_PRINTED else shown


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


# By the property and its seed, all the examples that a submission passed.
passed_before: dict[tuple[Any, int | None], list[Example]] = {}


def each_of(examples: list[Example], lab: Lab) -> None:
    for example in examples:
        example(lab=lab)
