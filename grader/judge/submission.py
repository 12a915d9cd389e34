"""Take in a submission: make a bounded, read-only copy, and find its TODOs."""

import errno
import logging
import math
import os
import shutil
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from itertools import islice
from pathlib import Path, PurePath, PurePosixPath
from typing import TypeVar

import msgspec

from grader.errors import Stop
from grader.judge.plain import copy_plain, open_plain, size_of
from grader.judge.result import Where
from grader.judge.rubric import CHECKS, Todo, load_rubric
from grader.protocol import MAX_UPLOAD
from grader.source.definitions import MAX_READ, Function, Program, source_of
from grader.source.flaws import Flaw, find_bad_bytes, find_flaw
from grader.source.given import MISPLACED, first_difference
from grader.source.regions import (
    MAX_SOURCE,
    Region,
    encode,
    find_regions,
    python_files,
    read_source,
    shape_of,
)
from grader.source.repair import OUTSIDE, HandedOut, Repairer

MAX_FILES = 500
MAX_SEEN = 20_000  # maximum of files and folders
MAX_COPIES = 20  # maximum of files to read beside the programs
MAX_DEPTH = 40  # maximum depth of folders
ENDLESS = f"it has more than {MAX_SEEN} files and folders, or {MAX_DEPTH} folders in each other"
FULL = {errno.ENOSPC, errno.EDQUOT}  # faults of our disk, and not of the submission
COPY = "TODO {id} is written in {copy}, which no program runs: the code belongs in {file}."
SUPPLIED = "{file} is missing. The handed-out one was taken in its place."
COMPILED = (".pyc", ".pyo", ".so", ".pyd", ".dll", ".dylib")  # unreadable code
IGNORED = {"venv", "__pycache__", "__MACOSX", "node_modules", "build"}  # and hidden folders


T = TypeVar("T")
log = logging.getLogger(__name__)


class CannotGrade(Stop):
    """There is nothing to grade; the message says why and what to do."""

    cannot = "grade"


def attempt(make: Callable[[], T], otherwise: T) -> T:
    """Return the result of `make` on a submission's code, or `otherwise` if it fails.

    Use it only for messages: no points depend on it.
    """
    try:
        return make()
    except CannotGrade:
        raise
    except Exception as error:
        log.warning("no words were found for a failed check: %s", type(error).__name__)
        return otherwise


@dataclass
class Submission:
    """The copy of a submission and the positions of its TODOs."""

    name: str
    folder: Path
    begun: dict[str, bool] = field(default_factory=dict)
    where: dict[str, Where] = field(default_factory=dict)
    functions: dict[str, str] = field(default_factory=dict)  # the shape of each TODO's function
    left_out: list[str] = field(default_factory=list)
    unread: list[str] = field(default_factory=list)  # files too long to read, in words
    uses_numpy: bool = False
    flaws: dict[str, Flaw] = field(default_factory=dict)  # by TODO: its code is not Python
    outside: dict[str, Flaw] = field(default_factory=dict)  # by program: other code is not Python
    starts: dict[str, Where] = field(default_factory=dict)  # the file with each program's main
    program: Program = field(default_factory=lambda: Program({}))  # all of its Python files
    supplied: list[str] = field(default_factory=list)  # given files that it lacks
    remarks: dict[str, str] = field(default_factory=dict)  # by TODO: the reason why no code counts

    def holds(self, file: str) -> bool:
        """Return whether it has a file of this name; the name may come from a child."""
        inside = PurePosixPath(file)
        safe = not inside.is_absolute() and ".." not in inside.parts and file.isprintable()
        with suppress(OSError):  # such as a name that is too long for any file
            return safe and (self.folder / inside).is_file()
        return False


def take_in(path: Path, copy: Path) -> Submission:
    """Copy a submission within bounds, make the copy read-only, and find the TODOs in it."""
    if not path.exists():
        raise CannotGrade(f"there is no submission at {path}: name a folder or a Python file")
    if path.is_file() and path.stat().st_size > MAX_UPLOAD:
        raise CannotGrade(f"{path} has more than {MAX_UPLOAD >> 20} MB")
    submission = Submission(path.resolve().name, copy)
    copy.mkdir(parents=True)
    if path.is_file():
        shutil.copyfile(path, copy / path.name)
    else:
        copy_tree(path, submission)
    use_printed_names(copy)
    submission.supplied = list(supply_given(copy))
    find_todos(submission)
    for each in [copy, *copy.rglob("*")]:
        each.chmod(0o555 if each.is_dir() else 0o444)
    return submission


