"""Define the command `questions`: sheets about programs, and marks for the answers."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from grader.cli.shared import (
    Confinement,
    CourseFile,
    console,
    print_note,
    print_notes,
    require_checkout,
    require_folder_target,
)
from grader.errors import Stop
from grader.judge.course import read_course
from grader.judge.task import Options, shipped_reference
from grader.judge.wall.outer import WHOLE, go_on_within
from grader.text import plural

if TYPE_CHECKING:
    from grader.intake.roster import ClassList
    from grader.questions.making import Making, SheetResult
    from grader.questions.marking import Marking

app = typer.Typer()


@app.command("questions")
def questions_command(
    context: typer.Context,
    path: Annotated[Path, typer.Argument(help="A submission: folder, file or zip.")],
    out: Annotated[Path, typer.Option(help="Where sheets and keys go.")] = Path("questions"),
    student: Annotated[
        str, typer.Option("--id", help="Whose it is; the name of the submission if left out.")
    ] = "",
    seed: Annotated[
        int | None, typer.Option(help="A secret seed; one is drawn and kept if left out.")
    ] = None,
    practice: Annotated[
        bool, typer.Option("--practice", help="A sheet with other numbers, and answers to open.")
    ] = False,
    isolation: Confinement = "auto",
    course: CourseFile = None,
) -> None:
    """Make a sheet of questions about one submission, with its key.

    A class has `grader class questions`. Exit status 0: there is a sheet, 1: there is none.
    """
    require_checkout("questions")
    if context.obj:
        go_on_within(WHOLE)
    require_folder_target(out, "--out")
    # Imported here: all of it would add a tenth of a second to every start.
    from grader.questions.making import Making, make_one

    options = Options(shipped_reference(), isolation, course=read_course(course))
    making = Making(out, options, seed, practice)
    try:
        made = make_one(making, path, student)
    except KeyboardInterrupt:
        raise Stop("stopped before there was a sheet") from None
    end_with_sheets(making, [made])


def make_sheets(making: "Making", path: Path, people: "ClassList") -> NoReturn:
    """Make the sheets of a class."""
    from grader.questions.making import make_class

    try:
        made = make_class(making, path, people, console)
    except KeyboardInterrupt:
        words = "stopped; sheets that are made stay, and the same command makes them again"
        raise Stop(words) from None
    end_with_sheets(making, made)


def end_with_sheets(making: "Making", made: "list[SheetResult]") -> NoReturn:
    """Print how many students have a sheet, and end with the command's status."""
    print_notes([each.words for each in made])
    print_note(f"{plural(sum(each.sheet is not None for each in made), 'sheet')} in {making.out}")
    raise typer.Exit(0 if all(each.sheet for each in made) else 1)


def mark_class(
    answers: Path, out: Path, write_gradebook: "Callable[[Marking], list[str]]"
) -> NoReturn:
    """Mark a table of answers.

    `write_gradebook` makes a gradebook and returns notes on it.
    """
    from grader.questions.marking import mark_answers, write_points

    marked = mark_answers(answers, out / "keys")
    tables = write_points(marked, out)
    waiting = [each for each in marked.marks if each.points is None]
    open_answers = [f"{each.student}, question {each.number}: {each.note}" for each in waiting]
    print_notes([*marked.notes, *open_answers])
    print_note(f"{' and '.join(map(str, tables))} are written")
    print_notes(write_gradebook(marked))
    raise typer.Exit(1 if waiting or marked.notes else 0)
