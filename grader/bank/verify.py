"""Grade the grader: both trees, the rubric, every member of the bank and every half-way state.

A member with the right marks is not graded again until something they depend on changes. So a
stopped run resumes.
"""

import atexit
import tempfile
import time
from collections import Counter as Count
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field, replace
from functools import cache, partial
from multiprocessing import active_children, get_context
from pathlib import Path
from typing import Protocol, TypeVar

from rich.console import Console
from rich.table import Table

from grader.bank.halfway import Halfway, list_states
from grader.bank.ladders import Ladder, list_ladders
from grader.bank.members import ATTACKED, Attack, Entry, Member, list_members
from grader.bank.store import Store
from grader.bank.sync import sync
from grader.bank.traces import watch_traces
from grader.errors import Stop
from grader.judge.course import FULL, Course
from grader.judge.grade import grade
from grader.judge.passed import PASSED, KnownPrograms, PassedBefore, PassedPrograms
from grader.judge.result import Result
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.wall.children import WarmWorker, Worker, start_worker
from grader.judge.wall.processes import begin_process
from grader.judge.wall.starting import count_cores
from grader.report.progress import Counter
from grader.text import plural

One = TypeVar("One")
Found = TypeVar("Found")

RESULTS = KIT / "build" / "verify"
NOTHING = "nothing in the bank has {!r} in its kind/name, such as wrong/4-against-the-slip"
MIN_HELPED = 0.95  # share of the half-way states whose first failure must say what is wrong


class HasComplaint(Protocol):
    @property
    def name(self) -> str: ...
    @property
    def complaint(self) -> str: ...


Judged = TypeVar("Judged", bound=HasComplaint)


@dataclass
class Verdict:
    """The result of a member of the bank, and the fault in it."""

    member: Member
    result: Result | None
    seconds: float
    complaint: str
    earlier: bool = False  # graded by an earlier run

    @property
    def name(self) -> str:
        return self.member.name

    @property
    def is_rung(self) -> bool:
        return self.member.kind == "ladder" and self.member.is_rung


@dataclass
class Report:
    verdicts: list[Verdict] = field(default_factory=list)
    halfway: list[Verdict] = field(default_factory=list)
    complaints: list[str] = field(default_factory=list)  # about the kit itself

    @property
    def ladders(self) -> list[Ladder]:
        return list_ladders((each.member, each.result) for each in self.verdicts)

    @property
    def sound(self) -> bool:
        of_members = [each.complaint for each in self.verdicts]
        of_ladders = [each.complaint for each in self.ladders]
        return not any([*self.complaints, *of_members, *of_ladders, self.halfway_complaint])

    @property
    def halfway_complaint(self) -> str:
        """Return the fault in the words for half-way states, or an empty text."""
        wrong = sum(each.complaint.startswith("says ") for each in self.halfway)
        helped = sum(not each.complaint for each in self.halfway)
        if wrong:
            return f"{wrong} get a wrong message"
        if helped < MIN_HELPED * len(self.halfway):
            return f"only {helped} of {len(self.halfway)} get a helpful message"
        return ""


def verify(
    jobs: int,
    only: str,
    console: Console,
    fresh: bool = False,
    course: Course = FULL,
) -> Report:
    """Grade the members of a course whose names contain `only`; print a table.

    Sound results of an earlier run are reused unless `fresh`, and no program runs twice. Points are
    those of the rubric: a course may give a check none, and it must still tell right from wrong.
    """
    course = course.as_rated
    report = Report(complaints=list(check_kit()))
    chosen = choose_members(only, course)
    states = list_halfway(only, course, report.complaints)
    if not chosen and not states:
        raise Stop(NOTHING.format(only))
    for what, some, found in (
        ("grading the bank", chosen, report.verdicts),
        ("grading half-way states", states, report.halfway),
    ):
        found += collect(what, judge(some, jobs, Store(RESULTS), fresh), len(some), console)
    order = {(m.kind, m.name, m.form): number for number, m in enumerate(chosen)}
    report.verdicts.sort(key=lambda v: order[v.member.kind, v.member.name, v.member.form])
    show(report, console)
    return report


def choose_members(only: str, course: Course = FULL) -> list[Member]:
    everything = [*list_trees(course), *list_members(course)]
    return [each for each in everything if only in f"{each.kind}/{each.name}"]


def write_members(only: str, folder: Path) -> list[Path]:
    """Write members and half-way states as submissions into a folder; return their paths."""
    chosen = [*choose_members(only), *list_halfway(only, FULL, [])]
    if not chosen:
        raise Stop(NOTHING.format(only))
    paths = []
    for each in chosen:
        paths.append(
            folder / each.name if each.form == "package" else folder / f"{each.name}-single"
        )
        each.build(paths[-1])
    return paths


def count_unproven(course: Course) -> int:
    """Count the members of a course's bank that no `verify` of this version has proved.

    It grades by the whole rubric, so one `verify` serves every course.
    """
    results = Store(RESULTS)
    all_of_them = choose_members("", course.as_rated)
    return sum(results.read(replace(each, course=FULL)) is None for each in all_of_them)


