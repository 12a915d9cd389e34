"""Grading a class, several submissions at a time.

Results are written as they come, and what stands from an earlier run is not graded again.
"""

import hashlib
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from pathlib import Path

import msgspec
from rich.console import Console

from grader.classroom.adjustments import Adjustments, load_adjustments
from grader.classroom.book import NOTHING, Book, Outcome, outcome_of
from grader.classroom.executor import LOST, Executor, ExecutorFailed, Graded
from grader.classroom.similarity import Prints, prints_of
from grader.intake.found import CannotTake, Found, Intake, Package
from grader.intake.names import in_short
from grader.intake.packing import pack
from grader.judge.course import FULL, Course
from grader.judge.result import Result
from grader.judge.submission import CannotGrade
from grader.report.files import as_json
from grader.report.progress import Counter


@dataclass
class Task:
    """A piece of work that must be graded, and whose it is."""

    members: list[Found]
    package: Package
    key: str


@dataclass
class Run:
    """One class, and what has become of it so far."""

    intake: Intake
    book: Book
    key: str
    adjustments: Adjustments
    course: Course = FULL
    outcomes: list[Outcome] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=lambda: {"graded": 0, "kept": 0, "trouble": 0})
    same: dict[str, dict[tuple[str, ...], str]] = field(default_factory=dict)  # names, by files
    prints: list[Prints] = field(default_factory=list)  # of whom there is something to compare
    said: dict[str, list[str]] = field(default_factory=dict)  # by name: what taking in had to say

    def tasks(self) -> Iterator[Task]:
        """The work that must be graded, each once; all else is recorded on the way."""
        works: dict[tuple[Path, ...], list[Found]] = {}
        for found in self.intake.found:
            works.setdefault(found.sources, []).append(found)
        for members in works.values():
            first = members[0]
            try:
                package = pack(first, self.course.modules)
                digest, prints = package.digest, prints_of(package, first.whose)
            except Exception as error:  # this one submission; the others go on
                words = str(error) if isinstance(error, CannotTake) else in_words(error)
                for found in members:
                    self.trouble(found, words)
                continue
            self.same.setdefault(digest, {})[first.whose] = first.name
            self.notes += [f"{first.name}: {each}" for each in package.notes]
            self.prints.append(prints)
            key = hashlib.sha256(f"{self.key} {digest}".encode()).hexdigest()
            if new := list(self.not_kept(members, package, key)):
                yield Task(new, msgspec.structs.replace(package, name=new[0].name), key)

    def not_kept(self, members: list[Found], package: Package, key: str) -> Iterator[Found]:
        """Those of one piece of work of whom no result is kept; the others are recorded."""
        for found in members:
            self.said[found.name] = package.notes
            kept = self.book.kept(found.name, key)
            if kept is None:
                yield found
            else:
                self.record("kept", found, kept)

    def graded(self, task: Task, graded: Graded) -> None:
        """Each of a group has a result, with a name of their own in it."""
        result = msgspec.json.decode(graded[0], type=Result)
        for found in task.members:
            own = as_json(msgspec.structs.replace(result, submission=found.name))
            outcome = outcome_of(found.name, own, graded[1], task.key)
            self.book.write(outcome, own)
            self.record("graded", found, outcome)

    def trouble(self, found: Found, words: str) -> None:
        self.book.forget(found.name)
        self.record("trouble", found, Outcome(found.name, words))

    def record(self, how: str, found: Found, outcome: Outcome) -> None:
        outcome = msgspec.structs.replace(outcome, bonus_by_hand=self.adjustments.bonus(found))
        added = 0 if outcome.trouble else self.course.added(outcome.bonus)
        earned = None if outcome.trouble else outcome.points + added
        final = self.adjustments.final(found, earned)
        counted = [f"bonus: +{added}"] if added and not final.by_hand else []
        outcome = msgspec.structs.replace(
            outcome,
            final=final.points or 0,
            by_hand=final.by_hand,
            reasons=[*counted, *final.reasons],
            notes=[*self.said.get(found.name, []), *outcome.broken],
            late=bool(self.adjustments.days_late(found)),
            due=final.due,
            handed_in=self.adjustments.aware(found.handed_in) if found.handed_in else None,
            group=list(found.group),
            handed_in_by=found.handed_in_by,
        )
        self.counts[how] = self.counts.get(how, 0) + 1
        self.outcomes.append(outcome)

    def nothing_handed_in(self, names: Iterable[str]) -> None:
        """Whose points are set by hand has a mark, whatever they handed in."""
        for name in names:
            found = Found(name, ())
            if self.adjustments.final(found, None).by_hand:
                self.record("by hand", found, Outcome(name, NOTHING))

    def comparable(self, outcomes: list[Outcome]) -> list[Outcome]:
        """Marks that a person gave are out of as many points as the others'."""
        most = max((each.max_points for each in outcomes), default=0)
        most = most or self.course.rubric.max_points
        return [
            msgspec.structs.replace(each, max_points=most) if each.by_hand else each
            for each in outcomes
        ]

    def copies(self) -> Iterator[str]:
        """Those who handed in the same files apart, unless these are worth nothing."""
        worth = {each.name: each.points for each in self.outcomes}
        for names in [list(each.values()) for each in self.same.values()]:
            if len(names) > 1 and worth[names[0]]:
                yield f"the same files were handed in by {in_short(names)}"


