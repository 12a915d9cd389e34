"""Changes to what a whole region does: beside its result, to some inputs, from some call on.

The operators of `operators.py` change one node, and need not know what it means. Those here make
what students and their assistants write: a function that works in every scene somebody looked at,
and does more than it should, or something else for inputs that were never tried. They need to know
what is a body and what a number, and how large that usually is: `scopes.toml` tells them.
"""

import ast
import copy
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import msgspec
from msgspec import Struct

Code = list[ast.stmt]


class Scale(Struct, frozen=True, forbid_unknown_fields=True):
    """How large a number usually is, where it counts as small or large, and a grid to round to."""

    usual: float
    small: float
    large: float
    grid: float
    zero: bool = True  # whether it may be 0


class Scope(Struct, frozen=True, forbid_unknown_fields=True):
    """What the names in one TODO's region mean; `scopes.toml` says more of each field."""

    bodies: list[str] = []
    each: str = ""
    crowds: list[str] = []
    vectors: list[str] = []
    pairs: list[str] = []
    numbers: list[str] = []
    sizes: list[str] = []
    lists: list[str] = []
    deeds: list[str] = []
    cases: list[str] = []
    roles: list[tuple[str, str]] = []
    reads: dict[str, Scale] = {}
    results: dict[str, Scale] = {}
    answers: list[str] = []
    products: list[str] = []
    many: int = 100
    parameters: frozenset[str] = frozenset()  # of the function
    unfinished: str = ""  # what the starter has in the place of the region

    def all_vectors(self) -> list[str]:
        return [*self.vectors, *(f"{body}.{field}" for body in self.bodies for field in MOVING)]

    def all_numbers(self) -> list[str]:
        return [*self.numbers, *(f"{body}.{field}" for body in self.bodies for field in NUMBERS)]

    def inverses(self) -> list[str]:
        return [f"{body}.{field}" for body in self.bodies for field in INVERSES]

    def ways_to_bodies(self) -> Iterator[tuple[str, str]]:
        """A name for some bodies, and the loop that it needs to stand for each of them."""
        yield from ((body, "") for body in [*self.bodies, *filter(None, [self.each])])
        yield from (("body", f"for body in {crowd}:\n    ") for crowd in self.crowds)


Slip = Callable[[Code, Scope], Iterator[Code]]

MOVING = ("pos", "vel")  # vectors of a body
NUMBERS = ("angle", "omega", "friction", "restitution")
INVERSES = ("inv_mass", "inv_inertia")  # smaller they may be; a static body has none


@cache
def scopes() -> dict[str, Scope]:
    """By TODO, what can be said of it in advance."""
    path = Path(__file__).with_name("scopes.toml")
    return msgspec.toml.decode(path.read_bytes(), type=dict[str, Scope])


def slipped(code: str, scope: Scope) -> Iterator[tuple[str, str]]:
    """Every slip in `code`: the operator's name and the code after it, no code twice."""
    tree = ast.parse(code)
    seen = {ast.unparse(tree)}
    for slip in SLIPS:
        for body in slip(copy.deepcopy(tree.body), scope):
            text = ast.unparse(ast.fix_missing_locations(ast.Module(body, [])))
            if text not in seen:
                seen.add(text)
                yield slip.__name__, text


# ---------------------------------------------------------------- ways to put them in


def parsed(text: str) -> Code:
    return ast.parse(text).body


def expression(text: str) -> ast.expr:
    return ast.parse(text, mode="eval").body


class Leaving(ast.NodeTransformer):
    """Do something last: before each return, with `answer` for what it returns."""

    def __init__(self, deed: str) -> None:
        self.deed = deed
        self.asks = any(name.startswith("answer") for name in names_of(deed))

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        return node  # its returns are its own

    def visit_Return(self, node: ast.Return) -> ast.AST | Code:
        value = node.value
        if value is None or (isinstance(value, ast.Constant) and value.value is None):
            return node if self.asks else [*parsed(self.deed), node]
        if isinstance(value, ast.Tuple):
            answer = ", ".join(f"answer_{index}" for index in range(len(value.elts)))
        else:
            answer = "answer"
        text = f"{answer} = {ast.unparse(value)}\n{self.deed}\nreturn {answer}"
        return parsed(text)


