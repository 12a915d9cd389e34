"""Reading one submission: the program in it is found, zips are unpacked, and it is packed."""

import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from grader.classroom.intake import canvas, moodle
from grader.classroom.intake.found import CannotTake, Found, Package
from grader.classroom.intake.places import (
    DEEPEST,
    ManyPrograms,
    holds_program,
    is_zip,
    python_first,
    root_of,
)
from grader.classroom.intake.zips import Bounds, check_size, unzip
from grader.classroom.names import portable
from grader.judge.submission import CannotGrade, plain_files
from grader.judge.workplace import work_folder

COPY = re.compile(r"-\d+(?=\.py$)")  # what an LMS adds to the name of a file that comes again


@contextmanager
def opened_submission(path: Path) -> Iterator[Path]:
    """The submission at `path`; what a zip holds is there, in a folder of its name, until the end.

    Raises CannotGrade where a zip cannot be taken.
    """
    if not is_zip(path) or not path.is_file():
        yield path
        return
    with work_folder() as temporary:
        try:
            package = pack(Found(portable(path.stem), (path,)))
        except ManyPrograms as error:
            raise CannotGrade(f"{path}: {error}, or grade each of them with --class") from error
        except CannotTake as error:
            raise CannotGrade(f"{path}: {error}") from error
        yield package.unpack(temporary)


def pack(found: Found) -> Package:
    """Read what may be taken of a submission, wherever in it the program lies."""
    bounds, files = Bounds(), []
    try:
        with laid_out(found) as (root, left_out):
            for path in python_first(plain_files(root)):
                name = path.relative_to(root).as_posix()
                if bounds.take(name, path.stat().st_size):
                    files.append((name, path.read_bytes()))
    except OSError as error:
        raise CannotTake(f"it cannot be read: {error}") from error
    return Package(found.name, sorted(files), [*left_out, *bounds.left_out])


@contextmanager
def laid_out(found: Found) -> Iterator[tuple[Path, list[str]]]:
    """The folder that holds the program, zips unpacked, and what had to be left out."""
    folder = found.sources[0]
    if len(found.sources) == 1 and folder.is_dir() and holds_program(root_of(folder)):
        yield root_of(folder), []
        return
    with work_folder() as temporary:
        bounds = Bounds()
        lay_out(found, temporary, bounds)
        yield root_of(temporary), bounds.left_out


def lay_out(found: Found, folder: Path, bounds: Bounds) -> None:
    """Gather what was handed in under the names it had, and unpack it until a program is there."""
    for source in found.sources:
        if source.is_dir():
            for path in python_first(plain_files(source)):
                gather(path, folder / path.relative_to(source), bounds)
        else:
            gather(source, folder / first_name(source), bounds)
    for _ in range(DEEPEST):
        zips = sorted(path for path in plain_files(folder) if is_zip(path))
        if holds_program(root_of(folder)) or not zips:
            return
        for path in zips:
            unzip(path.rename(path.with_name(f".{path.name}")), path, bounds)


def gather(path: Path, target: Path, bounds: Bounds) -> None:
    """Copy one file; a zip may be larger than a submission, its files may not."""
    if is_zip(path):
        check_size(path)
    elif not bounds.take(path.name, path.stat().st_size):
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(path, target)


def first_name(path: Path) -> str:
    """A file's name as the student gave it."""
    name = moodle.own_name(path) or canvas.own_name(path)
    return portable(COPY.sub("", name) if name else path.name)
