"""Find the line in which one small change makes a failed check pass.

The report names the line and the kind of change, never the change itself. This is only for a
student's own work, since it may take as long as all checks together.
"""

import ast
import builtins
import re
import textwrap
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain, combinations, islice

from grader.source import operators as make
from grader.source.definitions import find_function, statements
from grader.source.given import indent_of
from grader.source.operators import Operator, Place, list_edits, names_in, walk_places
from grader.source.regions import Region, find_regions, replace_regions

MOST_TRIED = 150  # changes
LONGEST, MOST_LETTERS = 80, 6000  # lines of a region, and letters; an answer has a dozen lines
NAMED = re.compile(r"(?:id|attr|value)=(?:'\w*'|[\d.e+-]+)")  # as ast.dump writes it


@dataclass(frozen=True)
class Variant:
    """A region with one change."""

    lines: tuple[int, ...]  # numbers in the region, from 1; two if two similar lines are changed
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
    region = find_regions(text).get(todo)
    if function is None or region is None:
        return None
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
    """Yield the region with one change; rare kinds of changes come first.

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
    tables = ((KINDS, places), (IN_TWINS, twins))
    groups = [
        list(islice(list_edits(how, operator, some, own), MOST_TRIED))
        for kinds, some in tables
        for how, operator in kinds
    ]
    seen = {ast.unparse(tree)}
    for each in chain(*sorted(groups, key=len)):
        code = each.put_into(tree)
        if code not in seen:
            seen.add(code)
            yield Variant(tuple(place.node.lineno for place in each.places), each.kind, code)


def is_value(name: str) -> bool:
    """Return whether a name may refer to a number or a vector, not to a class."""
    return name.islower() or name.isupper()


def find_places(tree: ast.AST) -> Iterator[Place]:
    for place in walk_places(tree):
        loaded = isinstance(getattr(place.node, "ctx", ast.Load()), ast.Load)
        in_text = isinstance(place.parent, ast.JoinedStr)  # nodes whose parts cannot be replaced
        if loaded and isinstance(place.node, ast.expr | ast.stmt) and not in_text:
            yield place


def find_twins(tree: ast.AST) -> Iterator[tuple[Place, Place]]:
    """Yield node pairs of two statements that differ only in names and numbers."""
    twins: dict[str, list[ast.stmt]] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign | ast.AugAssign):
            shape = NAMED.sub("", ast.dump(node))
            twins.setdefault(shape, []).append(node)
    for first, second in chain(*(combinations(some, 2) for some in twins.values())):
        yield from zip(find_places(first), find_places(second), strict=True)


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
    indents = [indent_of(each) for each in region.lines if each.strip()]
    new = textwrap.indent(code, " " * min(indents, default=0)).split("\n")
    return replace_regions(text, {region.id: tuple(new)})


KINDS: tuple[tuple[str, Operator], ...] = (  # kinds of changes, each with its words about the line
    ("With another operator in", make.change_arithmetic),
    ("With another comparison in", make.change_comparison),
    ("Without the statement that begins in", make.leave_out_statement),
    ("Without the condition in", make.leave_out_condition),
    ("With another of =, += and -= in", make.change_update),
    ("With another of =, += and -= in", make.add_to_it),
    ("Without a part of", make.unwrap),
    ("Without a part of", make.leave_out_term),
    ("With brackets elsewhere in", make.move_bracket),
    ("With the two sides of an operator exchanged in", make.swap_operands),
    ("With another order of the items in brackets in", make.swap_arguments),
    ("With another order of names in", make.swap_targets),
    ("With `and` and `or` exchanged in", make.change_and),
    ("With the opposite condition in", make.change_condition),
    ("With another number in", make.change_constant),
    ("With another sign in", make.change_sign),
    ("With another name in", make.use_a_similar_name),
    ("With another name in", make.use_another_attribute),
    ("With another name in", make.use_another_name),
    ("With a limit or abs() in", make.add_limit),
    ("With one more factor in", make.double),
    ("With one more factor in", make.add_factor),
)
IN_TWINS: tuple[tuple[str, Operator], ...] = (  # changes of two similar lines at once
    ("With another operator in", make.change_arithmetic),
    ("With brackets elsewhere in", make.move_bracket),
    ("With the two sides of an operator exchanged in", make.swap_operands),
    ("With another number in", make.change_constant),
    ("Without a part of", make.leave_out_term),
)
