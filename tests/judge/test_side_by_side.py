"""Test that running several checks at a time changes no result."""

import shutil
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest

from grader.bank.verify import shared_worker
from grader.judge.budget import Budget
from grader.judge.grade import grade
from grader.judge.result import CheckResult
from grader.judge.task import KIT, Options, shipped_reference
from grader.source.regions import replace_regions

WRONG = "        keep_vel = keep_omega = 1 - self.linear_damping * dt"
ENDLESS = "        while True:", "            pass"


def break_todo_5(folder: Path, code: tuple[str, ...]) -> Path:
    """Return the solution with other code in TODO 5."""
    shutil.copytree(KIT / "solution", folder, ignore=shutil.ignore_patterns("notebooks"))
    path = folder / "mini_engine" / "world.py"
    path.write_text(replace_regions(path.read_text("utf-8"), {"5": code}), "utf-8")
    return folder


@pytest.mark.parametrize("jobs", [2, pytest.param(3, marks=pytest.mark.soak)])
def test_results_are_the_same_and_come_in_order(tmp_path: Path, jobs: int):
    tree = break_todo_5(tmp_path / "tree", (WRONG,))
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


@pytest.mark.soak
def test_a_todo_has_the_same_time_beside_others(tmp_path: Path):
    tree = break_todo_5(tmp_path / "tree", ENDLESS)
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
