"""Check the tree again after each save, first the TODOs that the save changed: `check --watch`.

Events only wake the watch. It compares the sources themselves, so it does not matter how an editor
saves or whether the file system reports it.
"""

import time
from collections.abc import Collection, Iterator, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

import msgspec
import watchfiles
from rich.console import Console

from grader.errors import Stop
from grader.judge.grade import grade
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.rubric import load_rubric
from grader.judge.submission import module_of, plain_files
from grader.judge.task import Options
from grader.judge.wall.children import Worker, start_worker
from grader.player.graded import grade_with_replays
from grader.report.progress import CheckProgress
from grader.report.screen import LINES, Screen
from grader.report.terminal import say
from grader.source.definitions import find_function, source_of, statements
from grader.source.flaws import find_flaw
from grader.source.regions import read_source
from grader.text import clean

Sources = dict[str, str]  # the text of each Python file, by its path inside the tree

SETTLED = 10  # ms without another event, until a save is looked at
WITHOUT_EVENTS = 1000  # ms until a look without an event
MOST_NEWS = 3  # lines on what a save changed
LOOK_EVERY = 0.25  # s, while checks are running


class SavedAgain(Exception):
    """Raised when a file is saved during a check."""


@dataclass
class Watch:
    """A tree, its result, and the TODOs to check again."""

    folder: Path
    options: Options
    console: Console
    worker: Worker
    replays: Path | None = None
    latest: Sources = field(default_factory=dict)  # at the last look
    checked: Sources = field(default_factory=dict)  # at the last check
    touched: set[str] = field(default_factory=set)  # ids of TODOs to check and show
    others: set[str] = field(default_factory=set)  # to check, and to show if the result differs
    looked: float = 0.0  # s, time of the last look during checks
    news: list[str] = field(default_factory=list)  # lines on the last save
    result: Result = field(init=False)

    def start(self) -> None:
        self.latest = self.checked = read_sources(self.folder)
        with CheckProgress(self.options, self.console) as shown:
            self.result = self.grade(replace(self.options, progress=shown.count))
        self.draw()

    def look(self) -> None:
        """Check files saved since the last look."""
        again = False
        while (now := read_sources(self.folder)) != self.latest or again:
            if changed := sorted(find_differences(self.latest, now)):
                self.news = [f"saved: {clean(', '.join(changed))}"]
                self.tell(self.news, clear=True)
            self.latest, again = now, False
            new = sorted(find_differences(self.checked, now))
            if trouble := next(filter(None, map(self.find_trouble, new)), ""):
                self.tell([trouble])
                continue
            self.plan()
            try:
                self.check_again()
            except SavedAgain:
                again = True
            except OSError as error:  # a file went away while it was read
                say(f"cannot read the tree now ({clean(str(error))}): save again", self.console)

    def find_trouble(self, file: str) -> str:
        """Return why Python cannot read a file of the programs; empty if it can."""
        modules = load_rubric().modules
        if module_of(Path(file)) not in modules:
            return ""
        flaw = find_flaw(self.latest.get(file, ""))
        return f"{file}:{flaw.line} is not valid Python yet: {clean(flaw.message)}" if flaw else ""

    def plan(self) -> None:
        """Choose the TODOs to check: changed ones, and others that run a changed file."""
        wanted = self.options.only or {todo.id for todo in self.options.course.rubric.todos}
        for file in find_differences(self.checked, self.latest):
            before = read_functions(file, self.checked.get(file, ""))
            after = read_functions(file, self.latest.get(file, ""))
            self.touched |= {todo for todo in wanted if before.get(todo) != after.get(todo)}
            self.others |= wanted & find_users(file)
        self.checked = self.latest

    def check_again(self) -> None:
        """Check the chosen TODOs and show them, unless a save comes in between."""
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
        """Check TODOs again; return a line on each that changed, or with `always_tell` on each."""
        if not todos:
            return []
        options = replace(self.options, only=frozenset(todos), progress=self.stop_if_saved)
        news = []
        for todo in self.grade(options).todos:
            before = self.replace(todo)
            if always_tell or drop_lines(before) != drop_lines(todo):
                news.append(self.compare(before, todo))
        return news

    def grade(self, options: Options) -> Result:
        if self.replays is None:
            return grade(self.folder, options, self.worker)
        return grade_with_replays(self.folder, options, self.replays, self.worker)

    def draw(self, news: Sequence[str] = (), touched: Collection[str] = ()) -> None:
        """Print one screen: the save, its effect, and the result below."""
        more = len(news) - MOST_NEWS
        head = [*self.news, *news[:MOST_NEWS], *([f"and {more} more"] if more > 0 else [])]
        if self.console.is_terminal:
            self.tell(head, clear=True)
        else:
            self.tell(news)
        self.show(LINES - len(head) - 1, touched)

    def show(self, lines: int, touched: Collection[str]) -> None:
        """Print the result on at most this many lines."""
        Screen(self.console, self.replays, lines).show(self.result, touched)

    def tell(self, lines: Sequence[str], clear: bool = False) -> None:
        """Print lines in bold, on a cleared terminal if `clear`."""
        if clear:
            self.console.clear()
        for line in lines:
            say(line, self.console, indent=2, style="bold")

    def stop_if_saved(self, _: CheckResult) -> None:
        if time.monotonic() - self.looked > LOOK_EVERY:
            self.looked = time.monotonic()
            if read_sources(self.folder) != self.latest:
                raise SavedAgain

    def replace(self, todo: TodoResult) -> TodoResult:
        """Replace the TODO's result, and return the old one."""
        (before,) = (each for each in self.result.todos if each.id == todo.id)
        todos = [todo if each is before else each for each in self.result.todos]
        self.result = self.result.with_todos(todos)
        return before

    def compare(self, before: TodoResult, todo: TodoResult) -> str:
        """Return a line that compares the points of a TODO with those before."""
        if before.points == todo.points:
            return f"TODO {todo.id}: {todo.points} of {todo.max_points} as before"
        words = f"TODO {todo.id}: {before.points} → {todo.points} of {todo.max_points}"
        if not todo.bonus:
            total = self.result.points - todo.points + before.points
            words += f", in all {total} → {self.result.points} of {self.result.max_points}"
        return words


