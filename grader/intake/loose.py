"""Loose files in a class folder: somebody's work that cannot be graded like this, and the rest."""

from pathlib import Path

from grader.intake.brightspace import INDEX
from grader.intake.found import Intake
from grader.intake.gradescope import METADATA
from grader.intake.names import portable
from grader.intake.roster import ClassList

SIDE_FILES = {METADATA, INDEX, "adjustments.toml", "roster.csv"}  # of the class folder itself
WORK = {".py", ".ipynb"}  # what is somebody's
UNREAD = {".zst", ".lz", ".lzma", ".z", ".lzh", ".arj", ".ace", ".cab", ".iso", ".dmg", ".001"}


def mention(path: Path, intake: Intake, people: ClassList) -> None:
    """Say of a file that is no submission what is to be done about it, if anything is."""
    name = people.anybody(path.stem)
    if path.is_symlink():
        words = f"{path.name} is a link, and links are not followed: put there what it leads to"
        intake.troubles[portable(name or path.name)] = words
    elif path.suffix.lower() in WORK:
        words = f"{path.name} is no folder and no archive: put it into a folder"
        intake.troubles[portable(name or path.stem)] = words
    elif path.suffix.lower() in UNREAD:
        words = f"{path.name} is packed in a way that is not read: ask for a zip"
        intake.troubles[portable(name or path.stem)] = words
    elif name is not None:
        words = f"nothing of the lab was found: {path.name} is no folder and no archive"
        intake.troubles[portable(name)] = words
    elif path.name not in SIDE_FILES and path.suffix.lower() != ".csv":
        intake.notes.append(f"{path.name} is no submission: left out")
