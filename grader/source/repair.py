"""Replace code that Python refuses, so that the rest can run.

For one missing bracket, Python refuses a whole file and each program that imports it. So parts of
the file are replaced until it parses: TODO regions by the handed-out stubs, one at a time and then
several; other functions by the given ones; then all of the file but its regions. Lines keep their
numbers if possible.
"""

import ast
import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations, islice, pairwise

from grader.source.definitions import statements
from grader.source.flaws import MAX_LINE, UNDECODED, Flaw, find_flaw
from grader.source.given import given_pieces, indent_of, pieces, with_regions
from grader.source.regions import find_regions, parse, replace_regions

MAX_REPAIR = 4 * 1024 * 1024  # characters that are parsed to repair one submission
MAX_FUNCTIONS = 200  # of a file
NEAREST = 8  # parts of a file that are replaced in pairs
REFUSED = "\0"  # not allowed in a Python file
OUTSIDE = ""  # instead of a TODO's id: the flaw is in no TODO

MAIN = 'if __name__ == "__main__":'
CLASS = re.compile(r"class[ \t]+(\w+)")
DEF = re.compile(r"(?P<indent>[ \t]*)(?:async[ \t]+)?def[ \t]+(?P<name>\w+)")
NEXT = re.compile(r"(?P<indent>[ \t]*)(?:async |def |class |@|if __name__|# (?:END )?TODO )")
CLOSES = re.compile(r"[ \t]*[)\]}]")


@dataclass(frozen=True)
class HandedOut:
    """The given code: files by name, stubs by TODO, and the path of each TODO's function.

    `stubs` has the region of a TODO under its id, and the function around it under `def ID`.
    """

    files: Mapping[str, str]
    stubs: Mapping[str, str]
    functions: Mapping[str, str]


@dataclass(frozen=True)
class Patch:
    """Lines that can replace some lines of a file."""

    start: int
    stop: int
    lines: tuple[str, ...]
    todo: str = OUTSIDE  # the TODO whose code is replaced
    invented: bool = False  # the new lines are not given code

    def distance(self, line: int) -> tuple[bool, int]:
        """Return a sort key for the distance from a line; a patch after the line comes last."""
        index = line - 1
        return self.start > index, 0 if self.start <= index < self.stop else abs(index - self.stop)


@dataclass(frozen=True)
class Repaired:
    """A file's text that Python accepts, and the flaws that it had, by the ids of TODOs."""

    text: str
    flaws: Mapping[str, Flaw]


