"""Find leftovers of a grade on the machine: processes, open descriptors, files.

Other programs write files meanwhile, also into the home folder and shared memory. So only files
that are certainly of the grade count:

- all in the folder that the grade uses as temporary and home folder;
- files in folders open to every account, if named after the submission. Submissions of the bank
  that try to leave a file there name it after themselves.
"""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

import psutil

OWN_FOLDER = ("HOME", "USERPROFILE", "TMPDIR", "TEMP", "TMP")
OPEN_TO_ALL = ("/dev/shm", "/tmp", "/var/tmp")


@dataclass
class Traces:
    """Leftovers, filled in once the grade is over."""

    leftovers: list[str] = field(default_factory=list)

    @property
    def complaint(self) -> str:
        return f"left behind: {', '.join(self.leftovers)}" if self.leftovers else ""


@contextmanager
def watch_traces(own: Path, name: str) -> Iterator[Traces]:
    """Let a grade use the folder `own`; find its leftovers in there and elsewhere.

    With a `name`, also look for files that have it in their names.
    """
    own.mkdir()
    traces = Traces()
    shared = [Path.home(), *map(Path, OPEN_TO_ALL)]
    files, processes = find_named(name, shared), list_descendants()
    descriptors = count_descriptors()
    with redirect_home(own):
        yield traces
    left = {*own.rglob("*")} | {path for path, _ in find_named(name, shared) - files}
    traces.leftovers += [f"the file {path}" for path in sorted(left)[:3]]
    for process in list_descendants() - processes:
        with suppress(psutil.NoSuchProcess):
            traces.leftovers.append(f"the process {process.name()}")
    if (more := count_descriptors() - descriptors) > 0:
        traces.leftovers.append(f"{more} open files or sockets")


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


def find_named(name: str, folders: list[Path]) -> set[tuple[Path, int]]:
    """Return the files of this name in the folders, each with its last change."""
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
