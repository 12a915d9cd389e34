"""Moodle: a folder or a file for each student and kind of upload, both in the name."""

import re
from pathlib import Path

from grader.classroom.intake.found import Upload
from grader.classroom.names import portable
from grader.classroom.roster import ClassList

NAME = re.compile(r"(?P<name>.+)_(?P<id>\d+)_assignsubmission_(?P<kind>[a-z]+)(_(?P<file>.*))?")


def upload(path: Path, people: ClassList) -> Upload | None:
    """Whose upload this is; None for what Moodle does not write."""
    match = NAME.fullmatch(path.name)
    if match is None:
        return None
    name = people.name_of(["name"], match["name"]) or f"{match['name']}_{match['id']}"
    return Upload(path, portable(name), from_lms=True, empty=match["kind"] != "file")


def own_name(path: Path) -> str | None:
    """The file's name as the student gave it; None for what Moodle does not write."""
    match = NAME.fullmatch(path.name)
    return match["file"] or "file" if match else None