def leaving(code: Code, deed: str, scope: Scope) -> Code:
    """`code` that does `deed` at its end; for each body of its loop, where `deed` speaks of one."""
    code = copy.deepcopy(code)
    if scope.each and scope.each in names_of(deed) and not deed.startswith("for "):
        body = loop_over(code, scope.each).body
        body += parsed(deed)
        return code
    leave = Leaving(deed)
    changed: Code = leave.visit(ast.Module(code, [])).body
    if leave.asks or isinstance(changed[-1], ast.Return):
        return changed
    return [*changed, *parsed(deed)]


def loop_over(code: Code, name: str) -> ast.For:
    """The loop with this variable."""
    return next(
        node
        for node in ast.walk(ast.Module(code, []))
        if isinstance(node, ast.For) and name in names_of(ast.unparse(node.target))
    )


def unless(code: Code, condition: str, scope: Scope) -> Code:
    """The region as the starter has it where `condition` holds, `code` elsewhere.

    In a loop over bodies, one of which is spoken of, that body is passed over.
    """
    code = copy.deepcopy(code)
    test = expression(condition)
    if scope.each and scope.each in names_of(condition):
        loop_over(code, scope.each).body.insert(0, ast.If(test, [ast.Continue()], []))
        return code
    other = parsed(scope.unfinished) or [ast.Pass()]
    if isinstance(other[-1], ast.Return):
        return [ast.If(test, other, []), *code]
    return [ast.If(test, other, code)]


def reading(code: Code, read: str, instead: str, scope: Scope) -> Code:
    """`code` that takes `instead` for the number `read`; a parameter is changed first of all."""
    code = copy.deepcopy(code)
    if read in scope.parameters:
        return [*parsed(f"{read} = {instead}"), *code]
    changed: Code = Instead(read, instead).visit(ast.Module(code, [])).body
    return changed


class Instead(ast.NodeTransformer):
    """Put one expression in the place of another wherever its value is used."""

    def __init__(self, old: str, new: str) -> None:
        self.old = old
        self.new = new

    def generic_visit(self, node: ast.AST) -> ast.AST:
        loaded = isinstance(getattr(node, "ctx", ast.Load()), ast.Load)
        if isinstance(node, ast.expr) and loaded and ast.unparse(node) == self.old:
            return expression(self.new)
        return super().generic_visit(node)


def names_of(text: str) -> set[str]:
    """The variables in a piece of code, but for those that it binds in a comprehension."""
    tree = ast.parse(text)
    bound = {
        name.id
        for node in ast.walk(tree)
        if isinstance(node, ast.comprehension)
        for name in ast.walk(node.target)
        if isinstance(name, ast.Name)
    }
    return {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)} - bound


# ---------------------------------------------------------------- doing more than was asked


def zeroes_input(code: Code, scope: Scope) -> Iterator[Code]:
    """An input that must stay is 0 afterwards: `a.vel *= 0`."""
    for name in [*scope.all_vectors(), *scope.pairs]:
        yield leaving(code, f"{name} *= 0", scope)
    for name in scope.all_numbers():
        yield leaving(code, f"{name} = 0", scope)
    for body, loop in scope.ways_to_bodies():
        if body not in scope.bodies:
            yield leaving(code, f"{loop}{body}.vel *= 0", scope)
            yield leaving(code, f"{loop}{body}.omega = 0", scope)
            yield leaving(code, f"{loop}{body}.angle = 0", scope)


def moves_input(code: Code, scope: Scope) -> Iterator[Code]:
    """An input that must stay is a little more afterwards: `a.pos += (1, 0)`."""
    for name in [*scope.all_vectors(), *scope.pairs]:
        yield leaving(code, f"{name} += (1, 0)", scope)
    for name in [*scope.all_numbers(), *scope.sizes]:
        yield leaving(code, f"{name} += 1", scope)
    for body, loop in scope.ways_to_bodies():
        if body not in scope.bodies:
            yield leaving(code, f"{loop}{body}.pos += (0, 1)", scope)


