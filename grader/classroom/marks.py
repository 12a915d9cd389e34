"""Marks for the LMS: one per student, from the parts of the assignment, into its class list.

The shares of the parts are in marks.toml. Names and identifiers are written as they came, but never
so that a spreadsheet would run them.
"""

import csv
import io
import re
import tomllib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal
from pathlib import Path

import msgspec
from msgspec import Struct

from grader.classroom.book import NOTHING, Outcome
from grader.classroom.owners import match
from grader.intake.names import in_short
from grader.intake.roster import (
    BLACKBOARD,
    CANVAS,
    END_OF_LINE,
    MOODLE,
    POINTS_POSSIBLE,
    CannotRead,
    Kind,
    Roster,
)
from grader.judge.course import FULL, Course
from grader.report.sinks.tables import harmless
from grader.text import clean

TOTAL = re.compile(r"(?:Total Pts: |MaxPoints:)([\d.,]+)")  # Blackboard's and Brightspace's columns
COMMAS = ("worksheet", "brightspace")  # taken back in UTF-8 and with commas alone
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
    handed_in: bool = True  # a person may set points for who handed in nothing


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

    What could not be graded waits for a person, unless one has set its points.
    """
    return {
        each.name: {
            ENGINE: Part(
                each.final, each.max_points, each.mark is None, why(each), each.trouble != NOTHING
            )
        }
        for each in outcomes
    }


def why(outcome: Outcome) -> str:
    """Why these are its points, if they are not what the checks gave; and with whom."""
    return "; ".join(filter(None, [outcome.group_in_words, outcome.trouble, *outcome.reasons]))


# ---------------------------------------------------------------- marks for the LMS


@dataclass(frozen=True)
class Marks:
    """A file for the LMS, and what a person should know about it."""

    text: str
    given: int
    notes: list[str]
    encoding: str = "utf-8"


def marks(
    roster: Roster,
    key: str,
    scores: dict[str, Parts],
    marking: Marking,
    so_far: bool = False,
    others_known: bool = False,
) -> Marks:
    """The class list with a mark for each student.

    A mark that still waits for a person is left empty, unless `so_far`. So is a row that could be
    more than one student's: nobody gets another's mark, nor a zero for bearing another's name. And
    as long as work has no owner nobody is known to have handed in nothing, unless `others_known`.
    """
    absent = [
        name for name, parts in scores.items() if not any(p.handed_in for p in parts.values())
    ]
    owners = match(roster, key, scores, absent)
    rows: list[Marked] = []
    notes: list[str] = []
    unowned: list[str] = []
    given = 0
    for row in roster.rows:
        found = owners.of(row)
        mark, words = str(marking.absent), "nothing handed in"
        if row in owners.doubtful or len(found) > 1:
            mark, words = "", ""
            names = found or [name for name, them in owners.doubts.items() if row in them]
            notes.append(f"{row[key]}: no mark, {' and '.join(names)} could be theirs: see by hand")
        elif found:
            parts = scores[found[0]]
            mark, words = mark_of(parts, marking), summary(parts, marking)
            left = waiting(parts, marking)
            if left and not so_far:
                mark = ""
                notes.append(f"{row[key]}: no mark yet, {', '.join(left)} must be graded by hand")
            if mates := owners.mates(row):
                notes.append(f"{row[key]}: the mark of {' and '.join(mates)}, of the same group")
        elif owners.strangers and not others_known:
            mark, words = "", ""
            unowned.append(row[key])
        else:
            notes.append(f"{row[key]}: nothing handed in")
        given += mark != ""
        rows.append((row, mark, words))
    for student in sorted(owners.strangers):
        notes.append(f"{student}: handed in, but is not in the class list under {key!r}")
    if unowned:
        notes.append(
            f"{in_short(unowned)}: no mark, as that may be their work: say whose it is in a column "
            "Called, or with --others-known that it is nobody's here"
        )
    above = [row[key] for row, mark, _ in rows if is_above(mark, marking.total)]
    if above and roster.kind == "worksheet":
        notes.append(
            f"{in_short(above)}: above {marking.total:g}, which Moodle's worksheet leaves out "
            "without a word: set their grades in its gradebook, or let the bonus count apart"
        )
    elif above:
        notes.append(f"{in_short(above)}: above {marking.total:g}: may marks be so there?")
    worth = total_of(roster, marking.title)
    if worth is not None and worth != marking.total:
        notes.append(f"{roster.path} counts to {worth:g} there, these marks to {marking.total:g}")
    table = TABLES[roster.kind](roster, key, rows, marking)
    encoding = "utf-8" if roster.kind in COMMAS else roster.encoding
    return Marks(as_csv(table, roster), given, notes, encoding)


def summary(parts: Parts, marking: Marking) -> str:
    """What makes the mark, for the column of feedback."""
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


Marked = tuple[dict[str, str], str, str]  # a row of the class list, its mark, the summary


def canvas_table(roster: Roster, key: str, rows: list[Marked], marking: Marking) -> list[list[str]]:
    """Canvas takes back its own first columns and one column per assignment."""
    own = [name for name in CANVAS if name in roster.columns]
    title = titled(roster, f"{marking.title} (", marking.title)
    table = [[*own, title]]
    if roster.possible:
        table.append([f"    {POINTS_POSSIBLE}", *[""] * (len(own) - 1), f"{marking.total:g}"])
    table += [[*(row[name] for name in own), mark] for row, mark, _ in rows]
    return table


def plain_table(roster: Roster, key: str, rows: list[Marked], marking: Marking) -> list[list[str]]:
    """Moodle's gradebook asks at import which column is which."""
    own = [name for name in roster.columns if name in MOODLE or name == key]
    table = [[*(roster.titles.get(name, name) for name in own), "Grade", "Feedback"]]
    table += [[*(row[name] for name in own), mark, words] for row, mark, words in rows]
    return table


