"""What a fork bomb, a sleeper and a memory hog in a class of twelve cost the other nine.

Time that passes says little on a busy machine. So what counts is the processor time of each
submission: that of its judge, of the warm process and of all its children together. The class is
graded with the three and without, in turns, and of each submission the least counts.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table

from grader.bank.members import fill_every_todo
from grader.judge.grade import KIT

CLASS, CORES = 12, 2
MOST_CPU = 120.0  # s, of one submission: see grader/judge/budget.py
MOST_MORE = 1.1  # times as much as without the three
GREEDY = {  # in the place of every TODO
    "fork bomb": """
import os
while True:
    try:
        os.fork()
    except OSError:
        pass
""",
    "sleeper": """
import ctypes
ctypes.CDLL(None).usleep(7_000_000)
""",
    "memory hog": """
held = []
while True:
    try:
        held.append(bytearray(1 << 24))
    except MemoryError:
        pass
""",
}
ONE = """
import sys
from pathlib import Path
from grader.judge.grade import Options, grade, shipped_reference
print(grade(Path(sys.argv[1]), Options(shipped_reference(), trusted=True)).points)
"""


@dataclass(frozen=True)
class Cost:
    """Of one grade, with its warm process and all children; `memory` is of the largest process."""

    cpu: float  # s
    seconds: float
    memory: float  # MB
    points: int


def make_greedy(folder: Path, code: str) -> None:
    """The solution, with this code in every TODO."""
    shutil.copytree(KIT / "solution", folder, ignore=shutil.ignore_patterns("__pycache__"))
    fill_every_todo(folder, code)


def cost_of(folder: Path) -> Cost:
    """Grade it in a process of its own, whose descendants are all waited for."""
    start = time.monotonic()
    process = subprocess.Popen(
        [sys.executable, "-c", ONE, str(folder)],
        cwd=KIT,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    assert process.stdout is not None
    points = int(process.stdout.read().split()[-1])
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    seconds = time.monotonic() - start
    return Cost(used.ru_utime + used.ru_stime, seconds, used.ru_maxrss / 1024, points)


def graded(folders: list[Path]) -> dict[str, Cost]:
    """All of them, so many at a time as there are cores."""
    with ThreadPoolExecutor(CORES) as pool:
        costs = pool.map(cost_of, folders)
        return {each.name: cost for each, cost in zip(folders, costs, strict=True)}


def compare(rounds: int) -> tuple[dict[str, list[Cost]], dict[str, list[Cost]]]:
    """The costs of each round, by submission: without the three, and with them."""
    without: dict[str, list[Cost]] = {}
    together: dict[str, list[Cost]] = {}
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, sorted(before)[:CORES])
    try:
        with tempfile.TemporaryDirectory(prefix="greedy-") as temporary:
            bad, good = [], []
            for name, code in GREEDY.items():
                bad.append(Path(temporary, name))
                make_greedy(bad[-1], code)
            for number in range(CLASS - len(GREEDY)):
                good.append(Path(temporary, f"neighbour {number + 1}"))
                shutil.copytree(KIT / "solution", good[-1])
            third = len(good) // len(bad)
            every = []
            for number, each in enumerate(bad):
                every += [each, *good[number * third : (number + 1) * third]]
            for _ in range(rounds):
                for folders, found in ((good, without), (every, together)):
                    for name, cost in graded(folders).items():
                        found.setdefault(name, []).append(cost)
    finally:
        os.sched_setaffinity(0, before)
    return without, together


def least(costs: list[Cost]) -> float:
    return min(each.cpu for each in costs)


def bench_greedy(rounds: int, console: Console) -> None:
    """Print what the three cost, and how much more each of the others did beside them."""
    without, together = compare(rounds)
    table = Table("submission", "points", "processor s", "without the three", "ratio", "MB")
    table.title = f"a class of {CLASS} on {CORES} cores, the least of {rounds} rounds"
    for name, costs in together.items():
        alone = f"{least(without[name]):.2f}" if name in without else ""
        ratio = f"{least(costs) / least(without[name]):.3f}" if name in without else ""
        memory = max(each.memory for each in costs)
        points = str(costs[0].points)
        table.add_row(name, points, f"{least(costs):.2f}", alone, ratio, f"{memory:.0f}")
    console.print(table)
