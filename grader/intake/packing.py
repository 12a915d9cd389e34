"""Read one submission: unpack archives, find the programs, and pack the files that count."""

import hashlib
import re
import shutil
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from io import BufferedReader
from itertools import islice
from pathlib import Path, PurePosixPath

from msgspec import Struct

from grader.intake.archives import Bounds, unzip
from grader.intake.found import CannotTake, Package, Work
from grader.intake.learning_systems import SYSTEMS
from grader.intake.names import MENTIONED, make_portable, shorten_list
from grader.intake.pieces import (
    Layout,
    ManyPrograms,
    arrange,
    list_choices,
    match_name,
    name_type,
    rank_file,
    refuse_empty,
)
from grader.intake.places import (
    DEEPEST,
    cut_suffix,
    is_archive,
    is_packed,
    list_modules,
)
from grader.judge.plain import copy_plain, open_plain, size_of
from grader.judge.submission import CannotGrade, explain_unreadable, module_of, plain_files
from grader.judge.wall.outer import READING, Exceeded, Failed, Lost, call_within
from grader.judge.wall.workplace import work_folder
from grader.source.flaws import find_bad_bytes

COPY = re.compile(r"-\d+(?=\.\w+$)")  # suffix of an LMS for a file handed in again


@contextmanager
def open_submission(
    path: Path,
    say: Callable[[str], None] = lambda note: None,
    asked: Collection[str] = (),
) -> Iterator[Path]:
    """Unpack the submission at `path` and lay its files out as the lab does.

    It is read like one of a class. Raises CannotTake if it cannot be read.
    """
    if not path.exists():
        raise CannotTake(
            f"there is no submission at {path}: name a folder, an archive or a Python file"
        )
    real = path.resolve()
    name = real.name if real.is_dir() else cut_suffix(real)
    with work_folder() as temporary:
        try:
            package = pack(Work(make_portable(name), (real,)), asked)
        except ManyPrograms as error:
            raise CannotTake(f"{path}: {error}, or grade each of them with --class") from error
        except CannotTake as error:
            raise CannotTake(f"{path}: {error}") from error
        for note in package.notes:
            say(note)
        yield package.unpack(temporary)


def pack(found: Work, asked: Collection[str] = ()) -> Package:
    """Read a submission, with its programs in any folder.

    Raises CannotTake if it has none of the required programs, or cannot be read within the limits.
    Then it needs manual review; it is not worth 0 points.
    """
    try:
        work = partial(read_package, found, asked)
        return call_within(READING, Package, work, (ManyPrograms, CannotTake))
    except (Exceeded, Failed, Lost) as error:
        raise CannotTake(str(error)) from error


def read_package(found: Work, asked: Collection[str] = ()) -> Package:
    """Read a submission in this process."""
    bounds, files = Bounds(), []
    asked = asked or list_modules()
    try:
        with open_found(found, asked) as (folder, laid, notes):
            if not any(module_of(PurePosixPath(name)) in asked for name in laid.files):
                refuse_empty(folder, asked, notes)
            for name in sorted(laid.files, key=lambda each: rank_file(PurePosixPath(each))):
                with open_inside(folder, laid.files[name]) as file:
                    if bounds.take(name, length := size_of(file)):
                        files.append((name, file.read(length)))
    except OSError as error:
        raise CannotTake(explain_unreadable(error, found.sources[0])) from error
    except CannotTake:
        raise
    except CannotGrade as error:
        raise CannotTake(str(error)) from error
    notes = [*notes, *find_empty_programs(files, asked), *laid.notes, *bounds.notes]
    if len(notes) > MENTIONED:
        notes[MENTIONED:] = [f"and {len(notes) - MENTIONED} notes more"]
    return Package(found.name, sorted(files), notes)


class Contents(Struct, frozen=True):
    """A submission as handed in: its files, and paths to choose from."""

    files: list[tuple[str, bytes]]
    choices: list[list[str]] = []


def show(found: Work, asked: Collection[str] = ()) -> Contents:
    """Read a submission as handed in; return no files if it reaches a limit."""
    try:
        return call_within(READING, Contents, partial(read_shown, found, asked), (CannotTake,))
    except (Exceeded, Failed, Lost, CannotTake, OSError):
        return Contents([])


def read_shown(found: Work, asked: Collection[str]) -> Contents:
    """Read a submission in this process; open archives until a person must choose."""
    bounds = Bounds()
    with work_folder() as folder:
        copy_all(found, folder, bounds)
        with suppress(CannotGrade):
            unpack(found, folder, bounds, asked)
        paths = [PurePosixPath(path.relative_to(folder).as_posix()) for path in plain_files(folder)]
        files = [(path.as_posix(), (folder / path).read_bytes()) for path in paths]
        choices = list_choices(folder, asked)
    return Contents(sorted(files), [[each.as_posix() for each in group] for group in choices])


def find_empty_programs(files: list[tuple[str, bytes]], asked: Collection[str]) -> list[str]:
    """Return notes on empty programs; raises CannotTake for a program that is no text."""
    held = {name: content for name, content in files if module_of(PurePosixPath(name)) in asked}
    empty = {name for name, content in held.items() if name_type(content) == "empty"}
    if held and len(empty) == len(held):
        raise CannotTake(f"all programs are empty: {shorten_list(sorted(held))}")
    for name, content in sorted(held.items()):
        if name.endswith(".py") and name not in empty and (words := name_type(content)):
            needed = (
                "it is needed in UTF-8" if "UTF-16" in words else "the program itself is needed"
            )
            raise CannotTake(f"{name} is {words}: {needed}")
        if name.endswith(".py") and (flaw := find_bad_bytes(content)):
            raise CannotTake(f"{name}, line {flaw.line}: {flaw.message}: it is needed in UTF-8")
    alone = (f"{name} is empty" for name in sorted(empty) if "/" not in name)
    return list(alone)


