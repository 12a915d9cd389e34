"""Find similar submissions, apart from code that all students were given.

Each submission is cut into runs of `RUN` tokens without names and numbers, so that new names,
comments and layout change nothing. Runs of the starter, of given files and of the solution do not
count. Runs that many students have do not count either. The similarity of two submissions is the
share of the smaller one's runs that the other has.

Right answers to short tasks are similar by nature. `EXPECTED` is above the shares of the bank's
independent right answers, as a test shows.
"""

import keyword
import re
import token
import zlib
from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from functools import cache, lru_cache, partial
from itertools import combinations
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.intake.found import CannotTake, Package, Work
from grader.intake.listing import open_class
from grader.intake.packing import pack
from grader.intake.roster import ClassList
from grader.judge.task import KIT
from grader.judge.wall.outer import READING, Allowance, Exceeded, Failed, Lost, call_within
from grader.player.page import fill_template
from grader.report.files import write_whole
from grader.source.regions import python_files
from grader.text import format_csv, printable

TEMPLATES = Path(__file__).with_name("templates")

RUN = 14  # tokens: about two lines
EXPECTED = 0.5  # share of the smaller one's runs
FEWEST = 40  # own runs of a submission that is compared
FEW, MANY = 8, 50  # a run counts if at most a quarter of the class has it, within these bounds
MOST = 100  # pairs
MAX_TEXT = 500_000  # bytes of one submission
CONTEXT = 2  # lines around shared ones
MOST_SHOWN = 2000  # lines of a submission beside those of another
COMPARING = Allowance("comparing the class", cpu=300)
OPERATORS = sorted(token.EXACT_TOKEN_TYPES, key=len, reverse=True)
TOKEN = re.compile(  # an unclosed text takes the rest of its line or file
    r"(?P<layout>#.*|\\?\s+)"
    r"|(?P<text>\w{0,2}(?:\"{3}(?s:.*?)(?:\"{3}|\Z)|'{3}(?s:.*?)(?:'{3}|\Z)"
    r"|\"(?:\\.|[^\"\\\n])*(?:\"|$)|'(?:\\.|[^'\\\n])*(?:'|$)))"
    r"|(?P<number>\.?\d(?:[eE][+-]|[\w.])*)|(?P<name>\w+)"
    rf"|{'|'.join(map(re.escape, OPERATORS))}",
    re.M,
)

Token = tuple[str, int]  # a token as it is compared, and its line


@dataclass(frozen=True)
class Prints:
    """The own runs of a submission."""

    name: str
    runs: frozenset[int]
    team: tuple[str, ...] = ()  # the same for students who handed in together


class Pair(Struct, frozen=True):
    first: str
    second: str
    share: float  # of the smaller one's own runs
    runs: int  # that both have

    @property
    def names(self) -> tuple[str, str]:
        return self.first, self.second


def read_tokens(source: str) -> list[Token]:
    """Return the tokens of a file, without those that are easily changed."""
    found, line = list[Token](), 1
    for each in TOKEN.finditer(source):
        kind = "" if keyword.iskeyword(each[0]) else each.lastgroup
        if kind != "layout":
            found.append((kind or each[0], line))
        line += each[0].count("\n")
    return found


def list_runs(tokens: list[Token]) -> Iterator[tuple[int, int, int]]:
    """Return each RUN tokens in a row: their hash, first and last line."""
    words = [word for word, _ in tokens]
    for at in range(len(tokens) - RUN + 1):
        run = zlib.crc32("\0".join(words[at : at + RUN]).encode())
        yield run, tokens[at][1], tokens[at + RUN - 1][1]


def read_texts(package: Package) -> dict[str, str]:
    """Return the Python files by name, up to MAX_TEXT."""
    texts: dict[str, str] = {}
    room = MAX_TEXT
    for name, content in package.files:
        if name.endswith(".py") and len(content) <= room:
            room -= len(content)
            texts[name] = content.decode("utf-8-sig", "replace").replace("\r\n", "\n")
    return texts


@cache
def collect_given_runs() -> frozenset[int]:
    """Return the runs of the starter and of the solution."""
    files = [path for tree in ("starter", "solution") for path in python_files(KIT / tree)]
    texts = (path.read_text(encoding="utf-8") for path in files)
    return frozenset().union(*map(hash_runs, texts))


@lru_cache(maxsize=512)  # most files of a class are handed-out ones
def hash_runs(text: str) -> frozenset[int]:
    return frozenset(run for run, _, _ in list_runs(read_tokens(text)))


