"""Define a learning system: how to read its exports and write its imports."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from grader.intake.found import Intake, Upload, Work
from grader.intake.roster import PLAIN_COLUMNS, ClassList, Roster, Row

PAGE = "feedback.html"
TOTAL = re.compile(r"(?:Total Pts: |MaxPoints:)([\d.,]+)")  # of Blackboard and Brightspace


@dataclass(frozen=True)
class MarkRow:
    """The values of one student for a gradebook."""

    row: Row
    mark: str = ""
    summary: str = ""


@dataclass(frozen=True)
class MarkColumn:
    """The marks of one assignment, for a gradebook."""

    title: str
    total: float
    key: str  # the column of the class list that identifies students
    rows: list[MarkRow]


@dataclass(frozen=True)
class Page:
    """A student's page of feedback, to return."""

    name: str  # of the student
    file: str  # its name, if the system allows any
    content: bytes
    text: str  # the same in plain words
    participant: str = ""  # Moodle's name of a group member, if another one handed in


class Lms:
    """A learning system; this class serves any unknown one, by a table with plain columns.

    A new system is a subclass in `learning_systems/` that overrides what differs.
    """

    name = "plain"
    title = ""  # this and the next three: its row in the table of handouts/instructor/class.md
    class_list = ""
    download = ""
    marks_file = ""
    rank = 9  # systems with a lower one are asked first
    title_sign = ""  # the sign behind an assignment's title in the gradebook
    only_commas = False  # it accepts only UTF-8 with commas
    names_alone = True  # its export identifies students by their names alone
    takes_feedback = False  # feedback goes back in bulk, by name_pages
    upload_name: re.Pattern[str] | None = None  # the form of its names of uploads
    side_files: frozenset[str] = frozenset()  # other files of its export

    # -------------------------------------------------------- its exports

    def read_upload(self, path: Path, people: ClassList) -> Upload | None:
        """Return an upload with its owner; None for a name that this system does not write."""
        return None

    def match(self, path: Path) -> re.Match[str] | None:
        """Return the parts of a name that this system writes; None for any other name."""
        return self.upload_name.fullmatch(path.name) if self.upload_name else None

    def is_trial(self, path: Path) -> bool:
        """Return whether the teacher handed this in, as a test student."""
        return False

    def read_own_name(self, path: Path) -> str | None:
        """Return a file's name as the student gave it; None for any other name."""
        match = self.match(path)
        return match["file"] if match else None

    def is_export(self, folder: Path) -> bool:
        """Return whether a folder holds this system's list of submissions."""
        return False

    def is_whole_export(self, folder: Path) -> bool:
        """Return whether a folder among submissions is an export, not itself a submission."""
        return False

    def read_export(self, folder: Path, people: ClassList, intake: Intake) -> Iterator[Work]:
        """Yield the submissions in the list of an export."""
        return iter(())

    # -------------------------------------------------------- its gradebook

    def writes_gradebook(self, columns: set[str]) -> bool:
        """Return whether a gradebook with these columns is this system's."""
        return False

    def is_student(self, row: Row) -> bool:
        return True

    def read_row(self, row: Row) -> Row:
        """Return a student's row without signs around identifiers."""
        return row

    def translate(self, titles: list[str]) -> list[str]:
        """Return the titles of columns in English, as `roster.KEYS` and SUBMITTED have them."""
        return titles

    def make_table(self, roster: Roster, marks: MarkColumn) -> list[list[str]]:
        """Return the file of marks that the system takes, as rows of cells."""
        own = [name for name in roster.columns if name in PLAIN_COLUMNS or name == marks.key]
        table = [[*(roster.titles.get(name, name) for name in own), "Grade", "Feedback"]]
        return [*table, *([*pick(e.row, own), e.mark, e.summary] for e in marks.rows)]

    def for_other_assignments(self) -> "Lms":
        """Return the system to use for another assignment than the class list's own."""
        return self

    def find_total(self, roster: Roster, title: str) -> str:
        """Return the maximum in the gradebook; empty if it has none."""
        head = re.compile(rf"{re.escape(title)}(?: Points Grade)? [\[<]")
        columns = (name for name in roster.columns if head.match(name))
        return next((match[1] for name in columns if (match := TOTAL.search(name))), "")

    def warn_above(self, names: str, total: float) -> str:
        """Return a note on students whose marks are above the total."""
        return f"{names}: above {total:g}: does your gradebook allow that?"

    # -------------------------------------------------------- feedback

    def name_page(self, participant: str, file: str) -> str:
        """Return the name of a page for a student without a file; empty for none."""
        return ""

    def name_pages(
        self, source: Path, pages: list[Page]
    ) -> Iterable[tuple[str, bytes | dict[str, bytes]]]:
        """Yield the files of feedback for the upload `source`; a dict becomes a zip."""
        return ()


def pick(row: Row, columns: Iterable[str]) -> list[str]:
    return [row[name] for name in columns]


def find_title(roster: Roster, start: str, otherwise: str) -> str:
    """Return the title of the assignment's column, which ends with an id in the gradebook."""
    return next((name for name in roster.columns if name.startswith(start)), otherwise)
