"""Apply a person's decisions about points, in one file for a class, separate from the results.

handouts/instructor/class.md shows such a file. Rules missing in `[late]` come from course.toml.
Results never change: each grading computes points anew from them and from this file, and shows
every change with its reason.
"""

import math
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import date, datetime, timedelta, tzinfo
from pathlib import Path
from typing import Annotated, Any
from zoneinfo import ZoneInfo

import msgspec
from msgspec import Meta, Struct, structs

from grader.classroom.comments import Comment, place_comment
from grader.errors import Stop
from grader.intake.found import Work
from grader.intake.names import fold
from grader.intake.roster import ClassList, find_student, is_same_student
from grader.judge.course import END_OF_DAY, EXAMPLE, FULL, Course, Late
from grader.judge.wall.outer import READING, call_within
from grader.report.html import Remark
from grader.text import plural

DAY = timedelta(days=1)
KINDS = (
    "add = 5, points = 70, late = false, due = 2026-05-09T12:00:00+02:00, cap = 80, bonus = 3, "
    'take = "b.zip"'
)

Words = Annotated[str, Meta(pattern=r"\S")]
Points = Annotated[int, Meta(ge=0)]


class Adjust(Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """A decision about students: `student`, `reason`, and exactly one other field."""

    student: Words | Annotated[list[Words], Meta(min_length=1)]
    reason: Words
    add: int | None = None  # points, added to those of the grader
    points: Points | None = None  # the mark, for any or no result
    late: bool | None = None  # false: lateness is excused
    due: datetime | None = None  # an extension
    cap: Points | None = None  # the maximum
    bonus: Points | None = None  # points added to the grader's bonus
    take: Words | None = None  # the work that counts: a name, or a path in the submission

    def __post_init__(self) -> None:
        if len(msgspec.to_builtins(self)) != 3 or self.late:
            raise ValueError(f"write exactly one of {KINDS}")

    @property
    def students(self) -> list[str]:
        return [self.student] if isinstance(self.student, str) else self.student

    def concerns(self, name: str) -> bool:
        return any(is_same_student(who, name) for who in self.students)

    def change(self, points: int | None) -> tuple[int | None, str]:
        """Return the points after this decision, and the reason to show; empty for none."""
        if self.take is not None:
            return points, f"{self.take} counts: {self.reason}"
        if self.due is not None:
            return points, f"due {write_time(self.due)}: {self.reason}"
        if self.points is not None:
            return self.points, f"{self.reason}: set to {self.points}"
        if self.bonus is not None:
            return points, f"{self.reason}: {self.bonus:+} bonus"
        if self.late is not None:
            return points, ""
        if points is None:
            words = "nothing was graded that this could change, set points"
            return None, f"{self.reason}: {words}"
        if self.add is not None:
            return points + self.add, f"{self.reason}: {self.add:+}"
        assert self.cap is not None
        return min(points, self.cap), f"{self.reason}: {self.cap} at most"


class Adjustments(Struct, frozen=True, forbid_unknown_fields=True):
    """All decisions about a class, and the cost of lateness in it."""

    late: Late | None = None
    adjust: list[Adjust] = []
    comment: list[Comment] = []
    zone: str = ""

    def decide(self, found: Work, points: int | None) -> "FinalPoints":
        """Return the final points for a submission; `points` is None if it is not graded."""
        decisions = self.find_decisions(found)
        reasons: list[str] = []
        if points is not None and self.late is not None:
            points = self.apply_lateness(self.late, found, points, reasons)
        for each in decisions:
            points, reason = each.change(points)
            reasons.append(reason)
        final = None if points is None else max(points, 0)
        by_hand = any(each.points is not None for each in decisions)
        return FinalPoints(final, tuple(filter(None, reasons)), self.find_due(found), by_hand)

    def apply_lateness(self, late: Late, found: Work, points: int, reasons: list[str]) -> int:
        """Return the points after the loss for lateness, and add the reason to `reasons`."""
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

    def count_days_late(self, found: Work) -> int:
        """Return days begun since the due date; 1 if the LMS marks work late without a time."""
        due = self.find_due(found)
        if self.late is not None and due and found.handed_in:
            after = self.add_zone(found.handed_in) - due
            grace = timedelta(minutes=self.late.grace)
            return math.ceil(after / DAY) if after > grace else 0
        return int(found.late)

    def find_due(self, found: Work) -> datetime | None:
        """Return the due date of this student: the last extension, or the date for all."""
        extended = [each.due for each in self.find_decisions(found) if each.due]
        due = max(extended) if extended else self.late.due if self.late else None
        return self.add_zone(due) if due else None

    def find_decisions(self, found: Work) -> list[Adjust]:
        """Return the decisions about a student, or about the group member who handed in."""
        for name in (found.name, found.handed_in_by):
            if decisions := [each for each in self.adjust if each.concerns(name)]:
                return decisions
        return []

    def add_zone(self, when: datetime) -> datetime:
        """Return a moment with a zone, by default the school's."""
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
        """Return students with the work that a person assigned to them."""
        return [(who, each.take) for each in self.adjust if each.take for who in each.students]

    def place_comments(self, found: Work, files: Mapping[str, bytes]) -> list[Remark]:
        """Return the comments on a student's work, each beside its line.

        Raises Exceeded, Failed or Lost if searching its files reaches a limit.
        """
        names = found.name, found.handed_in_by
        lists = ([e for e in self.comment if is_same_student(e.student, name)] for name in names)
        about = next(filter(None, lists), [])

        def place() -> list[Remark]:
            return [place_comment(each, files) for each in about]

        return call_within(READING, list[Remark], place) if about and files else place()

    def find_unused(self, names: Iterable[str]) -> list[str]:
        """Return the students that decisions name but `names` lacks."""
        here = list(names)
        return [who for who in self.students if not any(is_same_student(who, n) for n in here)]

    def resolve(self, names: Iterable[str], people: ClassList) -> "Adjustments":
        """Return the decisions, with each student called by one of the class's `names`.

        The file may use any name of the class list: address, login, number or full name. Raises
        Stop for a name that two students have.
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
class FinalPoints:
    """The points that count, and why they differ from the checks' points."""

    points: int | None  # None: there is no mark
    reasons: tuple[str, ...] = ()
    due: datetime | None = None
    by_hand: bool = False  # a person set the points


def write_time(when: datetime | None) -> str:
    """Return a moment to the minute, with its distance from UTC; empty for None."""
    if when is None:
        return ""
    words = f"{when:%Y-%m-%d %H:%M %z}".rstrip()
    return f"{words[:-2]}:{words[-2:]}" if when.tzinfo else words


# ---------------------------------------------------------------- reading and checking


def load_adjustments(path: Path | None, course: Course = FULL) -> Adjustments:
    """Read the file; without one, return the course's rules. Raises Stop for an invalid file."""
    try:
        text = path.read_text(encoding="utf-8-sig") if path else ""
    except OSError as error:
        raise Stop(f"there are no adjustments at {path}") from error
    return read_adjustments(text, path, course)


def read_adjustments(text: str, path: Path | None, course: Course) -> Adjustments:
    """Read the text of the file at `path`. Raises Stop for an invalid one."""
    document: dict[str, Any] = {}
    try:
        document = tomllib.loads(text)
        convert_dates(document)
        adjustments = msgspec.convert(add_rules(course, document), Adjustments)
    except msgspec.ValidationError as error:
        raise Stop(f"{path}: {name_value(str(error), document)}") from error
    except ValueError as error:  # no TOML, or no text
        raise Stop(f"{path}: {error}") from error
    if faults := list(find_faults(adjustments, course)):
        raise Stop(f"{path}: " + "; ".join(faults))
    if adjustments.late is None:
        return adjustments
    return structs.replace(adjustments, late=adjustments.late.in_points(course.rubric.max_points))


RULES = {  # sentences by a part of msgspec's words
    "Expected `int` >= 0": "must be a whole number, 0 or more",
    "Expected `int": "must be a whole number",
    "%$'": 'must be points, or a share as "10%"',
    r"'\\S'": "must not be empty",
}


def name_value(words: str, document: dict[str, Any]) -> str:
    """Reword msgspec's message to name the key and value."""
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
    """Change each date without a time to the end of that day."""
    decisions = document.get("adjust")
    for each in [document.get("late"), *(decisions if isinstance(decisions, list) else [])]:
        due = each.get("due") if isinstance(each, dict) else None
        if isinstance(due, str):
            raise ValueError(f"due = {due!r} must be a date without quotes, as in due = {EXAMPLE}")
        if isinstance(due, date) and not isinstance(due, datetime):
            each["due"] = datetime.combine(due, END_OF_DAY)


def add_rules(course: Course, document: dict[str, Any]) -> dict[str, Any]:
    """Return the decisions, with the course's due date and late rules as defaults."""
    late = document.get("late", {})
    if not isinstance(late, dict):
        return document
    rules = structs.asdict(course.late) if course.late else {}
    late = rules | ({"due": course.due} if course.due else {}) | late
    return document | ({"late": late} if late else {})


def find_faults(adjustments: Adjustments, course: Course) -> Iterator[str]:
    """Return the values that are invalid in this course, a sentence each."""
    late = adjustments.late or Late()
    yield from late.find_faults(course.rubric.max_points)
    try:
        ZoneInfo(adjustments.zone or "UTC")
    except (LookupError, ValueError):
        yield f"zone = {adjustments.zone!r} is no zone: write one such as Europe/Berlin"
        return
    if late.due is not None and late.due.tzinfo is None and not adjustments.zone:
        yield f"due = {late.due} needs its time zone, as in {late.due}+02:00, or zone at the top"
    for each in adjustments.adjust:
        who = ", ".join(each.students)
        for name, value in (("points", each.points), ("cap", each.cap)):
            if value is not None and value > course.most:
                yield f"{name} = {value} of {who!r} is more than the {course.most} that there are"
        if each.due is None:
            continue
        if each.due.tzinfo is None and not adjustments.zone:
            yield f"due = {each.due} of {who!r} needs its time zone, or zone at the top"
        elif late.due is None:
            yield f"{who!r} has an extension, and neither [late] nor the course has a due to extend"
        elif adjustments.add_zone(each.due) < adjustments.add_zone(late.due):
            yield f"due = {each.due} of {who!r} is before the others' {late.due}"
    yield from find_set_twice(adjustments.adjust)


def find_set_twice(decisions: Iterable[Adjust]) -> Iterator[str]:
    """Yield notes on points that are set twice."""
    marked: set[str] = set()
    for each in decisions:
        if each.points is not None:
            twice = [name for name in each.students if fold(name) in marked]
            yield from (f"points of {name!r} are set twice" for name in twice)
            marked |= {fold(name) for name in each.students}
