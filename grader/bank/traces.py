"""Find what a grade leaves behind on the machine: processes, open descriptors, files.

Other programs write files meanwhile, also into the home folder and shared memory, and a look at a
folder cannot tell them apart. So only what is certainly of the grade counts:

- all in a folder that is its temporary and its home folder while it runs;
- what the judge's own process makes elsewhere: Python reports each file;
- what has the submission's name in its own where every account may write. A submission of the bank
  that tries to leave a file there names it after itself.
"""

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import psutil

from grader.judge.drawing import CACHE
from grader.judge.passed import PASSED

OWN_FOLDER = ("HOME", "USERPROFILE", "TMPDIR", "TEMP", "TMP")
OPEN_TO_ALL = ("/dev/shm", "/tmp", "/var/tmp")
MAKES = {"open": 0, "os.mkdir": 0, "os.link": 1, "os.rename": 1, "os.symlink": 1}  # which argument
JUDGES = {CACHE, PASSED.folder}  # the judge keeps these, whatever it grades
LISTENERS: list[set[Path]] = []  # each is told of what this process makes


@dataclass
class Traces:
    """Filled in once the grade is over."""

    left: list[str] = field(default_factory=list)

    @property
    def complaint(self) -> str:
        return f"left behind: {', '.join(self.left)}" if self.left else ""


@contextmanager
def watch_traces(own: Path, name: str) -> Iterator[Traces]:
    """Let the grade use the folder `own`, and find what it leaves there and elsewhere.

    With a `name`, files that have it in their names are looked for as well.
    """
    own.mkdir()
    traces = Traces()
    shared = [Path.home(), *map(Path, OPEN_TO_ALL)]
    files, processes = find_named(name, shared), list_descendants()
    descriptors = count_descriptors()
    with redirect_home(own), note_new_files() as made:
        yield traces
    left = {*own.rglob("*"), *made} | {path for path, _ in find_named(name, shared) - files}
    left = {path for path in left if path != CACHE.parent and not is_judges(path)}
    kept = sorted(path for path in left if os.path.lexists(path))
    traces.left += [f"the file {path}" for path in kept[:3]]
    for process in list_descendants() - processes:
        with suppress(psutil.NoSuchProcess):
            traces.left.append(f"the process {process.name()}")
    if (more := count_descriptors() - descriptors) > 0:
        traces.left.append(f"{more} open files or sockets")


def is_judges(path: Path) -> bool:
    return not JUDGES.isdisjoint([path, *path.parents])


@contextmanager
def redirect_home(folder: Path) -> Iterator[None]:
    """Make `folder` the temporary and home folder of this process and those it starts."""
    usual, names = tempfile.tempdir, {name: os.environ.get(name) for name in OWN_FOLDER}
    tempfile.tempdir = str(folder)
    os.environ.update(dict.fromkeys(OWN_FOLDER, str(folder)))
    try:
        yield
    finally:
        tempfile.tempdir = usual
        for name, value in names.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextmanager
def note_new_files() -> Iterator[set[Path]]:
    """Note the files and folders that this process makes, except Python's bytecode."""
    listen_to_audits()
    made: set[Path] = set()
    LISTENERS.append(made)
    try:
        yield made
    finally:
        LISTENERS.pop()


@cache
def listen_to_audits() -> None:
    """Listen once and for good: an audit hook cannot be removed."""
    sys.addaudithook(note_file)


def note_file(event: str, arguments: tuple[Any, ...]) -> None:
    if not LISTENERS or event not in MAKES:
        return
    name = arguments[MAKES[event]]
    if isinstance(name, int) or (event == "open" and not arguments[2] & os.O_CREAT):
        return
    path = Path(os.path.abspath(os.fsdecode(name)))
    if "__pycache__" not in path.parts and not os.path.lexists(path):
        LISTENERS[-1].add(path)


def find_named(name: str, folders: list[Path]) -> set[tuple[Path, int]]:
    """Return what has this name in the folders, each with the time of its last change."""
    found = set()
    for folder in folders if name else ():
        with suppress(OSError):
            for entry in os.scandir(folder):
                if name in entry.name:
                    with suppress(FileNotFoundError):
                        found.add((Path(entry.path), entry.stat(follow_symlinks=False).st_mtime_ns))
    return found


def list_descendants() -> set[psutil.Process]:
    return set(psutil.Process().children(recursive=True))


def count_descriptors() -> int:
    me = psutil.Process()
    return me.num_fds() if hasattr(me, "num_fds") else 0  # Windows has no such number