@contextmanager
def open_found(
    found: Work, asked: Collection[str] = ()
) -> Iterator[tuple[Path, Layout, list[str]]]:
    """Unpack a submission, and find the lab's files in it."""
    folder = found.sources[0]
    if len(found.sources) == 1 and folder.is_dir():
        laid = arrange(folder, asked, found.taken)
        if is_complete(laid, asked) or not list_archives(folder):
            yield folder, laid, note_unopened(folder, laid, asked)
            return
    with work_folder() as temporary:
        bounds = Bounds()
        copy_all(found, temporary, bounds)
        laid = unpack(found, temporary, bounds, asked)
        yield temporary, laid, [*note_unopened(temporary, laid, asked), *bounds.notes]


def is_complete(laid: Layout, asked: Collection[str]) -> bool:
    """Return whether all required programs were found."""
    held = {name.partition("/")[0].removesuffix(".py") for name in laid.files}
    return held.issuperset(asked or list_modules())


def list_archives(folder: Path) -> list[Path]:
    return sorted(path for path in plain_files(folder) if is_archive(path))


def note_unopened(folder: Path, laid: Layout, asked: Collection[str]) -> list[str]:
    names = [path.relative_to(folder).as_posix() for path in list_archives(folder)]
    enough = "all programs lie beside it"
    deep = f"archives are opened {DEEPEST} deep, one in the other"
    why = enough if is_complete(laid, asked) else deep
    return [f"{name} was not opened: {why}" for name in names]


def unpack(found: Work, folder: Path, bounds: Bounds, asked: Collection[str] = ()) -> Layout:
    """Unpack until all required programs are found, or no archive is left."""
    refused: dict[str, str] = {}
    for _ in range(DEEPEST):
        archives = list_archives(folder)
        laid = arrange(folder, asked, found.taken)
        if is_complete(laid, asked) or not archives:
            break
        for path in archives:
            packed = path.rename(path.with_name(f".{path.name}"))
            try:
                unzip(packed, path, bounds)
            except CannotTake as error:
                shutil.rmtree(path, ignore_errors=True)
                refused[path.relative_to(folder).as_posix()] = str(error)
            packed.unlink()
    laid = arrange(folder, asked, found.taken)
    if refused and not is_complete(laid, asked):
        names = {each.name for each in found.sources}
        why = (f"{name}: {words}" * (name not in names) or words for name, words in refused.items())
        more = [f"and {len(refused) - MENTIONED} more"] * (len(refused) > MENTIONED)
        raise CannotTake("; ".join([*islice(why, MENTIONED), *more]))
    laid.notes += [f"skipped {name}: {words}" for name, words in refused.items()]
    return laid


def copy_all(found: Work, folder: Path, bounds: Bounds) -> None:
    """Copy a submission's files; copy equal uploads only once."""
    copied: set[tuple[str, str]] = set()
    for source in found.sources:
        if source.is_dir():
            paths = (path.relative_to(source).as_posix() for path in plain_files(source))
            for inside in sorted(map(PurePosixPath, paths), key=rank_file):
                with open_inside(source, source / inside) as file:
                    copy_file(file, inside.name, folder / inside, bounds)
            continue
        name = read_first_name(source)
        with open_inside(source, source) as file:
            known = name, hash_file(file, bounds.packed)
            if known not in copied:
                copied.add(known)
                copy_file(file, source.name, find_free_name(folder / name), bounds)


def hash_file(file: BufferedReader, most: int) -> str:
    """Return a hash of an open file; empty for one of more than `most` bytes."""
    if size_of(file) > most:
        return ""
    digest = hashlib.file_digest(file, "sha256").hexdigest()
    file.seek(0)
    return digest


def open_inside(source: Path, path: Path) -> BufferedReader:
    """Open a file of a submission; no part of its path may be a link.

    Raises CannotTake if it cannot be read.
    """
    try:
        return open_plain(source.parent, path.relative_to(source.parent))
    except OSError as error:
        raise CannotTake(explain_unreadable(error, source)) from error


def copy_file(file: BufferedReader, name: str, target: Path, bounds: Bounds) -> None:
    """Copy one file within the bounds; an archive has bounds of its own."""
    length = size_of(file)
    head = file.read(8)
    file.seek(0)
    if is_packed(target, head):
        bounds.take_archive(length)
    elif not bounds.take(name, length):
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    copy_plain(file, target, length)


def find_free_name(path: Path) -> Path:
    """Return a free path; add a number if the name is taken."""
    number = 1
    while path.exists():
        number += 1
        stem = re.sub(r" \(\d+\)$", "", path.stem)
        path = path.with_name(f"{stem} ({number}){path.suffix}")
    return path


def read_first_name(path: Path) -> str:
    """Return the name that the student gave a file, before the LMS changed it."""
    name = next(filter(None, (each.read_own_name(path) for each in SYSTEMS)), None)
    if name is None or match_name(name, [f"{module}.py" for module in list_modules()]):
        return make_portable(name or path.name)
    return make_portable(COPY.sub("", name))