def make_prints(package: Package, team: tuple[str, ...] = ()) -> Prints:
    """Return the runs of a submission that are in neither the starter nor the solution."""
    given = collect_given_runs()  # once, for all processes forked from here
    texts = read_texts(package).values()
    runs = call_within(READING, frozenset[int], lambda: frozenset().union(*map(hash_runs, texts)))
    return Prints(package.name, runs - given, team)


def read_prints(
    stack: ExitStack, folder: Path, people: ClassList
) -> tuple[dict[str, Work], list[Prints]]:
    """Read an earlier class, named after its folder; its files stay while `stack` is open."""
    found, prints = {}, []
    for each in stack.enter_context(open_class(folder, people)).found:
        if each.handed_in_by:
            continue  # the work of a group is compared once
        name = f"{folder.stem}/{each.name}"
        with suppress(CannotTake, Exceeded, Failed, Lost):
            prints.append(replace(make_prints(pack(each), each.team), name=name))
            found[name] = each
    return found, prints


def find_pairs(
    prints: Iterable[Prints], least: float = EXPECTED, of: Container[str] | None = None
) -> list[Pair]:
    """Return the pairs that share more than `least`, the most similar first.

    Members of a group are no pair. `of` keeps only pairs with one of these names. Raises
    Exceeded if a class has too much in common for the limits.
    """
    return call_within(COMPARING, list[Pair], partial(compare_all, list(prints), least, of))


def compare_all(prints: list[Prints], least: float, of: Container[str] | None) -> list[Pair]:
    """Compare each with each, in this process."""
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
        together = first.team and first.team == second.team
        wanted = of is None or first.name in of or second.name in of
        if share > least and wanted and not together:
            pairs.append(Pair(first.name, second.name, round(share, 3), count))
    pairs.sort(key=lambda each: (-each.share, -each.runs, each.first, each.second))
    return pairs[:MOST]


@dataclass(frozen=True)
class Line:
    number: int
    text: str
    is_shared: bool


Side = dict[str, list[Line]]  # one of two submissions: lines around shared ones, by file


def show_pair(first: Work, second: Work) -> tuple[Side, Side]:
    """Show the shared lines of two submissions; nothing if that takes too long."""
    with suppress(CannotTake, Exceeded, Failed, Lost):
        return compare(pack(first), pack(second))
    return {}, {}


def compare(first: Package, second: Package) -> tuple[Side, Side]:
    """Return the lines of each that hold their common runs."""
    common = make_prints(first).runs & make_prints(second).runs
    return call_within(
        READING,
        tuple[Side, Side],
        lambda: (mark_lines(first, common), mark_lines(second, common)),
    )


def mark_lines(package: Package, common: frozenset[int]) -> Side:
    """Return the lines of a submission that hold common runs, with lines around them."""
    files, room = Side(), MOST_SHOWN
    for file, text in read_texts(package).items():
        marked = {
            line
            for run, first, last in list_runs(read_tokens(text))
            if run in common
            for line in range(first, last + 1)
        }
        shown = {line + by for line in marked for by in range(-CONTEXT, CONTEXT + 1)}
        lines = [
            Line(number, line, number in marked)
            for number, line in enumerate(text.split("\n"), 1)
            if number in shown
        ][:room]
        if lines:
            files[file] = lines
            room -= len(lines)
    return files


def locate_pairs(results: Path, suffix: str) -> Path:
    """Return the file of similar pairs, beside the folder of results."""
    results = results.resolve()
    return results.with_name(f"{results.name}.alike.{suffix}")


def write_pairs(results: Path, pairs: list[Pair], found: Mapping[str, Work]) -> Path:
    """Write the pairs as a page, a table and JSON; `found` has all submissions by name."""
    path = locate_pairs(results, "html")
    page = fill_template(
        TEMPLATES / "alike.html",
        "dashboard.css",
        title=results.name,
        pairs=[(pair, *show_pair(*(found[name] for name in pair.names))) for pair in pairs],
        least=EXPECTED,
        run=RUN,
        clean=printable,
    )
    write_whole(page.encode("utf-8"), path)
    rows = ((*each.names, each.share, each.runs) for each in pairs)
    table = format_csv([("first", "second", "alike", "runs"), *rows])
    write_whole(table.encode("utf-8-sig"), locate_pairs(results, "csv"))
    write_whole(msgspec.json.encode(pairs), locate_pairs(results, "json"))
    return path


def read_pairs(results: Path) -> list[Pair]:
    """Return the pairs that were found last; empty if there was no search."""
    try:
        content = locate_pairs(results, "json").read_bytes()
        return msgspec.json.decode(content, type=list[Pair])
    except (OSError, msgspec.MsgspecError):
        return []
