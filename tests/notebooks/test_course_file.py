"""Test that the course folder of nbgrader stores the course it was made from."""

from pathlib import Path

import pytest
from command_line import call_class, run_grader

from grader.classroom.nbgrader import gradebook, submissions
from grader.judge.course import COURSE_FILE

COURSE = 'title = "Lab 3"\ntodos = ["1", "8a"]\n[points]\n8a = 20\n'


def test_no_later_command_needs_the_course_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(COURSE_FILE, raising=False)
    (tmp_path / "autumn.toml").write_text(COURSE, encoding="utf-8")
    folder = tmp_path / "phys"
    course = ["--course", tmp_path / "autumn.toml"]
    run_grader("nbgrader", "course", folder, "--without-checks", *course)
    asked = []
    monkeypatch.setattr(gradebook, "fill_gradebook", lambda *_: [])
    monkeypatch.setattr(
        submissions, "grade_submitted", lambda _, options, *rest: asked.append(options.course) or []
    )
    run_grader("nbgrader", "bridge", "--folder", folder)
    assert [todo.id for todo in asked[0].rubric.todos] == ["1", "8a"]
    again = run_grader("nbgrader", "course", folder, "--without-checks", "--renew")
    assert again.exit_code == 0 and (folder / "course.toml").read_text(encoding="utf-8") == COURSE
    assert "TODO 1, 8a" in call_class("new", folder)