def collect(what: str, judged: Iterable[Judged], total: int, console: Console) -> list[Judged]:
    """Collect the verdicts and show progress; print each complaint."""
    found: list[Judged] = []
    with Counter(what, total, console) as counter:
        for each in judged:
            found.append(each)
            counter.reached(len(found))
            if each.complaint:
                console.print(f"{each.name}: {each.complaint}")
    return found


def judge(chosen: Sequence[Member], jobs: int, store: Store, fresh: bool) -> Iterator[Verdict]:
    """Yield a verdict on each member, earlier ones first; store the sound ones."""
    to_grade = []
    for member in chosen:
        store.key(member)  # before anything is graded
        found = None if fresh else store.read(member)
        if not found or find_complaint(member, found.result, found.seconds):
            to_grade.append(member)
        else:
            yield Verdict(member, found.result, found.seconds, "", earlier=True)
    for verdict in grade_all(to_grade, jobs, None if fresh else PASSED):
        if verdict.result is not None and not verdict.complaint:
            store.write(verdict.member, verdict.seconds, verdict.result)
        yield verdict


def list_trees(course: Course = FULL) -> list[Member]:
    """Return the shipped trees as members: all points, and none."""
    nothing = Entry(base="starter", loses=("everything",))
    return [
        Member("right", "solution", "package", Entry(), None, course),
        Member("hostile", "starter", "package", nothing, None, course),
    ]


def list_halfway(only: str, course: Course, complaints: list[str]) -> list[Halfway]:
    """Return the half-way states of a course; add a complaint if one cannot be built."""
    try:
        states = [each for each in list_states() if only in f"halfway/{each.name}"]
    except ValueError as error:
        complaints.append(f"half-way states: {error}")
        return []
    return [each for each in states if each.belongs_to(course)]


def check_kit() -> Iterator[str]:
    """Yield faults of the kit that show before anything is graded."""
    yield from sync(KIT / "solution", KIT / "starter", write=False)
    points = load_rubric().max_points
    if points != 100:
        yield f"the rubric adds up to {points} points instead of 100"


# ---------------------------------------------------------------- grading


def grade_all(
    chosen: Iterable[Member], jobs: int, passed: PassedPrograms | None = PASSED
) -> Iterator[Verdict]:
    """Grade members; those with numpy come last, as a worker that has loaded it forks slower."""
    graded = partial(grade_member, passed=passed)
    ordered = sorted(chosen, key=lambda member: member.uses_numpy)
    yield from run_in_processes(graded, ordered, jobs, lambda member: member.entry.sleeps)


def run_in_processes(
    function: Callable[[One], Found],
    chosen: Iterable[One],
    jobs: int,
    sleeps: Callable[[One], bool] = lambda each: False,
) -> Iterator[Found]:
    """Yield the results of a function, run in processes of their own, as they end.

    Without a number of jobs, there is one process per core, and one more for those that sleep.
    """
    todo = list(chosen)
    if not todo:
        return
    context = get_context("spawn")
    with (
        ProcessPoolExecutor(jobs or count_cores(), context, begin_process) as pool,
        ProcessPoolExecutor(1, context, begin_process) as beside,
    ):
        futures = [
            (beside if sleeps(each) and not jobs else pool).submit(function, each) for each in todo
        ]
        try:
            for future in as_completed(futures):
                yield future.result()
        except BaseException:  # such as Ctrl-C
            for executor in (pool, beside):
                executor.shutdown(wait=False, cancel_futures=True)
            for process in active_children():
                process.kill()
            raise


def grade_member(
    member: Member, only: frozenset[str] = frozenset(), passed: PassedPrograms | None = PASSED
) -> Verdict:
    """Grade it on all TODOs that may judge it, or on those in `only`.

    Programs that have `passed` are not run again; see `grade_submission`.
    """
    with tempfile.TemporaryDirectory(prefix="bank-") as folder:
        submission = Path(folder).resolve() / member.name
        try:
            member.build(submission)
        except ValueError as error:  # an edit of text that the solution no longer has
            return Verdict(member, None, 0.0, f"cannot be built: {error}")
        worker = shared_worker()
        start = time.monotonic()
        try:
            name = member.name if member.source else ""  # a tree leaves nothing on purpose
            with watch_traces(Path(folder, "temporary"), name) as traces:
                # Without fork, a worker keeps processes ready, which look like leftovers: do not
                # share it.
                shared = worker if isinstance(worker, WarmWorker) else None
                if isinstance(member, Halfway):
                    result = member.grade(submission, shared)
                else:
                    options = Options(
                        shipped_reference(),
                        only=only or member.judged_by,
                        trusted=True,
                        course=member.course,
                        passed=passed,
                    )
                    result = grade_submission(member, submission, options, shared)
        except Exception as error:  # a crash of the judge is the worst verdict
            text = f"the judge fell over: {type(error).__name__}: {error}"
            return Verdict(member, None, time.monotonic() - start, text)
        seconds = time.monotonic() - start
        complaint = find_complaint(member, result, seconds) or traces.complaint
        return Verdict(member, result, seconds, complaint)


