"""The command line: `python -m grader COMMAND`."""

from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from grader import student
from grader.commands import console, graded, known_todos, stop
from grader.judge.grade import KIT, Options, shipped_reference
from grader.judge.isolation import Isolation
from grader.judge.submission import CannotGrade
from grader.report.files import write_json
from grader.report.terminal import show, show_isolation

app = typer.Typer(
    help="Grades submissions of the physics-engine assignment.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


@app.command("grade")
def grade_command(
    path: Annotated[
        Path | None, typer.Argument(help="The submission; the shipped trees if left out.")
    ] = None,
    class_: Annotated[
        bool, typer.Option("--class", help="PATH is a folder of submissions, a folder each.")
    ] = False,
    out: Annotated[Path | None, typer.Option(help="Write NAME.json into this folder.")] = None,
    json: Annotated[Path | None, typer.Option(help="Write the one result here as JSON.")] = None,
    reference: Annotated[
        Path | None, typer.Option(help="The complete tree; the kit's own if left out.")
    ] = None,
    jobs: Annotated[int, typer.Option(help="Submissions at a time; 0 for one per core.")] = 0,
    isolation: Annotated[Isolation, typer.Option(help="Confinement to insist on.")] = "auto",
    seed: Annotated[int | None, typer.Option(help="A secret seed for the property tests.")] = None,
    todo: Annotated[list[str] | None, typer.Option(help="Only this TODO; may be repeated.")] = None,
) -> None:
    """Grade a submission, or a class of them.

    Exit status 0: full marks (for a class: all graded), 1: less, 2: could not be graded.
    """
    options = Options(
        reference or shipped_reference(), isolation, only=known_todos(todo), seed=seed
    )
    if path is None:
        demonstrate(options)
    elif class_:
        grade_folder(path, out, options, jobs)
    else:
        grade_one(path, out, json, options)


def grade_one(path: Path, out: Path | None, json: Path | None, options: Options) -> NoReturn:
    result = graded(path, options)
    show(result, console)
    show_isolation(result, console)
    if json is not None:
        write_json(result, json)
    if out is not None:
        write_json(result, out / f"{result.submission}.json")
    raise typer.Exit(0 if result.points == result.max_points else 1)


def grade_folder(path: Path, out: Path | None, options: Options, jobs: int) -> NoReturn:
    from grader.classroom.batch import grade_class, show_class

    try:
        outcomes = grade_class(path, out, options, jobs, console)
    except CannotGrade as error:
        stop(str(error))
    show_class(outcomes, console)
    raise typer.Exit(2 if any(outcome.result is None for outcome in outcomes) else 0)


def demonstrate(options: Options) -> None:
    """The shipped trees, to show that the grader works here."""
    for name in ("solution", "starter"):
        console.rule(name)
        result = graded(KIT / name, options)
        show(result, console)
    show_isolation(result, console)


def main() -> None:
    app.add_typer(student.app)
    if find_spec("grader.classroom"):  # students get neither of these two folders
        from grader.classroom.commands import app as classroom
        from grader.maintain.commands import app as maintain

        app.add_typer(classroom)
        app.add_typer(maintain)
    app(prog_name="grader")
