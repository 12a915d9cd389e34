"""Make the slips of students: changes to a whole region that look right in most scenes.

An operator of `operators.py` changes one node and need not know what it means. A slip does more
than was asked, or goes wrong for some inputs or from some call on. `slips.toml` lists them;
`scopes.toml` says what is a body or a number in each region, and how large it usually is.
"""

import ast
import copy
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.source.operators import Code, Replacer, parse_code, parse_expression


class Scale(Struct, frozen=True, forbid_unknown_fields=True):
    """The usual size of a number, what counts as small or large, and a grid to round to."""

    usual: float
    small: float
    large: float
    grid: float
    zero: bool = True  # whether it may be 0


class Scope(Struct, frozen=True, forbid_unknown_fields=True):
    """The meaning of the names in one TODO's region; `scopes.toml` explains each field."""

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

    def names(self, kind: str) -> list[str]:
        """Return the names of a kind, with the fields of bodies that are of this kind."""
        fields = [f"{body}.{field}" for body in self.bodies for field in FIELDS.get(kind, ())]
        return [*getattr(self, kind, []), *fields]

    def one_of_many(self) -> Iterator[tuple[str, str]]:
        """Yield names for one body of a loop or of a list, each with the loop that it needs."""
        if self.each:
            yield self.each, ""
        yield from (("body", f"for body in {crowd}:\n    ") for crowd in self.crowds)


FIELDS = {  # of a body; an inverse may become smaller, and a static body has none
    "vectors": ("pos", "vel"),
    "numbers": ("angle", "omega", "friction", "restitution"),
    "inverses": ("inv_mass", "inv_inertia"),
}


class SlipTable(Struct, frozen=True, forbid_unknown_fields=True):
    """The slips of `slips.toml`: by name, with what is put into the code."""

    calls: list[str]
    deeds: dict[str, dict[str, list[str]]]
    cases: dict[str, list[str]]
    reads: dict[str, list[str]]
    results: dict[str, list[str]]


HERE = Path(__file__).parent
TABLE = msgspec.toml.decode((HERE / "slips.toml").read_bytes(), type=SlipTable)
SCOPES = msgspec.toml.decode((HERE / "scopes.toml").read_bytes(), type=dict[str, Scope])  # by TODO


def make_slips(code: str, scope: Scope) -> Iterator[tuple[str, str]]:
    """Yield every slip in `code`: its name and the code after it, no code twice."""
    tree = ast.parse(code)
    seen = {ast.unparse(tree)}
    for slip in SLIPS:
        for name, body in slip(copy.deepcopy(tree.body), scope):
            text = ast.unparse(ast.fix_missing_locations(ast.Module(body, [])))
            if text not in seen:
                seen.add(text)
                yield name, text


Slip = Callable[[Code, Scope], Iterator[tuple[str, Code]]]


