"""Unpack untrusted archives: within limits, inside one folder, with a sentence for each error.

`repack` first makes a zip of any other archive, in a process of its own.
"""

import io
import math
import re
import shutil
import stat
import subprocess
import unicodedata
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path, PurePosixPath

from grader.errors import say_error
from grader.intake import repack
from grader.intake.found import CannotTake
from grader.intake.names import fold, make_portable
from grader.intake.pieces import rank_file
from grader.intake.places import SIGNS, is_system_file
from grader.judge.submission import IGNORED, MAX_DEPTH, MAX_FILES
from grader.judge.wall.children import reaped_seconds
from grader.judge.wall.starting import command
from grader.judge.wall.workplace import work_folder
from grader.protocol import MAX_UPLOAD
from grader.text import plural

# Of one submission, over all of its archives: many small ones cost no more than a large one.
MAX_ARCHIVES = 100
MAX_ZIP = 200 * 1024**2  # bytes: a virtual environment fits
MAX_DIRECTORY = 16 * 1024**2  # bytes of the lists of files in zips: about 200,000 of them
MAX_SECONDS = repack.SECONDS  # of processor time, for archives that are no zip
MAX_CLASS = 20 * MAX_DIRECTORY  # the same, of the zip of a class
LONGEST_PATH, SHORT = 2000, 30  # bytes of a path in the zip of a class, and of a folder that is cut
DRIVE = re.compile(r"[A-Za-z]:")  # with which a name on Windows begins
SPARED = 100  # files of the allowance for the lab's own alone
OWN_WAY = "the zip is packed in an unusual way: one as desktops make it is needed"
CLOCK_PER_CPU = 4  # s on the clock for each of processor time: the last resort


@dataclass
class Bounds:
    """The remaining limits of a submission with all its archives."""

    files: int = MAX_FILES
    bytes: int = MAX_UPLOAD
    archives: int = field(default_factory=lambda: MAX_ARCHIVES)
    packed: int = field(default_factory=lambda: MAX_ZIP)  # bytes, of archives
    listed: int = field(default_factory=lambda: MAX_DIRECTORY)  # bytes, of lists of files in zips
    seconds: float = field(default_factory=lambda: MAX_SECONDS)
    left_out: list[str] = field(default_factory=list)

    def take(self, name: str, length: int, spared: int = 0) -> bool:
        """Count a file if it fits and leaves room for `spared` others."""
        if self.files <= spared or length > self.bytes:
            self.left_out.append(name)
            return False
        self.files, self.bytes = self.files - 1, self.bytes - length
        return True

    def take_archive(self, length: int) -> None:
        """Count a handed-in archive as a file; raises CannotTake if it is too large."""
        if length > self.packed:
            most = f"the maximum for a submission is {MAX_ZIP >> 20} MB"
            raise CannotTake(f"the archive has {length >> 20} MB: {most}")
        self.packed -= length

    def open_one(self) -> None:
        """Count an archive; raises CannotTake if there are too many."""
        if self.archives < 1:
            raise CannotTake(f"more than {MAX_ARCHIVES} archives in one submission: one is needed")
        self.archives -= 1

    @property
    def notes(self) -> list[str]:
        """Return a note on the files that did not fit, if there are any."""
        if not self.left_out:
            return []
        first, *others = self.left_out
        more = f" and {plural(len(others), 'more file')}" if others else ""
        return [f"skipped {first}{more}: size limit reached"]


def unzip(path: Path, folder: Path, bounds: Bounds) -> None:
    """Unpack the possible parts of a submission within the bounds, the lab's files first."""
    bounds.open_one()
    with open_archive(path, bounds) as (archive, too_large):
        bounds.left_out += too_large
        members = name_members(archive)
        if not members:
            raise CannotTake("the archive holds no file: it is empty or cut off")
        environments = {name.parent for name, _ in members if name.name == "pyvenv.cfg"}
        folder.mkdir(parents=True, exist_ok=True)
        wanted = (
            (name, member)
            for name, member in members
            if not any(part in IGNORED or is_system_file(part) for part in name.parts)
            and environments.isdisjoint(name.parents)
        )
        for name, member in sorted(wanted, key=lambda each: rank_file(each[0])):
            spared = SPARED if rank_file(name)[0] else 0
            if bounds.take(name.as_posix(), member.file_size, spared):
                write_member(archive, member, folder / name)


def unzip_class(path: Path, folder: Path) -> None:
    """Unpack the download of a whole class; the submissions in it are read later."""
    with open_archive(path, Bounds(listed=MAX_CLASS)) as (archive, too_large):
        if too_large:
            raise CannotTake(f"{too_large[0]} is too large: unpack it, and name the folder instead")
        for number, member in enumerate(list_members(archive)):
            parts = [part for part in decode_name(member).split("/") if part]
            if not any(is_system_file(part) for part in parts):
                write_member(archive, member, find_place(folder, parts, number))


def find_place(folder: Path, parts: list[str], number: int) -> Path:
    """Return a free path for a file of a class.

    A file `a*` and a folder `a_` would get the same name: one gets `number`. If a path is too
    long for a system, all names but the student's are cut.
    """
    path, names = folder, [*map(make_portable, parts)]
    if len("/".join(names).encode()) > LONGEST_PATH:
        cut = (each.encode()[:SHORT].decode("utf-8", "ignore") for each in names[1:])
        names[1:] = islice(cut, MAX_DEPTH + 2)  # a path that is too deep stays so, and is refused
    for left, part in enumerate(names, 1 - len(names)):
        path /= part
        if path.is_file() if left else path.is_dir():
            path = path.with_name(f"{part} ({number})")
    return path


