"""Read what a course takes of the kit: which TODOs, for how many points, until when.

`course.toml` at the top of the kit says it, and is read here alone. What is wrong in it is said in
one sentence, before anything is graded.
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
COURSE_FILE = "COURSE_FILE"  # in the environment: make hands it on to every command
HANDED_OUT = CHECKS / "course.toml"  # in a student's copy, whose rubric has its TODOs alone
EXAMPLE = "2027-05-04T23:59:00+02:00"
END_OF_DAY = time(23, 59, 59)  # when something is due that is due on a day
ANYWHERE = timezone(timedelta(hours=-12), "anywhere on Earth")  # where a day ends last of all


Read = TypeVar("Read", bound=Struct)
Kind = Literal["number", "film", "why"]
Count = Annotated[int, Meta(ge=0)]
Share = Annotated[str, Meta(pattern=r"^(100|\d{1,2})%$")]
Worth = Annotated[int, Meta(ge=1, le=1000)]  # points


class WrongCourse(Stop):
    """Raised if a course file is invalid; names the file and what to write."""


class Late(Struct, frozen=True, forbid_unknown_fields=True):
    """The cost of lateness, begun days counted as whole: in a course, and in decisions."""

    per_day: Count | Share = 0  # points, or a share of those earned, as "10%"
    at_most: Count | Share | None = None  # what lateness takes, in the same way
    grace: Count = 0  # minutes after the due date that cost nothing
    free_days: Count = 0  # late days that each student has
    cap: Count | Share | None = None  # the most that late work can have; a share of full marks
    closed_after: Count | None = None  # days, after which there are no points
    due: datetime | None = None  # in decisions alone: a course has a line of its own for it

    def loss(self, days: int, points: int) -> int:
        """Return the points that `days` late days take off; a begun point of a share is kept."""
        if isinstance(self.per_day, str):
            loss = points * min(days * read_share(self.per_day), 100) // 100
        else:
            loss = days * self.per_day
        if isinstance(self.at_most, str):
            return min(loss, points * read_share(self.at_most) // 100)
        return loss if self.at_most is None else min(loss, self.at_most)

    def in_points(self, most: int) -> "Late":
        """Return the same with the cap in points, where full marks are `most`."""
        if not isinstance(self.cap, str):
            return self
        return structs.replace(self, cap=most * read_share(self.cap) // 100)

    def find_faults(self, most: int) -> Iterator[str]:
        """Yield what a course with `most` points cannot mean."""
        for name in ("per_day", "at_most", "cap"):
            value = getattr(self, name)
            if isinstance(value, int) and value > most:
                full = f"is more than the {most} points that there are"
                yield f'late: {name} = {value} {full}: write fewer, or a share as "10%"'


def read_share(share: str) -> int:
    """Return the percents of `10%`."""
    return int(share.removesuffix("%"))


class Asked(Struct, frozen=True, forbid_unknown_fields=True):
    """The number of questions of each kind on a sheet about the student's own program."""

    number: Annotated[int, Meta(ge=0, le=10)] = 3
    film: Annotated[int, Meta(ge=0, le=10)] = 1
    why: Annotated[int, Meta(ge=0, le=10)] = 2
    points: dict[Kind, Annotated[int, Meta(ge=1, le=100)]] = {}  # of one question; see WORTH

    def worth(self, kind: Kind) -> int:
        """Return the points of one question of a kind."""
        return self.points.get(kind, WORTH[kind])

    @property
    def most_points(self) -> int:
        """Return the points of a sheet with every question that may be on it."""
        counts: dict[Kind, int] = {"number": self.number, "film": self.film, "why": self.why}
        return sum(count * self.worth(kind) for kind, count in counts.items())


WORTH: dict[Kind, int] = {"number": 2, "film": 4, "why": 3}


class Course(Struct, frozen=True, forbid_unknown_fields=True):
    """One course; without any words of its own it takes all that there is.

    `todos`: the ids of its TODOs; None for all of them.
    `points`: what a TODO is worth where that is not what the rubric says.
    `out_of`: what gradebooks scale the points to; None for what the gradebook's own settings say.
    `bonus`: whether the points of bonus tasks are shown apart, left out, added until full marks are
    reached, or added up to this many.
    `due`, `late`: until when work is handed in, and what it costs to be late.
    `visible`: when students are shown why a hidden check failed; None for at once.
    `questions`: what is on the sheets about their own programs, whose points stand apart.
    """

    title: Annotated[str, Meta(pattern=r"\S")] = "Physics engine"
    todos: tuple[str, ...] | None = None
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
        return chosen(todos, tuple(self.points.items()))

    @property
    def given(self) -> list[Todo]:
        """Return the TODOs with a region that it leaves out: their code is handed out done."""
        asked = {todo.id for todo in self.rubric.todos}
        return [todo for todo in load_rubric().todos if todo.function and todo.id not in asked]

    @property
    def modules(self) -> list[str]:
        """Return the programs with a TODO, in the order of the rubric: what is to be handed in."""
        return list(dict.fromkeys(todo.module for todo in self.rubric.todos if todo.function))

    @property
    def as_rated(self) -> "Course":
        """Return the same with the rubric's points, of which each check has at least one."""
        return structs.replace(self, points={})

    def added(self, bonus: int, points: int) -> int:
        """Return how many points of a bonus count with the others, which are `points`."""
        if self.bonus == "fill up":
            return min(bonus, max(self.rubric.max_points - points, 0))
        return 0 if isinstance(self.bonus, str) else min(bonus, self.bonus)

    @property
    def most(self) -> int:
        """Return the most points that a mark can have, with as much of the bonus as counts."""
        bonus = sum(todo.max_points for todo in self.rubric.todos if todo.bonus)
        return self.rubric.max_points + self.added(bonus, self.rubric.max_points)


