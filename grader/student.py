"""What students run in their own tree: `check` and `hint`."""

from pathlib import Path
from typing import Annotated

import msgspec
import typer

from grader.commands import console, graded, known_todos, stop
from grader.judge.grade import Options
from grader.judge.rubric import CHECKS
from grader.report.terminal import show, show_next

app = typer.Typer()


@app.command("check")
def check_command(
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
    path: Annotated[Path, typer.Argument(help="A folder inside your tree.")] = Path("."),
) -> None:
    """Show what stands in your own tree, and what to do next. Exit status as for `grade`."""
    folder = own_tree(path)
    result = graded(folder, Options(reference=None, only=known_todos(todo)))
    show(result, console)
    show_next(result, console)
    raise typer.Exit(0 if result.points == result.max_points else 1)


def own_tree(path: Path) -> Path:
    """The student's tree around `path`: the folder that holds the mini engine."""
    for folder in [path.resolve(), *path.resolve().parents]:
        if (folder / "mini_engine").is_dir() or (folder / "mini_engine.py").is_file():
            return folder
    stop(f"there is no mini_engine in {path.resolve()} or above it: go to the folder handed out")


@app.command("hint")
def hint_command(
    todo: Annotated[str, typer.Option(help="The TODO you are at.")],
    level: Annotated[int, typer.Option(min=1, max=3, help="How much to tell.")] = 1,
) -> None:
    """Give a hint: first a question, then the idea, then nearly the code."""
    known_todos([todo])
    hints = msgspec.toml.decode((CHECKS / "hints.toml").read_bytes(), type=dict[str, list[str]])
    for number, words in enumerate(hints.get(todo, [])[:level], 1):
        console.print(f"{number}  {words}")
    if level < len(hints.get(todo, [])):
        console.print(f"More: python -m grader hint --todo {todo} --level {level + 1}")
