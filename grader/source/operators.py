"""Make small changes to code: swap, drop, shift or negate one thing at a time.

Each operator takes one node of the syntax tree and yields others to replace it. The result is code
that a hurried student could have written, and that a good check should notice.
"""

import ast
import re
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
CONFUSED = (  # attributes that are easily confused
    ("x", "y"),
    ("a", "b"),
    ("pos", "vel"),
    ("angle", "omega"),
    ("inv_mass", "inv_inertia", "mass"),
    ("jn", "jt"),
    ("friction", "restitution"),
    ("linear_damping", "angular_damping"),
)
ANY_ORDER = {"max", "min"}  # swapping arguments of these changes nothing

ENDING = re.compile(r"\d+|_[a-z]$")  # in which similar names differ
SUMS = ast.Add | ast.Sub | ast.Mult | ast.Div
ATOMS = ast.Constant | ast.Tuple | ast.List | ast.Compare | ast.BoolOp | ast.Lambda


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


@dataclass(frozen=True)
class Edit:
    """Replacements for some places of a tree at the same time, and the kind of this change."""

    kind: str
    places: tuple[Place, ...]
    offers: tuple[Offer, ...]

    def put_into(self, tree: ast.AST) -> str:
        """Return the code of the tree with the edit, which is undone afterwards."""
        pairs = zip(self.places, self.offers, strict=True)
        restores = [place.put(offer) for place, offer in pairs]
        code = ast.unparse(ast.fix_missing_locations(tree))
        for restore in restores:
            restore()
        return code


def list_edits(
    kind: str, operator: Operator, places: Iterable[tuple[Place, ...]], names: frozenset[str]
) -> Iterator[Edit]:
    """Yield the edits by one operator; it changes several places in the same way."""
    for some in places:
        for offers in zip(*(operator(each.node, names) for each in some), strict=False):
            yield Edit(kind, some, offers)


def make_changes(code: str, names: frozenset[str] = frozenset()) -> Iterator[tuple[str, str]]:
    """Yield every change of one thing in `code`: the operator's name and the code after it.

    `names` are the variables in scope beside those of the code itself. The code comes in the
    layout of `ast.unparse`.
    """
    tree = ast.parse(code)
    known = names | names_in(tree)
    for place in list(walk_places(tree)):
        for operator in OPERATORS:
            for edit in list_edits(operator.__name__, operator, [(place,)], known):
                yield edit.kind, edit.put_into(tree)


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


