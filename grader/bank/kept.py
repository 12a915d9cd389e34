"""Store what got the marks, or was told the words, that it must, in build/verify.

Each file says what it was made from. It is ignored if any of that changed, or if it was damaged.
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

from grader.bank.halfway import Halfway
from grader.bank.members import BESIDES, Member
from grader.judge.fingerprint import fingerprint
from grader.judge.grade import KIT
from grader.judge.result import Result
from grader.report.files import write_whole

UNREAD = ("README.md", "Makefile", "requirements.txt")  # files of a tree: no mark hangs on them
DECIDING = ("halfway.py", "members.py", "traces.py", "verify.py")  # of this folder


class Record(Struct, frozen=True):
    """One member, graded."""

    key: str
    seconds: float
    result: Result


class StoredResults:
    """The results in a folder; a new version of a member replaces the older ones."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.keys: dict[Member, str] = {}

    def key(self, member: Member) -> str:
        """Return the key as it was when first asked for: files may change while it is graded."""
        if member not in self.keys:
            self.keys[member] = make_key(member)
        return self.keys[member]

    def read(self, member: Member) -> tuple[Result, float] | None:
        with suppress(OSError, ValueError, msgspec.MsgspecError):
            digest, _, content = self.file(member).read_bytes().partition(b"\n")
            if digest.decode() == hashlib.sha256(content).hexdigest():
                record = msgspec.json.decode(content, type=Record)
                if record.key == self.key(member):
                    return record.result, record.seconds
        return None

    def write(self, member: Member, result: Result, seconds: float) -> None:
        content = msgspec.json.encode(Record(self.key(member), seconds, result))
        digest = hashlib.sha256(content).hexdigest().encode()
        write_whole(digest + b"\n" + content, self.file(member))

    def file(self, member: Member) -> Path:
        return self.folder / member.kind / f"{member.name} as {member.form}.json"


class StoredStates:
    """The half-way states in a folder that were told what they must be."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "halfway"

    def holds(self, state: Halfway) -> bool:
        with suppress(OSError, ValueError):
            return self.file(state).read_text("ascii") == make_state_key(state)
        return False

    def add(self, state: Halfway) -> None:
        write_whole(make_state_key(state).encode("ascii"), self.file(state))

    def file(self, state: Halfway) -> Path:
        return self.folder / f"{state.name}.txt"


def make_state_key(state: Halfway) -> str:
    """Hash the state and all that decides about what it is told, and this machine."""
    said = msgspec.json.encode([state.name, state.code, state.state]).decode()
    return hash_lines([hash_surroundings(), said])


def make_key(member: Member) -> str:
    """Hash all that decides about the member's marks, and this machine."""
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
