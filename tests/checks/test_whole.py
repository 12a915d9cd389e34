"""Test the checks of the whole program: the TODOs each needs, and the mistakes it finds."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest

from grader.bank.members import patch
from grader.judge.grade import grading
from grader.judge.rubric import Rubric, Todo, load_rubric
from grader.judge.task import KIT, Options
from grader.judge.wall.children import Worker, start_worker

WHOLE = next(todo for todo in load_rubric().todos if todo.id == "whole")
TASKS = [todo for todo in load_rubric().todos if todo.function]
TOGETHER = {  # TODOs that a check needs only if others are missing as well
    "the_picture_shows_where_the_balls_are": {"1"},
    "the_pymunk_stack_falls_when_it_is_knocked_over": {"7a", "7d"},
}


@pytest.fixture(scope="module")
def worker() -> Iterator[Worker]:
    started = start_worker()
    yield started
    started.close()


def without_needs() -> Rubric:
    """Return the whole alone, with checks that run even if a TODO is unfinished."""
    checks = [msgspec.structs.replace(each, needs=[], guard=False) for each in WHOLE.checks]
    whole = msgspec.structs.replace(WHOLE, checks=checks)
    return Rubric([*TASKS, whole])


def find_failing(todo: Todo, work: Path, worker: Worker) -> set[str]:
    """Return the checks that fail with this TODO's stub instead of the solution's code."""
    tree = work / todo.id
    shutil.copytree(KIT / "solution", tree, ignore=shutil.ignore_patterns("notebooks", ".*"))
    for path in (KIT / "starter").rglob("*.py"):
        if f"# TODO {todo.id}:" in path.read_text(encoding="utf-8"):
            stub = work / "stub.py"
            stub.write_text(region_of(todo, path), encoding="utf-8")
            patch(stub, tree)
    options = Options(only=frozenset({"whole"}))
    with grading(tree, options, worker, without_needs()) as ours:
        (whole,) = ours.run().todos
    return {check.id for check in whole.checks if check.state != "passed"}


def region_of(todo: Todo, path: Path) -> str:
    """Return the lines of a region with its two markers, moved to the left edge."""
    lines = path.read_text(encoding="utf-8").splitlines()
    begin = next(n for n, line in enumerate(lines) if f"# TODO {todo.id}:" in line)
    end = next(n for n, line in enumerate(lines) if f"# END TODO {todo.id}" in line)
    indent = len(lines[begin]) - len(lines[begin].lstrip())
    return "\n".join(line[indent:] for line in lines[begin : end + 1]) + "\n"


@pytest.mark.soak
@pytest.mark.parametrize("todo", TASKS, ids=lambda todo: todo.id)
def test_a_check_needs_what_it_fails_without(todo: Todo, tmp_path: Path, worker: Worker):
    """Each needs exactly the TODOs without which it fails."""
    needing = {
        check.id
        for check in WHOLE.checks
        if todo.id in set(check.needs) - TOGETHER.get(check.id, set())
    }
    assert find_failing(todo, tmp_path, worker) == needing