def grade_class(
    intake: Intake,
    out: Path,
    key: str,
    executor: Executor,
    console: Console,
    adjustments: Adjustments | None = None,
    course: Course = FULL,
    absent: Iterable[str] = (),
) -> Run:
    """Grade what is new in a class; results, book and table are in and beside the folder `out`.

    `absent` are those who might have handed in and did not; points set by hand are theirs too.
    """
    total = len(intake.found) + len(intake.troubles)
    with Book(out) as book, Counter("grading", total, console) as counter:
        decided = adjustments or load_adjustments(None, course)
        run = Run(intake, book, key, decided, course, notes=list(intake.notes))
        for name, words in intake.troubles.items():
            run.trouble(Found(name, ()), words)
        for task, graded in grade_all(run.tasks(), executor):
            if isinstance(graded, str):
                for found in task.members:
                    run.trouble(found, graded)
            else:
                run.graded(task, graded)
            counts = ", ".join(f"{count} {how}" for how, count in run.counts.items() if count)
            counter.reached(len(run.outcomes), counts)
        run.nothing_handed_in(absent)
        run.outcomes = run.comparable(sorted(run.outcomes, key=lambda each: each.name))
        book.close_with(run.outcomes, course)
    run.notes += run.copies()
    names = [each.name for each in run.outcomes]
    for student in run.adjustments.unused(names):
        run.notes.append(f"adjusted, but nothing was handed in: {student}")
    if others := book.others_than(names):
        run.notes.append(f"{out} also holds results of others than this class: {in_short(others)}")
    return run


def grade_all(tasks: Iterator[Task], executor: Executor) -> Iterator[tuple[Task, Graded | str]]:
    """Each task with its result or its trouble, in the order in which they end."""
    under_way: dict[Future[Graded], Task] = {}
    for task in tasks:
        under_way[executor.submit(task.package)] = task
        if len(under_way) >= executor.capacity():
            yield from finished(under_way, executor)
    while under_way:
        yield from finished(under_way, executor)


def finished(
    under_way: "dict[Future[Graded], Task]", executor: Executor
) -> Iterator[tuple[Task, Graded | str]]:
    """Those that have ended by now, one at least."""
    done, _ = wait(under_way, return_when=FIRST_COMPLETED)
    if any(future.cancelled() for future in done):
        raise CannotGrade(LOST)
    broken = any(isinstance(future.exception(), BrokenProcessPool) for future in done)
    if broken:
        done, _ = wait(under_way)  # at once: the pool has given all of them up
        executor.restart()
    for future in done:
        task = under_way.pop(future)
        graded: Graded | str
        try:
            again = isinstance(future.exception(), BrokenProcessPool)
            graded = executor.run_alone(task.package) if again else future.result()
        except BrokenProcessPool:
            graded = "it ended the grader's own process, twice: please report it"
        except ExecutorFailed as error:
            raise CannotGrade(str(error)) from error
        except Exception as error:  # this one submission; the others go on
            graded = in_words(error)
        yield task, graded


def in_words(error: Exception) -> str:
    return f"{type(error).__name__}: {error}"
