"""Write marks into the class list of a learning system, one per student, from all parts.

marks.toml has the shares of the parts. No name or identifier becomes a formula in a spreadsheet.
"""

import re
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from decimal import ROUND_HALF_UP, Decimal
from pathlib import Path
from typing import Annotated, Any

import msgspec
from msgspec import Meta, Struct

from grader.classroom.book import NOTHING, Outcome
from grader.classroom.owners import Owners, find_owners
from grader.errors import Stop
from grader.intake.lms import Lms, MarkColumn, MarkRow
from grader.intake.roster import Roster, Row
from grader.intake.systems import find_system
from grader.judge.course import FULL, Course
from grader.text import clean, format_csv

USUAL_TOTAL = 100  # maximum of marks, if a course has none
ENGINE = "engine"  # the part that the checks grade, and the name of its notebook
SHEET = "questions"  # the part about the student's own program
WITH_ID = re.compile(r" \(\d+\)$")  # of a title in Canvas


class Marking(Struct, frozen=True, forbid_unknown_fields=True):
    """The settings in marks.toml."""

    title: str
    shares: dict[str, Annotated[float, Meta(ge=0, lt=1e9)]]
    total: Annotated[float, Meta(gt=0)] = USUAL_TOTAL
    decimals: Annotated[int, Meta(ge=0, le=6)] = 1
    absent: int | float | str = 0


@dataclass(frozen=True)
class Part:
    points: float
    max_points: float
    waiting: bool = False  # for manual grading
    note: str = ""  # why these points
    handed_in: bool = True  # a person may set points for students who handed in nothing


Parts = dict[str, Part]


def load_marking(path: Path | None, course: Course = FULL) -> Marking:
    """Read the settings; title and total default to the course's.

    Without a file the engine is the only part. Raises Stop if the file is missing or invalid.
    """
    usual: dict[str, Any] = {"title": course.title, "total": course.out_of or USUAL_TOTAL}
    if path is None:
        return Marking(shares={ENGINE: 1}, **usual)
    try:
        document = tomllib.loads(path.read_text(encoding="utf-8"))
        marking = msgspec.convert(usual | document, Marking)
    except OSError as error:
        raise Stop(f"there is no {path}: it says what each part is worth") from error
    except (msgspec.MsgspecError, ValueError) as error:
        raise Stop(f"{path}: {error}") from error
    if not sum(marking.shares.values()):
        raise Stop(f"{path}: all shares are 0: give one part a share above 0")
    return marking


def mark_engine(path: Path | None, course: Course) -> Marking:
    """Return the settings for results, which hold the engine alone."""
    return msgspec.structs.replace(load_marking(path, course), shares={ENGINE: 1})


def compare_totals(marking: Marking, course: Course) -> Iterator[str]:
    """Yield a note if marks have another maximum than the students' pages."""
    total = course.out_of or USUAL_TOTAL
    if marking.total != total:
        pages = f"the students' pages count to {total:g}"
        yield f"these marks count to {marking.total:g}, and {pages}: set out_of in the course"


def compute_mark(parts: Parts, marking: Marking) -> str:
    """Return one mark from all parts; a missing part counts as 0."""
    share = sum(
        weight * parts[name].points / parts[name].max_points
        for name, weight in marking.shares.items()
        if name in parts and parts[name].max_points > 0
    )
    mark = Decimal(marking.total * share / sum(marking.shares.values()))
    # binary fractions must not decide which way to round
    mark = mark.quantize(Decimal("1e-9"))
    return str(mark.quantize(Decimal(1).scaleb(-marking.decimals), ROUND_HALF_UP))


def make_parts(outcomes: Iterable[Outcome]) -> dict[str, Parts]:
    """Return the engine as the only part, with the decisions as its note.

    Ungraded work needs manual review, unless a person has set its points.
    """
    made = {}
    for each in outcomes:
        waiting, handed_in = each.mark is None, each.trouble != NOTHING
        part = Part(each.final, each.max_points, waiting, each.explain(), handed_in)
        made[each.name] = {ENGINE: part}
    return made


@dataclass
class Marks:
    """A file for the learning system, and notes on it."""

    owners: Owners
    text: str = ""
    encoding: str = "utf-8"
    rows: list[MarkRow] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    unowned: list[str] = field(default_factory=list)  # possible owners of work without an owner

    @property
    def given(self) -> int:
        return sum(each.mark != "" for each in self.rows)


@dataclass(frozen=True)
class Scores:
    """The parts of all students, by the names of their results, and the settings of marks."""

    parts: dict[str, Parts]
    marking: Marking
    so_far: bool = False  # parts that need manual grading count as 0
    others_known: bool = False  # work without an owner belongs to no student of the class list
    of_sheets: bool = False  # another assignment, for each student alone

    @property
    def missing(self) -> str:
        """Return the note on a student without work."""
        return "no answers to a sheet" if self.of_sheets else "nothing handed in"

    @property
    def absent(self) -> list[str]:
        """Return the students who do not share their group's points."""
        by_name = self.parts.items()
        if self.of_sheets:
            return [*self.parts]
        return [name for name, parts in by_name if not any(p.handed_in for p in parts.values())]


