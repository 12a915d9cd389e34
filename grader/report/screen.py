"""The first screen of `check`: one TODO in full, all of it on the lines that a terminal shows."""

import os
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from rich.console import Console

from grader.judge.result import FAILED, CheckResult, Result, State, TodoResult
from grader.judge.wording import NAMES, command, named_reasons, task_of, total
from grader.report.terminal import (
    MARGIN,
    STATES,
    STYLES,
    alike,
    go_on_with,
    mend_first,
    subject,
    todo_line,
    wrapped,
    write,
)
from grader.text import clean

LINES = 16  # before the prompt
WIDTH = 76  # columns of a TODO's own line, at the end of which the points stand
COLUMNS = 80  # at most
CAUSES = ("Meaning", "Got", "Expected", "Look at", "We ran")  # who is given lines first


class Line(NamedTuple):
    text: str
    style: str = ""


@dataclass
class Screen:
    """Prints a result on so many `lines` at most."""

    console: Console
    replays: Path | None = None  # where they are, if there are any
    lines: int = LINES

    def show(
        self, result: Result, touched: Collection[str] = (), notes: Sequence[str] = ()
    ) -> None:
        """Print it. A TODO that was `touched` is shown before others; `notes` stand at the end."""
        for line in self.laid_out(result, touched, notes):
            write(line.text, self.console, line.style)

    def laid_out(
        self, result: Result, touched: Collection[str] = (), notes: Sequence[str] = ()
    ) -> list[Line]:
        todo = current(result, touched)
        said = [Line(each) for note in notes for each in self.wrap(note, 2)]
        if todo is None or not todo.failed:
            return [*self.standing(result, None), *said, *self.next_lines(todo)]
        head = self.fitting(todo_line(todo))
        standing = [*self.standing(result, todo), Line(head, STYLES[todo.state])]
        said += self.last_lines(todo)
        room = self.lines - len(standing) - len(said)
        return [*standing, *self.failed_lines(todo, room), *said]

    @property
    def width(self) -> int:
        return min(self.console.width, COLUMNS)

    def fitting(self, line: str) -> str:
        """A TODO's own line as it is, or where it is too long, its words without the columns."""
        return line if len(line) <= self.width else self.cut(" ".join(line.split()))

    def wrap(self, words: str, indent: int = 0, whole: bool = False) -> list[str]:
        return wrapped(words, self.console, indent, whole)

    def in_bold(self, words: str) -> list[Line]:
        return [Line(each, "bold") for each in self.wrap(words, 6)]

    # ------------------------------------------------------------ how it stands

    def standing(self, result: Result, apart: TodoResult | None) -> list[Line]:
        """The TODOs by their states, but the one that has lines of its own, and the points."""
        rows: list[Line] = []
        for states in (["passed"], ["error"], ["not yet"], ["not started", "waiting"]):
            parts = [row(result, state, apart) for state in STYLES if state in states]
            words = "   ".join(filter(None, parts))
            style = STYLES[next(state for state in STYLES if state in states)]
            rows += [Line(each, style) for each in self.wrap(words, STATES)] if words else []
        points = total(result)
        free = WIDTH - len(rows[0].text) if rows else 0
        if free <= len(points) or self.console.width < WIDTH:
            return [Line(points, "bold"), *rows]
        return [Line(rows[0].text + points.rjust(free), rows[0].style), *rows[1:]]

    def next_lines(self, todo: TodoResult | None) -> list[Line]:
        """What to begin with, where nothing that was begun fails."""
        if todo is None:
            return []
        headline, *commands = go_on_with(todo)
        return [*self.in_bold(headline), *map(Line, commands)]

    def last_lines(self, todo: TodoResult) -> list[Line]:
        """What to type, or what must be mended before anything else can be said."""
        all_of_it = f"All: {command('check', all_of_it=True)}"
        if words := mend_first(todo):
            return self.in_bold(words)
        if todo.id == "whole":
            return [Line(all_of_it)]
        both = f"A hint: {command('hint', todo.id)}   {all_of_it}"
        lines = [both] if len(both) <= self.width else both.split("   ")
        return [Line(each) for each in lines]

    # ------------------------------------------------------------ what fails

    def failed_lines(self, todo: TodoResult, room: int) -> list[Line]:
        """The first failure in full, and the others a line each, as far as there is room."""
        groups = alike(todo.failed)
        first = min(groups, key=urgency)
        titles = [self.title(each, points_of(each)) for each in groups if each is not first]
        waiting = alike(check for check in todo.checks if check.state == "waiting")
        titles += [self.title(each, clean(each[0].got)) for each in waiting]
        below = self.details(todo, first[0], room - 1 - bool(titles))
        left = room - 1 - len(below)
        if len(titles) > left:
            kept = max(left - 1, 0)
            titles = [*titles[:kept], f"  and {len(titles) - kept} more"] if titles else []
        lines = [Line(self.title(first, points_of(first)), "bold"), *map(Line, below)]
        return [*lines, *(Line(title, "bright_black") for title in titles)]

    def title(self, group: list[CheckResult], behind: str) -> str:
        """What checks are called, on one line, with something behind it."""
        return self.cut(f"  {subject(group)}", len(behind) + 2) + f"  {behind}"

    def cut(self, words: str, less: int = 0) -> str:
        """The words on one line, which ends with dots where they are longer."""
        most = self.width - less
        return words if len(words) <= most else f"{words[: max(most - 2, 1)].rstrip()} …"

    def details(self, todo: TodoResult, check: CheckResult, room: int) -> list[str]:
        """Why a check failed. Each text has a line; what is left of `room` goes to the cause."""
        texts = {
            name: self.wrap(f"{' ' * MARGIN}{name:<{NAMES}}{clean(text)}", MARGIN + NAMES)
            for name, text in named_reasons(check, task_of(todo))
        }
        free = room - len(texts)
        replay = self.replay_of(check)
        cause = sum(len(texts[name]) - 1 for name in CAUSES[:2] if name in texts)
        if len(replay) + cause > free:  # the cause is worth more than a picture of it
            replay = []
        free -= len(replay)
        shown = {}
        for name in sorted(texts, key=CAUSES.index):
            text = texts[name]
            kept = text[: 1 + max(free, 0)]
            free -= len(kept) - 1
            whole = len(kept) == len(text)
            shown[name] = kept if whole else [*kept[:-1], self.cut(kept[-1], 2) + " …"]
        return [*(line for name in texts for line in shown[name]), *replay]

    def replay_of(self, check: CheckResult) -> list[str]:
        if self.replays is None or check.replay is None:
            return []
        path = os.path.relpath(self.replays.parent / check.replay).replace(os.sep, "/")
        return self.wrap(f"{' ' * MARGIN}{'See it':<{NAMES}}{path}", 2, whole=True)


def current(result: Result, touched: Collection[str] = ()) -> TodoResult | None:
    """The one TODO to go on with: the first that fails, or else the first that is not begun.

    No bonus task, unless nothing else is left to mend.
    """
    states = (*FAILED, "not started")
    left = [todo for todo in result.counted or result.todos if todo.state in states]
    left = left or [todo for todo in result.shown if todo.state in FAILED]

    def rank(todo: TodoResult) -> tuple[bool, bool, bool]:
        return not todo.failed, todo.id not in touched, todo.id == "whole"

    begun = [todo for todo in result.shown if todo.id in touched and todo.failed]
    return min([*begun, *left], key=rank, default=None)


def row(result: Result, state: State, apart: TodoResult | None) -> str:
    ids = [todo.id for todo in result.shown if todo.state == state and todo is not apart]
    return f"{state.upper():<{STATES}}{' '.join(ids)}" if ids else ""


def urgency(group: list[CheckResult]) -> tuple[bool, bool]:
    """What comes first: given code to be put back, then a mistake that has a name."""
    given = any(check.where is not None and check.where.given for check in group)
    return not given, not any(check.meaning for check in group)


def points_of(group: list[CheckResult]) -> str:
    return f"(0 / {sum(check.max_points for check in group)})"
