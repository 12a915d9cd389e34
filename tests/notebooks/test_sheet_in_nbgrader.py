"""A sheet of questions through nbgrader's own command line: handed out, answered, marked.

Needs nbgrader beside the grader; takes half a minute.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from grader.questions.notebook import write_notebook
from grader.questions.question import Picture, Question, Sheet

pytestmark = pytest.mark.soak

FILMS = tuple(Picture(f"film {n}", "a film", f"<svg>{n}</svg>") for n in range(1, 5))
SHEET = Sheet(
    "ann",
    "1",
    (
        Question("a", "number", ("1",), "How large is `jn`?", 2, "962", 20.0, "kg px/s"),
        Question("b", "film", ("1",), "Which?", 4, "bdac", choices=tuple("wxyz"), pictures=FILMS),
        Question("c", "line", ("4",), "Which line?", 3, "2", code=("a", "b"), by_hand=1),
        Question("d", "why", ("4",), "Why?", 3, code=("x",), rubric=("because",), by_hand=3),
    ),
)
ANSWERS = {
    "answer-1": "answer_1 = 955",
    "answer-2": 'answer_2 = "bdca"',
    "answer-3": "answer_3 = 1",
    "words-4": "So it is.",
}
NAME = "questions-ann"


def run(course: Path, *arguments: str) -> None:
    """One of nbgrader's commands, as a person would type it in the course folder."""
    scripts = Path(sys.executable).parent
    path = os.pathsep.join([str(scripts), os.environ["PATH"]])
    command = [str(scripts / "nbgrader"), *arguments]
    environment = {**os.environ, "PATH": path}
    done = subprocess.run(command, cwd=course, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]


def test_nbgrader_hands_out_a_sheet_without_answers_and_marks_it(tmp_path: Path):
    api = pytest.importorskip(
        "nbgrader.api", reason="needs the extra notebooks, which make soak installs"
    )
    source = tmp_path / "source" / NAME / "questions.ipynb"
    source.parent.mkdir(parents=True)
    source.write_bytes(write_notebook(SHEET, "Physics"))
    run(tmp_path, "generate_assignment", NAME)
    released = (tmp_path / "release" / NAME / "questions.ipynb").read_text(encoding="utf-8")
    assert not any(secret in released for secret in ("962", "bdac", "because", "== 2"))
    cells = json.loads(released)
    for cell in cells["cells"]:
        if cell["id"] in ANSWERS:
            cell["source"] = ANSWERS[cell["id"]]
    handed_in = tmp_path / "submitted" / "ann" / NAME / "questions.ipynb"
    handed_in.parent.mkdir(parents=True)
    handed_in.write_text(json.dumps(cells), encoding="utf-8")
    run(tmp_path, "autograde", NAME)
    with api.Gradebook(f"sqlite:///{tmp_path / 'gradebook.db'}") as book:
        (found,) = book.find_submission(NAME, "ann").notebooks
        points = {grade.name: (grade.auto_score, grade.max_score) for grade in found.grades}
        waiting = {grade.name for grade in found.grades if grade.needs_manual_grade}
    assert points["test-1"] == (2, 2)
    assert points["test-2"] == (2, 4)
    assert points["test-3"] == (0, 2)
    assert waiting == {"words-4"}  # who wrote nothing waits for nobody
