"""The result in a terminal: one line per TODO, and a few for each check that is not there yet."""

import os
import sys
import textwrap
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import msgspec
from rich.console import Console
from rich.text import Text

from grader.judge.isolation import unconfined
from grader.judge.result import CheckResult, Result, State, TodoResult
from grader.judge.rubric import load_rubric

LABELS: dict[State, tuple[str, str]] = {
    "passed": ("PASSED", "green"),
    "not yet": ("NOT YET", "yellow"),
    "not started": ("NOT STARTED", "bright_black"),
    "waiting": ("WAITING", "bright_black"),
    "error": ("ERROR", "red"),
}
MEANINGS: dict[State, str] = {
    "not yet": "a check got another answer than the right one",
    "not started": "only what was handed out is there",
    "waiting": "something else must pass first; the line below it says what",
    "error": "the code raised an error, or gave no answer",
}
FAILED = ("not yet", "error")
STATES = 12  # columns of the states
NAMES = 14  # columns up to the words of *Got* and the like
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
        label, style = LABELS[todo.state]
        line = Text(label.ljust(STATES), style=style)
        line.append(f"{todo.id:<6}{todo.title:<48}", style="default")
        bonus = " bonus" * todo.bonus
        line.append(f"{todo.points:>3} / {todo.max_points}{bonus}", style="default")
        self.console.print(line, soft_wrap=True)
        for checks in alike(each for each in todo.checks if each.state in FAILED):
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
        for line in reasons(first, f", TODO {todo.id}" * (todo.id != "whole")):
            say(f"    {line}", self.console, indent=NAMES)
        if self.replays is not None and first.replay is not None:
            path = os.path.relpath(self.replays.parent / first.replay).replace(os.sep, "/")
            say(f"    {'See it':<9} {path}", self.console, indent=2, whole=True)


def total(result: Result) -> str:
    """The points, and the bonus apart from them; the bonus alone where nothing else was asked."""
    if not result.counted:
        return f"{result.bonus} bonus"
    bonus = f"  and {result.bonus} bonus" if result.bonus else ""
    return f"{result.points} / {result.max_points}{bonus}"


def alike(checks: Iterable[CheckResult]) -> list[list[CheckResult]]:
    """The checks in groups that have the same reason."""
    groups: dict[tuple[str, ...], list[CheckResult]] = {}
    for check in checks:
        groups.setdefault(reason(check), []).append(check)
    return list(groups.values())


def reason(check: CheckResult) -> tuple[str, ...]:
    """What is equal for two checks that failed alike: an error is one, whatever was run."""
    return (check.got,) if check.state == "error" else (check.ran, check.expected, check.got)


def subject(checks: list[CheckResult]) -> str:
    return checks[0].title if len(checks) == 1 else f"{len(checks)} checks"


def reasons(check: CheckResult, task: str = "") -> list[str]:
    """Why a check is not passed, a line each; `task` stands behind the place to look at."""
    return [f"{name:<9} {clean(words)}" for name, words in check.reasons(task)]


def show_standing(result: Result, teller: Teller) -> None:
    """Print what a student wants to know: the result, what its words mean, and what comes next."""
    teller.tell(result)
    shown = {todo.id for todo in result.todos}
    hidden = sum(todo.hidden_points for todo in load_rubric().counted if todo.id in shown)
    if hidden:
        words = f"{hidden} more points come from checks that only your instructor runs."
        say(words, teller.console)
    teller.console.print()
    show_states(result, teller.console)
    show_next(result, teller.console)


def show_states(result: Result, console: Console) -> None:
    """Say what the states mean, those that are there."""
    for state, meaning in MEANINGS.items():
        if any(todo.state == state for todo in result.shown):
            say(f"{LABELS[state][0]:<{STATES}}{meaning}", console, STATES, "bright_black")


def show_next(result: Result, console: Console) -> None:
    """The one thing to do next: the first TODO that was begun, or else the first of all.

    No bonus task, unless nothing else was asked.
    """
    asked = result.counted or result.todos
    left = [todo for todo in asked if todo.state in (*FAILED, "not started")]
    if not left:
        return
    todo = min(left, key=lambda each: (each.id == "whole", each.state == "not started"))
    place = next((f"{c.where.file}:{c.where.line}" for c in todo.checks if c.where), "")
    cannot, _, module = todo.checks[0].ran.partition("import ")
    if todo.state == "error" and module and not cannot:
        say(f"Next: mend {place}: nothing in {module} can be checked before", console, 6, "bold")
        return
    say(f"Next: TODO {todo.id}, {todo.title}" + f" ({place})" * bool(place), console, 6, "bold")
    say(f"  check it alone: {command('check', todo.id)}", console)
    if todo.id != "whole":
        say(f"  a hint:         {command('hint', todo.id)}", console)


def command(name: str, todo: str, level: int = 1) -> str:
    """One of the student's commands, as this person would type it here."""
    if "MAKELEVEL" in os.environ:
        return f"make {name} TODO={todo}" + f" LEVEL={level}" * (level > 1)
    python = sys.orig_argv[0]
    start = "python -m grader" if os.path.isabs(python) else f"{python} -m grader"
    if os.path.basename(sys.argv[0]) == "grader":
        start = "grader"
    return f"{start} {name} --todo {todo}" + f" --level {level}" * (level > 1)


def say(
    words: str, console: Console, indent: int = 0, style: str = "", whole: bool = False
) -> None:
    """Print words; what does not fit on their line goes on below, `indent` columns in.

    A single word that is longer than a line is broken, unless it must stay `whole`.
    """
    if not console.encoding.startswith("utf"):  # such as a Windows file or pipe
        words = (
            words.replace("→", "->").encode(console.encoding, "replace").decode(console.encoding)
        )
    lines = textwrap.wrap(
        words,
        min(console.width, WIDTH),
        subsequent_indent=" " * indent,
        break_on_hyphens=False,
        break_long_words=not whole,
    )
    console.print(Text("\n".join(lines), style=style), soft_wrap=True)


def clean(words: str) -> str:
    """A submission's words on one line, with nothing that a terminal would obey."""
    return "".join(c if c.isprintable() else " " for c in words)[:400]
