"""Define the students' command `questions`: a page to practise with their own program.

It replaces the command that makes sheets and keys. Films, lines and reasons come from the program;
numbers are cases of the release. TODOs that `check` passes count as right.
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
    course: CourseFile = None,
) -> None:
    """Make a page of practice questions about your own program.

    It asks new questions each time, about TODOs that pass. Exit status 0: there are questions,
    1: no TODO passes yet, 2: the page could not be made.
    """
    taken = read_course(course)
    sheet, _ = make_questions(find_tree(path, taken), taken)
    raise typer.Exit(0 if sheet.questions else 1)


def make_questions(folder: Path, course: Course) -> tuple[Sheet, Path]:
    """Write the page of a tree and print a summary; return sheet and path."""
    practice = load_practice()
    if practice is None:
        raise Stop("this copy has no cases for practice")
    seed = str(secrets.randbelow(10**6))
    try:
        with (
            console.status("looking at your program: ten seconds or so"),
            open_program(folder, make_options(list_askable(course), course)) as program,
        ):
            program = replace(program, given=practice.given)
            sheet = make_sheet(program, "practice", seed, practice.asked, practice.cases)
        target = folder / "build" / "questions.html"
        write_whole(make_page(sheet, course.title, "practice").encode(), target)
    except KeyboardInterrupt:
        raise Stop("stopped before there was a page") from None
    print_sheet(sheet, target)
    return sheet, target


def print_sheet(sheet: Sheet, target: Path) -> None:
    """Print the number of questions, and why some TODOs have none."""
    print_notes([f"Skipped a question on {words}." for words in sheet.dropped])
    if not sheet.questions:
        console.print("none of your TODOs passes its checks yet: ask again when one does")
        return
    print_note(f"{plural(len(sheet.questions), 'question')} in {target}")
