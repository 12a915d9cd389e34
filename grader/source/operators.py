"""Small changes to a piece of code: swap, drop, shift or negate one thing at a time.

Each operator looks at one node of the syntax tree and offers others in its place. What comes out is
a piece of code that a hurried student could have written, and that a good check should notice.
"""

import ast
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

Offer = ast.AST | list[ast.stmt]  # what stands in the place of one node
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
NAMES = (  # variables that are easily taken for one another
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
ANY_ORDER = {"max", "min"}  # two arguments of these may change places


@dataclass(frozen=True)
class Place:
    """Where a node hangs in its tree: a field of its parent, or an item of such a field."""

    parent: ast.AST
    field: str
    index: int | None

    @property
    def node(self) -> Any:
        held = getattr(self.parent, self.field)
        return held if self.index is None else held[self.index]

    def put(self, offer: Offer) -> Callable[[], None]:
        """Hang `offer` here; returns what puts everything back."""
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


def places(tree: ast.AST) -> Iterator[Place]:
    """Every place in a tree, outer ones first."""
    for field, value in ast.iter_fields(tree):
        items = list(enumerate(value)) if isinstance(value, list) else [(None, value)]
        for index, item in items:
            if isinstance(item, ast.AST):
                yield Place(tree, field, index)
                yield from places(item)


def changes(code: str, names: frozenset[str] = frozenset()) -> Iterator[tuple[str, str]]:
    """Every change of one thing in `code`: the operator's name, and the code after it.

    `names` are the variables in scope beside those of the code itself. The code comes in the
    layout of `ast.unparse`; a change that is no change is left out, and so is one made before.
    """
    tree = ast.parse(code)
    known = names | names_in(tree)
    seen = {ast.unparse(tree)}
    for place in list(places(tree)):
        for operator in OPERATORS:
            for offer in operator(place.node, known):
                restore = place.put(offer)
                text = ast.unparse(ast.fix_missing_locations(tree))
                restore()
                if text not in seen:
                    seen.add(text)
                    yield operator.__name__, text


def names_in(tree: ast.AST) -> frozenset[str]:
    """The variables and parameters that a piece of code speaks of."""
    variables = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    return frozenset(variables | {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)})


def normal(code: str) -> str:
    """The code in the layout that all changes have."""
    return ast.unparse(ast.parse(code))


# ---------------------------------------------------------------- the operators


def other_arithmetic(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """`+` for `-`, `*` for `/`, and `*` for `**`."""
    if isinstance(node, ast.BinOp) and type(node.op) in ARITHMETIC:
        yield ast.BinOp(node.left, ARITHMETIC[type(node.op)](), node.right)


def other_comparison(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """`<=` or `>` for `<`, and so on."""
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        for other in COMPARISONS.get(type(node.ops[0]), ()):
            yield ast.Compare(node.left, [other()], node.comparators)


def other_constant(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """One more, half as much, the other sign, 0 or 1."""
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        value = node.value
        assert isinstance(value, int | float)
        for other in dict.fromkeys((value + 1, value / 2, -value, 0, 1)):
            if other != value:
                yield ast.Constant(other)


def other_name(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """A name or an attribute of like kind."""
    if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
        for other in kin(node.id, NAMES):
            if other in names:
                yield ast.Name(other, node.ctx)
    if isinstance(node, ast.Attribute):
        for other in kin(node.attr, ATTRIBUTES):
            yield ast.Attribute(node.value, other, node.ctx)


def kin(name: str, groups: Iterable[tuple[str, ...]]) -> list[str]:
    return [each for group in groups if name in group for each in group if each != name]


def max_for_min(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """`max` for `min`, and the other way round."""
    if isinstance(node, ast.Name) and node.id in ("max", "min"):
        yield ast.Name("min" if node.id == "max" else "max", node.ctx)


def no_minus(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """`x` for `-x`, and `x` for `not x`."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not):
        yield node.operand


def no_call(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """`x` for `abs(x)` and for any other function of one thing."""
    if isinstance(node, ast.Call) and len(node.args) == 1 and not node.keywords:
        yield node.args[0]


def arguments_swapped(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """`f(y, x)` for `f(x, y)`, neighbour by neighbour; a tuple's items likewise."""
    if isinstance(node, ast.Call):
        if isinstance(node.func, ast.Name) and node.func.id in ANY_ORDER:
            return
        for items in neighbours_swapped(node.args):
            yield ast.Call(node.func, items, node.keywords)
    if isinstance(node, ast.Tuple) and isinstance(node.ctx, ast.Load):
        for items in neighbours_swapped(node.elts):
            yield ast.Tuple(items, node.ctx)


def neighbours_swapped(items: list[ast.expr]) -> Iterator[list[ast.expr]]:
    for first in range(len(items) - 1):
        yield [*items[:first], items[first + 1], items[first], *items[first + 2 :]]


def other_update(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """`-=` or plain `=` for `+=`, and so on."""
    if isinstance(node, ast.AugAssign):
        if type(node.op) in ARITHMETIC:
            yield ast.AugAssign(node.target, ARITHMETIC[type(node.op)](), node.value)
        yield ast.Assign([node.target], node.value)


def other_condition(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """The opposite condition; and `if` for `while`."""
    if isinstance(node, ast.If):
        yield ast.If(ast.UnaryOp(ast.Not(), node.test), node.body, node.orelse)
    if isinstance(node, ast.While):
        yield ast.While(ast.UnaryOp(ast.Not(), node.test), node.body, node.orelse)
        yield ast.If(node.test, node.body, node.orelse)
    if isinstance(node, ast.IfExp):
        yield ast.IfExp(node.test, node.orelse, node.body)


def no_statement(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """A statement left out; of an `if`, also the condition alone."""
    if isinstance(node, ast.stmt):
        yield []
    if isinstance(node, ast.If) and not node.orelse:
        yield node.body


def early_return(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """A bare return before a statement."""
    if isinstance(node, ast.stmt) and not isinstance(node, ast.Return):
        yield [ast.Return(None), node]


OPERATORS: tuple[Operator, ...] = (
    other_arithmetic,
    other_comparison,
    other_constant,
    other_name,
    max_for_min,
    no_minus,
    no_call,
    arguments_swapped,
    other_update,
    other_condition,
    no_statement,
    early_return,
)
