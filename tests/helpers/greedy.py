"""Measure what a fork bomb, a sleeper and a memory hog in a class of twelve cost the other nine.

Wall time says little on a busy machine, so processor time counts: that of the judge, the warm
process and all children together. The class is graded with the three and without, in turns, and the
least of each submission counts.
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
    """The cost of one grade: its judge, warm process and children; `memory` of the largest one."""

    cpu: float  # s
    seconds: float
    memory: float  # MB
    points: int


def make_greedy(folder: Path, code: str) -> None:
    """Copy the solution, with this code in every TODO."""
    shutil.copytree(KIT / "solution", folder, ignore=shutil.ignore_patterns("__pycache__"))
    fill_every_todo(folder, code)


def measure_grade(folder: Path) -> Cost:
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


def grade_all(folders: list[Path]) -> dict[str, Cost]:
    """Grade them, as many at a time as there are cores; return the cost of each."""
    with ThreadPoolExecutor(CORES) as pool:
        costs = pool.map(measure_grade, folders)
        return {each.name: cost for each, cost in zip(folders, costs, strict=True)}


def compare(rounds: int) -> tuple[dict[str, list[Cost]], dict[str, list[Cost]]]:
    """Return the costs of each round by submission, without the three and with them."""
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
                    for name, cost in grade_all(folders).items():
                        found.setdefault(name, []).append(cost)
    finally:
        os.sched_setaffinity(0, before)
    return without, together


def least_cpu(costs: list[Cost]) -> float:
    return min(each.cpu for each in costs)
