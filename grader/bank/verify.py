"""The grader is graded: the trees, the rubric and every member of the bank.

A member that got the marks it must is not graded again until something changes that decides about
them, so a run that was stopped goes on where it was.
"""

import os
import tempfile
import time
from collections import Counter as Count
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field
from functools import cache
from multiprocessing import active_children, get_context
from pathlib import Path
from typing import TypeVar

from rich.console import Console
from rich.table import Table

from grader.bank.halfway import Halfway, graded, halfway
from grader.bank.kept import Kept
from grader.bank.ladders import Ladder, ladders
from grader.bank.members import Entry, Member, members
from grader.bank.sync import sync
from grader.bank.traces import watched
from grader.judge.children import WarmWorker, Worker, start_worker
from grader.judge.course import FULL, Course
from grader.judge.grade import KIT, Options, grade, shipped_reference
from grader.judge.processes import begin_process
from grader.judge.result import Result
from grader.judge.rubric import load_rubric
from grader.report.progress import Counter

One = TypeVar("One")
Found = TypeVar("Found")

KEPT = KIT / "build" / "verify"


@dataclass
class Verdict:
    """A member of the bank, and what came of grading it."""

    member: Member
    result: Result | None
    seconds: float
    complaint: str
    earlier: bool = False  # graded by an earlier run


@dataclass
class Told:
    """A student half way, and what the first failure says that it must not, or does not say."""

    state: Halfway
    complaint: str


ENOUGH = 0.95  # of the states half way, whose first failure must say what is wrong


@dataclass
class Report:
    verdicts: list[Verdict] = field(default_factory=list)
    told: list[Told] = field(default_factory=list)
    complaints: list[str] = field(default_factory=list)  # about the kit itself

    @property
    def ladders(self) -> list[Ladder]:
        return ladders((each.member, each.result) for each in self.verdicts)

    @property
    def sound(self) -> bool:
        of_members = [each.complaint for each in self.verdicts]
        found = [*self.complaints, *of_members, *(each.complaint for each in self.ladders)]
        return not any([*found, self.untold])

    @property
    def untold(self) -> str:
        """What is wrong with what students half way are told; empty where nothing is."""
        wrong = [each for each in self.told if each.complaint.startswith("says ")]
        right = sum(not each.complaint for each in self.told)
        if wrong:
            return f"{len(wrong)} students half way are told what is wrong"
        if right < ENOUGH * len(self.told):
            return f"only {right} of {len(self.told)} students half way are told what they need"
        return ""


def verify(
    jobs: int, only: str, console: Console, fresh: bool = False, course: Course = FULL
) -> Report:
    """Grade what a course has of the bank, as far as its names contain `only`; prints a table.

    What an earlier run found sound still is, unless all is to be graded `fresh`. Points are those
    of the rubric: a course may give a check none, and still it must tell right from wrong.
    """
    course = course.as_rated
    report = Report(complaints=list(kit_complaints()))
    chosen = [
        each
        for each in [*trees(course), *members(KIT, course)]
        if only in f"{each.kind}/{each.name}"
    ]
    with Counter("grading the bank", len(chosen), console) as counter:
        for verdict in verdicts(chosen, jobs, Kept(KEPT), fresh):
            report.verdicts.append(verdict)
            counter.reached(len(report.verdicts))
            if verdict.complaint:
                console.print(f"{verdict.member.name}: {verdict.complaint}")
    asked = {todo.id for todo in course.rubric.todos}
    states = [each for each in halfway() if each.todo in asked and only in f"halfway/{each.name}"]
    with Counter("asking for students half way", len(states), console) as counter:
        for told in ask_all(states, jobs):
            report.told.append(told)
            counter.reached(len(report.told))
            if told.complaint:
                console.print(f"{told.state.name}: {told.complaint}")
    order = {(m.kind, m.name, m.form): number for number, m in enumerate(chosen)}
    report.verdicts.sort(key=lambda v: order[v.member.kind, v.member.name, v.member.form])
    show(report, console)
    return report


def verdicts(chosen: list[Member], jobs: int, kept: Kept, fresh: bool) -> Iterator[Verdict]:
    """On each member, those of an earlier run first; only sound ones are kept for the next run."""
    anew = []
    for member in chosen:
        kept.key(member)  # before anything is graded
        found = None if fresh else kept.read(member)
        if found is None or complaint_of(member, *found):
            anew.append(member)
        else:
            yield Verdict(member, *found, "", earlier=True)
    for verdict in grade_all(anew, jobs):
        if verdict.result is not None and not verdict.complaint:
            kept.write(verdict.member, verdict.result, verdict.seconds)
        yield verdict


def trees(course: Course = FULL) -> list[Member]:
    """The shipped trees themselves: everything, and nothing."""
    nothing = Entry(base="starter", points=0)
    return [
        Member("right", "solution", "package", Entry(), None, course),
        Member("hostile", "starter", "package", nothing, None, course),
    ]


def kit_complaints() -> Iterator[str]:
    """What is wrong with the kit before anything is graded."""
    yield from sync(KIT / "solution", KIT / "starter", write=False)
    points = load_rubric().max_points
    if points != 100:
        yield f"the rubric adds up to {points} points instead of 100"


def grade_all(chosen: Iterable[Member], jobs: int) -> Iterator[Verdict]:
    yield from each_of(grade_member, chosen, jobs)


def ask_all(states: Iterable[Halfway], jobs: int) -> Iterator[Told]:
    yield from each_of(graded_halfway, states, jobs)