def do_more(code: Code, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Change inputs that must stay, add what nobody asked for, or return another list."""
    for name, deeds in TABLE.deeds.items():
        for kinds, templates in deeds.items():
            for template in templates:
                if kinds == "one of many":
                    done = [loop + template.format(it=it) for it, loop in scope.one_of_many()]
                else:
                    names = [it for kind in kinds.split() for it in scope.names(kind)]
                    done = [template.format(it=it) for it in names]
                yield from ((name, add_deed(code, deed, scope)) for deed in done)


def store_results(code: Code, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Write a result to an input as well, or overwrite a vector and return it."""
    for result in scope.results:
        for name in [*scope.names("numbers"), *scope.sizes]:
            yield "stores_result", add_deed(code, f"{name} = {result}", scope)
    for product in scope.products:
        for name in scope.names("vectors"):
            deed = f"{name}.update({product})\n{product} = {name}"
            yield "returns_input", add_deed(code, deed, scope)


def miss_cases(code: Code, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Go wrong for some bodies, or in a case for which the docstring holds as well."""
    for body in [*scope.bodies, *filter(None, [scope.each])]:
        for name, cases in TABLE.cases.items():
            for case in cases:
                yield name, skip_case(code, case.replace("body", body), scope)
    for case in scope.cases:
        yield "wrong_in_a_case", skip_case(code, case, scope)


def misread_numbers(code: Code, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Take another number than was given."""
    for name, it, value in fill_templates(TABLE.reads, scope.reads):
        yield name, replace_number(code, it, value, scope)


def change_results(code: Code, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Leave another number than was found."""
    for name, it, value in fill_templates(TABLE.results, scope.results):
        yield name, add_deed(code, f"{it} = {value}", scope)


def fill_templates(
    table: dict[str, list[str]], scales: dict[str, Scale]
) -> Iterator[tuple[str, str, str]]:
    """Yield the slip's name, a number's name and an expression; whole numbers have no point."""
    for name, templates in table.items():
        for it, scale in scales.items():
            values = msgspec.structs.asdict(scale)
            plain = {key: int(each) if each == int(each) else each for key, each in values.items()}
            for template in templates:
                if scale.zero or not template.endswith("else 0"):
                    yield name, it, template.format(it=it, **plain)


def remember_calls(code: Code, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Go wrong from some call on, now and then, or for a body that was met before."""
    count = "calls = globals().setdefault('calls', [])\ncalls.append(1)"
    for case in TABLE.calls:
        wrong = skip_case(code, f"len(calls) {case.format(many=scope.many)}", scope)
        yield "counts_calls", [*parse_code(count), *wrong]
    for body in scope.bodies:
        known = f"known = globals().setdefault('known', [])\nmet = {body} in known"
        before = parse_code(f"{known}\nknown.append({body})")
        yield "knows_bodies", [*before, *skip_case(code, "met", scope)]


def confuse_roles(code: Code, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Take two names for one another all through, or use one for both."""
    for one, other in scope.roles:
        yield "roles_swapped", rename(code, {one: other, other: one})
        yield "one_role", rename(code, {one: other})
        yield "one_role", rename(code, {other: one})


SLIPS: tuple[Slip, ...] = (
    do_more,
    store_results,
    miss_cases,
    misread_numbers,
    change_results,
    remember_calls,
    confuse_roles,
)


# ---------------------------------------------------------------- tools


class DeedAtReturn(ast.NodeTransformer):
    """Put a deed before each return, with `answer` for what it returns."""

    def __init__(self, deed: str) -> None:
        self.deed = deed
        self.uses_answer = any(name.startswith("answer") for name in names_of(deed))

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        return node  # its returns are its own

    def visit_Return(self, node: ast.Return) -> ast.AST | Code:
        value = node.value
        if value is None or (isinstance(value, ast.Constant) and value.value is None):
            return node if self.uses_answer else [*parse_code(self.deed), node]
        answer = "answer"
        if isinstance(value, ast.Tuple):
            answer = ", ".join(f"answer_{index}" for index in range(len(value.elts)))
        return parse_code(f"{answer} = {ast.unparse(value)}\n{self.deed}\nreturn {answer}")


def add_deed(code: Code, deed: str, scope: Scope) -> Code:
    """Do `deed` at the end of `code`; in its loop, where `deed` speaks of the loop's body."""
    code = copy.deepcopy(code)
    if scope.each and scope.each in names_of(deed) and not deed.startswith("for "):
        find_loop(code, scope.each).body += parse_code(deed)
        return code
    transformer = DeedAtReturn(deed)
    changed: Code = transformer.visit(ast.Module(code, [])).body
    if transformer.uses_answer or isinstance(changed[-1], ast.Return):
        return changed
    return [*changed, *parse_code(deed)]


def find_loop(code: Code, name: str) -> ast.For:
    """Return the loop with this variable."""
    return next(
        node
        for node in ast.walk(ast.Module(code, []))
        if isinstance(node, ast.For) and name in names_of(ast.unparse(node.target))
    )


def skip_case(code: Code, condition: str, scope: Scope) -> Code:
    """Leave the region as the starter has it where `condition` holds.

    In a loop over bodies, where it speaks of one of them, that body is skipped.
    """
    code = copy.deepcopy(code)
    test = parse_expression(condition)
    if scope.each and scope.each in names_of(condition):
        find_loop(code, scope.each).body.insert(0, ast.If(test, [ast.Continue()], []))
        return code
    other = parse_code(scope.unfinished) or [ast.Pass()]
    if isinstance(other[-1], ast.Return):
        return [ast.If(test, other, []), *code]
    return [ast.If(test, other, code)]


def replace_number(code: Code, read: str, value: str, scope: Scope) -> Code:
    """Use `value` for the number `read`; a parameter is changed first of all."""
    code = copy.deepcopy(code)
    if read in scope.parameters:
        return [*parse_code(f"{read} = {value}"), *code]
    changed: Code = Replacer(read, value).visit(ast.Module(code, [])).body
    return changed


def rename(code: Code, names: dict[str, str]) -> Code:
    """Use other names where values are used; a name with a dot before it is a field."""
    code = copy.deepcopy(code)
    for node in ast.walk(ast.Module(code, [])):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            node.id = names.get(node.id, node.id)
        elif isinstance(node, ast.Attribute):
            node.attr = names.get(f".{node.attr}", f".{node.attr}")[1:]
    return code


def names_of(text: str) -> set[str]:
    """Return the variables in a piece of code, except those bound in a comprehension."""
    tree = ast.parse(text)
    loops = [node for node in ast.walk(tree) if isinstance(node, ast.comprehension)]
    bound = {name for loop in loops for name in stored_names(loop.target)}
    return {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)} - bound


def stored_names(tree: ast.AST) -> set[str]:
    names = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
    return {node.id for node in names if isinstance(node.ctx, ast.Store)}
