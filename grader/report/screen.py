"""Print the first screen of `check`: one TODO in full, on 16 lines."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import NamedTuple

import msgspec
from rich.console import Console

from grader.judge.result import FAILED, CheckResult, Result, State, TodoResult
from grader.judge.rubric import CHECKS
from grader.judge.wording import NAMES, command, list_reasons, task_of, total
from grader.report.terminal import (
    MARGIN,
    MAX_COLUMNS,
    STATES,
    STYLES,
    choose_todo,
    describe_obstacle,
    group_checks,
    is_endless,
    locate_replay,
    name_checks,
    suggest_todo,
    wrap,
    write,
    write_todo,
)
from grader.text import clean

LINES = 16  # before the prompt
USUAL = 13  # lines that the names of further failures may fill
OBVIOUS = {"an answer", "code that Python accepts"}  # expected where Got is an error
READING = "reading "  # start of We ran for a file
MOST_REMARKS = 2  # on TODOs without code that counts
WIDTH = 76  # columns of a TODO's own line, with the points at its end
TASKS = "tasks.json"  # only in a release, which makes it from its pages

Tasks = dict[str, list[str]]  # paragraphs of the lab sheet, by TODO

STATE_LINES: list[list[State]] = [["passed"], ["error"], ["not yet"], ["not started", "waiting"]]
# In the order in which they get lines.
CAUSES = ("Meaning", "Got", "Expected", "Look at", "Printed", "We ran")


class Line(NamedTuple):
    text: str
    style: str = ""


@dataclass
class Screen:
    """A printer of results on at most `lines` lines."""

    console: Console
    replays: Path | None = None  # where they are, if there are any
    lines: int = LINES
    tasks: Tasks | None = None  # shown in place of commands to type

    def show(
        self, result: Result, touched: Collection[str] = (), notes: Sequence[str] = ()
    ) -> None:
        """Print a result: `touched` TODOs first, and `notes` at the end."""
        for line in self.lay_out(result, touched, notes):
            write(line.text, self.console, line.style)

    def lay_out(
        self, result: Result, touched: Collection[str] = (), notes: Sequence[str] = ()
    ) -> list[Line]:
        """Return the lines: the states of all TODOs, the failures of one, and what to do next."""
        todo = choose_todo(result, touched)
        notes = [*list_remarks(result), *notes]
        end = [Line(each) for note in notes for each in wrap(note, self.console, 2)]
        if todo is None or not todo.failed:  # nothing fails
            next_one = self.suggest(todo, result) if todo else []
            return [*self.list_states(result, None), *end, *next_one]
        shown = choose_failure(todo)[0].state  # the lines below explain this failure
        head = self.shorten(write_todo(msgspec.structs.replace(todo, state=shown)))
        states = [*self.list_states(result, todo), Line(head, STYLES[shown])]
        end += self.suggest_commands(todo)
        room = self.lines - len(states) - len(end)
        return [*states, *self.list_failures(todo, room), *end]

    @property
    def width(self) -> int:
        return min(self.console.width, MAX_COLUMNS)

    def shorten(self, line: str) -> str:
        """Return a TODO's own line, without columns if it is too long."""
        return line if len(line) <= self.width else self.cut(" ".join(line.split()))

    def set_bold(self, words: str) -> list[Line]:
        return [Line(each, "bold") for each in wrap(words, self.console, 6)]

    # ------------------------------------------------------------ states

    def list_states(self, result: Result, apart: TodoResult | None) -> list[Line]:
        """Return the points and the TODOs by state, without `apart`, which has its own lines."""
        rows: list[Line] = []
        for states in STATE_LINES:
            parts = [list_ids(result, state, apart) for state in states]
            words = "   ".join(filter(None, parts))
            style = STYLES[states[0]]
            rows += [Line(each, style) for each in wrap(words, self.console, STATES)]
        if apart is not None and result.todos == [apart]:  # its own line has the points
            return []
        points = total(result)
        free = WIDTH - len(rows[0].text) if rows else 0
        if free <= len(points) or self.console.width < WIDTH:
            return [Line(f"Points: {points}", "bold"), *rows]
        return [Line(rows[0].text + points.rjust(free), rows[0].style), *rows[1:]]

    def suggest(self, todo: TodoResult, result: Result) -> list[Line]:
        """Return the next TODO, with commands to type or its text from the lab sheet."""
        headline, *below = suggest_todo(todo, result)
        if self.tasks is not None:
            below = [each for words in self.tasks.get(todo.id, []) for each in self.indent(words)]
        return [*self.set_bold(headline), *map(Line, below)]

    def indent(self, words: str) -> list[str]:
        return wrap(f"  {words}", self.console, 4 if words.startswith("- ") else 2)

    def suggest_commands(self, todo: TodoResult) -> list[Line]:
        """Return commands to type, or what must be corrected first."""
        all_of_it = f"All: {command('check', all_of_it=True)}"
        if words := describe_obstacle(todo):
            return self.set_bold(words)
        if self.tasks is not None:
            return []
        if todo.id == "whole":
            return [Line(all_of_it)]
        both = f"A hint: {command('hint', todo.id)}   {all_of_it}"
        lines = [both] if len(both) <= self.width else both.split("   ")
        return [Line(each) for each in lines]

    # ------------------------------------------------------------ failures

    def list_failures(self, todo: TodoResult, room: int) -> list[Line]:
        """Return the first failure in full, and a line for each other one that fits."""
        groups, first = group_checks(todo.failed), choose_failure(todo)
        titles = [self.title(each, count_points(each)) for each in groups if each != first]
        waiting = group_checks(check for check in todo.checks if check.state == "waiting")
        titles += [self.title(each, clean(each[0].got)) for each in waiting]
        below = self.explain(todo, first[0], room - 1 - bool(titles))
        left = room - 1 - len(below)
        left = max(left - max(self.lines - USUAL, 0), min(left, 1))
        if len(titles) > left:
            kept = max(left - 1, 0)
            titles = [*titles[:kept], f"  and {len(titles) - kept} more"] if titles else []
        lines = [Line(self.title(first, count_points(first)), "bold"), *map(Line, below)]
        return [*lines, *(Line(title, "bright_black") for title in titles)]

    def title(self, group: list[CheckResult], behind: str) -> str:
        """Name checks on one line, with `behind` at its end."""
        return self.cut(f"  {name_checks(group)}", len(behind) + 2) + f"  {behind}"

    def cut(self, words: str, less: int = 0) -> str:
        """Cut words to one line, with … at its end."""
        most = self.width - less
        if len(words) <= most:
            return words
        kept = words[: max(most - 2, 1)]
        return f"{kept[: kept.rfind(' ')] if ' ' in kept.strip() else kept} …"

    def explain(self, todo: TodoResult, check: CheckResult, room: int) -> list[str]:
        """Explain why a check failed: a line for each text; the rest of `room` is for the cause."""
        texts = {
            name: wrap(f"{' ' * MARGIN}{name:<{NAMES}}{clean(text)}", self.console, MARGIN + NAMES)
            for name, text in list_reasons(check, task_of(todo))
            if text not in OBVIOUS and not text.startswith(READING)
        }
        rerun, replay = locate_replay(check, self.replays, self.console)
        free = room - len(texts) - len(rerun)
        cause = sum(len(texts[name]) - 1 for name in CAUSES[:2] if name in texts)
        if len(replay) + cause > free:  # the cause is more important
            replay = []
        free -= len(replay)
        shown = {}
        for name in sorted(texts, key=CAUSES.index):
            text = texts[name]
            kept = text[: 1 + max(free, 0)]
            free -= len(kept) - 1
            whole = len(kept) == len(text)
            shown[name] = kept if whole else [*kept[:-1], self.cut(kept[-1], 2) + " …"]
        return [*(line for name in texts for line in shown[name]), *rerun, *replay]


