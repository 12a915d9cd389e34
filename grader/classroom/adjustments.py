"""Apply what a person decides about points: one file for a class, apart from the results.

handouts/instructor/class.md shows such a file. Rules that `[late]` leaves out are those of
course.toml, line by line.

Results are never changed: points are computed anew from them and from this file whenever a class is
graded, and every change is shown with its reason.
"""

import math
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import date, datetime, timedelta, tzinfo
from functools import partial
from pathlib import Path
from typing import Annotated, Any
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

import msgspec
from msgspec import Meta, Struct, structs

from grader.classroom.comments import Comment, Remark, place_all
from grader.errors import Stop
from grader.intake.found import Found
from grader.intake.names import fold
from grader.intake.roster import ClassList, find_student, is_same_student
from grader.judge.course import END_OF_DAY, EXAMPLE, FULL, Course, Late
from grader.judge.outer import READING, call_within
from grader.text import plural

DAY = timedelta(days=1)
KINDS = (
    "add = 5, points = 70, late = false, due = 2026-05-09T12:00:00+02:00, cap = 80, bonus = 3, "
    'take = "b.zip"'
)

Words = Annotated[str, Meta(pattern=r"\S")]
Points = Annotated[int, Meta(ge=0)]


class Adjust(Struct, frozen=True, forbid_unknown_fields=True):
    """A decision about one student or several: its reason, and exactly one of the others."""

    student: Words | Annotated[list[Words], Meta(min_length=1)]
    reason: Words
    add: int | None = None  # points, to those that the grader found
    points: Points | None = None  # the mark, whatever was found and whether anything was
    late: bool | None = None  # false: lateness is excused
    due: datetime | None = None  # an extension
    cap: Points | None = None  # the most that there can be
    bonus: Points | None = None  # points beside the grader's own bonus, counted as these are
    take: Words | None = None  # the work that counts: of a name, or a path in what was handed in

    @property
    def students(self) -> list[str]:
        return [self.student] if isinstance(self.student, str) else self.student

    def concerns(self, name: str) -> bool:
        return any(is_same_student(who, name) for who in self.students)


