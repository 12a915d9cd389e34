"""Run the grading of a class in processes of this machine; `cluster` has a cluster's.

Both run the same function on the same packages. A package that ends its process ends no other.
"""

import multiprocessing
import sys
import time
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from functools import cache
from typing import Protocol, Self

from grader.errors import Stop
from grader.intake.found import Package
from grader.judge.children import Worker, count_cores, start_worker
from grader.judge.grade import Options, grade
from grader.judge.processes import begin_process, end_all
from grader.judge.workplace import work_folder
from grader.report.files import as_json

AHEAD = 2  # submissions that wait, packed, for each one being graded
LOST = "the cluster is gone; what is graded stays, and the same command goes on from there"

Graded = tuple[bytes, float]  # a result as JSON, and the seconds it took


def grade_package(package: Package, options: Options) -> Graded:
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
    """Processes that grade, here or elsewhere."""

    def capacity(self) -> int:
        """Return how many submissions to have under way."""
        ...

    def submit(self, package: Package) -> "Future[Graded]": ...

    def restart(self) -> None:
        """Start anew after a process ended, and with it all that was under way."""

    def run_alone(self, package: Package) -> Graded:
        """Grade one of those that were under way then, with nothing beside it."""
        ...


class ExecutorFailed(Stop):
    """The executor cannot go on; the message says why and what to do."""


class Pool:
    work = staticmethod(grade_package)

    def __init__(self, options: Options, jobs: int) -> None:
        self.options, self.jobs = options, jobs or count_cores()
        if sys.platform == "win32":
            self.jobs = min(self.jobs, 61)  # Windows waits for no more at once

    def _start(self, jobs: int) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(jobs, multiprocessing.get_context("spawn"), begin_process)

    def __enter__(self) -> Self:
        self.processes = self._start(self.jobs)
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        if kind is not None:  # such as Ctrl-C
            under_way = multiprocessing.active_children()
            self.processes.shutdown(wait=False, cancel_futures=True)
            end_all(under_way)
        self.processes.shutdown(cancel_futures=True)

    def capacity(self) -> int:
        return self.jobs * (1 + AHEAD)

    def submit(self, package: Package) -> "Future[Graded]":
        try:
            return self.processes.submit(self.work, package, self.options)
        except BrokenProcessPool as error:
            broken: Future[Graded] = Future()
            broken.set_exception(error)
            return broken

    def restart(self) -> None:
        self.processes.shutdown()
        self.processes = self._start(self.jobs)

    def run_alone(self, package: Package) -> Graded:
        """Grade it in a pool of its own, which shows whether it is to blame."""
        with self._start(1) as executor:
            return executor.submit(self.work, package, self.options).result()
