"""Make questions that ask why, about a student's own line, marked by a person.

Each depends on how the student wrote a TODO: a line of a known form is quoted in the question.
"""

import ast
import re
from functools import cache
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.questions.program import FUNCTIONS, Program
from grader.questions.question import Question
from grader.source.regions import parse
from grader.text import printable

MOST_CODE_TO_SEARCH = 8000  # characters of a function that is searched
MOST_QUOTED = 160  # characters of a line


class Reason(Struct, frozen=True, forbid_unknown_fields=True):
    """A question about the first line that matches one of its patterns; see reasons.toml."""

    name: str
    text: str
    rubric: tuple[str, ...]  # a point each
    lines: tuple[str, ...] = ("",)  # patterns, the usual one first


@cache
def load_reasons() -> dict[str, Reason]:
    """Load the question about each TODO, in the order in which they are asked."""
    text = Path(__file__).with_name("reasons.toml").read_bytes()
    return msgspec.toml.decode(text, type=dict[str, Reason])


def list_reason_todos(program: Program) -> list[str]:
    """List the TODOs that are right and can be asked about."""
    return [todo for todo in load_reasons() if todo in program.right and quote_line(program, todo)]


def ask_reason(todo: str, program: Program, points: int) -> Question:
    reason, name = load_reasons()[todo], FUNCTIONS[todo].partition(":")[2]
    return Question(
        f"why-{reason.name}",
        "why",
        (todo,),
        f"The line below is of your `{name}`.\n{reason.text}",
        points,
        code=quote_line(program, todo),
        rubric=reason.rubric,
    )


def quote_line(program: Program, todo: str) -> str:
    """Return the line of the student's function to ask about, as written; empty for none."""
    found = program.own.find_function(FUNCTIONS[todo])
    lines = list_code_lines(found.source) if found else []
    for pattern in load_reasons()[todo].lines:
        for line in lines:
            if re.search(pattern, line):
                return line[:MOST_QUOTED]
    return ""


def list_code_lines(source: str) -> list[str]:
    """Return the lines of a function without its head, docstring and comments."""
    module = parse(source, MOST_CODE_TO_SEARCH)
    function = module.body[0] if module and module.body else None
    if not isinstance(function, ast.FunctionDef):
        return []
    body = function.body[ast.get_docstring(function, clean=False) is not None :]
    start = body[0].lineno - 1 if body else len(source)
    lines = (printable(line).strip() for line in source.splitlines()[start:])
    return [line for line in lines if line and not line.startswith("#")]