@dataclass
class Repairer:
    """Repairs the files of one submission, and parses at most MAX_REPAIR characters for that."""

    given: HandedOut
    read: int = field(default=0, init=False)

    def repair(self, flaw: Flaw, text: str) -> Repaired | None:
        """Return the file with as few parts replaced as possible; None if nothing helps."""
        file = flaw.file
        patches = [*self._patches(file, text), *line_patches(text, flaw)]
        original = self.given.files.get(file)
        if flaw.undecoded:
            text = text.replace(UNDECODED, REFUSED)
            repaired = self._by_patches(text, flaw, [each for each in patches if each.todo], None)
            if repaired is None and self._flaw(plain := text.replace(REFUSED, "?")) is None:
                repaired = Repaired(plain, {OUTSIDE: flaw})
        else:
            repaired = self._by_patches(text, flaw, patches, original)
        if repaired is None and original is not None:
            repaired = self._by_given_file(text, flaw, original)
        if repaired is None:
            return None
        return Repaired(
            repaired.text, {todo: f.in_file(file) for todo, f in repaired.flaws.items()}
        )

    def _by_given_file(self, text: str, flaw: Flaw, original: str) -> Repaired | None:
        """Keep only the regions; a TODO without a region gets its stub."""
        regions = {id: region.lines for id, region in find_regions(text).items()}
        base = replace_regions(original, regions)
        lost = {id: flaw for id in find_regions(original) if id not in regions}
        again = self._flaw(base)
        if again is None:
            return Repaired(base, {OUTSIDE: flaw} | lost)
        patches = [each for each in self._region_patches(base) if each.todo in regions]
        repaired = self._by_patches(base, again, patches, None)
        if repaired is None:
            return None
        moved = {todo: flaw_in(text, todo) or each for todo, each in repaired.flaws.items()}
        return Repaired(repaired.text, {OUTSIDE: flaw} | lost | moved)

    def _by_patches(
        self, text: str, flaw: Flaw, patches: list[Patch], original: str | None
    ) -> Repaired | None:
        for chosen in choices(text, flaw, patches):
            if self.read > MAX_REPAIR:
                break
            repaired = apply_patches(text, chosen)
            if self._flaw(repaired) is not None or lacks_given(repaired, chosen, original):
                continue
            flaws = {}
            for each in chosen:
                others = [other for other in chosen if other is not each]
                left = self._flaw(apply_patches(text, others)) if others else flaw
                flaws[each.todo] = move_into(each, text, left or flaw)
            return Repaired(repaired, flaws)
        return None

    def _flaw(self, text: str) -> Flaw | None:
        self.read += len(text)
        return find_flaw(text)

    # ------------------------------------------------------------ parts that can be replaced

    def _patches(self, file: str, text: str) -> Iterator[Patch]:
        """Yield the parts of a file that can be replaced, regions first."""
        yield from self._region_patches(text)
        marked = find_regions(text)
        module = file.partition("/")[0].removesuffix(".py")
        for path, start, stop in islice(functions_in(text.splitlines()), MAX_FUNCTIONS):
            todo = next((t for t, p in self.given.functions.items() if p == f"{module}:{path}"), "")
            lines = text.splitlines()[start:stop]
            if todo and todo not in marked:
                stub = ast.unparse(drop_docstring(self.given.stubs[f"def {todo}"]))
                yield Patch(start, stop, fill_up(indent_like(stub, lines[0]), stop - start), todo)
            elif (wanted := self._given_function(file, module, path, lines)) is not None:
                yield Patch(start, stop, fill_up(indent_like(wanted, lines[0]), stop - start))
            else:
                name = path.rpartition(".")[2]
                refuses = f"def {name}(*_, **__): raise SyntaxError('{name} is no Python')"
                new = fill_up(indent_like(refuses, lines[0]), stop - start)
                yield Patch(start, stop, new, invented=True)

    def _region_patches(self, text: str) -> Iterator[Patch]:
        lines = text.splitlines()
        for region in find_regions(text).values():
            if region.id in self.given.stubs and region.lines:
                stub = one_line(self.given.stubs[region.id])
                new = fill_up(indent_like(stub, lines[region.start]), len(region.lines))
                yield Patch(region.start + 1, region.stop, new, region.id)

    def _given_function(
        self, file: str, module: str, path: str, theirs: Sequence[str]
    ) -> str | None:
        """Return a given function with the student's regions; a single file has all functions."""
        own = file in self.given.files
        for name, text in self.given.files.items():
            if name != file and (own or name.partition("/")[0] != module):
                continue
            piece = given_pieces(text).get(path)
            if piece is not None and not piece.constant and not piece.whole_class:
                lines = tuple(text.splitlines()[piece.start : piece.stop])
                kept = with_regions(lines, [*theirs, ""])
                return textwrap.dedent("\n".join(kept)) if kept else None
        return None


def choices(text: str, flaw: Flaw, patches: list[Patch]) -> Iterator[list[Patch]]:
    """Yield the parts to replace together, the likely ones first."""
    near = sorted(patches, key=lambda each: (each.todo == OUTSIDE, each.distance(flaw.line)))
    lines = text.splitlines()
    bad = [p for p in near if p.todo and is_no_code(lines[p.start : p.stop])]
    if bad:
        yield bad
    yield from ([each] for each in near)
    if bad:
        yield from ([*bad, each] for each in near if each not in bad and are_apart([*bad, each]))
    closest = [each for each in near if each.todo][:NEAREST]
    yield from (list(pair) for pair in combinations(closest, 2) if are_apart(pair))
    regions = [each for each in near if each.todo]
    if len(regions) > 2 and are_apart(regions):
        yield regions


def is_no_code(lines: Sequence[str]) -> bool:
    text = textwrap.dedent("\n".join(lines))
    return bool(text.strip()) and parse(text) is None


def are_apart(patches: Sequence[Patch]) -> bool:
    """Return whether no patches overlap."""
    order = sorted(patches, key=lambda each: each.start)
    return all(a.stop <= b.start for a, b in pairwise(order))


