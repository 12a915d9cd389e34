"""The gradebook: the engine's marks go in, what everybody has in every notebook comes out."""

import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import msgspec

from grader.classroom.marks import ENGINE, Marking, Part, Parts
from grader.classroom.nbgrader.submissions import ASSIGNMENT, NoCourse
from grader.intake.names import folded, names_of
from grader.intake.roster import CannotRead, Roster, people
from grader.judge import wording as words
from grader.judge.result import CheckResult, Result, TodoResult

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
                    book.find_grade(
                        cell.name, ENGINE, ASSIGNMENT, submission.student.id
                    ).needs_manual_grade = True
                book.db.commit()
                yield f"{submission.student.id}: no result, so the engine waits for a person"


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


# ---------------------------------------------------------------- marks out of the gradebook


def parts_from_gradebook(course: Path, marking: Marking) -> dict[str, Parts]:
    """What everybody has in every notebook, late penalties taken off."""
    api = nbgrader_api()
    found: dict[str, Parts] = {}
    with opened(course, api) as book:
        try:
            notebooks = {notebook.name for notebook in book.find_assignment(ASSIGNMENT).notebooks}
        except api.MissingEntry as error:
            raise NoCourse(f"the gradebook knows no assignment {ASSIGNMENT}") from error
        unknown = sorted(set(marking.shares) - notebooks)
        if unknown:
            raise CannotRead(f"shares: there is no notebook {', '.join(unknown)} in the gradebook")
        for submission in book.assignment_submissions(ASSIGNMENT):
            found[submission.student.id] = {
                notebook.name: Part(
                    max(notebook.score - (notebook.late_submission_penalty or 0), 0),
                    notebook.max_score,
                    notebook.needs_manual_grade,
                )
                for notebook in submission.notebooks
            }
    return found


def tell_names(course: Path, roster: Roster, key: str) -> None:
    """Give the students in the gradebook the names of a class list; those not in it are added."""
    with opened(course, nbgrader_api()) as book:
        known = {folded(student.id): student.id for student in book.students}
        for person in people(roster, key):
            name = person.pop("id")
            name = next((known[each] for each in names_of(name) if each in known), name)
            book.update_or_create_student(name, **person)


# ---------------------------------------------------------------- the gradebook itself


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


@contextmanager
def opened(course: Path, api: ModuleType) -> Iterator[Any]:
    """The course's gradebook; nbgrader would make an empty one where there is none.

    Its libraries warn of what nbgrader does inside them: nothing that a person could mend here.
    """
    path = course.resolve() / "gradebook.db"
    if not path.exists():
        raise NoCourse(
            f"there is no gradebook at {path}: in the course folder, run "
            f"nbgrader generate_assignment {ASSIGNMENT}"
        )
    with (
        warnings.catch_warnings(action="ignore"),
        api.Gradebook(f"sqlite:///{path}") as book,
    ):
        yield book


def nbgrader_api() -> ModuleType:
    try:
        import nbgrader.api
    except ImportError as error:
        raise NoCourse(
            "nbgrader is not installed here: python -m pip install nbgrader matplotlib"
        ) from error
    api: ModuleType = nbgrader.api
    return api
