"""Canvas: a file for each upload, with its student, and whether it was late, in the name."""

import re
from collections.abc import Iterator
from pathlib import Path

from grader.intake.found import Upload
from grader.intake.lms import Lms, MarkColumn, Page, find_title, pick
from grader.intake.names import make_portable
from grader.intake.roster import ClassList, Roster, Row

# Letters, and accents that Python does not count as letters. One class only: a letter in two
# classes doubles the ways to read a name.
NAME = r"(?P<name>[0-9A-Za-z_\x80-\U0010ffff]+?)"
FILE = re.compile(rf"{NAME}_(?P<late>LATE_)?(?P<user>\d+)_\d+_(?P<file>.+)")
ANONYMOUS = re.compile(r"(?P<late>LATE_)?(?P<name>anon)_(?P<user>[^\W_]+)_\d+_(?P<file>.+)")
NO_FILE = re.compile(rf"{NAME}_(text|link)\.html")
COLUMNS = (
    *("Student", "LastName", "FirstName", "ID", "SIS User ID", "SIS Login ID"),
    *("Integration ID", "Root Account", "Section"),
)
POINTS_POSSIBLE = "Points Possible"  # the first cell of the second row
TEST_STUDENT = "Student, Test"  # Canvas's own test student
TRIAL = re.compile(r"studenttest_(LATE_)?\d+_.+")  # prefix of its file names


class Canvas(Lms):
    name = "canvas"
    title = "Canvas"
    class_list = "*Grades, Export*, with `Student`, `ID`, `SIS Login ID`, `Section`"
    download = (
        "`doejane_LATE_1234_5678_work.zip` becomes `doejane_1234`, marked as late; loose "
        "files of one student are one submission"
    )
    marks_file = "its own first columns, and the assignment's, by the title with its id"
    rank = 4
    title_sign = "("
    names_alone = False
    takes_feedback = True

    def match(self, path: Path) -> re.Match[str] | None:
        if path.is_dir():
            return None
        return ANONYMOUS.fullmatch(path.name) or FILE.fullmatch(path.name)

    def is_trial(self, path: Path) -> bool:
        return not path.is_dir() and TRIAL.fullmatch(path.name) is not None

    def read_upload(self, path: Path, people: ClassList) -> Upload | None:
        match, empty = self.match(path), NO_FILE.fullmatch(path.name)
        if match:
            name = people.find(["ID"], match["user"]) or f"{match['name']}_{match['user']}"
            late, user = bool(match["late"]), match["user"]
        elif empty:
            user = empty["name"].rpartition("_")[2]
            name = people.find(["ID"], user) or empty["name"].replace("_LATE_", "_")
            late = False
        else:
            return None
        return Upload(path, make_portable(name), late, from_lms=True, empty=bool(empty), owner=user)

    def writes_gradebook(self, columns: set[str]) -> bool:
        return "ID" in columns and ("Student" in columns or {"LastName", "FirstName"} <= columns)

    def is_student(self, row: Row) -> bool:
        return read_first_cell(row) not in ("", POINTS_POSSIBLE, TEST_STUDENT)

    def make_table(self, roster: Roster, marks: MarkColumn) -> list[list[str]]:
        own = [name for name in COLUMNS if name in roster.columns]
        table = [[*own, find_title(roster, f"{marks.title} (", marks.title)]]
        if any(read_first_cell(row) == POINTS_POSSIBLE for row in roster.other_rows):
            table.append([f"    {POINTS_POSSIBLE}", *[""] * (len(own) - 1), f"{marks.total:g}"])
        return [*table, *([*pick(each.row, own), each.mark] for each in marks.rows)]

    def name_pages(
        self, source: Path, pages: list[Page]
    ) -> Iterator[tuple[str, bytes | dict[str, bytes]]]:
        """Yield pages under the upload's name: as a zip for a zip, or else as text."""
        if self.match(source) is None:
            return
        if source.suffix.lower() == ".zip":
            yield source.name, {each.file: each.content for each in pages}
            return
        first, *mates = pages
        texts = [first.text, *(f"{each.name}\n{each.text}" for each in mates)]
        yield source.name, "\n".join(texts).encode("utf-8")


def read_first_cell(row: Row) -> str:
    """Return the name that Canvas writes first, in one column or in two."""
    names = [row[name].strip() for name in ("Student", "LastName", "FirstName") if name in row]
    return ", ".join(filter(None, names))
