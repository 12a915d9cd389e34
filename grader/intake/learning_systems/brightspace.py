"""Brightspace: a folder for each attempt of a student, or a file for each of its files."""

import re
from collections.abc import Iterator
from pathlib import Path

from grader.intake.dates import read_moment
from grader.intake.found import Upload
from grader.intake.lms import Lms, MarkColumn, Page, pick
from grader.intake.names import make_portable
from grader.intake.roster import ClassList, Roster, Row

NAME = re.compile(
    r"(?P<ids>\d+-\d+) - (?P<name>.+?) - (?P<when>(?:(?! - ).)*\d{4}(?:(?! - ).)*?)"
    r"(?: - (?P<file>.+))?"
)
OWN = ("OrgDefinedId", "Username")  # the identifiers that it accepts
SIGN = "#"  # before an identifier, and in the last column
END_OF_LINE = "End-of-Line Indicator"  # the last column, a # in each row


class Brightspace(Lms):
    name = "brightspace"
    title = "Brightspace"
    class_list = (
        "*Grades, Export*, with both keys: `OrgDefinedId`, `Username`, `End-of-Line Indicator`"
    )
    download = (
        "`123-456 - Jane Doe - May 4, 2026 1159 PM` becomes `Jane Doe_123-456`, and the time; "
        "the last of several counts, `index.html` is skipped"
    )
    marks_file = "`OrgDefinedId`, `Username`, `TITLE Points Grade`, `End-of-Line Indicator`"
    rank = 1
    only_commas = True
    takes_feedback = True
    upload_name = NAME
    side_files = frozenset({"index.html"})  # a list of all submissions

    def read_upload(self, path: Path, people: ClassList) -> Upload | None:
        """Return the owner and time of an upload; the time is the school's."""
        match = self.match(path)
        if match is None:
            return None
        name = people.find(["name"], match["name"]) or people.find_in_group(match["name"])
        when = read_moment(match["when"])
        return Upload(
            path,
            make_portable(name or f"{match['name']}_{match['ids']}"),
            from_lms=True,
            handed_in=when,
            attempt=when.isoformat() if when else match["when"],
            timeless=when is None,
            owner=match["ids"],
        )

    def writes_gradebook(self, columns: set[str]) -> bool:
        return END_OF_LINE in columns or "OrgDefinedId" in columns

    def read_row(self, row: Row) -> Row:
        """Remove the identifiers' sign; keep signed ones for `make_table`."""
        return (
            row
            | {f"{SIGN}{name}": row[name] for name in OWN if name in row}
            | {name: row[name].removeprefix(SIGN) for name in OWN if name in row}
        )

    def make_table(self, roster: Roster, marks: MarkColumn) -> list[list[str]]:
        """Return rows of identifiers, points, and the sign that ends a row."""
        own = [name for name in OWN if name in roster.columns]
        written = [f"{SIGN}{name}" for name in own]  # as it was exported
        table = [[*own, f"{marks.title} Points Grade", END_OF_LINE]]
        return [*table, *([*pick(each.row, written), each.mark, SIGN] for each in marks.rows)]

    def name_pages(self, source: Path, pages: list[Page]) -> Iterator[tuple[str, bytes]]:
        """Yield the pages, in folders named as in the download."""
        if match := self.match(source):
            folder = f"{match['ids']} - {match['name']} - {match['when']}"
            yield from ((f"{folder}/{each.file}", each.content) for each in pages)
