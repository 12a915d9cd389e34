"""Write text for people: safe words of a submission, tables, numbers, lists and times."""

import csv
import io
import math
import re
import shlex
import unicodedata
from collections.abc import Callable, Iterable
from datetime import datetime

MAX_WORDS = 400  # characters of a submission in one line


def defuse(words: str) -> str:
    """Return words without control and direction characters, so that they are safe to show."""
    return words.translate(HARMLESS)


class Harmless(dict[int, int]):
    """Maps each character code to the code to show; computed at first use."""

    def __missing__(self, number: int) -> int:
        letter = chr(number)
        self[number] = number if letter.isprintable() or letter == "\n" else ord(" ")
        return self[number]


HARMLESS = Harmless()


def printable(words: str) -> str:
    """Return words without line breaks, control and direction characters."""
    return defuse(words).replace("\n", " ")


def clean(words: str) -> str:
    """Return a submission's words on one line, without control characters."""
    return printable(words)[:MAX_WORDS]


def name_command(words: str, folder: object) -> str:
    """Return a command on a folder to type, such as `grader class grade 'lab 5'`."""
    return f"grader {words} {shlex.quote(str(folder))}"


def plural(number: int, noun: str) -> str:
    """Return a number with its noun: `1 point`, `2 points`."""
    return f"{number} {noun}" + "s" * (number != 1)


def format_time(when: datetime | None) -> str:
    """Return `4 May 2027 23:59 (UTC+02:00)`; empty for None."""
    return f"{when.day} {when:%B %Y %H:%M} ({when.tzname()})" if when else ""


NUMBERS = (
    *("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen"),
    *("eighteen", "nineteen", "twenty"),
)


def spell_number(count: int) -> str:
    """Return a small number as a word: `three`."""
    return NUMBERS[count] if count < len(NUMBERS) else str(count)


def join_words(words: list[str]) -> str:
    """Join words: `a, b and c`."""
    return " and ".join(filter(None, [", ".join(words[:-1]), words[-1]]))


def digits(value: float) -> str:
    """Return a number with six digits, and 0 for rounding noise around 0."""
    return f"{round(value, 9) + 0.0:.6g}" if math.isfinite(value) else str(value)


def format_rough(value: float) -> str:
    """Return a number with three digits, or all before the point."""
    return f"{value:.3g}" if value < 1000 else f"{value:.0f}"


# ---------------------------------------------------------------- tables for spreadsheets

FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n")  # the beginning of a cell that a spreadsheet runs
# The same signs inside a cell, also wide, small, raised and lowered ones. A spreadsheet's language
# and settings decide which separators split a line.
SIGNS = (
    "=+@\uff1d\uff0b\uff0d\uff20\ufe66\ufe62\ufe63\ufe6b\u207c\u207a\u208c\u208a\ufb29\u2a75\u2a76-"
)
SEPARATORS = ";|\t\r\n"


def escape_formula(cell: str) -> str:
    """Put an apostrophe before a cell that a spreadsheet would run as a formula."""
    plain = unicodedata.normalize("NFKC", cell).lstrip(" ")
    return f"'{cell}" if plain.startswith(FORMULA) and not is_dash(cell) else cell


def is_plain_row(cells: list[object]) -> bool:
    """Return whether a row begins with a word and has one line: then a dash begins no formula."""
    words = [str(cell) for cell in cells]
    return words[0][:1].isalnum() and not any(sign in word for word in words for sign in '"\r\n')


def is_dash(cell: object) -> bool:
    """Return whether a cell is only a dash, which means nothing."""
    return isinstance(cell, str) and unicodedata.normalize("NFKC", cell).lstrip(" ") == "-"


def escape_inside(cell: str, separators: str = SEPARATORS) -> str:
    """Put an apostrophe before each formula after one of these separators."""
    between = rf"[\s\"{separators}]"
    return re.sub(
        rf"(?<!{between}){between}++(?=[{SIGNS}])",  # reads each run once
        lambda found: found[0] + "'" * any(each in separators for each in found[0]),
        cell,
    )


def format_csv(
    table: Iterable[Iterable[object]],
    delimiter: str = ",",
    line_end: str = "\r\n",
    escape: Callable[[str], str] = escape_formula,
) -> str:
    """Return the rows of a table as CSV, each text escaped.

    No cell begins like a formula, for any separator of a spreadsheet.
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
