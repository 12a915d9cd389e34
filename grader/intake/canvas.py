"""Canvas: a file for each upload, with its student, and whether it was late, in the name."""

import re
from pathlib import Path

from grader.intake.found import Upload
from grader.intake.names import portable
from grader.intake.roster import ClassList

NAME = r"(?P<name>(?:\w|[^\x00-\x7f])+?)"  # letters, and the marks on them that are none to Python
FILE = re.compile(rf"{NAME}_(?P<late>LATE_)?(?P<user>\d+)_\d+_(?P<file>.+)")
ANONYMOUS = re.compile(r"(?P<late>LATE_)?(?P<name>anon)_(?P<user>[^\W_]+)_\d+_(?P<file>.+)")
NO_FILE = re.compile(rf"{NAME}_(text|link)\.html")


def upload(path: Path, people: ClassList) -> Upload | None:
    """Whose upload this is; None for what Canvas does not write."""
    match, empty = matched(path), NO_FILE.fullmatch(path.name)
    if match:
        name = people.name_of(["ID"], match["user"]) or f"{match['name']}_{match['user']}"
        late, user = bool(match["late"]), match["user"]
    elif empty:
        user = empty["name"].rpartition("_")[2]
        known = people.name_of(["ID"], user)
        name, late = known or empty["name"].replace("_LATE_", "_"), False
    else:
        return None
    return Upload(path, portable(name), late, from_lms=True, empty=bool(empty), owner=user)


def own_name(path: Path) -> str | None:
    """The file's name as the student gave it; None for what Canvas does not write."""
    match = matched(path)
    return match["file"] if match else None


def matched(path: Path) -> re.Match[str] | None:
    if path.is_dir():
        return None
    return ANONYMOUS.fullmatch(path.name) or FILE.fullmatch(path.name)
