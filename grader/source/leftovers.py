"""Find what is left in a TODO's function that should not be there: old lines, code that never runs.

The text alone shows it. Whether it is why a check fails, a run without it decides.
"""

import ast
import re
import textwrap
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeGuard

from grader.source.definitions import function_named, statements
from grader.source.flaws import MAX_LINE
from grader.source.regions import Region, read_regions

SWAPPED_SIGN = re.compile(r"\s*[\w.]+\s*=([+-])\s")

# Functions that only answer.
ANSWERS = {
    *("min", "max", "abs", "round", "sqrt", "exp", "cross", "dot", "normalize", "length"),
    *("friction_limit", "moment_for_circle", "Vector2", "Contact", "accel"),
}
VECTORS = {"pos", "vel", "half", "axis", "normal", "point"}
ENDS = (ast.Return, ast.Raise, ast.Break, ast.Continue)


@dataclass(frozen=True)
class Leftover:
    """Lines of a region that were handed out and still stand among the student's own."""

    line: int  # the number of the first one
    last: int  # and of the last one
    text: str  # of the first one
    without: str  # the file's text with all of them empty
    answers: bool = False  # whether it is the one return, below the student's own code

    @property
    def words(self) -> str:
        if self.line == self.last:
            lines, are, them = f"Line {self.line}", "is", "it"
        else:
            lines, are, them = f"Lines {self.line} to {self.last}", "are", "them"
        return (
            f"{lines}, `{self.text}`, {are} still there as handed out, beside your own code. "
            f"Remove {them}, and this passes."
        )

    @property
    def words_of_the_return(self) -> str:
        return (
            f"Line {self.last} still returns what was handed out, below your own code: return "
            "what your code has computed."
        )


@dataclass(frozen=True)
class DeadEnd:
    """A statement of a region that ends its block, and the first line below that never runs."""

    line: int
    text: str
    never: int
    is_first: bool  # whether no code of the region stands above it

    @property
    def words(self) -> str:
        return (
            f"Line {self.line}, `{self.text}`, ends the function, so line {self.never} and those "
            "after it never run."
        )


def show(line: str) -> str:
    """Return a line as it is quoted."""
    return line.strip() if len(line.strip()) <= MAX_LINE else f"{line.strip()[: MAX_LINE - 1]}…"


def find_leftover(text: str, todo: str, stub: str) -> Leftover | None:
    """Return the stub's statements at one end of a region; None where there is nothing else."""
    region, own = region_of(text, todo)
    old = [*map(dumped, statements(textwrap.dedent(stub)))]
    shapes = [*map(dumped, own)]
    left = [each for each, shape in zip(own, shapes, strict=True) if shape in old]
    at_an_end = bool(left) and (left[0] is own[0] or left[-1] is own[-1])
    if region is None or not at_an_end or len(left) == len(own):
        return None
    lines, first = text.splitlines(), region.start + 1
    numbers = [n + first for each in left for n in range(each.lineno - 1, each.end_lineno or 0)]
    shown = show(lines[numbers[0]])
    for number in numbers:
        lines[number] = ""
    without = "\n".join(lines) + "\n"
    answers = left[-1] is own[-1] and [*returns(own)] == [own[-1]]
    return Leftover(numbers[0] + 1, numbers[-1] + 1, shown, without, answers)


def returns(body: Sequence[ast.stmt]) -> Iterator[ast.AST]:
    return (node for node in ast.walk(ast.Module([*body], [])) if isinstance(node, ast.Return))


def dumped(node: ast.stmt) -> str:
    """Return what is equal for equal statements; empty for one nested beyond all measure."""
    try:
        return ast.dump(node)
    except (RecursionError, MemoryError, ValueError):  # or with a number of too many digits
        return ""


def find_dead_end(text: str, todo: str, path: str) -> DeadEnd | None:
    """Return the first statement of a region below which other code of the region never runs."""
    region, own = region_of(text, todo)
    function = function_named(statements(text), path)
    if region is None or function is None or not own:
        return None
    inside, first = range(region.start + 1, region.stop + 1), own[0].lineno + region.start + 1
    for last, never in dead_ends(function):
        if last.lineno in inside and never.lineno in inside:
            shown = show(text.splitlines()[last.lineno - 1])
            return DeadEnd(last.lineno, shown, never.lineno, last.lineno == first)
    return None


