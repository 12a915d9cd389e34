"""What people keep: a folder or an archive for each student, of any name."""

from pathlib import Path

from grader.classroom.intake.found import Upload
from grader.classroom.intake.places import is_archive, stem_of
from grader.classroom.names import portable
from grader.classroom.roster import ClassList


def upload(path: Path, people: ClassList) -> Upload | None:
    """A submission named after its folder or archive; None for any other file."""
    if path.is_dir():
        return Upload(path, portable(path.name))
    return Upload(path, portable(stem_of(path))) if is_archive(path) else None
