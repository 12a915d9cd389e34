"""Grading a class, several submissions at a time; what becomes of one touches no other.

Results are written as they come, and what stands from an earlier run is not graded again. The pool
of this machine and a cluster run the same function on the same packages.
"""

import hashlib
import multiprocessing
import os
import signal
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Protocol, Self

import msgspec
from rich.console import Console
from rich.table import Table

import grader
from grader.classroom.adjustments import Adjustments, load_adjustments
from grader.classroom.book import Book, Outcome, outcome_of
from grader.classroom.intake import (
    CannotTake,
    ClassList,
    Found,
    Intake,
    Package,
    opened_class,
    pack,
)
from grader.classroom.progress import Counter
from grader.classroom.roster import CannotRead, read_roster
from grader.judge.children import Worker, start_worker
from grader.judge.grade import Options, grade, work_folder
from grader.judge.result import is_bonus
from grader.judge.rubric import load_rubric
from grader.judge.submission import CannotGrade, module_of
from grader.report.files import as_json
from grader.todo_regions import python_files
from grader.words import clean

NOT_DECIDING = ("classroom", "maintain", "report")  # folders of the grader that give no points
LIBRARIES = ("hypothesis", "msgspec", "pygame-ce", "pymunk", "pytest")
LONGEST = 300  # rows that a terminal is given; the table as a file has them all
LONGEST_PAGE = 2000  # rows of the page: its makers hold all results at once, 35 kB each
AHEAD = 2  # submissions that wait, packed, for each one being graded
NAMED = 20  # names in one note

LOST = "the cluster is gone; what is graded stays, and the same command goes on from there"

Graded = tuple[bytes, float]  # a result as JSON, and the seconds it took


# ---------------------------------------------------------------- one submission


def grade_package(package: Package, options: Options) -> Graded:
    """Grade one submission; run in a process of the pool or of a cluster."""
    start = time.monotonic()
    with work_folder() as work:
        result = grade(package.unpack(work), options, shared_worker())
    return as_json(result), time.monotonic() - start


@cache
def shared_worker() -> Worker:
    """One for all submissions that this process grades; it ends when this process does."""
    return start_worker()


# ---------------------------------------------------------------- what a result depends on


@cache
def fingerprint() -> str:
    """The hash of the grader itself and of the libraries that decide about points."""
    top = Path(grader.__file__).parent
    digest = hashlib.sha256()
    for path in sorted(top.rglob("*")):
        inside = path.relative_to(top)
        if path.suffix in (".py", ".toml", ".json", ".ini") and inside.parts[0] not in NOT_DECIDING:
            digest.update(f"{inside.as_posix()}\0".encode() + path.read_bytes() + b"\0")
    releases = [f"{name} {version(name)}" for name in LIBRARIES]
    digest.update(f"{sys.version_info[:2]} {releases}".encode())
    return digest.hexdigest()


def key_of(options: Options) -> str:
    """The hash of all that a result depends on, the submission aside."""
    reference = packed_reference(options.reference)
    digest = reference.digest if reference else ""
    decides = [sorted(options.only), options.seed, options.isolation, options.spawn]
    return hashlib.sha256(msgspec.json.encode([fingerprint(), digest, decides])).hexdigest()


def packed_reference(folder: Path | None) -> Package | None:
    """Of the reference, the programs that the rubric names."""
    if folder is None:
        return None
    modules = {todo.module for todo in load_rubric().todos}
    files = [
        (path.relative_to(folder).as_posix(), path.read_bytes())
        for path in python_files(folder)
        if module_of(path.relative_to(folder)) in modules
    ]
    return Package("reference", sorted(files))


# ---------------------------------------------------------------- who grades


class Crew(Protocol):
    """Processes that grade, here or elsewhere."""

    def room(self) -> int:
        """How many submissions to have under way."""

    def submit(self, package: Package) -> "Future[Graded]": ...

    def mend(self) -> None:
        """A process fell over, and with it all that was under way: start anew."""

    def alone(self, package: Package) -> Graded:
        """Grade one of those that were under way then, and nothing beside it."""


class GaveUp(Exception):
    """The crew cannot go on; the message says why and what to do."""


class Pool:
    """Processes of this machine."""

    work = staticmethod(grade_package)

    def __init__(self, options: Options, jobs: int) -> None:
        self.options, self.jobs = options, jobs or os.cpu_count() or 1
        if sys.platform == "win32":
            self.jobs = min(self.jobs, 61)  # Windows waits for no more at once

    def _start(self, jobs: int) -> ProcessPoolExecutor:
        context = multiprocessing.get_context("spawn")
        return ProcessPoolExecutor(jobs, context, begin_process)

    def __enter__(self) -> Self:
        self.executor = self._start(self.jobs)
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        if kind is not None:  # somebody is tired of waiting
            for process in multiprocessing.active_children():
                process.kill()
        self.executor.shutdown(cancel_futures=True)

    def room(self) -> int:
        return self.jobs * (1 + AHEAD)

    def submit(self, package: Package) -> "Future[Graded]":
        try:
            return self.executor.submit(self.work, package, self.options)
        except BrokenProcessPool as error:
            broken: Future[Graded] = Future()
            broken.set_exception(error)
            return broken

    def mend(self) -> None:
        self.executor.shutdown()
        self.executor = self._start(self.jobs)

    def alone(self, package: Package) -> Graded:
        """In a pool of its own, so that it is known which one is to blame."""
        with self._start(1) as executor:
            return executor.submit(self.work, package, self.options).result()


