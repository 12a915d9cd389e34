"""The command `questions`: sheets about students' own programs, and marks for the answers."""

from pathlib import Path
from typing import Annotated, NoReturn

import typer

from grader.cli.shared import CourseFile, console, course_in, needs_checkout, refuse_ignored, stop
from grader.judge.grade import KIT, Options, shipped_reference
from grader.judge.isolation import Isolation
from grader.judge.submission import CannotGrade
from grader.text import clean, plural

TALLY = KIT / "build" / "questions" / "tally.json"

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
    tally: Annotated[
        Path, typer.Option(help="Where the answers of all classes are counted.")
    ] = TALLY,
    results: Annotated[
        Path | None, typer.Option(help="The results of grading them: nothing is graded again.")
    ] = None,
    roster: Annotated[Path | None, typer.Option(help="For a class: its list.")] = None,
    isolation: Annotated[Isolation, typer.Option(help="Confinement to insist on.")] = "auto",
    course: CourseFile = None,
) -> None:
    """Make a sheet of questions for each student about their own program, with its key.

    With --mark, answers are marked by the keys in --out. Exit status 0: everybody has a sheet, or
    every answer is marked, 1: not everybody or not every one, 2: nothing could be made.
    """
    needs_checkout("questions")
    if mark is not None:
        ignored_when_marking(context, path)
        mark_them(mark, out, tally)
    if path is None:
        stop("name a submission, or a class of them with --class", "ask")
    ignored, when = (("student",), "with") if class_ else (("roster",), "without")
    refuse_ignored(context, ignored, f"{when} --class")
    # Imported here: all of it would add a tenth of a second to every start.
    from grader.questions.making import Making, make_class, make_one

    taken = course_in(course)
    options = Options(shipped_reference(), isolation, course=taken)
    making = Making(out, options, seed, practice, results, tally)
    try:
        if class_:
            made = make_class(making, path, roster, console)
        else:
            made = [make_one(making, path, student)]
    except (CannotGrade, OSError) as error:
        stop(str(error), "ask")
    except KeyboardInterrupt:
        stop("stopped; sheets that are made stay, and the same command makes them again", "ask")
    for each in made:
        console.print(clean(each.words), soft_wrap=True)
    count = plural(sum(each.sheet is not None for each in made), "sheet")
    console.print(f"{count} in {out}", soft_wrap=True)
    raise typer.Exit(0 if all(each.sheet for each in made) else 1)


def ignored_when_marking(context: typer.Context, path: Path | None) -> None:
    making = ("class_", "student", "seed", "practice", "results", "roster", "isolation")
    refuse_ignored(context, making, "with --mark, which makes no sheets")
    if path is not None:
        stop(f"{path} would be ignored with --mark, which needs the keys in --out alone", "mark")


def mark_them(answers: Path, out: Path, tally: Path) -> NoReturn:
    """Mark a table of answers, and count them with those of other classes."""
    from grader.questions.marking import mark_answers, read_keys, write_points
    from grader.questions.tally import add_class, write_bank

    try:
        marked = mark_answers(answers, out / "keys")
        tables = write_points(marked, out)
        sheets = read_keys(out / "keys")
        write_bank(out / "bank.html", sheets, add_class(tally, sheets, marked.marks))
    except (CannotGrade, OSError) as error:
        stop(str(error), "mark")
    waiting = [each for each in marked.marks if each.points is None]
    for note in marked.notes:
        console.print(clean(note), soft_wrap=True)
    for each in waiting:
        words = f"{each.student}, question {each.number}: {each.note}"
        console.print(clean(words), soft_wrap=True)
    console.print(f"{' and '.join(map(str, tables))} are written", soft_wrap=True)
    raise typer.Exit(1 if waiting or marked.notes else 0)