def find_loop(text: str, todo: str) -> tuple[int, str] | None:
    """Return the line of the first `while` in a region and its text; None where there is none."""
    region, own = region_of(text, todo)
    loops = [node.lineno for node in ast.walk(ast.Module(own, [])) if isinstance(node, ast.While)]
    if region is None or not loops:
        return None
    line = region.start + 1 + min(loops)
    return line, show(text.splitlines()[line - 1])


def find_return_in_loop(text: str, todo: str) -> int | None:
    """Return the line of a return that ends a loop of a region in its first round."""
    region, own = region_of(text, todo)
    loops = (n for n in ast.walk(ast.Module(own, [])) if isinstance(n, ast.For | ast.While))
    lines = [
        loop.body[-1].lineno
        for loop in loops
        if isinstance(loop.body[-1], ast.Return)
        and not any(isinstance(node, ast.Continue) for node in ast.walk(loop))
    ]
    return region.start + 1 + min(lines) if region and lines else None


def find_idle(text: str, todo: str) -> tuple[int, str] | None:
    """Return the first line of a region whose value nothing keeps, and that does nothing else."""
    region, own = region_of(text, todo)
    nodes = list(ast.walk(ast.Module(own, [])))
    answers = ANSWERS | {each.name for each in nodes if is_answer(each)}
    idle = [
        node.lineno for node in nodes if isinstance(node, ast.Expr) and is_idle(node.value, answers)
    ]
    if region is None or not idle:
        return None
    line = region.start + 1 + min(idle)
    return line, show(text.splitlines()[line - 1])


def is_answer(node: ast.AST) -> TypeGuard[ast.FunctionDef]:
    """Return whether a node is a function that only returns what it works out of its arguments."""
    if not isinstance(node, ast.FunctionDef):
        return False
    parts = list(ast.walk(node))
    returns = any(isinstance(each, ast.Return) and each.value is not None for each in parts)
    return returns and not any(has_effect(each) for each in parts)


def has_effect(node: ast.AST) -> bool:
    """Return whether a part of a function may change what is outside of it."""
    match node:
        case ast.Nonlocal() | ast.Global():
            return True
        case ast.Call(ast.Name(id=name) | ast.Attribute(attr=name)):
            return name not in ANSWERS
        case ast.Attribute(ctx=ast.Store()) | ast.Subscript(ctx=ast.Store()):
            return True
    return isinstance(node, ast.Call)


def is_idle(value: ast.expr, answers: Collection[str]) -> bool:
    """Return whether a value is all that computing it does."""
    match value:
        case ast.BinOp() | ast.UnaryOp() | ast.Compare() | ast.Name() | ast.Attribute():
            return True
        case ast.Call(ast.Name(id=name) | ast.Attribute(attr=name)):
            return name in answers
    return False


def find_rebound(text: str, todo: str, path: str) -> tuple[int, str] | None:
    """Return the line of a region that gives another value to an argument, and the argument.

    Only arguments count of which fields are read: a number may well get another value.
    """
    region = region_of(text, todo)[0]
    function = function_named(statements(text), path)
    if region is None or function is None:
        return None
    names = {each.arg for each in function.args.args}
    things, rebound = set(), []
    for node in ast.walk(function):
        match node:
            case ast.Attribute(value=ast.Name(id=name)):
                things.add(name)
            case ast.Name(id=name, ctx=ast.Store(), lineno=line) if name in names:
                rebound.append((line, name))
    inside = range(region.start + 1, region.stop + 1)
    found = [(line, name) for line, name in rebound if name in things and line in inside]
    return min(found, default=None)