class Adjustments(Struct, frozen=True, forbid_unknown_fields=True):
    """All decisions about a class, and what lateness costs in it."""

    late: Late | None = None
    adjust: list[Adjust] = []
    comment: list[Comment] = []
    zone: str = ""

    def decide(self, found: Found, points: int | None) -> "Final":
        """Return what counts for a submission that earned `points`; None if it was not graded."""
        decisions = self.find_decisions(found)
        reasons: list[str] = []
        by_hand = False
        if points is not None and self.late is not None:
            points = self.apply_lateness(found, points, reasons)
        for each in decisions:
            if each.take is not None:
                reasons.append(f"{each.take} counts: {each.reason}")
            elif each.due is not None:
                reasons.append(f"due {write_time(each.due)}: {each.reason}")
            elif each.points is not None:
                points, by_hand = each.points, True
                reasons.append(f"{each.reason}: set to {each.points}")
            elif points is None and (each.add is not None or each.cap is not None):
                words = "nothing was graded that this could change, set points"
                reasons.append(f"{each.reason}: {words}")
            elif each.add is not None:
                points = (points or 0) + each.add
                reasons.append(f"{each.reason}: {each.add:+}")
            elif each.cap is not None:
                points = min(points or 0, each.cap)
                reasons.append(f"{each.reason}: {each.cap} at most")
            elif each.bonus is not None:
                reasons.append(f"{each.reason}: {each.bonus:+} bonus")
        final = None if points is None else max(points, 0)
        return Final(final, tuple(reasons), self.find_due(found), by_hand)

    def sum_bonus(self, found: Found) -> int:
        return sum(each.bonus or 0 for each in self.find_decisions(found))

    def apply_lateness(self, found: Found, points: int, reasons: list[str]) -> int:
        """Return the points that lateness leaves, and add the reason to `reasons`."""
        late = self.late or Late()
        days = self.count_days_late(found)
        if not days:
            return points
        decisions = self.find_decisions(found)
        late_for = f"{plural(days, 'day')} late"
        if excuses := [each.reason for each in decisions if each.late is False]:
            reasons += [f"{late_for}: 0", *(f"excused: {words}" for words in excuses)]
            return points
        if found.handed_in is None and any(each.due for each in decisions):
            reasons.append(
                "the LMS marks it late without a time: nothing is taken off an extension"
            )
            return points
        if late.closed_after is not None and days > late.closed_after:
            reasons.append(f"{late_for}: no points after {plural(late.closed_after, 'day')}")
            return 0
        costly = max(0, days - late.free_days)
        loss = late.loss(costly, points)
        free = f", {plural(days - costly, 'day')} free" if days > costly else ""
        reasons.append(f"{late_for}{free}: {'-' if loss else ''}{loss}")
        points -= loss
        if isinstance(late.cap, int) and costly and points > late.cap:
            reasons.append(f"late work has {late.cap} at most")
            points = late.cap
        return points

    def count_days_late(self, found: Found) -> int:
        """Return days begun since the due date; 1 where the LMS marks work late without a time."""
        due = self.find_due(found)
        if self.late is not None and due and found.handed_in:
            after = self.add_zone(found.handed_in) - due
            grace = timedelta(minutes=self.late.grace)
            return math.ceil(after / DAY) if after > grace else 0
        return int(found.late)

    def find_due(self, found: Found) -> datetime | None:
        """Return when this student's work is due: the last extension, or what holds for all."""
        extended = [each.due for each in self.find_decisions(found) if each.due]
        due = max(extended) if extended else self.late.due if self.late else None
        return self.add_zone(due) if due else None

    def find_decisions(self, found: Found) -> list[Adjust]:
        """Return the decisions about a student, or about the member of a group who handed in."""
        for name in (found.name, found.handed_in_by):
            if decisions := [each for each in self.adjust if each.concerns(name)]:
                return decisions
        return []

    def add_zone(self, when: datetime) -> datetime:
        """Return a moment with a zone: without one it is the school's own time."""
        if when.tzinfo:
            return when
        due = self.late.due if self.late else None
        school: tzinfo | None = ZoneInfo(self.zone) if self.zone else due.tzinfo if due else None
        return when.replace(tzinfo=school or ZoneInfo("UTC"))

    @property
    def students(self) -> list[str]:
        names = [name for each in self.adjust for name in each.students]
        return list(dict.fromkeys([*names, *(each.student for each in self.comment)]))

    @property
    def choices(self) -> list[tuple[str, str]]:
        """Return students and the work that a person says is theirs."""
        return [(who, each.take) for each in self.adjust if each.take for who in each.students]

    def place_comments(self, found: Found, files: Mapping[str, bytes]) -> list[Remark]:
        """Return the comments on a student's work, each beside its line.

        Raises Exceeded, Failed or Lost where its files cannot be searched within the limits.
        """
        for name in (found.name, found.handed_in_by):
            about = [each for each in self.comment if is_same_student(each.student, name)]
            if about:
                placing = partial(place_all, about, files)
                return call_within(READING, list[Remark], placing) if files else placing()
        return []

    def find_unused(self, names: Iterable[str]) -> list[str]:
        """Return the students of decisions who are not among `names`."""
        here = list(names)
        return [who for who in self.students if not any(is_same_student(who, n) for n in here)]

    def resolve(self, names: Iterable[str], people: ClassList) -> "Adjustments":
        """Return the decisions with students by their names in the class, `names`.

        A student may be written as the class list has them: by address, login, number or full
        name. Raises Stop where that means two students.
        """
        here = list(dict.fromkeys(names))
        known = {who: find_student(who, here, people) for who in self.students}
        adjust = [
            structs.replace(each, student=[known[who] for who in each.students])
            for each in self.adjust
        ]
        if faults := list(find_set_twice(adjust)):
            raise Stop(f"in the adjustments {faults[0]}")
        comment = [structs.replace(each, student=known[each.student]) for each in self.comment]
        return structs.replace(self, adjust=adjust, comment=comment)


@dataclass(frozen=True)
class Final:
    """The points that count, and why they are not those of the checks."""

    points: int | None  # None: there is no mark
    reasons: tuple[str, ...] = ()
    due: datetime | None = None
    by_hand: bool = False  # the points were set by a person


def write_time(when: datetime | None) -> str:
    """Return a moment to the minute, with its distance from UTC; empty for none."""
    if when is None:
        return ""
    words = f"{when:%Y-%m-%d %H:%M %z}".rstrip()
    return f"{words[:-2]}:{words[-2:]}" if when.tzinfo else words


# ---------------------------------------------------------------- reading and checking


def load_adjustments(path: Path | None, course: Course = FULL) -> Adjustments:
    """Read the file; without one, the course's rules are all."""
    document: dict[str, Any] = {}
    try:
        document = tomllib.loads(path.read_text(encoding="utf-8-sig")) if path else {}
        convert_dates(document)
        adjustments = msgspec.convert(add_rules(course, document), Adjustments)
        most = course.rubric.max_points
        if adjustments.late is not None and not any(adjustments.late.find_faults(most)):
            adjustments = structs.replace(adjustments, late=adjustments.late.in_points(most))
    except OSError as error:
        raise Stop(f"there are no adjustments at {path}") from error
    except msgspec.ValidationError as error:
        raise Stop(f"{path}: {name_value(str(error), document)}") from error
    except ValueError as error:  # no TOML, or no text
        raise Stop(f"{path}: {error}") from error
    if faults := list(find_faults(adjustments, course)):
        raise Stop(f"{path}: " + "; ".join(faults))
    return adjustments


