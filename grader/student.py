"""What students run in their own tree: `check`, `hint` and `hand-in`."""

from pathlib import Path
from typing import Annotated

import msgspec
import typer

from grader.commands import console, graded, known_todos, stop
from grader.hand_in import hand_in
from grader.judge.grade import Options
from grader.judge.result import Result
from grader.judge.rubric import CHECKS
from grader.judge.submission import CannotGrade
from grader.report.terminal import Teller, say, show_standing
from grader.words import clean, command

app = typer.Typer()


@app.command("check")
def check_command(
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
    path: Annotated[Path, typer.Argument(help="A folder inside your tree.")] = Path("."),
    watch: Annotated[bool, typer.Option("--watch", help="Check again after each save.")] = False,
) -> None:
    """Show what stands in your own tree, and what to do next. Exit status as for `grade`."""
    folder = own_tree(path)
    options = Options(
        reference=None, only=known_todos(todo), replays=replays_in(folder), trusted=True
    )
    if watch:
        result = watched(folder, options)
    else:
        result = graded(folder, options)
        show_standing(result, Teller(console, options.replays))
        say(f"To hand in: {command('hand-in')} packs what is asked for.", console)
    raise typer.Exit(0 if result.complete else 1)


def watched(folder: Path, options: Options) -> Result:
    """Check after each save until Ctrl-C; returns the last result."""
    from grader.watch import watch

    try:
        return watch(folder, options, console)
    except CannotGrade as error:
        stop(str(error), "go on")


def own_tree(path: Path) -> Path:
    """The student's tree around `path`: the folder that holds the mini engine."""
    for folder in [path.resolve(), *path.resolve().parents]:
        if (folder / "mini_engine").is_dir() or (folder / "mini_engine.py").is_file():
            return folder
    stop(f"there is no mini_engine in {path.resolve()} or above it: go to the folder handed out")


def replays_in(tree: Path) -> Path | None:
    """A folder for replays that git leaves alone; None where nothing can be written."""
    folder = tree / "build" / "replays"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / ".gitignore").write_text("*\n", encoding="utf-8")
    except OSError:
        return None
    return folder


@app.command("hand-in")
def hand_in_command(
    path: Annotated[Path, typer.Argument(help="A folder inside your tree.")] = Path("."),
) -> None:
    """Pack your work, and nothing else, into hand-in.zip. Exit status 1: a program is missing."""
    try:
        packed, names, missing = hand_in(own_tree(path))
    except (CannotGrade, OSError) as error:
        stop(str(error), "pack")
    for name in names:
        console.print(f"  {clean(name)}", soft_wrap=True)
    console.print(f"{len(names)} files are in {packed}: hand in this one file", soft_wrap=True)
    for name in missing:
        console.print(f"There is no {name} here. Hand in from the folder that holds all programs.")
    raise typer.Exit(1 if missing else 0)


@app.command("hint")
def hint_command(
    todo: Annotated[str, typer.Option(help="The TODO you are at.")],
    level: Annotated[int, typer.Option(min=1, max=3, help="How much to tell.")] = 1,
) -> None:
    """Give a hint: first a question, then the idea, then nearly the code."""
    known_todos([todo])
    hints = msgspec.toml.decode((CHECKS / "hints.toml").read_bytes(), type=dict[str, list[str]])
    if todo not in hints:
        say(f"There is no hint for {todo}. What its checks say leads to the TODO.", console)
        return
    for number, words in enumerate(hints[todo][:level], 1):
        say(f"{number}  {words}", console, indent=3)
    if level < len(hints[todo]):
        say(f"More: {command('hint', todo, level + 1)}", console)
