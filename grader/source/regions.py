"""The marked regions of the student's files: `# TODO 4: …` to `# END TODO 4`."""

import ast
import re
import textwrap
import warnings
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

# No lesson file comes near these. What is parsed takes up to a thousand times its length in memory.
MAX_SOURCE = 128 * 1024  # bytes of a file
MAX_SHAPE = 32 * 1024  # characters of a region or function of which more is kept than the text
# Fifty names with dots between them: in an import, Python's parser keeps each beginning of these.
CHAIN = re.compile(r"(?:\.[\s\\]*+\w++[\s\\]*+){50}")
START = re.compile(r"^(?P<indent>[ \t]*)# TODO (?P<id>[0-9]+[a-d]?|B[0-9]): (?P<task>\S.*)$")
END = re.compile(r"^[ \t]*# END TODO (?P<id>[0-9]+[a-d]?|B[0-9])\s{0,80}$")


class RegionError(ValueError):
    """Markers that do not pair up."""


@dataclass(frozen=True)
class Region:
    """One region of one file; `start` and `stop` are the line indices of its two markers."""

    id: str
    task: str
    start: int
    stop: int
    lines: tuple[str, ...]  # between the markers, as they stand

    @property
    def shape(self) -> str:
        """What the region says, comments and layout aside; its text where it is no Python."""
        return shape_of("\n".join(self.lines))


def shape_of(source: str) -> str:
    """A text that is equal for two pieces of code exactly if they differ in layout alone."""
    text = textwrap.dedent(source)
    tree = parsed(text, MAX_SHAPE)
    with suppress(ValueError, RecursionError, MemoryError):
        return ast.dump(tree) if tree else text.strip()
    return text.strip()


def parsed(text: str, most: int = MAX_SOURCE) -> ast.Module | None:
    """The tree of a source text; None where it is no Python, or longer than any program's.

    The judge parses what students wrote here and nowhere else.
    """
    if len(text) > most or CHAIN.search(text):
        return None
    try:
        with warnings.catch_warnings(action="ignore"):
            return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def regions_in(text: str) -> list[Region]:
    """The regions of a file in order; raises RegionError for unpaired, nested or double markers."""
    found: list[Region] = []
    lines = text.splitlines() if "TODO" in text else []
    open_at: int | None = None
    for number, line in enumerate(lines):
        start, end = START.match(line), END.match(line)
        if start:
            if open_at is not None:
                raise RegionError(f"line {number + 1}: a TODO begins inside another one: {line}")
            open_at = number
        elif end:
            opened = START.match(lines[open_at]) if open_at is not None else None
            if open_at is None or opened is None or opened["id"] != end["id"]:
                raise RegionError(f"line {number + 1}: nothing was opened for: {line.strip()}")
            found.append(
                Region(
                    end["id"],
                    opened["task"].rstrip(),
                    open_at,
                    number,
                    tuple(lines[open_at + 1 : number]),
                )
            )
            open_at = None
    if open_at is not None:
        raise RegionError(f"line {open_at + 1}: never ended: {lines[open_at].strip()}")
    ids = [region.id for region in found]
    if len(ids) != len(set(ids)):
        raise RegionError(f"a TODO id stands twice: {ids}")
    return found


def replaced(text: str, contents: dict[str, tuple[str, ...]]) -> str:
    """`text` with the lines of each region named in `contents` put in place of its own."""
    lines = text.splitlines(keepends=True)
    for region in reversed(regions_in(text)):
        if region.id in contents:
            lines[region.start + 1 : region.stop] = [line + "\n" for line in contents[region.id]]
    return "".join(lines)


def python_files(tree: Path) -> Iterator[Path]:
    """A tree's Python files in a fixed order; links, hidden folders and giants are left out."""
    for path in sorted(tree.rglob("*.py")):
        parts = path.relative_to(tree).parts
        if path.is_symlink() or not path.is_file() or any(p.startswith(".") for p in parts):
            continue
        if path.stat().st_size <= MAX_SOURCE:
            yield path


def read_source(path: Path) -> str:
    """A submission's file as text, whatever its bytes: BOM, CRLF and bad encodings included."""
    return path.read_bytes().decode("utf-8-sig", "replace").replace("\r\n", "\n")
