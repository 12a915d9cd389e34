"""The command line as people and scripts use it."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from grader.judge.grade import KIT


def grader(*args: object, cwd: Path = KIT) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(KIT), "COLUMNS": "100"}
    environment.pop("MAKELEVEL", None)  # `make test` is not `make hint`
    command = [sys.executable, "-m", "grader", *map(str, args)]
    return subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True)


@pytest.mark.parametrize(
    ("todos", "points"), [(["7a", "8a"], 5), pytest.param([], 100, marks=pytest.mark.soak)]
)
def test_full_marks_end_with_status_0(todos: list[str], points: int):
    done = grader("grade", "solution", *(f"--todo={todo}" for todo in todos))
    assert done.returncode == 0 and f"solution: {points} / {points}" in done.stdout


def test_less_than_full_marks_end_with_status_1(tmp_path: Path):
    target = tmp_path / "marks.json"
    done = grader("grade", "starter", "--json", target)
    assert done.returncode == 1
    assert json.loads(target.read_text(encoding="utf-8"))["points"] == 0


def test_what_cannot_be_graded_ends_with_status_2_and_a_sentence(tmp_path: Path):
    done = grader("grade", tmp_path / "nowhere")
    assert done.returncode == 2
    assert "there is no submission at" in done.stderr and "Traceback" not in done.stderr


def test_an_unknown_todo_ends_with_status_2():
    assert grader("grade", "solution", "--todo", "99").returncode == 2


def test_a_class_is_graded_into_a_folder(tmp_path: Path, hand_in):
    handed_in = tmp_path / "class"
    (handed_in / "anna").mkdir(parents=True)
    (handed_in / "ben").mkdir()
    (handed_in / "anna" / "integrators.py").write_bytes(
        (KIT / "solution" / "integrators.py").read_bytes()
    )
    done = grader("grade", handed_in, "--class", "--out", tmp_path / "marks", "--jobs", 1)
    assert done.returncode == 0, done.stderr
    marks = {
        path.stem: json.loads(path.read_text(encoding="utf-8"))["points"]
        for path in (tmp_path / "marks").glob("*.json")
    }
    assert marks == {"anna": 6, "ben": 0}


def test_check_finds_the_tree_from_a_folder_inside_it(hand_in):
    tree = hand_in("starter")
    done = grader("check", "--todo", "3", cwd=tree / "mini_engine")
    assert done.returncode == 1
    assert "NOT STARTED 3" in done.stdout and "Next: TODO 3" in done.stdout


def test_files_in_the_current_folder_shadow_nothing(hand_in):
    trap = "raise SystemExit('the judge imported a file of the submission')\n"
    names = ("json_py", "random_py", "pytest_py", "hypothesis_py", "conftest_py", "typer_py")
    tree = hand_in("solution", **dict.fromkeys(names, trap))
    done = grader("check", "--todo", "8a", cwd=tree)
    assert done.returncode == 0, done.stdout + done.stderr


def test_hints_say_more_by_level():
    first, third = grader("hint", "--todo", "4"), grader("hint", "--todo", "4", "--level", "3")
    assert "--level 2" in first.stdout and "clamp" not in first.stdout
    assert "friction_limit(c)" in third.stdout


def test_there_are_three_hints_for_every_todo():
    import msgspec

    from grader.judge.rubric import CHECKS, load_rubric

    hints = msgspec.toml.decode((CHECKS / "hints.toml").read_bytes())
    assert set(hints) == {todo.id for todo in load_rubric().todos if todo.function}
    assert all(len(each) == 3 for each in hints.values())
