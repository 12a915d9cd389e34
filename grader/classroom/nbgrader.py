"""nbgrader: a course folder, submissions taken into it, and the grader's marks in its gradebook.

nbgrader runs notebooks; it does not confine them. The engine is graded outside, by the judge, and
only its points are written into the gradebook, in the cells of the notebook `engine`.
"""

import filecmp
import re
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import msgspec
from rich.console import Console

from grader import words
from grader.judge.grade import KIT, Options
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.submission import CannotGrade, plain_files
from grader.maintain.sync import students_files

ASSIGNMENT = "physics-engine"
ENGINE = "engine"  # the notebook that holds a cell for each TODO
NOTEBOOKS = "notebooks"  # the folder of both trees
INSTRUCTOR = KIT / "handouts" / "instructor"
SETTINGS = ("nbgrader_config.py", "marks.toml")
NAME = re.compile(r"[^\s*?\[\]/\\.][^*?\[\]/\\]*")  # nbgrader looks students up with such patterns


class NoCourse(Exception):
    """The course folder is not ready for this; the message says why and what to do."""


# ---------------------------------------------------------------- making a course


def make_course(course: Path, renew: bool = False) -> list[str]:
    """Make the folder in which nbgrader's commands run; returns the assignment's files.

    The source holds the students' Python files, no TODO of them done: nbgrader releases whatever
    lies beside the notebooks.
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
    shutil.rmtree(source, ignore_errors=True)
    files = dict(assignment_files())
    for name, path in files.items():
        target = source / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target)
    for name in SETTINGS:
        if not (course / name).exists():
            shutil.copyfile(INSTRUCTOR / name, course / name)
    return sorted(files)


def assignment_files() -> Iterator[tuple[str, Path]]:
    """What the source of the assignment holds: the notebooks, and beside them students' files."""
    for name, path in students_files(KIT).items():
        if not name.startswith("."):
            yield name, path
    for path in sorted((KIT / "solution" / NOTEBOOKS).glob("*.ipynb")):
        yield path.name, path


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
    # Imported here: taking in reads class lists, and these import this module.
    from grader.classroom.intake import CannotTake, laid_out, opened_class

    need_source(course)
    try:
        with opened_class(folder) as intake:
            for found in intake.found:
                try:
                    with laid_out(found) as (path, _):
                        yield take(found.name, path, course)
                except CannotTake as error:
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
    wanted = {name for name, _ in assignment_files() if name.endswith(".ipynb")}
    for source in plain_files(path):
        inside = source.relative_to(path)
        if inside.name in wanted and inside.parts[:-1] in ((), (NOTEBOOKS,)):
            inside = Path(inside.name)
        (target / inside).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target / inside)
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
    # Imported here: taking in reads class lists, and these import this module.
    from grader.classroom.batch import Pool, grade_class, key_of
    from grader.classroom.intake import Found, Intake

    intake = Intake([Found(path.parent.name, (path,)) for path in found])
    results = course / "results"
    for path in results.glob("*.json"):
        if path.stem not in {each.name for each in intake.found}:
            path.unlink()  # none may outlive its submission
    with Pool(options, jobs) as pool:
        run = grade_class(intake, results, key_of(options), pool, console)
    return [f"{each.name}: {each.trouble}" for each in run.outcomes if each.trouble]


# ---------------------------------------------------------------- marks into the gradebook


@dataclass(frozen=True)
class Filled:
    """What the gradebook holds for one student's engine now."""

    student: str
    points: float
    max_points: float
    notes: tuple[str, ...] = ()


def read_results(paths: Iterable[Path]) -> Iterator[tuple[str, Result | str]]:
    """The results in files, or in folders of files, each named after its student.

    What is no result comes as a sentence that says so.
    """
    for path in paths:
        for file in sorted(path.glob("*.json")) if path.is_dir() else [path]:
            try:
                yield file.stem, msgspec.json.decode(file.read_bytes(), type=Result)
            except (OSError, msgspec.MsgspecError) as error:
                yield file.stem, f"{file} is no result of the grader ({error})"


def fill(course: Path, results: Iterable[tuple[str, Result | str]]) -> Iterator[Filled | str]:
    """Write results into the gradebook, a student at a time; troubles come as sentences.

    Points are clamped to what the cell is worth and missing ones are 0, so nothing but a passed
    check earns any. Doing it again changes nothing. A mark given by hand stays and counts.
    """
    api = nbgrader_api()
    with opened(course, api) as book:
        cells = engine_cells(book, api)
        known = {student.id for student in book.students}
        known |= {path.parent.name for path in (course / "submitted").glob(f"*/{ASSIGNMENT}")}
        done = set()
        for student, result in results:
            if isinstance(result, str):
                yield result
            elif student not in known:
                yield (
                    f"{student}: nobody of this name handed in or is in the gradebook. "
                    "A result's file must be named after its student."
                )
            else:
                done.add(student)
                yield fill_one(book, api, cells, student, result)
        for submission in book.assignment_submissions(ASSIGNMENT):
            if submission.student.id not in done and ungraded(book, cells, submission.student.id):
                for cell in cells:
                    write_mark(book, cell, submission.student.id, None)
                yield f"{submission.student.id}: no result, so 0 points for the engine until then"


