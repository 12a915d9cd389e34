"""Class lists: the CSV files of Canvas and Moodle, and who is meant by what an LMS says."""

import csv
import io
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from grader.classroom.names import folded, names_of

CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
MOODLE = ("First name", "Last name", "ID number", "Email address")
KEYS = ("SIS Login ID", "Email address", "ID number", "SIS User ID")
POINTS_POSSIBLE = "Points Possible"  # the first cell of Canvas's second row
TEST_STUDENT = "Student, Test"  # Canvas's own, who never hands in


class CannotRead(Exception):
    """A file that is not what it should be; the message names it and says what to do."""


# ---------------------------------------------------------------- reading


@dataclass
class Roster:
    """A class list as an LMS wrote it."""

    path: Path
    columns: list[str]
    rows: list[dict[str, str]]  # of students
    canvas: bool
    possible: bool  # there is a row of points possible
    delimiter: str
    mark: str  # the byte order mark, where there is one

    def key(self, wanted: str = "") -> str:
        """The column that identifies students."""
        if wanted and wanted not in self.columns:
            columns = ", ".join(self.columns)
            raise CannotRead(f"{self.path} has no column {wanted!r}; it has {columns}")
        for name in [wanted] if wanted else KEYS:
            if name in self.columns and any(row[name].strip() for row in self.rows):
                return name
        raise CannotRead(f"{self.path} has none of {', '.join(KEYS)}: name yours with --key")


def read_roster(path: Path) -> Roster:
    """Read a class list of Canvas, Moodle, or any CSV with a row of titles."""
    try:
        text = path.read_bytes().decode("utf-8")
    except OSError as error:
        raise CannotRead(f"there is no class list at {path}") from error
    except UnicodeDecodeError as error:
        raise CannotRead(f"{path} is not UTF-8: export it from the LMS again, as CSV") from error
    mark = "\ufeff" if text.startswith("\ufeff") else ""
    text = text.removeprefix(mark)
    first = text.partition("\n")[0]
    delimiter = max(",;\t", key=first.count)
    lines = [row for row in csv.reader(io.StringIO(text, newline=""), delimiter=delimiter) if row]
    if len(lines) < 2:
        raise CannotRead(f"{path} is empty: it needs a row of titles and a row per student")
    columns = [title.strip() for title in lines[0]]
    if len(set(columns)) < len(columns):
        raise CannotRead(f"{path} has two columns of one name: {', '.join(columns)}")
    rows = [dict(zip(columns, [*row, *[""] * len(columns)], strict=False)) for row in lines[1:]]
    canvas = set(CANVAS[:2]) <= set(columns)
    possible = canvas and any(row["Student"].strip() == POINTS_POSSIBLE for row in rows)
    students = [row for row in rows if not canvas or is_student(row)]
    return Roster(path, columns, students, canvas, possible, delimiter, mark)


def is_student(row: dict[str, str]) -> bool:
    return row["Student"].strip() not in ("", POINTS_POSSIBLE, TEST_STUDENT)


def people(roster: Roster, key: str) -> Iterator[dict[str, str]]:
    """Students for nbgrader: id, names and address, as far as the class list has them."""
    for row in roster.rows:
        if not row[key].strip():
            continue
        last, comma, first = row.get("Student", "").partition(", ")
        yield {
            "id": row[key].strip(),
            "first_name": row.get("First name", first if comma else ""),
            "last_name": row.get("Last name", last),
            "email": row.get("Email address", ""),
        }


# ---------------------------------------------------------------- who is meant


class ClassList:
    """Who is in the class, by everything that an LMS may call them; empty without a roster."""

    def __init__(self, roster: Roster | None = None, key: str = "") -> None:
        self.names: list[str] = []
        self._known: dict[tuple[str, str], set[str]] = {}
        if roster is None:
            return
        key = roster.key(key)
        for row in roster.rows:
            if not row[key].strip():
                continue
            self.names.append(row[key].strip())
            for column, label in [*row.items(), *(("name", name) for name in names_in(row))]:
                self._known.setdefault((column, folded(label)), set()).add(row[key].strip())

    def name_of(self, columns: Iterable[str], *labels: object) -> str | None:
        """The one student whom one of the labels means."""
        for column in columns:
            for label in labels:
                names = self._known.get((column, folded(str(label or ""))), set())
                if label and len(names) == 1:
                    return next(iter(names))
        return None

    def absent(self, handed_in: Iterable[str]) -> list[str]:
        """Those who handed in nothing, given the names of the others."""
        here = {folded(name) for name in handed_in}
        return [name for name in self.names if not here & set(names_of(name))]

    def unlisted(self, handed_in: Iterable[str]) -> list[str]:
        """Those who handed in and are not in the class list."""
        known = {each for name in self.names for each in names_of(name)}
        return [name for name in handed_in if self.names and folded(name) not in known]


def names_in(row: dict[str, str]) -> Iterator[str]:
    """Someone's full name, first name first and last name first."""
    last, _, first = row.get("Student", "").partition(", ")
    last, first = row.get("Last name", row.get("Surname", last)), row.get("First name", first)
    if first and last:
        yield from (f"{first} {last}", f"{last} {first}")
