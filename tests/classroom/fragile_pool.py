"""Pools of processes that grade nothing and may crash. The file is small, since each process loads
it."""

import os
import signal
import time

from grader.classroom.executor import Answer, Pool
from grader.intake.found import Package
from grader.judge.result import Result, TodoResult
from grader.judge.task import Options
from grader.judge.wall.outer import Allowance
from grader.report.files import as_json


def result_of(package: Package) -> bytes:
    """Return a result that depends on the files and the name, like a real one."""
    points = len(package.files)
    todo = TodoResult("8a", "", "passed" if points else "not yet", points, 2, None, [])
    return as_json(Result(1, package.name, points, 2, 0, ["processes"], [todo]))


def stand_in(package: Package, options: Options) -> Answer:
    """Replace grading by effects of some submissions on their process."""
    kind, held = package.name.partition("-")[0], []
    if kind.startswith("killer"):
        os.kill(os.getpid(), signal.SIGKILL)
    if kind == "raiser":
        raise ValueError("the judge fell over")
    if kind == "worker" and os.fork():
        os.wait()  # another process does the work
    while kind in ("looper", "worker"):
        pass
    while kind == "eater":
        held.append(bytearray(b"x") * (1 << 20))
        time.sleep(0.001)
    if kind == "gulper":
        held.append(bytes(1 << 40))
    if kind == "sleeper":
        time.sleep(1000)
    print("what is printed is in no message", flush=True)
    return result_of(package), 0.05


class FragilePool(Pool):
    module = "grader.judge.wall.outer"
    work = staticmethod(stand_in)
    allowance = Allowance("grading it", cpu=1, memory=200)


def count_checks(package: Package, options: Options) -> Answer:
    """Return how many checks may run at a time; with more than one, a greedy one never ends."""
    while package.name == "greedy" and options.jobs > 1:
        pass
    return str(options.jobs).encode(), 0.05


class CountingPool(FragilePool):
    work = staticmethod(count_checks)
    allowance = Allowance("grading it", cpu=0.5)


class ImpatientPool(FragilePool):
    allowance = Allowance("grading it", cpu=100, seconds=1)
