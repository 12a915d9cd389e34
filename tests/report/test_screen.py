"""Test the first screen of `check`: 16 lines on one TODO, the cause first."""

import io
import os
import shutil
import subprocess
import sys

import pytest
from rich.console import Console

from grader.judge.numbers import shorten_both, shorten_numbers
from grader.judge.result import CheckResult, Result, State, TodoResult, Where, state_of
from grader.judge.task import KIT
from grader.report.screen import LINES, Screen
from grader.report.terminal import choose_todo

LONG = "as much friction at a slip of 300 px/s as at 3000, and twice as much with jn twice as much "
HALF = "Half of it is missing: add the other half, too"


def failed(number: int, state: State = "not yet", **words: str) -> CheckResult:
    texts = {"ran": f"it {number}", "expected": "1", "got": f"{number}", **words}
    where = Where("mini_engine/solver.py", 85)
    return CheckResult(f"c{number}", f"Check {number}", "unit", state, 0, 1, where=where, **texts)


def todo(id: str, *checks: CheckResult) -> TodoResult:
    points = sum(check.points for check in checks)
    state = state_of(list(checks))
    return TodoResult(id, f"Task {id}", state, points, len(checks), None, list(checks))


def passed_todo(id: str) -> TodoResult:
    return todo(id, CheckResult("c", "Check", "unit", "passed", 1, 1))


def fresh(id: str) -> TodoResult:
    return todo(id, CheckResult("c", "Check", "unit", "not started", 0, 1))


def screen(*todos: TodoResult, width: int = 80, touched: set[str] | None = None) -> list[str]:
    out = io.StringIO()
    console = Console(file=out, width=width, highlight=False, markup=False)
    result = Result(1, "mine", 0, 0, 0, [], []).with_todos(list(todos))
    Screen(console).show(result, touched or set())
    return out.getvalue().splitlines()


@pytest.mark.parametrize("width", [80, 60, 200])
@pytest.mark.parametrize("times", [1, 3, 20])
def test_it_has_sixteen_lines_at_most_and_says_the_cause_in_full(times: int, width: int):
    checks = [failed(n, ran=LONG * times, expected=LONG * times) for n in range(8)]
    checks[3] = failed(3, ran=LONG * times, meaning=f"{HALF}.")
    todos = [passed_todo("1"), todo("2", *checks), todo("3", failed(9)), fresh("4"), fresh("5")]
    lines = screen(*todos, width=width)
    assert len(lines) <= LINES and max(map(len, lines)) <= min(width, 80)
    words = " ".join(" ".join(lines).split())
    assert f"{HALF}." in words
    assert "Look at mini_engine/solver.py:85, TODO 2" in words and "PASSED 1" in words
    assert "NOT YET 3" in words and "NOT STARTED 4 5" in words and "--all" in words


def test_one_todo_is_told_and_its_other_failures_have_a_line_each():
    lines = screen(todo("2", failed(1), failed(2), failed(3)), todo("3", failed(4)))
    assert [line for line in lines if "We ran" in line] == ["    We ran    it 1"]
    assert {"  Check 2  (0 / 1)", "  Check 3  (0 / 1)"} <= set(lines)
    assert not any("Check 4" in line for line in lines)
    assert "    We ran    it 4" in screen(todo("2", failed(1)), todo("3", failed(4)), touched={"3"})


def test_given_code_comes_first_and_then_what_has_a_name():
    named = failed(2, meaning="A sign.")
    given = CheckResult("c", "Given", "unit", "not yet", 0, 1, where=Where("a.py", 1, given=True))
    assert screen(todo("2", failed(1), named, given))[1] == "  Given  (0 / 1)"
    assert screen(todo("2", failed(1), named))[1] == "  Check 2  (0 / 1)"


def test_a_loop_that_never_ends_is_said_once():
    ways = (
        "it used up its 5 s of",
        "it used up its 1 s of",
        "not run: the checks before it used up",
    )
    lines = screen(todo("2", *(failed(n, "error", got=way) for n, way in enumerate(ways))))
    assert "  3 checks  (0 / 3)" in lines and sum("used up" in line for line in lines) == 1


def test_what_is_next_where_nothing_fails():
    result = Result(1, "mine", 0, 0, 0, [], []).with_todos(
        [passed_todo("1"), fresh("2"), fresh("3")]
    )
    assert choose_todo(result) is result.todos[1]
    assert choose_todo(result.with_todos([passed_todo("1")])) is None


@pytest.mark.soak
@pytest.mark.skipif(shutil.which("make") is None, reason="there is no make")
def test_make_says_nothing_of_its_own(hand_in):
    tree = hand_in("starter")
    settings = {"PYTHONPATH": str(KIT), "COLUMNS": "80"}
    command = ["make", "check", "TODO=8a", f"PYTHON={sys.executable}"]
    done = subprocess.run(
        command, cwd=tree, env={**os.environ, **settings}, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("NOT STARTED 8a") and "make hint TODO=8a" in done.stdout


# ---------------------------------------------------------------- numbers


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (f"x = {10**71} px", "x = 1e+71 px"),
        (f"{1e70:.3f} px/s", "1e+70 px/s"),
        (f"{10**400}", "a number of 401 digits"),
        ("(7.9e-33, 5.0)", "(0, 5.0)"),
        ("(-0.000, -0.5)", "(0.000, -0.5)"),
        ("0.30000000000000004", "0.3"),
        (
            "TODO 7a at 1/120 s, 2026 px, 3.2e-05, -12.5%",
            "TODO 7a at 1/120 s, 2026 px, 3.2e-05, -12.5%",
        ),
        ("mini_engine/world.py:68", "mini_engine/world.py:68"),
    ],
)
def test_a_number_has_the_digits_that_tell_something(text: str, told: str):
    assert shorten_numbers(text) == told


@pytest.mark.parametrize(
    ("expected", "got"),
    [("0.3 px", "0.30000000000000004 px"), ("0 px", "7.9e-33 px"), ("0.0 px", "-0.0 px")],
)
def test_what_differs_is_told_apart(expected: str, got: str):
    first, second = shorten_both(expected, got)
    assert first != second