def list_remarks(result: Result) -> list[str]:
    """Return, once each, the reasons why TODOs with code count as not started."""
    found = dict.fromkeys(todo.remark for todo in result.todos_to_show if todo.remark)
    return [*islice(found, MOST_REMARKS)]


def list_ids(result: Result, state: State, apart: TodoResult | None) -> str:
    ids = [todo.id for todo in result.todos_to_show if todo.state == state and todo is not apart]
    if apart is not None and state in FAILED:
        ids = [id for id in ids if id != "whole"]  # it cannot pass while another TODO fails
    return f"{state.upper():<{STATES}}{' '.join(ids)}" if ids else ""


def choose_failure(todo: TodoResult) -> list[CheckResult]:
    """Return the checks to explain: those that fail for the most important reason."""
    return min(group_checks(todo.failed), key=rank_failure)


def rank_failure(group: list[CheckResult]) -> tuple[bool, bool, bool]:
    """Rank failures: changed given code first, then an endless loop, then a known mistake."""
    given = any(check.where is not None and check.where.given for check in group)
    return not given, not is_endless(group[0]), not any(check.meaning for check in group)


def count_points(group: list[CheckResult]) -> str:
    return f"(0 / {sum(check.max_points for check in group)})"


def load_tasks() -> Tasks:
    """Load the texts of the tasks. Only a release has them: without one, return none."""
    path = CHECKS / TASKS
    return msgspec.json.decode(path.read_bytes(), type=Tasks) if path.is_file() else {}
