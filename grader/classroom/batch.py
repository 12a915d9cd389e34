"""Grade a class, several submissions at a time.

Each result is written at once. A later run grades only what has changed.
"""

import hashlib
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass, field
from functools import partial

import msgspec
from rich.console import Console

from grader.classroom.adjustments import Adjustments
from grader.classroom.book import NOTHING, Book, Outcome, make_outcome
from grader.classroom.executor import LOST, Answer, Executor, ExecutorFailed
from grader.classroom.similarity import Prints, make_prints
from grader.errors import Stop, say_error
from grader.intake.found import CannotTake, Intake, Package, Work
from grader.intake.names import make_portable
from grader.intake.packing import pack
from grader.intake.roster import ClassList
from grader.judge.course import FULL, Course
from grader.judge.result import Result
from grader.judge.submission import attempt
from grader.judge.wall.outer import Exceeded, Failed
from grader.report.files import as_json
from grader.report.html import Remark
from grader.report.progress import Counter

NONE = Adjustments()
COUNTED = ("graded", "kept", "not graded")  # what a run says of its submissions


@dataclass
class Task:
    members: list[Work]
    package: Package
    key: str


@dataclass
class Run:
    """A class and its results so far."""

    intake: Intake
    book: Book
    key: str
    adjustments: Adjustments = NONE
    course: Course = FULL
    people: ClassList = field(default_factory=ClassList)
    outcomes: list[Outcome] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=lambda: dict.fromkeys(COUNTED, 0))
    same: dict[str, dict[tuple[str, ...], str]] = field(default_factory=dict)  # names, by files
    prints: list[Prints] = field(default_factory=list)  # to compare
    package_notes: dict[str, list[str]] = field(default_factory=dict)  # by name
    remarks: dict[str, list[Remark]] = field(default_factory=dict)  # by name

    def list_tasks(self) -> Iterator[Task]:
        """Yield each submission to grade once; record the others."""
        works: dict[tuple[object, ...], list[Work]] = {}
        for found in self.intake.found:
            works.setdefault((found.sources, found.taken), []).append(found)
        for members in works.values():
            first = members[0]
            try:
                package = pack(first, self.course.modules)
                files = dict(package.files)
                remarks = {e.name: self.adjustments.place_comments(e, files) for e in members}
            except Exception as error:  # this one submission; the others go on
                for found in members:
                    self.record_trouble(found, describe_error(error))
                continue
            self.remarks |= remarks
            digest = package.digest
            self.same.setdefault(digest, {})[first.team] = first.name
            self.notes += [f"{first.name}: {each}" for each in package.notes]
            key = hashlib.sha256(f"{self.key} {digest}".encode()).hexdigest()
            if new := list(self.skip_kept(members, package, key)):
                yield Task(new, msgspec.structs.replace(package, name=new[0].name), key)
            # While it is graded: the first one takes 0.2 s, to read the solution.
            nothing = Prints(package.name, frozenset(), first.team)
            self.prints.append(attempt(partial(make_prints, package, first.team), nothing))

    def skip_kept(self, members: list[Work], package: Package, key: str) -> Iterator[Work]:
        """Yield students to grade; record those with a valid old result."""
        for found in members:
            self.package_notes[found.name] = package.notes
            kept = self.book.find_kept(found.name, key)
            if kept is None:
                yield found
            else:
                self.record("kept", found, kept)

    def record_result(self, task: Task, graded: Answer) -> None:
        """Write a result for each student of a group, with their own name."""
        result = msgspec.json.decode(graded[0], type=Result)
        for found in task.members:
            own = as_json(msgspec.structs.replace(result, submission=found.name))
            outcome = make_outcome(found.name, own, graded[1], task.key)
            outcome = self.decide(found, self.book.compare(outcome, own))
            self.book.write(outcome, own)
            self.count("graded", outcome)

    def record_trouble(self, found: Work, words: str) -> None:
        self.book.keep_earlier(found.name)
        self.record("not graded", found, Outcome(found.name, words))

    def record(self, how: str, found: Work, outcome: Outcome) -> None:
        """Apply the rules and decisions to an outcome, and count it."""
        self.count(how, self.decide(found, outcome))

    def count(self, how: str, outcome: Outcome) -> None:
        self.counts[how] = self.counts.get(how, 0) + 1
        self.outcomes.append(outcome)

    def decide(self, found: Work, outcome: Outcome) -> Outcome:
        """Return an outcome after bonus, lateness and decisions, with any earlier mark."""
        decisions = self.adjustments
        bonus = sum(each.bonus or 0 for each in decisions.find_decisions(found))
        outcome = msgspec.structs.replace(outcome, bonus_by_hand=bonus)
        added = 0 if outcome.trouble else self.course.count_bonus(outcome.bonus, outcome.points)
        final = decisions.decide(found, None if outcome.trouble else outcome.points + added)
        counted = [f"bonus: +{added}"] if added and not final.by_hand else []
        outcome = msgspec.structs.replace(
            outcome,
            final=final.points or 0,
            by_hand=final.by_hand,
            reasons=[*counted, *final.reasons],
            notes=[*self.package_notes.get(found.name, []), *outcome.broken],
            late=bool(decisions.count_days_late(found)),
            due=final.due,
            handed_in=decisions.add_zone(found.handed_in) if found.handed_in else None,
            group=list(found.group),
            remarks=self.remarks.get(found.name) or decisions.place_comments(found, {}),
            full_name=self.people.full_names.get(make_portable(found.name), ""),
            handed_in_by=found.handed_in_by,
        )
        return self.book.compare_marks(outcome)

    def record_absent(self, names: Iterable[str]) -> None:
        """Record students who handed in nothing, if a person set their points."""
        for name in names:
            found = Work(name, ())
            if self.adjustments.decide(found, None).by_hand:
                self.record("by hand", found, Outcome(name, NOTHING))

    def scale_by_hand(self, outcomes: list[Outcome]) -> list[Outcome]:
        """Return the outcomes; marks set by a person get the highest maximum."""
        most = max((each.max_points for each in outcomes), default=0)
        most = most or self.course.rubric.max_points
        return [
            msgspec.structs.replace(each, max_points=most) if each.by_hand else each
            for each in outcomes
        ]

    @property
    def changed(self) -> list[Outcome]:
        """Return the outcomes whose mark differs from the previous run's."""
        old = self.book.outcomes
        return [
            each
            for each in self.outcomes
            if each.name in old and not each.has_mark_of(old[each.name])
        ]

    def find_copies(self) -> Iterator[str]:
        """Yield notes on students who handed in the same files, if those files earn points."""
        worth = {each.name: each.points for each in self.outcomes}
        for names in [list(each.values()) for each in self.same.values()]:
            if len(names) > 1 and worth[names[0]]:
                yield f"the same files were handed in by {', '.join(names)}"