RULES = {  # by what msgspec says
    "Expected `int` >= 0": "must be a whole number, 0 or more",
    "Expected `int": "must be a whole number",
    "%$'": 'must be points, or a share as "10%"',
    r"'\\S'": "must not be empty",
}


def name_value(words: str, document: dict[str, Any]) -> str:
    """Write a complaint of msgspec's with the line of the file that it is about."""
    found = re.fullmatch(r"(.*) - at `\$\.(late|(adjust|comment)\[(\d+)\])(?:\.(\w+))?.*`", words)
    if found is None:
        return words
    complaint, place, kind, number, name = found.groups()
    line = document[kind][int(number)] if number else document.get("late", {})
    what = "comment on" if kind == "comment" else "decision about"
    who = f"the {what} {line.get('student')!r}" if number else place
    rule = next((rule for sign, rule in RULES.items() if sign in complaint), complaint)
    return f"{who}: {name} = {line.get(name)!r} {rule}" if name else f"{who}: {rule}"


def convert_dates(document: dict[str, Any]) -> None:
    """Make a date without a time the end of that day, as in course.toml."""
    decisions = document.get("adjust")
    for each in [document.get("late"), *(decisions if isinstance(decisions, list) else [])]:
        due = each.get("due") if isinstance(each, dict) else None
        if isinstance(due, str):
            raise ValueError(f"due = {due!r} must be a date without quotes, as in due = {EXAMPLE}")
        if isinstance(due, date) and not isinstance(due, datetime):
            each["due"] = datetime.combine(due, END_OF_DAY)


def add_rules(course: Course, document: dict[str, Any]) -> dict[str, Any]:
    """Return the decisions, with the course's due date and late rules where they have none."""
    late = document.get("late", {})
    if not isinstance(late, dict):
        return document
    rules = structs.asdict(course.late) if course.late else {}
    late = rules | ({"due": course.due} if course.due else {}) | late
    return document | ({"late": late} if late else {})


def find_faults(adjustments: Adjustments, course: Course) -> Iterator[str]:
    """Return all that cannot be meant, a sentence each."""
    if adjustments.late is not None:
        yield from adjustments.late.find_faults(course.rubric.max_points)
    try:
        ZoneInfo(adjustments.zone or "UTC")
    except (ZoneInfoNotFoundError, ValueError):
        yield f"zone = {adjustments.zone!r} is no zone: write one such as Europe/Berlin"
        return
    due = adjustments.late.due if adjustments.late else None
    if due is not None and due.tzinfo is None and not adjustments.zone:
        yield f"due = {due} needs its time zone, as in {due}+02:00, or zone at the top"
    for each in adjustments.adjust:
        yield from find_faults_of_decision(each, adjustments, course.most)
    yield from find_set_twice(adjustments.adjust)


def find_set_twice(decisions: Iterable[Adjust]) -> Iterator[str]:
    """Yield whose points two decisions set."""
    marked: set[str] = set()
    for each in decisions:
        if each.points is not None:
            twice = [name for name in each.students if fold(name) in marked]
            yield from (f"points of {name!r} are set twice" for name in twice)
            marked |= {fold(name) for name in each.students}


def find_faults_of_decision(each: Adjust, adjustments: Adjustments, most: int) -> Iterator[str]:
    who = ", ".join(each.students)
    given = [each.add, each.points, each.late, each.due, each.cap, each.bonus, each.take]
    if given.count(None) != len(given) - 1 or each.late:
        yield f"the decision about {who!r} needs one of {KINDS}"
    for name, value in (("points", each.points), ("cap", each.cap)):
        if value is not None and value > most:
            yield f"{name} = {value} of {who!r} is more than the {most} that there are"
    if each.due is None:
        return
    if each.due.tzinfo is None and not adjustments.zone:
        yield f"due = {each.due} of {who!r} needs its time zone, or zone at the top"
    elif adjustments.late is None or adjustments.late.due is None:
        yield f"{who!r} has an extension, and neither [late] nor the course has a due to extend"
    elif adjustments.add_zone(each.due) < adjustments.add_zone(adjustments.late.due):
        yield f"due = {each.due} of {who!r} is before the others' {adjustments.late.due}"
