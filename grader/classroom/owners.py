"""Whose a result is: by identifiers before names, and never by a guess.

A result bears the name of its student as the class was taken in: an identifier, if there was a
class list, or what the LMS wrote, a name with a number behind it.
"""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from grader.intake.names import folded, names_of, without_zeros
from grader.intake.roster import KEYS, Roster, groups_of, names_in, number_in

NUMBERED = re.compile(r"(?P<name>.+)_(?P<number>\d+(?:-\d+)?)")  # as exports name their files
Row = dict[str, str]
Labels = Callable[[Row], Iterable[str]]


@dataclass
class Owners:
    """Who has which result."""

    rows: dict[int, list[str]] = field(default_factory=dict)  # names of results, by the row
    doubts: dict[str, list[Row]] = field(default_factory=dict)  # of any of these rows
    strangers: list[str] = field(default_factory=list)
    group: dict[int, list[str]] = field(default_factory=dict)  # whose result is shared, by the row

    @property
    def doubtful(self) -> list[Row]:
        """The rows that some result may belong to, and none does for sure."""
        rows = [row for rows in self.doubts.values() for row in rows]
        return [row for row in rows if not self.rows.get(id(row))]

    def of(self, row: Row) -> list[str]:
        return self.rows.get(id(row), [])

    def mates(self, row: Row) -> list[str]:
        """Those of the group whose result counts for this student too."""
        return self.group.get(id(row), [])


def match(roster: Roster, key: str, names: Iterable[str], absent: Iterable[str] = ()) -> Owners:
    """Find the row of each result, by the surest way that finds any; `absent` share nothing."""
    owners = Owners()
    ways = [(indexed(roster, row_labels), labels) for row_labels, labels in ways_by(key)]
    for name in names:
        hits = next(filter(None, (found(index, labels(name)) for index, labels in ways)), [])
        if len(hits) == 1:
            owners.rows.setdefault(id(hits[0]), []).append(name)
        elif hits:
            owners.doubts[name] = hits
        else:
            owners.strangers.append(name)
    share(roster, owners, set(absent))
    return owners


def indexed(roster: Roster, labels: Labels) -> dict[str, list[Row]]:
    index: dict[str, list[Row]] = {}
    for row in roster.rows:
        for label in {folded(each) for each in labels(row)} - {""}:
            index.setdefault(label, []).append(row)
    return index


def found(index: dict[str, list[Row]], labels: Iterable[str]) -> list[Row]:
    rows = {id(row): row for label in labels for row in index.get(folded(label), [])}
    return list(rows.values())


def share(roster: Roster, owners: Owners, absent: set[str]) -> None:
    """Who handed in nothing has what the one of the group has who did."""
    for rows in groups_of(roster).values():
        handed_in = [name for row in rows for name in owners.of(row) if name not in absent]
        for row in rows:
            if handed_in and not owners.of(row):
                owners.group[id(row)] = handed_in
    for place, mates in owners.group.items():
        owners.rows[place] = mates


# ---------------------------------------------------------------- ways to know somebody


def ways_by(key: str) -> list[tuple[Labels, Callable[[str], list[str]]]]:
    """What a row is known by, and what to look for with a result's name, the surest first."""
    return [
        (lambda row: [row[key]], lambda name: [name]),
        (lambda row: [row.get(column, "") for column in (*KEYS, "ID")], lambda name: [name]),
        (lambda row: [row.get("ID", ""), number_in(row)], number_of),
        (lambda row: names_of(row[key]), names_of),
        (names_in, lambda name: [name, plain_name(name)]),
        (
            lambda row: [without_zeros(row.get(column, "")) for column in (key, *KEYS, "ID")],
            lambda name: [without_zeros(name)],
        ),
    ]


def number_of(name: str) -> list[str]:
    """Canvas's ID or that of Moodle's Identifier, as it stands behind a name."""
    match = NUMBERED.fullmatch(name)
    return [match["number"]] if match else []


def plain_name(name: str) -> str:
    match = NUMBERED.fullmatch(name)
    return match["name"] if match else name
