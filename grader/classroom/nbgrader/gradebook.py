"""Write the engine's marks into the gradebook, and read all points of all notebooks."""

import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from grader.classroom.marks import ENGINE, Marking, Part, Parts
from grader.classroom.nbgrader.submissions import ASSIGNMENT
from grader.errors import Stop
from grader.intake.names import fold, split_login
from grader.intake.roster import Roster, list_people
from grader.judge.result import Result, TodoResult
from grader.judge.wording import format_reasons
from grader.report.files import read_result


@dataclass(frozen=True)
class EngineMark:
    """The points of a student's engine in the gradebook, and notes on them."""

    student: str
    points: float
    max_points: float
    notes: tuple[str, ...] = ()


def read_results(paths: Iterable[Path]) -> Iterator[tuple[str, Result | str]]:
    """Yield each student and the result, or a sentence if it is invalid."""
    for path in paths:
        for file in sorted(path.glob("*.json")) if path.is_dir() else [path]:
            try:
                yield file.stem, read_result(file)
            except Stop as error:
                yield file.stem, str(error)


def fill_gradebook(
    course: Path, results: Iterable[tuple[str, Result | str]]
) -> Iterator[EngineMark | str]:
    """Write results into the gradebook, a student at a time; troubles come as sentences.

    Points are clamped to the cell's maximum and missing ones are 0, so only passed checks earn any.
    Doing it again changes nothing. A mark given by hand stays and counts.
    """
    api = load_nbgrader()
    with open_gradebook(course, api) as book:
        cells = find_engine_cells(book, api)
        students = {student.id for student in book.students}
        students |= {path.parent.name for path in (course / "submitted").glob(f"*/{ASSIGNMENT}")}
        done = set()
        for student, result in results:
            if isinstance(result, str):
                yield result
            elif student not in students:
                yield (
                    f"{student}: no submission and no student in the gradebook has this name: "
                    "name a result's file after its student"
                )
            else:
                done.add(student)
                if not has_submission(book, api, student):
                    add_empty_submission(book, student)
                yield write_marks(book, cells, student, result)
        for student in sorted(
            {s.student.id for s in book.assignment_submissions(ASSIGNMENT)} - done
        ):
            if await_result(book, cells, student):
                yield f"{student}: no result, so the engine needs manual grading"


def has_submission(book: Any, api: ModuleType, student: str) -> bool:
    book.update_or_create_student(student)
    try:
        book.find_submission(ASSIGNMENT, student)
    except api.MissingEntry:
        return False
    return True


def write_marks(book: Any, cells: list[Any], student: str, result: Result) -> EngineMark:
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
    extra = {f"todo-{todo.id}" for todo in result.main_todos} - {cell.name for cell in cells}
    notes += [f"{name}: no such cell in the notebook" for name in sorted(extra)]
    notebook = book.find_submission_notebook(ENGINE, ASSIGNMENT, student)
    return EngineMark(student, notebook.score, notebook.max_score, tuple(notes))


def add_empty_submission(book: Any, student: str) -> None:
    """Add a submission without notebooks, which nbgrader does not grade."""
    for notebook in book.add_submission(ASSIGNMENT, student).notebooks:
        for grade in notebook.grades:
            grade.auto_score, grade.needs_manual_grade = 0, False
    book.db.commit()


def write_mark(book: Any, cell: Any, student: str, todo: TodoResult | None) -> bool:
    """Write the points of one TODO; return whether a mark given by hand overrides them."""
    grade = book.find_grade(cell.name, ENGINE, ASSIGNMENT, student)
    points = float(min(max(todo.points if todo else 0, 0), cell.max_score))
    by_hand = grade.manual_score is not None
    if grade.auto_score != points:
        grade.auto_score, grade.needs_manual_grade = points, by_hand
    elif not by_hand:
        grade.needs_manual_grade = False
    comment = book.find_comment(cell.name, ENGINE, ASSIGNMENT, student)
    comment.auto_comment = write_comment(todo) if todo else "    not graded yet"
    book.db.commit()
    return by_hand


def await_result(book: Any, cells: list[Any], student: str) -> bool:
    """Mark an engine for manual grading if it is ungraded; return whether it is."""
    grades = [book.find_grade(cell.name, ENGINE, ASSIGNMENT, student) for cell in cells]
    if all(grade.auto_score is not None for grade in grades):
        return False
    for cell, grade in zip(cells, grades, strict=True):
        write_mark(book, cell, student, None)
        grade.needs_manual_grade = True
    book.db.commit()
    return True


def write_comment(todo: TodoResult) -> str:
    """Return the comment for feedback, indented so that it contains no markup."""
    lines = [f"{todo.state}: {todo.points} / {todo.max_points}"]
    for check in todo.checks:
        if check.state != "passed":
            lines.append(f"{check.title} ({check.points} / {check.max_points})")
            lines += [f"  {line}" for line in format_reasons(check)]
    return "\n".join(f"    {line}" for line in lines)


# ---------------------------------------------------------------- marks out of the gradebook


def read_parts(course: Path, marking: Marking) -> dict[str, Parts]:
    """Return the points of all students in all notebooks, less late penalties."""
    api = load_nbgrader()
    found: dict[str, Parts] = {}
    with open_gradebook(course, api) as book:
        try:
            notebooks = {notebook.name for notebook in book.find_assignment(ASSIGNMENT).notebooks}
        except api.MissingEntry as error:
            raise Stop(f"the gradebook knows no assignment {ASSIGNMENT}") from error
        unknown = sorted(set(marking.shares) - notebooks)
        if unknown:
            raise Stop(f"shares: there is no notebook {', '.join(unknown)} in the gradebook")
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


def write_names(course: Path, roster: Roster, key: str) -> None:
    """Give students in the gradebook the names of a class list, and add missing students."""
    with open_gradebook(course, load_nbgrader()) as book:
        ids = {fold(student.id): student.id for student in book.students}
        for person in list_people(roster, key):
            name = person.pop("id")
            name = next((ids[each] for each in split_login(name) if each in ids), name)
            book.update_or_create_student(name, **person)


# ---------------------------------------------------------------- the gradebook itself


def find_engine_cells(book: Any, api: ModuleType) -> list[Any]:
    try:
        cells = book.find_notebook(ENGINE, ASSIGNMENT).task_cells
    except api.MissingEntry:
        cells = []
    if not cells:
        raise Stop(
            f"the gradebook knows no notebook {ENGINE}: in the course folder, run "
            f"nbgrader generate_assignment {ASSIGNMENT}"
        )
    return sorted(cells, key=lambda cell: str(cell.name))


@contextmanager
def open_gradebook(course: Path, api: ModuleType) -> Iterator[Any]:
    """Open the course's gradebook; nbgrader would make a missing one.

    Hide warnings of its libraries about nbgrader's own code.
    """
    path = course.resolve() / "gradebook.db"
    if not path.exists():
        raise Stop(
            f"there is no gradebook at {path}: in the course folder, run "
            f"nbgrader generate_assignment {ASSIGNMENT}"
        )
    with (
        warnings.catch_warnings(action="ignore"),
        api.Gradebook(f"sqlite:///{path}") as book,
    ):
        yield book


def load_nbgrader() -> ModuleType:
    try:
        return import_module("nbgrader.api")
    except ImportError as error:
        raise Stop(
            "nbgrader is not installed here: python -m pip install nbgrader matplotlib"
        ) from error