def damps_input(code: Code, scope: Scope) -> Iterator[Code]:
    """An input that must stay is a little smaller afterwards: `a.omega *= 0.99`."""
    numbers = [*scope.all_numbers(), *scope.inverses()]
    for name in [*scope.all_vectors(), *scope.pairs, *numbers]:
        yield leaving(code, f"{name} *= 0.99", scope)
    for body, loop in scope.ways_to_bodies():
        if body not in scope.bodies:
            yield leaving(code, f"{loop}{body}.vel *= 0.99", scope)
            yield leaving(code, f"{loop}{body}.omega *= 0.99", scope)


def turns_input(code: Code, scope: Scope) -> Iterator[Code]:
    """A vector that must stay is turned or made a unit vector, itself and not a copy of it."""
    for name in scope.all_vectors():
        yield leaving(code, f"{name}.rotate_ip(90)", scope)
        yield leaving(code, f"if {name}:\n    {name}.normalize_ip()", scope)


def rounds_input(code: Code, scope: Scope) -> Iterator[Code]:
    """An input that must stay is rounded: `a.pos.x = round(a.pos.x)`."""
    for name in scope.all_vectors():
        yield leaving(code, f"{name}.x = round({name}.x)", scope)
    for name in [*scope.all_numbers(), *scope.inverses()]:
        yield leaving(code, f"{name} = round({name}, 2)", scope)


def empties_list(code: Code, scope: Scope) -> Iterator[Code]:
    """A list that must stay loses one item, or all."""
    for name in scope.lists:
        yield leaving(code, f"{name}.clear()", scope)
        yield leaving(code, f"del {name}[-1:]", scope)


def reorders_list(code: Code, scope: Scope) -> Iterator[Code]:
    """A list that must stay comes in another order."""
    for name in scope.lists:
        yield leaving(code, f"{name}.reverse()", scope)
        yield leaving(code, f"{name}.append({name}.pop(0)) if {name} else None", scope)


def grows_list(code: Code, scope: Scope) -> Iterator[Code]:
    """A list that must stay gets one of its items a second time."""
    for name in scope.lists:
        yield leaving(code, f"{name}.extend({name}[:1])", scope)


def does_more(code: Code, scope: Scope) -> Iterator[Code]:
    """Something that nobody asked for, after the work."""
    for deed in scope.deeds:
        yield leaving(code, deed, scope)


def stores_result(code: Code, scope: Scope) -> Iterator[Code]:
    """A result is written to an input as well."""
    for result in scope.results:
        for name in [*scope.all_numbers(), *scope.sizes]:
            yield leaving(code, f"{name} = {result}", scope)


def returns_input(code: Code, scope: Scope) -> Iterator[Code]:
    """A vector of the input is overwritten with the result and handed on in its place."""
    for product in scope.products:
        for name in scope.all_vectors():
            yield leaving(code, f"{name}.update({product})\n{product} = {name}", scope)


def changes_in_place(code: Code, scope: Scope) -> Iterator[Code]:
    """`low = b.pos; low -= half`, which moves b: an operation on a vector itself, not on a copy."""
    for place, index in statement_places(code):
        statement = place[index]
        if not isinstance(statement, ast.Assign | ast.AugAssign | ast.Return | ast.Expr):
            continue
        for node in operations(statement):
            left, sign = ast.unparse(node.left), SIGNS[type(node.op)]
            update = parsed(f"{left} {sign}= {ast.unparse(node.right)}")
            rest = Instead(ast.unparse(node), left).visit(copy.deepcopy(statement))
            place[index : index + 1] = [*update, rest]
            yield copy.deepcopy(code)
            place[index : index + 2] = [statement]


SIGNS: dict[type[ast.operator], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
}


def operations(statement: ast.stmt) -> Iterator[ast.BinOp]:
    """Each `u + v` in a statement whose left side is a variable or a field."""
    inner = {
        id(node)
        for part in ast.walk(statement)
        if isinstance(part, ast.comprehension | ast.Lambda | ast.ListComp)
        for node in ast.walk(part)
    }
    for node in ast.walk(statement):
        if not isinstance(node, ast.BinOp) or id(node) in inner or type(node.op) not in SIGNS:
            continue
        if isinstance(node.left, ast.Name | ast.Attribute):
            yield node


