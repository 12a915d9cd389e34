"""Define the command `questions`: sheets about students' programs, and marks for the answers."""

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
    refuse_ignored,
    require_checkout,
    require_folder_target,
)
from grader.errors import Stop
from grader.judge.course import read_course
from grader.judge.grade import Options, shipped_reference
from grader.judge.outer import WHOLE
from grader.text import plural

if TYPE_CHECKING:
    from grader.intake.roster import ClassList
    from grader.questions.making import Making
    from grader.questions.marking import Marking

app = typer.Typer()


@app.command("questions")
def questions_command(
    context: typer.Context,
    path: Annotated[
        Path | None, typer.Argument(help="A submission: folder, file or zip; or a class of them.")
    ] = None,
    class_: Annotated[
        bool, typer.Option("--class", help="PATH holds submissions: a folder or zip of them.")
    ] = False,
    out: Annotated[Path, typer.Option(help="Where sheets and keys go.")] = Path("questions"),
    student: Annotated[
        str, typer.Option("--id", help="Whose it is; the name of the submission if left out.")
    ] = "",
    seed: Annotated[
        int | None, typer.Option(help="A secret seed; one is drawn and kept if left out.")
    ] = None,
    practice: Annotated[
        bool, typer.Option("--practice", help="Sheets with other numbers, and answers to open.")
    ] = False,
    mark: Annotated[
        Path | None, typer.Option(help="Answers on paper, as CSV: student, question, answer.")
    ] = None,
    results: Annotated[
        Path | None, typer.Option(help="The results of grading them: nothing is graded again.")
    ] = None,
    roster: Annotated[Path | None, typer.Option(help="For a class: its list.")] = None,
    isolation: Confinement = "auto",
    course: CourseFile = None,
) -> None:
    """Make a sheet of questions for each student about their own program, with its key.

    With --mark, answers are marked by the keys in --out. Exit status 0: everybody has a sheet, or
    every answer is marked, 1: not everybody or not every one, 2: nothing could be made.
    """
    require_checkout("questions")
    if mark is not None:
        refuse_when_marking(context, path)
        go_on(context)
        mark_class(mark, out)
    if path is None:
        raise Stop("name a submission, or a class of them with --class")
    if not class_:
        go_on(context)
    require_folder_target(out, "--out")
    if results is not None and not results.is_dir():
        raise Stop(f"there is no folder of results at {results}: leave out --results")
    ignored, when = (("student",), "with") if class_ else (("roster",), "without")
    refuse_ignored(context, ignored, f"{when} --class")
    # Imported here: all of it would add a tenth of a second to every start.
    from grader.intake.systems import read_class_list
    from grader.questions.making import Making

    options = Options(shipped_reference(), isolation, course=read_course(course))
    making = Making(out, options, seed, practice, results)
    people = read_class_list(path, roster) if class_ else None
    make_sheets(making, path, people, student)


def go_on(context: typer.Context) -> None:
    """Go on within the limits of one submission; a class has them for each."""
    if context.obj is not None:
        context.obj(WHOLE)


def make_sheets(
    making: "Making", path: Path, people: "ClassList | None", student: str = ""
) -> NoReturn:
    """Make the sheets of a class, or of one submission where there are no `people`."""
    from grader.questions.making import make_class, make_one

    try:
        if people is not None:
            made = make_class(making, path, people, console)
        else:
            made = [make_one(making, path, student)]
    except KeyboardInterrupt:
        words = "stopped; sheets that are made stay, and the same command makes them again"
        raise Stop(words) from None
    print_notes([each.words for each in made])
    print_note(f"{plural(sum(each.sheet is not None for each in made), 'sheet')} in {making.out}")
    raise typer.Exit(0 if all(each.sheet for each in made) else 1)


def refuse_when_marking(context: typer.Context, path: Path | None) -> None:
    making = ("class_", "student", "seed", "practice", "results", "roster", "isolation")
    refuse_ignored(context, making, "with --mark, which makes no sheets")
    if path is not None:
        raise Stop(f"{path} would be ignored with --mark, which needs the keys in --out alone")


def mark_class(
    answers: Path,
    out: Path,
    write_gradebook: "Callable[[Marking], list[str]]" = lambda _: [],
) -> NoReturn:
    """Mark a table of answers.

    `write_gradebook` returns what to tell of the gradebook that it made.
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
