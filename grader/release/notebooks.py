"""Make the notebooks of a course: `engine` follows its rubric, others keep the course's cells.

The questions for practice in `quiz` are those of the page handouts/quiz.md.

A cell or a notebook that belongs to some TODOs names them in its metadata, as `"todos": ["5"]`. It
is omitted if the course has none of them, and so is a notebook without any task. A cell that is
also `"given": true` is kept, with its answer.
"""

import json
import re
from pathlib import Path
from typing import Any

from grader.judge.course import Course
from grader.judge.rubric import Rubric
from grader.judge.task import KIT
from grader.text import plural

Cell = dict[str, Any]
PLAIN = {"grade": False, "solution": False, "locked": True, "task": False}  # nbgrader's flags
TASK = PLAIN | {"task": True}
ENGINE, QUIZ = "engine.ipynb", "quiz.ipynb"
SOLVED = KIT / "solution" / "notebooks"
GIVEN = "# Given in this course.\n"
PRACTICE = "practice-"  # with a number added: the questions of the page
QUESTION = re.compile(r"<!--% if asked\((.*?)\) %-->\n(.*?)\n<!--% endif %-->", re.S)

INTRO = """\
# The engine

Nothing is to be done here. You write the engine in the Python files and hand everything in
together. The points below come from the course's grader, which runs your files outside of this
notebook. To see where you stand:

    python -m grader check

With the feedback you get the reasons for missing points in the same places.\
"""


def make_marked(
    id: str, kind: str, text: str, flags: dict[str, bool], points: int | None = None
) -> Cell:
    """Make a cell with the flags of nbgrader."""
    marks = {**flags, "grade_id": id, "schema_version": 3}
    if points is not None:
        marks["points"] = points
    return make_cell(id, kind, text, {"nbgrader": dict(sorted(marks.items()))})


def make_cell(id: str, kind: str, text: str, metadata: Cell) -> Cell:
    lines = text.splitlines(keepends=True)
    found: Cell = {"cell_type": kind, "id": id, "metadata": metadata, "source": lines}
    return found | ({"execution_count": None, "outputs": []} if kind == "code" else {})


def encode_notebook(notebook: Cell) -> str:
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def make_engine_notebook(rubric: Rubric) -> Cell:
    """Make a notebook with a cell for each TODO, worth its points, without bonus tasks."""
    cells = [make_cell("title", "markdown", INTRO, {})]
    for todo in rubric.main_todos:
        name = f"TODO {todo.id}" if todo.function else "The whole"
        text = f"### {name}: {todo.title}\n\n{plural(todo.max_points, 'point')}"
        if todo.function:
            text += f", for `{todo.function.partition(':')[2]}` in `{todo.module}`"
        cells.append(make_marked(f"todo-{todo.id}", "markdown", text, TASK, todo.max_points))
    python = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": python, "language_info": {"name": "python"}}
    return {"cells": cells, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}


def add_practice(notebook: Cell, page: str) -> Cell:
    """Add the practice questions of a page to the quiz, each with its TODOs."""
    cells = [cell for cell in notebook["cells"] if not cell["id"].startswith(PRACTICE)]
    at = 1 + next(n for n, cell in enumerate(cells) if cell["id"] == "about-practice")
    asked = [
        make_cell(f"{PRACTICE}{number}", "markdown", text, {"todos": re.findall(r'"(\w+)"', about)})
        for number, (about, text) in enumerate(QUESTION.findall(page), 1)
    ]
    return notebook | {"cells": [*cells[:at], *asked, *cells[at:]]}


def tidy(notebook: Cell) -> Cell:
    """Remove the traces of a run from a notebook."""
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
    """Write a notebook if it differs; return whether it did."""
    text = encode_notebook(notebook)
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return False
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8", newline="\n")
    return True


def make_notebooks(folder: Path, course: Course) -> dict[str, bytes]:
    """Return the notebooks of a course by name."""
    found = {}
    for path in sorted(folder.glob("*.ipynb")):
        notebook = read(path)
        if path.name == ENGINE and read_points(notebook) != read_points(
            make_engine_notebook(course.rubric)
        ):
            notebook = make_engine_notebook(course.rubric)
        cells = choose_cells(notebook, read(SOLVED / path.name), course)
        if cells == read(path)["cells"]:
            found[path.name] = path.read_bytes()
        elif any(map(has_task, cells)):
            found[path.name] = encode_notebook(notebook | {"cells": cells}).encode()
    return found


def choose_cells(notebook: Cell, solved: Cell, course: Course) -> list[Cell]:
    """Return a notebook's cells for a course; given cells have their answers."""
    answers = {cell["id"]: cell for cell in solved["cells"]}
    if not is_in_course(notebook, course):
        return []
    return [
        cell if is_in_course(cell, course) else make_given(answers[cell["id"]])
        for cell in notebook["cells"]
        if is_in_course(cell, course) or cell["metadata"].get("given")
    ]


def make_given(cell: Cell) -> Cell:
    """Return a cell of the solution as a given cell."""
    text = GIVEN + re.sub(r" *### (BEGIN|END) SOLUTION\n?", "", "".join(cell["source"]))
    return make_marked(cell["id"], cell["cell_type"], text, PLAIN)


def read_points(notebook: Cell) -> dict[str, Any]:
    return {
        cell["id"]: cell["metadata"].get("nbgrader", {}).get("points") for cell in notebook["cells"]
    }


def is_in_course(cell: Cell, course: Course) -> bool:
    about = cell["metadata"].get("todos")
    return about is None or any(todo.id in about for todo in course.rubric.todos)


def has_task(cell: Cell) -> bool:
    details = cell["metadata"].get("nbgrader", {})
    return any(details.get(each) for each in ("grade", "solution", "task"))
