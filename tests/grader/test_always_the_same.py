"""The same submission gives the same JSON, on an idle machine and a busy one (`make soak`)."""

import multiprocessing
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from grader.judge.grade import KIT, Options, grade, shipped_reference
from grader.report.files import as_json


@contextmanager
def busy_machine() -> Iterator[None]:
    """Every core has something else to do."""
    context = multiprocessing.get_context("spawn")
    hogs = [context.Process(target=count_for_ever) for _ in range(multiprocessing.cpu_count())]
    for hog in hogs:
        hog.start()
    try:
        yield
    finally:
        for hog in hogs:
            hog.kill()
            hog.join()


def count_for_ever() -> None:
    while True:
        pass


@pytest.mark.soak
@pytest.mark.parametrize("tree", ["solution", "starter"])
def test_twenty_grades_are_one(tree: str):
    options = Options(shipped_reference())
    idle = {as_json(grade(KIT / tree, options)) for _ in range(10)}
    with busy_machine():
        busy = {as_json(grade(KIT / tree, options)) for _ in range(10)}
    assert len(idle | busy) == 1
