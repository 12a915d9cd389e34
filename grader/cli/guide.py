"""Guide a student from task to task: `python -m grader` alone, and `make`.

It is `check --watch` with the lab sheet's text of the next task, and keys for hints, replays and
the program's window. At full marks, other keys lead on.
"""

import os
import subprocess
import sys
import tempfile
import webbrowser
from collections.abc import Collection
from contextlib import closing, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO

import typer

from grader.cli.keys import open_keys
from grader.cli.shared import console
from grader.cli.student import (
    find_tree,
    grade_shown,
    load_hints,
    make_options,
    make_replay_folder,
    write_due,
)
from grader.cli.watch import Watch, wait_for_saves
from grader.errors import Stop
from grader.judge.course import Course, read_course
from grader.judge.result import TodoResult
from grader.judge.rubric import load_rubric
from grader.judge.wall.children import start_worker
from grader.judge.wording import command
from grader.report.screen import Screen, Tasks, choose_failure, load_tasks
from grader.report.terminal import choose_todo, find_replay, say, wrap, write
from grader.text import clean

TICK = 200  # ms between two looks for keys
MOST_OUTPUT = 4000  # characters of a program that was run, of which the last lines are shown
MOST_LINES = 12
KEYS = "h hint   r replay   w window   p printed   q quit"
KEYS_AT_THE_END = "f film   b bonus task   t test yourself   w window   q quit"


class Quit(Exception):
    """Raised to end the guide."""


def guide_command(context: typer.Context) -> None:
    """Start the guide where no command is named."""
    if context.invoked_subcommand is None:
        lead(Path("."), read_course(None))


def lead(path: Path, course: Course) -> None:
    """Guide through the tree around `path`; without a terminal, show its first screen and end."""
    folder = find_tree(path, course)
    options, replays = make_options(frozenset(), course), make_replay_folder(folder)
    if not (console.is_terminal and sys.stdin.isatty()):
        Screen(console, replays, tasks=load_tasks()).show(grade_shown(folder, options, replays))
        return
    with (
        closing(start_worker(options.spawn, count=options.jobs)) as worker,
        open_keys() as read_key,
    ):
        guide = Guide(folder, options, console, worker, replays)
        with suppress(KeyboardInterrupt, Quit):
            guide.start()
            if guide.todo is not None:
                say("Change that file and save it: it is checked at once.", console)
            for _ in wait_for_saves(folder, TICK):
                guide.look()
                guide.press(read_key())
                guide.show_output()
            raise Stop(f"{folder} no longer exists")


