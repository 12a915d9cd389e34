"""Write text for people: a submission's words made safe, tables, numbers, lists and times."""

import csv
import io
import math
import re
import unicodedata
from collections.abc import Callable, Iterable
from datetime import datetime

MAX_WORDS = 400  # characters of a submission in one line


def harmless(words: str) -> str:
    """Return words without control and direction characters, so that they are safe to show."""
    return words.translate(HARMLESS)


class Harmless(dict[int, int]):
    """The letters to show, by number of letter; each is looked up when it first comes."""

    def __missing__(self, number: int) -> int:
        letter = chr(number)
        self[number] = number if letter.isprintable() or letter == "\n" else ord(" ")
        return self[number]


HARMLESS = Harmless()


def printable(words: str) -> str:
    """Return words without line breaks, control and direction characters."""
    return harmless(words).replace("\n", " ")


def clean(words: str) -> str:
    """Return a submission's words on one line, with nothing that a terminal would obey."""
    return printable(words)[:MAX_WORDS]


def plural(number: int, noun: str) -> str:
    """`1 point`, `2 points`."""
    return f"{number} {noun}" + "s" * (number != 1)


def moment(when: datetime | None) -> str:
    """`4 May 2027 23:59 (UTC+02:00)`; empty for none."""
    return f"{when.day} {when:%B %Y %H:%M} ({when.tzname()})" if when else ""


NUMBERS = (
    *("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen"),
    *("eighteen", "nineteen", "twenty"),
)


def number(count: int) -> str:
    """Return a small number as a word: `three`."""
    return NUMBERS[count] if count < len(NUMBERS) else str(count)


def listed(words: list[str]) -> str:
    """`a, b and c`."""
    return " and ".join(filter(None, [", ".join(words[:-1]), words[-1]]))


def digits(value: float) -> str:
    """Return six digits, without the noise that rounding leaves around 0."""
    return f"{round(value, 9) + 0.0:.6g}" if math.isfinite(value) else str(value)


def about(value: float) -> str:
    """Return three digits, or all before the point."""
    return f"{value:.3g}" if value < 1000 else f"{value:.0f}"


# ---------------------------------------------------------------- tables for spreadsheets

FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n")  # how a cell begins that a spreadsheet would run


# The same signs inside a cell: spreadsheets part a line where their language or a setting says so.
# Wide, small, raised and lowered ones count too.
SIGNS = (
    "=+@\uff1d\uff0b\uff0d\uff20\ufe66\ufe62\ufe63\ufe6b\u207c\u207a\u208c\u208a\ufb29\u2a75\u2a76-"
)
SEPARATORS = ";|\t\r\n"


def escape_formula(cell: str) -> str:
    """Put an apostrophe before a cell that a spreadsheet would take for a formula."""
    plain = unicodedata.normalize("NFKC", cell).lstrip(" ")
    return f"'{cell}" if plain.startswith(FORMULA) and not is_dash(cell) else cell


def is_plain_row(cells: list[object]) -> bool:
    """Return whether a row begins with a word, and on one line: a dash in it begins nothing."""
    words = [str(cell) for cell in cells]
    return words[0][:1].isalnum() and not any(sign in word for word in words for sign in '"\r\n')


def is_dash(cell: object) -> bool:
    """Return whether a cell is a dash alone, which stands for nothing."""
    return isinstance(cell, str) and unicodedata.normalize("NFKC", cell).lstrip(" ") == "-"


def escape_inside(cell: str, separators: str = SEPARATORS) -> str:
    """Put an apostrophe before each formula that begins after one of these separators."""
    between = rf"[\s\"{separators}]"
    return re.sub(
        rf"(?<!{between}){between}++(?=[{SIGNS}])",  # each run is looked at once
        lambda found: found[0] + "'" * any(each in separators for each in found[0]),
        cell,
    )


def format_csv(
    table: Iterable[Iterable[object]],
    delimiter: str = ",",
    line_end: str = "\r\n",
    escape: Callable[[str], str] = escape_formula,
) -> str:
    """Return the rows of a table as CSV, each text in it escaped.

    No cell begins like a formula, whatever the table is taken apart at.
    """
    separators = SEPARATORS + "," * (delimiter != ",")  # the writer quotes what has a delimiter
    out = io.StringIO(newline="")
    writer = csv.writer(out, delimiter=delimiter, lineterminator=line_end)
    for row in table:
        cells = [escape_inside(escape(c), separators) if isinstance(c, str) else c for c in row]
        if len(cells) > 1 and not is_plain_row(cells):
            cells = [f"'{cell}" if is_dash(cell) else cell for cell in cells]
        writer.writerow(cells)
    return out.getvalue()
