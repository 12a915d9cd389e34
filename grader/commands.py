"""What the commands share: where they print, how they stop, which TODOs there are."""

from pathlib import Path
from typing import NoReturn

import typer
from rich.console import Console

from grader.judge.grade import Options, grade
from grader.judge.result import Result
from grader.judge.rubric import load_rubric
from grader.judge.submission import CannotGrade

console = Console(highlight=False, markup=False)


def stop(message: str, cannot: str = "grade") -> NoReturn:
    """End the command with exit status 2, and say why."""
    Console(stderr=True, highlight=False, markup=False).print(f"cannot {cannot}: {message}")
    raise typer.Exit(2)


def known_todos(todos: list[str] | None) -> frozenset[str]:
    """The TODOs named on the command line; an unknown one ends the command."""
    known = [todo.id for todo in load_rubric().todos]
    for todo in todos or ():
        if todo not in known:
            stop(f"there is no TODO {todo}; there are {', '.join(known)}")
    return frozenset(todos or ())


def graded(path: Path, options: Options) -> Result:
    """The result of one submission; a folder that cannot be graded ends the command."""
    try:
        return grade(path, options)
    except CannotGrade as error:
        stop(str(error))
