"""Take submissions into a course folder of nbgrader, and grade their engines."""

import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from rich.console import Console

from grader.classroom.batch import Run, grade_class
from grader.classroom.book import Book
from grader.classroom.executor import Pool
from grader.classroom.fingerprint import make_key
from grader.errors import Stop
from grader.intake.found import Intake, Work
from grader.intake.listing import open_class
from grader.intake.packing import open_found
from grader.judge.plain import copy_plain, open_plain, size_of
from grader.judge.submission import explain_unreadable, plain_files
from grader.judge.task import KIT, Options
from grader.judge.wall.outer import READING, call_alone

ASSIGNMENT = "physics-engine"
NOTEBOOKS = "notebooks"  # the folder of both trees
NAME = re.compile(r"[^\s*?\[\]/\\.][^*?\[\]/\\]*")  # nbgrader looks students up with such patterns


@dataclass(frozen=True)
class StudentFolder:
    """A student's folder, and the files taken from it."""

    student: str
    words: str
    taken: bool = True


def collect_submissions(folder: Path, course: Path) -> Iterator[StudentFolder]:
    """Copy each student's folder to nbgrader's folder for it.

    No links and nothing hidden is copied. A notebook may lie in the folder `notebooks`, as in the
    starter, beside the engine, or anywhere else. A changed submission is autograded again.
    """
    if not (course / "source" / ASSIGNMENT).is_dir():
        make = f"python -m grader nbgrader course {course}"
        raise Stop(f"{course} is no course yet: make it with {make}")
    with open_class(folder) as intake:
        for found in intake.found:
            answer = call_alone(READING, StudentFolder, partial(take_found, found, course))
            yield (
                answer
                if isinstance(answer, StudentFolder)
                else StudentFolder(found.name, str(answer), False)
            )
        for name, words in intake.troubles.items():
            yield StudentFolder(name, words, False)


def take_found(found: Work, course: Path) -> StudentFolder:
    """Take one submission, or return the reason why that fails."""
    try:
        with open_found(found) as (folder, laid, _):
            files = laid.files or {str(p.relative_to(folder)): p for p in plain_files(folder)}
            return take_submission(found.name, files, folder, course)
    except Stop as error:
        return StudentFolder(found.name, str(error), False)


def take_submission(
    student: str, files: Mapping[str, Path], folder: Path, course: Path
) -> StudentFolder:
    """Put one student's files into nbgrader's folder, unless they are there already.

    `files` has the lab's files by name; `folder` has all submitted files.
    """
    if not NAME.fullmatch(student):
        return StudentFolder(student, "nbgrader cannot work with this name: rename it", False)
    target = course / "submitted" / student / ASSIGNMENT
    with tempfile.TemporaryDirectory() as temporary:
        copy = Path(temporary) / ASSIGNMENT
        notebooks = copy_files(files, folder, copy)
        if target.exists() and read_files(copy) == read_files(target):
            return StudentFolder(student, "unchanged")
        shutil.rmtree(target, ignore_errors=True)
        shutil.rmtree(course / "autograded" / student / ASSIGNMENT, ignore_errors=True)
        shutil.copytree(copy, target)
    return StudentFolder(student, f"{notebooks} notebooks" if notebooks else "no notebook")


def copy_files(files: Mapping[str, Path], folder: Path, target: Path) -> int:
    """Copy a submission as nbgrader needs it, with notebooks on top; return their number.

    A notebook that is not beside the programs is searched in all submitted files.
    """
    target.mkdir()
    wanted = {path.name for path in (KIT / "solution" / NOTEBOOKS).glob("*.ipynb")}
    for name, source in files.items():
        inside = Path(name)
        if inside.name in wanted and inside.parts[:-1] in ((), (NOTEBOOKS,)):
            inside = Path(inside.name)
        copy_one(folder, source, target / inside)
    for name in sorted(name for name in wanted if not (target / name).exists()):
        if notebook := find_notebook(folder, name):
            copy_one(folder, notebook, target / name)
    return sum((target / name).exists() for name in wanted)


def copy_one(top: Path, source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        file = open_plain(top, source.relative_to(top))
    except OSError as error:
        raise Stop(explain_unreadable(error, top)) from error
    with file:
        copy_plain(file, target, size_of(file))


def find_notebook(folder: Path, name: str) -> Path | None:
    """Return the notebook nearest to the top; raises Stop if two differ at the same depth."""
    paths = [path for path in plain_files(folder) if path.name == name]
    depth = min((len(path.parts) for path in paths), default=0)
    nearest = [path for path in paths if len(path.parts) == depth]
    if len({path.read_bytes() for path in nearest}) > 1:
        names = " and ".join(path.relative_to(folder).as_posix() for path in sorted(nearest))
        raise Stop(f"{names} are the same notebook with other content: leave one")
    return min(nearest, default=None)


def read_files(top: Path) -> dict[Path, bytes]:
    return {p.relative_to(top): p.read_bytes() for p in top.rglob("*") if p.is_file()}


def grade_submitted(course: Path, options: Options, jobs: int, console: Console) -> list[str]:
    """Grade every engine in `submitted`, and write files into `results`; return the troubles."""
    found = sorted((course / "submitted").glob(f"*/{ASSIGNMENT}"))
    if not found:
        raise Stop(f"there is nothing in {course / 'submitted'}: collect submissions first")
    intake = Intake([Work(path.parent.name, (path,)) for path in found])
    results = course / "results"
    for path in results.glob("*.json"):
        if path.stem not in {each.name for each in intake.found}:
            path.unlink()  # stale results must not outlive their submissions
    with Pool(options, jobs) as pool:
        run = grade_class(Run(intake, Book(results), make_key(options)), pool, console)
    return [f"{each.name}: {each.trouble}" for each in run.outcomes if each.trouble]
