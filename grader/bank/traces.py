"""What a grade leaves behind on the machine: processes, open descriptors, files. Nothing, it must.

Other programs write files meanwhile, also into the home folder and shared memory. None of them can
be told by a look at a folder, so only what is the grade's for sure counts:

- all in a folder that is its temporary and its home folder while it runs;
- what this very process, the judge's, makes elsewhere: Python tells it of each file;
- what bears the submission's name where every account may write. A submission of the bank that
  tries to leave a file there names it after itself.
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

OWN_FOLDER = ("HOME", "USERPROFILE", "TMPDIR", "TEMP", "TMP")
OPEN_TO_ALL = ("/dev/shm", "/tmp", "/var/tmp")
MAKES = {"open": 0, "os.mkdir": 0, "os.link": 1, "os.rename": 1, "os.symlink": 1}  # which argument
LISTENERS: list[set[Path]] = []  # each is told of what this process makes


@dataclass
class Traces:
    """Filled in once the grade is over."""

    left: list[str] = field(default_factory=list)

    @property
    def complaint(self) -> str:
        return f"left behind: {', '.join(self.left)}" if self.left else ""


@contextmanager
def watched(own: Path, name: str) -> Iterator[Traces]:
    """Let what runs inside use the folder `own`, and see what it leaves there and elsewhere.

    With a `name`, files that bear it are looked for as well.
    """
    own.mkdir()
    traces = Traces()
    shared = [Path.home(), *map(Path, OPEN_TO_ALL)]
    files, processes, descriptors = named(name, shared), descendants(), open_descriptors()
    with at_home_in(own), noted() as made:
        yield traces
    left = {*own.rglob("*"), *made} | {path for path, _ in named(name, shared) - files}
    left = {path for path in left if CACHE not in (path, *path.parents)}  # the judge's own
    kept = sorted(path for path in left if os.path.lexists(path))
    traces.left += [f"the file {path}" for path in kept[:3]]
    for process in descendants() - processes:
        with suppress(psutil.NoSuchProcess):
            traces.left.append(f"the process {process.name()}")
    if (more := open_descriptors() - descriptors) > 0:
        traces.left.append(f"{more} open files or sockets")


@contextmanager
def at_home_in(folder: Path) -> Iterator[None]:
    """This process and those it starts take `folder` for their temporary and home folder."""
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
def noted() -> Iterator[set[Path]]:
    """The files and folders that this process makes meanwhile, except Python's bytecode."""
    listen()
    made: set[Path] = set()
    LISTENERS.append(made)
    try:
        yield made
    finally:
        LISTENERS.pop()


@cache
def listen() -> None:
    """Once and for good: there is no way to take an audit hook back."""
    sys.addaudithook(note)


def note(event: str, arguments: tuple[Any, ...]) -> None:
    if not LISTENERS or event not in MAKES:
        return
    name = arguments[MAKES[event]]
    if isinstance(name, int) or (event == "open" and not arguments[2] & os.O_CREAT):
        return
    path = Path(os.path.abspath(os.fsdecode(name)))
    if "__pycache__" not in path.parts and not os.path.lexists(path):
        LISTENERS[-1].add(path)


def named(name: str, folders: list[Path]) -> set[tuple[Path, int]]:
    """What bears this name in the folders, each with the time of its last change."""
    found = set()
    for folder in folders if name else ():
        with suppress(OSError):
            for entry in os.scandir(folder):
                if name in entry.name:
                    with suppress(FileNotFoundError):
                        found.add((Path(entry.path), entry.stat(follow_symlinks=False).st_mtime_ns))
    return found


def descendants() -> set[psutil.Process]:
    return set(psutil.Process().children(recursive=True))


def open_descriptors() -> int:
    me = psutil.Process()
    return me.num_fds() if hasattr(me, "num_fds") else 0  # Windows has no such number
