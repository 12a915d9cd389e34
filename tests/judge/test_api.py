"""Test the public API: the names of `grader`, and the guide's example."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import grader
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT
from grader.source.regions import replace_regions


def run(code: str, folder: Path) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, "-c", code],
        cwd=folder,
        env={"PYTHONPATH": str(KIT)},
        capture_output=True,
        text=True,
    )


def example() -> str:
    guide = (KIT / "handouts" / "instructor" / "guide.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"^```python\n(from grader import .*?)^```$", guide, re.M | re.S)
    return code


def test_the_lines_of_the_guide_print_the_points_of_each_todo(tmp_path: Path):
    (tmp_path / "submissions" / "ann").mkdir(parents=True)
    program = (KIT / "starter" / "integrators.py").read_text(encoding="utf-8")
    right = "    v = v + accel(x) * dt\n    return x + v * dt, v"
    program = replace_regions(program, {"8a": (right,)})
    (tmp_path / "submissions" / "ann" / "integrators.py").write_text(program, encoding="utf-8")
    done = run(example(), tmp_path)
    assert done.returncode == 0, done.stderr
    head, *todos = done.stdout.splitlines()
    most = next(todo.max_points for todo in load_rubric().todos if todo.id == "8a")
    assert head == f"ann: {most} of 100 points"
    assert len(todos) == len(load_rubric().todos)
    assert [line for line in todos if "passed" in line] == [f"TODO 8a: {most} of {most}, passed"]


def test_the_lines_of_the_guide_say_what_cannot_be_graded(tmp_path: Path):
    done = run(example(), tmp_path)
    assert done.returncode == 1
    assert done.stderr == (
        "cannot grade: there is no submission at submissions/ann: name a folder, an archive or "
        "a Python file\n"
    )


def test_every_name_is_there_and_says_what_it_is_for():
    for name in grader.__all__:
        assert getattr(grader, name).__doc__, name
    with pytest.raises(AttributeError, match="no attribute 'grades'"):
        grader.grades  # noqa: B018


def test_the_package_alone_loads_nothing_of_the_judge(tmp_path: Path):
    """Children of the worker import it, as do programs that only need the version."""
    code = "import sys, grader; print(grader.__version__, *sorted(sys.modules))"
    version, *loaded = run(code, tmp_path).stdout.split()
    assert version == grader.__version__
    assert [name for name in loaded if name.startswith(("grader.", "msgspec", "rich"))] == []
