"""Blackboard: a file for each upload, with assignment, user and attempt in its name, and a receipt.

The receipt is the `.txt` of an attempt. It names the user, even if the user's name or the
assignment's contains an underscore.
"""

import re
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from grader.intake.found import Upload
from grader.intake.lms import Lms, MarkColumn, find_title, pick
from grader.intake.names import make_portable
from grader.intake.roster import ClassList, Roster
from grader.judge.plain import open_plain

# The first attempt in a name is Blackboard's own: a student may write another into a file's name.
NAME = re.compile(
    r"(?P<attempt>(?P<assignment>.+?)_(?P<user>[^_]+)_attempt_"
    r"(?P<when>\d{4}-\d\d-\d\d-\d\d-\d\d-\d\d))(?:_(?P<file>.+)|\.txt)"
)
WHO = re.compile(r"Name:\s*+(?P<name>.*)\((?P<user>[^()\n]+)\)\s*$", re.M)
HEAD = 600  # characters of a receipt that Blackboard writes itself, before the student's words
COLUMNS = ("Last Name", "First Name", "Username", "Student ID")


class Blackboard(Lms):
    name = "blackboard"
    title = "Blackboard"
    class_list = (
        "*Work offline, Download*, tabs or commas between, with `Username`, `Last Name`, "
        "`First Name`"
    )
    download = (
        "`Lab_ab123_attempt_2026-05-04-23-59-00_work.zip` becomes `ab123`, and the time; "
        "loose files are put together, the last attempt counts. The receipt tells whose file "
        "it is where a login has a `_`"
    )
    marks_file = (
        "names, `Username`, and the column with its id, in the same encoding, tabs or commas"
    )
    rank = 2
    title_sign = "["
    names_alone = False

    def match(self, path: Path) -> re.Match[str] | None:
        return None if path.is_dir() else NAME.fullmatch(path.name)

    def read_upload(self, path: Path, people: ClassList) -> Upload | None:
        """Return the owner and time of an upload; the time is the school's."""
        match = self.match(path)
        if match is None:
            return None
        user, full = read_receipt(path.with_name(f"{match['attempt']}.txt"))
        user = user or match["user"]
        name = people.find(["Username"], user)
        name = name or people.find(["SIS Login ID", "Email address", "ID number"], user)
        if not name and full and not people.has_column("Username"):
            name = people.find(["name"], full)
        when = None
        with suppress(ValueError):
            when = datetime.strptime(match["when"], "%Y-%m-%d-%H-%M-%S")
        return Upload(
            path,
            make_portable(name or people.find_in_group(user) or user),
            from_lms=True,
            empty=not match["file"],
            handed_in=when,
            attempt=match["when"],
            owner=user,
        )

    def writes_gradebook(self, columns: set[str]) -> bool:
        return set(COLUMNS[:3]) <= columns

    def make_table(self, roster: Roster, marks: MarkColumn) -> list[list[str]]:
        """Return rows by username; Blackboard knows a column by the id behind its title."""
        own = [name for name in COLUMNS if name in roster.columns]
        title = find_title(roster, f"{marks.title} [", marks.title)
        return [[*own, title], *([*pick(each.row, own), each.mark] for each in marks.rows)]


def read_receipt(path: Path) -> tuple[str, str]:
    """Return the user's and the full name on a receipt, or empty texts."""
    with suppress(OSError), open_plain(path.parent, path.name) as file:
        match = WHO.search(file.read(HEAD).decode("utf-8-sig", "replace").partition("\n\n")[0])
        if match:
            return match["user"], match["name"].strip()
    return "", ""
