"""What a person decides about points, kept apart from what the grader found.

    [late]                                # by what the LMS says of each submission
    due = 2026-05-04T23:59:00+02:00       # needed only where the LMS gives the time, not a mark
    per_day = 10
    at_most = 50

    [[adjust]]
    student = "ann"
    add = 5                               # or points = 70, or late = false to excuse
    reason = "her machine failed in the lab"

Results are never changed: points are worked out anew from them and from this file whenever a class
is graded, and every change is shown with its reason.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path

import msgspec
from msgspec import Struct, structs

from grader.classroom.intake.found import Found
from grader.classroom.names import folded
from grader.judge.course import Course
from grader.judge.submission import CannotGrade

DAY = timedelta(days=1)


class Late(Struct, frozen=True, forbid_unknown_fields=True):
    """What each day after the due date costs, begun days counted as whole."""

    per_day: int
    at_most: int = 100
    due: datetime | None = None


class Adjust(Struct, frozen=True, forbid_unknown_fields=True):
    """One decision about one student: exactly one of `add`, `points` and `late`."""

    student: str
    reason: str
    add: int | None = None
    points: int | None = None
    late: bool | None = None


class Adjustments(Struct, frozen=True, forbid_unknown_fields=True):
    late: Late | None = None
    adjust: list[Adjust] = []

    def within(self, course: Course) -> "Adjustments":
        """These, with the course's due date and late rules where they have none of their own."""
        rules = course.late
        late = self.late or (Late(rules.per_day, rules.at_most) if rules else None)
        if course.due is not None:
            late = late or Late(0)
            late = structs.replace(late, due=late.due or course.due)
        return structs.replace(self, late=late)

    def final(self, found: Found, points: int) -> "Final":
        """The points that count for a submission that earned `points`."""
        mine = [each for each in self.adjust if folded(each.student) == folded(found.name)]
        excused = [each.reason for each in mine if each.late is False]
        days, reasons = self.days_late(found), []
        if self.late is not None and days:
            loss = 0 if excused else min(days * self.late.per_day, self.late.at_most)
            points -= loss
            reasons.append(f"{days_of(days)} late: {'-' if loss else ''}{loss}")
            reasons += [f"excused: {reason}" for reason in excused]
        for each in mine:
            if each.add is not None:
                points += each.add
                reasons.append(f"{each.reason}: {each.add:+}")
            if each.points is not None:
                points = each.points
                reasons.append(f"{each.reason}: set to {each.points}")
        return Final(max(points, 0), tuple(reasons))

    def days_late(self, found: Found) -> int:
        """Days begun since the due date; one where the LMS says late and does not say when."""
        if self.late is not None and self.late.due and found.handed_in:
            return max(0, math.ceil((found.handed_in - self.late.due) / DAY))
        return int(found.late)

    def unused(self, names: Iterable[str]) -> list[str]:
        """The students it speaks of who are not among `names`."""
        known = {folded(name) for name in names}
        return [each.student for each in self.adjust if folded(each.student) not in known]


@dataclass(frozen=True)
class Final:
    """The points that count, and why they are not those of the checks."""

    points: int
    reasons: tuple[str, ...] = ()


def days_of(days: int) -> str:
    return "1 day" if days == 1 else f"{days} days"


def load_adjustments(path: Path) -> Adjustments:
    """Read the file; raises CannotGrade with what is wrong in it."""
    try:
        adjustments = msgspec.toml.decode(path.read_bytes(), type=Adjustments)
    except OSError as error:
        raise CannotGrade(f"there are no adjustments at {path}") from error
    except (msgspec.MsgspecError, UnicodeError) as error:
        raise CannotGrade(f"{path}: {error}") from error
    for each in adjustments.adjust:
        given = [each.add, each.points, each.late]
        if given.count(None) != 2 or each.late or not each.reason.strip():
            raise CannotGrade(
                f"{path}: what is said of {each.student!r} needs a reason and one of "
                "add = 5, points = 70 and late = false"
            )
    late = adjustments.late
    if late is not None and (late.per_day < 0 or late.at_most < 0):
        raise CannotGrade(f"{path}: per_day and at_most must be 0 or more")
    if late is not None and late.due is not None and late.due.tzinfo is None:
        raise CannotGrade(f"{path}: due = {late.due} needs its time zone, as in {late.due}+02:00")
    return adjustments
