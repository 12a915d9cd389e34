"""Find lines of a TODO's region that look wrong: handed-out lines, dead code, lost values.

Only the text decides. If a line can be removed, a run without it shows whether that helps.
"""

import ast
import re
import textwrap
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TypeGuard

from grader.source.definitions import find_function, statements
from grader.source.flaws import quote
from grader.source.regions import find_regions

REBOUND = (
    "Line {line} gives `{name}` another value. From there on `{name}` is no longer what the "
    "function was given: use another name."
)
IDLE = "Line {line}, `{text}`, computes a value and keeps it nowhere: is return or = missing?"
UNREAD = "Line {line} gives `{name}` a value, and nothing reads it."
ALIAS = (
    "Line {line} makes no copy: `{name}` is `{value}` itself, and changes with it. Write "
    "Vector2({value})."
)
SWAPPED = "Line {line} has {got}, which keeps nothing of the old value: write {meant}."
RETURNS = "Line {line} returns in the first round of its loop: is it indented too far?"
LOOP = "The loop in line {line}, `{text}`, seems not to end: its body must change what it asks."
DEAD_END = "Line {line}, `{text}`, ends the function, so line {never} and those after it never run."
LEFTOVER = (
    "{lines}, `{text}`, {are} still there as handed out, beside your own code. Remove {them}, and "
    "this passes."
)
RETURNS_STUB = (
    "Line {line} still returns what was handed out, below your own code: return what your code has "
    "computed."
)
SWAPPED_SIGN = re.compile(r"\s*[\w.]+\s*=([+-])\s")
PURE = {  # functions that only return a value
    *("min", "max", "abs", "round", "sqrt", "exp", "cross", "dot", "normalize", "length"),
    *("friction_limit", "moment_for_circle", "Vector2", "Contact", "accel"),
}
VECTORS = {"pos", "vel", "half", "axis", "normal", "point"}
ENDS = (ast.Return, ast.Raise, ast.Break, ast.Continue)


@dataclass(frozen=True)
class Suspect:
    """A line that looks wrong, and a sentence that says why."""

    line: int
    words: str


@dataclass(frozen=True)
class Leftover(Suspect):
    """Handed-out lines among the student's own, and words for when a check passes without them."""

    last: Suspect  # the last of these lines, as a return that hides the student's own answer
    without: str  # the file's text with empty lines in their place
    is_only_return: bool  # the last line is the region's one return, below the student's own code


class RegionCode:
    """The code of one TODO in a file: its region, and the function around it.

    Nodes of `body` count their lines from the region's first line, nodes of `function` from the
    file's.
    """

    def __init__(self, text: str, todo: str, path: str) -> None:
        self.text, self.path = text, path
        self.region = find_regions(text).get(todo)
        code = textwrap.dedent("\n".join(self.region.lines)) if self.region else ""
        self.body = statements(code)
        self.before = self.region.start + 1 if self.region else 0  # lines before the first one

    @cached_property
    def function(self) -> ast.FunctionDef | None:
        return find_function(statements(self.text), self.path)

    @cached_property
    def nodes(self) -> list[ast.AST]:
        return list(ast.walk(ast.Module(self.body, [])))

    @property
    def first_line(self) -> int:
        """Return the number of the first line with code; 0 if there is none."""
        return self.before + self.body[0].lineno if self.body else 0

    def has_line(self, line: int) -> bool:
        return self.region is not None and self.region.start + 1 <= line <= self.region.stop

    def quote(self, line: int) -> str:
        """Return a line of the file, cut to the length of a quote."""
        return quote(self.text.splitlines()[line - 1].strip())

    def suspect_first(self, lines: Sequence[int], words: str) -> Suspect | None:
        """Return the first of these lines of the region as a suspect, described in `words`."""
        if not lines:
            return None
        line = self.before + min(lines)
        return Suspect(line, words.format(line=line, text=self.quote(line)))


def find_suspects(code: RegionCode) -> Mapping[str, Suspect]:
    """Return the lines that look wrong, by the names in FINDERS."""
    if code.region is None:
        return {}
    found = ((name, find(code)) for name, find in FINDERS.items())
    return {name: suspect for name, suspect in found if suspect is not None}


# ---------------------------------------------------------------- lines that can be left out


