"""Grade generated code: finding words about it must not stop a grade."""

import re
import shutil
from pathlib import Path

from edited_trees import grade_todos, set_regions

from grader.judge.result import Result
from grader.judge.task import KIT, shipped_reference

BRANCHES = ["if x == 0:\n        return x, v"]
BRANCHES += [f"elif x == {number}:\n        return x, v" for number in range(1, 1500)]
ODD = {
    "8a": "    " + "\n    ".join(BRANCHES),
    "8b": f"    big = 0x{'F' * 5000}\n    return 1, 2",
    "8c": '    print("OddError: in line " + "9" * 30)\n    return 0, 0',
}


def grade_code(folder: Path, regions: dict[str, str]) -> Result:
    """Grade the solution with other regions; its prints are read, too."""
    shutil.copytree(KIT / "solution", folder, ignore=shutil.ignore_patterns("__pycache__"))
    set_regions(folder, "integrators.py", regions)
    return grade_todos(folder, *regions, "5", reference=shipped_reference())


def test_odd_code_costs_its_own_points_alone(tmp_path: Path) -> None:
    """A chain of 1,500 branches, a number of 5,000 digits, an error in a line of 30 digits."""
    result = grade_code(tmp_path / "work", ODD)
    assert [todo.id for todo in result.todos if todo.points] == ["5"]
    assert result.todos[0].state == "passed"
    for todo in result.todos[1:]:
        places = [check.where for check in todo.checks if check.where]
        assert places and max(each.line for each in places) < 4000  # there is such a line


def test_an_error_that_names_a_file_outside_does_not_open_it(tmp_path: Path) -> None:
    outside = tmp_path / "outside.py"
    outside.write_text("secret_of_the_judge.dot(1)\n", encoding="utf-8")
    words = f"'Vector2' object is not callable (in {outside}, line 1: x)"
    result = grade_code(tmp_path / "work", {"8a": f'    raise TypeError("{words}")'})
    failed = [check for todo in result.todos for check in todo.checks if check.failed]
    assert failed and not any(re.search("secret_of", check.meaning) for check in failed)