def copy_tree(path: Path, submission: Submission) -> None:
    """Copy plain files within the bounds, the lab's first, without links and hidden files."""
    files = size = 0
    made = {Path()}  # folders
    for inside in sorted((each.relative_to(path) for each in plain_files(path)), key=weight):
        target = submission.folder / inside
        try:
            with open_plain(path, inside) as file:
                length = size_of(file)
                if files + 1 > MAX_FILES or size + length > MAX_UPLOAD:
                    submission.left_out.append(f"{inside.as_posix()}: too much")
                    continue
                files, size = files + 1, size + length
                if inside.parent not in made:
                    target.parent.mkdir(parents=True, exist_ok=True)
                    made.add(inside.parent)
                copy_plain(file, target, length)
        except OSError as error:  # such as a path that is too long
            if error.errno in FULL:
                raise
            raise CannotGrade(explain_unreadable(error, path)) from error


def weight(inside: PurePath) -> tuple[bool, bool, int, PurePath]:
    """Return a sort key that puts the lab's own files before all others."""
    of_lab = inside.parts[0].removesuffix(".py") in load_rubric().modules
    return not of_lab, inside.suffix != ".py", len(inside.parts), inside


def use_printed_names(folder: Path) -> None:
    """Copy NAME_starter.py, the name that the lesson prints, to NAME.py if there is no NAME."""
    for name in load_rubric().modules:
        printed, own = folder / f"{name}_starter.py", folder / f"{name}.py"
        if printed.is_file() and not own.exists() and not (folder / name).exists():
            shutil.copyfile(printed, own)


def supply_given(folder: Path) -> Iterator[str]:
    """Add given files that a submission lacks, and yield their names.

    A package is completed if a part of it was handed in. A missing program stays missing.
    """
    programs = {f"{module}.py" for module in load_rubric().modules}
    for name, text in load_given().items():
        if name in programs:
            continue
        package = name.partition("/")[0]
        own_package = (folder / package / "__init__.py").exists()
        hidden = (folder / f"{package}.py").exists() and not own_package
        target = folder / name
        found = next(each for each in (target, *target.parents) if each.exists())
        if not found.is_dir() or found == target:  # the file, or a folder of its name
            continue
        if "/" in name and (hidden or not (folder / package).is_dir()):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8", newline="\n")
        yield name


@cache
def load_given() -> dict[str, str]:
    """Return the programs as they were handed out: files by name, as `sync` keeps them."""
    return msgspec.json.decode((CHECKS / "given.json").read_bytes(), type=dict[str, str])


def plain_files(path: Path) -> Iterator[Path]:
    """Yield the files of a submission, without hidden ones and virtual environments.

    Raises CannotGrade if there are too many, or a folder cannot be read: it may hold the work.
    """
    seen, waiting = 0, deque([(path, 0)])
    while waiting:
        here, depth = waiting.popleft()
        try:
            entries = os.scandir(here)
        except FileNotFoundError:  # it went away
            continue
        except OSError as error:
            raise CannotGrade(explain_unreadable(error, path)) from error
        with entries:
            for entry in entries:
                seen += 1
                if seen > MAX_SEEN or depth > MAX_DEPTH:
                    raise CannotGrade(ENDLESS)
                if entry.is_dir(follow_symlinks=False):
                    if may_be_entered(entry):
                        waiting.append((here / entry.name, depth + 1))
                elif entry.is_file(follow_symlinks=False) and may_be_read(entry.name):
                    yield here / entry.name


def explain_unreadable(error: OSError, within: Path) -> str:
    """Return the reason why a file or folder cannot be read, with its name in the submission."""
    why = error.strerror or type(error).__name__
    name = os.fspath(error.filename) if isinstance(error.filename, (str, os.PathLike)) else ""
    if not name or name == os.fspath(within):
        return f"it cannot be read: {why}"
    inside = os.path.relpath(name, within)
    return f"{Path(name).name if inside.startswith('..') else inside} cannot be read: {why}"


