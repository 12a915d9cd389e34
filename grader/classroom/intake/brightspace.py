"""Brightspace: a folder for each time that a student handed in, or a file for each file of it."""

import re
from datetime import datetime
from pathlib import Path

from grader.classroom.intake.found import Upload
from grader.classroom.names import portable
from grader.classroom.roster import ClassList

NAME = re.compile(
    r"(?P<ids>\d+-\d+) - (?P<name>.+?) - (?P<when>[^-]*\d{4} \d{3,4}(?: [AP]M)?)"
    r"(?: - (?P<file>.+))?"
)
DATES = ("%b %d, %Y", "%B %d, %Y", "%d %B, %Y", "%d %b, %Y", "%d %B %Y", "%d %b %Y", "%Y %b %d")
INDEX = "index.html"  # a list of all that was handed in


def upload(path: Path, people: ClassList) -> Upload | None:
    """Whose upload this is; None for what Brightspace does not write. The time is the school's."""
    match = NAME.fullmatch(path.name)
    if match is None:
        return None
    name = people.name_of(["name"], match["name"]) or f"{match['name']}_{match['ids']}"
    when = moment(match["when"])
    return Upload(
        path,
        portable(name),
        from_lms=True,
        handed_in=when,
        attempt=when.isoformat() if when else match["when"],
        owner=match["ids"],
    )


def own_name(path: Path) -> str | None:
    """The file's name as the student gave it; None for what Brightspace does not write."""
    match = NAME.fullmatch(path.name)
    return match["file"] if match else None


def moment(words: str) -> datetime | None:
    """A time as folders have it: `May 4, 2026 1159 PM`, no colon being allowed in a name."""
    date, _, clock = re.sub(r" (?=[AP]M$)", "", words.strip()).rpartition(" ")
    clock = re.sub(r"^(\d)(?=\d\d(\D|$))", r"0\1", clock)
    for form in DATES:
        for hours in ("%I%M%p", "%H%M"):
            try:
                return datetime.strptime(f"{date} {clock}", f"{form} {hours}")
            except ValueError:
                continue
    return None
