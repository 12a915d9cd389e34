"""Define the students' commands `check`, `hint` and `hand-in`."""

import re
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from grader.cli.hand_in import find_missing, list_tops, list_warnings, pack_tree, write_receipt
from grader.cli.restore import list_notes, restore
from grader.cli.shared import (
    CourseFile,
    check_todos,
    console,
    find_parts,
    grade_one,
    require_file_target,
)
from grader.errors import Stop
from grader.judge.course import Course, read_course
from grader.judge.result import Result
from grader.judge.rubric import load_rubric
from grader.judge.task import Options
from grader.judge.wall.starting import count_cores
from grader.judge.wording import command, hidden_points_note, total
from grader.report.progress import CheckProgress
from grader.report.screen import Screen
from grader.report.terminal import say, show_all
from grader.source.regions import TODO_ID
from grader.text import clean, format_time, plural

app = typer.Typer()

IS_TODO = re.compile(rf"(?:{TODO_ID}|whole)", re.IGNORECASE)


@app.command("check")
def check_command(
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
    what: Annotated[
        list[str] | None, typer.Argument(help="TODOs, such as 4 or 7a; or your folder.")
    ] = None,
    watch: Annotated[bool, typer.Option("--watch", help="Check again after each save.")] = False,
    whole: Annotated[bool, typer.Option("--all", help="Explain every failure.")] = False,
    status: Annotated[bool, typer.Option(hidden=True)] = True,
    undo: Annotated[
        list[str] | None,
        typer.Option("--restore", metavar="NAME", help="Restore given code, by its name."),
    ] = None,
    course: CourseFile = None,
) -> None:
    """Check your programs, and show what to do next.

    One TODO at a time is explained; with --all, every failure. Exit status 0: all checks pass,
    1: some fail, 2: the checks could not run.
    """
    taken = read_course(course)
    ids, path = split_words(what or [])
    folder = find_tree(path, taken)
    if undo:
        for name in undo:
            for words in restore(folder, name):
                say(clean(words), console)
        return
    options = make_options(check_todos([*(todo or []), *ids], taken), taken)
    replays = make_replay_folder(folder)
    if watch:
        from grader.cli.watch import watch_tree

        result = watch_tree(folder, options, console, replays)
    else:
        result = grade_shown(folder, options, replays)
        show_all(result, console, replays) if whole else show_first(result, folder, replays)
        if whole or result.has_full_marks:
            say(f"To hand in: {command('hand-in')}{write_due(taken)}", console)
    raise typer.Exit(0 if result.has_full_marks or not status else 1)


def split_words(words: list[str]) -> tuple[list[str], Path]:
    """Split words into TODOs and a folder."""
    paths = [each for each in words if not IS_TODO.fullmatch(each) or Path(each).is_dir()]
    if len(paths) > 1:
        raise Stop(f"{paths[0]} and {paths[1]} are two folders: name one, or TODOs such as 4 or 7a")
    return [each for each in words if each not in paths], Path(*paths)


def grade_shown(folder: Path, options: Options, replays: Path | None) -> Result:
    """Grade a tree with a progress bar."""
    with CheckProgress(options, console) as shown:
        return grade_one(folder, replace(options, progress=shown.count), replays)


def show_first(result: Result, folder: Path, replays: Path | None) -> None:
    Screen(console, replays).show(result, notes=list_notes(folder, result))
    if result.has_full_marks and (words := hidden_points_note(result)):
        say(words, console)


def make_options(todos: frozenset[str], course: Course) -> Options:
    """Return the options of `check`: like `grade`, but no reference or confinement."""
    return Options(only=todos, trusted=True, mends=True, course=course, jobs=count_cores())


def find_tree(path: Path, course: Course) -> Path:
    """Return the student's tree around `path`, the folder with the course's first program."""
    name = course.modules[0]
    for folder in [path.resolve(), *path.resolve().parents]:
        if (folder / name).is_dir() or (folder / f"{name}.py").is_file():
            return folder
    raise Stop(f"there is no {name} in {path.resolve()} or above it: go to the folder handed out")


def write_due(course: Course) -> str:
    return f", until {format_time(course.due)}" if course.due else ""


@app.command("hand-in")
def hand_in_command(
    path: Annotated[Path, typer.Argument(help="A folder inside your tree.")] = Path("."),
    out: Annotated[Path | None, typer.Option(help="The zip; hand-in.zip if left out.")] = None,
    checks: Annotated[
        bool, typer.Option("--check/--no-check", help="Run the checks, to list what is unfinished.")
    ] = True,
    course: CourseFile = None,
) -> None:
    """Pack your work into hand-in.zip. Exit status 1: a program is missing."""
    require_file_target(out, "--out")
    taken = read_course(course)
    folder = find_tree(path, taken)
    packed, names = pack_tree(folder, taken, out)
    for words in list_tops(names):
        console.print(f"  {clean(words)}", soft_wrap=True)
    missing = find_missing(names, taken)
    for name in missing:
        say(f"There is no {name} here: hand in when all programs are there.", console)
    for words in list_warnings(folder, names):
        say(clean(words), console, indent=2, style="yellow")
    if checks and not missing:
        say(describe_progress(folder, make_options(frozenset(), taken)), console, indent=2)
    say(f"{plural(len(names), 'file')} in {packed}", console)
    say(write_receipt(packed), console)
    say(f"Hand in this one file{write_due(taken)}.", console)
    raise typer.Exit(1 if missing else 0)


def describe_progress(folder: Path, options: Options) -> str:
    """Check a tree; return a line on the points and the unfinished TODOs."""
    try:
        result = grade_shown(folder, options, None)
    except Stop as error:
        return f"The checks cannot run: {clean(str(error))}."
    left = [todo.id for todo in result.main_todos if todo.state != "passed"]
    points = " ".join(total(result).split())
    if not left:
        return f"All checks pass: {points}."
    return f"Your checks give {points}. Not finished: {', '.join(left)}."


def make_replay_folder(tree: Path) -> Path | None:
    """Make a folder for replays that git ignores; return None if it cannot be written."""
    folder = tree / "build" / "replays"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / ".gitignore").write_text("*\n", encoding="utf-8")
    except OSError:
        return None
    return folder


@app.command("hint")
def hint_command(
    name: Annotated[str, typer.Argument(help="The TODO, such as 4.")] = "",
    todo: Annotated[str, typer.Option(help="The same, as an option.")] = "",
    level: Annotated[
        int, typer.Option(min=1, max=3, help="1 for the least help, 3 for the most.")
    ] = 1,
    course: CourseFile = None,
) -> None:
    """Give a hint: a question, with --level 2 the idea, with 3 nearly the code."""
    if not (name or todo):
        raise Stop(f"name a TODO, as in {command('hint', '4')}")
    todo, *others = find_parts(name or todo, read_course(course))
    if others:
        raise Stop(f"there are {', '.join([todo, *others])}: name one")
    hints = load_hints(todo)
    if not hints:
        say(f"There is no hint for {todo}: its checks name the TODO to look at.", console)
        return
    for number, words in enumerate(hints[:level], 1):
        say(f"{number}  {words}", console, indent=3)
    if level < len(hints):
        say(f"More: {command('hint', todo, level + 1)}", console)


def load_hints(id: str) -> list[str]:
    """Return the three hints of a TODO; empty if it has none."""
    return next((todo.hints for todo in load_rubric().todos if todo.id == id), [])
