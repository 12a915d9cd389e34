"""Moodle: a folder or a file for each student and kind of upload, both in the name."""

import re
from pathlib import Path

from grader.intake.found import Upload
from grader.intake.names import portable
from grader.intake.roster import ClassList

NAME = re.compile(r"(?P<name>.+)_(?P<id>\d+)_assignsubmission_(?P<kind>[a-z]+)(_(?P<file>.*))?")


def upload(path: Path, people: ClassList) -> Upload | None:
    """Whose upload this is; None for what Moodle does not write."""
    match = NAME.fullmatch(path.name)
    if match is None:
        return None
    known = people.name_of(["Identifier"], match["id"])
    if known is None and not people.knows("Identifier"):
        known = people.name_of(["name"], match["name"], *without_group(match["name"]))
    name = known or f"{match['name']}_{match['id']}"
    return Upload(
        path,
        portable(name),
        from_lms=True,
        empty=match["kind"] != "file",
        handed_in=people.handed_in(name),
        owner=match["id"],
    )


def without_group(name: str) -> list[str]:
    """What may be the student's name where the group's stands before it: `Group 3-Ann Lee`."""
    parts = name.split("-")
    return ["-".join(parts[at:]) for at in range(1, len(parts))]


def own_name(path: Path) -> str | None:
    """The file's name as the student gave it; None for what Moodle does not write."""
    match = NAME.fullmatch(path.name)
    return match["file"] or "file" if match else None
