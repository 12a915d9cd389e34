"""Test the checks of the whole program: the TODOs each needs, and the mistakes it finds."""

import shutil
from collections.abc import Iterator
from pathlib import Path
from textwrap import dedent

import msgspec
import pytest

from grader.bank.members import put_regions
from grader.judge.grade import grading
from grader.judge.rubric import Rubric, Todo, load_rubric
from grader.judge.submission import handed_out
from grader.judge.task import KIT, Options
from grader.judge.wall.children import Worker, start_worker

WHOLE = next(todo for todo in load_rubric().todos if todo.id == "whole")
TASKS = [todo for todo in load_rubric().todos if todo.function]
TOGETHER = {  # TODOs that a check needs only if others are missing as well
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
    put_regions({todo.id: tuple(dedent(handed_out().stubs[todo.id]).splitlines())}, tree)
    options = Options(only=frozenset({"whole"}))
    with grading(tree, options, worker, without_needs()) as ours:
        (whole,) = ours.run().todos
    return {check.id for check in whole.checks if check.state != "passed"}


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
