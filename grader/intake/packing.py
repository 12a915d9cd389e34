"""Reading one submission: archives are unpacked, the programs in it are found, and it is packed."""

import re
import shutil
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from filecmp import cmp
from pathlib import Path, PurePosixPath

from grader.intake import blackboard, brightspace, canvas, moodle
from grader.intake.archives import Bounds, check_size, unzip
from grader.intake.found import CannotTake, Found, Package
from grader.intake.names import MENTIONED, in_short, portable
from grader.intake.pieces import (
    Arranged,
    ManyPrograms,
    arranged,
    meant,
    no_program,
    nothing_of_the_lab,
    weight,
)
from grader.intake.places import (
    DEEPEST,
    is_archive,
    modules,
    stem_of,
    unwrapped,
)
from grader.judge.submission import CannotGrade, module_of, plain_files, unreadable
from grader.judge.workplace import work_folder

COPY = re.compile(r"-\d+(?=\.\w+$)")  # what an LMS adds to the name of a file that comes again


@contextmanager
def opened_submission(
    path: Path,
    say: Callable[[str], None] = lambda note: None,
    asked: Collection[str] = (),
) -> Iterator[Path]:
    """The submission at `path`, as the lab lays it out: unpacked, and its files put together.

    Raises CannotGrade where it cannot be taken. A folder with nothing of the lab is left as it is:
    whoever names one sees what is in it.
    """
    if (path.is_file() and not is_archive(path)) or not path.exists() or lies_well(path, asked):
        yield path
        return
    with work_folder() as temporary:
        try:
            package = pack(Found(portable(stem_of(path.resolve())), (path,)), asked)
        except ManyPrograms as error:
            raise CannotGrade(f"{path}: {error}, or grade each of them with --class") from error
        except CannotTake as error:
            raise CannotGrade(f"{path}: {error}") from error
        for note in package.notes:
            say(note)
        yield package.unpack(temporary)


def lies_well(path: Path, asked: Collection[str] = ()) -> bool:
    """Whether a folder can be graded as it lies, or holds nothing that could be put together."""
    if not path.is_dir():
        return False
    try:
        laid = arranged(path, asked)
    except ManyPrograms:
        return False
    as_it_is = laid.as_found and laid.root == path
    return as_it_is or not (laid.files or archives_in(path))


def pack(found: Found, asked: Collection[str] = ()) -> Package:
    """Read what may be taken of a submission, wherever in it the programs lie.

    Raises CannotTake where there is none of those that the course asks for, or something could not
    be read: this is no work worth nothing, but for a person to look at.
    """
    bounds, files = Bounds(), []
    asked = asked or modules()
    try:
        with opened(found, asked) as (folder, laid, notes):
            if not any(module_of(PurePosixPath(name)) in asked for name in laid.files):
                raise nothing_of_the_lab(folder, asked, notes)
            for name in sorted(laid.files, key=lambda each: weight(PurePosixPath(each))):
                path = laid.files[name]
                if bounds.take(name, path.stat().st_size):
                    files.append((name, path.read_bytes()))
    except OSError as error:
        raise CannotTake(unreadable(error, found.sources[0])) from error
    except CannotGrade as error:
        raise CannotTake(str(error)) from error
    said = [*notes, *no_programs(files, asked), *laid.notes, *bounds.notes]
    if len(said) > MENTIONED:
        said[MENTIONED:] = [f"and {len(said) - MENTIONED} notes more"]
    return Package(found.name, sorted(files), said)


def no_programs(files: list[tuple[str, bytes]], asked: Collection[str]) -> list[str]:
    """Notes on programs that say nothing; raises CannotTake where one is no Python at all."""
    held = {name: content for name, content in files if module_of(PurePosixPath(name)) in asked}
    empty = {name for name, content in held.items() if no_program(content) == "empty"}
    if held and len(empty) == len(held):
        raise CannotTake(f"there is nothing in what was handed in: {in_short(sorted(held))}")
    for name, content in sorted(held.items()):
        if name.endswith(".py") and name not in empty and (words := no_program(content)):
            raise CannotTake(f"{name} is {words}: ask for the program itself")
    alone = (f"{name} is empty" for name in sorted(empty) if "/" not in name)
    return list(alone)


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
def opened(found: Found, asked: Collection[str] = ()) -> Iterator[tuple[Path, Arranged, list[str]]]:
    """All that was handed in, archives unpacked, and the lab's files in it."""
    folder = found.sources[0]
    if len(found.sources) == 1 and folder.is_dir():
        laid = arranged(folder, asked)
        if complete(laid, asked) or not archives_in(folder):
            yield folder, laid, unopened(folder, laid, asked)
            return
    with work_folder() as temporary:
        bounds = Bounds()
        gather_all(found, temporary, bounds)
        laid = unpacked(found, temporary, bounds, asked)
        yield temporary, laid, [*unopened(temporary, laid, asked), *bounds.notes]


def complete(laid: Arranged, asked: Collection[str]) -> bool:
    """Whether every program is there that the course asks for."""
    held = {name.partition("/")[0].removesuffix(".py") for name in laid.files}
    return held.issuperset(asked or modules())


def archives_in(folder: Path) -> list[Path]:
    return sorted(path for path in plain_files(folder) if is_archive(path))


def unopened(folder: Path, laid: Arranged, asked: Collection[str]) -> list[str]:
    names = [path.relative_to(folder).as_posix() for path in archives_in(folder)]
    enough = "all programs lie beside it"
    deep = f"archives are opened {DEEPEST} deep, one in the other"
    return [f"{name} was not opened: {enough if complete(laid, asked) else deep}" for name in names]


def unpacked(found: Found, folder: Path, bounds: Bounds, asked: Collection[str] = ()) -> Arranged:
    """Unpack until all programs that are asked for are there, or nothing is left to unpack."""
    refused: dict[str, str] = {}
    for _ in range(DEEPEST):
        archives = archives_in(folder)
        laid = arranged(folder, asked)
        if complete(laid, asked) or not archives:
            break
        for path in archives:
            packed = path.rename(path.with_name(f".{path.name}"))
            try:
                unzip(packed, path, bounds)
            except CannotTake as error:
                shutil.rmtree(path, ignore_errors=True)
                refused[path.relative_to(folder).as_posix()] = str(error)
            packed.unlink()
    laid = arranged(folder, asked)
    if refused and not complete(laid, asked):
        names = {each.name for each in found.sources}
        told = (
            f"{name}: {words}" * (name not in names) or words for name, words in refused.items()
        )
        raise CannotTake("; ".join(told))
    laid.notes += [f"left out {name}: {words}" for name, words in refused.items()]
    return laid


def gather_all(found: Found, folder: Path, bounds: Bounds) -> None:
    """Gather what was handed in under the names it had, the same file but once."""
    known: dict[tuple[str, int], list[Path]] = {}
    for source in found.sources:
        if source.is_file():
            alike = known.setdefault((first_name(source), source.stat().st_size), [])
            if any(cmp(source, each, shallow=False) for each in alike):
                continue
            alike.append(source)
        if source.is_dir():
            paths = (path.relative_to(source).as_posix() for path in plain_files(source))
            for inside in sorted(map(PurePosixPath, paths), key=weight):
                gather(source / inside, folder / inside, bounds)
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
