"""Define the students' command `questions`: a page to practise with their own program.

It replaces the command that makes sheets and keys. Films, lines and reasons are made of the
program; numbers are cases that came with the release. What `check` passes is right.
"""

import secrets
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from grader.cli.shared import (
    CourseFile,
    console,
    print_note,
    print_notes,
    require_file_target,
)
from grader.cli.student import find_tree, make_options
from grader.errors import Stop
from grader.judge.course import Course, read_course
from grader.questions.page import make_page
from grader.questions.practice import load_practice
from grader.questions.program import list_askable, open_program
from grader.questions.question import Sheet
from grader.questions.sheet import make_sheet
from grader.report.files import write_whole
from grader.text import plural

app = typer.Typer()


@app.command("questions")
def questions_command(
    path: Annotated[Path, typer.Argument(help="A folder inside your tree.")] = Path("."),
    out: Annotated[
        Path | None, typer.Option(help="The page; build/questions.html if left out.")
    ] = None,
    seed: Annotated[
        int | None, typer.Option(help="A number gives the same questions again.")
    ] = None,
    course: CourseFile = None,
) -> None:
    """Make a page of practice questions about your own program.

    It asks new questions each time, about TODOs that pass. Exit status 0: there are questions,
    1: no TODO passes yet, 2: the page could not be made.
    """
    require_file_target(out, "--out")
    taken = read_course(course)
    sheet, _ = make_questions(find_tree(path, taken), taken, out, seed)
    raise typer.Exit(0 if sheet.questions else 1)


def make_questions(
    folder: Path, course: Course, out: Path | None = None, seed: int | None = None
) -> tuple[Sheet, Path]:
    """Make and describe the page of a tree; return the sheet and the page's path."""
    practice = load_practice()
    if practice is None:
        raise Stop("this copy has no cases for practice")
    drawn = str(secrets.randbelow(10**6) if seed is None else seed)
    try:
        with (
            console.status("looking at your program: ten seconds or so"),
            open_program(folder, make_options(list_askable(course), course)) as program,
        ):
            program = replace(program, given=practice.given)
            sheet = make_sheet(program, "practice", drawn, practice.asked, practice.cases)
        target = out or folder / "build" / "questions.html"
        write_whole(make_page(sheet, course.title, "practice").encode(), target)
    except KeyboardInterrupt:
        raise Stop("stopped before there was a page") from None
    print_sheet(sheet, target)
    return sheet, target


def print_sheet(sheet: Sheet, target: Path) -> None:
    """Print the number of questions, and why some TODOs have none."""
    print_notes([f"not asked: {words}" for words in sheet.dropped])
    if not sheet.questions:
        console.print("none of your TODOs passes its checks yet: ask again when one does")
        return
    print_note(f"{plural(len(sheet.questions), 'question')} in {target}, with seed {sheet.seed}")
