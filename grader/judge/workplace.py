"""Folders for what a grade writes. They end with it, or after a crash with the next grade.

A folder belongs to a process for as long as that holds a lock on it, which no crash outlives.
"""

import os
import shutil
import stat
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows: what a crash leaves there stays until somebody clears it
    fcntl = None  # type: ignore[assignment]

PREFIX = "physics-grader-"
NEW_SECONDS = 5  # a folder as young as that may not be locked yet


@contextmanager
def work_folder() -> Iterator[Path]:
    """Make a folder of our own, removed afterwards even where a submission made parts read-only."""
    remove_leftovers(tempfile.gettempdir())
    work = Path(tempfile.mkdtemp(prefix=PREFIX)).resolve()
    lock = locked(work)
    try:
        yield work
    finally:
        remove(work)
        if lock is not None:
            os.close(lock)


@cache
def remove_leftovers(place: str) -> None:
    """Remove, once for each place, what a killed process of ours has left there."""
    if fcntl is None:
        return
    for folder in Path(place).glob(f"{PREFIX}*"):
        with suppress(OSError):
            about = folder.lstat()
            ours = stat.S_ISDIR(about.st_mode) and about.st_uid == os.getuid()
            if ours and time.time() - about.st_mtime > NEW_SECONDS:
                lock = locked(folder)
                if lock is not None:
                    remove(folder)
                    os.close(lock)


def locked(folder: Path) -> int | None:
    """Return a descriptor that holds the folder's lock; None where another process holds it."""
    if fcntl is None:
        return None
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:  # or a file system without locks
        os.close(descriptor)
        return None
    return descriptor


def remove(work: Path) -> None:
    for folder, _, _ in os.walk(work):
        with suppress(OSError):
            os.chmod(folder, stat.S_IRWXU)
    shutil.rmtree(work, ignore_errors=True)
