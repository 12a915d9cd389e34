"""Run the grading of a class in processes of this machine; `cluster` runs it on a cluster.

Both run the same function on the same packages. A package that ends its process does not affect
others.
"""

import time
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from functools import cache
from itertools import count
from queue import SimpleQueue
from threading import Event
from typing import Protocol, Self

from grader.classroom.job import JOB, SIDE_BY_SIDE
from grader.errors import Stop
from grader.intake.found import Package
from grader.judge.grade import grade
from grader.judge.task import Options
from grader.judge.wall.children import Worker, start_worker
from grader.judge.wall.outer import GRADING, Exceeded, Failed, Lost, WatchedProcess
from grader.judge.wall.starting import count_cores
from grader.judge.wall.workplace import work_folder
from grader.report.files import as_json

AHEAD = 2  # packed submissions that wait, for each one being graded
FIRST_SECONDS = 5.0  # s that a process waits for the first result
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
    return start_worker(count=SIDE_BY_SIDE)


class Executor(Protocol):
    """Processes that grade, on this machine or on others."""

    def capacity(self) -> int:
        """Return how many submissions to queue at once."""
        ...

    def submit(self, package: Package) -> "Future[Answer]": ...


class ExecutorFailed(Stop):
    """Raised if the executor cannot go on; says why and what to do."""


class Pool:
    """Processes of this machine; each grades one submission after another, within its limits.

    The first submission runs two checks at a time, while one process waits: its result comes early.
    The last ones do too, because some processes have nothing to grade then.
    """

    module = JOB
    work = staticmethod(grade_package)
    allowance = GRADING

    def __init__(self, options: Options, jobs: int) -> None:
        self.options, self.jobs = options, jobs or count_cores()

    def __enter__(self) -> Self:
        self.processes = [WatchedProcess(self.module) for _ in range(self.jobs)]
        self.free: SimpleQueue[WatchedProcess] = SimpleQueue()
        for each in self.processes:
            self.free.put(each)
        self.threads = ThreadPoolExecutor(self.jobs)
        self.waiting: SimpleQueue[Package] = SimpleQueue()
        self.numbers = count()  # of submissions, as they begin
        self.has_first = Event()
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        self.threads.shutdown(wait=kind is None, cancel_futures=True)
        for each in self.processes:
            each.close()
        self.threads.shutdown()

    def capacity(self) -> int:
        return self.jobs * (1 + AHEAD)

    def submit(self, package: Package) -> "Future[Answer]":
        self.waiting.put(package)
        return self.threads.submit(self.grade_next)

    def grade_next(self) -> Answer:
        """Grade the next submission in a free process."""
        package, number, process = self.waiting.get(), next(self.numbers), self.free.get()
        is_last = number >= self.jobs and self.waiting.qsize() < self.jobs
        try:
            if self.jobs > 1 and (number == 0 or is_last):
                return self.grade_side_by_side(package, process)
            if 0 < number == self.jobs - 1:
                process.begin()
                self.has_first.wait(FIRST_SECONDS)
            return self.grade(package, process, self.options)
        finally:
            self.has_first.set()
            self.free.put(process)

    def grade_side_by_side(self, package: Package, process: WatchedProcess) -> Answer:
        """Grade one submission, two checks at a time.

        The limits are those of one check at a time: a grade that reaches one is repeated so.
        """
        with suppress(Exceeded):
            return self.grade(package, process, replace(self.options, jobs=SIDE_BY_SIDE))
        return self.grade(package, process, self.options)

    def grade(self, package: Package, process: WatchedProcess, options: Options) -> Answer:
        """Grade one submission; repeat it once if the process ended."""
        for _ in range(2):
            with suppress(Lost):
                return process.call(self.allowance, Answer, self.work, package, options)
        raise Failed("it ended the grader's own process, twice: please report it")
