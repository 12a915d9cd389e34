"""A pool that reads the points in a submission. The file is small, since each process loads it."""

import re
from concurrent.futures import Future
from contextlib import AbstractContextManager

from grader.classroom.executor import Answer
from grader.intake.found import Package
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.task import Options
from grader.report.files import as_json

FULL = 20


def stand_in(package: Package, options: Options) -> Answer:
    """Return a result with the number in integrators.py as its points."""
    text = dict(package.files)["integrators.py"].decode()
    found = re.search(r"points = (\d+)", text)
    points = int(found[1]) if found else 0
    state = "passed" if points == FULL else "not yet"
    check = CheckResult("a", "A title", "unit", state, points, FULL, "ran", "that", "this")
    todo = TodoResult("8a", "An integrator", state, points, FULL, None, [check])
    return as_json(Result(1, package.name, points, FULL, 0, ["processes"], [todo])), 0.5


class Inline(AbstractContextManager["Inline"]):
    """Finds the points in this process; stops, as by Ctrl-C, after `patience` grades."""

    def __init__(self, patience: int = 1000) -> None:
        self.patience = patience

    def __exit__(self, *_: object) -> None:
        pass

    def capacity(self) -> int:
        return 1

    def submit(self, package: Package) -> "Future[Answer]":
        self.patience -= 1
        if self.patience < 0:
            raise KeyboardInterrupt
        future: Future[Answer] = Future()
        future.set_result(stand_in(package, Options()))
        return future
