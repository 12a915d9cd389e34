"""What grading a class costs: cores, the grader's own share, memory, a second run, a cluster.

The class is made from the bank. Every figure comes from `grade --class` as instructors run it.
"""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from itertools import cycle, islice
from pathlib import Path

import psutil
from rich.console import Console
from rich.table import Table

from grader.bank.members import members
from grader.classroom.book import read_book
from grader.classroom.executor import shared_worker
from grader.judge import loop as plugin
from grader.judge.grade import KIT, Options, grade, shipped_reference

SECTION = 25  # submissions that are graded in one go, of those graded in turns
SAME = ("OTHER BYTES", "the same bytes")
SAMPLE = 6  # submissions that are graded alone, to see what of it is checks


@dataclass
class Measured:
    """One run over the class."""

    seconds: float
    results: dict[str, bytes]  # every result and the table
    busy: float  # s that processes were grading, all together
    early: float  # MB of all processes at most, until half is graded
    late: float  # MB at most, after that


def make_class(folder: Path, numbers: range) -> None:
    """As many students as wanted: wrong and right members of the bank in turns."""
    chosen = [each for each in members(KIT) if each.kind in ("wrong", "right")]
    wanted = islice(cycle(chosen), numbers.start, numbers.stop)
    for number, member in zip(numbers, wanted, strict=True):
        member.build(KIT, folder / f"{number:04}-{member.name}")


def run(
    folder: Path,
    out: Path,
    *options: str,
    cores: int = 0,
    at: int = 0,
    then: Callable[[psutil.Popen], None] | None = None,
) -> Measured:
    """Grade the class, on the first `cores` cores only; something happens `at` so many results."""
    command = [sys.executable, "-m", "grader", "grade", "--class", str(folder), "--out", str(out)]
    start = time.monotonic()
    process = psutil.Popen([*command, *options], cwd=KIT, stdout=subprocess.DEVNULL)
    if cores and hasattr(process, "cpu_affinity"):
        process.cpu_affinity(sorted(os.sched_getaffinity(0))[:cores])
    half, early, late = len(list(folder.iterdir())) // 2, 0.0, 0.0
    while process.poll() is None:
        time.sleep(0.25)
        done = len(list(out.glob("*.json")))
        memory = megabytes(process)
        early, late = (max(early, memory), 0.0) if done < half else (early, max(late, memory))
        if then is not None and done >= at:
            then(process)
            then = None
    seconds = time.monotonic() - start
    book = out.with_name(f"{out.name}.class.jsonl")
    busy = sum(each.seconds for each in read_book(book))
    return Measured(seconds, dict(snapshot(out)), busy, early, late)


def snapshot(out: Path) -> Iterator[tuple[str, bytes]]:
    table = out.with_name(f"{out.name}.class.csv")
    if table.exists():
        yield "the table", table.read_bytes()
    for path in out.glob("*.json"):
        yield path.name, path.read_bytes()


def megabytes(process: psutil.Process) -> float:
    """Memory of a process and all it has started."""
    try:
        family = [process, *process.children(recursive=True)]
        return sum(each.memory_info().rss for each in family) / 1e6
    except psutil.Error:
        return 0.0


def share_of_checks(folder: Path) -> float:
    """Of the time that grading one submission takes, the share in which checks run."""
    inside = 0.0
    original = plugin.run_pytest

    def timed(*arguments: object) -> None:
        nonlocal inside
        start = time.monotonic()
        original(*arguments)  # type: ignore[arg-type]
        inside += time.monotonic() - start

    plugin.run_pytest = timed  # type: ignore[assignment]
    try:
        paths = sorted(folder.iterdir())[:SAMPLE]
        grade(
            paths[0], Options(shipped_reference(), trusted=True), shared_worker()
        )  # all is loaded after this
        inside, start = 0.0, time.monotonic()
        for path in paths:
            grade(path, Options(shipped_reference(), trusted=True), shared_worker())
        return inside / (time.monotonic() - start)
    finally:
        plugin.run_pytest = original
        shared_worker().close()


