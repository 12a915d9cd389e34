"""Reading one submission: archives are unpacked, the programs in it are found, and it is packed."""

import re
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from grader.classroom.intake import blackboard, brightspace, canvas, moodle
from grader.classroom.intake.archives import Bounds, check_size, unzip
from grader.classroom.intake.found import CannotTake, Found, Package
from grader.classroom.intake.pieces import (
    Arranged,
    ManyPrograms,
    arranged,
    meant,
    nothing_of_the_lab,
)
from grader.classroom.intake.places import (
    DEEPEST,
    is_archive,
    modules,
    python_first,
    stem_of,
    unwrapped,
)
from grader.classroom.names import MENTIONED, portable
from grader.judge.submission import CannotGrade, plain_files
from grader.judge.workplace import work_folder

COPY = re.compile(r"-\d+(?=\.\w+$)")  # what an LMS adds to the name of a file that comes again


@contextmanager
def opened_submission(path: Path, say: Callable[[str], None] = lambda note: None) -> Iterator[Path]:
    """The submission at `path`, as the lab lays it out: unpacked, and its files put together.

    Raises CannotGrade where it cannot be taken. A folder with nothing of the lab is left as it is:
    whoever names one sees what is in it.
    """
    if (path.is_file() and not is_archive(path)) or not path.exists() or lies_well(path):
        yield path
        return
    with work_folder() as temporary:
        try:
            package = pack(Found(portable(stem_of(path.resolve())), (path,)))
        except ManyPrograms as error:
            raise CannotGrade(f"{path}: {error}, or grade each of them with --class") from error
        except CannotTake as error:
            raise CannotGrade(f"{path}: {error}") from error
        for note in package.notes:
            say(note)
        yield package.unpack(temporary)


def lies_well(path: Path) -> bool:
    """Whether a folder can be graded as it lies, or holds nothing that could be put together."""
    if not path.is_dir():
        return False
    try:
        laid = arranged(path)
    except ManyPrograms:
        return False
    as_it_is = laid.as_found and laid.root == path
    return as_it_is or not (laid.files or archives_in(path))


def pack(found: Found) -> Package:
    """Read what may be taken of a submission, wherever in it the programs lie.

    Raises CannotTake where there is none of them, or something could not be read: this is no work
    worth nothing, but for a person to look at.
    """
    bounds, files = Bounds(), []
    try:
        with opened(found) as (folder, laid, notes):
            if not laid.files:
                raise nothing_of_the_lab(folder)
            for name in sorted(laid.files, key=lambda each: (not each.endswith(".py"), each)):
                path = laid.files[name]
                if bounds.take(name, path.stat().st_size):
                    files.append((name, path.read_bytes()))
    except OSError as error:
        raise CannotTake(f"it cannot be read: {error}") from error
    except CannotGrade as error:
        raise CannotTake(str(error)) from error
    left_out = [f"left out {each}" for each in bounds.left_out]
    said = [*notes, *laid.notes, *left_out]
    if len(said) > MENTIONED:
        said[MENTIONED:] = [f"and {len(said) - MENTIONED} notes more"]
    return Package(found.name, sorted(files), said)


@contextmanager
def laid_out(found: Found) -> Iterator[tuple[Path, list[str]]]:
    """A folder that holds the work as the lab lays it out, and what there is to say of it."""
    with opened(found) as (folder, laid, notes):
        if not laid.files:
            yield unwrapped(folder), notes
        elif laid.as_found:
            yield laid.root, [*notes, *laid.notes]
        else:
            with work_folder() as temporary:
                for name, path in laid.files.items():
                    (temporary / name).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copyfile(path, temporary / name)
                yield temporary, [*notes, *laid.notes]


@contextmanager
def opened(found: Found) -> Iterator[tuple[Path, Arranged, list[str]]]:
    """All that was handed in, archives unpacked, and the lab's files in it."""
    folder = found.sources[0]
    if len(found.sources) == 1 and folder.is_dir():
        laid = arranged(folder)
        if complete(laid) or not archives_in(folder):
            yield folder, laid, unopened(folder)
            return
    with work_folder() as temporary:
        bounds = Bounds()
        gather_all(found, temporary, bounds)
        laid = unpacked(found, temporary, bounds)
        left_out = [f"left out {each}" for each in bounds.left_out]
        yield temporary, laid, [*unopened(temporary), *left_out]


def complete(laid: Arranged) -> bool:
    """Whether every program of the lab is there."""
    held = {name.partition("/")[0].removesuffix(".py") for name in laid.files}
    return modules() <= held


def archives_in(folder: Path) -> list[Path]:
    return sorted(path for path in plain_files(folder) if is_archive(path))


def unopened(folder: Path) -> list[str]:
    names = [path.relative_to(folder).as_posix() for path in archives_in(folder)]
    return [f"{name} was not opened: all programs lie beside it" for name in names]


def unpacked(found: Found, folder: Path, bounds: Bounds) -> Arranged:
    """Unpack until all programs of the lab are there, or there is nothing left to unpack."""
    refused: dict[str, str] = {}
    for _ in range(DEEPEST):
        archives = archives_in(folder)
        laid = arranged(folder)
        if complete(laid) or not archives:
            break
        for path in archives:
            packed = path.rename(path.with_name(f".{path.name}"))
            try:
                unzip(packed, path, bounds)
            except CannotTake as error:
                shutil.rmtree(path, ignore_errors=True)
                refused[path.relative_to(folder).as_posix()] = str(error)
            packed.unlink()
    laid = arranged(folder)
    if refused and not complete(laid):
        names = {each.name for each in found.sources}
        told = (
            f"{name}: {words}" * (name not in names) or words for name, words in refused.items()
        )
        raise CannotTake("; ".join(told))
    laid.notes += [f"left out {name}: {words}" for name, words in refused.items()]
    return laid


def gather_all(found: Found, folder: Path, bounds: Bounds) -> None:
    """Gather what was handed in under the names it had."""
    for source in found.sources:
        if source.is_dir():
            for path in python_first(plain_files(source)):
                gather(path, folder / path.relative_to(source), bounds)
        else:
            gather(source, free(folder / first_name(source)), bounds)


def gather(path: Path, target: Path, bounds: Bounds) -> None:
    """Copy one file; an archive may be larger than a submission, its files may not."""
    if not path.is_file():
        raise CannotTake(f"{path.name} is no file to read, but a pipe, a device or nothing")
    if is_archive(path):
        check_size(path)
    elif not bounds.take(path.name, path.stat().st_size):
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(path, target)


def free(path: Path) -> Path:
    """A second file of one name gets another, by which it is known again."""
    number = 1
    while path.exists():
        number += 1
        stem = re.sub(r" \(\d+\)$", "", path.stem)
        path = path.with_name(f"{stem} ({number}){path.suffix}")
    return path


def first_name(path: Path) -> str:
    """A file's name as the student gave it; the lab's own are known again by `pieces`."""
    forms = (blackboard, brightspace, moodle, canvas)
    name = next(filter(None, (form.own_name(path) for form in forms)), None)
    if name is None or meant(name, [f"{module}.py" for module in modules()]):
        return portable(name or path.name)
    return portable(COPY.sub("", name))