@contextmanager
def open_archive(path: Path, bounds: Bounds) -> Iterator[tuple[zipfile.ZipFile, list[str]]]:
    """Open an archive of any known kind, and list its files that are too large."""
    with open(path, "rb") as file:
        sign = file.read(8)
    if not sign:
        raise CannotTake("the archive is broken: it has no bytes")
    if sign.startswith(b"PK\x03\x04") or (
        path.suffix.lower() == ".zip" and not sign.startswith(SIGNS)
    ):
        with open_zip(path, bounds) as archive:
            yield archive, []
        return
    with work_folder() as work:
        too_large = repack_as_zip(path, work / "plain.zip", bounds)
        with open_zip(work / "plain.zip", bounds) as archive:
            yield archive, too_large


def repack_as_zip(path: Path, target: Path, bounds: Bounds) -> list[str]:
    """Make a zip in a process with limits; return the names of files that are too large."""
    if bounds.seconds <= 0:
        raise CannotTake("the archives of the submission take too long to unpack")
    seconds, began = math.ceil(bounds.seconds), reaped_seconds()
    script = command("grader.intake.repack", str(path.resolve()), str(target), str(seconds))
    try:
        done = subprocess.run(
            script,
            capture_output=True,
            encoding="utf-8",
            errors="replace",
            timeout=CLOCK_PER_CPU * seconds,
        )
    except subprocess.TimeoutExpired as error:
        raise CannotTake("the archive takes too long to unpack") from error
    finally:
        bounds.seconds -= reaped_seconds() - began
    if done.returncode == repack.REFUSED:
        raise CannotTake(done.stdout.strip().splitlines()[-1])
    if done.returncode:
        raise CannotTake("the archive takes too much memory or time to unpack")
    return done.stdout.splitlines()


@contextmanager
def open_zip(path: Path, bounds: Bounds) -> Iterator[zipfile.ZipFile]:
    """Open a zip; raises CannotTake with a sentence for any error."""
    try:
        with ZipReader(path, bounds.listed) as file, zipfile.ZipFile(file) as archive:
            bounds.listed -= file.taken
            yield archive
    except CannotTake:
        raise
    except NotImplementedError as error:
        raise CannotTake(f"{OWN_WAY} ({error})") from error
    except RuntimeError as error:
        raise CannotTake("the zip is encrypted: one without a password is needed") from error
    except Exception as error:  # zipfile and zlib raise many kinds
        cut = path.suffix.lower() == ".zip" and not zipfile.is_zipfile(path)
        why = ": it is cut off, or no zip" if cut else ""
        raise CannotTake(
            f"the zip is broken{why} ({type(error).__name__}: {say_error(error):.100})"
        ) from error


class ZipReader(io.BufferedReader):
    """A file for `zipfile` that limits the size of one read.

    This limits the list of files too, since `zipfile` reads that list at once.
    """

    def __init__(self, path: Path, most: int) -> None:
        super().__init__(io.FileIO(path))
        self.most = most  # bytes
        self.taken = 0  # bytes so far

    def read(self, size: int | None = -1, /) -> bytes:
        rest = size is None or size < 0
        content = super().read(self.most + 1 if rest else min(size or 0, self.most + 1))
        if len(content) > self.most:
            raise CannotTake("the zip lists too many files: the program alone is needed")
        self.taken += len(content)
        return content


def list_members(archive: zipfile.ZipFile) -> Iterator[zipfile.ZipInfo]:
    for member in archive.infolist():
        if not member.is_dir() and stat.S_IFMT(member.external_attr >> 16) in (0, stat.S_IFREG):
            yield member


def name_members(archive: zipfile.ZipFile) -> list[tuple[PurePosixPath, zipfile.ZipInfo]]:
    """Return files with their names; raises CannotTake if different files share one."""
    found: dict[str, tuple[PurePosixPath, zipfile.ZipInfo]] = {}
    for member in list_members(archive):
        name = PurePosixPath(check_name(decode_name(member)))
        other, first = found.get(fold(name.as_posix()), (name, member))
        if other != name:
            raise CannotTake(f"{other} and {name} differ in case alone: other names are needed")
        if (first.CRC, first.file_size) != (member.CRC, member.file_size):
            raise CannotTake(f"the archive holds two different files {name}: one of them is needed")
        found[fold(name.as_posix())] = name, member
    return list(found.values())


def decode_name(member: zipfile.ZipInfo) -> str:
    """Return a member's name, decoded as UTF-8 if possible, or else from DOS letters."""
    name = member.filename
    if not member.flag_bits & 0x800:
        with suppress(UnicodeError):
            name = name.encode("cp437").decode("utf-8")
    return unicodedata.normalize("NFC", name.replace("\\", "/"))


def check_name(name: str) -> str:
    """Return a name that every system accepts; raise CannotTake if it leaves its folder."""
    parts = [part for part in name.split("/") if part not in ("", ".")]
    if len(parts) > MAX_DEPTH:
        raise CannotTake(f"the archive has more than {MAX_DEPTH} folders in each other")
    if name.startswith("/") or ".." in parts or DRIVE.match(name):
        raise CannotTake(f"the archive reaches outside its folder, with {name[:100]!r}")
    return "/".join(part if is_system_file(part) else make_portable(part) for part in parts)


def write_member(archive: zipfile.ZipFile, member: zipfile.ZipInfo, path: Path) -> None:
    """Unpack one file, up to the size that the zip gives.

    With other compression methods, `zipfile` may need more memory than the file has bytes.
    """
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise CannotTake(OWN_WAY)
    path.parent.mkdir(parents=True, exist_ok=True)
    with archive.open(member) as source, open(path, "wb") as target:
        shutil.copyfileobj(source, target)
