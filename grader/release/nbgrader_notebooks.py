"""The notebooks of both trees: `engine` follows the rubric, the starter's are nbgrader's release.

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
from grader.release.notebooks import QUIZ, engine_notebook, read, tidied, with_practice, write


def release(kit: Path) -> list[str]:
    """Tidy the solution's notebooks and let nbgrader make the starter's; returns what changed."""
    solution, starter = kit / "solution" / "notebooks", kit / "starter" / "notebooks"
    changed = []
    if write(solution / "engine.ipynb", engine_notebook(load_rubric())):
        changed.append("solution/notebooks/engine.ipynb")
    page = (kit / "handouts" / "quiz.md").read_text(encoding="utf-8")
    if write(solution / QUIZ, with_practice(read(solution / QUIZ), page)):
        changed.append(f"solution/notebooks/{QUIZ}")
    for path in sorted(solution.glob("*.ipynb")):
        if write(path, tidied(read(path))):
            changed.append(f"solution/notebooks/{path.name}")
    with tempfile.TemporaryDirectory() as temporary:
        made = generated(Path(temporary))
        for path in starter.glob("*.ipynb"):
            if not (made / path.name).exists():
                path.unlink()
                changed.append(f"starter/notebooks/{path.name}")
        for path in sorted(made.glob("*.ipynb")):
            if write(starter / path.name, tidied(read(path))):
                changed.append(f"starter/notebooks/{path.name}")
    return changed


def generated(course: Path) -> Path:
    """The folder that nbgrader releases from a fresh course."""
    make_course(course)
    run_nbgrader(course, "generate_assignment", ASSIGNMENT)
    return course / "release" / ASSIGNMENT


def run_nbgrader(course: Path, *arguments: str) -> None:
    """Run a command of nbgrader's in the course folder, this Python's folder first on the path."""
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
