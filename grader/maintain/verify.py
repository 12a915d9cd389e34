"""The grader is graded: the trees, the rubric and every member of the bank."""

import os
import tempfile
import time
from collections.abc import Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field
from functools import cache
from multiprocessing import get_context
from pathlib import Path

from rich.console import Console
from rich.table import Table

from grader.classroom.progress import Counter
from grader.judge.children import WarmWorker, Worker, start_worker
from grader.judge.grade import KIT, Options, grade, shipped_reference
from grader.judge.result import Result
from grader.judge.rubric import load_rubric
from grader.maintain.bank import Entry, Member, members
from grader.maintain.sync import sync
from grader.maintain.traces import watched


@dataclass
class Verdict:
    """A member of the bank, and what came of grading it."""

    member: Member
    result: Result | None
    seconds: float
    complaint: str


@dataclass
class Report:
    verdicts: list[Verdict] = field(default_factory=list)
    complaints: list[str] = field(default_factory=list)  # about the kit itself

    @property
    def sound(self) -> bool:
        return not self.complaints and not any(each.complaint for each in self.verdicts)


def verify(jobs: int, only: str, console: Console) -> Report:
    """Grade the bank, as far as its names contain `only`; prints a table."""
    report = Report(complaints=list(kit_complaints()))
    chosen = [each for each in [*trees(), *members(KIT)] if only in f"{each.kind}/{each.name}"]
    with Counter("grading the bank", len(chosen), console) as counter:
        for verdict in grade_all(chosen, jobs):
            report.verdicts.append(verdict)
            counter.reached(len(report.verdicts))
            if verdict.complaint:
                console.print(f"{verdict.member.name}: {verdict.complaint}")
    order = {(m.kind, m.name, m.form): number for number, m in enumerate(chosen)}
    report.verdicts.sort(key=lambda v: order[v.member.kind, v.member.name, v.member.form])
    show(report, console)
    return report


def trees() -> list[Member]:
    """The shipped trees themselves: everything, and nothing."""
    return [
        Member("right", "solution", "package", Entry(), None),
        Member("hostile", "starter", "package", Entry(base="starter", points=0), None),
    ]


def kit_complaints() -> Iterator[str]:
    """What is wrong with the kit before anything is graded."""
    yield from sync(KIT / "solution", KIT / "starter", write=False)
    points = load_rubric().max_points
    if points != 100:
        yield f"the rubric adds up to {points} points instead of 100"


def grade_all(chosen: Iterable[Member], jobs: int) -> Iterator[Verdict]:
    context = get_context("spawn")
    with ProcessPoolExecutor(jobs or os.cpu_count(), mp_context=context) as pool:
        futures = [pool.submit(grade_member, member) for member in chosen]
        for future in as_completed(futures):
            yield future.result()


def grade_member(member: Member, only: frozenset[str] = frozenset()) -> Verdict:
    """Grade it on all that may judge it, or on the TODOs in `only`."""
    with tempfile.TemporaryDirectory(prefix="bank-") as folder:
        submission = Path(folder).resolve() / member.name
        member.build(KIT, submission)
        todos, worker = only or member.judged_by, shared_worker()
        options = Options(shipped_reference(), only=todos)
        start = time.monotonic()
        try:
            with watched(Path(folder, "temporary")) as traces:
                # One without fork keeps processes ahead, as if left behind: not to be shared.
                shared = worker if isinstance(worker, WarmWorker) else None
                result = grade(submission, options, shared)
        except Exception as error:  # a judge that falls over is the worst verdict of all
            text = f"the judge fell over: {type(error).__name__}: {error}"
            return Verdict(member, None, time.monotonic() - start, text)
        seconds = time.monotonic() - start
        complaint = member.complaint(result, seconds) or traces.complaint
        return Verdict(member, result, seconds, complaint)


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
        table.add_row(*row(each))
    console.print(table)
    wrong = [v for v in report.verdicts if v.member.kind == "wrong" and v.result is not None]
    named = [v.member.misnamed(v.result) for v in wrong if v.result is not None]
    counts = {kind: named.count(kind) for kind in ("right", "wrong", "none")}
    bad = sum(1 for v in report.verdicts if v.complaint)
    console.print(
        f"{len(report.verdicts)} members, {bad} with the wrong marks; mistakes named rightly: "
        f"{counts['right']}, not named: {counts['none']}, named wrongly: {counts['wrong']}"
    )
    for complaint in report.complaints:
        console.print(f"the kit: {complaint}")


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