def score_sheets(
    totals: Iterable[tuple[str, int, int, int]], course: Course, decimals: int
) -> Scores:
    """Return the points of the sheets of questions, in a column of their own.

    Each total is a student, points, the maximum, and the number of answers not marked yet. Sheets
    differ in their maximum, so a mark is the same share of the points of a whole sheet.
    """
    parts = {
        student: {SHEET: Part(points, most, bool(waiting))}
        for student, points, most, waiting in totals
    }
    title = f"{WITH_ID.sub('', course.title)} {SHEET}"
    marking = Marking(title, {SHEET: 1}, course.questions.most_points, decimals, "")
    return Scores(parts, marking, of_sheets=True)


def make_marks(roster: Roster, key: str, scores: Scores) -> Marks:
    """Return the class list with a mark for each student.

    A mark that needs manual review stays empty, unless `so_far`. A row stays empty if
    several results fit it, so that no student gets a wrong mark. While some work has no
    owner, rows without work stay empty too, unless `others_known`.
    """
    marking = scores.marking
    owners = find_owners(roster, key, scores.parts, scores.absent)
    made = Marks(owners)
    for row in roster.rows:
        made.rows.append(mark_row(row, row[key], scores, made))
    for student in sorted(owners.strangers):
        made.notes.append(f"{student}: handed in, but is not in the class list under {key!r}")
    if made.unowned:
        made.notes.append(
            f"{', '.join(made.unowned)}: no mark, since work without an owner may be theirs: name "
            "its owner in a column Called, or use --others-known if no student here owns it"
        )
    lms = find_system(roster)
    if scores.of_sheets:
        lms = lms.for_other_assignments()
    if above := [each.row[key] for each in made.rows if is_above(each.mark, marking.total)]:
        made.notes.append(lms.warn_above(", ".join(above), marking.total))
    worth = read_total(roster, marking.title, lms)
    if worth is not None and worth != marking.total:
        words = f"{roster.path} counts to {worth:g} there, these marks to {marking.total:g}"
        made.notes.append(words)
    table = lms.make_table(roster, MarkColumn(marking.title, marking.total, key, made.rows))
    made.text = roster.mark + format_csv(table, "," if lms.only_commas else roster.delimiter)
    made.encoding = "utf-8" if lms.only_commas else roster.encoding
    return made


def mark_row(row: Row, student: str, scores: Scores, made: Marks) -> MarkRow:
    """Return a student's values, and add notes to `made`."""
    owners = made.owners
    results = owners.find_results(row)
    if row in owners.doubtful or len(results) > 1:
        names = results or [name for name, rows in owners.doubts.items() if row in rows]
        words = f"no mark, {' and '.join(names)} could be theirs: see by hand"
        made.notes.append(f"{student}: {words}")
        return MarkRow(row)
    if results:
        parts, marking = scores.parts[results[0]], scores.marking
        waiting = [name for name in marking.shares if name in parts and parts[name].waiting]
        if waiting and not scores.so_far:
            words = f"no mark yet, needs manual review: {', '.join(waiting)}"
            made.notes.append(f"{student}: {words}")
        if mates := owners.mates.get(id(row)):
            made.notes.append(f"{student}: the mark of {' and '.join(mates)}, of the same group")
        mark = "" if waiting and not scores.so_far else compute_mark(parts, marking)
        return MarkRow(row, mark, summarize(parts, marking))
    if owners.strangers and not scores.others_known:
        made.unowned.append(student)
        return MarkRow(row)
    made.notes.append(f"{student}: {scores.missing}")
    return MarkRow(row, str(scores.marking.absent), scores.missing)


def summarize(parts: Parts, marking: Marking) -> str:
    """Return the parts of the mark in words, for the column of feedback."""
    return "; ".join(
        (
            f"{name} not graded"
            if parts[name].waiting and not parts[name].max_points
            else f"{name} {parts[name].points:g} / {parts[name].max_points:g}"
        )
        + f" ({clean(parts[name].note)})" * bool(parts[name].note)
        for name in marking.shares
        if name in parts
    )


def read_total(roster: Roster, title: str, lms: Lms | None = None) -> float | None:
    """Return the maximum in the gradebook; None if it has none."""
    try:
        total = (lms or find_system(roster)).find_total(roster, title)
        return float(total.replace(",", ".")) if total else None  # with a decimal comma
    except ValueError:
        return None


def is_above(mark: str, total: float) -> bool:
    try:
        return float(mark) > total
    except ValueError:  # empty, or a word for students who handed in nothing
        return False
