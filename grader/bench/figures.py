"""Measure what grading costs: a student's wait, a full grade, a class, and a release.

All are measured in turns, so that a slow minute of the machine slows all of them. Linux only.
"""

import ctypes
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, suppress
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory, mkdtemp
from time import perf_counter, sleep
from typing import Any, NamedTuple

import msgspec
import psutil
from rich.console import Console
from rich.table import Table

from grader.bank.members import list_members
from grader.judge.task import KIT

Process = subprocess.Popen[str]
Look = Callable[[Process], object]  # at a process, as long as it wants to
ADOPT_ORPHANS = 36  # PR_SET_CHILD_SUBREAPER of Linux: their time counts too


class Tested(NamedTuple):
    """A kit to measure, and the folder for its files."""

    kit: Path
    work: Path

    def start(self, *words: str, cwd: Path | None = None, **how: Any) -> Process:
        """Start a command of this kit's grader."""
        environment = os.environ | {"PYTHONPATH": str(self.kit)}
        usual: dict[str, Any] = {"stdout": subprocess.DEVNULL, "cwd": cwd or self.kit, "text": True}
        command = [sys.executable, "-m", "grader", *words]
        return subprocess.Popen(command, env=environment, **usual | how)

    def run(self, *words: str, look: Look = lambda _: None, **how: Any) -> tuple[float, float]:
        """Run a command and call `look` on it; return its seconds and CPU seconds."""
        start, before = perf_counter(), sum(os.times()[2:4])
        process = self.start(*words, **how)
        look(process)
        assert process.wait() == 0, words
        seconds = perf_counter() - start
        sleep(0.1)  # until the rest has ended too
        with suppress(ChildProcessError):
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        return seconds, sum(os.times()[2:4]) - before


def measure_memory(tested: Tested, *words: str) -> tuple[float, float]:
    """Run a command; return its seconds, and the most memory of all its processes at once, MB."""
    found = [0.0]

    def look(process: Process) -> None:
        top = psutil.Process(process.pid)
        while process.poll() is None:
            with suppress(psutil.Error):  # one of them has just ended
                every = [top, *top.children(recursive=True)]
                found.append(sum(each.memory_full_info().pss for each in every) / 1e6)
            sleep(0.02)

    return tested.run(*words, look=look)[0], max(found)


def bench(rounds: int, size: int, console: Console, against: Path | None = None) -> None:
    """Print the figures of some rounds, with those of another checkout beside them."""
    ctypes.CDLL(None).prctl(ADOPT_ORPHANS, 1, 0, 0, 0)
    kits = {"this kit": KIT} | ({str(against): against.resolve()} if against else {})
    found: dict[str, dict[str, list[float]]] = {name: {} for name in kits}
    with TemporaryDirectory(prefix="bench-") as temporary, ExitStack() as stack:
        turns: list[tuple[str, Tested, Process]] = []
        for name, kit in kits.items():
            tested = Tested(kit, Path(temporary, str(len(turns))))
            prepare(tested, size)
            turns.append((name, tested, watch_todo_4(tested)))
            stack.callback(turns[-1][-1].terminate)
        for number in range(rounds):
            for name, tested, watch in turns:
                for figure, value in measure(tested, watch, size, first=number == 0):
                    found[name].setdefault(figure, []).append(value)
            turns.reverse()
    console.print(tabulate(found, f"{rounds} rounds, a class of {size}: minimum, median, maximum"))


