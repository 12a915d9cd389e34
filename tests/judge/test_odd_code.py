"""Grade generated code: finding words about it must not stop a grade."""

import re
import shutil
from pathlib import Path

import pytest

from grader.bank.verify import shared_worker
from grader.judge.grade import grade
from grader.judge.result import Result
from grader.judge.task import KIT, Options, shipped_reference
from grader.source.regions import read_source, replace_regions

BRANCHES = ["if x == 0:\n        return x, v"]
BRANCHES += [f"elif x == {number}:\n        return x, v" for number in range(1, 1500)]
ODD = {
    "a chain of branches": "    " + "\n    ".join(BRANCHES),
    "a number of 5000 digits": f"    big = 0x{'F' * 5000}\n    return 1, 2",
    "an error in a line that is not there": (
        '    exec(compile("\\n" * 5000 + "raise AssertionError", __file__, "exec"))'
    ),
    "an answer larger than any float": "    return 10**400, 0",
    "a printed error in a line of 30 digits": (
        '    print("OddError: in line " + "9" * 30)\n    return 0, 0'
    ),
}


def grade_code(folder: Path, code: str) -> Result:
    shutil.copytree(KIT / "solution", folder, ignore=shutil.ignore_patterns("__pycache__"))
    file = folder / "integrators.py"
    file.write_text(
        replace_regions(read_source(file), {"8a": tuple(code.split("\n"))}), encoding="utf-8"
    )
    options = Options(
        shipped_reference(), only=frozenset({"8a", "8b"}), trusted=True
    )  # its prints, too
    return grade(folder, options, shared_worker())


@pytest.mark.parametrize("what", ODD)
def test_odd_code_costs_its_own_points_alone(what: str, tmp_path: Path) -> None:
    result = grade_code(tmp_path / "work", ODD[what])
    assert [todo.points for todo in result.todos] == [0, 2]
    places = [check.where for todo in result.todos for check in todo.checks if check.where]
    assert places and max(each.line for each in places) < 2000  # there is such a line


def test_an_error_that_names_a_file_outside_does_not_open_it(tmp_path: Path) -> None:
    outside = tmp_path / "outside.py"
    outside.write_text("secret_of_the_judge.dot(1)\n", encoding="utf-8")
    words = f"'Vector2' object is not callable (in {outside}, line 1: x)"
    result = grade_code(tmp_path / "work", f'    raise TypeError("{words}")')
    told = [check for todo in result.todos for check in todo.checks if check.failed]
    assert told and not any(re.search("secret_of", check.meaning) for check in told)
