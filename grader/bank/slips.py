"""Make the slips of students: changes to a whole region that look right in most scenes.

Operators in `operators.py` change one node and ignore its meaning. A slip does extra work, or fails
for some inputs or after some calls. `slips.toml` lists them; `scopes.toml` says what is a body or a
number in each region, and how large it usually is.
"""

import ast
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.source.operators import Code, Replacer, parse_code, parse_expression

Scale = dict[
    str, int | float | bool
]  # the usual size of a number, a small and a large one, and a grid


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
    reads: dict[str, Scale] = {}
    results: dict[str, Scale] = {}
    answers: list[str] = []
    many: int = 100
    parameters: frozenset[str] = frozenset()  # of the function
    unfinished: str = ""  # the starter's region

    def names(self, kind: str) -> list[str]:
        """Return the names of a kind, with the fields of bodies that are of this kind."""
        fields = [f"{body}.{field}" for body in self.bodies for field in FIELDS.get(kind, ())]
        return [*getattr(self, kind, []), *fields]

    def fill_deed(self, kinds: str, template: str) -> Iterator[str]:
        """Yield an action for each name of these kinds, or for one body of each loop or list."""
        if kinds != "one of many":
            yield from (template.format(it=it) for k in kinds.split() for it in self.names(k))
            return
        if self.each:
            yield template.format(it=self.each)
        for crowd in self.crowds:
            yield f"for body in {crowd}:\n    " + template.format(it="body")


FIELDS = {  # of a body; an inverse may become smaller, and a static body has none
    "vectors": ("pos", "vel"),
    "numbers": ("angle", "omega", "friction", "restitution"),
    "inverses": ("inv_mass", "inv_inertia"),
}


class SlipTable(Struct, frozen=True, forbid_unknown_fields=True):
    """The slips of `slips.toml`, by name, with their code."""

    calls: list[str]
    deeds: dict[str, dict[str, list[str]]]
    cases: dict[str, list[str]]
    reads: dict[str, list[str]]
    results: dict[str, list[str]]


HERE = Path(__file__).parent
TABLE = msgspec.toml.decode((HERE / "slips.toml").read_bytes(), type=SlipTable)
SCOPES = msgspec.toml.decode((HERE / "scopes.toml").read_bytes(), type=dict[str, Scope])  # by TODO


def make_slips(code: str, scope: Scope) -> Iterator[tuple[str, str]]:
    """Yield every slip in `code`: its name and the code after it."""
    for slip in SLIPS:
        for name, body in slip(code, scope):
            yield name, ast.unparse(ast.fix_missing_locations(ast.Module(body, [])))


Slip = Callable[[str, Scope], Iterator[tuple[str, Code]]]


def do_more(code: str, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Change inputs that must stay, add unwanted work, or return another list."""
    for name, deeds in TABLE.deeds.items():
        for kinds, templates in deeds.items():
            for template in templates:
                for deed in scope.fill_deed(kinds, template):
                    yield name, add_deed(code, deed, scope)


def miss_cases(code: str, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Fail for some bodies, or in a case that the docstring includes."""
    for body in [*scope.bodies, *filter(None, [scope.each])]:
        for name, cases in TABLE.cases.items():
            for case in cases:
                yield name, skip_case(code, case.replace("body", body), scope)
    for case in scope.cases:
        yield "wrong_in_a_case", skip_case(code, case, scope)


def misread_numbers(code: str, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Use another number instead of the given one."""
    for name, it, value in fill_templates(TABLE.reads, scope.reads):
        yield name, replace_number(code, it, value, scope)


def change_results(code: str, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Return another number instead of the computed one."""
    for name, it, value in fill_templates(TABLE.results, scope.results):
        yield name, add_deed(code, f"{it} = {value}", scope)


def fill_templates(
    table: dict[str, list[str]], scales: dict[str, Scale]
) -> Iterator[tuple[str, str, str]]:
    """Yield the slip's name, a number's name and an expression."""
    for name, templates in table.items():
        for it, scale in scales.items():
            for template in templates:
                if scale.get("zero", True) or not template.endswith("else 0"):
                    yield name, it, template.format(it=it, **scale)


def count_calls(code: str, scope: Scope) -> Iterator[tuple[str, Code]]:
    """Fail after some calls, or now and then."""
    count = "calls = globals().setdefault('calls', [])\ncalls.append(1)"
    for case in TABLE.calls:
        wrong = skip_case(code, f"len(calls) {case.format(many=scope.many)}", scope)
        yield "counts_calls", [*parse_code(count), *wrong]


SLIPS: tuple[Slip, ...] = (
    do_more,
    miss_cases,
    misread_numbers,
    change_results,
    count_calls,
)


# ---------------------------------------------------------------- tools


class DeedAtReturn(ast.NodeTransformer):
    """Put an action before each return; `answer` stands for the returned value."""

    def __init__(self, deed: str) -> None:
        self.deed = deed
        self.uses_answer = re.search(r"\banswer", deed) is not None

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


def add_deed(code: str, deed: str, scope: Scope) -> Code:
    """Add `deed` to the end of `code`, or to its loop if `deed` uses the loop's body."""
    tree = ast.parse(code)
    if mentions(deed, scope.each) and not deed.startswith("for "):
        find_loop(tree, scope.each).body += parse_code(deed)
        return tree.body
    transformer = DeedAtReturn(deed)
    changed: Code = transformer.visit(tree).body
    if transformer.uses_answer or isinstance(changed[-1], ast.Return):
        return changed
    return [*changed, *parse_code(deed)]


def mentions(text: str, name: str) -> bool:
    return bool(name) and re.search(rf"\b{name}\b", text) is not None


def find_loop(tree: ast.Module, name: str) -> ast.For:
    """Return the loop with this variable."""
    loops = (node for node in ast.walk(tree) if isinstance(node, ast.For))
    return next(loop for loop in loops if mentions(ast.unparse(loop.target), name))


def skip_case(code: str, condition: str, scope: Scope) -> Code:
    """Use the starter's region if `condition` holds.

    In a loop over bodies, if it is about one of them, skip that body.
    """
    tree, test = ast.parse(code), parse_expression(condition)
    if mentions(condition, scope.each):
        find_loop(tree, scope.each).body.insert(0, ast.If(test, [ast.Continue()], []))
        return tree.body
    other = parse_code(scope.unfinished) or [ast.Pass()]
    if isinstance(other[-1], ast.Return):
        return [ast.If(test, other, []), *tree.body]
    return [ast.If(test, other, tree.body)]


def replace_number(code: str, read: str, value: str, scope: Scope) -> Code:
    """Use `value` for the number `read`; a parameter is changed at the start."""
    if read in scope.parameters:
        return parse_code(f"{read} = {value}\n{code}")
    changed: Code = Replacer(read, value).visit(ast.parse(code)).body
    return changed
