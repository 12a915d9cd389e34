"""How alike two submissions are, beyond what everybody was given: it shows, and accuses nobody.

Of each submission all runs of `RUN` tokens are taken, whatever its names and numbers are, so that
new names, comments and layout change nothing. Runs that stand in the starter, in any given file or
in the solution are left out, and so are those that many of the class have. What is left was written
by somebody. Two submissions are as alike as the share of the smaller one's runs that the other has.

Right answers to short tasks are alike by nature. `EXPECTED` is above what independent right answers
of the bank share; a test holds it there.
"""

import io
import keyword
import token
import tokenize
import zlib
from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from itertools import combinations
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.intake.found import CannotTake, Found, Package
from grader.intake.listing import opened_class
from grader.intake.packing import pack
from grader.intake.roster import ClassList
from grader.judge.grade import KIT
from grader.player.page import fill_template
from grader.report.files import write_whole
from grader.report.sinks.tables import as_csv
from grader.source.regions import python_files
from grader.text import printable

TEMPLATES = Path(__file__).with_name("templates")

RUN = 14  # tokens: about two lines
EXPECTED = 0.5  # of the smaller one's runs
FEWEST = 40  # runs of one's own, below which nothing can be said
FEW, MANY = 8, 50  # or a quarter of the class: what more of them have tells nothing
MOST = 100  # pairs
MAX_TEXT = 500_000  # bytes of one submission
CONTEXT = 2  # lines around what is alike
LAYOUT = {token.COMMENT, token.NL, token.NEWLINE, token.INDENT, token.DEDENT, token.ENDMARKER}


@dataclass(frozen=True)
class Token:
    """One token as it is compared, and the line it stands in."""

    word: str
    line: int


@dataclass(frozen=True)
class Prints:
    """What a submission has of its own."""

    name: str
    runs: frozenset[int]
    with_whom: tuple[str, ...] = ()  # the same of those who handed in together


class Pair(Struct, frozen=True):
    """Two submissions, and how alike they are."""

    first: str
    second: str
    share: float  # of the smaller one's own runs
    runs: int  # that both have

    @property
    def names(self) -> tuple[str, str]:
        return self.first, self.second


# ---------------------------------------------------------------- reading


def tokens_of(source: str) -> list[Token]:
    """The tokens of a file, as far as Python can read it."""
    found: list[Token] = []
    try:
        for each in tokenize.generate_tokens(io.StringIO(source).readline):
            if each.type not in LAYOUT:
                found.append(Token(word_of(each), each.start[0]))
    except (tokenize.TokenError, SyntaxError, ValueError):
        pass
    return found


def word_of(each: tokenize.TokenInfo) -> str:
    """A token without what costs nothing to change."""
    if each.type == token.NAME and not keyword.iskeyword(each.string):
        return "name"
    if each.type == token.STRING:
        return "text"
    return "number" if each.type == token.NUMBER else each.string


def runs_in(tokens: list[Token]) -> Iterator[tuple[int, int, int]]:
    """Each run as a number, and the first and last of its lines."""
    words = [each.word for each in tokens]
    for at in range(len(tokens) - RUN + 1):
        run = zlib.crc32("\0".join(words[at : at + RUN]).encode())
        yield run, tokens[at].line, tokens[at + RUN - 1].line


def texts_of(package: Package) -> dict[str, str]:
    """The Python files by name, as many as somebody can have written."""
    texts: dict[str, str] = {}
    room = MAX_TEXT
    for name, content in package.files:
        if name.endswith(".py") and len(content) <= room:
            room -= len(content)
            texts[name] = content.decode("utf-8-sig", "replace").replace("\r\n", "\n")
    return texts


@cache
def given_runs() -> frozenset[int]:
    """All that students were given, and the solution's own wording."""
    files = [path for tree in ("starter", "solution") for path in python_files(KIT / tree)]
    texts = (path.read_text(encoding="utf-8") for path in files)
    return frozenset().union(*map(runs_of, texts))


@lru_cache(maxsize=512)  # most files of a class are those that were given
def runs_of(text: str) -> frozenset[int]:
    return frozenset(run for run, _, _ in runs_in(tokens_of(text)))


def prints_of(package: Package, with_whom: tuple[str, ...] = ()) -> Prints:
    """What is a submission's own: neither given nor the solution's wording."""
    runs: frozenset[int] = frozenset().union(*map(runs_of, texts_of(package).values()))
    return Prints(package.name, runs - given_runs(), with_whom)


