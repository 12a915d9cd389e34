"""Blame a check that is wrong itself, and not the submission."""

from pathlib import Path
from types import ModuleType

import pytest
from conftest import KIT

from grader.bank.verify import shared_worker
from grader.judge import jobs
from grader.judge.grade import grading
from grader.judge.rubric import Check, Rubric, Todo
from grader.judge.submission import CannotGrade
from grader.judge.task import Options, shipped_reference

HEAD = '''from grader.judge.lab import Lab


def mine(lab: Lab) -> None:
    """Mine"""
    lab.ran("one step")
    '''
WRONG = {
    "what is no function": 'lab.call("OMEGA")',
    "what is not there": 'lab.call("no_such_function")',
    "an error of its own": "[].append(1, 2)",
    "what is no argument": 'lab.call("rk4", object())',
    "an expectation that nothing meets": 'lab.want(False, "a", "b")',
}
RIGHT = '(end,) = lab.integrate("rk4", (1.0, 0.0), 0.1, [0.0])'


def grade_check(body: str, tree: Path, patched: pytest.MonkeyPatch) -> str:
    """Return the state of the check, or the sentence that refuses it."""
    checks = ModuleType("checks")
    exec(HEAD + body, vars(checks))
    patched.setattr(jobs, "load_checks", lambda todo: checks)
    check = Check("mine", 1, "unit")
    todo = Todo("8c", "Mine", "integrators", "integrators:rk4", "mine", [check])
    options = Options(shipped_reference(), trusted=True)
    try:
        with grading(tree, options, shared_worker(), Rubric([todo])) as run:
            return run.run().todos[0].checks[0].state
    except CannotGrade as error:
        return str(error)


@pytest.mark.parametrize(
    "name",
    [pytest.param(each, marks=() if n % 2 else pytest.mark.soak) for n, each in enumerate(WRONG)],
)
def test_a_check_that_the_right_code_fails_is_wrong(name: str, monkeypatch: pytest.MonkeyPatch):
    said = grade_check(WRONG[name], KIT / "solution", monkeypatch)
    assert said.startswith("the check mine in checks/mine")
    assert "is wrong: the right code fails it too. It ran: one step" in said


@pytest.mark.parametrize(
    "answer",
    [
        *("'far'", "1 / 0"),
        *(
            pytest.param(each, marks=pytest.mark.soak)
            for each in ("None", "(1.0, 'x')", "(1.0, 2.0, 3.0)")
        ),
    ],
)
def test_a_submission_that_fails_what_the_right_code_passes_is_to_blame(
    answer: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    wrong = f"def rk4(x, v, dt, accel):\n    return {answer}\n"
    (tmp_path / "integrators.py").write_text(wrong, encoding="utf-8")
    state = grade_check(RIGHT, tmp_path / "integrators.py", monkeypatch)
    assert state in ("not yet", "error")


def test_a_check_that_the_right_code_passes_is_not_wrong(monkeypatch: pytest.MonkeyPatch):
    assert grade_check(RIGHT, KIT / "solution", monkeypatch) == "passed"