def each_of(function: Callable[[One], Found], chosen: Iterable[One], jobs: int) -> Iterator[Found]:
    """What a function makes of each, in processes of their own, in the order in which they end."""
    todo = list(chosen)
    if not todo:
        return
    context = get_context("spawn")
    with ProcessPoolExecutor(jobs or os.cpu_count(), context, begin_process) as pool:
        futures = [pool.submit(function, each) for each in todo]
        try:
            for future in as_completed(futures):
                yield future.result()
        except BaseException:  # somebody is tired of waiting
            pool.shutdown(wait=False, cancel_futures=True)
            for process in active_children():
                process.kill()
            raise


def grade_member(member: Member, only: frozenset[str] = frozenset()) -> Verdict:
    """Grade it on all of its course that may judge it, or on the TODOs in `only`."""
    with tempfile.TemporaryDirectory(prefix="bank-") as folder:
        submission = Path(folder).resolve() / member.name
        member.build(KIT, submission)
        todos, worker = only or member.judged_by, shared_worker()
        options = Options(shipped_reference(), only=todos, trusted=True, course=member.course)
        start = time.monotonic()
        try:
            name = member.name if member.source else ""  # a tree leaves nothing on purpose
            with watched(Path(folder, "temporary"), name) as traces:
                # One without fork keeps processes ahead, as if left behind: not to be shared.
                shared = worker if isinstance(worker, WarmWorker) else None
                result = grade(submission, options, shared)
        except Exception as error:  # a judge that falls over is the worst verdict of all
            text = f"the judge fell over: {type(error).__name__}: {error}"
            return Verdict(member, None, time.monotonic() - start, text)
        seconds = time.monotonic() - start
        complaint = complaint_of(member, result, seconds) or traces.complaint
        return Verdict(member, result, seconds, complaint)


def graded_halfway(state: Halfway) -> Told:
    """What the first failure says of a state; like `grade_member`, with a worker of the process."""
    worker = shared_worker()
    shared = worker if isinstance(worker, WarmWorker) else None
    with tempfile.TemporaryDirectory(prefix="bank-") as folder:
        return Told(state, state.complaint(graded(state, Path(folder).resolve(), shared)))


def complaint_of(member: Member, result: Result, seconds: float) -> str:
    """What is wrong with its marks, or with the name that its mistake was given."""
    if complaint := member.complaint(result, seconds):
        return complaint
    if member.kind == "wrong" and member.misnamed(result) == "wrong":
        names = sorted({todo.misconception for todo in result.todos if todo.misconception})
        return f"its mistake is named {', '.join(names)}"
    return ""


@cache
def shared_worker() -> Worker:
    """One for all members that this process grades; it ends when this process does."""
    worker = start_worker()
    if isinstance(worker, WarmWorker):
        worker.wait_until_loaded()  # its own processes are none that a grade leaves behind
    return worker


def show(report: Report, console: Console) -> None:
    table = Table("member", "form", "points", "lost in", "named", "s", "verdict")
    for each in report.verdicts:
        if not is_rung(each) or each.complaint:
            table.add_row(*row(each))
    for ladder in report.ladders:
        points = " ".join(map(str, ladder.points.values()))
        verdict = ladder.complaint or "as it must"
        table.add_row(f"ladder/{ladder.name}", "package", points, "", "", "", verdict)
    console.print(table)
    for line in summary(report.verdicts):
        console.print(line)
    right = sum(not each.complaint for each in report.told)
    if report.told:
        console.print(f"students half way: {len(report.told)}, told what is wrong: {right}")
    if report.untold:
        console.print(f"students half way: {report.untold}")
    for complaint in report.complaints:
        console.print(f"the kit: {complaint}")


def is_rung(verdict: Verdict) -> bool:
    return verdict.member.kind == "ladder" and verdict.member.is_patch


def summary(verdicts: list[Verdict]) -> Iterator[str]:
    """How many of each kind there were, how many are as they must, and what was not graded now.

    A ladder counts as one, whatever the number of its rungs.
    """
    single = [(each.member.kind, each.complaint) for each in verdicts if not is_rung(each)]
    rungs = [each for each in verdicts if is_rung(each)]
    single += [("ladder", each.complaint) for each in rungs if each.result is None]
    single += [("ladder", each.complaint) for each in ladders((r.member, r.result) for r in rungs)]
    all_of = Count(kind for kind, _ in single)
    bad = Count(kind for kind, complaint in single if complaint)
    for kind, count in all_of.items():
        yield f"{kind}: {count}, of which {bad[kind]} with a complaint"
    named = Count(
        each.member.misnamed(each.result)
        for each in verdicts
        if each.member.kind == "wrong" and each.result is not None
    )
    yield (
        f"mistakes named rightly: {named['right']}, not named: {named['none']}, "
        f"named wrongly: {named['wrong']}"
    )
    earlier = sum(each.earlier for each in verdicts)
    now = len(verdicts) - earlier
    yield f"{len(verdicts)} members: {now} graded now, {earlier} taken from an earlier run"


def row(verdict: Verdict) -> list[str]:
    member, result = verdict.member, verdict.result
    if result is None:
        return [f"{member.kind}/{member.name}", member.form, "", "", "", "", verdict.complaint]
    lost = [f"{t.id} (-{t.max_points - t.points})" for t in result.todos if t.points < t.max_points]
    return [
        f"{member.kind}/{member.name}",
        member.form,
        str(result.points),
        ", ".join(lost) if len(lost) < 6 else f"{len(lost)} TODOs",
        member.misnamed(result) if member.kind == "wrong" else "",
        f"{verdict.seconds:.1f}",
        verdict.complaint or "as it must",
    ]