def grade_submission(
    member: Member, submission: Path, options: Options, worker: Worker | None
) -> Result:
    """Grade a member that was built; run no program that has passed, unless it may be affected.

    The first hostile line may affect all that runs after it: code in regions begins in the checks
    of its TODO, other hostile code with its import. An attack that was refused has changed nothing.
    """
    passed = options.passed
    if member.kind != "hostile" or passed is None:
        return grade(submission, options, worker)
    attack = member.entry if isinstance(member.entry, Attack) else None
    if attack is None and not member.is_patch:
        return grade(submission, replace(options, passed=None), worker)
    if attack is not None and attack.only_tries:
        result = grade(submission, replace(options, passed=KnownPrograms(passed)), worker)
        if list_answers(result) == answers_if_refused():
            return result
    return grade(submission, replace(options, passed=PassedBefore(passed)), worker)


@cache
def answers_if_refused() -> list[str]:
    """Return what the checks get from an attack that was refused: its program stands still."""
    still = Member("hostile", "stands-still", "package", Attack(code="return x, v"), None)
    result = grade_member(still, frozenset({ATTACKED}), None).result
    return list_answers(result) if result else []


def list_answers(result: Result) -> list[str]:
    """Return what the checks of the attacked TODO got."""
    return [each.got for todo in result.todos if todo.id == ATTACKED for each in todo.checks]


def find_complaint(member: Member, result: Result, seconds: float) -> str:
    """Return the fault in its marks, or in the name of its mistake."""
    if complaint := member.complaint(result, seconds):
        return complaint
    if member.kind == "wrong" and member.compare_name(result) == "wrong":
        names = sorted({todo.misconception for todo in result.todos if todo.misconception})
        return f"its mistake is named {', '.join(names)}"
    return ""


@cache
def shared_worker() -> Worker:
    """Start one worker for all members that this process grades; it ends with the process."""
    worker = start_worker()
    atexit.register(worker.close)
    if isinstance(worker, WarmWorker):
        worker.wait_until_loaded()  # its own processes are no leftovers
    return worker


# ---------------------------------------------------------------- showing


def show(report: Report, console: Console) -> None:
    table = Table("member", "form", "points", "lost in", "named", "s", "verdict")
    for each in report.verdicts:
        if not each.is_rung or each.complaint:
            table.add_row(*make_row(each))
    for ladder in report.ladders:
        points = " ".join(map(str, ladder.points.values()))
        verdict = ladder.complaint or "as it must"
        table.add_row(f"ladder/{ladder.name}", "package", points, "", "", "", verdict)
    console.print(table)
    for line in summarize(report):
        console.print(line)


def make_row(verdict: Verdict) -> list[str]:
    member, result = verdict.member, verdict.result
    name = f"{member.kind}/{member.name}"
    if result is None:
        return [name, member.form, "", "", "", "", verdict.complaint]
    lost = [f"{t.id} (-{t.max_points - t.points})" for t in result.todos if t.points < t.max_points]
    return [
        name,
        member.form,
        str(result.points),
        ", ".join(lost) if len(lost) < 6 else f"{len(lost)} TODOs",
        member.compare_name(result) if member.kind == "wrong" else "",
        f"{verdict.seconds:.1f}",
        verdict.complaint or "as it must",
    ]


def summarize(report: Report) -> Iterator[str]:
    """Count the members of each kind, the names of mistakes, and the complaints.

    A ladder counts as one, with any number of rungs.
    """
    judged = [(v.member.kind, v.complaint) for v in report.verdicts if not v.is_rung]
    judged += [("ladder", v.complaint) for v in report.verdicts if v.is_rung and v.complaint]
    judged += [("ladder", ladder.complaint) for ladder in report.ladders]
    bad = Count(kind for kind, complaint in judged if complaint)
    for kind, count in Count(kind for kind, _ in judged).items():
        yield f"{kind}: {count}, of which {bad[kind]} with a complaint"
    wrong = [v for v in report.verdicts if v.member.kind == "wrong"]
    named = Count(v.member.compare_name(v.result) for v in wrong if v.result is not None)
    right, none = named["right"], named["none"]
    yield f"mistakes named rightly: {right}, not named: {none}, named wrongly: {named['wrong']}"
    count, earlier = len(report.verdicts), sum(v.earlier for v in report.verdicts)
    taken = f"{count - earlier} graded now, {earlier} taken from an earlier run"
    yield f"{plural(count, 'member')}: {taken}"
    if report.halfway:
        helped = sum(not state.complaint for state in report.halfway)
        again = sum(state.earlier for state in report.halfway)
        yield (
            f"half-way states: {len(report.halfway)}, with a helpful message: {helped}; "
            f"{again} taken from an earlier run"
        )
    if report.halfway_complaint:
        yield f"half-way states: {report.halfway_complaint}"
    yield from (f"the kit: {complaint}" for complaint in report.complaints)
