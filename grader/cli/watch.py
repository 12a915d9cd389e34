"""`check --watch`: after each save the tree is checked again, first what the save touched.

Events only wake us up. What changed is seen from the sources themselves, so it does not matter
how an editor saves, nor whether the file system tells of it.
"""

import time
import warnings
from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

import msgspec
import watchfiles
from rich.console import Console

from grader.judge.children import Worker, start_worker
from grader.judge.grade import Options, grade
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.rubric import Todo, load_rubric
from grader.judge.submission import (
    CannotGrade,
    module_of,
    plain_files,
)
from grader.player.replay import grade_with_replays
from grader.report.screen import LINES, Screen
from grader.report.terminal import say
from grader.source.definitions import function_named, source_of, statements
from grader.source.regions import read_source
from grader.text import clean

Sources = dict[str, str]  # the text of each Python file, by its path inside the tree

SETTLED = 25  # ms without another event, until a save is looked at
WITHOUT_EVENTS = 1000  # ms, until we look all the same
MOST_NEWS = 3  # lines on what a save changed
LOOK_EVERY = 0.25  # s, while checks are running


class SavedAgain(Exception):
    """Raised between two checks: the tree is no longer the one that is being checked."""


@dataclass
class Watch:
    """A tree, what was found in it, and what is to be checked again."""

    folder: Path
    options: Options
    console: Console
    worker: Worker
    replays: Path | None = None
    seen: Sources = field(default_factory=dict)  # as they were when last looked at
    checked: Sources = field(default_factory=dict)  # as they were when last checked
    touched: set[str] = field(default_factory=set)  # TODO ids to be checked, and shown
    others: set[str] = field(default_factory=set)  # to be checked, and shown if anything is new
    looked: float = 0.0  # s, when that was
    news: list[str] = field(default_factory=list)  # what is new since the last save
    result: Result = field(init=False)

    def start(self) -> None:
        """Check the whole tree."""
        self.seen = self.checked = python_sources(self.folder)
        self.result = self.grade(self.options)
        self.draw()

    def look(self) -> None:
        """Check again whatever was saved since the last look."""
        again = False
        while (now := python_sources(self.folder)) != self.seen or again:
            if changed := sorted(differing(self.seen, now)):
                self.news = [f"saved: {clean(', '.join(changed))}"]
                self.tell(self.news, clear=True)
            self.seen, again = now, False
            new = sorted(differing(self.checked, now))
            if trouble := next(filter(None, map(self.trouble_in, new)), ""):
                self.tell([trouble])
                continue
            self.plan()
            try:
                self.check_again()
            except SavedAgain:
                again = True
            except OSError as error:  # a file went away while it was read
                say(f"cannot read the tree now ({clean(str(error))}): save again", self.console)

    def trouble_in(self, file: str) -> str:
        """Why Python cannot read a file of the programs; empty if it can."""
        modules = {todo.module for todo in load_rubric().todos}
        if module_of(Path(file)) not in modules:
            return ""
        error = syntax_error(self.seen.get(file, ""))
        if error is None:
            return ""
        return f"{file}:{error.lineno or 1} is no Python yet: {clean(error.msg)}"

    def plan(self) -> None:
        """Note what to check: what the saves since the last check touched comes first."""
        wanted = self.options.only or {todo.id for todo in self.options.course.rubric.todos}
        for file in differing(self.checked, self.seen):
            self.touched |= wanted & changed_todos(
                file, self.checked.get(file, ""), self.seen.get(file, "")
            )
            self.others |= wanted & users_of(file)
        self.checked = self.seen

    def check_again(self) -> None:
        """Check and show what is noted, unless a save comes in between."""
        touched = set(self.touched)
        news = self.check(self.touched, always_tell=True)
        if touched:
            self.draw(news, touched)
        self.others -= self.touched
        self.touched = set()
        more = self.check(self.others, always_tell=False)
        self.others = set()
        if more:
            self.draw([*news, *more], touched)
        elif not touched:
            total = f"{self.result.points} of {self.result.max_points}"
            show = self.draw if self.console.is_terminal else self.tell
            show([f"nothing new: {total} points"])

    def check(self, todos: set[str], always_tell: bool) -> list[str]:
        """Check these again; what is new about them, or about each where all is to be told."""
        if not todos:
            return []
        options = replace(self.options, only=frozenset(todos), progress=self.stop_if_saved)
        news = []
        for todo in self.grade(options).todos:
            before = self.replace(todo)
            if always_tell or without_lines(before) != without_lines(todo):
                news.append(self.progress(before, todo))
        return news

    def grade(self, options: Options) -> Result:
        if self.replays is None:
            return grade(self.folder, options, self.worker)
        return grade_with_replays(self.folder, options, self.replays, self.worker)

    def draw(self, news: Sequence[str] = (), touched: Collection[str] = ()) -> None:
        """One screen: the save and what it changed, and below it how things stand."""
        said = [*self.news, *news[:MOST_NEWS], *more_than(news, MOST_NEWS)]
        if self.console.is_terminal:
            self.tell(said, clear=True)
        else:
            self.tell(news)
        screen = Screen(self.console, self.replays, LINES - len(said) - 1)
        screen.show(self.result, touched)

    def tell(self, lines: Sequence[str], clear: bool = False) -> None:
        """Print what is new; where it is a terminal, on one that is empty."""
        if clear:
            self.console.clear()
        for line in lines:
            say(line, self.console, indent=2, style="bold")

    def stop_if_saved(self, _: CheckResult) -> None:
        if time.monotonic() - self.looked > LOOK_EVERY:
            self.looked = time.monotonic()
            if python_sources(self.folder) != self.seen:
                raise SavedAgain

    def replace(self, todo: TodoResult) -> TodoResult:
        """Put the TODO's new result in the place of the one before, which is returned."""
        (before,) = (each for each in self.result.todos if each.id == todo.id)
        todos = [todo if each is before else each for each in self.result.todos]
        self.result = self.result.with_todos(todos)
        return before

    def progress(self, before: TodoResult, todo: TodoResult) -> str:
        """What became of a TODO, in a line."""
        if before.points == todo.points:
            return f"TODO {todo.id}: {todo.points} of {todo.max_points} as before"
        words = f"TODO {todo.id}: {before.points} → {todo.points} of {todo.max_points}"
        if not todo.bonus:
            total = self.result.points - todo.points + before.points
            words += f", in all {total} → {self.result.points} of {self.result.max_points}"
        return words


