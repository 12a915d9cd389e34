"""Store the members with the expected grade, in build/verify.

A file has a hash of its sources; it is ignored once a source changes.
"""

import hashlib
import platform
import sys
from contextlib import suppress
from fnmatch import fnmatch
from functools import cache
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.bank.members import BESIDES, Member
from grader.judge.fingerprint import fingerprint
from grader.judge.result import Result
from grader.judge.task import KIT
from grader.report.files import write_whole

UNREAD = ("README.md", "Makefile", "requirements.txt")  # files of a tree that no mark depends on
DECIDING = ("halfway.py", "members.py", "traces.py", "verify.py")  # of this folder


class Record(Struct, frozen=True):
    key: str
    seconds: float
    result: Result


class Store:
    """The records in a folder; a new version of a member replaces the older ones."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.keys: dict[Path, str] = {}

    def key(self, member: Member) -> str:
        """Return the key, computed once: files may change during grading."""
        path = self.file(member)
        if path not in self.keys:
            self.keys[path] = make_key(member)
        return self.keys[path]

    def read(self, member: Member) -> Record | None:
        with suppress(OSError, msgspec.DecodeError):
            record = msgspec.json.decode(self.file(member).read_bytes(), type=Record)
            return record if record.key == self.key(member) else None
        return None

    def write(self, member: Member, seconds: float, result: Result) -> None:
        record = Record(self.key(member), seconds, result)
        write_whole(msgspec.json.encode(record), self.file(member))

    def file(self, member: Member) -> Path:
        return self.folder / member.kind / f"{member.name} as {member.form}.json"


def make_key(member: Member) -> str:
    """Hash everything that the member's marks depend on, and this machine."""
    todos, judges = member.course.rubric.todos, member.judged_by
    asked = [todo for todo in todos if not judges or todo.id in judges]
    line = [*member.lineage]
    sources = [each.source for each in line if each.source and each.source.suffix != ".toml"]
    files = [row for source in sources for row in hash_contents(source, "__pycache__")]
    entry = [member.kind, member.name, member.form, [each.entry for each in line], asked]
    return hash_lines([hash_surroundings(), msgspec.json.encode(entry).decode(), *files])


@cache
def hash_surroundings() -> str:
    """Hash the judge, its libraries and Python, both trees, and the rules of the bank."""
    rules = [line for name in DECIDING for line in hash_contents(KIT / "grader" / "bank" / name)]
    trees = (KIT / "solution", KIT / "starter", KIT / "tests" / "bank" / "single_file")
    files = [line for tree in trees for line in hash_contents(tree, *BESIDES, *UNREAD)]
    return hash_lines([fingerprint(), sys.version, platform.platform(), *rules, *files])


def hash_contents(path: Path, *left_out: str) -> list[str]:
    """Return names and hashes of a file, or of files in a folder whose names fit no pattern."""
    rows = []
    for each in [path] if path.is_file() else sorted(path.rglob("*")):
        name = each.relative_to(path.parent)
        if each.is_file() and not any(fnmatch(p, out) for p in name.parts for out in left_out):
            rows.append(f"{name.as_posix()} {hashlib.sha256(each.read_bytes()).hexdigest()}")
    return rows


def hash_lines(lines: list[str]) -> str:
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()
