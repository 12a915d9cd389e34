"""Make questions that ask why, about a student's own line, marked by a person.

Each depends on how the student wrote a TODO: a line of a known form is found in the syntax tree and
quoted in the question.
"""

import ast
from collections.abc import Iterator
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


class Form(Struct, frozen=True, forbid_unknown_fields=True):
    """A form of a statement; without any field, every statement has it."""

    calls: set[str] = set()
    operators: set[str] = set()
    is_a: set[str] = set()

    def fits(self, statement: ast.stmt) -> bool:
        if self.is_a:
            return type(statement).__name__ in self.is_a
        nodes = list(walk_statement(statement))
        if self.operators:
            return any(type(node).__name__ in self.operators for node in nodes)
        called = {ast.unparse(node.func) for node in nodes if isinstance(node, ast.Call)}
        names = {name.rpartition(".")[2] for name in called}
        return not self.calls or not names.isdisjoint(self.calls)


class Reason(Struct, frozen=True, forbid_unknown_fields=True):
    """A question about the first statement that has one of some forms; see reasons.toml."""

    name: str
    text: str
    rubric: tuple[str, ...]  # a point each
    forms: tuple[Form, ...] = (Form(),)  # the usual one first


def walk_statement(node: ast.stmt) -> Iterator[ast.AST]:
    """Walk a statement without the statements in it: for an `if`, only its condition."""
    waiting: list[ast.AST] = [node]
    while waiting:
        each = waiting.pop()
        yield each
        children = ast.iter_child_nodes(each)
        waiting += [child for child in children if not isinstance(child, ast.stmt)]


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
    """Return the line of the student's function to ask about, as written; or None."""
    text = program.own.find_function(FUNCTIONS[todo])
    module = parse(text.source, MOST_CODE_TO_SEARCH) if text else None
    if text is None or module is None or not module.body:
        return ""
    function = module.body[0]
    statements = [
        node
        for node in ast.walk(function)
        if isinstance(node, ast.stmt) and node is not function and not is_docstring(node)
    ]
    forms = load_reasons()[todo].forms
    try:
        node = next((each for form in forms for each in statements if form.fits(each)), None)
    except RecursionError:  # nested deeper than usual code
        return ""
    if node is None:
        return ""
    return printable(text.source.splitlines()[node.lineno - 1]).strip()[:MOST_QUOTED]


def is_docstring(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
