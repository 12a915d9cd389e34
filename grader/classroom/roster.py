"""Class lists: the gradebook files of learning systems, and who is meant by what one says."""

import csv
import io
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Literal

from grader.classroom.names import folded, names_of

CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
MOODLE = ("First name", "Last name", "Surname", "ID number", "Email address")
WORKSHEET = ("Identifier", "Full name", "ID number", "Email address")  # Moodle's, of one assignment
BLACKBOARD = ("Last Name", "First Name", "Username", "Student ID")
BRIGHTSPACE = ("OrgDefinedId", "Username", "Last Name", "First Name", "Email")
END_OF_LINE = "End-of-Line Indicator"  # Brightspace's last column, a # in each row
SUBMITTED = "Last modified (submission)"  # in Moodle's worksheet, the school's own time
MOMENTS = ("%A, %d %B %Y, %I:%M %p", "%A, %B %d, %Y, %I:%M %p", "%d %B %Y, %I:%M %p")
CALLED = "Called"  # a column of one's own: what an export calls somebody whom it does not identify
KEYS = (
    "SIS Login ID",
    "Email address",
    "ID number",
    "SIS User ID",
    "Username",
    "OrgDefinedId",
    "Student ID",
    "Email",
    "Identifier",
)
GROUPS = ("Group", "Groups", "Group name", "Group Name")
Kind = Literal["canvas", "worksheet", "blackboard", "brightspace", "plain"]
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
    kind: Kind
    possible: bool  # there is a row of points possible
    delimiter: str
    mark: str  # the byte order mark, where there is one
    encoding: str = "utf-8"

    def key(self, wanted: str = "") -> str:
        """The column that identifies students."""
        if wanted and wanted not in self.columns:
            columns = ", ".join(self.columns)
            raise CannotRead(f"{self.path} has no column {wanted!r}; it has {columns}")
        for enough in (all, any):  # one that everybody has, before one that some have
            for name in [wanted] if wanted else KEYS:
                if name in self.columns and enough(row[name].strip() for row in self.rows):
                    return name
        raise CannotRead(f"{self.path} has none of {', '.join(KEYS)}: name yours with --key")


def read_roster(path: Path) -> Roster:
    """Read the gradebook of a learning system, or any CSV with a row of titles."""
    try:
        content = path.read_bytes()
        # Blackboard calls its tables .xls and writes them so
        encoding = "utf-16" if content.startswith((b"\xff\xfe", b"\xfe\xff")) else "utf-8"
        text = content.decode(encoding)
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
    kind = kind_of(columns)
    canvas = kind == "canvas"
    possible = canvas and any(row["Student"].strip() == POINTS_POSSIBLE for row in rows)
    students = [row for row in rows if not canvas or is_student(row)]
    return Roster(path, columns, students, kind, possible, delimiter, mark, encoding)


def kind_of(columns: list[str]) -> Kind:
    """Whose gradebook has these columns."""
    here = set(columns)
    if set(CANVAS[:2]) <= here:
        return "canvas"
    if {"Identifier", "Grade"} <= here:
        return "worksheet"
    if END_OF_LINE in here or "OrgDefinedId" in here:
        return "brightspace"
    return "blackboard" if set(BLACKBOARD[:3]) <= here else "plain"


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
            "first_name": row.get("First name", row.get("First Name", first if comma else "")),
            "last_name": row.get("Last name", row.get("Last Name", last)),
            "email": row.get("Email address", row.get("Email", "")),
        }


# ---------------------------------------------------------------- who is meant


class ClassList:
    """Who is in the class, by everything that an LMS may call them; empty without a roster."""

    def __init__(self, roster: Roster | None = None, key: str = "") -> None:
        self.names: list[str] = []
        self._known: dict[tuple[str, str], set[str]] = {}
        self._columns: set[str] = set()
        self._handed_in: dict[str, datetime] = {}
        self._participants: dict[str, str] = {}
        self.groups: list[list[str]] = []
        if roster is None:
            return
        key = roster.key(key)
        self._columns = set(roster.columns)
        for row in roster.rows:
            if not row[key].strip():
                continue
            self.names.append(row[key].strip())
            number = row.get("Identifier", "").removeprefix("Participant ").strip()
            if row.get("Full name", "").strip() and number.isdecimal():
                self._participants[row[key].strip()] = f"{row['Full name'].strip()}_{number}"
            if when := moment(row.get(SUBMITTED, "")):
                self._handed_in[row[key].strip()] = when
            for column, label in [*row.items(), *(("name", name) for name in names_in(row))]:
                self._known.setdefault((column, folded(label)), set()).add(row[key].strip())
        for rows in groups_of(roster):
            self.groups.append([row[key].strip() for row in rows if row[key].strip()])

    def name_of(self, columns: Iterable[str], *labels: object) -> str | None:
        """The one student whom one of the labels means."""
        for column in columns:
            for label in labels:
                names = self._known.get((column, folded(str(label or ""))), set())
                if label and len(names) == 1:
                    return next(iter(names))
        return None

    def knows(self, column: str) -> bool:
        """Whether the list has such identifiers: then no name need be guessed from."""
        return column in self._columns

    def handed_in(self, name: str) -> datetime | None:
        """When somebody handed in, where the list says so: the school's own time, no zone."""
        return self._handed_in.get(name)

    def participant(self, name: str) -> str:
        """What Moodle calls a student in the names of files; empty where the list does not say."""
        return self._participants.get(name, "")

    def absent(self, handed_in: Iterable[str]) -> list[str]:
        """Those who handed in nothing, given the names of the others."""
        here = {folded(name) for name in handed_in}
        return [name for name in self.names if not here & set(names_of(name))]

    def unlisted(self, handed_in: Iterable[str]) -> list[str]:
        """Those who handed in and are not in the class list."""
        known = {each for name in self.names for each in names_of(name)}
        return [name for name in handed_in if self.names and folded(name) not in known]


def groups_of(roster: Roster) -> list[list[dict[str, str]]]:
    """The rows of each group that the list names, in the order in which they come."""
    column = next((name for name in GROUPS if name in roster.columns), None)
    groups: dict[str, list[dict[str, str]]] = {}
    for row in roster.rows if column else []:
        if row[column or ""].strip():
            groups.setdefault(row[column or ""].strip(), []).append(row)
    return list(groups.values())


def names_in(row: dict[str, str]) -> Iterator[str]:
    """Someone's full name, first name first and last name first."""
    last, _, first = row.get("Student", "").partition(", ")
    for title in ("Last name", "Last Name", "Surname"):
        last = row.get(title, last)
    for title in ("First name", "First Name"):
        first = row.get(title, first)
    if first and last:
        yield from (f"{first} {last}", f"{last} {first}")
    if full := row.get("Full name", ""):
        yield full


def moment(words: str) -> datetime | None:
    """A time as Moodle's worksheet has it, in English."""
    for form in MOMENTS:
        try:
            return datetime.strptime(words.strip(), form)
        except ValueError:
            continue
    return None
