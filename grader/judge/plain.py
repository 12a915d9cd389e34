"""Open the files of a submission safely, even if they are replaced by links.

A name may change its target between the check and the opening. So each folder on the way is
opened inside the one before, links are refused, and the type is read from the open file. Windows
has no such calls: there a name is checked right before it is opened.
"""

import errno
import io
import os
import stat
from pathlib import Path, PurePath

NO_LINK = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_CLOEXEC", 0)
FOLDER = os.O_RDONLY | getattr(os, "O_DIRECTORY", 0)
FILE = os.O_RDONLY | NO_LINK | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
PART = 1024 * 1024  # bytes copied at once
BY_FOLDERS = os.open in os.supports_dir_fd and hasattr(os, "O_NOFOLLOW")


def open_plain(folder: Path, inside: PurePath | str) -> io.BufferedReader:
    """Open a file by its path inside a folder; raises OSError for a link, pipe or folder.

    The folder itself is trusted, and may be a link.
    """
    path = folder / inside
    try:
        number = (
            open_by_folders(folder, PurePath(inside).parts) if BY_FOLDERS else look_and_open(path)
        )
    except OSError as error:
        raise type(error)(error.errno, error.strerror, str(path)) from error
    if not stat.S_ISREG(os.fstat(number).st_mode):
        os.close(number)
        raise OSError(errno.EINVAL, "no file to read, but a pipe, a device or a folder", str(path))
    return os.fdopen(number, "rb")


def open_by_folders(folder: Path, parts: tuple[str, ...]) -> int:
    """Return a descriptor of a file below a folder; raises OSError for a link on the way."""
    here = os.open(folder, FOLDER)
    try:
        for part in parts[:-1]:
            inner = os.open(part, FOLDER | NO_LINK, dir_fd=here)
            os.close(here)
            here = inner
        return os.open(parts[-1], FILE, dir_fd=here)
    finally:
        os.close(here)


def look_and_open(path: Path) -> int:
    if os.path.islink(path):
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    return os.open(path, FILE)


def size_of(file: io.BufferedReader) -> int:
    """Return the length in bytes of a file that is open."""
    return os.fstat(file.fileno()).st_size


def read_plain(folder: Path, inside: PurePath | str, most: int = -1) -> bytes:
    """Return the content of a file inside a folder, or its first `most` bytes."""
    with open_plain(folder, inside) as file:
        return file.read(most)


def copy_plain(file: io.BufferedReader, target: Path, length: int) -> None:
    """Copy this many bytes of an open file, even if it grows meanwhile."""
    with open(target, "wb") as out:
        while part := file.read(min(length, PART)):
            out.write(part)
            length -= len(part)
