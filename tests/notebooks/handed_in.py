"""Make notebooks as students hand them in, from those of the source."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from grader.judge.task import KIT

SOURCE = KIT / "solution" / "notebooks"
RELEASED = KIT / "starter" / "notebooks"
NAMES = sorted(path.stem for path in SOURCE.glob("*.ipynb"))
STUBS = {"code": "# Write your code here.", "markdown": "*Write your answer here.*"}
SCRIPTS = Path(sys.executable).parent
MARKERS = ("### BEGIN SOLUTION", "### END SOLUTION")


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def write(path, notebook):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(notebook, ensure_ascii=False), encoding="utf-8")


def source(cell):
    return "".join(cell["source"])


def kind(cell):
    """Return nbgrader's flags of a cell."""
    details = cell["metadata"].get("nbgrader", {})
    return "+".join(flag for flag in ("grade", "locked", "solution", "task") if details.get(flag))


def release_source(cell):
    """Return the source of a cell without answers and hidden tests."""
    text = source(cell)
    if "solution" in kind(cell) and "### BEGIN SOLUTION" not in text:
        return STUBS[cell["cell_type"]]
    text = re.sub(
        r"^( *)### BEGIN SOLUTION\n.*?^ *### END SOLUTION$",
        lambda found: found[1] + STUBS["code"],
        text,
        flags=re.MULTILINE | re.DOTALL,
    )
    hidden = r"^ *### BEGIN HIDDEN TESTS\n.*?### END HIDDEN TESTS\n?"
    return re.sub(hidden, "", text, flags=re.MULTILINE | re.DOTALL).rstrip("\n")


def fill_answers(name):
    """Return a released notebook with every answer filled in."""
    notebook = read(RELEASED / f"{name}.ipynb")
    right = {cell["id"]: cell for cell in read(SOURCE / f"{name}.ipynb")["cells"]}
    for cell in notebook["cells"]:
        if "solution" in kind(cell):
            lines = source(right[cell["id"]]).splitlines(keepends=True)
            cell["source"] = [line for line in lines if not line.strip().startswith(MARKERS)]
    return notebook


def answers():
    return {name: fill_answers(name) for name in NAMES}


def active_environment():
    """Return the variables of a terminal with the active environment."""
    path = os.pathsep.join([str(SCRIPTS), os.environ["PATH"]])
    return {**os.environ, "PATH": path}


def run(course, *arguments):
    """Run one of nbgrader's commands in the course folder."""
    command = [str(SCRIPTS / "nbgrader"), *arguments]
    return subprocess.run(
        command, cwd=course, env=active_environment(), capture_output=True, text=True
    )


def hand_in(folder, tree, notebooks):
    """Make a student's submission folder from a tree's files and these notebooks."""
    ignored = shutil.ignore_patterns("__pycache__", "notebooks", "build")
    shutil.copytree(KIT / tree, folder, ignore=ignored)
    for name, notebook in notebooks.items():
        write(folder / "notebooks" / f"{name}.ipynb", notebook)
    return folder


def replace_in(notebook, cell_id, text):
    """Replace the source of a cell."""
    for cell in notebook["cells"]:
        if cell["id"] == cell_id:
            cell["source"] = text.splitlines(keepends=True)
            return notebook
    raise LookupError(cell_id)
