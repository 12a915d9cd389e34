"""Word the parts that every form of a report shares: reasons, points, and commands to type."""

import os
import sys
from datetime import datetime

from msgspec import structs

from grader.judge.course import Course
from grader.judge.result import CheckResult, Result, State, TodoResult
from grader.judge.rubric import load_rubric
from grader.text import clean, format_time, plural

MEANINGS: dict[State, str] = {
    "not yet": "a check got another answer than the right one",
    "not started": "only what was handed out is there",
    "waiting": "something else must pass first; the line below it says what",
    "error": "the code raised an error, or gave no answer",
}
NAMES = 10  # columns before the words of *Got* and other labels


# ---------------------------------------------------------------- why a check failed


def list_reasons(check: CheckResult, task: str = "") -> list[tuple[str, str]]:
    """Return a failed check's reasons, as named lines; `task` follows a line of the TODO's code."""
    place = place_of(check) + task * (not check.where.given) if check.where else ""
    words = (
        ("We ran", check.ran),
        ("Expected", check.expected),
        ("Got", check.got),
        ("Printed", check.printed or ""),
        ("Meaning", check.meaning),
        ("Look at", place),
    )
    return [(name, text) for name, text in words if text]


def format_reasons(check: CheckResult, task: str = "") -> list[str]:
    """Return the reasons of a failed check, as lines of text."""
    return [f"{name:<{NAMES}}{clean(words)}" for name, words in list_reasons(check, task)]


def place_of(check: CheckResult) -> str:
    """Return the student's file and line; empty if none is known."""
    return f"{check.where.file}:{check.where.line}" if check.where else ""


def add_task(todo: TodoResult, title: str) -> str:
    """Return a title with the number of its TODO; the whole program has none."""
    return title if todo.id == "whole" else f"TODO {todo.id}: {title}"


def task_of(todo: TodoResult) -> str:
    """Return the words after a line to look at; the whole program is no TODO."""
    return "" if todo.id == "whole" else f", TODO {todo.id}"


# ---------------------------------------------------------------- points and numbers


def total(result: Result) -> str:
    """Return the points and the bonus; the bonus alone if there is nothing else."""
    if not result.main_todos:
        return f"{result.bonus} bonus"
    bonus = f"  and {result.bonus} bonus" if result.bonus else ""
    return f"{result.points} / {result.max_points}{bonus}"


def points_in_words(result: Result) -> str:
    bonus = f", and {result.bonus} bonus" if result.bonus else ""
    return f"{result.points} of {result.max_points} points{bonus}"


def hidden_points_note(result: Result) -> str:
    """Mention the points of checks that a student's copy lacks; empty if it lacks none."""
    here = {todo.id for todo in result.todos}
    points = sum(todo.hidden_points for todo in load_rubric().main_todos if todo.id in here)
    words = f"Your instructor runs more checks, for {plural(points, 'more point')}."
    return words if points else ""


# ---------------------------------------------------------------- commands


def command(
    name: str, todo: str = "", level: int = 1, all_of_it: bool = False, restore: str = ""
) -> str:
    """Return one of the student's commands, as they type it here."""
    if "MAKELEVEL" in os.environ:
        words = f"make {name}" + f" TODO={todo}" * bool(todo) + f" LEVEL={level}" * (level > 1)
        return words + " ALL=1" * all_of_it + f" RESTORE={restore}" * bool(restore)
    start = f"{python_command()} -m grader"
    if os.path.basename(sys.argv[0]) == "grader":
        start = "grader"
    words = f"{start} {name}" + f" --todo {todo}" * bool(todo) + f" --level {level}" * (level > 1)
    return words + " --all" * all_of_it + f" --restore {restore}" * bool(restore)


def python_command() -> str:
    """Return the word that started Python on the command line."""
    python = sys.orig_argv[0]
    return "python" if os.path.isabs(python) else python


# ---------------------------------------------------------------- hidden reasons


def withhold_reasons(result: Result, course: Course, now: datetime | None = None) -> Result:
    """Withhold the reasons of hidden checks until the course's day."""
    when = course.visible
    if when is None or (now or datetime.now(when.tzinfo)) >= when:
        return result
    later = f"shown from {format_time(when)} on"
    hidden = {(todo.id, c.id) for todo in course.rubric.todos for c in todo.checks if c.hidden}
    todos = [
        structs.replace(
            todo,
            checks=[
                structs.replace(
                    each, ran="", expected="", got=later, meaning="", where=None, replay=None
                )
                if each.failed and (todo.id, each.id) in hidden
                else each
                for each in todo.checks
            ],
        )
        for todo in result.todos
    ]
    return structs.replace(result, todos=todos)
