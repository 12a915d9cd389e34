"""Find the student of each result: by identifiers before names, without guessing.

With a class list a result is named by the student's identifier; without one by the name and number
that the learning system wrote.
"""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from grader.intake.names import fold, split_login, strip_zeros
from grader.intake.roster import KEYS, Roster, Row, list_full_names, read_number

NUMBERED = re.compile(r"(?P<name>.+)_(?P<number>\d+(?:-\d+)?)")  # names of files in exports
Labels = Callable[[Row], Iterable[str]]


@dataclass
class Owners:
    """The results of each row of a class list, and results without a clear owner."""

    rows: dict[int, list[str]] = field(default_factory=dict)  # names of results, by the row
    doubts: dict[str, list[Row]] = field(default_factory=dict)  # rows that may own a result
    strangers: list[str] = field(default_factory=list)
    mates: dict[int, list[str]] = field(default_factory=dict)  # whose result is shared

    @property
    def doubtful(self) -> list[Row]:
        """Return the rows with uncertain results only."""
        rows = [row for rows in self.doubts.values() for row in rows]
        return [row for row in rows if not self.find_results(row)]

    def find_results(self, row: Row) -> list[str]:
        return self.rows.get(id(row), [])


def find_owners(roster: Roster, key: str, names: Iterable[str], absent: Iterable[str]) -> Owners:
    """Find the row of each result; results of `absent` students are not shared."""
    owners = Owners()
    ways = [(index_rows(roster, row_labels), labels) for row_labels, labels in list_ways(key)]
    for name in names:
        hits = next(filter(None, (look_up(index, labels(name)) for index, labels in ways)), [])
        if len(hits) == 1:
            owners.rows.setdefault(id(hits[0]), []).append(name)
        elif hits:
            owners.doubts[name] = hits
        else:
            owners.strangers.append(name)
    share_results(roster, owners, set(absent))
    return owners


def index_rows(roster: Roster, labels: Labels) -> dict[str, list[Row]]:
    index: dict[str, list[Row]] = {}
    for row in roster.rows:
        for label in {fold(each) for each in labels(row)} - {""}:
            index.setdefault(label, []).append(row)
    return index


def look_up(index: dict[str, list[Row]], labels: Iterable[str]) -> list[Row]:
    rows = {id(row): row for label in labels for row in index.get(fold(label), [])}
    return list(rows.values())


def share_results(roster: Roster, owners: Owners, absent: set[str]) -> None:
    """Give a group's results to its members who have none."""
    for rows in roster.list_groups().values():
        handed_in = [name for row in rows for name in owners.find_results(row)]
        handed_in = [name for name in handed_in if name not in absent]
        for row in rows:
            if handed_in and not owners.find_results(row):
                owners.mates[id(row)] = handed_in
    owners.rows |= owners.mates


def list_ways(key: str) -> list[tuple[Labels, Callable[[str], list[str]]]]:
    """Return the ways to match the labels of a row with a result's name, the surest first."""
    return [
        (lambda row: [row[key]], lambda name: [name]),
        (lambda row: [row.get(column, "") for column in (*KEYS, "ID")], lambda name: [name]),
        (lambda row: [row.get("ID", ""), read_number(row)], lambda name: split_name(name)[1:]),
        (lambda row: split_login(row[key]), split_login),
        (list_full_names, lambda name: [name, split_name(name)[0]]),
        (
            lambda row: [strip_zeros(row.get(column, "")) for column in (key, *KEYS, "ID")],
            lambda name: [strip_zeros(name)],
        ),
    ]


def split_name(name: str) -> list[str]:
    """Return a name, and the number that a learning system put behind it, if any."""
    match = NUMBERED.fullmatch(name)
    return [match["name"], match["number"]] if match else [name]
