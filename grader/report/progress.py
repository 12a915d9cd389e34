"""Show the progress of long work: a bar on a terminal, a line now and then in a log."""

import time
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

NOW_AND_THEN = 30.0  # s


class Counter:
    """A counter up to `total` that shows the time left; a context manager."""

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
        """Show how many are done; `more` says what became of them."""
        self.bar.update(self.task, completed=count, more=more)
        if not self.console.is_terminal and time.monotonic() - self.printed >= NOW_AND_THEN:
            self.printed = time.monotonic()
            words = f"{self.what}: {count} of {self.total}"
            self.console.print(f"{words}, {more}" if more else words)
