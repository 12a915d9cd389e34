"""Describe class lists, and find the student whom a learning system means."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

from grader.errors import Stop
from grader.intake.dates import read_moment
from grader.intake.names import fold, make_portable, split_login, strip_zeros

Row = dict[str, str]

KEYS = (  # columns that identify students, in the order in which they are tried
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
PLAIN_COLUMNS = ("First name", "Last name", "Surname", "ID number", "Email address")
LAST = ("Last name", "Last Name", "LastName", "Surname")
FIRST = ("First name", "First Name", "FirstName")
GROUPS = ("Group", "Groups", "Group name", "Group Name")
SUBMITTED = "Last modified (submission)"  # in Moodle's worksheet, the school's own time
CALLED = "Called"  # a teacher's column: a student's name in an export without identifiers


@dataclass
class Roster:
    """A class list as a learning system wrote it."""

    path: Path
    columns: list[str]
    rows: list[Row]  # of students
    delimiter: str
    mark: str  # the byte order mark, if there is one
    encoding: str = "utf-8"
    titles: dict[str, str] = field(default_factory=dict)  # titles of columns, if it has other ones
    doubt: str = ""  # reason for manual review
    other_rows: list[Row] = field(default_factory=list)  # such as Canvas's points possible

    def choose_key(self, wanted: str = "") -> str:
        if wanted and wanted not in self.columns:
            columns = ", ".join(self.columns)
            raise Stop(f"{self.path} has no column {wanted!r}; it has {columns}")
        for enough in (all, any):  # first a column that all students have
            for name in [wanted] if wanted else KEYS:
                if name in self.columns and enough(row[name].strip() for row in self.rows):
                    return name
        for name in [] if wanted else self.columns:  # in an unknown language
            addresses = {row[name].strip() for row in self.rows}
            if len(addresses) == len(self.rows) and all("@" in each for each in addresses):
                return name
        raise Stop(
            f"{self.path} has none of {', '.join(KEYS)}: call the column that identifies students "
            "by one of these names, export it again in English, or, where a command has it, name "
            "your column with --key"
        )

    @property
    def group_column(self) -> str:
        """Return the column of groups; empty if there is none."""
        return next((name for name in GROUPS if name in self.columns), "")

    def list_groups(self) -> dict[str, list[Row]]:
        """Return the rows of each group by its name, in the order of the list."""
        groups: dict[str, list[Row]] = {}
        for row in self.rows if self.group_column else []:
            if name := row[self.group_column].strip():
                groups.setdefault(name, []).append(row)
        return groups


def list_people(roster: Roster, key: str) -> Iterator[dict[str, str]]:
    """Return students for nbgrader: id, names and address, as far as the class list has them."""
    for row in roster.rows:
        last, first = split_name(row)
        if row[key].strip():
            yield {
                "id": row[key].strip(),
                "first_name": first,
                "last_name": last,
                "email": row.get("Email address", row.get("Email", "")),
            }


def split_name(row: Row) -> tuple[str, str]:
    """Return a student's last and first name, as far as the class list has them."""
    last, _, first = row.get("Student", "").partition(", ")
    return pick_title(row, LAST, last), pick_title(row, FIRST, first)


def list_full_names(row: Row) -> Iterator[str]:
    """Yield a student's full name, first name first and last name first."""
    last, first = split_name(row)
    if first and last:
        yield from (f"{first} {last}", f"{last} {first}")
    if full := row.get("Full name", ""):
        yield full


def list_name(row: Row) -> str:
    """Return a student's name as lists have it, last name first; empty if unknown."""
    last, first = split_name(row)
    return f"{last}, {first}" if first and last else row.get("Full name", "")


def read_number(row: Row) -> str:
    """Return the number in Moodle's Identifier, which begins with a word."""
    match = re.search(r"\d+$", row.get("Identifier", "").strip())
    return match[0] if match else ""


def pick_title(row: Row, titles: tuple[str, ...], otherwise: str) -> str:
    return next((row[title] for title in titles if title in row), otherwise)