@dataclass
class Guide(Watch):
    """A watch that shows the next task and obeys keys."""

    tasks: Tasks = field(default_factory=load_tasks)
    todo: TodoResult | None = None  # on the screen
    hints: dict[str, int] = field(default_factory=dict)  # the number given so far, by TODO
    running: "Running | None" = None  # the program started last

    def show(self, lines: int, touched: Collection[str]) -> None:
        """Print the result, the text of the next task, and the keys."""
        self.todo = choose_todo(self.result, touched)
        screen = Screen(self.console, self.replays, lines - 1, self.tasks)
        screen.show(self.result, touched)
        if self.result.has_full_marks:
            hand_in = command("hand-in") + write_due(self.options.course)
            say(f"All checks pass. To hand in: {hand_in}", self.console, style="bold")
        self.show_keys()

    def show_keys(self) -> None:
        at_end = self.result.has_full_marks and self.todo is None
        say(KEYS_AT_THE_END if at_end else KEYS, self.console, style="bright_black")

    def press(self, key: str) -> None:
        """Obey a key; ignore others."""
        at_end = {"f": self.show_film, "b": self.show_bonus, "t": self.ask_questions}
        keys = {
            "h": self.give_hint,
            "r": self.open_replay,
            "w": self.open_window,
            "p": self.show_printed,
            "q": self.quit,
        }
        if self.result.has_full_marks:
            keys |= at_end
        if key in keys:
            keys[key]()

    def quit(self) -> None:
        raise Quit

    def say(self, words: str, indent: int = 2) -> None:
        say(words, self.console, indent)

    # ------------------------------------------------------------ keys

    def give_hint(self) -> None:
        """Print the next hint for the shown TODO; after the last, repeat it."""
        name = self.todo.id if self.todo else ""
        hints = load_hints(name)
        if not hints:
            self.say("There is no hint for this.")
            return
        given = self.hints[name] = min(self.hints.get(name, 0) + 1, len(hints))
        more = "   (h: the next hint)" if given < len(hints) else ""
        self.say(f"Hint {given} of {len(hints)}: {hints[given - 1]}{more}")

    def open_replay(self) -> None:
        """Open the replay of the failure on the screen."""
        failing = self.todo if self.todo and self.todo.failed else None
        check = choose_failure(failing)[0] if failing else None
        if check is None or self.replays is None or find_replay(check, self.replays) is None:
            self.say("There is no replay of this.")
            return
        self.open_page(self.replays.parent / str(check.replay))

    def open_page(self, path: Path) -> None:
        """Open a page in the browser, and print its path in case there is no browser."""
        for line in wrap(f"Opening {clean(os.path.relpath(path))}", self.console, 2, whole=True):
            write(line, self.console)
        with suppress(webbrowser.Error, OSError):
            webbrowser.open(path.resolve().as_uri())

    def open_window(self) -> None:
        """Start the program of the TODO on the screen, unless it is running."""
        if self.running is not None:
            self.say(f"{self.running.name} is running: close its window first.")
            return
        name = self.todo.id if self.todo else ""
        functions = {todo.id: todo.function for todo in load_rubric().todos}
        module = (functions.get(name) or "").partition(":")[0] or self.options.course.modules[0]
        self.running = Running.start(self.folder, module)
        self.say(f"Started {self.running.name}")

    def show_output(self) -> None:
        """Show the last lines that an ended program printed."""
        if self.running is not None and self.running.has_ended():
            for line in self.running.read_output():
                self.say(clean(line))
            self.running = None
            self.show_keys()

    def show_printed(self) -> None:
        """Show what the program printed in the checks of this TODO."""
        checks = self.todo.checks if self.todo else []
        printed = dict.fromkeys(check.printed for check in checks if check.printed)
        for words in printed:
            self.say(f"Printed: {clean(str(words))}")
        if not printed:
            self.say("These checks printed nothing. Output of print() appears here.")

    # ------------------------------------------------------------ at full marks

    def show_film(self) -> None:
        """Open a film of the lab scene, run by the student's own engine."""
        from grader.cli.film import write_film  # imported here, since it is slow

        try:
            path = write_film(self.folder, self.options, self.worker, self.result)
        except Exception as error:  # the guide goes on after any error of a program
            self.say(f"There is no film: {clean(str(error))}")
            return
        self.open_page(path)

    def show_bonus(self) -> None:
        """Show the first unfinished bonus task."""
        left = [todo for todo in self.result.todos if todo.bonus and todo.state != "passed"]
        if not left:
            self.say("There is no bonus task left.")
            return
        self.todo = left[0]
        for line in Screen(self.console, tasks=self.tasks).suggest(self.todo, self.result):
            say(line.text, self.console, style=line.style)
        self.show_keys()

    def ask_questions(self) -> None:
        """Make a page of practice questions and open it."""
        from grader.cli.practice import make_questions

        try:
            sheet, path = make_questions(self.folder, self.options.course)
        except Stop as error:
            self.say(f"There are no questions: {clean(str(error))}.")
            return
        if sheet.questions:
            self.open_page(path)


@dataclass
class Running:
    """A running program and its output so far."""

    name: str
    process: "subprocess.Popen[bytes]"
    output: IO[bytes]

    @classmethod
    def start(cls, folder: Path, module: str) -> "Running":
        words = ["-m", module] if (folder / module).is_dir() else [f"{module}.py"]
        output = tempfile.TemporaryFile()  # noqa: SIM115  # a pipe would fill up
        process = subprocess.Popen(
            [sys.executable, *words],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
        return cls(f"python {' '.join(words)}", process, output)

    def has_ended(self) -> bool:
        return self.process.poll() is not None

    def read_output(self) -> list[str]:
        """Return the last lines that it printed."""
        with self.output:
            size = self.output.seek(0, 2)
            self.output.seek(max(size - MOST_OUTPUT, 0))
            return self.output.read().decode(errors="replace").splitlines()[-MOST_LINES:]
