"""Find given code that a submission has changed, and undo the changes.

The given files are compared piece by piece: functions outside their TODO regions, constants and
imports. Layout, comments and docstrings do not count.
"""

import ast
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from difflib import SequenceMatcher
from functools import cache
from itertools import accumulate, islice

from grader.source.definitions import dotted_name, statements
from grader.source.flaws import quote
from grader.source.regions import (
    MAX_SHAPE,
    START,
    Region,
    RegionError,
    find_regions,
    regions_in,
    replace_regions,
    shape_of,
)

MISPLACED = (
    "Line {line} of {file}, `{text}`, stands outside the region of TODO {id}: move your code "
    "between its two marker lines."
)
MAX_COMPARED = 1000  # lines of code that are compared; no function has a tenth
Definition = ast.FunctionDef | ast.ClassDef


@dataclass(frozen=True)
class Piece:
    """A function, constant or class of a file, by the indices of its lines."""

    start: int
    stop: int
    owner: str = ""  # the class around it
    constant: bool = False
    whole_class: bool = False


@dataclass(frozen=True)
class GivenChange:
    """A changed piece of given code: the first line that differs, and the lines that undo it."""

    name: str  # such as solve_normal, World.step or ITERATIONS
    file: str
    line: int
    theirs: str  # the first line that differs; empty if one is missing
    given: str  # that line as it was handed out; empty if one was added
    start: int  # index of the first line to replace
    stop: int  # index after the last one
    lines: tuple[str, ...] = field(repr=False, default=())  # to put in their place
    marker: int = 0  # the line at which a region of the piece begins, or 0

    @property
    def to_type(self) -> str:
        """Return the name for `check --restore`; an import is restored with its file."""
        return self.name if self.name.replace(".", "").isidentifier() else self.file

    @property
    def todo(self) -> str:
        """Return the TODO whose function this is; empty for none."""
        found = map(START.match, self.lines if self.name != self.file else ())
        return next((each["id"] for each in found if each), "")

    @property
    def outside(self) -> str:
        """Return a sentence about a line of a TODO's function outside its region, or an empty text.

        A line that was added above the region is a helper, and is allowed.
        """
        helps = not self.given and self.line < self.marker
        if not self.todo or not self.theirs or helps:
            return ""
        return MISPLACED.format(line=self.line, file=self.file, text=self.theirs, id=self.todo)

    @property
    def how(self) -> str:
        """Return a sentence about the difference, without its full stop."""
        if self.theirs and self.theirs == self.given:
            return f"`{self.theirs}` has been moved, to line {self.line} of {self.file}"
        if not self.theirs:
            return f"`{self.given}` is gone from {self.file}"
        before = f"was `{self.given}`" if self.given else "was not there"
        return f"line {self.line} of {self.file}, `{self.theirs}`, {before}"


def compare_files(theirs: Mapping[str, str], given: Mapping[str, str]) -> list[GivenChange]:
    """Return the submission's changes to given files; both map names to texts."""
    found: list[GivenChange] = []
    for name, text in given.items():
        own = theirs.get(name)
        if own is None or own == text or len(own) > MAX_SHAPE or outside(own) == outside(text):
            continue
        with suppress(ValueError, RecursionError, MemoryError):  # the code is nested too deeply
            found += compare_file(name, own, text)
    return found


def undo_changes(text: str, undone: Iterable[GivenChange]) -> str:
    """Return a file's text with these changes of it undone."""
    lines = text.splitlines()
    for each in sorted(undone, key=lambda change: (-change.start, -change.stop)):
        lines[each.start : each.stop] = each.lines
    return "\n".join(lines) + "\n"


def keep_regions(text: str, given: str) -> str:
    """Return a given file with the TODO regions of another one; may raise RegionError."""
    return replace_regions(given, {region.id: region.lines for region in regions_in(text)})


def outside(text: str) -> list[str]:
    """Return the lines of a file outside its regions."""
    lines = text.splitlines()
    for region in reversed(find_regions(text).values()):
        del lines[region.start + 1 : region.stop]
    return lines


# ---------------------------------------------------------------- one file