def fill_one(book: Any, api: ModuleType, cells: list[Any], student: str, result: Result) -> Filled:
    """Write one student's points and the reasons for missing ones."""
    book.update_or_create_student(student)
    try:
        book.find_submission(ASSIGNMENT, student)
    except api.MissingEntry:
        nothing_but_the_engine(book, student)
    todos = {f"todo-{todo.id}": todo for todo in result.todos}
    notes = []
    for cell in cells:
        todo = todos.get(cell.name)
        if todo is None:
            notes.append(f"{cell.name}: not in the result, so 0 points")
        elif todo.max_points != cell.max_score:
            notes.append(f"{cell.name}: {todo.max_points} points here, {cell.max_score:g} there")
        if write_mark(book, cell, student, todo):
            notes.append(f"{cell.name}: a mark given by hand counts instead")
    extra = {f"todo-{todo.id}" for todo in result.counted} - {cell.name for cell in cells}
    notes += [f"{name}: no such cell in the notebook" for name in sorted(extra)]
    notebook = book.find_submission_notebook(ENGINE, ASSIGNMENT, student)
    return Filled(student, notebook.score, notebook.max_score, tuple(notes))


def nothing_but_the_engine(book: Any, student: str) -> None:
    """A submission without notebooks, which nbgrader passes over: nothing waits to be graded."""
    for notebook in book.add_submission(ASSIGNMENT, student).notebooks:
        for grade in notebook.grades:
            grade.auto_score, grade.needs_manual_grade = 0, False
    book.db.commit()


def write_mark(book: Any, cell: Any, student: str, todo: TodoResult | None) -> bool:
    """Write the points of one TODO; returns whether a mark given by hand overrides them."""
    grade = book.find_grade(cell.name, ENGINE, ASSIGNMENT, student)
    points = float(min(max(todo.points if todo else 0, 0), cell.max_score))
    by_hand = grade.manual_score is not None
    if grade.auto_score != points:
        grade.auto_score, grade.needs_manual_grade = points, by_hand
    elif not by_hand:
        grade.needs_manual_grade = False
    comment = book.find_comment(cell.name, ENGINE, ASSIGNMENT, student)
    comment.auto_comment = reasons(todo) if todo else "    not graded yet"
    book.db.commit()
    return by_hand


def ungraded(book: Any, cells: list[Any], student: str) -> bool:
    grades = [book.find_grade(cell.name, ENGINE, ASSIGNMENT, student) for cell in cells]
    return any(grade.auto_score is None for grade in grades)


def reasons(todo: TodoResult) -> str:
    """The comment that feedback shows: indented, so that nothing in it is taken for markup."""
    lines = [f"{todo.state}: {todo.points} / {todo.max_points}"]
    for check in todo.checks:
        if check.state != "passed":
            lines += reason(check)
    return "\n".join(f"    {line}" for line in lines)


def reason(check: CheckResult) -> list[str]:
    told = [f"  {line}" for line in words.reasons(check)]
    return [f"{check.title} ({check.points} / {check.max_points})", *told]


def engine_cells(book: Any, api: ModuleType) -> list[Any]:
    """The cells that take the grader's marks, in the order of the notebook."""
    try:
        cells = book.find_notebook(ENGINE, ASSIGNMENT).task_cells
    except api.MissingEntry:
        cells = []
    if not cells:
        raise NoCourse(
            f"the gradebook knows no notebook {ENGINE}: in the course folder, run "
            f"nbgrader generate_assignment {ASSIGNMENT}"
        )
    return sorted(cells, key=lambda cell: str(cell.name))


def opened(course: Path, api: ModuleType) -> Any:
    """The course's gradebook; nbgrader would make an empty one where there is none."""
    path = course.resolve() / "gradebook.db"
    if not path.exists():
        raise NoCourse(
            f"there is no gradebook at {path}: in the course folder, run "
            f"nbgrader generate_assignment {ASSIGNMENT}"
        )
    return api.Gradebook(f"sqlite:///{path}")


def nbgrader_api() -> ModuleType:
    try:
        import nbgrader.api
    except ImportError as error:
        raise NoCourse(
            "nbgrader is not installed here: python -m pip install nbgrader matplotlib"
        ) from error
    api: ModuleType = nbgrader.api
    return api
