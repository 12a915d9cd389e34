"""What a grade leaves behind on the machine: processes, open descriptors, files. Nothing, it must.

Files count in the temporary folder of the grade, the home folder and shared memory: elsewhere an
instructor's account may not write, or the kit itself is.
"""

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

import psutil


@dataclass
class Traces:
    """Filled in once the grade is over."""

    left: list[str] = field(default_factory=list)

    @property
    def complaint(self) -> str:
        return f"left behind: {', '.join(self.left)}" if self.left else ""


@contextmanager
def watched(temporary: Path) -> Iterator[Traces]:
    """Let what runs inside use `temporary`, and see what it leaves there and elsewhere."""
    temporary.mkdir()
    traces, usual = Traces(), tempfile.tempdir
    files, processes, descriptors = listed(), descendants(), open_descriptors()
    tempfile.tempdir = str(temporary)
    try:
        yield traces
    finally:
        tempfile.tempdir = usual
    traces.left += [f"the file {path}" for path in sorted(temporary.rglob("*"))[:3]]
    traces.left += [f"the file {path}" for path in sorted(listed() - files)[:3]]
    for process in descendants() - processes:
        with suppress(psutil.NoSuchProcess):
            traces.left.append(f"the process {process.name()}")
    if (more := open_descriptors() - descriptors) > 0:
        traces.left.append(f"{more} open files or sockets")


def listed() -> set[str]:
    folders = [Path.home(), Path("/dev/shm")]
    names = {str(path) for folder in folders if folder.is_dir() for path in folder.iterdir()}
    return {name for name in names if "/dev/shm/sem." not in name}  # of Python's own process pools


def descendants() -> set[psutil.Process]:
    return set(psutil.Process().children(recursive=True))


def open_descriptors() -> int:
    me = psutil.Process()
    return me.num_fds() if hasattr(me, "num_fds") else 0  # Windows has no such number
