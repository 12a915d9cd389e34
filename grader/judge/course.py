"""Read `course.toml`: the TODOs of a course, their points, and the date they are due.

A mistake in it is reported in one sentence, before anything is graded.
"""

import re
import tomllib
from collections.abc import Iterator, Sequence
from contextlib import suppress
from datetime import date, datetime, time, timedelta, timezone
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Literal, Never, TypeVar

import msgspec
from msgspec import Meta, Struct, structs

from grader.errors import Stop
from grader.judge.result import is_bonus
from grader.judge.rubric import CHECKS, Check, Rubric, Todo, load_rubric

PLACE = CHECKS.parents[1] / "course.toml"  # in a checkout of the kit
COURSE_FILE = "COURSE_FILE"  # the variable by which make passes a course to every command
HANDED_OUT = CHECKS / "course.toml"  # in a student's copy, whose rubric has only its TODOs
EXAMPLE = "2027-05-04T23:59:00+02:00"
END_OF_DAY = time(23, 59, 59)  # due time of a date without a time
ANYWHERE = timezone(timedelta(hours=-12), "anywhere on Earth")  # where a day ends last


Read = TypeVar("Read", bound=Struct)
Kind = Literal["number", "film", "why"]
Count = Annotated[int, Meta(ge=0)]
Share = Annotated[str, Meta(pattern=r"^(100|\d{1,2})%$")]
Worth = Annotated[int, Meta(ge=1, le=1000)]  # points


class WrongCourse(Stop):
    """Raised if a course file is invalid; names the file and what to write."""


