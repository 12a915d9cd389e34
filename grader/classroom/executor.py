"""Run the grading of a class in processes of this machine; `cluster` runs it on a cluster.

Both run the same function on the same packages. A package that ends its process does not affect
others.
"""

import time
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from functools import cache
from queue import SimpleQueue
from typing import Protocol, Self

from grader.errors import Stop
from grader.intake.found import Package
from grader.judge.grade import grade
from grader.judge.task import Options
from grader.judge.wall.children import Worker, start_worker
from grader.judge.wall.outer import GRADING, Failed, Lost, WatchedProcess
from grader.judge.wall.starting import count_cores
from grader.judge.wall.workplace import work_folder
from grader.report.files import as_json

AHEAD = 2  # packed submissions that wait, for each one being graded
LOST = "the cluster is gone; what is graded stays, and the same command goes on from there"

Answer = tuple[bytes, float]  # a result as JSON, and the seconds it took


def grade_package(package: Package, options: Options) -> Answer:
    """Grade one submission, in a process of the pool or of a cluster."""
    start = time.monotonic()
    with work_folder() as work:
        result = grade(package.unpack(work), options, shared_worker())
    return as_json(result), time.monotonic() - start


@cache
def shared_worker() -> Worker:
    """Start the worker for all submissions that this process grades; it ends with the process."""
    return start_worker()


class Executor(Protocol):
    """Processes that grade, on this machine or on others."""

    def capacity(self) -> int:
        """Return how many submissions to queue at once."""
        ...

    def submit(self, package: Package) -> "Future[Answer]": ...


class ExecutorFailed(Stop):
    """Raised if the executor cannot go on; says why and what to do."""


class Pool:
    """Processes of this machine; each grades one submission after another, within its limits."""

    work = staticmethod(grade_package)
    allowance = GRADING

    def __init__(self, options: Options, jobs: int) -> None:
        self.options, self.jobs = options, jobs or count_cores()

    def __enter__(self) -> Self:
        self.processes = [WatchedProcess() for _ in range(self.jobs)]
        self.free: SimpleQueue[WatchedProcess] = SimpleQueue()
        for each in self.processes:
            self.free.put(each)
        self.threads = ThreadPoolExecutor(self.jobs)
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        self.threads.shutdown(wait=kind is None, cancel_futures=True)
        for each in self.processes:
            each.close()
        self.threads.shutdown()

    def capacity(self) -> int:
        return self.jobs * (1 + AHEAD)

    def submit(self, package: Package) -> "Future[Answer]":
        return self.threads.submit(self.grade, package)

    def grade(self, package: Package) -> Answer:
        """Grade one submission in a free process; repeat it once if the process ended."""
        process = self.free.get()
        try:
            for _ in range(2):
                with suppress(Lost):
                    return process.call(self.allowance, Answer, self.work, package, self.options)
            raise Failed("it ended the grader's own process, twice: please report it")
        finally:
            self.free.put(process)