def may_be_read(name: str) -> bool:
    """Return whether a name is printable, and neither hidden nor that of compiled code."""
    return name.isprintable() and not name.startswith(".") and not name.endswith(COMPILED)


def may_be_entered(folder: os.DirEntry[str]) -> bool:
    """Return whether a folder may hold a student's files, and is no virtual environment."""
    is_own = may_be_read(folder.name) and folder.name not in IGNORED
    return is_own and not os.path.lexists(os.path.join(folder.path, "pyvenv.cfg"))


def find_todos(submission: Submission) -> None:
    """Find the position of each TODO, and whether its code differs from the stub."""
    rubric = load_rubric()
    texts = {
        path.relative_to(submission.folder): read_source(path)
        for path in python_files(submission.folder)
    }
    program = submission.program = repair_programs(submission, texts)
    loaded = program.list_files(rubric.modules)
    submission.uses_numpy = any("numpy" in texts[path] for path in loaded)
    for todo in rubric.todos:
        if not todo.function:
            continue
        found = program.definition(todo.function.partition(":")[0], todo.path)
        if found is not None:
            inside = program.paths[found.module]
            note_place(submission, todo, inside, texts[inside], found.function)
        submission.begun.setdefault(todo.id, not todo.bonus)  # older programs have no bonus tasks
    note_remarks(submission, texts)
    for module in rubric.modules:
        main = program.definition(module, "main")
        path = program.paths.get(main.module if main else module)
        if path is not None:
            line = main.function.lineno if main and main.function else 1
            submission.starts[module] = Where(path.as_posix(), line)
    for module, flaw in submission.outside.items():
        own = [todo.id for todo in rubric.todos if todo.function and todo.module == module]
        if not any(id in submission.functions for id in own):  # only code that is not Python
            submission.flaws |= dict.fromkeys(own, flaw)
    for id, flaw in submission.flaws.items():
        submission.begun[id], submission.where[id] = True, Where(flaw.file, flaw.line)
    giants = {each for each in submission.folder.rglob("*.py") if each.is_file()} - {
        submission.folder / inside for inside in texts
    }
    paths = [*sorted(giants), *(submission.folder / inside for inside in program.unread)]
    submission.unread = [describe_unread(path, submission.folder) for path in paths]


def repair_programs(submission: Submission, texts: dict[Path, str]) -> Program:
    """Replace code that Python refuses in the files that the programs load.

    Changes `texts` and the copy, and notes the TODOs whose code was replaced.
    """
    repairer, repaired_once = Repairer(handed_out()), set[Path]()
    modules = load_rubric().modules
    started = [*modules, *(f"{module}.__main__" for module in modules)]
    while True:
        program = Program(texts)
        loaded = dict.fromkeys(part for module in started for part in program.list_loaded(module))
        refused = {
            path: flaw
            for name in loaded
            if (path := program.paths[name]) not in {*repaired_once, *program.unread}
            and (flaw := flaw_of(submission.folder / path, program.modules[name].refused))
        }
        for path, flaw in refused.items():
            repair_file(submission, repairer, path, texts, flaw)
        if not refused:
            return program
        repaired_once |= refused.keys()


def repair_file(
    submission: Submission, repairer: Repairer, path: Path, texts: dict[Path, str], flaw: Flaw
) -> None:
    module, flaw = module_of(path), flaw.in_file(path.as_posix())
    repaired = repairer.repair(flaw, texts[path])
    if repaired is None:
        submission.outside.setdefault(module, flaw)
        return
    texts[path] = repaired.text
    (submission.folder / path).write_bytes(encode(repaired.text))
    for todo, each in repaired.flaws.items():
        if todo == OUTSIDE:
            submission.outside.setdefault(module, each)
        else:
            submission.flaws.setdefault(todo, each)


def flaw_of(path: Path, refused: bool) -> Flaw | None:
    """Return the first flaw that Python refuses in a file, which may be undecodable."""
    return find_bad_bytes(path.read_bytes()) or (find_flaw(read_source(path)) if refused else None)


@cache
def handed_out() -> HandedOut:
    stubs = msgspec.json.decode((CHECKS / "stubs.json").read_bytes(), type=dict[str, str])
    functions = {todo.id: todo.function for todo in load_rubric().todos if todo.function}
    return HandedOut(load_given(), stubs, functions)


