"""What people keep: a folder or an archive for each student, of any name."""

from pathlib import Path

from grader.intake.found import Upload
from grader.intake.names import portable
from grader.intake.places import is_archive, stem_of
from grader.intake.roster import ClassList


def upload(path: Path, people: ClassList) -> Upload | None:
    """A submission named after its folder or archive; None for any other file."""
    if path.is_dir():
        return Upload(path, portable(path.name))
    return Upload(path, portable(stem_of(path))) if is_archive(path) else None
