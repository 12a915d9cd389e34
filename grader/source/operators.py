"""Make small changes to code: swap, drop, shift or negate one thing at a time.

Each operator takes one node of the syntax tree and yields others to replace it. The result is code
that a hurried student could have written, and that a good check should notice.
"""

import ast
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

Code = list[ast.stmt]
Offer = ast.AST | Code  # replacements of one node
Operator = Callable[[ast.AST, frozenset[str]], Iterator[Offer]]

ARITHMETIC: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Pow: ast.Mult,
}
COMPARISONS: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.Gt),
    ast.LtE: (ast.Lt, ast.GtE),
    ast.Gt: (ast.GtE, ast.Lt),
    ast.GtE: (ast.Gt, ast.LtE),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
}
NAMES = (  # variables and functions that are easily confused
    ("max", "min"),
    ("a", "b"),
    ("ra", "rb", "axis"),
    ("low", "high"),
    ("x", "v"),
    ("closest", "centre"),
    ("distance", "radius", "gap"),
    ("limit", "total"),
    ("mass", "radius"),
    ("STEP", "MAX_FRAME", "MAX_STEPS", "frame_seconds", "accumulator"),
    ("a_start", "a_end"),
    ("v", "v1", "v2", "v3", "v4"),
    ("a1", "a2", "a3", "a4"),
)
ATTRIBUTES = (
    ("a", "b"),
    ("x", "y"),
    ("pos", "vel", "omega"),
    ("inv_mass", "inv_inertia"),
    ("linear_damping", "angular_damping"),
    ("jn", "jt"),
    ("bias", "k"),
)
ANY_ORDER = {"max", "min"}  # swapping arguments of these changes nothing


@dataclass(frozen=True)
class Place:
    """The place of a node in its tree: a field of its parent, or an item of such a field."""

    parent: ast.AST
    field: str
    index: int | None

    @property
    def node(self) -> Any:
        held = getattr(self.parent, self.field)
        return held if self.index is None else held[self.index]

    def put(self, offer: Offer) -> Callable[[], None]:
        """Put `offer` here; return a function that puts the node back."""
        before = getattr(self.parent, self.field)
        if self.index is None:
            new: Any = offer
        else:
            here = offer if isinstance(offer, list) else [offer]
            new = [*before[: self.index], *here, *before[self.index + 1 :]]
            if not new:
                new = [ast.Pass()]
        setattr(self.parent, self.field, new)
        return lambda: setattr(self.parent, self.field, before)


def walk_places(tree: ast.AST) -> Iterator[Place]:
    """Yield every place in a tree, outer ones first."""
    for field, value in ast.iter_fields(tree):
        items = list(enumerate(value)) if isinstance(value, list) else [(None, value)]
        for index, item in items:
            if isinstance(item, ast.AST):
                yield Place(tree, field, index)
                yield from walk_places(item)


def make_changes(code: str, names: frozenset[str] = frozenset()) -> Iterator[tuple[str, str]]:
    """Yield every change of one thing in `code`: the operator's name and the code after it.

    `names` are the variables in scope beside those of the code itself. The code comes in the
    layout of `ast.unparse`.
    """
    tree = ast.parse(code)
    known = names | names_in(tree)
    for place in list(walk_places(tree)):
        for operator in OPERATORS:
            for offer in operator(place.node, known):
                restore = place.put(offer)
                text = ast.unparse(ast.fix_missing_locations(tree))
                restore()
                yield operator.__name__, text


def names_in(tree: ast.AST) -> frozenset[str]:
    """Return the variables and parameters of a piece of code."""
    variables = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    return frozenset(variables | {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)})


def normalize(code: str) -> str:
    """Return the code in the layout that all changes have."""
    return ast.unparse(ast.parse(code))


def parse_code(text: str) -> Code:
    return ast.parse(text).body


def parse_expression(text: str) -> ast.expr:
    return ast.parse(text, mode="eval").body


class Replacer(ast.NodeTransformer):
    """Replace one expression by another wherever its value is used."""

    def __init__(self, old: str, new: str) -> None:
        self.old = old
        self.new = new

    def generic_visit(self, node: ast.AST) -> ast.AST:
        loaded = isinstance(getattr(node, "ctx", ast.Load()), ast.Load)
        if isinstance(node, ast.expr) and loaded and ast.unparse(node) == self.old:
            return parse_expression(self.new)
        return super().generic_visit(node)