def apply_patches(text: str, patches: Sequence[Patch]) -> str:
    lines = text.splitlines()
    for each in sorted(patches, key=lambda patch: -patch.start):
        lines[each.start : each.stop] = each.lines
    return "\n".join(lines) + "\n"


def lacks_given(text: str, chosen: Sequence[Patch], original: str | None) -> bool:
    """Return whether an invented function hides names of a given file."""
    if original is None or not any(each.invented for each in chosen):
        return False
    return not given_pieces(original).keys() <= pieces(statements(text)).keys()


def move_into(patch: Patch, text: str, flaw: Flaw) -> Flaw:
    """Move a flaw's line into the replaced code: Python may report it further down."""
    if patch.start < flaw.line <= patch.stop or not patch.todo:
        return flaw
    lines = text.splitlines()
    said = (n for n in range(patch.start, patch.stop) if lines[n].strip().strip("#"))
    line = next(said, patch.start) + 1
    message = f"{flaw.message}, which Python notices in line {flaw.line}"
    return Flaw(line, message, lines[line - 1].strip()[:MAX_LINE])


def flaw_in(text: str, todo: str) -> Flaw | None:
    """Return the flaw of a region, with its line in the file."""
    region = find_regions(text).get(todo)
    if region is None:
        return None
    own = textwrap.indent(textwrap.dedent("\n".join(region.lines)), "    ")
    flaw = find_flaw(f"def region():\n{own}\n")
    return flaw and replace(flaw, line=flaw.line + region.start)


def line_patches(text: str, flaw: Flaw) -> Iterator[Patch]:
    """Yield patches of a single line: the one that Python refuses, and the first one."""
    lines = text.splitlines()
    for index in dict.fromkeys((flaw.line - 1, 0)):
        line = lines[index]
        head = CLASS.match(line)
        new = f"class {head[1]}:" if head else MAIN if line.startswith("if __name__") else "pass"
        yield Patch(index, index + 1, (indent_like(new, line),), invented=True)


# ---------------------------------------------------------------- finding functions by layout


def functions_in(lines: Sequence[str]) -> Iterator[tuple[str, int, int]]:
    """Yield each function's path and the indices of its lines, by the layout of the text.

    A function ends where the next one begins, or at a line further to the left. Such a line may be
    a mistake: if the two ends differ, yield the function with both.
    """
    owner, inside = "", -1
    for number, line in enumerate(lines):
        if found := CLASS.match(line):
            owner = found[1]
        found = DEF.match(line)
        if not found or number < inside:
            continue
        indent = len(found["indent"])
        path = f"{owner}.{found['name']}" if indent and owner else found["name"]
        rest = range(number + 1, len(lines))
        further = next((n for n in rest if begins_next(lines[n], indent)), len(lines))
        near = next((n for n in rest if n < further and stands_left(lines[n], indent)), further)
        inside = near
        for stop in dict.fromkeys((near, further)):
            while stop > number + 1 and not lines[stop - 1].strip():
                stop -= 1
            yield path, number, stop


def begins_next(line: str, indent: int) -> bool:
    found = NEXT.match(line)
    return found is not None and len(found["indent"]) <= indent


def stands_left(line: str, indent: int) -> bool:
    text = line.strip()
    return bool(text) and indent_of(line) <= indent and not CLOSES.match(line)


# ---------------------------------------------------------------- new lines


def drop_docstring(source: str) -> ast.stmt:
    (node,) = statements(textwrap.dedent(source))
    assert isinstance(node, ast.FunctionDef)
    if ast.get_docstring(node) is not None:
        node.body = node.body[1:] or [ast.Pass()]
    return node


def one_line(source: str) -> str:
    """Return a stub's statements in one line, without its comments."""
    return "; ".join(map(ast.unparse, statements(textwrap.dedent(source)))) or "pass"


def indent_like(source: str, like: str) -> str:
    return textwrap.indent(source, like[: indent_of(like)])


def fill_up(source: str, count: int) -> tuple[str, ...]:
    """Return the lines of a source, filled up with empty ones to `count` lines."""
    lines = source.splitlines()
    return (*lines, *[""] * (count - len(lines)))