def grade_class(run: Run, executor: Executor, console: Console, absent: Iterable[str] = ()) -> Run:
    """Grade what has changed in a class; write results, book and table at the book's folder.

    `absent` are students who handed in nothing; a person may have set points for them too.
    """
    total = len(run.intake.names)
    with run.book as book, Counter("grading", total, console) as counter:
        run.notes += run.intake.notes
        for name, words in run.intake.troubles.items():
            run.record_trouble(Work(name, ()), words)
        for task, graded in grade_tasks(run.list_tasks(), executor):
            if isinstance(graded, str):
                for found in task.members:
                    run.record_trouble(found, graded)
            else:
                run.record_result(task, graded)
            counts = ", ".join(f"{count} {how}" for how, count in run.counts.items() if count)
            counter.reached(len(run.outcomes), counts)
        run.record_absent(absent)
        run.outcomes = run.scale_by_hand(sorted(run.outcomes, key=lambda each: each.order))
        book.finish(run.outcomes, run.course)
    run.notes += run.find_copies()
    changed = [f"{each.label} ({each.before} → {each.mark_in_words})" for each in run.changed]
    if changed:
        run.notes.append(f"other marks than in the run before: {', '.join(changed)}")
    names = [each.name for each in run.outcomes]
    for student in run.adjustments.find_unused(names):
        run.notes.append(f"adjusted, but nothing was handed in: {student}")
    if others := sorted({path.stem for path in book.folder.glob("[!.]*.json")} - set(names)):
        words = f"also holds results of others than this class: {', '.join(others)}"
        run.notes.append(f"{book.folder} {words}")
    return run


def grade_tasks(tasks: Iterator[Task], executor: Executor) -> Iterator[tuple[Task, Answer | str]]:
    """Yield each finished task, with its result or the reason for none."""
    under_way: dict[Future[Answer], Task] = {}
    for task in tasks:
        under_way[executor.submit(task.package)] = task
        if len(under_way) >= executor.capacity():
            yield from collect_results(under_way)
    while under_way:
        yield from collect_results(under_way)


def collect_results(
    under_way: "dict[Future[Answer], Task]",
) -> Iterator[tuple[Task, Answer | str]]:
    """Wait for a task to end, and yield all that have ended."""
    done, _ = wait(under_way, return_when=FIRST_COMPLETED)
    if any(future.cancelled() for future in done):
        raise Stop(LOST)
    for future in done:
        yield under_way.pop(future), read_future(future)


def read_future(future: Future[Answer]) -> Answer | str:
    """Return a result, or the reason why there is none."""
    try:
        return future.result()
    except ExecutorFailed:
        raise
    except Exception as error:  # this one submission; the others go on
        return describe_error(error)


def describe_error(error: Exception) -> str:
    """Describe an error; omit the type of our own ones."""
    if isinstance(error, CannotTake | Exceeded | Failed):
        return str(error)
    return f"{type(error).__name__}: {say_error(error)}"