# ---------------------------------------------------------------- wrong for some inputs


def for_bodies(code: Code, scope: Scope, *cases: str) -> Iterator[Code]:
    """The unfinished region where one of these holds for one of the bodies."""
    for body in [*scope.bodies, *filter(None, [scope.each])]:
        for case in cases:
            yield unless(code, case.replace("body", body), scope)


def wrong_for_static(code: Code, scope: Scope) -> Iterator[Code]:
    """Wrong where one of the bodies is static, or where it is not."""
    yield from for_bodies(code, scope, "body.is_static", "not body.is_static")


def wrong_one_way(code: Code, scope: Scope) -> Iterator[Code]:
    """Wrong for a body that moves up, or to the left, or that turns one way."""
    yield from for_bodies(code, scope, "body.vel.y < 0", "body.vel.x < 0", "body.omega < 0")


def wrong_when_fast(code: Code, scope: Scope) -> Iterator[Code]:
    """Wrong for a body that is fast, spins fast or is just at rest."""
    yield from for_bodies(code, scope, "body.vel.length() > 1000", "abs(body.omega) > 20")
    yield from for_bodies(code, scope, "not body.vel", "body.omega == 0")


def wrong_off_screen(code: Code, scope: Scope) -> Iterator[Code]:
    """Wrong for negative coordinates, and far away."""
    yield from for_bodies(code, scope, "body.pos.x < 0", "body.pos.y < 0", "body.pos.x > 2000")


def wrong_for_extremes(code: Code, scope: Scope) -> Iterator[Code]:
    """Wrong for a very light or heavy body, and for rough, smooth or bouncy ones."""
    yield from for_bodies(code, scope, "body.inv_mass > 10", "0 < body.inv_mass < 0.01")
    yield from for_bodies(code, scope, "body.friction == 0", "body.restitution > 0.9")


def wrong_in_a_case(code: Code, scope: Scope) -> Iterator[Code]:
    """Wrong in a case that is none: what the docstring says holds for it as well."""
    for case in scope.cases:
        yield unless(code, case, scope)


# ---------------------------------------------------------------- another number than was given


def misread(code: Code, scope: Scope, how: str) -> Iterator[Code]:
    """`how` says what is taken for a number, in terms of `it` and of its scale."""
    for read, scale in scope.reads.items():
        if scale.zero or how != DEAD_ZONE:
            yield reading(code, read, filled(how, read, scale), scope)


DEAD_ZONE = "{it} if abs({it}) > {small} else 0"


def filled(how: str, name: str, scale: Scale) -> str:
    """`how` for one number; 0 and other whole ones are written without a point."""
    values = msgspec.structs.asdict(scale)
    plain = {key: int(each) if each == int(each) else each for key, each in values.items()}
    return how.format(it=name, **plain)


def usual_read(code: Code, scope: Scope) -> Iterator[Code]:
    """A constant for a number that was given: a radius of 10, a step of 1/120 s."""
    yield from misread(code, scope, "{usual}")


def snapped_read(code: Code, scope: Scope) -> Iterator[Code]:
    """A number that was given is rounded to a grid."""
    yield from misread(code, scope, "round({it} / {grid}) * {grid}")


def snapped_to_usual(code: Code, scope: Scope) -> Iterator[Code]:
    """A number near the usual one is taken for that."""
    yield from misread(code, scope, "{usual} if abs({it} - {usual}) <= {grid} / 2 else {it}")


def capped_read(code: Code, scope: Scope) -> Iterator[Code]:
    """No number counts as more than a large one."""
    yield from misread(code, scope, "min({it}, {large})")


def floored_read(code: Code, scope: Scope) -> Iterator[Code]:
    """No number counts as less than a small one."""
    yield from misread(code, scope, "max({it}, {small})")


def dead_zone_read(code: Code, scope: Scope) -> Iterator[Code]:
    """Small numbers count as 0."""
    yield from misread(code, scope, DEAD_ZONE)


def unsigned_read(code: Code, scope: Scope) -> Iterator[Code]:
    """Negative numbers count as positive, or as 0."""
    yield from misread(code, scope, "abs({it})")
    yield from misread(code, scope, "max({it}, 0)")