class Late(Struct, frozen=True, forbid_unknown_fields=True):
    """The cost of lateness, in a course and in decisions; a begun day counts as a whole day."""

    per_day: Count | Share = 0  # points, or a share of those earned, as "10%"
    at_most: Count | Share | None = None  # the maximum loss, in the same way
    grace: Count = 0  # minutes after the due date that cost nothing
    free_days: Count = 0  # late days without a loss, for each student
    cap: Count | Share | None = None  # the maximum of late work; a share of full marks
    closed_after: Count | None = None  # days, after which there are no points
    due: datetime | None = None  # in decisions only: a course has a separate line for it

    def loss(self, days: int, points: int) -> int:
        """Return the points that `days` late days cost; a share is rounded down."""
        if isinstance(self.per_day, str):
            loss = points * min(days * read_share(self.per_day), 100) // 100
        else:
            loss = days * self.per_day
        if isinstance(self.at_most, str):
            return min(loss, points * read_share(self.at_most) // 100)
        return loss if self.at_most is None else min(loss, self.at_most)

    def in_points(self, most: int) -> "Late":
        """Return these rules with the cap in points, if full marks are `most`."""
        if not isinstance(self.cap, str):
            return self
        return structs.replace(self, cap=most * read_share(self.cap) // 100)

    def find_faults(self, most: int) -> Iterator[str]:
        """Yield a message for each value above the `most` points of the course."""
        for name in ("per_day", "at_most", "cap"):
            value = getattr(self, name)
            if isinstance(value, int) and value > most:
                full = f"is more than the {most} points that there are"
                yield f'late: {name} = {value} {full}: write fewer, or a share as "10%"'


def read_share(share: str) -> int:
    """Read a percentage: return 10 for `10%`."""
    return int(share.removesuffix("%"))


class Asked(Struct, frozen=True, forbid_unknown_fields=True):
    """Question counts by kind for a sheet about the student's program."""

    number: Annotated[int, Meta(ge=0, le=10)] = 3
    film: Annotated[int, Meta(ge=0, le=10)] = 1
    why: Annotated[int, Meta(ge=0, le=10)] = 2
    points: dict[Kind, Annotated[int, Meta(ge=1, le=100)]] = {}  # of one question; see WORTH

    def worth(self, kind: Kind) -> int:
        """Return the points of one question of a kind."""
        return self.points.get(kind, WORTH[kind])

    @property
    def most_points(self) -> int:
        """Return the points of a sheet with all its questions."""
        counts: dict[Kind, int] = {"number": self.number, "film": self.film, "why": self.why}
        return sum(count * self.worth(kind) for kind, count in counts.items())


WORTH: dict[Kind, int] = {"number": 2, "film": 4, "why": 3}


class Course(Struct, frozen=True, forbid_unknown_fields=True):
    """One course; an empty course file means all TODOs and the usual points.

    `todos`: the ids of its TODOs; None for all of them.
    `points`: the points of TODOs, if they differ from the rubric's.
    `out_of`: the points of full marks in gradebooks; None for the gradebook's own settings.
    `bonus`: points of bonus tasks are shown separately, omitted, added up to full marks, or added
    up to this number. `due`, `late`: the due date, and the cost of lateness. `visible`: the date
    from which students see why a hidden check failed; None for at once. `questions`: the sheets
    about students' own programs, whose points stand apart.
    """

    title: Annotated[str, Meta(pattern=r"\S")] = "Physics engine"
    todos: Annotated[tuple[str, ...], Meta(min_length=1)] | None = None
    points: dict[str, Worth] = {}
    out_of: Annotated[float, Meta(gt=0, le=100_000)] | None = None
    bonus: Literal["apart", "left out", "fill up"] | Count = "apart"
    due: datetime | None = None
    late: Late | None = None
    visible: datetime | None = None
    questions: Asked = Asked()

    @property
    def rubric(self) -> Rubric:
        """Return the rubric of this course."""
        todos = self.todos
        if self.bonus == "left out":
            known = [todo.id for todo in load_rubric().todos] if todos is None else todos
            todos = tuple(todo for todo in known if not is_bonus(todo))
        return choose_todos(todos, tuple(self.points.items()))

    @property
    def given_todos(self) -> list[Todo]:
        """Return the TODOs that the course gives students with their code."""
        asked = {todo.id for todo in self.rubric.todos}
        return [todo for todo in load_rubric().todos if todo.function and todo.id not in asked]

    @property
    def modules(self) -> list[str]:
        """Return the programs with a TODO, which are to be handed in, in the rubric's order."""
        return list(dict.fromkeys(todo.module for todo in self.rubric.todos if todo.function))

    @property
    def as_rated(self) -> "Course":
        """Return this course with the rubric's points, at least 1 per check."""
        return structs.replace(self, points={})

    def count_bonus(self, bonus: int, points: int) -> int:
        """Return the part of a bonus that counts, in addition to `points`."""
        if self.bonus == "fill up":
            return min(bonus, max(self.rubric.max_points - points, 0))
        return 0 if isinstance(self.bonus, str) else min(bonus, self.bonus)

    @property
    def most(self) -> int:
        """Return the maximum of a mark, with the part of the bonus that counts."""
        bonus = sum(todo.max_points for todo in self.rubric.todos if todo.bonus)
        return self.rubric.max_points + self.count_bonus(bonus, self.rubric.max_points)


FULL = Course()


# ---------------------------------------------------------------- the rubric of a course


@cache
def choose_todos(todos: tuple[str, ...] | None, points: tuple[tuple[str, int], ...]) -> Rubric:
    """Return the rubric cut to `todos`, in the rubric's order, with these `points`.

    Checks of the whole program stay if they run a program with a TODO. One that needs only omitted
    TODOs counts only if another passes.
    """
    every = load_rubric().todos
    asked = [todo for todo in every if todos is None or todo.id in todos]
    worth = {todo.id: todo.max_points for todo in asked} | dict(points)
    programs = {todo.module for todo in asked if todo.function and not todo.bonus}
    names = frozenset(todo.id for todo in asked)
    kept = [
        todo if todo.function else structs.replace(todo, checks=keep_checks(todo, programs, names))
        for todo in asked
    ]
    return Rubric([set_points(todo, worth[todo.id]) for todo in kept])


def keep_checks(whole: Todo, programs: set[str], todos: frozenset[str]) -> list[Check]:
    """Return the checks of the whole program in a course with these programs and TODOs."""
    return [
        structs.replace(
            check,
            needs=[each for each in check.needs if each in todos],
            guard=check.guard or (bool(check.needs) and todos.isdisjoint(check.needs)),
        )
        for check in whole.checks
        if (check.module or whole.module) in programs
    ]


def set_points(todo: Todo, points: int) -> Todo:
    """Return a TODO with these points, spread over its checks in the rubric's proportions."""
    shares = spread_points(points, [check.points for check in todo.checks])
    pairs = zip(todo.checks, shares, strict=True)
    return structs.replace(todo, checks=[structs.replace(c, points=p) for c, p in pairs])


def spread_points(points: int, weights: Sequence[int]) -> list[int]:
    """Return whole numbers that add up to `points`, by the largest remainder.

    A share is 0 only if there are fewer points than weights.
    """
    total = sum(weights)
    shares = [points * weight // total for weight in weights]
    order = sorted(range(len(weights)), key=lambda n: -(points * weights[n] % total))
    for n in order[: points - sum(shares)]:
        shares[n] += 1
    while 0 in shares and max(shares, default=0) > 1:
        shares[shares.index(max(shares))] -= 1
        shares[shares.index(0)] += 1
    return shares


# ---------------------------------------------------------------- reading the file


def read_course(path: Path | None = None) -> Course:
    """Read the course in a file, by default the kit's own; raises WrongCourse.

    In a student's copy, it is the course that was handed out.
    """
    if path is None:
        path = next((each for each in (PLACE, HANDED_OUT) if each.exists()), None)
    if path is None:
        return FULL
    try:
        document = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise WrongCourse(f"there is no course at {path}: name a file such as {PLACE}") from error
    except ValueError as error:  # no TOML, or no text
        raise WrongCourse(f"{path} is no TOML: {error}") from error
    for name, at in (("due", END_OF_DAY), ("visible", time())):
        if isinstance(document.get(name), date):
            document[name] = instant(document[name], at)
    try:
        course = next(map(refuse, faults_before(document)), None) or convert(document, Course)
        next(map(refuse, faults_between(course)), None)
    except WrongCourse as wrong:
        raise WrongCourse(f"{path}: {wrong}") from None
    return course


def instant(when: date, at: time) -> datetime:
    """Add the time `at` to a date, and the world's last time zone if it has none.

    So no machine's time zone matters.
    """
    exact = when if isinstance(when, datetime) else datetime.combine(when, at)
    return exact if exact.tzinfo else exact.replace(tzinfo=ANYWHERE)


def refuse(complaint: str) -> Never:
    raise WrongCourse(complaint)


MUST = {  # the rule for each value, by its position in the file; * is any key of a table
    "title": "is no title: write some words in quotes",
    "todos": 'must name TODOs in quotes, as in ["1", "2"]',
    "points": "must be a table: write [points] on a line and 4 = 12 below it",
    "points.*": "must be a whole number from 1 to 1000",
    "out_of": "must be a number above 0, as in out_of = 100",
    "bonus": 'must be "apart", "left out", "fill up", or the maximum number of points',
    "due": f"must be a date without quotes, as in due = {EXAMPLE}",
    "visible": f"must be a date without quotes, as in visible = {EXAMPLE}",
    "late": "must be a table: write [late] on a line and per_day = 10 below it",
    "late.per_day": 'must be a whole number, 0 or more, or a share as "10%"',
    "late.at_most": 'must be a whole number, 0 or more, or a share as "50%"',
    "late.cap": 'must be a whole number, 0 or more, or a share as "80%"',
    "late.*": "must be a whole number, 0 or more",
    "questions": "must be a table: write [questions] and number = 3 below it",
    "questions.points": "must be as in points = { number = 2, why = 3 }",
    "questions.points.*": "must be a whole number from 1 to 100, of number, film or why",
    "questions.*": "must be a whole number from 0 to 10",
}


def convert(document: Any, kind: type[Read]) -> Read:
    """Return a table of the file as a struct; raises WrongCourse with a sentence.

    msgspec does not name the wrong key of a points table, so this looks for it.
    """
    try:
        return msgspec.convert(document, kind)
    except msgspec.ValidationError as error:
        place = re.search(r"`\$\.?([\w.]*)(?:\[.*)?`$", str(error))
        names = [name for name in place[1].split(".") if name] if place else []
        if unknown := re.search(r"unknown field `(.*?)`", str(error)):
            owner = {"late": Late, "questions": Asked}.get(names[-1] if names else "", Course)
            known = ", ".join(
                each for each in owner.__struct_fields__ if each != "due" or not names
            )
            raise WrongCourse(
                f"{': '.join([*names, ''])}there is no key {unknown[1]}; there are {known}"
            ) from None
        value = document
        for name in names:
            value = value[name]
        if isinstance(value, dict) and names[-1] == "points":
            names, value = next(
                ([*names, key], worth)
                for key, worth in value.items()
                if not fits({key: worth}, Asked if len(names) > 1 else Course)
            )
        must = next(MUST[p] for p in (".".join(names), ".".join([*names[:-1], "*"])) if p in MUST)
        shown = ": ".join([*names[:-1], f"{names[-1]} = {value!r} {must}"])
        raise WrongCourse(shown) from None


def fits(points: dict[str, Any], kind: type[Struct]) -> bool:
    with suppress(msgspec.ValidationError):
        msgspec.convert({"points": points}, kind)
        return True
    return False


def faults_before(document: dict[str, Any]) -> Iterator[str]:
    """Yield faults that types allow: keys below the wrong table, a `late` without rules."""
    points, late = document.get("points"), document.get("late")
    for table, name in ((points, "points"), (late, "late")):
        known = Course.__struct_fields__ if name == "points" else ("due",)
        for key in (each for each in known if isinstance(table, dict) and each in table):
            yield f"{name}: {key} stands below [{name}]: write it above that line"
    if isinstance(late, dict) and not late.keys() & {"per_day", "cap", "closed_after"}:
        yield f"late = {late!r} {MUST['late']}"


def faults_between(course: Course) -> Iterator[str]:
    """Yield faults of values that contradict each other."""
    todos = [todo.id for todo in load_rubric().todos]
    if course.todos is not None:
        for each in course.todos:
            if each not in todos:
                yield f"todos: there is no TODO {each!r}; write some of {', '.join(todos)}"
            elif course.todos.count(each) > 1:
                yield f"todos: {each} is listed {course.todos.count(each)} times; list it once"
        asked = [todo for todo in load_rubric().todos if todo.id in course.todos]
        if not any(todo.function and not todo.bonus for todo in asked):
            yield "todos: there are no points without a bonus: add one of TODO 1 to 8c"
        whole = next(
            (todo for todo in choose_todos(course.todos, ()).todos if not todo.function), None
        )
        if whole and all(check.guard for check in whole.checks):
            yield (
                "todos: none of the checks of the whole program needs one of these TODOs, so "
                'its points would be free: leave "whole" out'
            )
    if course.late is not None:
        yield from course.late.find_faults(course.rubric.max_points)
    for name in course.points:
        if name not in (course.todos or todos):
            there = "is not among the todos" if name in todos else "is no TODO"
            yield f"points: {name} {there}: remove it, or add it there"
    if course.due is not None and course.visible is not None and course.visible < course.due:
        visible = f"visible = {course.visible} is before due = {course.due}"
        yield f"{visible}: students could still hand in"