@cache
def load_stubs() -> dict[str, str]:
    """Return the shapes of the stubs' regions, and of the functions around them."""
    return {name: shape_of(source) for name, source in handed_out().stubs.items()}


def describe_unread(path: Path, folder: Path) -> str:
    size = math.ceil(path.stat().st_size / 1024)
    return (
        f"{path.relative_to(folder).as_posix()} has {size} KB and was not read: a file may have at "
        f"most {MAX_SOURCE // 1024} KB, and all together {MAX_READ // 1024} KB"
    )


def note_place(
    submission: Submission, todo: Todo, inside: Path, text: str, function: Function | None
) -> None:
    """Note the position of a TODO: its region or, without markers, its function.

    A region counts only inside the function: a copy elsewhere does not run.
    """
    region = find_regions(text).get(todo.id)
    if function is not None:
        source = source_of(text, function)
        submission.functions[todo.id] = shape_of(source)
        if region and not function.lineno <= region.start + 1 <= function.end_lineno:
            region = None
    file = inside.as_posix()
    if region is not None:
        submission.where[todo.id] = Where(file, first_code_line(region))
        submission.begun[todo.id] = region.shape != load_stubs()[todo.id]
        if not submission.begun[todo.id] and function is not None:
            note_misplaced(submission, todo, file, text, function)
    elif function is not None:
        submission.where[todo.id] = Where(file, function.lineno)
        submission.begun[todo.id] = submission.functions[todo.id] != load_stubs()[f"def {todo.id}"]


def note_misplaced(
    submission: Submission, todo: Todo, file: str, text: str, function: Function
) -> None:
    """Note the first line that was written in a TODO's function outside its region."""
    own, given = source_of(text, function), handed_out().stubs[f"def {todo.id}"]
    number, theirs, _ = first_difference(own.splitlines(), given.splitlines())
    if theirs and shape_of(own) != shape_of(given):
        line = function.lineno + number
        submission.where[todo.id] = Where(file, line)
        submission.remarks[todo.id] = MISPLACED.format(
            line=line, file=file, text=theirs, id=todo.id
        )


def note_remarks(submission: Submission, texts: dict[Path, str]) -> None:
    """Note other reasons why a TODO has no code: it is in a copy, or its file is missing."""
    lacking = [
        todo
        for todo in load_rubric().todos
        if todo.function
        and todo.id not in submission.remarks
        and (todo.id not in submission.functions or not submission.begun[todo.id])
    ]
    copies = find_copies(submission, {todo.id for todo in lacking}, texts)
    for todo in lacking:
        found, where = copies.get(todo.id), submission.where.get(todo.id)
        if found is not None:
            file = where.file if where else f"{todo.module}.py"
            words = COPY.format(id=todo.id, copy=found.as_posix(), file=file)
            submission.remarks[todo.id] = words
        elif where is not None and where.file in submission.supplied:
            submission.remarks[todo.id] = SUPPLIED.format(file=where.file)


def find_copies(submission: Submission, ids: set[str], texts: dict[Path, str]) -> dict[str, Path]:
    """Return, by TODO, an unloaded file with code for it that is not the stub."""
    program = submission.program
    modules = load_rubric().modules
    loaded = {program.paths[part] for module in modules for part in program.list_loaded(module)}
    others = [path for path in texts if path not in loaded and not path.stem.endswith("_old")]
    with_regions = (path for path in others if ids and "# END TODO" in texts[path])
    return {
        id: path
        for path in islice(with_regions, MAX_COPIES)
        for id, region in find_regions(texts[path]).items()
        if id in ids and region.shape != load_stubs()[id]
    }


def first_code_line(region: Region) -> int:
    """Return the number of a region's first line of code, or else of its first line."""
    code = (number for number, line in enumerate(region.lines) if not is_comment(line))
    return region.start + 2 + next(code, 0)


def is_comment(line: str) -> bool:
    return line.strip().startswith("#") or not line.strip()


def module_of(inside: PurePath) -> str:
    """Return the module or package of a file, by its path inside the submission."""
    return inside.parts[0].removesuffix(".py")