FULL = Course()


# ---------------------------------------------------------------- the rubric of a course


@cache
def chosen(todos: tuple[str, ...] | None, points: tuple[tuple[str, int], ...]) -> Rubric:
    """Return the rubric with these TODOs alone, in its own order, and with these points.

    The whole program is asked by those of its checks that run a program with a TODO; one that needs
    none of the TODOs counts only once another one passes.
    """
    every = load_rubric().todos
    asked = [todo for todo in every if todos is None or todo.id in todos]
    worth = {todo.id: todo.max_points for todo in asked} | dict(points)
    programs = {todo.module for todo in asked if todo.function and not todo.bonus}
    names = frozenset(todo.id for todo in asked)
    kept = [
        todo if todo.function else structs.replace(todo, checks=asking(todo, programs, names))
        for todo in asked
    ]
    return Rubric([with_points(todo, worth[todo.id]) for todo in kept])


def asking(whole: Todo, programs: set[str], todos: frozenset[str]) -> list[Check]:
    """Return the checks of the whole program that a course with these programs and TODOs has."""
    return [
        structs.replace(
            check,
            needs=[each for each in check.needs if each in todos],
            guard=check.guard or (bool(check.needs) and todos.isdisjoint(check.needs)),
        )
        for check in whole.checks
        if (check.module or whole.module) in programs
    ]


def with_points(todo: Todo, points: int) -> Todo:
    """Return the TODO with these points in all, spread over its checks in their proportion."""
    shares = spread(points, [check.points for check in todo.checks])
    pairs = zip(todo.checks, shares, strict=True)
    return structs.replace(todo, checks=[structs.replace(c, points=p) for c, p in pairs])


def spread(points: int, weights: Sequence[int]) -> list[int]:
    """Return whole numbers that add up to `points`, by the largest remainder.

    None of them is 0, unless there are fewer points than weights.
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
    """Read the course in this file, or else the kit's own; may raise WrongCourse.

    Where there is no kit around the grader, as with students, there is nothing but what they have.
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
    """Return a date of a course: without a time it is `at`, and without a zone anywhere on Earth.

    So it does not depend on the machine's zone, and nobody is late whose own clock is before it.
    """
    exact = when if isinstance(when, datetime) else datetime.combine(when, at)
    return exact if exact.tzinfo else exact.replace(tzinfo=ANYWHERE)


def refuse(complaint: str) -> Never:
    raise WrongCourse(complaint)


# What each value must be, by its place in the file; * is any key of a table.
MUST = {
    "title": "is no title: write some words in quotes",
    "points": "must be a table: write [points] on a line and 4 = 12 below it",
    "points.*": "must be a whole number from 1 to 1000",
    "out_of": "must be a number above 0, as in out_of = 100",
    "bonus": 'must be "apart", "left out", "fill up", or how many points count at most',
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

    msgspec names the place of what is wrong, but not the key in a table of numbers.
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
    """Yield what is wrong with keys and TODOs, which no type can tell, the first to mend first."""
    points, late = document.get("points"), document.get("late")
    for table, name in ((points, "points"), (late, "late")):
        known = Course.__struct_fields__ if name == "points" else ("due",)
        for key in (each for each in known if isinstance(table, dict) and each in table):
            yield f"{name}: {key} stands below [{name}]: write it above that line"
    if isinstance(late, dict) and not late.keys() & {"per_day", "cap", "closed_after"}:
        yield f"late = {late!r} {MUST['late']}"
    yield from wrong_todos(document.get("todos"))


def wrong_todos(todos: Any) -> Iterator[str]:
    if todos is None:
        return
    known = [todo.id for todo in load_rubric().todos]
    if not isinstance(todos, list) or not todos:
        yield f'todos = {todos!r} must name TODOs, as in ["1", "2"]'
        return
    for each in todos:
        if each not in known:
            quoted = " in quotes" if str(each) in known else ""
            yield f"todos: there is no TODO {each!r}; write{quoted} some of {', '.join(known)}"
        elif todos.count(each) > 1:
            yield f"todos: {each} is listed {todos.count(each)} times; list it once"


def faults_between(course: Course) -> Iterator[str]:
    """Yield what is wrong with values that are right by themselves."""
    todos = [todo.id for todo in load_rubric().todos]
    if course.todos is not None:
        asked = [todo for todo in load_rubric().todos if todo.id in course.todos]
        if not any(todo.function and not todo.bonus for todo in asked):
            yield "todos: nobody could earn a point without a bonus: add one of TODO 1 to 8c"
        whole = next((todo for todo in chosen(course.todos, ()).todos if not todo.function), None)
        if whole and all(check.guard for check in whole.checks):
            yield (
                "todos: none of the checks of the whole program needs one of these TODOs, so it "
                'would be given away: leave "whole" out'
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
