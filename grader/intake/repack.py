"""Make a plain zip of a .tar, .7z or .rar, so that the same rules apply to all archives.

It runs in a process with limits on memory, time and disk, confined like a child: only here do the
libraries for these formats read untrusted bytes. It prints the names of files that are too large, a
line each, or the reason why there is no zip.
"""

import importlib
import io
import os
import sys
import tarfile
import tempfile
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from grader.errors import say_error
from grader.protocol import MAX_UPLOAD

try:
    import resource
except ImportError:  # Windows: the time that the parent waits is the only limit
    resource = None  # type: ignore[assignment]

MAX_UNPACKED = 200 * 1024**2  # of one archive, unpacked
MAX_MEMBERS = 200_000
MEMORY = 768 * 1024**2  # bytes
SECONDS = 12  # of processor time
PEEK = 8  # bytes that identify a format
RAR = b"Rar!\x1a\x07"
REFUSED = 3  # exit status: it printed a sentence for people

Files = Iterator[tuple[str, bytes | None]]  # None: too large


class CannotRepack(Exception):
    """Raised for an archive that cannot be unpacked, with the reason."""


def main(source: str, target: str, seconds: int = SECONDS) -> int:
    set_limits(seconds)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(encoding="utf-8", errors="replace")
    try:
        with zipfile.ZipFile(target, "w") as out:
            size = 0
            for count, (name, content) in enumerate(read_files(source)):
                if content is None:
                    say(name)
                    continue
                size += len(content)
                if count >= MAX_MEMBERS or size > MAX_UNPACKED:
                    raise CannotRepack("the archive holds too much: the program alone is needed")
                out.writestr(zipfile.ZipInfo(name), content)
    except CannotRepack as refusal:
        words = str(refusal)
    except MemoryError:
        words = "the archive takes too much memory to unpack"
    except Exception as error:  # each library has many kinds
        words = f"the archive is broken ({type(error).__name__}: {say_error(error):.100})"
    else:
        return 0
    say(words)
    return REFUSED


def say(words: str) -> None:
    """Print words on one line: the caller reads line by line."""
    print(" ".join(words.split())[:300])


def shut_in(source: str, folder: str) -> None:
    """Confine this process to the archive, the zip, its libraries, and the unpackers of a .rar.

    A machine that lacks some layers continues without them.
    """
    from grader.worker.confinement import shut_in_reader  # here: the judge imports this file, too

    tempfile.tempdir = os.environ["TMPDIR"] = folder
    with open(source, "rb") as file:
        unpacked_by_others = file.read(len(RAR)) == RAR
    shut_in_reader(source, folder, os.get_exec_path() if unpacked_by_others else ())


def set_limits(seconds: int) -> None:
    if resource is not None:
        wanted = (
            (resource.RLIMIT_AS, MEMORY),
            (resource.RLIMIT_CPU, seconds),
            (resource.RLIMIT_FSIZE, 2 * MAX_UNPACKED),
        )
        for kind, most in wanted:
            hard = resource.getrlimit(kind)[1]
            most = most if hard == resource.RLIM_INFINITY else min(most, hard)
            try:
                resource.setrlimit(kind, (most, hard))
            except (ValueError, OSError):  # macOS has no limit of this kind on memory
                continue


def read_files(source: str) -> Files:
    """Return the files in an archive, without the contents of files that are too large."""
    with open(source, "rb") as file:
        head = file.read(PEEK)
    if head.startswith(b"7z\xbc\xaf\x27\x1c"):
        return read_7z(source)
    if head.startswith(RAR):
        return read_rar(source)
    return read_tar(source)


def read_tar(source: str) -> Files:
    if not tarfile.is_tarfile(source):
        raise CannotRepack(
            "the archive is broken, or of no kind that is read here: a zip is needed"
        )
    with tarfile.open(source) as archive:
        for member in archive:
            if member.isreg() and member.size > MAX_UPLOAD:
                yield member.name, None
            elif member.isreg() and (content := archive.extractfile(member)) is not None:
                yield member.name, content.read()


def read_7z(source: str) -> Files:
    py7zr = load_library("py7zr", ".7z")
    try:
        with py7zr.SevenZipFile(source) as archive:
            plain = [each for each in archive.list() if each.is_file and not each.is_symlink]
            for each in plain:
                if each.uncompressed > MAX_UPLOAD:
                    yield each.filename, None
            wanted = {e.filename: e.uncompressed for e in plain if e.uncompressed <= MAX_UPLOAD}
            if sum(wanted.values()) > MAX_UNPACKED or len(wanted) > MAX_MEMBERS:
                raise CannotRepack("the archive holds too much: the program alone is needed")
            factory = py7zr.io.BytesIOFactory(MAX_UPLOAD + 1)
            archive.extract(targets=list(wanted), factory=factory)
    except py7zr.exceptions.PasswordRequired as error:
        raise CannotRepack("the archive is encrypted: one without a password is needed") from error
    except py7zr.exceptions.AbsolutePathError as error:
        raise CannotRepack(f"the archive reaches outside its folder ({error!s:.100})") from error
    for name, content in factory.products.items():
        content.seek(0)
        yield name, content.read()


def read_rar(source: str) -> Files:
    rarfile = load_library("rarfile", ".rar")
    try:
        with rarfile.RarFile(source, errors="strict") as archive:
            if archive.needs_password():
                raise CannotRepack("the archive is encrypted: one without a password is needed")
            for each in archive.infolist():
                if each.is_file() and not each.file_redir:
                    too_large = each.file_size > MAX_UPLOAD
                    yield each.filename, None if too_large else archive.read(each)
    except rarfile.RarCannotExec as error:
        raise CannotRepack(
            "this machine has nothing that unpacks a .rar: install one of unrar, unar and 7z; "
            "without it, a zip is needed"
        ) from error
    except rarfile.Error as error:
        raise CannotRepack(
            "the archive is broken, one part of several, or cannot be unpacked here: "
            "a zip is needed"
        ) from error


def load_library(name: str, format: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise CannotRepack(
            f"a {format} needs {name}, which is not installed: {sys.executable} -m pip install "
            f"{name}; without it, a zip is needed"
        ) from error


if __name__ == "__main__":
    shut_in(sys.argv[1], str(Path(sys.argv[2]).parent))
    sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3])))
