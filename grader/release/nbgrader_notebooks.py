"""Renew the notebooks of both trees: `engine` follows the rubric, nbgrader makes the starter's.

Edit `solution/notebooks/` in Jupyter. `engine.ipynb` is written from the rubric, and the questions
for practice in `quiz.ipynb` from the page of the handouts.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from grader.classroom.nbgrader.submissions import ASSIGNMENT
from grader.errors import Stop
from grader.judge.rubric import load_rubric
from grader.release.nbgrader_course import make_course
from grader.release.notebooks import QUIZ, add_practice, make_engine_notebook, read, tidy, write


def renew_notebooks(kit: Path) -> list[str]:
    """Tidy the solution's notebooks, let nbgrader make the starter's; return what changed."""
    solution, starter = kit / "solution" / "notebooks", kit / "starter" / "notebooks"
    changed = []
    if write(solution / "engine.ipynb", make_engine_notebook(load_rubric())):
        changed.append("solution/notebooks/engine.ipynb")
    page = (kit / "handouts" / "quiz.md").read_text(encoding="utf-8")
    if write(solution / QUIZ, add_practice(read(solution / QUIZ), page)):
        changed.append(f"solution/notebooks/{QUIZ}")
    for path in sorted(solution.glob("*.ipynb")):
        if write(path, tidy(read(path))):
            changed.append(f"solution/notebooks/{path.name}")
    with tempfile.TemporaryDirectory() as temporary:
        course = Path(temporary)
        make_course(course)
        run_nbgrader(course, "generate_assignment", ASSIGNMENT)
        made = course / "release" / ASSIGNMENT
        for path in starter.glob("*.ipynb"):
            if not (made / path.name).exists():
                path.unlink()
                changed.append(f"starter/notebooks/{path.name}")
        for path in sorted(made.glob("*.ipynb")):
            if write(starter / path.name, tidy(read(path))):
                changed.append(f"starter/notebooks/{path.name}")
    return changed


def run_nbgrader(course: Path, *arguments: str) -> None:
    """Run a command of nbgrader in the course folder; this Python's folder is first on the path."""
    scripts = str(Path(sys.executable).parent)
    command = shutil.which("nbgrader", path=scripts)
    if command is None:
        raise Stop(f"there is no nbgrader in {scripts}: python -m pip install nbgrader")
    environment = {**os.environ, "PATH": os.pathsep.join([scripts, os.environ.get("PATH", "")])}
    done = subprocess.run(
        [command, *arguments], cwd=course, env=environment, capture_output=True, text=True
    )
    if done.returncode:
        raise Stop(f"nbgrader {arguments[0]} failed:\n{done.stderr[-2000:]}")
