"""Keep slow recordings and proofs in build/recorded until their sources change.

A recording's key is a hash of everything that it was made from.
"""

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import msgspec

from grader.bank.members import list_members
from grader.bank.store import hash_contents, hash_lines, hash_surroundings, make_key
from grader.judge.course import Course
from grader.judge.task import KIT
from grader.report.files import write_whole

FOLDER = KIT / "build" / "recorded"
RECORDING = (
    "bank",
    "player",
    "questions",
    "release",
)  # packages of the grader that a recording depends on

Record = Callable[[str, Callable[[], bytes]], bytes]  # by the name of the recording


def record_anew(what: str, make: Callable[[], bytes]) -> bytes:
    """Make a recording and keep nothing."""
    return make()


class Recordings:
    """Keep the recordings of a course's release; make all of them again if `fresh`."""

    def __init__(self, course: Course, folder: Path = FOLDER, fresh: bool = False) -> None:
        self.folder, self.key, self.fresh = folder, make_record_key(course), fresh

    def __call__(self, what: str, make: Callable[[], bytes]) -> bytes:
        """Return the recording of this name, or make it now."""
        path = self.folder / f"{what}-{self.key}"
        if not self.fresh:
            with suppress(FileNotFoundError):
                return path.read_bytes()
        content = make()
        write_whole(content, path)
        return content


def make_record_key(course: Course) -> str:
    """Hash the code, the course, the wrong members, the libraries and this machine."""
    rooms = [KIT / "grader" / room for room in RECORDING]
    code = [row for room in rooms for row in hash_contents(room, "__pycache__")]
    asked = msgspec.json.encode([course, course.rubric]).decode()
    wrong = [make_key(member) for member in list_members(course) if member.kind == "wrong"]
    return hash_lines([hash_surroundings(), asked, *code, *wrong])