def bench_class(console: Console, size: int = 200, *only: str) -> None:
    """Print what a class of `size` costs on one core, on two, again, after a kill, on a cluster.

    One core and two take turns with each section of the class; the rest is done with half of it.
    `only` are options of `grade` for all runs, to measure in less time: "--todo", "8a".
    """
    table = Table("run", "submissions", "s", "result")
    with tempfile.TemporaryDirectory(prefix="class-") as temporary:
        work, half = Path(temporary), size // 2
        single, double = in_turns(list(sections(work, size)), *only)
        one, two = (sum(each.seconds for each in runs) for runs in (single, double))
        alike = all(a.results == b.results for a, b in zip(single, double, strict=True))
        table.add_row("one core", f"{size}", f"{one:.1f}", f"{one / size:.2f} s each")
        told = f"{one / two:.2f} times one core; {SAME[alike]}"
        table.add_row("two cores", f"{size}", f"{two:.1f}", told)
        folder = work / "half"
        make_class(folder, range(half))
        checks = share_of_checks(folder)
        first = on_two_cores(folder, *only)
        own = 1 - checks * first.busy / (2 * first.seconds)
        told = f"{own:.0%} of the time is not spent in checks"
        table.add_row("at a stretch", f"{half}", f"{first.seconds:.1f}", told)
        memory = f"{first.early:.0f} MB until half is graded, {first.late:.0f} MB after"
        table.add_row("", "", "", memory)
        again = on_two_cores(folder, *only)
        told = f"{again.seconds / first.seconds:.1%} of the first; {same(first, again)}"
        table.add_row("a second time", f"{half}", f"{again.seconds:.1f}", told)
        killed = work / "killed"
        part = run(folder, killed, "--jobs", "2", *only, at=half // 2, then=psutil.Popen.kill)
        rest = run(folder, killed, "--jobs", "2", *only)
        told = f"{len(part.results)} stand"
        table.add_row("killed in the middle", f"{half}", f"{part.seconds:.1f}", told)
        table.add_row("and run again", f"{half}", f"{rest.seconds:.1f}", same(first, rest))
        if find_spec("distributed"):
            there = on_cluster(folder, work / "there", half // 2, *only)
            told = f"one worker killed in the middle; {same(first, there)}"
            table.add_row("a cluster of two workers", f"{half}", f"{there.seconds:.1f}", told)
    console.print(table)


def sections(work: Path, size: int) -> Iterator[Path]:
    """The class in parts: a machine may be slower for minutes, and must be so for all runs."""
    for start in range(0, size, SECTION):
        folder = work / f"from-{start:04}"
        make_class(folder, range(start, min(start + SECTION, size)))
        yield folder


def in_turns(parts: list[Path], *only: str) -> tuple[list[Measured], list[Measured]]:
    """Each part on one core and on two, with either first by turns."""
    single: list[Measured] = []
    double: list[Measured] = []
    for number, folder in enumerate(parts):
        ways = [(single, on_one_core), (double, on_two_cores)]
        for runs, way in ways[:: -1 if number % 2 else 1]:
            runs.append(way(folder, *only))
    return single, double


def on_one_core(folder: Path, *only: str) -> Measured:
    return run(folder, folder.with_name(f"{folder.name}-one"), "--jobs", "1", *only, cores=1)


def on_two_cores(folder: Path, *only: str) -> Measured:
    return run(folder, folder.with_name(f"{folder.name}-two"), "--jobs", "2", *only, cores=2)


def same(one: Measured, other: Measured) -> str:
    return SAME[one.results == other.results]


def on_cluster(folder: Path, out: Path, at: int, *only: str) -> Measured:
    """The class on two worker processes of this machine, one of which is killed."""
    import distributed

    quiet: dict[str, object] = {"dashboard_address": None, "silence_logs": "CRITICAL"}
    workers = distributed.LocalCluster(  # type: ignore[no-untyped-call]
        n_workers=2, threads_per_worker=1, **quiet
    )
    with workers as local:
        victim = psutil.Process(next(iter(local.workers.values())).pid)
        address = local.scheduler_address
        return run(folder, out, "--cluster", address, *only, at=at, then=lambda _: victim.kill())
