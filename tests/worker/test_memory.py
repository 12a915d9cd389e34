"""Test that data kept from call to call is found and named."""

import importlib
import sys
from pathlib import Path

import pytest
from conftest import HandIn

from grader.bank.verify import shared_worker
from grader.judge.explain.meaning import Evidence, Failure, explain
from grader.judge.failures import REMEMBERS
from grader.judge.grade import grade
from grader.judge.result import CheckResult
from grader.judge.rubric import load_rubric
from grader.judge.task import Options, shipped_reference
from grader.source.definitions import Program
from grader.worker.memory import Memory

KEEPER = """
import math

last = 0.0
seen = []
table = {"a": [1, 2]}

class Counter:
    count = 0
    def step(self, by=[]):
        Counter.count += 1
        by.append(1)

def work(x, cache={}):
    return x

def honest(x):
    return [x, math.pi]
"""


@pytest.mark.parametrize(
    ("line", "names"),
    [
        ("k.last = 2.5", ["last"]),
        ("k.fresh = 1", ["fresh"]),
        ("k.seen.append(3)", ["seen"]),
        ("k.table['a'].append(3)", ["table"]),
        ("k.Counter().step()", ["Counter"]),
        ("k.work.calls = 1", ["work"]),
        ("k.work.__defaults__[0][3] = 4", ["work"]),
        ("k.honest(3)", []),
        ("thing = k.Counter(); thing.own = 3", []),
    ],
)
def test_a_changed_global_is_found_under_its_name(tmp_path: Path, line: str, names: list[str]):
    name = f"keeper{abs(hash(line))}"
    (tmp_path / f"{name}.py").write_text(KEEPER, encoding="utf-8")
    sys.path.insert(0, str(tmp_path))
    try:
        module = importlib.import_module(name)
        memory = Memory(str(tmp_path))
        exec(line, {"k": module})
        assert memory.changed() == [f"{name}.{each}" for each in names]
    finally:
        sys.path.remove(str(tmp_path))
        sys.modules.pop(name, None)


def failed_checks(tree: Path, todo: str) -> list[CheckResult]:
    options = Options(shipped_reference(), only=frozenset({todo}))
    (result,) = grade(tree, options, shared_worker()).todos
    return result.failed


def test_a_forbidden_change_is_not_called_a_memory(hand_in: HandIn):
    folder = hand_in("solution")
    path = folder / "mini_engine" / "contacts.py"
    text = path.read_text(encoding="utf-8")
    at = text.index("\n", text.index("# TODO 1")) + 1
    path.write_text(text[:at] + "    a.omega = 0.0\n" + text[at:], encoding="utf-8")
    failed = failed_checks(folder, "1")
    assert failed and not any(REMEMBERS in check.meaning for check in failed)


PROGRAM = """
memo, other = {}, {}

def helper(x):
    return memo.setdefault(x, x)

def other_helper(x):
    other[x] = x

class World:
    table = []
    def grow(self, dt):
        self.widen(dt)
        return helper(dt)
    def widen(self, dt):
        World.table.append(dt)
"""


def test_only_what_the_code_of_a_todo_runs_is_named():
    used = Program({Path("engine.py"): PROGRAM}).names_used("engine", "World.grow")
    assert used >= {"memo", "helper", "table", "widen", "grow"}
    assert not used & {"other", "other_helper"}
    failed = CheckResult("id", "title", "unit", "not yet", 0, 1, meaning="So.")
    told = explain(Failure(failed, Evidence(load_rubric().todos[0]), kept_names=["engine.memo"]))
    assert told.meaning.startswith("So. ") and "in memo:" in told.meaning
