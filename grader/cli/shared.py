"""What the commands share: where they print, what stops them, which TODOs there are."""

from collections.abc import Collection, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, NoReturn

import typer
from rich.console import Console

from grader.judge.course import COURSE_FILE, FULL, Course, WrongCourse, read_course
from grader.judge.grade import KIT, Options, grade
from grader.judge.result import Result
from grader.judge.submission import CannotGrade
from grader.text import clean

CHECKOUT = ("solution/mini_engine", "starter/mini_engine", "tests/bank", "handouts/instructor")

console = Console(highlight=False, markup=False)

CourseFile = Annotated[
    Path | None,
    typer.Option(
        "--course",
        envvar=COURSE_FILE,
        show_envvar=False,
        help="What the course takes of the kit; its course.toml if left out.",
    ),
]


def course_in(path: Path | None) -> Course:
    """The course in this file or else the kit's; one that cannot be so ends the command."""
    try:
        return read_course(path)
    except WrongCourse as error:
        stop(str(error), "go on")


def stop(message: str, cannot: str = "grade") -> NoReturn:
    """End the command with exit status 2, and say why."""
    say_why(message, cannot)
    raise typer.Exit(2)


def say_why(message: str, cannot: str) -> None:
    Console(stderr=True, highlight=False, markup=False).print(f"cannot {cannot}: {message}")


def needs_checkout(command: str, instead: str = "") -> None:
    """Stop where the grader is installed without the kit around it, and say what is missing."""
    missing = [name for name in CHECKOUT if not (KIT / name).is_dir()]
    if missing:
        stop(
            f"`grader {command}` works on the whole kit, and {KIT} holds no {', '.join(missing)}: "
            f"run python -m grader {command} in a checkout of the kit{instead}",
            "go on",
        )


def refuse_ignored(context: typer.Context, names: Collection[str], when: str) -> None:
    """Stop if any of these options was given: nobody should believe that it counted."""
    given = [
        option.opts[-1]
        for option in context.command.params
        if option.name in names and was_given(context, option.name or "")
    ]
    if given:
        stop(f"{', '.join(given)} would be ignored {when}", "go on")


def was_given(context: typer.Context, name: str) -> bool:
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def known_todos(todos: list[str] | None, course: Course = FULL) -> frozenset[str]:
    """The TODOs named on the command line; one that the course has not ends the command."""
    known = [todo.id for todo in course.rubric.todos]
    for todo in todos or ():
        if todo not in known:
            stop(f"there is no TODO {todo}; there are {', '.join(known)}")
    return frozenset(todos or ())


def graded(path: Path, options: Options, replays: Path | None = None) -> Result:
    """Grade one submission, with `replays` in a folder; what cannot be graded ends the command."""
    try:
        if replays is None:
            return grade(path, options)
        # Here for the time it takes, 0.04 s: it loads what makes pages.
        from grader.player.replay import grade_with_replays

        return grade_with_replays(path, options, replays)
    except CannotGrade as error:
        stop(str(error))
    except KeyboardInterrupt:  # exit status 1 would say that points are missing
        stop("stopped before the end; nothing is left behind")


@contextmanager
def submission_at(path: Path, asked: Collection[str] = ()) -> Iterator[Path]:
    """The submission itself: what a zip holds is unpacked, in the instructor's grader.

    Two files for one program are a question only where the course has `asked` for it.
    """
    if not find_spec("grader.classroom"):  # students have no zips and no folders of submissions
        yield path
        return
    # Imported here: students have none of it, and it would add 30 ms to every start.
    from grader.intake.listing import class_in
    from grader.intake.packing import opened_submission

    names = class_in(path) if path.is_dir() else []
    if names:
        more = f" and {len(names) - 2} more" if len(names) > 2 else ""
        stop(
            f"{path} is no submission but holds some, {', '.join(names[:2])}{more}: grade all of "
            "them with --class, or name one"
        )
    try:
        with opened_submission(path, lambda note: console.print(clean(note)), asked) as folder:
            yield folder
    except CannotGrade as error:
        stop(str(error))
