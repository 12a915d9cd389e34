"""Test text for people: no table has a formula, for any separator of a spreadsheet."""

import csv
import io
import re
import sys
import unicodedata
from itertools import product
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from grader.text import SEPARATORS, SIGNS, escape_inside, format_csv

GRADER = Path(__file__).parents[1] / "grader"
CELLS = st.text(st.sampled_from("=+-@;|,\t\r\n\u00a0 \"'a1\uff1d"), max_size=8)


def formulas(text: str, delimiter: str) -> list[str]:
    """Return the cells that a spreadsheet would run if it splits lines at this delimiter."""
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
    cells = (unicodedata.normalize("NFKC", cell).strip() for row in rows for cell in row)
    return [cell for cell in cells if cell.startswith(("=", "+", "-", "@")) and cell != "-"]


@pytest.mark.parametrize("separator", [";", "\t", "|", "\n", "\r"])
def test_no_formula_begins_inside_of_a_cell(separator: str):
    for sign, written in product("=+-@\uff1d", ",;\t"):
        for cell in (f"a{separator}{sign}1", f"{separator} {sign}1", f'a{separator}"{sign}1'):
            text = format_csv([[cell, "b"]], written)
            assert not any(formulas(text, parted) for parted in (",", ";", "\t", "|"))
            assert not re.search(rf"[{SEPARATORS}][\s\"]*[{SIGNS}]", text)


@settings(max_examples=50, deadline=None)
@given(st.lists(st.lists(CELLS, min_size=2, max_size=2), min_size=1, max_size=3))
@example([["-", ""]])
def test_no_table_has_a_formula(table: list[list[str]]):
    for written in (",", ";", "\t"):
        text = format_csv(table, written)
        assert not any(formulas(text, parted) for parted in (",", ";", "\t", "|"))


def test_all_signs_that_begin_a_formula_are_listed():
    letters = map(chr, range(sys.maxunicode + 1))
    found = {c for c in letters if unicodedata.normalize("NFKC", c)[:1] in ("=", "+", "-", "@")}
    assert found == set(SIGNS)


@pytest.mark.parametrize(
    "cell",
    [
        *("3; 4", "a=b; c-d", "1 - 2", "x, -y", "-", "| a |", "a\nb"),
        "O'Brien",
        "3-4",
        "12.5",
        "  x",
    ],
)
def test_honest_words_stay(cell: str):
    assert next(csv.reader(io.StringIO(format_csv([[cell]]), newline=""))) == [cell]


@pytest.mark.parametrize("part", ["\t", "; ", ";", '"', " "])
def test_a_long_cell_is_read_once(part: str):
    """A pattern that goes back takes hours for such a cell."""
    assert escape_inside(part * 500_000 + "a") == part * 500_000 + "a"


def test_all_tables_are_written_by_one_function():
    files = (
        path
        for path in GRADER.rglob("*.py")
        if re.search(r"csv\.(writer|Dict)", path.read_text("utf-8"))
    )
    assert [path.relative_to(GRADER).as_posix() for path in files] == ["text.py"]
