"""Share options, output and checks of arguments among all commands."""

import re
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from grader.errors import Stop
from grader.judge.course import COURSE_FILE, FULL, Course
from grader.judge.grade import grade
from grader.judge.result import Result
from grader.judge.task import KIT, Options
from grader.judge.wall.isolation import Isolation
from grader.player.graded import grade_with_replays
from grader.text import printable

CHECKOUT = ("solution/mini_engine", "starter/mini_engine", "tests/bank", "handouts/instructor")

COURSE_HELP = "The TODOs, points and dates of the course; its course.toml if left out."

console = Console(highlight=False, markup=False)


def course_option(*names: str) -> typer.models.OptionInfo:
    """Return the option for the course file, which the environment may name too."""
    option: typer.models.OptionInfo = typer.Option(
        *names, envvar=COURSE_FILE, show_envvar=False, help=COURSE_HELP
    )
    return option


CourseFile = Annotated[Path | None, course_option("--course")]
Confinement = Annotated[Isolation, typer.Option(help="The isolation to require.")]
SecretSeed = Annotated[
    int | None, typer.Option(help="A secret seed: other numbers in every check.")
]
Jobs = Annotated[int, typer.Option(min=0, help="Submissions at a time; 0 for one per core.")]
ResultsFolder = Annotated[Path, typer.Argument(help="The results of a class, a folder.")]


def list_missing() -> list[str]:
    """List the missing folders of a checkout of the kit."""
    return [name for name in CHECKOUT if not (KIT / name).is_dir()]


def require_checkout(command: str, instead: str = "") -> None:
    """Stop if the grader is installed without the kit around it."""
    if missing := list_missing():
        raise Stop(
            f"`grader {command}` works on the whole kit, and {KIT} holds no {', '.join(missing)}: "
            f"run python -m grader {command} in a checkout of the kit{instead}"
        )


def refuse_ignored(context: typer.Context, names: Collection[str], when: str) -> None:
    """Stop if any of these options, which have no effect, was given."""
    given = [
        option.opts[-1]
        for option in context.command.params
        if option.name in names and was_given(context, option.name or "")
    ]
    if given:
        raise Stop(f"{', '.join(given)} would be ignored {when}")


def was_given(context: typer.Context, name: str) -> bool:
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def require_file_target(path: Path | None, option: str) -> None:
    """Stop if an option names a file that cannot be written."""
    if path is not None and path.is_dir():
        raise Stop(f"{option} {path} is a folder: name a file")
    if path is not None:
        require_folder_target(path.absolute().parent, f"{option} {path} needs")


def require_folder_target(path: Path | None, option: str) -> None:
    """Stop if an option names a folder that cannot be made."""
    if path is None:
        return
    there = next(each for each in (path.absolute(), *path.absolute().parents) if each.exists())
    if not there.is_dir():
        raise Stop(f"{option} {path}: {there} is a file: name a folder")


def check_todos(todos: list[str] | None, course: Course = FULL) -> frozenset[str]:
    """Return the TODOs named on the command line; stop at one that the course lacks.

    A number stands for all its parts: 7 for 7a to 7d.
    """
    return frozenset(id for todo in todos or () for id in find_parts(todo, course))


def find_parts(todo: str, course: Course) -> list[str]:
    """Return the TODOs that a word names, ignoring case."""
    ids = [todo.id for todo in course.rubric.todos]
    found = [id for id in ids if id.lower() == todo.lower()]
    found = found or [id for id in ids if re.fullmatch(rf"{re.escape(todo)}[a-z]", id)]
    if not found:
        raise Stop(f"there is no TODO {todo}; there are {', '.join(ids)}")
    return found


def grade_one(path: Path, options: Options, replays: Path | None = None) -> Result:
    """Grade one submission, and write replays into the folder `replays`, if any."""
    try:
        if replays is None:
            return grade(path, options)
        return grade_with_replays(path, options, replays)
    except KeyboardInterrupt:  # exit status 1 would say that points are missing
        raise Stop("stopped before the end; nothing is left behind") from None


@contextmanager
def open_path(path: Path, programs: Collection[str] = ()) -> Iterator[Path]:
    """Open a submission in any form; a student's copy of the grader opens only a tree.

    Two files for one program are an error only for the course's `programs`.
    """
    if not find_spec("grader.classroom"):  # students have no zips and no folders of submissions
        yield path
        return
    # Imported here: students have none of it, and it would add 30 ms to every start.
    from grader.intake.packing import open_submission

    with open_submission(path, print_note, programs) as folder:
        yield folder


def print_note(note: str) -> None:
    console.print(printable(note), soft_wrap=True)


def print_notes(notes: Collection[str]) -> None:
    for note in notes:
        print_note(note)
