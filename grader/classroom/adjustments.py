"""What a person decides about points: one file for a class, kept apart from what the grader found.

    zone = "Europe/Berlin"                # of times that an LMS gives without one

    [late]                                # by what the LMS says of each submission
    due = 2026-05-04T23:59:00+02:00       # needed only where the LMS gives the time, not a mark
    grace = 15                            # minutes after it that cost nothing
    free_days = 2                         # late days that each student has
    per_day = 10                          # points, or "10%" of what was earned
    at_most = 50                          # that lateness takes
    cap = 80                              # the most that late work can have
    closed_after = 7                      # days, after which there are no points

    [[adjust]]
    student = "ann"                       # or ["ann", "ben"]
    add = 5                               # one of those in `Adjust`
    reason = "her machine failed in the lab"

What `[late]` does not say is as the course has it in course.toml, line by line.

Results are never changed: points are worked out anew from them and from this file whenever a class
is graded, and every change is shown with its reason.
"""

import math
import re
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from datetime import date, datetime, timedelta, tzinfo
from pathlib import Path
from typing import Any
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

import msgspec
from msgspec import Struct, structs

from grader.intake.found import Found
from grader.intake.names import folded, names_of
from grader.judge.course import END_OF_DAY, EXAMPLE, FULL, Course, Late, wrong_late
from grader.judge.submission import CannotGrade

DAY = timedelta(days=1)
KINDS = "add = 5, points = 70, late = false, due = 2026-05-09T12:00:00+02:00, cap = 80, bonus = 3"


class Adjust(Struct, frozen=True, forbid_unknown_fields=True):
    """One decision about one student or some: its reason, and exactly one of the others."""

    student: str | list[str]
    reason: str
    add: int | None = None  # points, to those that the grader found
    points: int | None = None  # the mark, whatever was found and whether anything was
    late: bool | None = None  # false: lateness is pardoned
    due: datetime | None = None  # an extension
    cap: int | None = None  # the most that there can be
    bonus: int | None = None  # points beside the grader's own bonus, counted as these are

    @property
    def students(self) -> list[str]:
        return [self.student] if isinstance(self.student, str) else self.student


