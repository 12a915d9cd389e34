"""Test that a submission runs as on its student's machine: in its folder, with its imports."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import HandIn

from grader.bank.verify import shared_worker
from grader.judge.grade import grade
from grader.judge.result import CheckResult, Result
from grader.judge.task import KIT, Options, shipped_reference
from grader.source.regions import read_source
from grader.worker.imports import LIBRARIES, RULE

INTEGRATORS = read_source(KIT / "solution" / "integrators.py")


def grade_folder(folder: Path, todo: str = "8a") -> Result:
    options = Options(shipped_reference(), only=frozenset({todo}))
    return grade(folder, options, shared_worker())


def checks(result: Result) -> list[CheckResult]:
    return [check for todo in result.todos for check in todo.checks]


HABITS = """
import json
assert json.load(open('settings.json')) == {'dt': 1}
from pathlib import Path
Path(__file__).with_name('settings.json').read_text()
import logging
logging.basicConfig(filename='run.log')
logging.error('here')
Path(__file__).with_name('other.log').write_text('here')
import os
assert os.path.samefile(os.getcwd(), os.path.dirname(__file__))
import argparse
argparse.ArgumentParser().parse_args()
import sys
assert sys.argv[0].endswith('integrators.py') and not sys.argv[1:]
import numpy
assert numpy.hypot(3, 4) == 5
sys.path.append('lib')
import own
try:
    import scipy
except ImportError:
    scipy = None
import threading, multiprocessing, sqlite3, decimal
"""


def test_habits_of_students_cost_nothing(hand_in: HandIn):
    files = {"settings.json": '{"dt": 1}', "lib__own_py": "x = 1\n"}
    result = grade_folder(hand_in(integrators_py=f"{HABITS}\n{INTEGRATORS}", **files))
    assert result.points == result.max_points, checks(result)[0].got


@pytest.mark.parametrize("library", ["scipy", "grader.checks.exact"])
def test_any_other_import_in_a_todo_meets_the_rule(library: str, hand_in: HandIn):
    program = re.sub("(# TODO 8a.*\n)", rf"\1    import {library}\n", INTEGRATORS)
    result = grade_folder(hand_in(integrators_py=program))
    assert result.points == 0 and RULE in checks(result)[0].got


@pytest.mark.parametrize("library", ["scipy", "grader.checks.exact"])
def test_an_import_in_given_code_is_put_back(library: str, hand_in: HandIn):
    """The import is in given code, so the TODO keeps its points."""
    result = grade_folder(hand_in(integrators_py=f"import {library}\n{INTEGRATORS}"))
    check = checks(result)[0]
    assert f"`import {library}`, was not there" in check.meaning
    assert result.points == result.max_points
    assert check.where is not None and (check.where.file, check.where.line) == ("integrators.py", 1)


def test_the_lab_sheet_says_what_may_be_imported():
    sheet = (KIT / "handouts" / "lab-sheet.md").read_text(encoding="utf-8")
    assert all(f"`{name}`" in sheet or name in sheet for name in LIBRARIES)


@pytest.mark.skipif(sys.platform != "linux", reason="there is another way to be elsewhere")
@pytest.mark.soak
def test_the_working_folder_of_whoever_grades_changes_nothing(hand_in: HandIn, tmp_path: Path):
    folder = hand_in(integrators_py=INTEGRATORS)
    program = [sys.executable, "-m", "grader", "grade", str(folder), "--todo", "8a", "--json"]
    results = []
    for number, cwd in enumerate((KIT, Path("/"))):
        out = tmp_path / f"{number}.json"
        environment = {"PATH": "/usr/bin:/bin", "PYTHONPATH": str(KIT)}
        done = subprocess.run([*program, str(out)], cwd=cwd, env=environment, capture_output=True)
        assert done.returncode == 0, done.stderr
        results.append(out.read_bytes())
    assert results[0] == results[1]
