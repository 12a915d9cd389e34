"""The course folder: the assignment in it, and submissions taken in and graded."""

import filecmp
import re
import shutil
import tempfile
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from grader.classroom.batch import grade_class
from grader.classroom.executor import Pool
from grader.classroom.fingerprint import key_of
from grader.classroom.intake.found import CannotTake, Found, Intake
from grader.classroom.intake.listing import opened_class
from grader.classroom.intake.packing import laid_out
from grader.judge.course import FULL, Course
from grader.judge.grade import KIT, Options
from grader.judge.submission import CannotGrade, plain_files, unreadable
from grader.maintain.handed_out import students_tree, write_tree
from grader.maintain.notebooks import notebooks_of
from grader.todo_regions import regions_in

ASSIGNMENT = "physics-engine"
NOTEBOOKS = "notebooks"  # the folder of both trees
INSTRUCTOR = KIT / "handouts" / "instructor"
SHARE = re.compile(r"^(\w+) = \d+\n", re.M)  # of a notebook, in marks.toml
SETTINGS = ("nbgrader_config.py", "marks.toml")
MANIFEST = "MANIFEST.txt"  # of a release: a hash and a name on each line
NAME = re.compile(r"[^\s*?\[\]/\\.][^*?\[\]/\\]*")  # nbgrader looks students up with such patterns


class NoCourse(Exception):
    """The course folder is not ready for this; the message says why and what to do."""


# ---------------------------------------------------------------- making a course


def make_course(
    course: Path, renew: bool = False, release: Path | None = None, taken: Course = FULL
) -> list[str]:
    """Make the folder in which nbgrader's commands run; returns the assignment's files.

    The source holds the students' Python files, no TODO of them done: nbgrader releases whatever
    lies beside the notebooks. From the archive of a `release` come the checks as well, so that
    `make check` works in what students get.
    """
    if course.resolve().is_relative_to(KIT) and not course.resolve().is_relative_to(KIT / "build"):
        raise NoCourse(
            f"{course} is inside the kit: nbgrader would write where solution and starter are. "
            "Name a folder outside it, or one in build."
        )
    source = course / "source" / ASSIGNMENT
    if source.exists() and not renew:
        raise NoCourse(
            f"there is an assignment in {source} already. --renew replaces it; "
            "settings, submissions and gradebook stay."
        )
    files = dict(assignment_files(taken))
    if release is not None:
        notebooks = {name: text for name, text in files.items() if name.endswith(".ipynb")}
        files = released_files(release, taken) | notebooks
    shutil.rmtree(source, ignore_errors=True)
    write_tree(files, source)
    for name in SETTINGS:
        if not (course / name).exists():
            text = (INSTRUCTOR / name).read_text(encoding="utf-8")
            text = SHARE.sub(lambda share: share[0] if f"{share[1]}.ipynb" in files else "", text)
            (course / name).write_text(text, encoding="utf-8", newline="\n")
    return sorted(files)


def released_files(release: Path, taken: Course) -> dict[str, bytes]:
    """What students get in an archive of `release`, but for its notebooks.

    Raises NoCourse where it is none, or one that asks for other TODOs.
    """
    files = {}
    try:
        with zipfile.ZipFile(release) as archive:
            for member in archive.infolist():
                _, _, name = member.filename.partition("/")
                if name and not name.startswith((".", f"{NOTEBOOKS}/")):
                    files[name] = archive.read(member)
    except (OSError, zipfile.BadZipFile) as error:
        raise NoCourse(f"{release} is no archive of a release ({error}): make one") from error
    if MANIFEST in files:
        files[MANIFEST] = of_these(files[MANIFEST], files)
    asked = {todo.id for todo in taken.rubric.todos if todo.function}
    sources = [text.decode() for name, text in files.items() if name.endswith(".py")]
    there = {region.id for text in sources for region in regions_in(text)}
    if other := sorted(there ^ asked):
        raise NoCourse(
            f"{release} is not of this course, they differ in TODO {', '.join(other)}: "
            "run make release for it first"
        )
    return files


def of_these(manifest: bytes, files: dict[str, bytes]) -> bytes:
    """The lines of a manifest that are about these files, so that comparing finds them all."""
    rows = manifest.decode().splitlines(keepends=True)
    kept = (row for row in rows if row.startswith("#") or row.rstrip().split("  ", 1)[-1] in files)
    return "".join(kept).encode()