def find_leftover(code: RegionCode, stub: str) -> Leftover | None:
    """Return the stub's statements at one end of a region; None if they are all of it."""
    old = [*map(dump, statements(textwrap.dedent(stub)))]
    left = [each for each in code.body if dump(each) in old]
    at_an_end = bool(left) and (left[0] is code.body[0] or left[-1] is code.body[-1])
    if not at_an_end or len(left) == len(code.body):
        return None
    numbers = [
        code.before + n for each in left for n in range(each.lineno, (each.end_lineno or 0) + 1)
    ]
    first, last, lines = numbers[0], numbers[-1], code.text.splitlines()
    for number in numbers:
        lines[number - 1] = ""
    without = "\n".join(lines) + "\n"
    returns = [node for node in code.nodes if isinstance(node, ast.Return)]
    only_return = left[-1] is code.body[-1] and returns == [left[-1]]
    where, are, them = f"Lines {first} to {last}", "are", "them"
    if first == last:
        where, are, them = f"Line {first}", "is", "it"
    words = LEFTOVER.format(lines=where, text=code.quote(first), are=are, them=them)
    end = Suspect(last, RETURNS_STUB.format(line=last))
    return Leftover(first, words, end, without, only_return)


def dump(node: ast.stmt) -> str:
    """Return a text that is equal for equal statements; empty for one that is nested too deeply."""
    try:
        return ast.dump(node)
    except (RecursionError, MemoryError, ValueError):  # or with a number of too many digits
        return ""


def find_idle(code: RegionCode) -> Suspect | None:
    """Return the first line that only computes a value and does not store it."""
    pure = PURE | {each.name for each in code.nodes if is_pure(each)}
    idle = [n.lineno for n in code.nodes if isinstance(n, ast.Expr) and is_idle(n.value, pure)]
    return code.suspect_first(idle, IDLE)


def is_pure(node: ast.AST) -> TypeGuard[ast.FunctionDef]:
    """Return whether a node is a function that returns a value and changes nothing."""
    if not isinstance(node, ast.FunctionDef):
        return False
    parts = list(ast.walk(node))
    returns = any(isinstance(each, ast.Return) and each.value is not None for each in parts)
    return returns and not any(has_effect(each) for each in parts)


def has_effect(node: ast.AST) -> bool:
    """Return whether a part of a function may change something outside it."""
    match node:
        case ast.Nonlocal() | ast.Global():
            return True
        case ast.Call(ast.Name(id=name) | ast.Attribute(attr=name)):
            return name not in PURE
        case ast.Attribute(ctx=ast.Store()) | ast.Subscript(ctx=ast.Store()):
            return True
    return isinstance(node, ast.Call)


def is_idle(value: ast.expr, pure: Collection[str]) -> bool:
    """Return whether computing a value has no effect."""
    match value:
        case ast.BinOp() | ast.UnaryOp() | ast.Compare() | ast.Name() | ast.Attribute():
            return True
        case ast.Call(ast.Name(id=name) | ast.Attribute(attr=name)):
            return name in pure
    return False


def find_dead_end(code: RegionCode) -> Suspect | None:
    """Return the first statement that ends its block before the rest of the region."""
    for block in list_blocks(code.function) if code.function and code.body else ():
        for last, never in pairwise(block):
            if is_end(last) and code.has_line(last.lineno) and code.has_line(never.lineno):
                line, text = last.lineno, code.quote(last.lineno)
                return Suspect(line, DEAD_END.format(line=line, text=text, never=never.lineno))
    return None


def list_blocks(function: ast.FunctionDef) -> Iterator[list[ast.stmt]]:
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


# ---------------------------------------------------------------- lines that may be wrong


def find_rebound(code: RegionCode) -> Suspect | None:
    """Return the line that gives another value to an argument whose fields are read.

    An argument that is a number may get another value.
    """
    if code.function is None:
        return None
    names = {each.arg for each in code.function.args.args}
    objects, rebound = set(), []
    for node in ast.walk(code.function):
        match node:
            case ast.Attribute(value=ast.Name(id=name)):
                objects.add(name)
            case ast.Name(id=name, ctx=ast.Store(), lineno=line) if name in names:
                rebound.append((line, name))
    found = [(line, name) for line, name in rebound if name in objects and code.has_line(line)]
    return name_first(found, REBOUND)


