"""Show the progress of long work: a bar on a terminal, a line now and then in a log."""

import time
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from grader.judge.result import CheckResult
from grader.judge.task import Options
from grader.judge.wording import place_of
from grader.report.terminal import is_endless, say
from grader.text import clean

NOW_AND_THEN = 30.0  # s


class Counter:
    """A counter up to `total` that shows the remaining time; a context manager."""

    def __init__(self, what: str, total: int, console: Console) -> None:
        self.what, self.total, self.console = what, total, console
        columns = (TextColumn(what), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
        more = TextColumn("{task.fields[more]}")
        here = console.is_terminal
        self.bar = Progress(*columns, more, console=console, transient=True, disable=not here)
        self.task = self.bar.add_task("", total=total, more="")
        self.printed = time.monotonic()

    def __enter__(self) -> Self:
        self.bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.bar.stop()

    def reached(self, count: int, more: str = "") -> None:
        """Show a count; `more` describes the results."""
        self.bar.update(self.task, completed=count, more=more)
        if not self.console.is_terminal and time.monotonic() - self.printed >= NOW_AND_THEN:
            self.printed = time.monotonic()
            words = f"{self.what}: {count} of {self.total}"
            self.console.print(f"{words}, {more}" if more else words)


class CheckProgress:
    """Shows a bar during a student's check, and reports an endless loop at once.

    Checks finish in the order of the rubric.
    """

    def __init__(self, options: Options, console: Console) -> None:
        wanted = filter(options.wants, options.course.rubric.todos)
        self.todos = [todo.id for todo in wanted for _ in todo.checks]
        self.counter = Counter("Checking", len(self.todos), console)
        self.console = console
        self.done = 0
        self.endless: set[str] = set()  # TODOs

    def __enter__(self) -> Self:
        self.counter.__enter__()
        return self

    def __exit__(self, *_: object) -> None:
        self.counter.__exit__()

    def count(self, check: CheckResult) -> None:
        """Count a finished check."""
        todo = self.todos[self.done]
        self.done += 1
        self.counter.reached(self.done, name_task(todo))
        if is_endless(check) and todo not in self.endless:
            self.endless.add(todo)
            place = f" Look at {place_of(check)}." if check.where else ""
            say(f"{name_task(todo)}: {clean(check.got)}{place} Others still run.", self.console)


def name_task(todo: str) -> str:
    return "the whole" if todo == "whole" else f"TODO {todo}"
