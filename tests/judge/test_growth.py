"""Measure how the judge's work grows with its input: little faster than the input itself."""

import io
import json
import tempfile
import time
import tracemalloc
import zipfile
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial
from pathlib import Path, PurePosixPath
from typing import NamedTuple

import msgspec
import pytest
from counting import count_calls
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grader.classroom.comments import Comment, place_comment
from grader.classroom.similarity import hash_runs
from grader.cli.hand_in import has_no_answer
from grader.intake import names
from grader.intake.archives import Bounds, check_name, unzip
from grader.intake.dates import read_moment
from grader.intake.found import CannotTake
from grader.intake.learning_systems import SYSTEMS
from grader.intake.pieces import is_renamed, name_type, rank_file, strip_additions
from grader.intake.roster import ClassList
from grader.judge.explain.error_words import find_similar
from grader.judge.submission import load_given
from grader.protocol import NOT_A_MESSAGE, Answered
from grader.source.definitions import Program
from grader.source.flaws import find_bad_bytes, find_flaw
from grader.source.given import compare_files
from grader.source.regions import regions_in, shape_of
from grader.source.suspects import RegionCode, find_dead_end, find_leftover, find_suspects
from grader.text import clean, escape_inside, format_csv

TIMES = 4  # as much input
MOST = 2.5 * TIMES  # times the work: more than n log n, less than n squared, with a margin
FEW_CALLS, FEW_SECONDS, FEW_BYTES = 2_000, 0.05, 2 << 20  # below this, any growth is accepted


class Cost(NamedTuple):
    calls: int  # of functions
    seconds: float  # of the processor
    bytes: int  # at the highest point


ENOUGH = Cost(FEW_CALLS, FEW_SECONDS, FEW_BYTES)