def prepare(tested: Tested, size: int) -> None:
    """Write the kit's solution, and a class picked evenly from the bank's members."""
    without = shutil.ignore_patterns("__pycache__")
    shutil.copytree(tested.kit / "solution", tested.work / "tree", ignore=without)
    chosen = [each for each in list_members() if each.kind in ("wrong", "right")]
    for number in range(size):
        chosen[number * len(chosen) // size].build(tested.work / "class" / f"{number:04}")
    tested.run("release")  # the next one finds nothing new


def measure(tested: Tested, watch: Process, size: int, first: bool) -> Iterator[tuple[str, float]]:
    """Measure each figure once; those that take long only in the `first` round."""
    tree = tested.work / "tree"
    seconds, cpu = tested.run("grade", str(tree))
    yield "full grade on all cores, s", seconds
    yield "full grade, processor s", cpu
    yield "full grade on one core, s", tested.run("grade", str(tree), preexec_fn=use_one_core)[0]
    yield "full grade, MB at most", measure_memory(tested, "grade", str(tree))[1]
    yield "check --todo 4, s", tested.run("check", "--todo", "4", cwd=tree)[0]
    yield "check --watch, after a save, s", measure_save(tree, watch)
    one, cpu, _ = grade_class(tested, 1)
    two, _, until_first = grade_class(tested, 2)
    yield "class, processor s per submission", cpu / size
    yield "class on one core, s per submission", one / size
    yield "class, two jobs: times as fast", one / two
    yield "class, s until the first result", until_first
    if first:
        yield from measure_outputs(tested, 10_000)
        yield "release, nothing new, s", tested.run("release")[0]


def use_one_core() -> None:
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def grade_class(tested: Tested, jobs: int) -> tuple[float, float, float]:
    """Grade a class in `jobs` jobs; return seconds: total, CPU, until the first result."""
    out = Path(mkdtemp(dir=tested.work), "results")  # in a new folder all are graded again
    words = ["--class", str(tested.work / "class"), "--jobs", str(jobs), "--out", str(out)]
    start, until_first = perf_counter(), list[float]()

    def look(process: Process) -> None:
        while process.poll() is None and not any(out.glob("[!.]*.json")):
            sleep(0.01)
        until_first.append(perf_counter() - start)

    pinned = use_one_core if jobs == 1 else None
    seconds, cpu = tested.run("grade", *words, look=look, preexec_fn=pinned)
    return seconds, cpu, until_first[0]


def measure_outputs(tested: Tested, count: int) -> Iterator[tuple[str, float]]:
    """Measure making pages and gradebook for `count` copies of the class's results."""
    book = next(tested.work.glob("*/results.class.jsonl"))
    lines = [msgspec.json.decode(line) for line in book.read_bytes().splitlines()]
    names = {f"student-{number:05}": lines[number % len(lines)] for number in range(count)}
    results = Path(mkdtemp(dir=tested.work), "many")
    results.mkdir()
    for name, line in names.items():
        os.link(book.with_name("results") / f"{line['name']}.json", results / f"{name}.json")
    rows = b"\n".join(msgspec.json.encode(line | {"name": name}) for name, line in names.items())
    results.with_suffix(".class.jsonl").write_bytes(rows + b"\n")
    results.with_name("roster.csv").write_text("\n".join(["Email address", *names]), "utf-8")
    results.with_name("class.toml").write_text('roster = "roster.csv"\nresults = "many"\n', "utf-8")
    pages, most = measure_memory(tested, "dashboard", str(results))
    yield f"pages and gradebook of {count}, MB at most", most
    gradebook, _ = tested.run("class", "marks", str(results.parent))
    yield f"pages and gradebook of {count}, s", pages + gradebook
    shutil.rmtree(results.parent)


def watch_todo_4(tested: Tested) -> Process:
    """Start `check --watch`, and wait for its first result."""
    words = ["check", "--todo", "4", "--watch"]
    process = tested.start(*words, cwd=tested.work / "tree", stdout=subprocess.PIPE)
    read_until(process, "Watching")
    return process


def read_until(process: Process, start: str) -> None:
    assert process.stdout is not None
    next(line for line in process.stdout if line.startswith(start))


def measure_save(tree: Path, watch: Process) -> float:
    """Save a new comment inside TODO 4; return the seconds until its points are shown."""
    path = tree / "mini_engine" / "solver.py"
    text = path.read_text(encoding="utf-8").replace("    # END TODO 4", "    #\n    # END TODO 4")
    start = perf_counter()
    path.write_text(text, encoding="utf-8")
    read_until(watch, "TODO 4:")
    return perf_counter() - start


def tabulate(found: dict[str, dict[str, list[float]]], title: str) -> Table:
    """Return a row for each figure, with the ratios of the rounds if there are two kits."""
    ours, *others = found
    table = Table("figure", *found, *(f"{ours} / {name}" for name in others), title=title)
    for figure, values in found[ours].items():
        pairs = (zip(values, found[name][figure], strict=True) for name in others)
        ratios = [[one / other for one, other in each] for each in pairs]
        table.add_row(figure, *map(write_range, [*(found[n][figure] for n in found), *ratios]))
    return table


def write_range(values: list[float]) -> str:
    return "  ".join(f"{each:.2f}" for each in (min(values), median(values), max(values)))