def begin_process() -> None:
    """In a process of the pool: Ctrl-C is the parent's, and nobody works on without a parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def follow() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=follow, daemon=True).start()


# ---------------------------------------------------------------- a class


@dataclass
class Task:
    """A submission that must be graded."""

    found: Found
    package: Package
    key: str


@dataclass
class Run:
    """One class, and what has become of it so far."""

    intake: Intake
    book: Book
    key: str
    adjustments: Adjustments
    outcomes: list[Outcome] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=lambda: {"graded": 0, "kept": 0, "trouble": 0})
    same: dict[str, dict[tuple[Path, ...], str]] = field(default_factory=dict)  # names, by files

    def tasks(self) -> Iterator[Task]:
        """The submissions that must be graded; all others are settled on the way."""
        for found in self.intake.found:
            try:
                package = pack(found)
            except CannotTake as error:
                self.trouble(found, str(error))
                continue
            self.same.setdefault(package.digest, {})[found.sources] = found.name
            self.notes += [f"{found.name}: left out {each}" for each in package.notes]
            key = hashlib.sha256(f"{self.key} {package.digest}".encode()).hexdigest()
            kept = self.book.kept(found.name, key)
            if kept is None:
                yield Task(found, package, key)
            else:
                self.settle("kept", found, kept)

    def graded(self, task: Task, graded: Graded) -> None:
        outcome = outcome_of(task.found.name, *graded, task.key)
        self.book.write(outcome, graded[0])
        self.settle("graded", task.found, outcome)

    def trouble(self, found: Found, words: str) -> None:
        self.book.forget(found.name)
        self.settle("trouble", found, Outcome(found.name, words))

    def settle(self, how: str, found: Found, outcome: Outcome) -> None:
        final = self.adjustments.final(found, outcome.points)
        outcome = msgspec.structs.replace(
            outcome,
            final=final.points if not outcome.trouble else 0,
            reasons=list(final.reasons),
            late=found.late,
            handed_in=found.handed_in,
        )
        self.counts[how] += 1
        self.outcomes.append(outcome)

    def copies(self) -> Iterator[str]:
        """Those who handed in the same files apart, unless these are worth nothing."""
        worth = {each.name: each.points for each in self.outcomes}
        for names in [list(each.values()) for each in self.same.values()]:
            if len(names) > 1 and worth[names[0]]:
                yield f"the same files were handed in by {some(names)}"


def grade_class(
    intake: Intake,
    out: Path,
    key: str,
    crew: Crew,
    console: Console,
    adjustments: Adjustments | None = None,
) -> Run:
    """Grade what is new in a class; results, book and table are in and beside the folder `out`."""
    total = len(intake.found) + len(intake.troubles)
    with Book(out) as book, Counter("grading", total, console) as counter:
        run = Run(intake, book, key, adjustments or Adjustments(), notes=list(intake.notes))
        for name, words in intake.troubles.items():
            run.trouble(Found(name, ()), words)
        for task, graded in grade_all(run.tasks(), crew):
            if isinstance(graded, str):
                run.trouble(task.found, graded)
            else:
                run.graded(task, graded)
            counts = ", ".join(f"{count} {how}" for how, count in run.counts.items() if count)
            counter.reached(len(run.outcomes), counts)
        run.outcomes.sort(key=lambda each: each.name)
        book.close_with(run.outcomes)
    run.notes += run.copies()
    names = [each.name for each in run.outcomes]
    for student in run.adjustments.unused(names):
        run.notes.append(f"adjusted, but nothing was handed in: {student}")
    if others := book.strangers(names):
        run.notes.append(f"{out} also holds results of others than this class: {some(others)}")
    return run


def grade_all(tasks: Iterator[Task], crew: Crew) -> Iterator[tuple[Task, Graded | str]]:
    """Each task with its result or its trouble, in the order in which they end."""
    under_way: dict[Future[Graded], Task] = {}
    for task in tasks:
        under_way[crew.submit(task.package)] = task
        if len(under_way) >= crew.room():
            yield from finished(under_way, crew)
    while under_way:
        yield from finished(under_way, crew)


def finished(
    under_way: "dict[Future[Graded], Task]", crew: Crew
) -> Iterator[tuple[Task, Graded | str]]:
    """Those that have ended by now, one at least."""
    done, _ = wait(under_way, return_when=FIRST_COMPLETED)
    if any(future.cancelled() for future in done):
        raise CannotGrade(LOST)
    broken = any(isinstance(future.exception(), BrokenProcessPool) for future in done)
    if broken:
        done, _ = wait(under_way)  # at once: the pool has given all of them up
        crew.mend()
    for future in done:
        task = under_way.pop(future)
        graded: Graded | str
        try:
            again = isinstance(future.exception(), BrokenProcessPool)
            graded = crew.alone(task.package) if again else future.result()
        except BrokenProcessPool:
            graded = "it ended the grader's own process, twice: please report it"
        except GaveUp as error:
            raise CannotGrade(str(error)) from error
        except Exception as error:  # this one submission; the others go on
            graded = f"{type(error).__name__}: {error}"
        yield task, graded


# ---------------------------------------------------------------- from the command line


@dataclass(frozen=True)
class Wanted:
    """How a class is to be graded, as the command line says it."""

    options: Options
    out: Path | None = None  # the class folder's name and `-results`, beside it, if left out
    jobs: int = 0
    roster: Path | None = None  # roster.csv of the class folder, if there is one
    adjust: Path | None = None  # adjustments.toml of the class folder, if there is one
    cluster: str = ""  # the address of a Dask scheduler


def run_class(path: Path, wanted: Wanted, console: Console) -> Run:
    """Grade the class at `path`, show it, and say where the results are."""
    path = path.resolve()
    people = people_of(path, wanted.roster)
    adjust = wanted.adjust or beside(path, "adjustments.toml")
    adjustments = load_adjustments(adjust) if adjust else Adjustments()
    out = wanted.out or path.with_name(f"{path.stem}-results")
    with opened_class(path, people) as intake, hired(wanted) as crew:
        run = grade_class(intake, out, key_of(wanted.options), crew, console, adjustments)
        if absent := people.absent(intake.found):
            run.notes.append(f"nothing was handed in by {some(absent)}")
        if strangers := people.strangers(intake.found):
            run.notes.append(f"not in the class list: {some(strangers)}")
    show_class(run, console)
    console.print(page_of(run), soft_wrap=True)
    return run


def page_of(run: Run) -> str:
    """Make the page of the class, and say where it is; of too many there is none by itself."""
    if len(run.outcomes) > LONGEST_PAGE:
        return f"page:    for more than {LONGEST_PAGE}, by `grader dashboard {run.book.folder}`"
    from grader.classroom.dashboard import read_class, write_dashboard  # jinja: not in the pool

    return f"page:    {write_dashboard(run.book.folder, read_class(run.book.folder))}"


def people_of(path: Path, roster: Path | None) -> ClassList:
    """Who is in the class, if there is a class list."""
    roster = roster or beside(path, "roster.csv")
    try:
        return ClassList(read_roster(roster) if roster else None)
    except CannotRead as error:
        raise CannotGrade(str(error)) from error


def beside(path: Path, name: str) -> Path | None:
    return path / name if (path / name).is_file() else None


def hired(wanted: Wanted) -> AbstractContextManager[Crew]:
    if not wanted.cluster:
        return Pool(wanted.options, wanted.jobs)
    from grader.classroom.cluster import connected  # an extra

    return connected(wanted.cluster, wanted.options)


# ---------------------------------------------------------------- for people


def show_class(run: Run, console: Console) -> None:
    """The table, how many passed each TODO, and all that a person should know."""
    if len(run.outcomes) <= LONGEST:
        console.print(table_of(run.outcomes))
    results = [each for each in run.outcomes if not each.trouble]
    if len(results) > 1:
        console.print(rates(results))
    for note in run.notes[:LONGEST]:
        console.print(clean(note), soft_wrap=True)
    counts = ", ".join(f"{count} {how}" for how, count in run.counts.items())
    console.print(f"{len(run.outcomes)} submissions: {counts}")
    console.print(f"results: {run.book.folder}", soft_wrap=True)
    console.print(f"table:   {run.book.table}", soft_wrap=True)


def table_of(outcomes: list[Outcome]) -> Table:
    table = Table("submission", "points", "not passed")
    for each in outcomes:
        if each.trouble:
            table.add_row(clean(each.name), "none", clean(each.trouble))
            continue
        points = f"{each.final} / {each.max_points}"
        told = [f"found {each.points}; {clean('; '.join(each.reasons))}"] if each.reasons else []
        late = ["late"] if each.late and not each.reasons else []
        nothing = set(each.left) == {todo for todo in each.todos if not is_bonus(todo)}
        left = "all" if nothing else ", ".join(each.left)
        table.add_row(clean(each.name), points, "\n".join(filter(None, [left, *late, *told])))
    return table


def rates(results: list[Outcome]) -> Table:
    """The share of submissions that pass each TODO of the assignment."""
    table = Table("TODO", "passed by", box=None)
    for todo in load_rubric().counted:
        asked = [each for each in results if todo.id in each.todos]
        if asked:
            passed = sum(todo.id not in each.left for each in asked)
            table.add_row(f"{todo.id} {todo.title}", f"{passed / len(asked):4.0%}")
    return table


def some(names: list[str]) -> str:
    """Names for one note."""
    more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
    return ", ".join(names[:NAMED]) + more