def whole_read(code: Code, scope: Scope) -> Iterator[Code]:
    """What follows the point is cut off."""
    yield from misread(code, scope, "int({it})")


def first_read(code: Code, scope: Scope) -> Iterator[Code]:
    """The number of the first call is used ever after."""
    yield from misread(code, scope, "globals().setdefault('first', {it})")


def late_read(code: Code, scope: Scope) -> Iterator[Code]:
    """The number of the call before is used, as when a state is updated too late."""
    yield from misread(code, scope, LATE)


LATE = "(globals().setdefault('late', [{it}]).append({it}), globals()['late'].pop(0))[1]"


# ---------------------------------------------------------------- another result


def misput(code: Code, scope: Scope, how: str) -> Iterator[Code]:
    """`how` says what becomes of a result, in terms of `it` and of its scale."""
    for result, scale in scope.results.items():
        if scale.zero or how != DEAD_ZONE:
            yield leaving(code, f"{result} = {filled(how, result, scale)}", scope)


def capped_result(code: Code, scope: Scope) -> Iterator[Code]:
    """No result is larger than a large one; nor smaller than its negative."""
    yield from misput(code, scope, "min({it}, {large})")
    yield from misput(code, scope, "max(-{large}, min({it}, {large}))")


def floored_result(code: Code, scope: Scope) -> Iterator[Code]:
    """No result is smaller than a small one, or than 0."""
    yield from misput(code, scope, "max({it}, {small})")
    yield from misput(code, scope, "max({it}, 0)")


def dead_zone_result(code: Code, scope: Scope) -> Iterator[Code]:
    """Small results are 0."""
    yield from misput(code, scope, DEAD_ZONE)


def rounded_result(code: Code, scope: Scope) -> Iterator[Code]:
    """Results are rounded to a grid, or to a few places."""
    yield from misput(code, scope, "round({it} / {grid}) * {grid}")
    yield from misput(code, scope, "round({it}, 3)")


def inexact_result(code: Code, scope: Scope) -> Iterator[Code]:
    """Results are a little off, each time or at random."""
    yield from misput(code, scope, "{it} * 1.001")
    yield from misput(code, scope, "{it} * (1 + 0.001 * __import__('random').random())")


def unsigned_result(code: Code, scope: Scope) -> Iterator[Code]:
    """Results have lost their sign."""
    yield from misput(code, scope, "abs({it})")


def first_result(code: Code, scope: Scope) -> Iterator[Code]:
    """The result of the first call is given ever after."""
    yield from misput(code, scope, "globals().setdefault('first', {it})")


def late_result(code: Code, scope: Scope) -> Iterator[Code]:
    """The result of the call before is given, or the mean of both."""
    yield from misput(code, scope, LATE)
    yield from misput(code, scope, f"0.5 * {{it}} + 0.5 * {LATE}")


def other_answer(code: Code, scope: Scope) -> Iterator[Code]:
    """A list that is returned lacks an item or more, has one twice, or is in another order."""
    for answer in scope.answers:
        for other in ("[1:]", "[:-1]", "[:100]", "[::-1]", " * 2"):
            yield leaving(code, f"{answer} = {answer}{other}", scope)


# ---------------------------------------------------------------- remembering


def counts_calls(code: Code, scope: Scope) -> Iterator[Code]:
    """Wrong from the second call on or after many, at first, and now and then."""
    count = "calls = globals().setdefault('calls', [])\ncalls.append(1)"
    for case in ("> 1", f"> {scope.many}", "== 1", "% 2 == 0", f"% {scope.many} == 0"):
        yield [*parsed(count), *unless(code, f"len(calls) {case}", scope)]


def knows_bodies(code: Code, scope: Scope) -> Iterator[Code]:
    """Wrong for a body that it has met before."""
    for body in scope.bodies:
        asked = f"known = globals().setdefault('known', [])\nmet = {body} in known"
        yield [*parsed(f"{asked}\nknown.append({body})"), *unless(code, "met", scope)]


# ---------------------------------------------------------------- the wrong way round