def newest_release(folder: Path) -> Path | None:
    """The archive that students get, as `release` left it in a folder."""
    found = sorted(folder.glob(f"{ASSIGNMENT}-*.zip"), key=lambda path: path.stat().st_mtime)
    return found[-1] if found else None


def assignment_files(taken: Course) -> Iterator[tuple[str, bytes]]:
    """What the source of the assignment holds: the notebooks, and beside them students' files."""
    for name, content in students_tree(KIT, taken).items():
        if not name.startswith("."):
            yield name, content
    yield from notebooks_of(KIT / "solution" / NOTEBOOKS, taken).items()


# ---------------------------------------------------------------- taking submissions in


@dataclass(frozen=True)
class Taken:
    """What became of one student's folder."""

    student: str
    words: str
    taken: bool = True


def collect(folder: Path, course: Path) -> Iterator[Taken]:
    """Copy each student's folder to where nbgrader looks for it.

    No links and nothing hidden is copied. A notebook may lie in the folder `notebooks`, as in the
    starter, or beside the engine. A submission that changed will be autograded anew.
    """
    need_source(course)
    try:
        with opened_class(folder) as intake:
            for found in intake.found:
                try:
                    with laid_out(found) as (path, _):
                        yield take(found.name, path, course)
                except (CannotTake, CannotGrade) as error:
                    yield Taken(found.name, str(error), False)
            for name, words in intake.troubles.items():
                yield Taken(name, words, False)
    except CannotGrade as error:
        raise NoCourse(str(error)) from error


def take(student: str, path: Path, course: Path) -> Taken:
    """Lay one student's files where nbgrader looks for them, if they are not there already."""
    if not NAME.fullmatch(student):
        return Taken(student, "nbgrader cannot work with this name: rename it", False)
    target = course / "submitted" / student / ASSIGNMENT
    with tempfile.TemporaryDirectory() as temporary:
        copy = Path(temporary) / ASSIGNMENT
        notebooks = lay_out(path, copy)
        if target.exists() and same(copy, target):
            return Taken(student, "unchanged")
        shutil.rmtree(target, ignore_errors=True)
        shutil.rmtree(course / "autograded" / student / ASSIGNMENT, ignore_errors=True)
        shutil.copytree(copy, target)
    return Taken(student, f"{notebooks} notebooks" if notebooks else "no notebook")


def lay_out(path: Path, target: Path) -> int:
    """Copy a submission as nbgrader wants it: notebooks on top. Returns how many there are."""
    target.mkdir()
    wanted = {path.name for path in (KIT / "solution" / NOTEBOOKS).glob("*.ipynb")}
    for source in plain_files(path):
        inside = source.relative_to(path)
        if inside.name in wanted and inside.parts[:-1] in ((), (NOTEBOOKS,)):
            inside = Path(inside.name)
        (target / inside).parent.mkdir(parents=True, exist_ok=True)
        try:
            shutil.copyfile(source, target / inside)
        except PermissionError as error:
            raise CannotGrade(unreadable(error, path)) from error
    return sum((target / name).exists() for name in wanted)


def same(one: Path, other: Path) -> bool:
    names = [{p.relative_to(top) for p in top.rglob("*") if p.is_file()} for top in (one, other)]
    if names[0] != names[1]:
        return False
    return all(filecmp.cmp(one / name, other / name, shallow=False) for name in names[0])


def need_source(course: Path) -> None:
    if not (course / "source" / ASSIGNMENT).is_dir():
        raise NoCourse(
            f"{course} is no course yet: make it with python -m grader nbgrader course {course}"
        )


# ---------------------------------------------------------------- grading what was taken in


def grade_submitted(course: Path, options: Options, jobs: int, console: Console) -> list[str]:
    """Grade every engine in `submitted`; a result file each in `results`. Returns the troubles."""
    found = sorted((course / "submitted").glob(f"*/{ASSIGNMENT}"))
    if not found:
        raise NoCourse(f"there is nothing in {course / 'submitted'}: collect submissions first")
    intake = Intake([Found(path.parent.name, (path,)) for path in found])
    results = course / "results"
    for path in results.glob("*.json"):
        if path.stem not in {each.name for each in intake.found}:
            path.unlink()  # none may outlive its submission
    with Pool(options, jobs) as pool:
        run = grade_class(intake, results, key_of(options), pool, console)
    return [f"{each.name}: {each.trouble}" for each in run.outcomes if each.trouble]
