"""Mark answers on paper: a table of answers in, tables of points out.

An unreadable answer never counts as 0 silently: it has no points and a note with the reason.
"""

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import msgspec

from grader.intake.names import fold
from grader.judge.submission import CannotGrade
from grader.questions.question import (
    Question,
    Sheet,
    Unreadable,
    find_misunderstanding,
    grade_answer,
)
from grader.report.files import write_whole
from grader.text import escape_formula, format_csv, plural

COLUMNS = ("student", "question", "answer")
BY_HAND = "points"  # optional column: points given by a person


@dataclass(frozen=True)
class GivenAnswer:
    line: int
    student: str
    question: str
    answer: str
    by_hand: str


@dataclass(frozen=True)
class Mark:
    """The points of one answer; None if not marked yet."""

    student: str
    number: int
    question: Question
    answer: str
    points: int | None
    note: str = ""


class Total(NamedTuple):
    """The points of one sheet, its maximum, and the number of answers not marked yet."""

    student: str
    points: int
    max_points: int
    waiting: int


@dataclass(frozen=True)
class Marking:
    marks: list[Mark]
    notes: list[str]  # lines that match no student
    silent: list[str]  # students with a sheet and no answer in the table

    @property
    def totals(self) -> list[Total]:
        """Return the points of each student who has a question; marks are in their order."""
        by_student = groupby(self.marks, key=lambda each: each.student)
        return [sum_points(student, list(marks)) for student, marks in by_student]


def mark_answers(table: Path, keys: Path) -> Marking:
    """Mark a table of answers with the keys in a folder; raises CannotGrade without keys."""
    sheets = read_keys(keys)
    if not sheets:
        raise CannotGrade(f"there are no keys in {keys}: name the folder of the sheets with --out")
    given, notes = sort_answers(read_answers(table), sheets)
    marks = [
        mark_question(sheet.student, number, question, given.get((sheet.student, number)))
        for sheet in sheets
        for number, question in enumerate(sheet.questions, 1)
    ]
    heard = {name for name, _ in given}
    silent = [each.student for each in sheets if each.questions and each.student not in heard]
    notes += [f"no answer of {name} is in the table" for name in silent]
    return Marking(marks, notes, silent)


def read_keys(folder: Path) -> list[Sheet]:
    """Read the sheets with their answers, by student."""
    try:
        texts = [path.read_bytes() for path in sorted(folder.glob("*.json"))]
        return [msgspec.json.decode(text, type=Sheet) for text in texts]
    except (OSError, msgspec.DecodeError) as error:
        raise CannotGrade(f"the keys in {folder} cannot be read: {error}") from error


def read_answers(table: Path) -> list[GivenAnswer]:
    """Read the lines of the table, with any separator between columns."""
    try:
        text = table.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise CannotGrade(f"{table} cannot be read as a table in UTF-8: {error}") from error
    head = text.partition("\n")[0]
    rows = csv.reader(io.StringIO(text), delimiter=";" if ";" in head else ",")
    names = [fold(each) for each in next(rows, [])]
    if missing := [each for each in COLUMNS if each not in names]:
        raise CannotGrade(
            f"{table} has no column {missing[0]}: its first line must be student,question,answer"
        )
    found = []
    for row in rows:
        cells = dict(zip(names, row, strict=False))
        if any(each.strip() for each in row):
            student, question, answer = (cells.get(each, "").strip() for each in COLUMNS)
            by_hand = cells.get(BY_HAND, "").strip()
            found.append(GivenAnswer(rows.line_num, student, question, answer, by_hand))
    return found


def sort_answers(
    lines: Iterable[GivenAnswer], sheets: Iterable[Sheet]
) -> tuple[dict[tuple[str, int], GivenAnswer], list[str]]:
    """Return the answers by student and number, and a note on each line that fits no sheet."""
    named, found = index_names(sheets), dict[tuple[str, int], GivenAnswer]()
    notes = []
    for each in lines:
        owners = named.get(fold(each.student), [])
        digits = each.question.removeprefix("q").removeprefix("Q").rstrip(".")
        number = int(digits) if digits.isdecimal() and len(digits) < 4 else 0
        if len(owners) != 1:
            names = " or ".join(owner.student for owner in owners)
            words = f"write {names}" if owners else "there is no sheet of that name"
            notes.append(f"line {each.line}: {each.student!r}: {words}")
        elif not 1 <= number <= len(owners[0].questions):
            there = plural(len(owners[0].questions), "question")
            notes.append(f"line {each.line}: {each.student} has {there}, and no {each.question!r}")
        elif (owners[0].student, number) in found:
            notes.append(f"line {each.line}: {each.student} answered question {number} above")
        else:
            found[owners[0].student, number] = each
    return found, notes


def index_names(sheets: Iterable[Sheet]) -> dict[str, list[Sheet]]:
    """Return the sheets by their student's names; two students may share a full name."""
    named: dict[str, list[Sheet]] = {}
    for sheet in sheets:
        for name in {fold(each) for each in (sheet.student, sheet.label, sheet.full_name)} - {""}:
            named.setdefault(name, []).append(sheet)
    return named


def mark_question(student: str, number: int, question: Question, given: GivenAnswer | None) -> Mark:
    """Mark one question; an empty answer has no points, and a note."""
    if given is None or not (given.answer or given.by_hand):
        return Mark(student, number, question, "", 0, "no answer")
    return Mark(student, number, question, given.answer, *mark_answer(question, given))


def mark_answer(question: Question, given: GivenAnswer) -> tuple[int | None, str]:
    """Return the points, or None, and a note."""
    if question.by_hand:
        if given.by_hand.isdecimal() and int(given.by_hand) <= question.points:
            return int(given.by_hand), ""
        return None, f"needs manual marking: 0 to {question.points} in the column {BY_HAND}"
    try:
        points = grade_answer(question, given.answer)
    except Unreadable as error:
        return None, f"not read: {error}"
    return points, find_misunderstanding(question, given.answer)


def write_points(marked: Marking, out: Path) -> tuple[Path, Path]:
    """Write a table of all answers, and a table of students."""
    answers, totals = out / "points.csv", out / "totals.csv"
    titles = ("student", "question", "kind", "about", "answer", "points", "out of", "note")
    rows = [
        (
            each.student,
            each.number,
            each.question.kind,
            " ".join(each.question.todos),
            each.answer,
            "" if each.points is None else each.points,
            each.question.points,
            each.note,
        )
        for each in marked.marks
    ]
    write_whole(encode_table([titles, *rows]), answers)
    head = ("student", "points", "out of", "open")
    write_whole(encode_table([head, *marked.totals]), totals)
    return answers, totals


def sum_points(student: str, marks: Sequence[Mark]) -> Total:
    """Return the total of one student's marks."""
    points = sum(each.points or 0 for each in marks)
    waiting = sum(each.points is None for each in marks)
    return Total(student, points, sum(each.question.points for each in marks), waiting)


def is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def encode_table(rows: Iterable[Sequence[object]]) -> bytes:
    """Return the table without text that a spreadsheet would run; negative numbers stay."""
    return format_csv(
        rows,
        line_end="\n",
        escape=lambda cell: cell if is_number(cell) else escape_formula(cell),
    ).encode("utf-8")
