"""Run one check, in a new child each time, and keep the evidence."""

import re
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from hypothesis.errors import Flaky
from msgspec import UNSET, structs

from grader.judge.budget import LITTLE_CPU, Budget, for_words
from grader.judge.drawing import Example, kept_examples
from grader.judge.failures import REMEMBERS, Broke, Failing, NotYet, secret_of
from grader.judge.jobs import Job
from grader.judge.lab import Lab, Observation
from grader.judge.result import CheckResult, in_bounds
from grader.judge.rubric import Todo
from grader.judge.task import Task
from grader.judge.verdict import last_lines, make_result, word_failure
from grader.judge.wall.children import Child
from grader.protocol import Piece

DIGITS = re.compile(r"[-\d.e]+")  # changes tried between two examples of one question
COST = {"unit": 0, "scene": 1, "property": 2}  # kinds of checks, the longest last
SURVEY_CPU = 2  # s of processor time, for a survey
BRIEF = 1.0  # s of processor time: only quicker checks are surveyed

Opener = Callable[[int], Child]  # takes the budget in processor seconds


@dataclass(frozen=True)
class Conditions:
    """The conditions under which a check runs."""

    isolated: bool = False  # whether the reference replaces the other TODOs
    on_reference: bool = False  # whether the reference runs instead of the submission
    surveys: bool = False  # whether the check continues after a failure, to ask everything
    watched: bool = False  # whether the child notes names that keep a value from call to call
    opener: Opener | None = None  # opens children of another tree
    cpu_for_words: int = 0  # s, the own budget of a run that only affects messages


@dataclass
class Outcome:
    """The result of a check, and the evidence on it."""

    job: Job
    result: CheckResult
    failed: bool = False  # set if it failed in its turn and can run again
    observations: list[Observation] = field(default_factory=list)  # answers of the run that counts
    answers: list[Observation] = field(default_factory=list)  # answers of the unchanged program
    fails_in: str | None = None  # the TODO in which it fails first; empty if unknown
    lab: Lab | None = None  # of the failed run
    failing: Failing | None = None  # to run it once more for a replay


