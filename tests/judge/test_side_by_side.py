"""Test that running several checks at a time changes no result."""

from dataclasses import replace

import msgspec
import pytest
from conftest import HandIn
from edited_trees import set_regions

from grader.bank.verify import shared_worker
from grader.judge.budget import Budget
from grader.judge.grade import grade
from grader.judge.jobs import jobs_of
from grader.judge.loop import order_starts
from grader.judge.result import CheckResult
from grader.judge.rubric import load_rubric
from grader.judge.task import Options, shipped_reference

WRONG = "        keep_vel = keep_omega = 1 - self.linear_damping * dt"
ENDLESS = "        while True:\n            pass"
WORLD = "mini_engine/world.py"


@pytest.mark.parametrize("jobs", [2, pytest.param(3, marks=pytest.mark.soak)])
def test_results_are_the_same_and_come_in_order(hand_in: HandIn, jobs: int):
    tree = set_regions(hand_in("solution"), WORLD, {"5": WRONG})
    told: dict[int, list[CheckResult]] = {1: [], jobs: []}
    results = [
        grade(
            tree,
            Options(
                shipped_reference(),
                only=frozenset({"5", "8a"}),
                trusted=True,
                jobs=number,
                progress=told[number].append,
            ),
            shared_worker(),
        )
        for number in told
    ]
    first, second = map(msgspec.json.encode, results)
    assert first == second
    assert told[1] == told[jobs]
    assert 0 < results[0].points < results[0].max_points


def test_a_property_starts_second_in_its_todo():
    todos = [todo for todo in load_rubric().todos if todo.id in ("3", "4")]
    started = order_starts([job for todo in todos for job in jobs_of(todo)])
    for todo in todos:
        kinds = [job.check.kind for job in started if job.todo == todo]
        assert kinds[0] == "unit" and kinds[1] == "property"
    assert [job.todo.id for job in started] == sorted(job.todo.id for job in started)


@pytest.mark.soak
def test_a_todo_has_the_same_time_beside_others(hand_in: HandIn):
    tree = set_regions(hand_in("solution"), WORLD, {"5": ENDLESS})
    alone = Options(shipped_reference(), only=frozenset({"5"}), trusted=True)
    first, second = (grade(tree, options) for options in (alone, replace(alone, jobs=3)))
    assert first == second and first.points == 0


def test_a_copy_of_a_budget_is_counted_once():
    budget = Budget()
    budget.cpu["5"] = 3.0
    before = budget.copy()
    after = before.copy()
    after.cpu["5"] += 8.0
    after.rest["5"] += 1.0
    budget.cpu["5"] += 1.0
    assert before.allowance("5") == budget.allowance("5")
    budget.add("5", before, after)
    assert (budget.cpu["5"], budget.rest["5"]) == (12.0, 1.0)
    assert before.allowance("5") != budget.allowance("5")