def leave_out_statement(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Remove a statement."""
    if isinstance(node, ast.stmt):
        yield []


def leave_out_condition(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Run the body of an `if` in every case."""
    if isinstance(node, ast.If) and not node.orelse:
        yield node.body


def add_statement(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Return before a statement, or run it twice."""
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


# ---------------------------------------------------------------- operators that may mend a line


def change_sign(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `x` by `-x`."""
    if isinstance(node, ast.expr) and not isinstance(node, ATOMS | ast.UnaryOp):
        yield ast.UnaryOp(ast.USub(), node)


def leave_out_term(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `x + y`, `x and y`, `x if z else y`, `max(x, y)` and similar by `x` or `y`."""
    match node:
        case ast.BinOp(left, op, right) if isinstance(op, SUMS):
            yield from (left, right)
        case ast.IfExp(_, left, right):
            yield from (left, right)
        case ast.BoolOp(values=parts) | ast.Call(ast.Name("max" | "min"), args=parts):
            yield from parts


def move_bracket(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `x + y * z` by `(x + y) * z`, also in longer sums, and the reverse."""
    match node:
        case ast.BinOp(
            ast.BinOp(left, ast.Add() | ast.Sub() as plus, right),
            ast.Mult() | ast.Div() as times,
            factor,
        ):
            yield ast.BinOp(left, plus, ast.BinOp(right, times, factor))
        case ast.BinOp(_, ast.Add() | ast.Sub(), last):
            terms = terms_of(node)
            factors: list[tuple[ast.operator, ast.expr]] = []
            while isinstance(last, ast.BinOp) and isinstance(last.op, ast.Mult | ast.Div):
                factors.insert(0, (last.op, last.right))
                last = last.left
                for first in range(len(terms) - 1):
                    inner = add_up([*terms[first:-1], (terms[-1][0], last)])
                    for op, factor in factors:
                        inner = ast.BinOp(inner, op, factor)
                    yield add_up([*terms[:first], (terms[first][0], inner)])


def terms_of(node: ast.expr) -> list[tuple[ast.operator, ast.expr]]:
    """Return the terms of a sum, each with the sign before it."""
    match node:
        case ast.BinOp(left, ast.Add() | ast.Sub() as plus, right):
            return [*terms_of(left), (plus, right)]
    return [(ast.Add(), node)]


def add_up(terms: list[tuple[ast.operator, ast.expr]]) -> ast.expr:
    whole = terms[0][1]
    for plus, term in terms[1:]:
        whole = ast.BinOp(whole, plus, term)
    return whole


def swap_operands(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `x - y` by `y - x`."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Sub | ast.Div):
        yield ast.BinOp(node.right, node.op, node.left)


def swap_targets(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `x, y = z` by `y, x = z`."""
    match node:
        case ast.Assign([ast.Tuple([first, second], ctx)], value):
            yield ast.Assign([ast.Tuple([second, first], ctx)], value)


def change_and(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `and` by `or`."""
    if isinstance(node, ast.BoolOp):
        yield ast.BoolOp(ast.Or() if isinstance(node.op, ast.And) else ast.And(), node.values)


def use_a_similar_name(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `v1` by `v2`, and `vel_b` by `vel_a`."""
    if isinstance(node, ast.Name) and node.id in names:
        stem = ENDING.sub("", node.id)
        for each in sorted(names - {node.id}):
            if ENDING.sub("", each) == stem:
                yield ast.Name(each, node.ctx)


def use_another_name(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Use another name."""
    if isinstance(node, ast.Name) and node.id in names:
        yield from (ast.Name(each, node.ctx) for each in sorted(names - {node.id}))


def use_another_attribute(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `b.pos.x` by `b.pos.y`."""
    if isinstance(node, ast.Attribute):
        for other in related_names(node.attr, CONFUSED):
            yield ast.Attribute(node.value, other, node.ctx)


def double(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `x` by twice or half of it."""
    if isinstance(node, ast.expr) and not isinstance(node, ATOMS):
        yield from (ast.BinOp(node, ast.Mult(), ast.Constant(each)) for each in (2, 0.5))


def add_factor(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Multiply by a name, or divide by it."""
    if isinstance(node, ast.expr) and not isinstance(node, ATOMS):
        for each in sorted(names):
            yield ast.BinOp(node, ast.Mult(), ast.Name(each))
            yield ast.BinOp(node, ast.Div(), ast.Name(each))


def add_limit(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `x` by `max(0, x)`, `min(0, x)` or `abs(x)`."""
    if isinstance(node, ast.expr) and not isinstance(node, ATOMS):
        for name in ("max", "min"):
            yield ast.Call(ast.Name(name), [ast.Constant(0), node], [])
        yield ast.Call(ast.Name("abs"), [node], [])


def add_to_it(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `=` by `+=` or `-=`."""
    match node:
        case ast.Assign([ast.Name() | ast.Attribute() as target], value):
            yield from (ast.AugAssign(target, sign, value) for sign in (ast.Add(), ast.Sub()))


OPERATORS: tuple[Operator, ...] = (  # of mutants
    change_arithmetic,
    change_comparison,
    change_constant,
    change_name,
    unwrap,
    swap_arguments,
    change_update,
    change_condition,
    leave_out_statement,
    leave_out_condition,
    add_statement,
    cut_loop_short,
)