def prints_of_class(
    stack: ExitStack, folder: Path, people: ClassList, label: str = ""
) -> tuple[dict[str, Found], list[Prints]]:
    """All of a class that can be read, each under its label, as long as `stack` is open."""
    found, prints = {}, []
    for each in stack.enter_context(opened_class(folder, people)).found:
        if each.handed_in_by:
            continue  # the work of a group is compared once
        name = f"{label}/{each.name}" if label else each.name
        with suppress(CannotTake):
            prints.append(replace(prints_of(pack(each), each.whose), name=name))
            found[name] = each
    return found, prints


# ---------------------------------------------------------------- comparing


def alike(
    prints: Iterable[Prints], least: float = EXPECTED, of: Container[str] | None = None
) -> list[Pair]:
    """The pairs that are more alike than `least`, the most alike first; those of a group are not.

    Each pair has one of the names in `of`.
    """
    everybody = sorted(prints, key=lambda each: each.name)
    count_of = Counter(run for each in everybody for run in each.runs)
    most = min(max(FEW, len(everybody) // 4), MANY)
    sizes = [sum(count_of[run] <= most for run in each.runs) for each in everybody]
    by_run: dict[int, list[int]] = {}
    for number, each in enumerate(everybody):
        if sizes[number] >= FEWEST:
            for run in each.runs:
                if 1 < count_of[run] <= most:
                    by_run.setdefault(run, []).append(number)
    shared: Counter[tuple[int, int]] = Counter()
    for holders in by_run.values():
        shared.update(combinations(holders, 2))
    pairs = []
    for (one, other), count in shared.items():
        first, second = everybody[one], everybody[other]
        share = count / min(sizes[one], sizes[other])
        together = first.with_whom and first.with_whom == second.with_whom
        asked = of is None or first.name in of or second.name in of
        if share > least and asked and not together:
            pairs.append(Pair(first.name, second.name, round(share, 3), count))
    pairs.sort(key=lambda each: (-each.share, -each.runs, each.first, each.second))
    return pairs[:MOST]


@dataclass(frozen=True)
class Line:
    number: int
    text: str
    alike: bool


@dataclass(frozen=True)
class Side:
    """One of two, as far as it is like the other: its files, and the lines around what is alike."""

    name: str
    files: dict[str, list[Line]]


def side_by_side(first: Package, second: Package) -> tuple[Side, Side]:
    """What both have and nobody was given, where it stands in each."""
    common = (prints_of(first).runs & prints_of(second).runs) - given_runs()
    return side(first, common), side(second, common)


def side(package: Package, common: frozenset[int]) -> Side:
    files: dict[str, list[Line]] = {}
    for name, text in texts_of(package).items():
        marked = {
            line
            for run, first, last in runs_in(tokens_of(text))
            if run in common
            for line in range(first, last + 1)
        }
        shown = {line + by for line in marked for by in range(-CONTEXT, CONTEXT + 1)}
        lines = [
            Line(number, line, number in marked)
            for number, line in enumerate(text.splitlines(), 1)
            if number in shown
        ]
        if lines:
            files[name] = lines
    return Side(package.name, files)


# ---------------------------------------------------------------- for people


@dataclass(frozen=True)
class Places:
    """Where what is alike in a class is shown, beside its folder of results."""

    results: Path

    def beside(self, suffix: str) -> Path:
        return self.results.with_name(f"{self.results.name}.alike.{suffix}")


def write_alike(
    results: Path, pairs: list[Pair], found: Mapping[str, Found], least: float = EXPECTED
) -> Path:
    """Write the pairs as a page, a table and for the class page; `found` has them all by name."""
    places = Places(results.resolve())
    page = fill_template(
        TEMPLATES / "alike.html",
        (TEMPLATES / "dashboard.css").read_text(encoding="utf-8"),
        title=results.name,
        pairs=[(pair, *sides(pair, found)) for pair in pairs],
        least=least,
        run=RUN,
        clean=printable,
    )
    write_whole(page.encode("utf-8"), places.beside("html"))
    write_whole(as_table(pairs), places.beside("csv"))
    write_whole(msgspec.json.encode(pairs), places.beside("json"))
    return places.beside("html")


def sides(pair: Pair, found: Mapping[str, Found]) -> tuple[Side, Side]:
    first, second = (pack(found[name]) for name in pair.names)
    one, other = side_by_side(first, second)
    return replace(one, name=pair.first), replace(other, name=pair.second)


def read_alike(results: Path) -> list[Pair]:
    """The pairs that were found last; empty where nobody looked."""
    try:
        content = Places(results.resolve()).beside("json").read_bytes()
        return msgspec.json.decode(content, type=list[Pair])
    except (OSError, msgspec.MsgspecError):
        return []


def as_table(pairs: list[Pair]) -> bytes:
    """The pairs for a spreadsheet."""
    rows = ((*each.names, each.share, each.runs) for each in pairs)
    return as_csv([("first", "second", "alike", "runs"), *rows]).encode("utf-8-sig")
