"""What a course takes of the kit: which TODOs, for how many points, until when.

`course.toml` at the top of the kit says it, and is read here alone. What is wrong in it is said in
one sentence, before anything is graded.
"""

import re
import tomllib
from collections.abc import Iterator, Sequence
from datetime import date, datetime, time, timedelta, timezone
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Literal

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


class WrongCourse(Stop):
    """A course cannot be as its file says; the message names the file and what to write."""


Count = Annotated[int, Meta(ge=0)]
Share = Annotated[str, Meta(pattern=r"^\d+%$")]


class Late(Struct, frozen=True, forbid_unknown_fields=True):
    """What lateness costs, begun days counted as whole: in a course, and in a class's decisions."""

    per_day: Count | Share = 0  # points, or a share of those earned, as "10%"
    at_most: Count = 100  # points that lateness takes
    grace: Count = 0  # minutes after the due date that cost nothing
    free_days: Count = 0  # late days that each student has
    cap: Count | None = None  # the most that late work can have
    closed_after: Count | None = None  # days, after which there are no points
    due: datetime | None = None  # in decisions alone: a course has a line of its own for it

    def loss(self, days: int, points: int) -> int:
        """The points that so many days take off `points`; a begun point of a share is kept."""
        if isinstance(self.per_day, str):
            share = min(days * int(self.per_day.removesuffix("%")), 100)
            return min(points * share // 100, self.at_most)
        return min(days * self.per_day, self.at_most)


class Asked(Struct, frozen=True, forbid_unknown_fields=True):
    """How many questions of each kind a sheet about the student's own program has."""

    number: int = 3
    film: int = 1
    line: int = 1
    why: int = 2
    points: dict[str, int] = {}  # of one question, by its kind; see WORTH for the others

    def worth(self, kind: str) -> int:
        """The points of one question of a kind."""
        return self.points.get(kind, WORTH[kind])


WORTH = {"number": 2, "film": 4, "line": 3, "why": 3}


class Course(Struct, frozen=True, forbid_unknown_fields=True):
    """One course; without any words of its own it takes all that there is.

    `todos`: the ids of its TODOs; None for all of them.
    `points`: what a TODO is worth where that is not what the rubric says.
    `out_of`: what gradebooks scale the points to; None for what the gradebook's own settings say.
    `bonus`: whether the points of bonus tasks are shown apart, left out, or added up to this many.
    `due`, `late`: until when work is handed in, and what it costs to be late.
    `visible`: when students are shown why a hidden check failed; None for at once.
    `questions`: what is on the sheets about their own programs, whose points stand apart.
    """

    title: str = "Physics engine"
    todos: tuple[str, ...] | None = None
    points: dict[str, int] = {}
    out_of: float | None = None
    bonus: Literal["apart", "left out"] | int = "apart"
    due: datetime | None = None
    late: Late | None = None
    visible: datetime | None = None
    questions: Asked = Asked()

    @property
    def rubric(self) -> Rubric:
        """The rubric of this course."""
        todos = self.todos
        if self.bonus == "left out":
            known = [todo.id for todo in load_rubric().todos] if todos is None else todos
            todos = tuple(todo for todo in known if not is_bonus(todo))
        return chosen(todos, tuple(self.points.items()))

    @property
    def given(self) -> list[Todo]:
        """The TODOs with a region that it leaves out: their code is handed out done."""
        asked = {todo.id for todo in self.rubric.todos}
        return [todo for todo in load_rubric().todos if todo.function and todo.id not in asked]

    @property
    def modules(self) -> list[str]:
        """The programs with a TODO, in the order of the rubric: what is to be handed in."""
        return list(dict.fromkeys(todo.module for todo in self.rubric.todos if todo.function))

    @property
    def as_rated(self) -> "Course":
        """The same with the rubric's points, of which each check has at least one."""
        return structs.replace(self, points={})

    def added(self, bonus: int) -> int:
        """How many points of a bonus count with the others."""
        return 0 if isinstance(self.bonus, str) else min(bonus, self.bonus)

    @property
    def most(self) -> int:
        """The most points that a mark can have, with as much of the bonus as counts."""
        bonus = sum(todo.max_points for todo in self.rubric.todos if todo.bonus)
        return self.rubric.max_points + self.added(bonus)


FULL = Course()


# ---------------------------------------------------------------- the rubric of a course


@cache
def chosen(todos: tuple[str, ...] | None, points: tuple[tuple[str, int], ...]) -> Rubric:
    """The rubric with these TODOs alone, in its own order, and with these points where it says so.

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
    """The checks of the whole program that a course with these programs and TODOs has."""
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
    """The TODO worth so many points, its checks in the proportion that they had."""
    shares = spread(points, [check.points for check in todo.checks])
    pairs = zip(todo.checks, shares, strict=True)
    return structs.replace(todo, checks=[structs.replace(c, points=p) for c, p in pairs])


def spread(points: int, weights: Sequence[int]) -> list[int]:
    """Whole numbers that add up to `points`, by the largest remainder.

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
    """The course in this file, or else the kit's own; raises WrongCourse where it cannot be so.

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
    complaint = next(complaints(document), "")
    if complaint:
        raise WrongCourse(f"{path}: {complaint}")
    try:
        return msgspec.convert(document, Course)
    except msgspec.ValidationError as error:
        raise WrongCourse(f"{path}: {error}") from error


def instant(when: date, at: time) -> datetime:
    """A date of a course: without a time it is `at`, and without a zone anywhere on Earth.

    So it does not depend on the machine's zone, and nobody is late whose own clock is before it.
    """
    exact = when if isinstance(when, datetime) else datetime.combine(when, at)
    return exact if exact.tzinfo else exact.replace(tzinfo=ANYWHERE)


def complaints(document: dict[str, Any]) -> Iterator[str]:
    """All that is wrong with a course, a sentence each, the one to mend first."""
    yield from strangers(document)
    yield from wrong_todos(document.get("todos"))
    yield from wrong_points(document)
    yield from wrong_numbers(document)
    yield from wrong_questions(document.get("questions", {}))
    yield from wrong_dates(document)


def strangers(document: dict[str, Any]) -> Iterator[str]:
    known = Course.__struct_fields__
    for name in document.keys() - set(known):
        yield f"there is no key {name}; there are {', '.join(known)}"
    title = document.get("title", "")
    if not isinstance(title, str) or (not title.strip() and "title" in document):
        yield f"title = {title!r} is no title: write some words in quotes"


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
            yield f"todos: {each} stands there {todos.count(each)} times, and needs to stand once"
    asked = [todo for todo in load_rubric().todos if todo.id in todos]
    if not any(todo.function and not todo.bonus for todo in asked):
        yield "todos: nobody could earn a point without a bonus: add one of TODO 1 to 8c"
    whole = next((todo for todo in chosen(tuple(todos), ()).todos if not todo.function), None)
    if whole and all(check.guard for check in whole.checks):
        yield (
            "todos: none of the checks of the whole program needs one of these TODOs, so it would "
            'be given away: leave "whole" out'
        )


def wrong_points(document: dict[str, Any]) -> Iterator[str]:
    points = document.get("points", {})
    if not isinstance(points, dict):
        yield f"points = {points!r} must be a table: write [points] on a line and 4 = 12 below it"
        return
    known = [todo.id for todo in load_rubric().todos]
    for name, worth in points.items():
        if name in Course.__struct_fields__:
            yield f"points: {name} stands below [points]: write it above that line"
        elif name not in document.get("todos", known):
            there = "is not among the todos" if name in known else "is no TODO"
            yield f"points: {name} {there}: remove it, or add it there"
        elif type(worth) is not int or not 1 <= worth <= 1000:
            yield f"points: {name} = {worth!r} must be a whole number from 1 to 1000"


def wrong_numbers(document: dict[str, Any]) -> Iterator[str]:
    out_of, bonus, late = (document.get(name) for name in ("out_of", "bonus", "late"))
    if out_of is not None and (type(out_of) not in (int, float) or not 0 < out_of <= 100_000):
        yield f"out_of = {out_of!r} must be a number above 0, as in out_of = 100"
    words = bonus in ("apart", "left out")
    if bonus is not None and not words and (type(bonus) is not int or bonus < 0):
        yield f'bonus = {bonus!r} must be "apart", "left out", or how many points count at most'
    if late is None:
        return
    if not isinstance(late, dict) or not late.keys() & {"per_day", "cap", "closed_after"}:
        yield f"late = {late!r} must be a table: write [late] on a line and per_day = 10 below it"
    elif "due" in late:
        yield "late: due stands below [late]: write it above that line"
    else:
        yield from wrong_late(late)


def wrong_late(late: dict[str, Any]) -> Iterator[str]:
    """All that is wrong with rules for late work; their date aside."""
    known = [name for name in Late.__struct_fields__ if name != "due"]
    for name, worth in late.items():
        share = isinstance(worth, str) and re.fullmatch(r"\d+%", worth)
        if name not in known:
            yield f"late: there is no key {name}; there are {', '.join(known)}"
        elif name == "per_day" and isinstance(worth, str) and not share:
            yield f'late: per_day = {worth!r} must be points, or a share as "10%"'
        elif not (name == "per_day" and share) and (type(worth) is not int or worth < 0):
            yield f"late: {name} = {worth!r} must be a whole number, 0 or more"


def wrong_questions(asked: Any) -> Iterator[str]:
    """All that is wrong with the sheets of questions."""
    if not isinstance(asked, dict):
        yield f"questions = {asked!r} must be a table: write [questions] and number = 3 below it"
        return
    points = asked.get("points", {})
    if not isinstance(points, dict):
        yield f"questions: points = {points!r} must be as in points = {{ number = 2, why = 3 }}"
        return
    for name in [*asked, *points]:
        if name not in WORTH and (name in points or name != "points"):
            yield f"questions: there is no kind {name}; there are {', '.join(WORTH)}"
    for name, count in asked.items():
        if name in WORTH and (type(count) is not int or not 0 <= count <= 10):
            yield f"questions: {name} = {count!r} must be a whole number from 0 to 10"
    for name, worth in points.items():
        if type(worth) is not int or not 1 <= worth <= 100:
            yield f"questions: points of {name} = {worth!r} must be a whole number from 1 to 100"


def wrong_dates(document: dict[str, Any]) -> Iterator[str]:
    for name in ("due", "visible"):
        when = document.get(name)
        if when is not None and not isinstance(when, datetime):
            yield f"{name} = {when!r} must be a date without quotes, as in {name} = {EXAMPLE}"
            return
    due, visible = document.get("due"), document.get("visible")
    if due is not None and visible is not None and visible < due:
        yield f"visible = {visible} is before due = {due}: students could still hand in"