@dataclass
class Runner:
    """Runs checks of one submission in the children of one worker, and charges its budget."""

    grading: Task
    open_child: Opener
    budget: Budget
    replaceable: frozenset[str] = frozenset()  # TODOs that have right versions in the whole

    def run(self, job: Job) -> Outcome:
        """Run a check with the reference's code in the other TODOs, then the unchanged program.

        The words about a failure come from the unchanged program: a submission could read the
        reference that it was sent, and reveal it in its answers. A check that ran out of time does
        not run again.
        """
        lab, example = self._attempt(job, Conditions(isolated=True))
        alone = lab
        if lab.failure is not None and lab.connection.pieces and not lab.late:
            alone, example = self._attempt(job, Conditions())
        failure, pieces = alone.failure, alone.connection.pieces
        if failure is None:
            passed = make_result(job, "passed", meaning=" ".join(alone.notes))
            answers = self._survey(job, alone)
            return Outcome(job, passed, observations=alone.observations, answers=answers)
        outcome = Outcome(job, word_failure(self.grading.submission, job, failure), lab=alone)
        outcome.observations = lab.observations
        if lab.failure is not None and fails_elsewhere(lab.failure, failure):
            outcome.fails_in = self._todo_of(failure)
        if not pieces:
            outcome.answers = self._survey(job, alone)
        if not alone.ended:
            secret = secret_of(self.grading.options.seed, job.todo, job.check)
            outcome.failing = Failing(job.todo, job.check, example, pieces, secret)
        result = outcome.result
        shows_output = self.grading.options.trusted and not alone.played
        if shows_output and not result.got.startswith("BdbQuit"):
            result = structs.replace(result, printed=last_lines(alone.connection.output) or UNSET)
        outcome.result = in_bounds(result)
        return outcome

    def _survey(self, job: Job, lab: Lab) -> list[Observation]:
        """Return the answers to all questions of a failed check, to separate right from wrong ones.

        Properties ask too much, and programs take too long, so these are not surveyed.
        """
        wanted = isinstance(lab.failure, NotYet) or self.grading.surveys_all
        brief = lab.connection.cpu < BRIEF and not lab.played and self.budget.has_more
        is_property = job.check.kind == "property"
        if not wanted or not brief or not lab.observations or is_property:
            return lab.observations
        how = Conditions(surveys=True, watched=True, cpu_for_words=SURVEY_CPU)
        survey = self._ask(job, job.function, how)
        lab.remembers = survey.remembers
        return survey.observations

    def find_wrong_check(self, job: Job, lab: Lab) -> str:
        """Describe how the reference fails a check too; empty if not.

        The reference runs only if the check may be wrong: after an unexpected error, or if the
        submission has the reference's code.
        """
        grading = self.grading
        likely = lab.unforeseen or grading.reference.is_that_of(grading.submission, job.todo)
        cut = lab.ended and not lab.unforeseen  # out of time or memory: that may be the machine
        if grading.options.reference is None or cut or not likely:
            return ""
        with kept_examples(job.function, grading.options.seed):
            right = self._ask(job, job.function, Conditions(on_reference=True))
        failure = right.failure
        if failure is None or (right.ended and not right.unforeseen):
            return ""
        expected = f"; expected: {failure.expected}" if isinstance(failure, NotYet) else ""
        return (
            f"the check {job.check.id} in checks/{job.todo.folder} is wrong: the right code fails "
            f"it too. It ran: {failure.ran}{expected}; got: {failure.got}"
        )

    # ------------------------------------------------------------ properties

    def _attempt(self, job: Job, how: Conditions) -> tuple[Lab, Example]:
        """Run a check; return its lab, and the example that ran last.

        A property draws the same examples for every submission, so examples that another submission
        passed run first. Only if one fails, hypothesis searches for the simplest.
        """
        seed = self.grading.options.seed
        known = passed_before.get((job.function, seed))
        if known is not None:
            every = partial(run_each, known)
            lab = self._ask(job, every, how)
            if lab.failure is None or lab.ended:
                return lab, every
        with kept_examples(job.function, seed) as examples:
            lab = self._ask(job, job.function, how)
        if not examples:
            return lab, job.function
        if lab.failure is None:
            passed_before[job.function, seed] = examples
        elif isinstance(lab.failure, NotYet) and lab.failure is not lab.overstepped:
            lab = choose_lab(lab, self._ask(job, examples[-1], replace(how, watched=True)))
        return lab, examples[-1]

    # ------------------------------------------------------------ once more

    def run_again(self, job: Job, opener: Opener) -> Lab:
        """Run a check in other children; its lab has the unchanged program's answers."""
        with kept_examples(job.function, self.grading.options.seed):
            lab = self._ask(job, job.function, Conditions(isolated=True, opener=opener))
            if lab.connection.pieces:
                alone = self._ask(job, job.function, Conditions(opener=opener))
                lab.observations = alone.observations
            return lab

    def do_pass(self, outcomes: Iterable[Outcome], failed: Collection[str], opener: Opener) -> bool:
        """Return whether checks of a TODO pass in other children, within little time.

        The checks in `failed`, by id, must pass, and those that passed before.
        """
        chosen = [
            each
            for each in outcomes
            if each.job.check.id in failed or each.result.state == "passed"
        ]
        chosen.sort(key=lambda o: (o.job.check.id not in failed, COST[o.job.check.kind]))
        return all(self._passes(each, opener) for each in chosen)

    def _passes(self, outcome: Outcome, opener: Opener) -> bool:
        """Return whether a check passes; first run only the example that failed."""
        how = Conditions(isolated=True, opener=opener, cpu_for_words=LITTLE_CPU)
        job, failing = outcome.job, outcome.failing
        with kept_examples(job.function, self.grading.options.seed):
            first = failing is None or self._ask(job, failing.again, how).failure is None
            return first and self._ask(job, job.function, how).failure is None

    # ------------------------------------------------------------ one run

    def _ask(self, job: Job, example: Example, how: Conditions) -> Lab:
        """Run a check; return its lab."""
        secret = secret_of(self.grading.options.seed, job.todo, job.check)
        pieces = self.find_pieces(job.todo, job.module) if how.isolated else []
        lab = Lab(job.module, lambda: self._open_child(job, how), pieces, secret=secret)
        lab.surveys, lab.connection.watched = how.surveys, how.watched
        little = self.budget.why_little(job.todo.id)
        with lab.opened():
            try:
                with lab.settled():
                    example(lab=lab)
                lab.failure = lab.overstepped
            except (NotYet, Broke) as failure:
                lab.failure = failure
                if isinstance(failure, NotYet) and not how.surveys:
                    lab.trespass = name_trespass(lab)
                    failure.got += f"; {lab.trespass}" if lab.trespass else ""
            except Flaky:  # the lab kept the first failure, if it saw one
                lab.failure = lab.failure or Broke(lab.running, "a different answer each time")
            except Exception as error:  # an answer that our own arithmetic cannot process
                name = type(error).__name__
                lab.failure = Broke(lab.running, f"an answer that makes no sense ({name}: {error})")
                lab.unforeseen = True
            lab.remembers = lab.connection.remembered()
        if how.cpu_for_words:
            self.budget.charge_for_words(lab.connection)
        elif not how.on_reference:
            self.budget.charge(job.todo.id, lab.connection)
            if lab.ended and lab.failure is not None:
                lab.failure.got += little
        return lab

    def _open_child(self, job: Job, how: Conditions) -> Child:
        if how.on_reference:
            return self.grading.open_right(job.check.cpu_seconds)
        open_child = how.opener or self.open_child
        if how.cpu_for_words:
            return for_words(open_child)(how.cpu_for_words)
        child = open_child(self.budget.cpu_for(job.todo.id, job.check.cpu_seconds))
        child.rest_seconds = self.budget.rest_for(job.todo.id)
        return child

    def find_pieces(self, todo: Todo, module: str, differing: bool = True) -> list[Piece]:
        """Return the right versions of other TODOs; see Reference.for_the_others."""
        grading, failed = self.grading, self.replaceable
        return grading.reference.for_the_others(
            todo, module, grading.rubric, grading.submission, failed, differing
        )

    def _todo_of(self, failure: NotYet | Broke) -> str:
        """Return the TODO whose function raised an error; empty if unknown."""
        raised = failure.raised if isinstance(failure, Broke) else None
        names = [frame.function for frame in reversed(raised.frames)] if raised else []
        by_name = {todo.function_name: todo.id for todo in self.grading.rubric.todos}
        return next((by_name[name] for name in names if name in by_name), "")


