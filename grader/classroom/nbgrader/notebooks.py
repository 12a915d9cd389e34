"""The notebooks of both trees: `engine` follows the rubric, the starter's are nbgrader's release.

Edit `solution/notebooks/` in Jupyter. `engine.ipynb` alone is written from the rubric.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from grader.classroom.nbgrader.course import ASSIGNMENT, NoCourse, make_course
from grader.judge.rubric import Rubric, load_rubric

Cell = dict[str, Any]

INTRO = """\
# The engine

Nothing is to be done here. You write the engine in the Python files and hand everything in
together. The points below come from the course's grader, which runs your files outside of this
notebook. To see where you stand:

    python -m grader check

With the feedback you get the reasons for missing points in the same places.\
"""


def engine_notebook(rubric: Rubric) -> Cell:
    """A notebook with a cell for each TODO, worth its points; bonus tasks are no part of a sum."""
    cells = [markdown("title", INTRO, {})]
    for todo in rubric.counted:
        name = f"TODO {todo.id}" if todo.function else "The whole"
        noun = "point" if todo.max_points == 1 else "points"
        text = f"### {name}: {todo.title}\n\n{todo.max_points} {noun}"
        if todo.function:
            text += f", for `{todo.function.partition(':')[2]}` in `{todo.module}`"
        details = {
            "grade": False,
            "grade_id": f"todo-{todo.id}",
            "locked": True,
            "points": todo.max_points,
            "schema_version": 3,
            "solution": False,
            "task": True,
        }
        cells.append(markdown(f"todo-{todo.id}", text, {"nbgrader": details}))
    python = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": python, "language_info": {"name": "python"}}
    return {"cells": cells, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}


def markdown(name: str, text: str, metadata: Cell) -> Cell:
    lines = text.splitlines(keepends=True)
    return {"cell_type": "markdown", "id": name, "metadata": metadata, "source": lines}


def tidied(notebook: Cell) -> Cell:
    """A notebook without what running it leaves behind."""
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell.update(execution_count=None, outputs=[])
        for trace in ("execution", "ExecuteTime", "collapsed", "scrolled"):
            cell["metadata"].pop(trace, None)
    notebook["metadata"]["language_info"] = {"name": "python"}
    return notebook


def read(path: Path) -> Cell:
    notebook: Cell = json.loads(path.read_text(encoding="utf-8"))
    return notebook


def write(path: Path, notebook: Cell) -> bool:
    """Write a notebook if it differs; returns whether it did."""
    text = json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return False
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8", newline="\n")
    return True


def release(kit: Path) -> list[str]:
    """Tidy the solution's notebooks and let nbgrader make the starter's; returns what changed."""
    solution, starter = kit / "solution" / "notebooks", kit / "starter" / "notebooks"
    changed = []
    if write(solution / "engine.ipynb", engine_notebook(load_rubric())):
        changed.append("solution/notebooks/engine.ipynb")
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
        raise NoCourse(f"there is no nbgrader in {scripts}: python -m pip install nbgrader")
    environment = {**os.environ, "PATH": os.pathsep.join([scripts, os.environ.get("PATH", "")])}
    done = subprocess.run(
        [command, *arguments], cwd=course, env=environment, capture_output=True, text=True
    )
    if done.returncode:
        raise NoCourse(f"nbgrader {arguments[0]} failed:\n{done.stderr[-2000:]}")