def name_first(found: Collection[tuple[int, str]], words: str) -> Suspect | None:
    """Return the first of `found` as a suspect, described in `words`."""
    line, name = min(found, default=(0, ""))
    return Suspect(line, words.format(line=line, name=name)) if line else None


def find_loop(code: RegionCode) -> Suspect | None:
    """Return the line of the first `while`."""
    loops = [node.lineno for node in code.nodes if isinstance(node, ast.While)]
    return code.suspect_first(loops, LOOP)


def find_unread(code: RegionCode) -> Suspect | None:
    """Return the line that gives a value to a name which nothing reads.

    A loop over a range may count with such a name.
    """
    if code.function is None:
        return None
    names = [node for node in ast.walk(code.function) if isinstance(node, ast.Name)]
    needed = {*find_needed(code.function), *find_counters(code.function)}
    unread = [
        (node.lineno, node.id)
        for node in names
        if isinstance(node.ctx, ast.Store)
        and node.id not in needed
        and code.has_line(node.lineno)
        and not node.id.startswith("_")
    ]
    return name_first(unread, UNREAD)


def find_needed(node: ast.AST, assigned: str = "") -> Iterator[str]:
    """Yield the names that code reads, except to compute a new value of the name itself.

    `assigned` is the only name that the code gives a value.
    """
    for each in ast.iter_child_nodes(node):
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Load) and each.id != assigned:
            yield each.id
        yield from find_needed(each, find_assigned(each) or assigned)


def find_assigned(node: ast.AST) -> str:
    """Return the name that an assignment, or an `if` of assignments, sets; else empty."""
    match node:
        case ast.Assign([ast.Name(name)]) | ast.AugAssign(ast.Name(name)):
            return name
        case ast.If(body=body, orelse=orelse):
            names = {find_assigned(each) for each in (*body, *orelse)}
            return names.pop() if len(names) == 1 else ""
    return ""


def find_counters(function: ast.FunctionDef) -> Iterator[str]:
    """Yield the names that count how often a loop has run."""
    for node in ast.walk(function):
        match node:
            case ast.For(ast.Name(counter), ast.Call(ast.Name("range"))):
                yield counter


def find_swapped_sign(code: RegionCode) -> Suspect | None:
    """Return the line with =+ or =- instead of += or -=."""
    for number, text in enumerate(code.region.lines if code.region else (), code.before + 1):
        if found := SWAPPED_SIGN.match(text):
            words = SWAPPED.format(line=number, got=f"={found[1]}", meant=f"{found[1]}=")
            return Suspect(number, words)
    return None


def find_return_in_loop(code: RegionCode) -> Suspect | None:
    """Return the line with a return that ends a loop in its first round."""
    lines = [
        loop.body[-1].lineno
        for loop in code.nodes
        if isinstance(loop, ast.For | ast.While)
        and isinstance(loop.body[-1], ast.Return)
        and not any(isinstance(node, ast.Continue) for node in ast.walk(loop))
    ]
    return code.suspect_first(lines, RETURNS)


def find_alias(code: RegionCode) -> Suspect | None:
    """Return the line that gives another object's vector a second name, and changes it there."""
    names: dict[str, tuple[int, str]] = {}
    for node in sorted(code.nodes, key=lambda each: getattr(each, "lineno", 0)):
        match node:
            case ast.Assign([ast.Name(name)], ast.Attribute(attr=attr) as other) if attr in VECTORS:
                names[name] = code.before + node.lineno, ast.unparse(other)
            case ast.Assign([ast.Name(name)]):
                names.pop(name, None)
            case (
                ast.AugAssign(ast.Name(name), ast.Add() | ast.Sub())
                | ast.AugAssign(ast.Attribute(ast.Name(name), "x" | "y"))
                | ast.Assign([ast.Attribute(ast.Name(name), "x" | "y")])
            ) if name in names:
                line, value = names[name]
                return Suspect(line, ALIAS.format(line=line, name=name, value=value))
    return None


FINDERS: dict[str, Callable[[RegionCode], Suspect | None]] = {
    "rebound": find_rebound,
    "loop": find_loop,
    "unread": find_unread,
    "swapped sign": find_swapped_sign,
    "return in loop": find_return_in_loop,
    "alias": find_alias,
}