class Adjustments(Struct, frozen=True, forbid_unknown_fields=True):
    late: Late | None = None
    adjust: list[Adjust] = []
    zone: str = ""

    def final(self, found: Found, points: int | None) -> "Final":
        """What counts for a submission that earned `points`; None where it could not be graded."""
        mine = self.about(found)
        due = self.due(found)
        reasons: list[str] = []
        by_hand = False
        if points is not None and self.late is not None:
            points = self.after_lateness(found, points, mine, reasons)
        for each in mine:
            words = each.reason
            if each.due is not None:
                reasons.append(f"due {timestamp(each.due)}: {words}")
            elif each.points is not None:
                points, by_hand = each.points, True
                reasons.append(f"{words}: set to {each.points}")
            elif points is None and (each.add is not None or each.cap is not None):
                reasons.append(f"{words}: nothing was graded that this could change, set points")
            elif each.add is not None:
                points = (points or 0) + each.add
                reasons.append(f"{words}: {each.add:+}")
            elif each.cap is not None:
                points = min(points or 0, each.cap)
                reasons.append(f"{words}: {each.cap} at most")
            elif each.bonus is not None:
                reasons.append(f"{words}: {each.bonus:+} bonus")
        final = None if points is None else max(points, 0)
        return Final(final, tuple(reasons), due, by_hand)

    def bonus(self, found: Found) -> int:
        """The bonus that a person gave this student."""
        return sum(each.bonus or 0 for each in self.about(found))

    def after_lateness(
        self, found: Found, points: int, mine: list[Adjust], reasons: list[str]
    ) -> int:
        """The points that lateness leaves, and why, added to `reasons`."""
        late = self.late or Late()
        days = self.days_late(found)
        if not days:
            return points
        excused = [each.reason for each in mine if each.late is False]
        if excused:
            reasons += [f"{days_of(days)} late: 0", *(f"excused: {words}" for words in excused)]
            return points
        if found.handed_in is None and any(each.due for each in mine):
            reasons.append("late says the LMS, and not when: nothing is taken off an extension")
            return points
        costly = max(0, days - late.free_days)
        loss = late.loss(costly, points)
        free = f", {days_of(days - costly)} free" if days > costly else ""
        if late.closed_after is not None and days > late.closed_after:
            reasons.append(f"{days_of(days)} late: no points after {days_of(late.closed_after)}")
            return 0
        reasons.append(f"{days_of(days)} late{free}: {'-' if loss else ''}{loss}")
        points -= loss
        if late.cap is not None and costly and points > late.cap:
            reasons.append(f"late work has {late.cap} at most")
            points = late.cap
        return points

    def days_late(self, found: Found) -> int:
        """Days begun since the due date; one where the LMS says late and does not say when."""
        due = self.due(found)
        if self.late is not None and due and found.handed_in:
            after = self.aware(found.handed_in) - due
            grace = timedelta(minutes=self.late.grace)
            return math.ceil(after / DAY) if after > grace else 0
        return int(found.late)

    def due(self, found: Found) -> datetime | None:
        """When this student's work is due: the last extension, or what holds for all."""
        extended = [each.due for each in self.about(found) if each.due]
        due = max(extended) if extended else self.late.due if self.late else None
        return self.aware(due) if due else None

    def about(self, found: Found) -> list[Adjust]:
        """What was decided of a student; of who has no line, what was of who handed in for them."""
        return self.named(found.name) or self.named(found.handed_in_by)

    def named(self, name: str) -> list[Adjust]:
        return [each for each in self.adjust if any(means(who, name) for who in each.students)]

    def aware(self, when: datetime) -> datetime:
        """A moment: without a zone it is the school's own time."""
        return when if when.tzinfo else when.replace(tzinfo=self.school)

    @property
    def school(self) -> tzinfo:
        """The school's zone: the one that is named, or that of the due date."""
        if self.zone:
            return ZoneInfo(self.zone)
        due = self.late.due if self.late else None
        return (due.tzinfo if due else None) or ZoneInfo("UTC")

    @property
    def students(self) -> list[str]:
        """All whom it speaks of, each once."""
        return list(dict.fromkeys(name for each in self.adjust for name in each.students))

    def unused(self, names: Iterable[str]) -> list[str]:
        """The students it speaks of who are not among `names`."""
        known = list(names)
        return [who for who in self.students if not any(means(who, name) for name in known)]

    def refuse_doubts(self, names: Iterable[str]) -> None:
        """Raise CannotGrade where one name of the file means two students."""
        known = list(dict.fromkeys(names))
        for who in self.students:
            meant = [name for name in known if means(who, name)]
            if len(meant) > 1:
                raise CannotGrade(
                    f"{who!r} in the adjustments could be {' or '.join(meant)}: write it whole"
                )


def means(who: str, name: str) -> bool:
    """Whether a name in the file is this student's: the same, or the first half of an address."""
    return folded(who) in names_of(name) or folded(name) in names_of(who)


@dataclass(frozen=True)
class Final:
    """The points that count, and why they are not those of the checks."""

    points: int | None  # None: there is no mark
    reasons: tuple[str, ...] = ()
    due: datetime | None = None
    by_hand: bool = False  # the points were set by a person


def days_of(days: int) -> str:
    return "1 day" if days == 1 else f"{days} days"


def timestamp(when: datetime) -> str:
    """A moment for people: to the minute, with its distance from UTC."""
    words = f"{when:%Y-%m-%d %H:%M %z}".rstrip()
    return f"{words[:-2]}:{words[-2:]}" if when.tzinfo else words


# ---------------------------------------------------------------- reading and checking


def load_adjustments(path: Path | None, course: Course = FULL) -> Adjustments:
    """Read the file; without one, the course's rules are all. CannotGrade says what is wrong."""
    try:
        document = tomllib.loads(path.read_text(encoding="utf-8-sig")) if path else {}
        in_order(document)
        adjustments = msgspec.convert(within(course, document), Adjustments)
    except OSError as error:
        raise CannotGrade(f"there are no adjustments at {path}") from error
    except (msgspec.MsgspecError, ValueError) as error:  # no TOML, or no text
        raise CannotGrade(f"{path}: {error}") from error
    if wrong := list(faults(adjustments, course.most)):
        raise CannotGrade(f"{path}: " + "; ".join(wrong))
    return adjustments


