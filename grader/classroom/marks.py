"""Marks for the LMS: one per student, from the parts of the assignment, into its class list.

The shares of the parts are in marks.toml. Names and identifiers are written as they came, but never
so that a spreadsheet would run them.
"""

import csv
import io
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.classroom.book import Outcome
from grader.classroom.names import folded, names_of
from grader.classroom.roster import CANVAS, MOODLE, POINTS_POSSIBLE, CannotRead, Roster
from grader.judge.course import FULL, Course
from grader.report.sinks.tables import harmless
from grader.words import clean

ENGINE = "engine"  # the part that the checks grade; it is also the notebook of that name


# ---------------------------------------------------------------- how marks are made


class Marking(Struct, frozen=True, forbid_unknown_fields=True):
    """marks.toml."""

    title: str
    shares: dict[str, float]
    total: float = 100
    decimals: int = 1
    absent: int | float | str = 0


@dataclass(frozen=True)
class Part:
    """What a student has in one notebook."""

    points: float
    max_points: float
    waiting: bool = False  # for a person to grade it
    note: str = ""  # why these points


Parts = dict[str, Part]


def load_marking(path: Path, course: Course = FULL) -> Marking:
    """The settings; a title and a total that they do not name are the course's."""
    usual = {"title": course.title, "total": course.out_of or 100}
    try:
        document = tomllib.loads(path.read_text(encoding="utf-8"))
        marking = msgspec.convert(usual | document, Marking)
    except OSError as error:
        raise CannotRead(f"there is no {path}: it says what each part is worth") from error
    except (msgspec.MsgspecError, ValueError) as error:
        raise CannotRead(f"{path}: {error}") from error
    wrong = [f"{name} = {share}" for name, share in marking.shares.items() if not 0 <= share < 1e9]
    if wrong or not sum(marking.shares.values()):
        raise CannotRead(f"{path}: shares must be 0 or more, and not all 0 ({', '.join(wrong)})")
    if marking.total <= 0 or not 0 <= marking.decimals <= 6:
        raise CannotRead(f"{path}: total must be above 0, and decimals from 0 to 6")
    return marking


def mark_of(parts: Parts, marking: Marking) -> str:
    """One mark from all parts; a part that is missing counts as 0."""
    share = sum(
        weight * parts[name].points / parts[name].max_points
        for name, weight in marking.shares.items()
        if name in parts and parts[name].max_points > 0
    )
    mark = Decimal(marking.total * share / sum(marking.shares.values()))
    # what binary fractions leave over must not decide which way to round
    mark = mark.quantize(Decimal("1e-9"))
    return str(mark.quantize(Decimal(1).scaleb(-marking.decimals), ROUND_HALF_UP))


def waiting(parts: Parts, marking: Marking) -> list[str]:
    """The parts that a person must still grade."""
    return [name for name in marking.shares if name in parts and parts[name].waiting]


def parts_from_results(outcomes: Iterable[Outcome]) -> dict[str, Parts]:
    """The engine alone, where no notebooks are used: after adjustments, which are its note.

    What could not be graded waits for a person.
    """
    return {
        each.name: {ENGINE: Part(each.final, each.max_points, bool(each.trouble), why(each))}
        for each in outcomes
    }


def why(outcome: Outcome) -> str:
    """Why these are its points, if they are not what the checks gave."""
    return outcome.trouble or "; ".join(outcome.reasons)


# ---------------------------------------------------------------- marks for the LMS


@dataclass(frozen=True)
class Marks:
    """A file for the LMS, and what a person should know about it."""

    text: str
    given: int
    notes: list[str]


def marks(
    roster: Roster, key: str, scores: dict[str, Parts], marking: Marking, so_far: bool = False
) -> Marks:
    """The class list with a mark for each student.

    A mark that still waits for a person is left empty, unless `so_far`.
    """
    by_name = {folded(student): student for student in scores}
    rows, notes, met = [], [], set()
    given = 0
    for row in roster.rows:
        student = next((by_name[name] for name in names_of(row[key]) if name in by_name), None)
        mark, words = str(marking.absent), "nothing handed in"
        if student is not None:
            met.add(student)
            mark, words = mark_of(scores[student], marking), summary(scores[student], marking)
            left = waiting(scores[student], marking)
            if left and not so_far:
                mark = ""
                notes.append(f"{row[key]}: no mark yet, {', '.join(left)} must be graded by hand")
        else:
            notes.append(f"{row[key]}: nothing handed in")
        given += mark != ""
        rows.append((row, mark, words))
    for student in sorted(set(scores) - met):
        notes.append(f"{student}: handed in, but is not in the class list under {key!r}")
    table = canvas_table(roster, rows, marking) if roster.canvas else plain_table(roster, key, rows)
    return Marks(as_csv(table, roster), given, notes)


def summary(parts: Parts, marking: Marking) -> str:
    """What makes the mark, for the column of feedback."""
    return "; ".join(
        f"{name} {parts[name].points:g} / {parts[name].max_points:g}"
        + f" ({clean(parts[name].note)})" * bool(parts[name].note)
        for name in marking.shares
        if name in parts
    )


Marked = tuple[dict[str, str], str, str]  # a row of the class list, its mark, the summary


def canvas_table(roster: Roster, rows: list[Marked], marking: Marking) -> list[list[str]]:
    """Canvas takes back its own first columns and one column per assignment."""
    own = [name for name in CANVAS if name in roster.columns]
    title = next((c for c in roster.columns if c.startswith(f"{marking.title} (")), marking.title)
    table = [[*own, title]]
    if roster.possible:
        table.append([f"    {POINTS_POSSIBLE}", *[""] * (len(own) - 1), f"{marking.total:g}"])
    table += [[*(row[name] for name in own), mark] for row, mark, _ in rows]
    return table


def plain_table(roster: Roster, key: str, rows: list[Marked]) -> list[list[str]]:
    """Moodle asks at import which column is which."""
    own = [name for name in roster.columns if name in MOODLE or name == key]
    table = [[*own, "Grade", "Feedback"]]
    table += [[*(row[name] for name in own), mark, words] for row, mark, words in rows]
    return table


def as_csv(table: list[list[str]], roster: Roster) -> str:
    out = io.StringIO(newline="")
    writer = csv.writer(out, delimiter=roster.delimiter, lineterminator="\r\n")
    writer.writerows([harmless(cell) for cell in row] for row in table)
    return roster.mark + out.getvalue()