def compare_file(file: str, text: str, given: str) -> Iterator[GivenChange]:
    """Yield the changes in a file; if it is not Python, the file as a whole."""
    body = statements(text)
    lines, right = text.splitlines(), given.splitlines()
    if not body:
        yield from compare_whole_file(file, text, given)
        return
    own, originals = with_markers(pieces(body), text), given_pieces(given)
    elsewhere = imported_names(body)
    for name, piece in originals.items():
        wanted = tuple(right[piece.start : piece.stop])
        found = own.get(name)
        if found is None and not {name, piece.owner, "*"} & (elsewhere - {""}):
            if not piece.owner or piece.owner in own:  # else its class is missing as a whole
                yield restore_piece(name, file, body, piece, wanted, len(lines))
        elif found is not None and not piece.whole_class and not found.whole_class:
            original = with_regions(wanted, lines[found.start : found.stop])
            if original is not None:
                yield from compare_piece(name, file, lines, found, original)
    for missing in missing_imports(body, given, file.endswith("__init__.py")):
        place = end_of_imports(body)
        yield GivenChange(missing, file, place + 1, "", missing, place, place, (missing,))
    for name in sorted(own.keys() & imported_names(statements(given)) - originals.keys()):
        hides = own[name]
        yield GivenChange(
            name, file, hides.start + 1, quote_code(lines[hides.start]), "", hides.start, hides.stop
        )


def compare_whole_file(file: str, text: str, given: str) -> Iterator[GivenChange]:
    """Yield all differences outside the regions as one change."""
    lines = text.splitlines()
    with suppress(RegionError):
        whole = tuple(keep_regions(text, given).splitlines())
        yield from compare_piece(file, file, lines, Piece(0, len(lines)), whole)


def restore_piece(
    name: str, file: str, body: list[ast.stmt], piece: Piece, wanted: tuple[str, ...], count: int
) -> GivenChange:
    """Return a missing piece, to be restored after the imports, its class, or the whole file."""
    place = end_of_imports(body) if piece.constant else end_of(body, piece.owner, count)
    gap = () if piece.constant else ("",) if piece.owner else ("", "")
    return GivenChange(name, file, place + 1, "", first_code(wanted), place, place, (*gap, *wanted))


def compare_piece(
    name: str, file: str, lines: list[str], piece: Piece, original: tuple[str, ...]
) -> Iterator[GivenChange]:
    """Yield the change of a piece, if any; `original` is given code with the student's regions."""
    own = tuple(lines[piece.start : piece.stop])
    if meaning_of(own) == meaning_of(original):
        return
    line, theirs, given = first_difference(own, original)
    place = piece.start + line + 1
    marker = next((n for n, each in enumerate(own, piece.start + 1) if START.match(each)), 0)
    yield GivenChange(name, file, place, theirs, given, piece.start, piece.stop, original, marker)


def with_regions(given: tuple[str, ...], theirs: Sequence[str]) -> tuple[str, ...] | None:
    """Return a given function with the student's regions; None if a marker is missing."""
    own = {id: region.lines for id, region in find_regions("\n".join(theirs)).items()}
    needed = find_regions("\n".join(given))
    if not needed.keys() <= own.keys():
        return None
    return tuple(replace_regions("\n".join(given) + "\n", own).splitlines()) if needed else given


def first_difference(mine: Sequence[str], given: Sequence[str]) -> tuple[int, str, str]:
    """Return the index of the first line that differs, that line, and the given one.

    A line that occurs as often as in the given code was moved; then return it as both.
    """
    own, right = list(islice(code_lines(mine), MAX_COMPARED)), list(code_lines(given))
    matcher = SequenceMatcher(None, [line for _, line in own], [line for _, line in right], False)
    for kind, start, stop, first, last in matcher.get_opcodes():
        if kind == "equal":
            continue
        number = own[min(start, len(own) - 1)][0] if own else 0
        theirs = own[start][1] if start < stop else ""
        meant = right[first][1] if first < last else ""
        alone = "" if theirs and meant else theirs or meant
        places = [number for number, line in own if line == alone]
        if places and len(places) == sum(line == alone for _, line in right):
            return places[0], quote_code(alone), quote_code(alone)
        return number, quote_code(theirs), quote_code(meant)
    return 0, quote_code(mine[0].strip()), quote_code(given[0].strip())


