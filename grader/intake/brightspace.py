"""Brightspace: a folder for each time that a student handed in, or a file for each file of it."""

import re
from pathlib import Path

from grader.intake.dates import moment
from grader.intake.found import Upload
from grader.intake.names import portable
from grader.intake.roster import ClassList

NAME = re.compile(
    r"(?P<ids>\d+-\d+) - (?P<name>.+?) - (?P<when>(?:(?! - ).)*\d{4}(?:(?! - ).)*?)"
    r"(?: - (?P<file>.+))?"
)
INDEX = "index.html"  # a list of all that was handed in


def upload(path: Path, people: ClassList) -> Upload | None:
    """Whose upload this is; None for what Brightspace does not write. The time is the school's."""
    match = NAME.fullmatch(path.name)
    if match is None:
        return None
    name = people.name_of(["name"], match["name"]) or people.one_of_group(match["name"])
    name = name or f"{match['name']}_{match['ids']}"
    when = moment(match["when"])
    return Upload(
        path,
        portable(name),
        from_lms=True,
        handed_in=when,
        attempt=when.isoformat() if when else match["when"],
        timeless=when is None,
        owner=match["ids"],
    )


def own_name(path: Path) -> str | None:
    """The file's name as the student gave it; None for what Brightspace does not write."""
    match = NAME.fullmatch(path.name)
    return match["file"] if match else None
