"""Moodle: a folder or file for each upload; its name has student and kind."""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import msgspec

from grader.intake.found import Upload
from grader.intake.lms import PAGE, Lms, MarkColumn, Page
from grader.intake.names import fold, make_portable
from grader.intake.roster import ClassList, Roster

# The first number in a name is Moodle's own: a student may write another into a file's name.
NAME = re.compile(r"(?P<name>.+?)_(?P<id>\d+)_assignsubmission_(?P<kind>[a-z]+)(_(?P<file>.*))?")
TOTAL = "Maximum Grade"  # a column of the worksheet; the one before it is the grade's


@cache
def load_titles() -> dict[str, list[str]]:
    """Load the titles of columns in other languages, by the English ones."""
    text = Path(__file__).with_suffix(".toml").read_bytes()
    return msgspec.toml.decode(text, type=dict[str, list[str]])


class Moodle(Lms):
    """Moodle with its grading worksheet; the export of its gradebook is a plain list."""

    name = "moodle"
    title = "Moodle"
    class_list = (
        "the assignment's *grading worksheet*, with `Identifier`, or *Grades, Export, Plain "
        "text*, with `Email address`, `ID number`"
    )
    download = (
        "`Jane Doe_123456_assignsubmission_file_` becomes `Jane Doe_123456`; with or without "
        "a folder each; the time from the grading worksheet"
    )
    marks_file = (
        "the whole worksheet, `Grade` and `Feedback comments` filled in; for a plain list the "
        "columns of names, then `Grade` and `Feedback`, to be mapped at import"
    )
    rank = 3
    only_commas = True
    names_alone = False
    takes_feedback = True
    upload_name = NAME

    def read_upload(self, path: Path, people: ClassList) -> Upload | None:
        match = self.match(path)
        if match is None:
            return None
        known = people.find(["Identifier"], match["id"])
        if known is None and not people.has_column("Identifier"):
            known = people.find(["name"], match["name"], *cut_group(match["name"]))
        name = known or f"{match['name']}_{match['id']}"
        return Upload(
            path,
            make_portable(name),
            from_lms=True,
            empty=match["kind"] != "file",
            handed_in=people.times.get(name),
            owner=match["id"],
        )

    def read_own_name(self, path: Path) -> str | None:
        return (super().read_own_name(path) or "file") if self.match(path) else None

    def writes_gradebook(self, columns: set[str]) -> bool:
        return {"Identifier", "Grade"} <= columns

    def translate(self, titles: list[str]) -> list[str]:
        plain = {fold(TOTAL): TOTAL}  # newer ones write it in small letters
        for name, others in load_titles().items():
            for other in others:
                if other != "ID" or "Bestwertung" in titles:  # many lists have another ID
                    plain.setdefault(fold(other), name)
        columns = [plain.get(fold(title).replace("\u2019", "'"), title) for title in titles]
        if "Full name" not in columns and "Last name" not in columns:  # Italian: one word for both
            columns = ["Full name" if name == "First name" else name for name in columns]
        if TOTAL in columns and "Identifier" in columns and "Grade" not in columns:
            columns[columns.index(TOTAL) - 1] = "Grade"
        return columns if len(set(columns)) == len(columns) else titles

    def make_table(self, roster: Roster, marks: MarkColumn) -> list[list[str]]:
        """Return the unchanged worksheet with two columns filled in."""
        table = [[roster.titles.get(name, name) for name in roster.columns]]
        for each in marks.rows:
            cells = each.row | {"Grade": each.mark, "Feedback comments": each.summary}
            table.append([cells[name] for name in roster.columns])
        return table

    def for_other_assignments(self) -> Lms:
        """Return a plain list: a worksheet takes marks of its own assignment alone."""
        return Lms()

    def find_total(self, roster: Roster, title: str) -> str:
        totals = {row.get(TOTAL, "").strip() for row in roster.rows}
        return totals.pop() if len(totals) == 1 else ""

    def warn_above(self, names: str, total: float) -> str:
        return (
            f"{names}: above {total:g}, which Moodle's worksheet leaves out without a word: set "
            "their grades in its gradebook, or let the bonus count apart"
        )

    def name_page(self, participant: str, file: str) -> str:
        """Return Moodle's name of a file, with the student's number behind its first `_`."""
        name, _, number = participant.rpartition("_")
        return f"{name.replace('_', ' ')}_{number}_assignsubmission_file_{file}"

    def name_pages(self, source: Path, pages: list[Page]) -> Iterator[tuple[str, bytes]]:
        """Return files whose names hold a participant's number and the kind of upload."""
        if match := self.match(source):
            first = f"{match['name']}_{match['id']}"
            for each in pages:
                file = PAGE if each.participant else each.file
                yield self.name_page(each.participant or first, file), each.content


def cut_group(name: str) -> list[str]:
    """Return possible names of the student in `Group 3-Ann Lee`."""
    parts = name.split("-")
    return ["-".join(parts[at:]) for at in range(1, len(parts))]
