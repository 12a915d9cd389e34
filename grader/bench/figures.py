"""Measure what grading costs: a student's wait, a full grade, and a class.

All figures are measured in turns, those of another checkout too, so that a slow minute of the
machine slows all of them.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory, mkdtemp
from time import perf_counter, sleep
from typing import Any, NamedTuple

from rich.console import Console
from rich.table import Table

from grader.bank.members import list_members
from grader.judge.task import KIT


class Tested(NamedTuple):
    """A kit that is measured, and the folder for what it writes."""

    kit: Path
    work: Path

    def start(self, *words: str, cwd: Path | None = None, **how: Any) -> "subprocess.Popen[str]":
        """Start a command of this kit's grader."""
        environment = os.environ | {"PYTHONPATH": str(self.kit)}
        usual: dict[str, Any] = {"stdout": subprocess.DEVNULL, "cwd": cwd or self.kit, "text": True}
        command = [sys.executable, "-m", "grader", *words]
        return subprocess.Popen(command, env=environment, **usual | how)

    def run(self, *words: str, **how: Any) -> tuple[float, float]:
        """Run a command, which must succeed; return its seconds, and those of the processor.

        Only Unix has the latter.
        """
        start, process = perf_counter(), self.start(*words, **how)
        cpu = 0.0
        if hasattr(os, "wait4"):
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            cpu = used.ru_utime + used.ru_stime
        assert process.wait() == 0, words
        return perf_counter() - start, cpu


def bench(rounds: int, size: int, console: Console, against: Path | None = None) -> None:
    """Print the figures of some rounds, with those of another checkout beside them."""
    kits = {"this kit": KIT} | ({str(against): against.resolve()} if against else {})
    found: dict[str, dict[str, list[float]]] = {name: {} for name in kits}
    with TemporaryDirectory(prefix="bench-") as temporary, ExitStack() as stack:
        turns: list[tuple[str, Tested, subprocess.Popen[str]]] = []
        for name, kit in kits.items():
            tested = Tested(kit, Path(temporary, str(len(turns))))
            prepare(tested, size)
            turns.append((name, tested, stack.enter_context(watch_todo_4(tested))))
        for _ in range(rounds):
            measured = [measure(each, watch, size) for _, each, watch in turns]
            for figures in zip(*measured, strict=True):
                for (name, _, _), (figure, value) in zip(turns, figures, strict=True):
                    found[name].setdefault(figure, []).append(value)
            turns.reverse()
    title = f"{rounds} rounds, {size} in the class: minimum, median, maximum"
    console.print(tabulate(found, title))


def prepare(tested: Tested, size: int) -> None:
    """Lay out a kit's own solution, and a class of this kit's bank, spread over all of it."""
    without = shutil.ignore_patterns("__pycache__")
    shutil.copytree(tested.kit / "solution", tested.work / "tree", ignore=without)
    chosen = [each for each in list_members(KIT) if each.kind in ("wrong", "right")]
    for number in range(size):
        member = chosen[number * len(chosen) // size]
        member.build(KIT, tested.work / "class" / f"{number:04}-{member.name}")


def measure(
    tested: Tested, watch: "subprocess.Popen[str]", size: int
) -> Iterator[tuple[str, float]]:
    """Measure each figure once."""
    tree = tested.work / "tree"
    seconds, cpu = tested.run("grade", str(tree))
    yield "full grade on all cores, s", seconds
    yield "full grade, processor s", cpu
    yield "full grade on one core, s", tested.run("grade", str(tree), **on_one_core())[0]
    yield "check --todo 4, s", tested.run("check", "--todo", "4", cwd=tree)[0]
    yield "check --watch, after a save, s", measure_save(tree, watch)
    one, _ = grade_class(tested, 1)
    two, first = grade_class(tested, 2)
    yield "class on one core, s per submission", one / size
    yield "class, two jobs, s per submission", two / size
    yield "class, s until the first result", first


def on_one_core() -> dict[str, Any]:
    """Return the prefix that starts a command on one core, if the system allows it."""
    if not hasattr(os, "sched_setaffinity"):
        return {}
    return {"preexec_fn": partial(os.sched_setaffinity, 0, {min(os.sched_getaffinity(0))})}


def grade_class(tested: Tested, jobs: int) -> tuple[float, float]:
    """Grade a class on as many cores; return the seconds in all and until the first result."""
    out = Path(mkdtemp(dir=tested.work), "results")  # in a new folder all are graded again
    words = ["--class", str(tested.work / "class"), "--jobs", str(jobs), "--out", str(out)]
    start = perf_counter()
    process = tested.start("grade", *words, **(on_one_core() if jobs == 1 else {}))
    while process.poll() is None and not any(out.glob("[!.]*.json")):
        sleep(0.01)
    first = perf_counter() - start
    assert process.wait() == 0, words
    return perf_counter() - start, first


@contextmanager
def watch_todo_4(tested: Tested) -> Iterator["subprocess.Popen[str]"]:
    """Start a `check --watch` that has shown its first result."""
    words = ["check", "--todo", "4", "--watch"]
    with tested.start(*words, cwd=tested.work / "tree", stdout=subprocess.PIPE) as process:
        try:
            read_until(process, "Watching")
            yield process
        finally:
            process.terminate()


def read_until(process: "subprocess.Popen[str]", start: str) -> None:
    assert process.stdout is not None
    if not any(line.startswith(start) for line in process.stdout):
        raise RuntimeError(f"check --watch ended before it said: {start}")


def measure_save(tree: Path, watch: "subprocess.Popen[str]") -> float:
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
