"""The command `questions` at home: a page of questions to practise, about one's own program.

Students have it in the place of the one that makes sheets and keys. Films, lines and reasons are
made of their program; numbers are cases that came with the release. What `check` passes is right.
"""

import secrets
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from grader.cli.shared import CourseFile, console, course_in, stop
from grader.cli.student import own_options, own_tree
from grader.judge.submission import CannotGrade
from grader.questions.page import page
from grader.questions.practice import load_practice
from grader.questions.program import askable, opened_program
from grader.questions.question import Sheet
from grader.questions.sheet import sheet_of
from grader.report.files import write_whole
from grader.text import clean, plural

app = typer.Typer()


@app.command("questions")
def questions_command(
    path: Annotated[Path, typer.Argument(help="A folder inside your tree.")] = Path("."),
    out: Annotated[
        Path | None, typer.Option(help="The page; build/questions.html if left out.")
    ] = None,
    seed: Annotated[
        int | None, typer.Option(help="For the same questions again; new ones if left out.")
    ] = None,
    course: CourseFile = None,
) -> None:
    """Make a page of questions about your own program, to practise; other ones each time.

    It asks about TODOs that pass their checks, and its answers open with a click. Exit status 0:
    there are questions, 1: nothing to ask about yet, 2: no page could be made.
    """
    practice = load_practice()
    if practice is None:
        stop("this copy has no cases for practice", "ask")
    chosen = course_in(course)
    folder = own_tree(path, chosen)
    drawn = str(secrets.randbelow(10**6) if seed is None else seed)
    try:
        with (
            console.status("looking at your program: ten seconds or so"),
            opened_program(folder, own_options(askable(chosen), chosen)) as program,
        ):
            program = replace(program, given=practice.given)
            sheet = sheet_of(program, "practice", drawn, practice.asked, practice.cases)
        target = out or folder / "build" / "questions.html"
        write_whole(page(sheet, chosen.title, "practice").encode(), target)
    except (CannotGrade, OSError) as error:
        stop(str(error), "ask")
    except KeyboardInterrupt:
        stop("stopped before there was a page", "ask")
    tell(sheet, target)
    raise typer.Exit(0 if sheet.questions else 1)


def tell(sheet: Sheet, target: Path) -> None:
    """Print what is asked, and what is not, and why."""
    for words in sheet.dropped:
        console.print(clean(f"not asked: {words}"), soft_wrap=True)
    if not sheet.questions:
        console.print("none of your TODOs passes its checks yet: ask again when one does")
        return
    count = plural(len(sheet.questions), "question")
    console.print(clean(f"{count} in {target}, with seed {sheet.seed}"), soft_wrap=True)
