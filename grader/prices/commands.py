"""The command that measures what an engine's accuracy costs.

It imports what measures and draws itself: that would add to every start of the grader.
"""

from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from grader.commands import (
    CourseFile,
    console,
    course_in,
    refuse_ignored,
    stop,
    submission_at,
)
from grader.judge.grade import Options, shipped_reference
from grader.judge.isolation import Isolation
from grader.judge.submission import CannotGrade
from grader.student import own_tree

FOR_CLASS = ("jobs", "roster")

app = typer.Typer()


@app.command("experiments")
def experiments_command(
    context: typer.Context,
    path: Annotated[
        Path | None,
        typer.Argument(help="The submission: folder, file or zip. Left out: your own tree."),
    ] = None,
    class_: Annotated[
        bool, typer.Option("--class", help="PATH holds submissions: a folder or zip of them.")
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(help="Write the curves into this folder. For a class: its results."),
    ] = None,
    jobs: Annotated[
        int, typer.Option(help="For a class: submissions at a time; 0 for one per core.")
    ] = 0,
    roster: Annotated[
        Path | None, typer.Option(help="For a class: its list, as the LMS exports it.")
    ] = None,
    isolation: Annotated[Isolation, typer.Option(help="Confinement to insist on.")] = "auto",
    seed: Annotated[
        int | None, typer.Option(help="A secret seed: other sizes, masses and speeds.")
    ] = None,
    course: CourseFile = None,
) -> None:
    """Measure what an engine's accuracy costs: error against opcodes, in three scenes.

    Nothing here is a mark. Exit status 0: measured, 2: could not be measured.
    """
    chosen = course_in(course)
    reference = shipped_reference()
    options = Options(reference, isolation, seed=seed, trusted=reference is None, course=chosen)
    if class_:
        if path is None:
            stop("--class needs the submissions: name a folder or a zip of them", "measure")
        measure_class(path, options, out, jobs, roster)
    refuse_ignored(context, FOR_CLASS, "without --class, which measures a folder or zip of them")
    if path is None:
        measure_one(own_tree(Path("."), chosen), options, out)
    else:
        with submission_at(path, chosen.modules) as folder:
            measure_one(folder, options, out)


def measure_one(path: Path, options: Options, out: Path | None) -> None:
    """Measure one engine beside those to compare with, and show it."""
    from grader.prices.one import price_one, show, write_one

    try:
        with console.status("measuring: ten seconds or so"):
            prices, own = price_one(path, options)
    except CannotGrade as error:
        stop(str(error), "measure")
    except KeyboardInterrupt:
        stop("stopped before the end; nothing is left behind", "measure")
    show(prices, own, console)
    if out is not None:
        for each in write_one(prices, own, out):
            console.print(f"made {each}", soft_wrap=True)


def measure_class(
    path: Path, options: Options, out: Path | None, jobs: int, roster: Path | None
) -> NoReturn:
    if not find_spec("grader.classroom"):
        stop("this is the students' grader, and --class needs the whole kit", "measure")
    from grader.classroom.prices import ClassPrices, run_prices

    try:
        run_prices(path, ClassPrices(options, out, jobs, roster), console)
    except (CannotGrade, OSError) as error:
        stop(str(error), "measure")
    except KeyboardInterrupt:
        stop("stopped; what is measured stays, and the same command goes on from there", "measure")
    raise typer.Exit