def code_lines(lines: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Yield the lines of code, with their indices."""
    for number, line in enumerate(lines):
        if is_code(line):
            yield number, line.strip()


def is_code(line: str) -> bool:
    text = line.strip()
    return bool(text) and not text.startswith("#")


def first_code(lines: Sequence[str]) -> str:
    return quote_code(next((text for _, text in code_lines(lines)), ""))


def quote_code(line: str) -> str:
    """Return a line without its comment at the end, cut to the length of a quote."""
    text = line.strip()
    if '"' not in text and "'" not in text:
        text = text.partition("  #")[0].rstrip()
    return quote(text)


# ---------------------------------------------------------------- pieces


@cache
def given_pieces(text: str) -> dict[str, Piece]:
    return with_markers(pieces(statements(text)), text)


def with_markers(found: dict[str, Piece], text: str) -> dict[str, Piece]:
    """Return the pieces, each with a final region after its last statement."""
    lines = text.splitlines()
    regions = list(find_regions(text).values())
    code = list(accumulate(map(is_code, lines), initial=0))  # lines of code before each line
    return {name: with_last_region(piece, regions, lines, code) for name, piece in found.items()}


def with_last_region(
    piece: Piece, regions: Sequence[Region], lines: Sequence[str], code: Sequence[int]
) -> Piece:
    stop = piece.stop
    first = bisect_left(regions, piece.start, key=lambda each: each.start)
    for number in range(first, len(regions)):
        region = regions[number]
        if region.start >= stop and code[stop] < code[region.start]:
            break  # the regions that follow are further down
        if indent_of(lines[region.start]) > indent_of(lines[piece.start]):
            stop = max(stop, region.stop + 1)
    return replace(piece, stop=stop)


def indent_of(line: str) -> int:
    return len(line) - len(line.lstrip())


def pieces(body: Iterable[ast.stmt], owner: str = "") -> dict[str, Piece]:
    """Return functions, constants and classes by name; the last one of a name counts."""
    found: dict[str, Piece] = {}
    for node in body:
        start, stop = first_line(node) - 1, node.end_lineno or node.lineno
        match node:
            case ast.FunctionDef(name=name):
                found[f"{owner}{name}"] = Piece(start, stop, owner.rstrip("."))
            case ast.ClassDef(name=name):
                found[name] = Piece(start, stop, whole_class=True)
                found |= pieces(node.body, f"{name}.")
            case ast.Assign(targets=[target]) | ast.AnnAssign(target=target):
                if name := names_in(target):
                    found[f"{owner}{name}"] = Piece(start, stop, owner.rstrip("."), constant=True)
    return found


def first_line(node: ast.stmt) -> int:
    decorators = node.decorator_list if isinstance(node, Definition) else []
    return min([node.lineno, *(each.lineno for each in decorators)])


def names_in(target: ast.expr) -> str:
    """Return `WIDTH` or `WIDTH, HEIGHT`; empty for other targets."""
    each = target.elts if isinstance(target, ast.Tuple) else [target]
    return ", ".join(filter(None, map(dotted_name, each)))


def meaning_of(lines: Sequence[str]) -> str:
    """Return a text that does not depend on the layout and comments of a piece."""
    body = statements(shift_left(lines))
    for node in body:
        if isinstance(node, Definition) and ast.get_docstring(node, clean=False) is not None:
            node.body = node.body[1:]
    return ast.dump(ast.Module(body, [])) if body else shape_of("\n".join(lines))


def shift_left(lines: Sequence[str]) -> str:
    """Move lines to the left by the indent of the first."""
    indent = indent_of(lines[0]) if lines else 0
    return "\n".join(line[indent:] if not line[:indent].strip() else line for line in lines)


# ---------------------------------------------------------------- imports


def imports_in(body: Iterable[ast.stmt]) -> Iterator[tuple[str, str, str]]:
    """Yield each imported name, its module, and its name in the module."""
    for node in body:
        if isinstance(node, ast.Import):
            for each in node.names:
                yield each.asname or each.name, "", each.name
        elif isinstance(node, ast.ImportFrom):
            source = "." * node.level + (node.module or "")
            for each in node.names:
                yield each.asname or each.name, source, each.name


def imported_names(body: Iterable[ast.stmt]) -> set[str]:
    return {name for name, _, _ in imports_in(body)}


def missing_imports(body: list[ast.stmt], given: str, passed_on: bool) -> Iterator[str]:
    """Yield the given imports of names that this file reads but does not define.

    For a file that re-exports its names, yield all missing imports.
    """
    bound = imported_names(body) | pieces(body).keys()
    read = {node.id for node in ast.walk(ast.Module(body, [])) if isinstance(node, ast.Name)}
    for name, source, what in imports_in(statements(given)):
        if name not in bound and (passed_on or ("*" not in bound and name in read)):
            called = f" as {name}" if name != what else ""
            yield f"from {source} import {what}{called}" if source else f"import {what}{called}"


def end_of_imports(body: list[ast.stmt]) -> int:
    """Return the index of the line after the last import, or after the docstring."""
    ends = [each.end_lineno or 0 for each in body if isinstance(each, ast.Import | ast.ImportFrom)]
    first = body[0]
    doc = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    return max([*ends, (first.end_lineno or 0) if doc else 0])


def end_of(body: list[ast.stmt], owner: str, count: int) -> int:
    """Return the index after the last line of a class, or of the file."""
    ends = [n.end_lineno or 0 for n in body if isinstance(n, ast.ClassDef) and n.name == owner]
    return ends[-1] if ends else count