def find_unread(text: str, todo: str, path: str) -> tuple[int, str] | None:
    """Return the line of a region that gives a name a value which nothing reads, and the name.

    A loop over a range may count with a name that nothing reads.
    """
    region = region_of(text, todo)[0]
    function = function_named(statements(text), path)
    if region is None or function is None:
        return None
    names = [node for node in ast.walk(function) if isinstance(node, ast.Name)]
    needed = set(find_needed(function)) | counters(function)
    inside = range(region.start + 1, region.stop + 1)
    unread = (
        (node.lineno, node.id)
        for node in names
        if isinstance(node.ctx, ast.Store) and node.id not in needed and node.lineno in inside
    )
    return min((each for each in unread if not each[1].startswith("_")), default=None)


def find_alias(text: str, todo: str) -> tuple[int, str, str] | None:
    """Return the line of a region that names another's vector, the name, and whose it is.

    Only if the name's vector is changed in place afterwards: with it that of the other one is.
    """
    region, own = region_of(text, todo)
    names: dict[str, tuple[int, str]] = {}
    for node in sorted(ast.walk(ast.Module(own, [])), key=lambda each: getattr(each, "lineno", 0)):
        match node:
            case ast.Assign([ast.Name(name)], ast.Attribute(attr=attr) as other) if attr in VECTORS:
                names[name] = node.lineno, ast.unparse(other)
            case ast.Assign([ast.Name(name)]):
                names.pop(name, None)
            case (
                ast.AugAssign(ast.Name(name), ast.Add() | ast.Sub())
                | ast.AugAssign(ast.Attribute(ast.Name(name), "x" | "y"))
                | ast.Assign([ast.Attribute(ast.Name(name), "x" | "y")])
            ) if name in names and region is not None:
                line, value = names[name]
                return region.start + 1 + line, name, value
    return None


def find_needed(node: ast.AST, makes: str = "") -> Iterator[str]:
    """Yield the names that a piece of code reads, but for what one of them alone is made of itself.

    `makes` is the name to which all of the piece gives a value.
    """
    for each in ast.iter_child_nodes(node):
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Load) and each.id != makes:
            yield each.id
        yield from find_needed(each, name_made(each) or makes)


def name_made(node: ast.AST) -> str:
    """Return the one name that an assignment, or an `if` of such, gives a value; else nothing."""
    match node:
        case ast.Assign([ast.Name(name)]) | ast.AugAssign(ast.Name(name)):
            return name
        case ast.If(body=body, orelse=orelse):
            made = {name_made(each) for each in (*body, *orelse)}
            return made.pop() if len(made) == 1 else ""
    return ""


def find_swapped_sign(text: str, todo: str) -> tuple[int, str, str] | None:
    """Return the line of a region with =+ or =- for += or -=, what it has, and what is meant."""
    region = region_of(text, todo)[0]
    if region is None:
        return None
    for number, line in enumerate(region.lines, region.start + 2):
        if found := SWAPPED_SIGN.match(line):
            return number, f"={found[1]}", f"{found[1]}="
    return None


def counters(function: ast.FunctionDef) -> set[str]:
    """Return the names that only count how often a loop has run."""
    found = set()
    for node in ast.walk(function):
        match node:
            case ast.For(ast.Name(counter), ast.Call(ast.Name("range"))):
                found.add(counter)
    return found


def region_of(text: str, todo: str) -> tuple[Region | None, list[ast.stmt]]:
    """Return the region of a TODO and its statements, whose lines count from the region's first."""
    region = next((each for each in read_regions(text)[0] if each.id == todo), None)
    return region, statements(textwrap.dedent("\n".join(region.lines))) if region else []


def dead_ends(function: ast.FunctionDef) -> Iterator[tuple[ast.stmt, ast.stmt]]:
    """Yield each statement that ends its block with the one that stands below it."""
    for block in blocks(function):
        yield from ((last, never) for last, never in pairwise(block) if is_end(last))


def blocks(function: ast.FunctionDef) -> Iterator[Sequence[ast.stmt]]:
    for node in ast.walk(function):
        for name in ("body", "orelse", "finalbody"):
            block = getattr(node, name, None)
            if isinstance(block, list):
                yield block


def is_end(node: ast.stmt) -> bool:
    """Return whether nothing below a statement of the same block can run."""
    if isinstance(node, ast.If):
        return bool(node.orelse) and is_end(node.body[-1]) and is_end(node.orelse[-1])
    return isinstance(node, ENDS)
