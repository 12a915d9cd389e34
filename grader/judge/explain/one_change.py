"""Find the line in which one small change makes a failed check pass.

The report names the line and the kind of change, never the change itself. This is only for a
student's own work, since it may take as long as all checks together.
"""

import ast
import builtins
import re
import textwrap
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import chain, combinations, islice

from grader.source.definitions import find_function, statements
from grader.source.operators import (
    Offer,
    Place,
    change_arithmetic,
    change_comparison,
    change_condition,
    change_constant,
    change_update,
    names_in,
    related_names,
    swap_arguments,
    unwrap,
    walk_places,
)
from grader.source.regions import Region, regions_in, replace_regions

MOST_TRIED = 150  # changes
LONGEST, MOST_LETTERS = 80, 6000  # lines of a region, and letters; an answer has a dozen lines
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
ENDING = re.compile(r"\d+|_[a-z]$")  # in which similar names differ
SUMS = ast.Add | ast.Sub | ast.Mult | ast.Div
NAMED = re.compile(r"(?:id|attr|value)=(?:'\w*'|[\d.e+-]+)")  # in the output of ast.dump
ATOMS = ast.Constant | ast.Tuple | ast.List | ast.Compare | ast.BoolOp | ast.Lambda

Change = Callable[[ast.AST, frozenset[str]], Iterator[Offer]]


@dataclass(frozen=True)
class Variant:
    """A region with one change."""

    lines: tuple[int, ...]  # of the region, from 1; two if both of two similar lines are changed
    how: str  # in words
    code: str


@dataclass(frozen=True)
class Mend:
    """The lines of a file in which a change makes checks pass, and its kind in words."""

    file: str
    lines: tuple[int, ...]
    how: str

    @property
    def in_words(self) -> str:
        lines = " and in line ".join(map(str, self.lines))
        return f"{self.how} line {lines}, this passes: look there."


def find_mend(
    text: str,
    about: tuple[str, str, str],
    passes: Callable[[str], bool],
    has_time: Callable[[], bool],
) -> Mend | None:
    """Return the line of a file in which a change makes checks pass, or None if none is found.

    `about`: the file's name, the TODO and the path of its function. `passes` runs the checks on a
    changed text of the file, and `has_time` returns whether there is time for another one.
    """
    file, todo, path = about
    function = find_function(statements(text), path)
    regions = [each for each in regions_in(text) if each.id == todo]
    if function is None or len(regions) != 1:
        return None
    (region,) = regions
    parameters = frozenset(each.arg for each in function.args.args)
    try:
        for variant in islice(make_variants(region, parameters), MOST_TRIED):
            if not has_time():
                return None
            if passes(put_into(text, region, variant.code)):
                return Mend(file, tuple(region.start + 1 + n for n in variant.lines), variant.how)
    except (RecursionError, ValueError):  # thousands of terms, or code that cannot be unparsed
        pass
    return None


def make_variants(region: Region, names: frozenset[str]) -> Iterator[Variant]:
    """Yield the region with one change; kinds of changes with few places come first.

    Yield none if Python refuses the region, or it is long. `names` are the function's parameters.
    """
    if len(region.lines) > LONGEST or sum(map(len, region.lines)) > MOST_LETTERS:
        return
    try:
        tree = ast.parse(textwrap.dedent("\n".join(region.lines)))
    except SyntaxError:
        return
    own = frozenset(n for n in names | names_in(tree) if n not in dir(builtins) and is_value(n))
    ends = set(find_ends(tree))
    places = [(each,) for each in find_places(tree) if each.node.lineno not in ends]
    twins = list(islice(find_twins(tree), MOST_TRIED * MOST_TRIED))
    groups = [list_changes(how, change, places, own) for how, change in KINDS]
    groups += [list_changes(how, change, twins, own) for how, change in IN_TWINS]
    seen = {ast.unparse(tree)}
    for each in chain(*sorted(groups, key=len)):
        code = each.put_into(tree)
        if code not in seen:
            seen.add(code)
            yield Variant(tuple(place.node.lineno for place in each.places), each.how, code)


def is_value(name: str) -> bool:
    """Return whether a name may refer to a number or a vector, not to a class."""
    return name.islower() or name.isupper()


