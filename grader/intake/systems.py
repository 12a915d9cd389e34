"""Read class lists as learning systems write them."""

import csv
import io
import re
from contextlib import suppress
from pathlib import Path

from grader.errors import Stop
from grader.intake.learning_systems import SYSTEMS
from grader.intake.lms import Lms
from grader.intake.roster import KEYS, ClassList, Roster

ANY_OTHER = Lms()

WORKBOOKS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")  # first bytes of .xlsx and .ods, .xls
MANGLED = re.compile(r"\d([.,]\d+)?E\+\d+")  # a long number in a spreadsheet


def find_system(roster: Roster) -> Lms:
    """Return the system whose gradebook this is."""
    columns = set(roster.columns)
    return next((each for each in SYSTEMS if each.writes_gradebook(columns)), ANY_OTHER)


def read_roster(path: Path) -> Roster:
    """Read the gradebook of a learning system, or any CSV with a row of titles."""
    roster = read_table(path)
    system = find_system(roster)
    everything = roster.rows
    roster.rows = [system.read_row(row) for row in everything if system.is_student(row)]
    roster.other_rows = [row for row in everything if not system.is_student(row)]
    for row in roster.rows:
        for column in (*KEYS, "ID"):
            if MANGLED.fullmatch(row.get(column, "").strip()):
                raise Stop(
                    f"{path} has {row[column].strip()} under {column!r}, which a spreadsheet made "
                    "of a number: export it again, and do not save it from a spreadsheet"
                )
    return roster


def read_table(path: Path) -> Roster:
    """Read any CSV with a row of titles, in any encoding and with any separator."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise Stop(f"there is no class list at {path}") from error
    if content.startswith(WORKBOOKS):
        raise Stop(f"{path} is a spreadsheet's own file: export the class list as CSV")
    text, encoding, doubt = decode(content, path)
    mark = "\ufeff" if text.startswith("\ufeff") else ""
    text = re.sub(r"\Asep=[,;\t]\r?\n", "", text.removeprefix(mark))  # only spreadsheets read it
    first = text.partition("\n")[0]
    delimiter = max(",;\t", key=lambda each: len(next(csv.reader([first], delimiter=each), [])))
    cells = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
    lines = [row for row in cells if any(map(str.strip, row))]
    if len(lines) < 2:
        raise Stop(f"{path} is empty: it needs a row of titles and a row per student")
    written = columns = [title.strip() for title in lines[0]]
    for system in SYSTEMS:
        columns = system.translate(columns)
    if len(set(columns)) < len(columns):
        raise Stop(f"{path} has two columns of one name: {', '.join(columns)}")
    rows = [dict(zip(columns, [*row, *[""] * len(columns)], strict=False)) for row in lines[1:]]
    titles = {name: title for name, title in zip(columns, written, strict=True) if name != title}
    return Roster(path, columns, rows, delimiter, mark, encoding, titles, doubt)


def decode(content: bytes, path: Path) -> tuple[str, str, str]:
    """Return a table's text, the encoding to write, and a warning or empty text."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        return content.decode("utf-16", "replace"), "utf-16", ""  # as Blackboard's .xls
    with suppress(UnicodeDecodeError):
        return content.decode("utf-8"), "utf-8", ""
    text = content.decode("cp1252", "replace")
    letters = next((word for word in re.findall(r"\w+", text) if not word.isascii()), "\ufffd")
    doubt = f"{path} is not UTF-8 and was read as Windows writes it: is {letters!r} right?"
    return text, "utf-8", doubt


def read_class_list(folder: Path) -> ClassList:
    """Return the class list of a folder, its roster.csv; empty without one."""
    roster = find_file(folder, "roster.csv")
    return ClassList(read_roster(roster) if roster else None)


def find_file(folder: Path, name: str) -> Path | None:
    """Return the file of this name in the folder of a class, or None."""
    return folder / name if (folder / name).is_file() else None
