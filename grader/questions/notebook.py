"""Write a sheet as a notebook for nbgrader, in its source form: cells that mark themselves.

What nbgrader hands out has neither answers nor hidden tests. A test that ends with a number gives
that many points.
"""

import json
from collections.abc import Iterator
from typing import Any

from grader.questions.moodle import encode_picture, name_file
from grader.questions.question import KINDS, Question, Sheet

Cell = dict[str, Any]
SHAPES = {
    "number": (
        "assert isinstance({name}, (int, float)), "
        'f"{name} is {{{name}!r}}, but it must be a number."'
    ),
    "line": (
        'assert isinstance({name}, int), f"{name} is {{{name}!r}}, but it must be a whole number."'
    ),
    "film": (
        'assert isinstance({name}, str) and set({name}) <= set("abcd") and len({name}) == {count}, '
        'f"{name} is {{{name}!r}}, but it must be {count} letters, as in \\"abcd\\"."'
    ),
}
TESTS = {
    "number": 'assert abs({name} - {answer}) <= {tolerance}, "Another number is right."',
    "line": 'assert {name} == {answer}, "It is another line."',
    "film": "sum(map(str.__eq__, {name}, {answer!r})) * {points} // {count}",
}
WANTED = {"number": "a number", "line": "the number of the line", "film": 'letters, as "abcd",'}
PLAIN = {"grade": False, "solution": False, "locked": True, "task": False}  # nbgrader's flags
ANSWER = PLAIN | {"solution": True, "locked": False}
TEST = PLAIN | {"grade": True}
WORDS = ANSWER | {"grade": True}
TASK = PLAIN | {"task": True}


def write_notebook(sheet: Sheet, title: str) -> bytes:
    about = f"# {title}: {sheet.label}\n\nAbout your own program, as you handed it in."
    cells = [make_marked("title", "markdown", about, PLAIN)]
    for number, question in enumerate(sheet.questions, 1):
        cells += make_cells(number, question)
    return encode_notebook(make_notebook(cells)).encode()


def make_cells(number: int, question: Question) -> Iterator[Cell]:
    asked = make_marked(f"question-{number}", "markdown", write_text(number, question), PLAIN)
    if question.pictures:
        asked["attachments"] = {
            name_file(each): {"image/svg+xml": encode_picture(each)} for each in question.pictures
        }
    yield asked
    if question.by_machine:
        name = f"answer_{number}"
        right = repr(question.answer) if question.kind == "film" else question.answer
        solution = f"{name} = None\n### BEGIN SOLUTION\n{name} = {right}\n### END SOLUTION"
        yield make_marked(f"answer-{number}", "code", solution, ANSWER)
        given = {
            "name": name,
            "answer": question.answer,
            "tolerance": question.tolerance + 1e-9,
            "points": question.by_machine,
            "count": len(question.answer),
        }
        shape = SHAPES[question.kind].format(**given)
        test = TESTS[question.kind].format(**given)
        text = f"{shape}\n### BEGIN HIDDEN TESTS\n{test}\n### END HIDDEN TESTS"
        yield make_marked(f"test-{number}", "code", text, TEST, question.by_machine)
    if question.by_hand:
        text = "\n".join(["What to look for:", "", *(f"- {each}" for each in question.rubric)])
        yield make_marked(f"words-{number}", "markdown", text, WORDS, question.by_hand)


def write_text(number: int, question: Question) -> str:
    """Return a question in Markdown."""
    parts = [f"## {number}. {KINDS[question.kind].capitalize()} ({question.points} points)"]
    parts += question.text.splitlines()
    if question.code:
        lines = [f"{number:3}  {line}" for number, line in enumerate(question.code, 1)]
        parts.append("\n".join(["```text", *lines, "```"]))
    for each in question.pictures:
        parts += [f"{each.name}:", f"![{each.alt}](attachment:{name_file(each)})"]
    if question.choices:
        letters = "abcdefgh"[: len(question.choices)]
        lettered = zip(letters, question.choices, strict=True)
        parts.append("\n".join(f"- **{letter}** {words}" for letter, words in lettered))
    if question.by_machine:
        unit = f" in {question.unit}" if question.unit else ""
        parts.append(f"Put {WANTED[question.kind]}{unit} into `answer_{number}`.")
    if question.by_hand:
        parts.append("Write your words into the cell for them.")
    return "\n\n".join(parts)


# ---------------------------------------------------------------- notebooks of any kind


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


def make_notebook(cells: list[Cell]) -> Cell:
    python = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": python, "language_info": {"name": "python"}}
    return {"cells": cells, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}


def encode_notebook(notebook: Cell) -> str:
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"
