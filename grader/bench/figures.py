"""Measure what grading costs: a student's wait, a full grade, the walls around it, a class.

All figures are measured in turns, so that a slow minute of the machine slows all of them.
"""

import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory, mkdtemp
from time import perf_counter

import psutil
from rich.console import Console
from rich.table import Table

from grader.bank.members import members
from grader.judge.grade import KIT

GRADER = [sys.executable, "-m", "grader"]


def bench(rounds: int, size: int, console: Console) -> None:
    """Print the figures of some rounds; `size` is the number of submissions in the class."""
    found: dict[str, list[float]] = {}
    with TemporaryDirectory(prefix="bench-") as temporary:
        tree, class_folder = Path(temporary, "tree"), Path(temporary, "class")
        shutil.copytree(KIT / "solution", tree, ignore=shutil.ignore_patterns("__pycache__"))
        make_class(class_folder, size)
        with watch_todo_4(tree) as watch:
            for _ in range(rounds):
                for name, value in measure_all(tree, class_folder, watch):
                    found.setdefault(name, []).append(value)
    table = Table("figure", "min", "median", "max", title=f"{rounds} rounds, {size} in the class")
    for name, values in found.items():
        table.add_row(name, *(f"{each:.2f}" for each in (min(values), median(values), max(values))))
    console.print(table)


def make_class(folder: Path, size: int) -> None:
    """Build wrong and right members of the bank, spread over all of it."""
    chosen = [each for each in members(KIT) if each.kind in ("wrong", "right")]
    for number in range(size):
        member = chosen[number * len(chosen) // size]
        member.build(KIT, folder / f"{number:04}-{member.name}")


def measure_all(
    tree: Path, class_folder: Path, watch: "subprocess.Popen[str]"
) -> Iterator[tuple[str, float]]:
    """Measure each figure once."""
    yield "check --todo 4, s", run_grader("check", "--todo", "4", tree=tree)
    yield "check --watch, after a save, s", measure_save(tree, watch)
    yield "full grade, s", run_grader("grade", str(tree))
    used, used_inside = grade_solution(), grade_solution("--inside")
    yield "processor time of a full grade, s", used
    yield "isolation: that, divided by the time in one process", used / used_inside
    yield "a class on one core, s per submission", grade_class(class_folder, 1)
    yield "a class on two cores, s per submission", grade_class(class_folder, 2)


def run_grader(*arguments: str, tree: Path = KIT, cores: int = 0) -> float:
    """Run a command of the grader on `cores` cores; return the seconds it took."""
    start = perf_counter()
    process = psutil.Popen([*GRADER, *arguments], cwd=tree, stdout=subprocess.DEVNULL)
    if cores and hasattr(process, "cpu_affinity"):  # macOS has no such thing
        process.cpu_affinity(process.cpu_affinity()[:cores])
    assert process.wait() == 0, arguments
    return perf_counter() - start


def grade_class(folder: Path, cores: int) -> float:
    """Grade a class on `cores` cores; return the seconds that each submission took."""
    out = mkdtemp(dir=folder.parent)  # in a new folder all are graded again
    class_ = ["--class", str(folder), "--jobs", str(cores), "--out", out]
    return run_grader("grade", *class_, cores=cores) / len(list(folder.iterdir()))


@contextmanager
def watch_todo_4(tree: Path) -> Iterator["subprocess.Popen[str]"]:
    """Start a `check --watch` that has shown its first result."""
    command = [*GRADER, "check", "--todo", "4", "--watch"]
    with subprocess.Popen(command, cwd=tree, stdout=subprocess.PIPE, text=True) as process:
        read_until(process, "Watching")
        try:
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


def grade_solution(*options: str) -> float:
    """Grade the solution once; return the processor seconds that took."""
    command = [sys.executable, "-m", "grader.bench.one_process", *options]
    done = subprocess.run(command, cwd=KIT, capture_output=True, check=True, text=True)
    return float(done.stdout.split()[-1])  # pygame writes a line first