# ---------------------------------------------------------------- the operators


def change_arithmetic(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `-` by `+`, `/` by `*`, and `**` by `*`."""
    if isinstance(node, ast.BinOp) and type(node.op) in ARITHMETIC:
        yield ast.BinOp(node.left, ARITHMETIC[type(node.op)](), node.right)


def change_comparison(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `<` by `<=` or `>`, and so on."""
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        for other in COMPARISONS.get(type(node.ops[0]), ()):
            yield ast.Compare(node.left, [other()], node.comparators)


def change_constant(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Add one, halve, negate, or take 0 or 1."""
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        value = node.value
        assert isinstance(value, int | float)
        for other in dict.fromkeys((value + 1, value / 2, -value, 0, 1)):
            if other != value:
                yield ast.Constant(other)


def change_name(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Use another name or attribute of the same kind."""
    if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
        for other in related_names(node.id, NAMES):
            if other in names or other in ANY_ORDER:
                yield ast.Name(other, node.ctx)
    if isinstance(node, ast.Attribute):
        for other in related_names(node.attr, ATTRIBUTES):
            yield ast.Attribute(node.value, other, node.ctx)


def related_names(name: str, groups: Iterable[tuple[str, ...]]) -> list[str]:
    return [each for group in groups if name in group for each in group if each != name]


def unwrap(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `-x`, `not x`, `abs(x)` and any other call with one argument by `x`."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not):
        yield node.operand
    if isinstance(node, ast.Call) and len(node.args) == 1 and not node.keywords:
        yield node.args[0]


def swap_arguments(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Swap neighbours among the arguments of a call or the items of a tuple."""
    if isinstance(node, ast.Call):
        if isinstance(node.func, ast.Name) and node.func.id in ANY_ORDER:
            return
        for items in swap_neighbours(node.args):
            yield ast.Call(node.func, items, node.keywords)
    if isinstance(node, ast.Tuple) and isinstance(node.ctx, ast.Load):
        for items in swap_neighbours(node.elts):
            yield ast.Tuple(items, node.ctx)


def swap_neighbours(items: list[ast.expr]) -> Iterator[list[ast.expr]]:
    for first in range(len(items) - 1):
        yield [*items[:first], items[first + 1], items[first], *items[first + 2 :]]


def change_update(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `+=` by `-=` or plain `=`, and so on."""
    if isinstance(node, ast.AugAssign):
        if type(node.op) in ARITHMETIC:
            yield ast.AugAssign(node.target, ARITHMETIC[type(node.op)](), node.value)
        yield ast.Assign([node.target], node.value)


def change_condition(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Negate a condition, or replace `while` by `if`."""
    if isinstance(node, ast.If):
        yield ast.If(ast.UnaryOp(ast.Not(), node.test), node.body, node.orelse)
    if isinstance(node, ast.While):
        yield ast.While(ast.UnaryOp(ast.Not(), node.test), node.body, node.orelse)
        yield ast.If(node.test, node.body, node.orelse)
    if isinstance(node, ast.IfExp):
        yield ast.IfExp(node.test, node.orelse, node.body)


def change_statement(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Remove a statement or only its condition, run it twice, or return before it."""
    if isinstance(node, ast.stmt):
        yield []
    if isinstance(node, ast.If) and not node.orelse:
        yield node.body
    if isinstance(node, ast.stmt) and not isinstance(node, ast.Return):
        yield [ast.Return(None), node]
    if isinstance(node, ast.AugAssign | ast.Expr):
        yield [node, node]


def cut_loop_short(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Skip the first or the last item of a loop, or stop after one pass or a few."""
    if isinstance(node, ast.While):
        yield ast.While(node.test, [*node.body, ast.Break()], node.orelse)
    if isinstance(node, ast.For):
        yield ast.For(node.target, node.iter, [*node.body, ast.Break()], node.orelse)
        for part in ("[1:]", "[:-1]", "[:20]"):
            items = parse_expression(f"list({ast.unparse(node.iter)}){part}")
            yield ast.For(node.target, items, node.body, node.orelse)


OPERATORS: tuple[Operator, ...] = (
    change_arithmetic,
    change_comparison,
    change_constant,
    change_name,
    unwrap,
    swap_arguments,
    change_update,
    change_condition,
    change_statement,
    cut_loop_short,
)