class ClassList:
    """The students of a class, by all their names and identifiers; empty without a roster."""

    def __init__(self, roster: Roster | None = None, key: str = "") -> None:
        self.names: list[str] = []
        self.groups: dict[str, list[str]] = {}  # students, by the group's name
        self.times: dict[str, datetime] = {}  # of handing in, without a zone, if the list has it
        self.full_names: dict[str, str] = {}  # as lists have them, by the names of results
        self.chosen: list[tuple[str, str]] = []  # students, and the work chosen for them
        self.participants: dict[str, str] = {}  # Moodle's names of students in file names
        self._students: dict[tuple[str, str], set[str]] = {}  # by column and spelling
        self._columns = set(roster.columns) if roster else set()
        if roster is None:
            return
        key = roster.choose_key(key)
        for row in roster.rows:
            if name := row[key].strip():
                self._add(name, row)
        for group, rows in roster.list_groups().items():
            self.groups[group] = [row[key].strip() for row in rows if row[key].strip()]

    def _add(self, name: str, row: Row) -> None:
        self.names.append(name)
        self.full_names[make_portable(name)] = list_name(row)
        number = read_number(row)
        self._students.setdefault(("Identifier", number), set()).add(name)
        if number and (full := row.get("Full name", "").strip()):
            self.participants[name] = f"{full}_{number}"
        if when := read_moment(row.get(SUBMITTED, "")):
            self.times[name] = when
        for column, label in [*row.items(), *(("name", each) for each in list_full_names(row))]:
            for spelled in {fold(label), strip_zeros(label)}:
                self._students.setdefault((column, spelled), set()).add(name)

    def find(self, columns: Iterable[str], *labels: object) -> str | None:
        """Return the first student that a label identifies alone; None if none does."""
        for spell in (fold, strip_zeros):
            for column in columns:
                for label in filter(None, labels):
                    names = self._students.get((column, spell(str(label))), set())
                    if len(names) == 1:
                        return next(iter(names))
        return None

    def list_called(self, label: str) -> list[str]:
        """Return all students with this name or identifier, in the list's order."""
        columns = [*KEYS, "ID", CALLED, "Student", "Full name", "name"]
        spellings = {fold(label), strip_zeros(label)}
        keys = [(column, spelled) for column in columns for spelled in spellings]
        found = set().union(*(self._students.get(key, set()) for key in keys))
        return [name for name in self.names if name in found]

    def find_in_group(self, group: str) -> str:
        """Return a group's first student, whose work the others share."""
        groups = self.groups.items()
        return next((names[0] for name, names in groups if names and fold(name) == fold(group)), "")

    def has_column(self, column: str) -> bool:
        """Return whether the list has identifiers in this column."""
        return column in self._columns

    def list_absent(self, handed_in: Iterable[str]) -> list[str]:
        """Return the students who are not among `handed_in`."""
        here = {fold(name) for name in handed_in}
        return [name for name in self.names if not here & set(split_login(name))]

    def list_unlisted(self, handed_in: Iterable[str]) -> list[str]:
        """Return the names in `handed_in` that are not in the class list."""
        listed = {each for name in self.names for each in split_login(name)}
        return [name for name in handed_in if self.names and fold(name) not in listed]


def find_student(who: str, names: list[str], people: ClassList) -> str:
    """Return a student's name in the class, or `who` as written if unknown.

    Raises Stop for a name that two students have.
    """
    meant = [name for name in names if is_same_student(who, name)]
    listed = [each for name in people.list_called(who) for each in (name, make_portable(name))]
    meant += [name for name in names if any(is_same_student(each, name) for each in listed)]
    meant = list(dict.fromkeys(meant))
    if len(meant) > 1:
        raise Stop(
            f"{who!r} in the adjustments could be {' or '.join(meant)}: write one of these names"
        )
    return meant[0] if meant else who


def is_same_student(who: str, name: str) -> bool:
    """Return whether two names are the same, or one is the first half of the other's address."""
    return fold(who) in split_login(name) or fold(name) in split_login(who)