def more_than(news: Sequence[str], most: int) -> list[str]:
    return [f"and {len(news) - most} more"] * (len(news) > most)


# -------------------------------------------------------------------- what a save touched


def differing(before: Sources, after: Sources) -> set[str]:
    """The files that are new, gone or changed."""
    return {file for file in before | after if before.get(file) != after.get(file)}


def changed_todos(file: str, before: str, after: str) -> set[str]:
    """The TODOs whose function is another one."""
    old, new = functions_in(file, before), functions_in(file, after)
    return {todo for todo in old | new if old.get(todo) != new.get(todo)}


def functions_in(file: str, text: str) -> dict[str, str]:
    """The source of each TODO's function that a file holds."""
    body = statements(text)
    found = {}
    for todo in load_rubric().todos:
        if todo.function and todo.module == module_of(Path(file)):
            function = function_named(body, todo.function.partition(":")[2])
            if function is not None:
                found[todo.id] = source_of(text, function)
    return found


def users_of(file: str) -> set[str]:
    """The TODOs whose checks run a file; a helper of the student's own may be used by all."""
    todos, module = load_rubric().todos, module_of(Path(file))
    users = {todo.id for todo in todos if module in modules_of(todo)}
    return users or {todo.id for todo in todos}


def modules_of(todo: Todo) -> set[str]:
    """The modules that a TODO's checks import."""
    return {check.module or todo.module for check in todo.checks}


def without_lines(todo: TodoResult) -> TodoResult:
    """A result that does not tell where: lines move whenever something is written above them."""
    checks = [msgspec.structs.replace(check, where=None) for check in todo.checks]
    return msgspec.structs.replace(todo, checks=checks)


def syntax_error(text: str) -> SyntaxError | None:
    ignored = warnings.catch_warnings(action="ignore")
    with ignored, suppress(ValueError, RecursionError, MemoryError):
        try:
            compile(text, "", "exec", dont_inherit=True)
        except SyntaxError as error:
            return error
    return None


# -------------------------------------------------------------------- the tree


def python_sources(folder: Path) -> Sources:
    """The Python files that would be handed in. One that goes away meanwhile is left out."""
    found = {}
    for path in plain_files(folder):
        if path.suffix == ".py":
            with suppress(OSError):
                found[path.relative_to(folder).as_posix()] = read_source(path)
    return found


def folders_of(folder: Path) -> list[Path]:
    """The folders to watch, without the virtual environment and its thousands of files."""
    return sorted({folder, *(each.parent for each in plain_files(folder))})


def moments_to_look(folder: Path) -> Iterator[None]:
    """After each event in the tree, and from time to time without one."""
    while folder.is_dir():
        folders = folders_of(folder)
        try:
            for _ in watchfiles.watch(
                *folders,
                watch_filter=watchfiles.PythonFilter(),
                step=SETTLED,
                rust_timeout=WITHOUT_EVENTS,
                yield_on_timeout=True,
                recursive=False,
            ):
                yield
                if not folder.is_dir() or folders_of(folder) != folders:
                    break
        except OSError:  # a folder went away, or there are more than this machine can watch
            time.sleep(WITHOUT_EVENTS / 1000)
            yield


def watch(folder: Path, options: Options, console: Console, replays: Path | None) -> Result:
    """Check the tree, and again after each save, until Ctrl-C; returns the last result."""
    worker = start_worker(options.spawn)
    session = Watch(folder, options, console, worker, replays)
    try:
        session.start()
        say("Watching: save a file, and it is checked again. Ctrl-C ends this.", console)
        with suppress(KeyboardInterrupt):
            for _ in moments_to_look(folder):
                session.look()
            raise CannotGrade(f"there is no {folder} any more")
    finally:
        worker.close()
    return session.result
