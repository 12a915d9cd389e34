"""What a result depends on, as one hash: as long as it stays, nothing is graded again.

The rule: a file of the grader counts if it can decide about points. These are the checks, the judge
that weighs their answers, the worker that runs the submission, and what these three share. Who asks
for a grade, and how a result is shown, played or kept, decides nothing.
"""

import hashlib
import sys
from collections.abc import Iterator
from functools import cache
from importlib.metadata import version
from pathlib import Path

import msgspec

import grader
from grader.classroom.intake.found import Package
from grader.judge.grade import Options
from grader.judge.rubric import load_rubric
from grader.judge.submission import module_of
from grader.todo_regions import python_files

DECIDING = ("checks", "judge", "worker", "protocol.py", "todo_regions.py")  # of the folder grader
READ = (".py", ".toml", ".json", ".ini")  # by Python and by the checks
LIBRARIES = ("hypothesis", "msgspec", "pygame-ce", "pymunk", "pytest")


@cache
def fingerprint() -> str:
    """The hash of the grader itself and of the libraries that decide about points."""
    top = Path(grader.__file__).parent
    digest = hashlib.sha256()
    for path in deciding_files(top):
        digest.update(f"{path.relative_to(top).as_posix()}\0".encode() + path.read_bytes() + b"\0")
    releases = [f"{name} {version(name)}" for name in LIBRARIES]
    digest.update(f"{sys.version_info[:2]} {releases}".encode())
    return digest.hexdigest()


def deciding_files(top: Path) -> Iterator[Path]:
    """The files of the grader in `top` that count, in a fixed order."""
    for path in sorted(top.rglob("*")):
        if path.suffix in READ and path.relative_to(top).parts[0] in DECIDING:
            yield path


def key_of(options: Options) -> str:
    """The hash of all that a result depends on, the submission aside."""
    reference = packed_reference(options.reference)
    digest = reference.digest if reference else ""
    asked = options.course.rubric
    decides = [sorted(options.only), options.seed, options.isolation, options.spawn, asked]
    return hashlib.sha256(msgspec.json.encode([fingerprint(), digest, decides])).hexdigest()


def packed_reference(folder: Path | None) -> Package | None:
    """Of the reference, the programs that the rubric names."""
    if folder is None:
        return None
    modules = {todo.module for todo in load_rubric().todos}
    files = [
        (path.relative_to(folder).as_posix(), path.read_bytes())
        for path in python_files(folder)
        if module_of(path.relative_to(folder)) in modules
    ]
    return Package("reference", sorted(files))
