"""Notebooks as students hand them in, made from the source's."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from grader.judge.grade import KIT

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
    """What nbgrader makes of a cell: one of its four flags, or two of them."""
    details = cell["metadata"].get("nbgrader", {})
    return "+".join(flag for flag in ("grade", "locked", "solution", "task") if details.get(flag))


def released(cell):
    """The words of a cell after its answers and hidden tests are gone."""
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


def secrets(name):
    """Every line of a notebook that only its source has."""
    notebook, found, given = read(SOURCE / f"{name}.ipynb"), set(), set()
    for cell in notebook["cells"]:
        found |= {line.strip() for line in source(cell).splitlines()}
        given |= {line.strip() for line in released(cell).splitlines()}
    return {line for line in found - given if len(line) > 8 and not line.startswith("###")}


def answered(name):
    """A released notebook with every answer of the source written in."""
    notebook = read(RELEASED / f"{name}.ipynb")
    right = {cell["id"]: cell for cell in read(SOURCE / f"{name}.ipynb")["cells"]}
    for cell in notebook["cells"]:
        if "solution" in kind(cell):
            lines = source(right[cell["id"]]).splitlines(keepends=True)
            cell["source"] = [line for line in lines if not line.strip().startswith(MARKERS)]
    return notebook


def answers():
    return {name: answered(name) for name in NAMES}


def activated():
    """The variables of a terminal in which the environment is active."""
    path = os.pathsep.join([str(SCRIPTS), os.environ["PATH"]])
    return {**os.environ, "PATH": path}


def run(course, *arguments):
    """One of nbgrader's commands, as a person would type it in the course folder."""
    command = [str(SCRIPTS / "nbgrader"), *arguments]
    return subprocess.run(command, cwd=course, env=activated(), capture_output=True, text=True)


def hand_in(folder, tree, notebooks):
    """A folder as a student hands it in: a tree's files and these notebooks, by name."""
    ignored = shutil.ignore_patterns("__pycache__", "notebooks", "build")
    shutil.copytree(KIT / tree, folder, ignore=ignored)
    for name, notebook in notebooks.items():
        write(folder / "notebooks" / f"{name}.ipynb", notebook)
    return folder


def replace_in(notebook, cell_id, text):
    """Write other words into a cell."""
    for cell in notebook["cells"]:
        if cell["id"] == cell_id:
            cell["source"] = text.splitlines(keepends=True)
            return notebook
    raise LookupError(cell_id)