def find_differences(before: Sources, after: Sources) -> set[str]:
    return {file for file in before | after if before.get(file) != after.get(file)}


def read_functions(file: str, text: str) -> dict[str, str]:
    """Return the functions' sources in a file, by their TODOs."""
    body = statements(text)
    found = {}
    for todo in load_rubric().todos:
        if todo.function and todo.module == module_of(Path(file)):
            function = find_function(body, todo.function.partition(":")[2])
            if function is not None:
                found[todo.id] = source_of(text, function)
    return found


def find_users(file: str) -> set[str]:
    """Return the TODOs whose checks run a file; all TODOs for an added file."""
    todos, module = load_rubric().todos, module_of(Path(file))
    users = {
        todo.id
        for todo in todos
        if module in {check.module or todo.module for check in todo.checks}
    }
    return users or {todo.id for todo in todos}


def drop_lines(todo: TodoResult) -> TodoResult:
    """Return a result without line numbers, which change with every line added above."""
    checks = [msgspec.structs.replace(check, where=None) for check in todo.checks]
    return msgspec.structs.replace(todo, checks=checks)


def read_sources(folder: Path) -> Sources:
    """Read the Python files that would be handed in; skip a file that disappears meanwhile."""
    found = {}
    for path in plain_files(folder):
        if path.suffix == ".py":
            with suppress(OSError):
                found[path.relative_to(folder).as_posix()] = read_source(path)
    return found


def list_folders(folder: Path) -> list[Path]:
    """Return the folders to watch, without the virtual environment and its many files."""
    return sorted({folder, *(each.parent for each in plain_files(folder))})


def wait_for_saves(folder: Path, most: int = 0) -> Iterator[None]:
    """Yield after each event in the tree, and after `most` ms without one."""
    while folder.is_dir():
        folders = list_folders(folder)
        try:
            for _ in watchfiles.watch(
                *folders,
                watch_filter=watchfiles.PythonFilter(),
                step=SETTLED,
                rust_timeout=most or WITHOUT_EVENTS,
                yield_on_timeout=True,
                recursive=False,
            ):
                yield
                if not folder.is_dir() or list_folders(folder) != folders:
                    break
        except OSError:  # a folder was removed, or there are too many to watch
            time.sleep(WITHOUT_EVENTS / 1000)
            yield


def watch_tree(folder: Path, options: Options, console: Console, replays: Path | None) -> Result:
    """Check the tree, and again after each save, until Ctrl-C; return the last result."""
    with closing(start_worker(options.spawn, count=options.jobs)) as worker:
        watched = Watch(folder, options, console, worker, replays)
        watched.start()
        say("Watching: save a file, and it is checked again. Ctrl-C ends this.", console)
        with suppress(KeyboardInterrupt):
            for _ in wait_for_saves(folder):
                watched.look()
            raise Stop(f"{folder} no longer exists")
    return watched.result
