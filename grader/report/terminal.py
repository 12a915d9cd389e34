"""The result in a terminal: one line per TODO, and a few for each check that is not there yet."""

import os
import textwrap
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import msgspec
from rich.console import Console
from rich.text import Text

from grader.judge.isolation import unconfined
from grader.judge.result import FAILED, CheckResult, Result, State, TodoResult
from grader.judge.wording import (
    MEANINGS,
    NAMES,
    command,
    hidden_points_note,
    place_of,
    reasons,
    task_of,
    total,
)
from grader.text import clean, plural

STYLES: dict[State, str] = {
    "passed": "green",
    "not yet": "yellow",
    "not started": "bright_black",
    "waiting": "bright_black",
    "error": "red",
}
ENDLESS = ("it used up its", "not run: the checks before it used up")  # of processor time
STATES = 12  # columns of the states
MARGIN = 4  # columns left of why a check failed
WIDTH = 80  # at most


def show(result: Result, console: Console) -> None:
    """Print the whole result."""
    Teller(console).tell(result)


def show_isolation(result: Result, console: Console) -> None:
    """Print what held the submission in, and what did not."""
    say(f"isolation: {', '.join(result.isolation)}", console, indent=11, style="bright_black")
    if lacking := unconfined(result.isolation):
        words = f"not confined here: {', '.join(lacking)}. Grade only submissions you trust."
        say(words, console, style="yellow")


@dataclass
class Teller:
    """Prints results. A reason that many checks share is given once."""

    console: Console
    replays: Path | None = None  # where they are, if there are any
    told: set[tuple[str, ...]] = field(default_factory=set)

    def tell(self, result: Result) -> None:
        for todo in result.shown:
            self.tell_todo(todo)
        words = f"{clean(result.submission)}: {total(result)}"
        say(words, self.console, style="bold")

    def tell_todo(self, todo: TodoResult) -> None:
        line = Text(todo_line(todo), style="default")
        line.stylize(STYLES[todo.state], 0, STATES)
        self.console.print(line, soft_wrap=True)
        for checks in alike(todo.failed):
            self.tell_failed(todo, checks)
        for checks in alike(each for each in todo.checks if each.state == "waiting"):
            say(f"  {subject(checks)}: {clean(checks[0].got)}", self.console, indent=4)

    def tell_failed(self, todo: TodoResult, checks: list[CheckResult]) -> None:
        """Print what checks have to say that all failed for the same reason."""
        first, max_points = checks[0], sum(check.max_points for check in checks)
        known = reason(first) in self.told
        words = f"  {subject(checks)}  (0 / {max_points})" + "  as above" * known
        say(words, self.console, indent=4, style="bold")
        if known:
            return
        if ("meaning", first.meaning) in self.told:
            first = msgspec.structs.replace(first, meaning="")
        self.told |= {reason(first), ("meaning", first.meaning)}
        for line in reasons(first, task_of(todo)):
            say(f"{' ' * MARGIN}{line}", self.console, indent=MARGIN + NAMES)
        if self.replays is not None and first.replay is not None:
            path = os.path.relpath(self.replays.parent / first.replay).replace(os.sep, "/")
            say(f"{' ' * MARGIN}{'See it':<{NAMES}}{path}", self.console, indent=2, whole=True)


def todo_line(todo: TodoResult) -> str:
    """A TODO's state, number, title and points."""
    bonus = " bonus" * todo.bonus
    points = f"{todo.points:>3} / {todo.max_points}{bonus}"
    return f"{todo.state.upper():<{STATES}}{todo.id:<6}{todo.title:<48}{points}"


def alike(checks: Iterable[CheckResult]) -> list[list[CheckResult]]:
    """The checks in groups that have the same reason."""
    groups: dict[tuple[str, ...], list[CheckResult]] = {}
    for check in checks:
        groups.setdefault(reason(check), []).append(check)
    return list(groups.values())


def reason(check: CheckResult) -> tuple[str, ...]:
    """What is equal for two checks that failed alike: an error is one, whatever was run.

    A loop that never ends is one, too, however much time a check had left for it.
    """
    if check.state != "error":
        return check.ran, check.expected, check.got
    return ("endless",) if check.got.startswith(ENDLESS) else (check.got,)


def subject(checks: list[CheckResult]) -> str:
    return checks[0].title if len(checks) == 1 else plural(len(checks), "check")


def show_standing(result: Result, teller: Teller) -> None:
    """Print what a student wants to know: the result, what its words mean, and what comes next."""
    teller.tell(result)
    if words := hidden_points_note(result):
        say(words, teller.console)
    teller.console.print()
    show_states(result, teller.console)
    show_next(result, teller.console)


def show_states(result: Result, console: Console) -> None:
    """Say what the states mean, those that are there."""
    for state, meaning in MEANINGS.items():
        if any(todo.state == state for todo in result.shown):
            say(f"{state.upper():<{STATES}}{meaning}", console, STATES, "bright_black")


def show_next(result: Result, console: Console) -> None:
    """The one thing to do next: the first TODO that was begun, or else the first of all.

    No bonus task, unless nothing else was asked.
    """
    asked = result.counted or result.todos
    left = [todo for todo in asked if todo.state in (*FAILED, "not started")]
    if not left:
        return
    todo = min(left, key=lambda each: (each.id == "whole", each.state == "not started"))
    if words := mend_first(todo):
        say(words, console, 6, "bold")
        return
    headline, *commands = go_on_with(todo)
    say(headline, console, 6, "bold")
    for line in commands:
        say(line, console)


def mend_first(todo: TodoResult) -> str:
    """What must be mended before anything else can be said of a TODO; empty where nothing must."""
    cannot, _, module = todo.checks[0].ran.partition("import ")
    if todo.state != "error" or not module or cannot:
        return ""
    return f"Next: mend {first_place(todo)}: nothing in {module} can be checked before"


def go_on_with(todo: TodoResult) -> list[str]:
    """The TODO to go on with, and what to type for it."""
    place = first_place(todo)
    lines = [f"Next: TODO {todo.id}, {todo.title}" + f" ({place})" * bool(place)]
    lines.append(f"  check it alone: {command('check', todo.id)}")
    if todo.id != "whole":
        lines.append(f"  a hint:         {command('hint', todo.id)}")
    return lines


def first_place(todo: TodoResult) -> str:
    return next(filter(None, map(place_of, todo.checks)), "")


def say(
    words: str, console: Console, indent: int = 0, style: str = "", whole: bool = False
) -> None:
    """Print words; what does not fit on their line goes on below, `indent` columns in.

    A single word that is longer than a line is broken, unless it must stay `whole`.
    """
    for line in wrapped(words, console, indent, whole):
        write(line, console, style)


def wrapped(words: str, console: Console, indent: int = 0, whole: bool = False) -> list[str]:
    """The lines that words take; see `say`."""
    return textwrap.wrap(
        words,
        min(console.width, WIDTH),
        subsequent_indent=" " * indent,
        break_on_hyphens=False,
        break_long_words=not whole,
    )


def write(line: str, console: Console, style: str = "") -> None:
    """Print a line, in the letters that the terminal knows."""
    if not console.encoding.startswith("utf"):  # such as a Windows file or pipe
        for letter, plain in (("→", "->"), ("…", "...")):
            line = line.replace(letter, plain)
        line = line.encode(console.encoding, "replace").decode(console.encoding)
    console.print(Text(line, style=style), soft_wrap=True)