def roles_swapped(code: Code, scope: Scope) -> Iterator[Code]:
    """Two names are taken for one another all through."""
    for one, other in scope.roles:
        yield renamed(code, {one: other, other: one})


def one_role(code: Code, scope: Scope) -> Iterator[Code]:
    """One of two names is used for both."""
    for one, other in scope.roles:
        yield renamed(code, {one: other})
        yield renamed(code, {other: one})


def renamed(code: Code, names: dict[str, str]) -> Code:
    """`code` with other names where values are used; a name with a dot before it is a field."""
    code = copy.deepcopy(code)
    for node in ast.walk(ast.Module(code, [])):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            node.id = names.get(node.id, node.id)
        elif isinstance(node, ast.Attribute):
            node.attr = names.get(f".{node.attr}", f".{node.attr}")[1:]
    return code


def statement_places(code: Code) -> Iterator[tuple[Code, int]]:
    """Each statement as its list and its index in it."""
    for node in ast.walk(ast.Module(code, [])):
        for _, value in ast.iter_fields(node):
            if isinstance(value, list) and value and isinstance(value[0], ast.stmt):
                yield from ((value, index) for index in range(len(value)))


def statements_exchanged(code: Code, scope: Scope) -> Iterator[Code]:
    """Two neighbouring statements change places, unless the second would lack a variable."""
    for place, index in statement_places(code):
        if index + 1 < len(place) and free_to_swap(
            place[index], place[index + 1], scope.parameters
        ):
            place[index], place[index + 1] = place[index + 1], place[index]
            yield copy.deepcopy(code)
            place[index], place[index + 1] = place[index + 1], place[index]


def free_to_swap(first: ast.stmt, second: ast.stmt, known: frozenset[str]) -> bool:
    """Whether the second needs no variable that only the first makes; `known` ones are there."""
    if any(isinstance(node, ast.Return) for node in (first, second)):
        return False
    bound = {
        node.id
        for node in ast.walk(first)
        if isinstance(node, ast.Name)
        and isinstance(node.ctx, ast.Store)
        and not isinstance(first, ast.AugAssign)
    }
    if isinstance(first, ast.FunctionDef):
        bound.add(first.name)
    return not (bound - known) & names_of(ast.unparse(second))


def statement_repeated(code: Code, scope: Scope) -> Iterator[Code]:
    """A statement stands there twice."""
    for place, index in statement_places(code):
        if isinstance(place[index], ast.AugAssign | ast.Expr):
            place.insert(index, copy.deepcopy(place[index]))
            yield copy.deepcopy(code)
            del place[index]


def loop_cut_short(code: Code, scope: Scope) -> Iterator[Code]:
    """A loop leaves out the first or the last, or ends after one pass or after a few."""
    for node in ast.walk(ast.Module(code, [])):
        if isinstance(node, ast.For | ast.While):
            node.body.append(ast.Break())
            yield copy.deepcopy(code)
            node.body.pop()
        if isinstance(node, ast.For):
            items, text = node.iter, ast.unparse(node.iter)
            for part in ("[1:]", "[:-1]", "[:20]"):
                node.iter = expression(f"list({text}){part}")
                yield copy.deepcopy(code)
            node.iter = items


SLIPS: tuple[Slip, ...] = (
    zeroes_input,
    moves_input,
    damps_input,
    turns_input,
    rounds_input,
    empties_list,
    reorders_list,
    grows_list,
    does_more,
    stores_result,
    returns_input,
    changes_in_place,
    wrong_for_static,
    wrong_one_way,
    wrong_when_fast,
    wrong_off_screen,
    wrong_for_extremes,
    wrong_in_a_case,
    usual_read,
    snapped_read,
    snapped_to_usual,
    capped_read,
    floored_read,
    dead_zone_read,
    unsigned_read,
    whole_read,
    first_read,
    late_read,
    capped_result,
    floored_result,
    dead_zone_result,
    rounded_result,
    inexact_result,
    unsigned_result,
    first_result,
    late_result,
    other_answer,
    counts_calls,
    knows_bodies,
    roles_swapped,
    one_role,
    statements_exchanged,
    statement_repeated,
    loop_cut_short,
)
