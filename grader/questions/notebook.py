"""Write a sheet as a notebook for nbgrader, in its source form: cells that mark themselves.

What nbgrader hands out has neither answers nor hidden tests. A test that ends with a number gives
that many points.
"""

import base64
import json
from collections.abc import Iterator
from typing import Any

from grader.questions.moodle import name_file
from grader.questions.question import KINDS, Picture, Question, Sheet

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
PLAIN = {"grade": False, "solution": False, "locked": True}
ANSWER = {"grade": False, "solution": True, "locked": False}
TEST = {"grade": True, "solution": False, "locked": True}
WORDS = {"grade": True, "solution": True, "locked": False}


def write_notebook(sheet: Sheet, title: str) -> bytes:
    """Return the notebook of one student."""
    about = f"# {title}: {sheet.student}\n\nAbout your own program, as you handed it in."
    cells = [make_cell("title", "markdown", about, PLAIN)]
    for number, question in enumerate(sheet.questions, 1):
        cells += make_cells(number, question)
    names = {"display_name": "Python 3", "language": "python", "name": "python3"}
    whole = {
        "cells": cells,
        "metadata": {"kernelspec": names, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return (json.dumps(whole, indent=1, ensure_ascii=False) + "\n").encode()


def make_cells(number: int, question: Question) -> Iterator[Cell]:
    asked = make_cell(f"question-{number}", "markdown", write_text(number, question), PLAIN)
    if question.pictures:
        asked["attachments"] = {name_file(each): attach(each) for each in question.pictures}
    yield asked
    if question.by_machine:
        name = f"answer_{number}"
        right = repr(question.answer) if question.kind == "film" else question.answer
        solution = f"{name} = None\n### BEGIN SOLUTION\n{name} = {right}\n### END SOLUTION"
        yield make_cell(f"answer-{number}", "code", solution, ANSWER)
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
        yield make_cell(f"test-{number}", "code", text, TEST, question.by_machine)
    if question.by_hand:
        text = "\n".join(["What to look for:", "", *(f"- {each}" for each in question.rubric)])
        yield make_cell(f"words-{number}", "markdown", text, WORDS, question.by_hand)


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


def attach(picture: Picture) -> dict[str, str]:
    return {"image/svg+xml": base64.b64encode(picture.svg.encode()).decode()}


def make_cell(
    id: str, kind: str, text: str, flags: dict[str, bool], points: int | None = None
) -> Cell:
    """Make a cell with the flags of nbgrader."""
    marks = {**flags, "grade_id": id, "schema_version": 3, "task": False}
    if points is not None:
        marks["points"] = points
    found: Cell = {
        "cell_type": kind,
        "id": id,
        "metadata": {"nbgrader": marks},
        "source": text.splitlines(keepends=True),
    }
    if kind == "code":
        found |= {"execution_count": None, "outputs": []}
    return found