def find_places(tree: ast.AST) -> Iterator[Place]:
    for place in walk_places(tree):
        loaded = isinstance(getattr(place.node, "ctx", ast.Load()), ast.Load)
        in_text = isinstance(place.parent, ast.JoinedStr)  # whose parts cannot be replaced
        if loaded and isinstance(place.node, ast.expr | ast.stmt) and not in_text:
            yield place


def find_twins(tree: ast.AST) -> Iterator[tuple[Place, Place]]:
    """Yield pairs of places in two statements that differ only in names and numbers."""
    twins: dict[str, list[ast.stmt]] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign | ast.AugAssign):
            shape = NAMED.sub("", ast.dump(node))
            twins.setdefault(shape, []).append(node)
    for first, second in chain(*(combinations(some, 2) for some in twins.values())):
        yield from zip(find_places(first), find_places(second), strict=True)


@dataclass(frozen=True)
class Edit:
    """Code to put into some places at the same time, and the kind of this change in words."""

    how: str
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


def list_changes(
    how: str, change: Change, places: Iterable[tuple[Place, ...]], names: frozenset[str]
) -> list[Edit]:
    """Return the edits of one kind in these places, at most as many as are tried."""
    found = (
        Edit(how, some, offers)
        for some in places
        for offers in zip(*(change(each.node, names) for each in some), strict=False)
    )
    return list(islice(found, MOST_TRIED))


def find_ends(tree: ast.AST) -> Iterator[int]:
    """Yield the lines that decide when a `while` ends: an endless loop would take long to try."""
    for loop in ast.walk(tree):
        if not isinstance(loop, ast.While):
            continue
        yield loop.lineno
        tested = {ast.unparse(node) for node in ast.walk(loop.test)}
        for node in ast.walk(loop):
            match node:
                case ast.Assign(targets):
                    changed = [ast.unparse(each) for each in targets]
                case ast.AugAssign(target):
                    changed = [ast.unparse(target)]
                case _:
                    continue
            if tested.intersection(changed):
                yield node.lineno


def put_into(text: str, region: Region, code: str) -> str:
    """Return a file's text with other code in the region."""
    indents = [len(each) - len(each.lstrip()) for each in region.lines if each.strip()]
    new = textwrap.indent(code, " " * min(indents, default=0)).split("\n")
    return replace_regions(text, {region.id: tuple(new)})


# ---------------------------------------------------------------- the changes


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


def leave_out_statement(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Remove a statement."""
    if isinstance(node, ast.stmt):
        yield []


def leave_out_condition(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Run the body of an `if` in every case."""
    if isinstance(node, ast.If) and not node.orelse:
        yield node.body


def add_to_it(node: ast.AST, names: frozenset[str]) -> Iterator[Offer]:
    """Replace `=` by `+=` or `-=`."""
    match node:
        case ast.Assign([ast.Name() | ast.Attribute() as target], value):
            yield from (ast.AugAssign(target, sign, value) for sign in (ast.Add(), ast.Sub()))


KINDS: tuple[tuple[str, Change], ...] = (  # each with its words about the line
    ("With another operator in", change_arithmetic),
    ("With another comparison in", change_comparison),
    ("Without the statement that begins in", leave_out_statement),
    ("Without the condition in", leave_out_condition),
    ("With another of =, += and -= in", change_update),
    ("With another of =, += and -= in", add_to_it),
    ("Without a part of", unwrap),
    ("Without a part of", leave_out_term),
    ("With brackets elsewhere in", move_bracket),
    ("With the two sides of an operator exchanged in", swap_operands),
    ("With another order of the items in brackets in", swap_arguments),
    ("With another order of names in", swap_targets),
    ("With `and` and `or` exchanged in", change_and),
    ("With the opposite condition in", change_condition),
    ("With another number in", change_constant),
    ("With another sign in", change_sign),
    ("With another name in", use_a_similar_name),
    ("With another name in", use_another_attribute),
    ("With another name in", use_another_name),
    ("With a limit or abs() in", add_limit),
    ("With one more factor in", double),
    ("With one more factor in", add_factor),
)
IN_TWINS: tuple[tuple[str, Change], ...] = (  # changes of two similar lines at once
    ("With another operator in", change_arithmetic),
    ("With brackets elsewhere in", move_bracket),
    ("With the two sides of an operator exchanged in", swap_operands),
    ("With another number in", change_constant),
    ("Without a part of", leave_out_term),
)
