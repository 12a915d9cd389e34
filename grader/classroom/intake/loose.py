"""Loose files in a class folder: somebody's work that cannot be graded like this, and the rest."""

from pathlib import Path

from grader.classroom.intake.brightspace import INDEX
from grader.classroom.intake.found import Intake
from grader.classroom.intake.gradescope import METADATA
from grader.classroom.names import portable

SIDE_FILES = {METADATA, INDEX, "adjustments.toml", "roster.csv"}  # of the class folder itself
WORK = {".py", ".ipynb"}  # what is somebody's


def mention(path: Path, intake: Intake) -> None:
    """Say of a file that is no submission what is to be done about it, if anything is."""
    if path.suffix.lower() in WORK:
        name = portable(path.stem)
        intake.troubles[name] = f"{path.name} is no folder and no archive: put it into a folder"
    elif path.name not in SIDE_FILES and path.suffix.lower() != ".csv":
        intake.notes.append(f"{path.name} is no submission: left out")