def worksheet_table(
    roster: Roster, key: str, rows: list[Marked], marking: Marking
) -> list[list[str]]:
    """Moodle's grading worksheet goes back as it came: by its Identifier, two columns filled."""
    filled = {"Grade": 1, "Feedback comments": 2}
    table = [[roster.titles.get(name, name) for name in roster.columns]]
    for marked in rows:
        cells = {name: str(marked[at]) for name, at in filled.items()}
        table.append([cells.get(name, marked[0][name]) for name in roster.columns])
    return table


def blackboard_table(
    roster: Roster, key: str, rows: list[Marked], marking: Marking
) -> list[list[str]]:
    """Blackboard knows people by their username, and a column by the id behind its title."""
    own = [name for name in BLACKBOARD if name in roster.columns]
    title = titled(roster, f"{marking.title} [", marking.title)
    return [[*own, title], *([*(row[name] for name in own), mark] for row, mark, _ in rows)]


def brightspace_table(
    roster: Roster, key: str, rows: list[Marked], marking: Marking
) -> list[list[str]]:
    """Brightspace wants an identifier, the points, and a sign at the end of each row."""
    own = [name for name in ("OrgDefinedId", "Username") if name in roster.columns]
    table = [[*own, f"{marking.title} Points Grade", END_OF_LINE]]
    return [*table, *([*(row[name] for name in own), mark, "#"] for row, mark, _ in rows)]


def total_of(roster: Roster, title: str) -> float | None:
    """What full marks are in the gradebook; None where it does not say."""
    if roster.kind == "worksheet":
        totals = {row.get("Maximum Grade", "").strip() for row in roster.rows}
        told = next(iter(totals)) if len(totals) == 1 else ""
    else:
        columns = (name for name in roster.columns if name.startswith(title))
        told = next((match[1] for name in columns if (match := TOTAL.search(name))), "")
    try:
        return float(told.replace(",", ".")) if told else None  # as another country writes it
    except ValueError:
        return None


def is_above(mark: str, total: float) -> bool:
    try:
        return float(mark) > total
    except ValueError:  # empty, or a word for who handed in nothing
        return False


def titled(roster: Roster, start: str, otherwise: str) -> str:
    """The gradebook's own name of the assignment's column, an id behind it."""
    return next((name for name in roster.columns if name.startswith(start)), otherwise)


TABLES: dict[Kind, Callable[[Roster, str, list[Marked], Marking], list[list[str]]]] = {
    "canvas": canvas_table,
    "worksheet": worksheet_table,
    "blackboard": blackboard_table,
    "brightspace": brightspace_table,
    "plain": plain_table,
}


def as_csv(table: list[list[str]], roster: Roster) -> str:
    out = io.StringIO(newline="")
    delimiter = "," if roster.kind in COMMAS else roster.delimiter
    writer = csv.writer(out, delimiter=delimiter, lineterminator="\r\n")
    writer.writerows([harmless(cell) for cell in row] for row in table)
    return roster.mark + out.getvalue()
