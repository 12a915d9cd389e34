"""What students run in their own tree: `check`, `hint` and `hand-in`."""

from pathlib import Path
from typing import Annotated

import msgspec
import typer

from grader.cli.hand_in import hand_in, missing_programs
from grader.cli.restore import CannotRestore, notes_on, restore
from grader.cli.shared import CourseFile, console, course_in, graded, known_todos, stop
from grader.judge.course import Course
from grader.judge.grade import Options
from grader.judge.result import Result
from grader.judge.rubric import CHECKS
from grader.judge.submission import CannotGrade
from grader.judge.wording import command, hidden_points_note
from grader.report.screen import Screen
from grader.report.terminal import Teller, say, show_standing
from grader.text import clean, moment, plural

app = typer.Typer()


@app.command("check")
def check_command(
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
    path: Annotated[Path, typer.Argument(help="A folder inside your tree.")] = Path("."),
    watch: Annotated[bool, typer.Option("--watch", help="Check again after each save.")] = False,
    whole: Annotated[bool, typer.Option("--all", help="Everything that failed, in full.")] = False,
    status: Annotated[bool, typer.Option(hidden=True)] = True,
    undo: Annotated[
        list[str] | None,
        typer.Option("--restore", metavar="NAME", help="Put back given code, by its name."),
    ] = None,
    course: CourseFile = None,
) -> None:
    """Show what stands in your own tree, and what to do next. Exit status as for `grade`.

    One TODO at a time is told in full; `--all` tells everything.
    """
    chosen = course_in(course)
    folder = own_tree(path, chosen)
    if undo:
        put_back(folder, undo)
        return
    options, replays = own_options(known_todos(todo, chosen), chosen), replays_in(folder)
    if watch:
        result = watched(folder, options, replays)
    else:
        result = graded(folder, options, replays)
        tell(result, replays, chosen, folder, whole)
    raise typer.Exit(0 if result.complete or not status else 1)


def tell(result: Result, replays: Path | None, course: Course, folder: Path, whole: bool) -> None:
    """Print the first screen of a result, or the `whole` of it, and how to hand in."""
    if whole:
        show_standing(result, Teller(console, replays))
    else:
        Screen(console, replays).show(result, notes=notes_on(folder, result))
    if whole or result.complete:
        if words := "" if whole else hidden_points_note(result):
            say(words, console)
        say(f"To hand in: {command('hand-in')}{until(course)}", console)


def own_options(todos: frozenset[str], course: Course) -> Options:
    """How `check` grades: as `grade` does without a reference, but for what confines."""
    return Options(only=todos, trusted=True, course=course)


def put_back(folder: Path, names: list[str]) -> None:
    """Undo changes of given code, and say what was done."""
    for name in names:
        try:
            for words in restore(folder, name):
                say(clean(words), console)
        except (CannotRestore, OSError) as error:
            stop(str(error), f"restore {name}")


def watched(folder: Path, options: Options, replays: Path | None) -> Result:
    """Check after each save until Ctrl-C; returns the last result."""
    from grader.cli.watch import watch

    try:
        return watch(folder, options, console, replays)
    except CannotGrade as error:
        stop(str(error), "go on")


def own_tree(path: Path, course: Course) -> Path:
    """The student's tree around `path`: the folder that holds the first program of the course."""
    name = course.modules[0]
    for folder in [path.resolve(), *path.resolve().parents]:
        if (folder / name).is_dir() or (folder / f"{name}.py").is_file():
            return folder
    stop(f"there is no {name} in {path.resolve()} or above it: go to the folder handed out")


def until(course: Course) -> str:
    """The due date, where the course has one."""
    return f", until {moment(course.due)}" if course.due else ""


@app.command("hand-in")
def hand_in_command(
    path: Annotated[Path, typer.Argument(help="A folder inside your tree.")] = Path("."),
    out: Annotated[Path | None, typer.Option(help="The zip; hand-in.zip if left out.")] = None,
    course: CourseFile = None,
) -> None:
    """Pack your work, and nothing else, into hand-in.zip. Exit status 1: a program is missing."""
    chosen = course_in(course)
    try:
        packed, names = hand_in(own_tree(path, chosen), chosen, out)
    except (CannotGrade, OSError) as error:
        stop(str(error), "pack")
    for name in names:
        console.print(f"  {clean(name)}", soft_wrap=True)
    missing = missing_programs(names, chosen)
    for name in missing:
        say(f"There is no {name} here: hand in once all programs are there.", console)
    say(f"{plural(len(names), 'file')} in {packed}", console)
    say(f"Hand in this one file{until(chosen)}.", console)
    raise typer.Exit(1 if missing else 0)


def replays_in(tree: Path) -> Path | None:
    """A folder for replays that git leaves alone; None where nothing can be written."""
    folder = tree / "build" / "replays"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / ".gitignore").write_text("*\n", encoding="utf-8")
    except OSError:
        return None
    return folder


@app.command("hint")
def hint_command(
    todo: Annotated[str, typer.Option(help="The TODO you are at.")],
    level: Annotated[int, typer.Option(min=1, max=3, help="How much to tell.")] = 1,
    course: CourseFile = None,
) -> None:
    """Give a hint: first a question, then the idea, then nearly the code."""
    known_todos([todo], course_in(course))
    hints = msgspec.toml.decode((CHECKS / "hints.toml").read_bytes(), type=dict[str, list[str]])
    if todo not in hints:
        say(f"There is no hint for {todo}. What its checks say leads to the TODO.", console)
        return
    for number, words in enumerate(hints[todo][:level], 1):
        say(f"{number}  {words}", console, indent=3)
    if level < len(hints[todo]):
        say(f"More: {command('hint', todo, level + 1)}", console)