class Shape(NamedTuple):
    """A text of any length that repeats itself."""

    start: str
    unit: str
    end: str

    def __call__(self, length: int) -> str:
        return self.start + self.unit * max(1, length // len(self.unit)) + self.end


def measure(work: Callable[[], object]) -> Cost:
    calls = count_calls(work)
    began = time.process_time()
    work()
    seconds = time.process_time() - began
    tracemalloc.start()
    try:
        work()
        return Cost(calls, seconds, tracemalloc.get_traced_memory()[1])
    finally:
        tracemalloc.stop()


def find_growth(work: Callable[[str], object], shape: Shape, length: int) -> list[str]:
    """Return the costs that grow too fast from a text to a longer one."""
    little, much = (measure(partial(work, shape(size))) for size in (length, TIMES * length))
    return [
        f"{name}: {before:.4g} -> {after:.4g}"
        for name, before, after, enough in zip(Cost._fields, little, much, ENOUGH, strict=True)
        if after > max(enough, MOST * before)
    ]


def check_growth(work: Callable[[str], object], shape: Shape, length: int) -> None:
    """Fail if a cost grows too fast in three measurements: one may be the machine's fault."""
    for _ in range(3):
        found = find_growth(work, shape, length)
        if not found:
            return
    raise AssertionError(f"{shape!r} from {length} to {TIMES * length} letters: {found}")


def draw_shapes(pieces: Iterable[str]) -> st.SearchStrategy[Shape]:
    letters = st.text(max_size=3)
    piece = st.one_of(st.sampled_from(sorted(pieces)), letters)
    few = st.lists(piece, max_size=3).map("".join)
    return st.builds(Shape, few, few.filter(bool), few)


def encodable(work: Callable[[str], object]) -> Callable[[str], object]:
    """Return the work, done on the characters that UTF-8 can encode."""
    return lambda text: work(text.encode("utf-8", "ignore").decode("utf-8"))


# ---------------------------------------------------------------- names

IN_NAMES = {
    *(" ", " - ", "_", "-1", "(1)", " (1)", "copy", " - Copy", "Copy of ", "Kopie von ", "final"),
    *(".py", ".txt", ".tar.gz", ".", "%20", "%", "/", "\\", "..", "con", "\u0390", "e\u0301", "1"),
    *("integrators", "mini_engine", "attempt", "_attempt_2026-05-04-10-00-00", "LATE", "LATE_"),
    *("assignsubmission_file", "123-456 - ", "May 4, 2026 1159 PM", "2026", "\ufdfa", "\u202e"),
}
EVERYBODY = ClassList()


def read_name(name: str) -> None:
    """Read the name of a file or folder of a class in every way."""
    path = Path("/class") / (name.replace("/", "_").replace("\0", "_") or "_")
    for system in SYSTEMS:
        system.match(path)
        system.read_own_name(path)
        system.read_upload(path, EVERYBODY)
    read_moment(name)
    find_similar(name[:255], ["integrators", "mini_engine"])


def read_entry_name(name: str) -> None:
    """Read a name in an archive, which may be longer, in every way."""
    for work in (names.make_portable, names.fold, names.strip_zeros, names.split_login):
        work(name)
    with suppress(CannotTake):
        check_name(name)
    rank_file(PurePosixPath(name))
    strip_additions(name)
    is_renamed(name, "integrators")
    clean(name)
    format_csv([[escape_inside(name), name]])


def read_sorted(name: str) -> None:
    names.sort_key(name)


# ---------------------------------------------------------------- sources

IN_SOURCES = {
    *(" ", "\t", "\f", "\n", "\r", "\\\n", "(", ")", "[", "{", "'", '"', '"""', "f'{", "#", "$"),
    *("@", ";", ":", "=", "a", "a.b", "0", "1e", "-", "not ", "lambda: ", "x if x else ", "async "),
    *(
        "# TODO 8a: x\n",
        "# END TODO 8a\n",
        "#TODO",
        "a1",
        "def step():\n    pass\n",
        "if 0:\n ",
        "pass\n",
        "x = 1\n",
    ),
    *("class A(A.a, A.b): pass\n", "from integrators import *\n", "import integrators as a\n"),
    *(
        "while 1: pass\n",
        "return\n",
        "try:\n pass\nfinally:\n pass\n",
        "\ufeff",
        "\0",
        "\u0390",
        "?",
    ),
}
STUB = "return position, velocity\n"


def read_source(text: str) -> None:
    """Read a program as the judge does before it runs."""
    find_bad_bytes(text.encode())
    name_type(text.encode())
    find_flaw(text)
    shape_of(text)
    with suppress(ValueError):
        regions_in(text)
    code = RegionCode(text, "8a", "step")
    find_leftover(code, STUB)
    find_dead_end(code)
    find_suspects(code)
    compare_files({"integrators.py": text}, load_given())
    program = Program({Path("integrators.py"): text})
    program.definition("integrators", "step")
    program.names_used("integrators", "step")
    program.list_loaded("integrators")


def read_tokens(text: str) -> None:
    hash_runs.cache_clear()
    hash_runs(text)


def find_comment(text: str) -> None:
    """Look for the line of a comment, if it is unchanged and if it has changed."""
    for code in (text.partition("\n")[0], "something else"):
        comment = Comment("ann", "Why?", "a.py", 3, code, "pass", "x = 1")
        place_comment(comment, {"a.py": text.encode()})


# ---------------------------------------------------------------- archives, replies, notebooks


def read_archive(text: str) -> None:
    """Unpack an archive whose files have the pieces of a text as names."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for number, first in enumerate(range(0, len(text), 40)):
            archive.writestr(f"{number}/{text[first : first + 40]}", text[first : first + 40])
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "work.zip").write_bytes(packed.getvalue())
        with suppress(CannotTake):
            unzip(Path(folder) / "work.zip", Path(folder) / "out", Bounds())


def read_reply(text: str) -> None:
    for value in (text, [text[first : first + 9] for first in range(0, len(text), 9)]):
        for message in (value, {"reply": {"type": "returned", "value": value}}):
            with suppress(*NOT_A_MESSAGE):
                msgspec.msgpack.decode(msgspec.msgpack.encode(message), type=Answered)
    with suppress(*NOT_A_MESSAGE):
        msgspec.msgpack.decode(text.encode(), type=Answered)


def read_notebook(text: str) -> None:
    cell = {"cell_type": "code", "metadata": {}, "outputs": [], "source": [text[:200]]}
    notebook = {"cells": [cell] * (len(text) // 200), "metadata": {}, "nbformat": 4}
    for content in (text, json.dumps(notebook)):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "integrators.ipynb"
            file.write_text(content, encoding="utf-8")
            with suppress(ValueError, KeyError, TypeError, AttributeError):
                has_no_answer(file)


WORKS = {
    "name": (read_name, IN_NAMES, 60),
    "sorted": (read_sorted, IN_NAMES, 60),
    "entry": (read_entry_name, IN_NAMES, 1000),
    "source": (read_source, IN_SOURCES, 3000),
    "tokens": (read_tokens, IN_SOURCES, 3000),
    "archive": (read_archive, IN_NAMES, 2000),
    "reply": (read_reply, IN_NAMES | IN_SOURCES, 8000),
    "notebook": (read_notebook, IN_SOURCES, 8000),
}
ANY = settings(deadline=None, suppress_health_check=list(HealthCheck), database=None)


def try_shapes(kind: str, examples: int) -> None:
    work, pieces, length = WORKS[kind]

    @given(draw_shapes(pieces))
    @settings(ANY, max_examples=examples, derandomize=examples < 100)
    def holds(shape: Shape) -> None:
        check_growth(encodable(work), shape, length)

    holds()


@pytest.mark.parametrize(
    ("kind", "examples"),
    [
        *((kind, 10) for kind in WORKS if kind != "archive"),
        *(pytest.param(kind, 300, marks=pytest.mark.soak) for kind in WORKS),
    ],
)
def test_work_grows_little_faster_than_its_input(kind: str, examples: int):
    try_shapes(kind, examples)


@pytest.mark.parametrize(
    "unit",
    [
        "x = 1\n\n",
        pytest.param("x = 1\n", marks=pytest.mark.soak),
        pytest.param("\n", marks=pytest.mark.soak),
    ],
)
def test_a_comment_is_found_in_time_among_lines_of_one_text(unit: str):
    check_growth(find_comment, Shape("x = 1\n", unit, ""), 40_000)


@pytest.mark.parametrize("start", ["#TODO", "# END TODO ", "    # todo "])
def test_a_long_word_for_a_marker_is_read_in_time(start: str):
    check_growth(read_source, Shape(start, "a1", " "), 6000)


def test_a_square_is_noticed():
    def compare_all(text: str) -> int:
        return sum(one.isalpha() and other.isalpha() for one in text for other in text)

    assert find_growth(compare_all, Shape("", "a", ""), 200)
    assert not find_growth(str.upper, Shape("", "a", ""), 200)
