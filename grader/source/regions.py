"""Read the marked regions of the student's files: `# TODO 4: …` to `# END TODO 4`."""

import ast
import codecs
import re
import textwrap
import tokenize
import warnings
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from io import BytesIO
from pathlib import Path

# The lesson's files are much smaller. A parsed text takes up to a thousand times its length.
MAX_SOURCE = 128 * 1024  # bytes of a file
MAX_SHAPE = 32 * 1024  # characters of a region or function that is parsed
# Fifty names with dots between them: in an import, Python's parser keeps each beginning of these.
CHAIN = re.compile(r"(?:\.[\s\\]*+\w++[\s\\]*+){50}")
# Encodings that editors write; others may take long to read.
USUAL = re.compile(r"iso8859-\d+|cp\d+|koi8-[ru]|mac-\w+|gb\w+|big5\w*|shift_jis\w*|euc_\w+")
TODO_ID = r"[0-9]+[a-z]?|B[0-9]+"  # the ids of TODOs, defined only here
START = re.compile(rf"[ \t]*# TODO (?P<id>{TODO_ID}): (?P<task>\S.*)$")
END = re.compile(rf"[ \t]*# END TODO (?P<id>{TODO_ID})\s{{0,80}}$")
# A mistyped marker: an id with a colon, or at the end.
MEANT = re.compile(
    r"[ \t]*# ?(?:TODO ?(?=\w*[0-9])\w++:|END ?TODO ?(?=\w*[0-9])\w++\s{0,80}$)", re.IGNORECASE
)
# Characters that end a line for `str.splitlines` and not for Python, which refuses them in code.
NO_END = dict.fromkeys(map(ord, "\v\x1c\x1d\x1e\x85\u2028\u2029"), "\u2424")
# Python reads it as a space; at the start of a line, it and the spaces before it do not count.
PAGE_BREAK = re.compile(r"(?P<start>^[ \t\f]*\f)|\f", re.MULTILINE)


class RegionError(ValueError):
    """Markers that do not pair up."""


@dataclass(frozen=True)
class Region:
    """One region of one file; `start` and `stop` are the line indices of its two markers."""

    id: str
    task: str
    start: int
    stop: int
    lines: tuple[str, ...]  # between the markers

    @property
    def shape(self) -> str:
        """Return the region's code without comments and layout; its text if it is not Python."""
        return shape_of("\n".join(self.lines))


@lru_cache(maxsize=64)  # a function that nobody edits is the same in the next grade
def shape_of(source: str) -> str:
    """Return a text that does not depend on the layout of a piece of code."""
    text = textwrap.dedent(source)
    tree = parse(text, MAX_SHAPE)
    with suppress(ValueError, RecursionError, MemoryError):
        return ast.dump(tree) if tree else text.strip()
    return text.strip()


def parse(text: str, most: int = MAX_SOURCE) -> ast.Module | None:
    """Return the tree of a source text; None if it is not Python or too long.

    The judge parses students' code only here.
    """
    if len(text) > most or CHAIN.search(text):
        return None
    try:
        with warnings.catch_warnings(action="ignore"):
            return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def regions_in(text: str, file: str = "") -> list[Region]:
    """Return the regions of a file in order.

    Raises RegionError, with the file and the line, for markers that are mistyped, nested, or do not
    pair up.
    """
    found, wrong = pair_markers(text)
    if wrong:
        line, why = wrong[0]
        raise RegionError(f"{file}:{line}: {why}" if file else f"line {line}: {why}")
    return list(found.values())


def find_regions(text: str) -> dict[str, Region]:
    """Return the regions of a file by their ids, in order, without markers that do not pair up."""
    return pair_markers(text)[0]


def pair_markers(text: str) -> tuple[dict[str, Region], list[tuple[int, str]]]:
    """Return the regions of a file, and the faults of markers that do not pair up, by line."""
    found: dict[str, Region] = {}
    wrong: list[tuple[int, str]] = []
    lines = text.splitlines() if "TODO" in text else []
    opened: tuple[int, str, str] | None = None  # the index, id and task of the last start
    for number, line in enumerate(lines):
        start, end = START.match(line), END.match(line)
        if start:
            if opened is not None:
                wrong.append((number + 1, f"a TODO begins inside another one: {line.strip()}"))
            opened = number, start["id"], start["task"].rstrip()
        elif end:
            if opened is None or opened[1] != end["id"]:
                wrong.append((number + 1, f"nothing was opened for: {line.strip()}"))
            elif end["id"] in found:
                wrong.append((number + 1, f"TODO {end['id']} is there twice"))
            else:
                between = tuple(lines[opened[0] + 1 : number])
                found[end["id"]] = Region(end["id"], opened[2], opened[0], number, between)
            opened = None
        elif MEANT.match(line):
            form = "write `# TODO 4: what to do`, and `# END TODO 4` below it"
            wrong.append((number + 1, f"`{line.strip()}` is no marker: {form}"))
    if opened is not None:
        wrong.append((opened[0] + 1, f"never ended: {lines[opened[0]].strip()}"))
    return found, wrong


def replace_regions(text: str, contents: dict[str, tuple[str, ...]]) -> str:
    """Return the text with new lines in the regions named in `contents`."""
    lines = text.splitlines(keepends=True)
    for region in reversed(regions_in(text)):
        if region.id in contents:
            lines[region.start + 1 : region.stop] = [line + "\n" for line in contents[region.id]]
    return "".join(lines)


def python_files(tree: Path) -> Iterator[Path]:
    """Yield a tree's Python files in a fixed order, without links, hidden ones and giants."""
    for path in sorted(tree.rglob("*.py")):
        parts = path.relative_to(tree).parts
        if path.is_symlink() or not path.is_file() or any(p.startswith(".") for p in parts):
            continue
        if path.stat().st_size <= MAX_SOURCE:
            yield path


def read_source(path: Path) -> str:
    """Return a file as text, also with a BOM, CRLF or bytes of another encoding."""
    data = path.read_bytes()
    return number_lines(data.decode(encoding_of(data), "replace").replace("\r\n", "\n"))


def number_lines(text: str) -> str:
    """Return a source text whose lines have the same numbers for Python and `splitlines`."""
    if any(chr(each) in text for each in NO_END):  # faster than to translate every text
        text = text.translate(NO_END)
    if "\f" not in text:
        return text
    return PAGE_BREAK.sub(lambda found: " " if found["start"] is None else "", text)


def encode(text: str) -> bytes:
    """Return a source's bytes in the encoding that it declares."""
    data = text.encode("utf-8", "replace")
    encoding = encoding_of(data)
    return data if encoding == "utf-8-sig" else text.encode(encoding, "replace")


def encoding_of(data: bytes) -> str:
    """Return the encoding that a source declares (PEP 263), or UTF-8 if that is unusual."""
    try:
        declared, _ = tokenize.detect_encoding(BytesIO(data).readline)
        name = codecs.lookup(declared).name
    except (SyntaxError, LookupError):
        return "utf-8-sig"
    return name if USUAL.fullmatch(name) else "utf-8-sig"


def is_usual(encoding: str) -> bool:
    """Return whether an encoding is UTF-8 or another that editors write."""
    name = codecs.lookup(encoding).name
    return name in ("utf-8", "utf-8-sig", "ascii") or USUAL.fullmatch(name) is not None
