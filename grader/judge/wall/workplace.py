"""Make folders for the files of a grade, and remove them: after a crash, with the next grade.

A process owns a folder as long as it holds a lock on it, which ends with the process.
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
except ImportError:  # Windows: the files of a crash stay until a user removes them
    fcntl = None  # type: ignore[assignment]

PREFIX = "physics-grader-"
NEW_SECONDS = 5  # a younger folder may not be locked yet


@contextmanager
def work_folder() -> Iterator[Path]:
    """Make a folder, and remove it afterwards even if a submission made parts read-only."""
    remove_leftovers(tempfile.gettempdir())
    work = Path(tempfile.mkdtemp(prefix=PREFIX)).resolve()
    lock = lock_folder(work)
    try:
        yield work
    finally:
        remove(work)
        if lock is not None:
            os.close(lock)


@cache
def remove_leftovers(place: str) -> None:
    """Remove from `place` the folders of killed processes, once."""
    if fcntl is None:
        return
    for folder in Path(place).glob(f"{PREFIX}*"):
        with suppress(OSError):
            about = folder.lstat()
            ours = stat.S_ISDIR(about.st_mode) and about.st_uid == os.getuid()
            if ours and time.time() - about.st_mtime > NEW_SECONDS:
                lock = lock_folder(folder)
                if lock is not None:
                    remove(folder)
                    os.close(lock)


def lock_folder(folder: Path) -> int | None:
    """Return a descriptor that holds the folder's lock; None if another process holds it."""
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
