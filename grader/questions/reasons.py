"""Say why: questions that a person marks, about a line of the student's own.

Each depends on how the student wrote a TODO: a line that does it in one way or another is found in
the syntax tree, quoted, and asked about.
"""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.questions.program import FUNCTIONS, CannotAsk, Program
from grader.questions.question import Question
from grader.source.regions import parsed
from grader.text import printable

MOST_CODE_TO_SEARCH = 8000  # characters of a function that is looked through
MOST_QUOTED = 160  # characters of a line


class Reason(Struct, frozen=True, forbid_unknown_fields=True):
    """A question about a statement of a certain form; see reasons.toml."""

    name: str
    todo: str
    text: str
    rubric: tuple[str, ...]  # a point each
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


def walk_statement(node: ast.stmt) -> Iterator[ast.AST]:
    """Walk a statement without the statements in it: of an `if`, its condition alone."""
    waiting: list[ast.AST] = [node]
    while waiting:
        each = waiting.pop()
        yield each
        children = ast.iter_child_nodes(each)
        waiting += [child for child in children if not isinstance(child, ast.stmt)]


@cache
def load_reasons() -> list[Reason]:
    text = Path(__file__).with_name("reasons.toml").read_bytes()
    return msgspec.toml.decode(text, type=dict[str, list[Reason]])["reason"]


def find_reasons(program: Program) -> list[Reason]:
    """Return the questions about TODOs that are right, one for each, in a fixed order."""
    found: dict[str, Reason] = {}
    for each in load_reasons():
        if each.todo in program.right and each.todo not in found and quote_line(program, each):
            found[each.todo] = each
    return list(found.values())


def ask_reason(each: Reason, program: Program, points: int) -> Question:
    line = quote_line(program, each)
    if not line:
        raise CannotAsk("no line of theirs has this form")
    name = FUNCTIONS[each.todo].partition(":")[2]
    return Question(
        f"why-{each.name}",
        "why",
        (each.todo,),
        f"The line below is of your `{name}`.\n{each.text}",
        points,
        code=(line,),
        rubric=each.rubric,
        by_hand=points,
    )


def quote_line(program: Program, each: Reason) -> str:
    """Return the first line of the student's function that has the form, as they wrote it."""
    text = program.own.find_function(FUNCTIONS[each.todo])
    module = parsed(text.source, MOST_CODE_TO_SEARCH) if text else None
    if text is None or module is None or not module.body:
        return ""
    function = module.body[0]
    found = (
        node
        for node in ast.walk(function)
        if isinstance(node, ast.stmt) and node is not function and not is_docstring(node)
    )
    try:
        node = next(filter(each.fits, found), None)
    except RecursionError:  # nested deeper than anybody writes
        return ""
    if node is None:
        return ""
    return printable(text.source.splitlines()[node.lineno - 1]).strip()[:MOST_QUOTED]


def is_docstring(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
