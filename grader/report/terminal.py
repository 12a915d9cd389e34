"""Print a result in a terminal: a line per TODO, and a few lines per failed check."""

import os
import textwrap
from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path

import msgspec
from rich.console import Console
from rich.text import Text

from grader.judge.failures import ENDLESS
from grader.judge.result import FAILED, CheckResult, Result, State, TodoResult
from grader.judge.wall.isolation import list_unconfined
from grader.judge.wording import (
    MEANINGS,
    NAMES,
    command,
    format_reasons,
    hidden_points_note,
    place_of,
    python_command,
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
SPENT = (ENDLESS, "not run: the checks before it used up")  # processor time
STATES = 12  # columns of the states
MARGIN = 4  # columns before the reasons of a failure
FIRST = "8a"  # the TODO that the lab sheet begins with
MAX_COLUMNS = 80


def show_isolation(result: Result, console: Console) -> None:
    say(f"isolation: {', '.join(result.isolation)}", console, indent=11, style="bright_black")
    if lacking := list_unconfined(result.isolation):
        words = f"not confined here: {', '.join(lacking)}. Grade only submissions you trust."
        say(words, console, style="yellow")


@dataclass
class Printer:
    """A printer of results; it prints a shared reason once."""

    console: Console
    replays: Path | None = None  # their folder
    printed: set[tuple[str, ...]] = field(default_factory=set)  # reasons

    def print(self, result: Result) -> None:
        for todo in result.todos_to_show:
            self.print_todo(todo)
        words = f"{clean(result.submission)}: {total(result)}"
        say(words, self.console, style="bold")

    def print_todo(self, todo: TodoResult) -> None:
        line = Text(write_todo(todo), style="default")
        line.stylize(STYLES[todo.state], 0, STATES)
        self.console.print(line, soft_wrap=True)
        for checks in group_checks(todo.failed):
            self.print_failed(todo, checks)
        for note in filter(None, [*todo.notes, todo.remark]):
            say(f"  {clean(note)}", self.console, indent=2)
        for checks in group_checks(each for each in todo.checks if each.state == "waiting"):
            say(f"  {name_checks(checks)}: {clean(checks[0].got)}", self.console, indent=4)

    def print_failed(self, todo: TodoResult, checks: list[CheckResult]) -> None:
        """Print the reason that these failed checks share."""
        first, max_points = checks[0], sum(check.max_points for check in checks)
        is_repeated = find_reason(first) in self.printed
        words = f"  {name_checks(checks)}  (0 / {max_points})" + "  as above" * is_repeated
        say(words, self.console, indent=4, style="bold")
        if is_repeated:
            return
        if ("meaning", first.meaning) in self.printed:
            first = msgspec.structs.replace(first, meaning="")
        self.printed |= {find_reason(first), ("meaning", first.meaning)}
        for line in format_reasons(first, task_of(todo)):
            say(f"{' ' * MARGIN}{line}", self.console, indent=MARGIN + NAMES)
        for line in chain(*locate_replay(first, self.replays, self.console)):
            write(line, self.console)


def write_todo(todo: TodoResult) -> str:
    """Return a TODO's state, number, title and points on one line."""
    bonus = " bonus" * todo.bonus
    points = f"{todo.points:>3} / {todo.max_points}{bonus}"
    return f"{todo.state.upper():<{STATES}}{todo.id:<6}{todo.title:<48}{points}"


def locate_replay(
    check: CheckResult, replays: Path | None, console: Console
) -> tuple[list[str], list[str]]:
    """Return the lines with the command of a check's script, and those with its replay's path."""
    path = find_replay(check, replays)
    if path is None:
        return [], []
    rerun, replay = (
        wrap_command(f"{' ' * MARGIN}{name:<{NAMES}}", words, console)
        for name, words in (
            ("Run it", f"{python_command()} {path.removesuffix('.html')}.py"),
            ("See it", path),
        )
    )
    return rerun, replay


def find_replay(check: CheckResult, replays: Path | None) -> str | None:
    """Return the path of a check's replay, relative to the working folder; None if it has none."""
    if replays is None or check.replay is None:
        return None
    return os.path.relpath(replays.parent / check.replay).replace(os.sep, "/")


def group_checks(checks: Iterable[CheckResult]) -> list[list[CheckResult]]:
    groups: dict[tuple[str, ...], list[CheckResult]] = {}
    for check in checks:
        groups.setdefault(find_reason(check), []).append(check)
    return list(groups.values())


def find_reason(check: CheckResult) -> tuple[str, ...]:
    """Return the reason of a failure; for an error, it does not include the call.

    All endless loops have the same reason, for any remaining time.
    """
    if check.state != "error":
        return check.ran, check.expected, check.got
    return ("endless",) if is_endless(check) else (check.got,)


def is_endless(check: CheckResult) -> bool:
    """Return whether a check failed because its processor time was used up."""
    return check.state == "error" and check.got.startswith(SPENT)


def name_checks(checks: list[CheckResult]) -> str:
    return checks[0].title if len(checks) == 1 else plural(len(checks), "check")


def show_all(result: Result, console: Console, replays: Path | None = None) -> None:
    """Print a whole result for its student, the meaning of the states, and what to do next."""
    Printer(console, replays).print(result)
    if words := hidden_points_note(result):
        say(words, console)
    console.print()
    for state, meaning in MEANINGS.items():
        if any(todo.state == state for todo in result.todos_to_show):
            say(f"{state.upper():<{STATES}}{meaning}", console, STATES, "bright_black")
    show_next(result, console)


def show_next(result: Result, console: Console) -> None:
    """Print what to do next; bonus tasks only if nothing else was asked for."""
    todo = choose_todo(result)
    if todo is None or (todo.bonus and result.main_todos):
        return
    if words := describe_obstacle(todo):
        say(words, console, 6, "bold")
        return
    headline, *commands = suggest_todo(todo, result)
    say(headline, console, 6, "bold")
    for line in commands:
        say(line, console)


def choose_todo(result: Result, touched: Collection[str] = ()) -> TodoResult | None:
    """Return the next TODO: the first that fails, or else the first that is not started.

    Bonus tasks come last.
    """
    states = (*FAILED, "not started")
    left = [todo for todo in result.main_todos or result.todos if todo.state in states]
    left = left or [todo for todo in result.todos_to_show if todo.state in FAILED]

    def rank(todo: TodoResult) -> tuple[bool, ...]:
        is_last, is_later = todo.id == "whole", todo.id != FIRST
        return not todo.failed, todo.id not in touched, not todo.remark, is_last, is_later

    begun = [todo for todo in result.todos_to_show if todo.id in touched and todo.failed]
    return min([*begun, *left], key=rank, default=None)


def describe_obstacle(todo: TodoResult) -> str:
    """Return what must be corrected before a TODO can be checked, or an empty text."""
    cannot, _, module = todo.checks[0].ran.partition("import ")
    if todo.state != "error" or not module or cannot:
        return ""
    return f"Next: correct {find_place(todo)}. Until then nothing in {module} can be checked"


def suggest_todo(todo: TodoResult, result: Result) -> list[str]:
    """Return the name of the next TODO and the commands to type for it."""
    place = find_place(todo)
    lines = [f"Next: TODO {todo.id}, {todo.title}" + f" ({place})" * bool(place)]
    if len(result.todos) > 1:
        lines.append(f"  check it alone: {command('check', todo.id)}")
    if todo.id != "whole":
        lines.append(f"  a hint:         {command('hint', todo.id)}")
    return lines


def find_place(todo: TodoResult) -> str:
    return next(filter(None, map(place_of, todo.checks)), "")


def say(words: str, console: Console, indent: int = 0, style: str = "") -> None:
    """Print words, wrapped; all lines but the first are indented."""
    for line in wrap(words, console, indent):
        write(line, console, style)


def wrap(words: str, console: Console, indent: int = 0, whole: bool = False) -> list[str]:
    """Wrap words into lines; a word longer than a line is broken unless it must stay `whole`."""
    return textwrap.wrap(
        words,
        min(console.width, MAX_COLUMNS),
        subsequent_indent=" " * indent,
        break_on_hyphens=False,
        break_long_words=not whole,
    )


def wrap_command(name: str, words: str, console: Console) -> list[str]:
    """Return a named command on one line, so that it can be copied; the name may stand above."""
    line = name + words
    return [line] if len(line) <= min(console.width, MAX_COLUMNS) else [name.rstrip(), f"  {words}"]


def write(line: str, console: Console, style: str = "") -> None:
    """Print a line in the terminal's encoding."""
    if not console.encoding.startswith("utf"):  # such as a Windows file or pipe
        for letter, plain in (("→", "->"), ("…", "...")):
            line = line.replace(letter, plain)
        line = line.encode(console.encoding, "replace").decode(console.encoding)
    console.print(Text(line, style=style), soft_wrap=True)