def in_order(document: dict[str, Any]) -> None:
    """See to the dates and numbers of each decision before it is decoded."""
    decisions = document.get("adjust")
    for each in [document.get("late"), *(decisions if isinstance(decisions, list) else [])]:
        if isinstance(each, dict):
            whole_day(each)
            whole_points(each)


def whole_day(decision: dict[str, Any]) -> None:
    """A date without a time is the end of that day, as in course.toml.

    Raises ValueError where it is none.
    """
    due = decision.get("due")
    if isinstance(due, date) and not isinstance(due, datetime):
        decision["due"] = datetime.combine(due, END_OF_DAY)
    elif isinstance(due, str) and not re.match(r"\d{4}-\d\d-\d\d", due):
        raise ValueError(f"due = {due!r} must be a date without quotes, as in due = {EXAMPLE}")


def whole_points(decision: dict[str, Any]) -> None:
    """Raises ValueError where a number of points is none."""
    for name in ("points", "add", "cap", "bonus"):
        if name in decision and type(decision[name]) is not int:
            whose = f" of {decision['student']!r}" if "student" in decision else ""
            raise ValueError(f"{name} = {decision[name]!r}{whose} must be a whole number")


def within(course: Course, document: dict[str, Any]) -> dict[str, Any]:
    """The decisions, with the course's due date and late rules where they have no such line."""
    late = document.get("late", {})
    if not isinstance(late, dict):
        return document
    rules = structs.asdict(course.late) if course.late else {}
    dated = {"due": course.due} if course.due else {}
    late = rules | dated | late
    return document | ({"late": late} if late else {})


def faults(adjustments: Adjustments, most: int) -> Iterator[str]:
    """All that cannot be meant, a sentence each."""
    if adjustments.zone:
        try:
            ZoneInfo(adjustments.zone)
        except (ZoneInfoNotFoundError, ValueError):
            yield f"zone = {adjustments.zone!r} is none, as Europe/Berlin is"
            return
    if adjustments.late is not None:
        yield from faults_of_late(adjustments.late, bool(adjustments.zone))
    marked: set[str] = set()
    for each in adjustments.adjust:
        yield from faults_of(each, adjustments, most)
        if each.points is not None:
            twice = [name for name in each.students if folded(name) in marked]
            yield from (f"points of {name!r} are set twice" for name in twice)
            marked |= {folded(name) for name in each.students}


def faults_of_late(late: Late, zone: bool) -> Iterator[str]:
    rules = structs.asdict(late).items()
    yield from wrong_late(
        {name: rule for name, rule in rules if rule is not None and name != "due"}
    )
    if late.due is not None and late.due.tzinfo is None and not zone:
        yield f"due = {late.due} needs its time zone, as in {late.due}+02:00, or zone at the top"


def faults_of(each: Adjust, adjustments: Adjustments, most: int) -> Iterator[str]:
    who = ", ".join(each.students)
    given = [each.add, each.points, each.late, each.due, each.cap, each.bonus]
    if given.count(None) != len(given) - 1 or each.late or not each.reason.strip():
        yield f"what is said of {who!r} needs a reason and one of {KINDS}"
    if not each.students or not all(name.strip() for name in each.students):
        yield f"the decision {each.reason!r} names no student"
    for name, points in (("points", each.points), ("cap", each.cap), ("bonus", each.bonus)):
        if points is not None and points < 0:
            yield f"{name} = {points} of {who!r} is less than 0"
    if each.points is not None and each.points > most:
        yield f"points = {each.points} of {who!r} is more than the {most} that there are"
    if each.due is None:
        return
    if each.due.tzinfo is None and not adjustments.zone:
        yield f"due = {each.due} of {who!r} needs its time zone, or zone at the top"
    elif adjustments.late is None or adjustments.late.due is None:
        yield f"{who!r} has an extension, and neither [late] nor the course has a due to extend"
    elif adjustments.aware(each.due) < adjustments.aware(adjustments.late.due):
        yield f"due = {each.due} of {who!r} is before the others' {adjustments.late.due}"
