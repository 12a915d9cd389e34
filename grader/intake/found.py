"""Describe a class on disk: submissions with their paths, and notes on other files."""

import hashlib
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.judge.submission import CannotGrade


class CannotTake(CannotGrade):
    """Raised for a submission that cannot be read and needs manual review."""


@dataclass(frozen=True)
class Work:
    """A submission on disk, before it is read."""

    name: str  # of its result; a file name on every platform
    sources: tuple[Path, ...]  # a folder, or what was handed in
    late: bool = False  # marked late by the LMS
    handed_in: datetime | None = None  # without a zone if the LMS writes the school's own time
    group: tuple[str, ...] = ()  # the other owners of this work
    handed_in_by: str = ""  # the one who handed in, if not this student
    taken: tuple[str, ...] = ()  # paths in it that a person chose among several

    @property
    def team(self) -> tuple[str, ...]:
        """Return an identity of the group or student who handed this in."""
        if self.group:
            return str(self.sources[0].parent), *sorted({self.name, *self.group})
        return tuple(str(each) for each in self.sources)


@dataclass
class Intake:
    found: list[Work] = field(default_factory=list)
    troubles: dict[str, str] = field(default_factory=dict)  # name -> reason why it cannot be graded
    refused: dict[str, list[Work]] = field(default_factory=dict)  # work that needs review
    notes: list[str] = field(default_factory=list)

    def refuse(self, name: str, words: str, *works: Work) -> None:
        """Mark work for manual review, where a person may choose among `works`."""
        self.troubles[name] = words
        self.refused[name] = [*self.refused.get(name, []), *works]

    def drop(self, name: str) -> None:
        """Remove all work under a name."""
        self.found = [each for each in self.found if each.name != name]
        self.troubles.pop(name, None)
        self.refused.pop(name, None)

    @property
    def works(self) -> list[Work]:
        """Return all work, including work that needs review."""
        return [*self.found, *(each for works in self.refused.values() for each in works)]

    @property
    def names(self) -> list[str]:
        """Return all students who handed in, also those whose work cannot be graded."""
        return [*(each.name for each in self.found), *self.troubles]


@dataclass(frozen=True)
class Upload:
    """A handed-in file or folder, and whose it is by its name."""

    path: Path
    name: str  # as of `Work`
    late: bool = False
    from_lms: bool = False  # an LMS wrote the name: all files of one owner belong together
    empty: bool = False  # a text or a link was handed in, and no file
    handed_in: datetime | None = None
    attempt: str = ""  # the last in order counts
    timeless: bool = False  # the order of attempts is unknown
    owner: str = ""  # the LMS's identifier: two students of one name have two


class Package(Struct, frozen=True):
    """A submission as bytes, which can travel to another machine."""

    name: str
    files: list[tuple[str, bytes]]  # sorted by path, which is relative and has forward slashes
    notes: list[str] = []

    @property
    def digest(self) -> str:
        """Return a hash of the files, without the name of their student."""
        return hashlib.sha256(msgspec.msgpack.encode(self.files)).hexdigest()

    def unpack(self, folder: Path) -> Path:
        """Write the files into a new folder named after the submission."""
        target = folder / self.name
        target.mkdir()
        for name, content in self.files:
            path = target / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        return target