def choose_lab(first: Lab, alone: Lab) -> Lab:
    """Run the last example alone in another child; return the lab to report.

    If the two differ, the answer depends on earlier questions, and its numbers mean nothing.
    """
    before, after = first.failure, alone.failure
    assert isinstance(before, NotYet)
    first.remembers = alone.remembers
    same = after is not None and (before.ran, before.got) == (after.ran, after.got)
    if alone.ended or same:
        return first
    if isinstance(after, NotYet):
        after.meaning = REMEMBERS
        return alone
    before.meaning = REMEMBERS
    return first


def fails_elsewhere(isolated: NotYet | Broke, alone: NotYet | Broke) -> bool:
    """Return whether the program fails at an earlier question than the isolated TODO.

    At the same question, an error from another function may come first.
    """
    if DIGITS.sub("", isolated.ran) != DIGITS.sub("", alone.ran):
        return True
    raised = [each.raised if isinstance(each, Broke) else None for each in (isolated, alone)]
    errors = [(each.error, each.frames[-1:]) if each is not None else None for each in raised]
    return errors[1] is not None and errors[0] != errors[1]


def name_trespass(lab: Lab) -> str:
    """Return the forbidden change that a failed check saw; empty if it saw none."""
    words = lab.overstepped.got if lab.overstepped is not None else ""
    return words if " changed " in words else ""


# All the examples that a submission passed, by property and seed.
passed_before: dict[tuple[Any, int | None], list[Example]] = {}


def run_each(examples: list[Example], lab: Lab) -> None:
    for example in examples:
        example(lab=lab)
