"""Grades one submission where Gradescope has laid it, and writes the results it looks for.

Whatever happens, the results are valid: where nothing could be graded they say why. What is printed
is for the instructor alone.
"""

import sys
import traceback
from pathlib import Path

import msgspec
from msgspec import Struct
from rich.console import Console

from grader.classroom.intake.found import CannotTake, Found
from grader.classroom.intake.packing import pack
from grader.judge.course import FULL, Course
from grader.judge.grade import KIT, Options, grade, shipped_reference
from grader.judge.isolation import Isolation
from grader.judge.submission import CannotGrade
from grader.judge.workplace import work_folder
from grader.report.files import write_whole
from grader.report.sinks.gradescope import gradescope
from grader.report.terminal import show, show_isolation
from grader.words import clean, told


class Settings(Struct, frozen=True):
    """How the instructor wants it, kept in the zip as settings.json."""

    isolation: Isolation = "auto"
    seed: int | None = None
    course: Course = FULL


def main(top: Path) -> int:
    """Grade `top`/submission into `top`/results; exit status 1 is a fault of the grader."""
    status = 0
    try:
        results = graded(top / "submission")
    except (CannotGrade, CannotTake) as error:
        print(f"cannot grade: {clean(str(error))}")
        results = ungraded(f"This could not be graded: {error}")
    except Exception:
        traceback.print_exc(file=sys.stdout)
        results, status = ungraded("The grader itself failed. Please tell your instructor."), 1
    write_whole(results, top / "results" / "results.json")
    return status


def graded(submission: Path) -> bytes:
    """Take it in as that of a class is, folders around it and all."""
    settings = msgspec.json.decode((KIT / "settings.json").read_bytes(), type=Settings)
    reference, course = shipped_reference(), settings.course
    options = Options(reference, settings.isolation, seed=settings.seed, course=course)
    package = pack(Found("submission", (submission,)))
    with work_folder() as work:
        result = grade(package.unpack(work), options)
    console = Console(highlight=False, markup=False, width=100)
    for note in package.notes:
        console.print(clean(note))
    show(result, console)
    show_isolation(result, console)
    return gradescope(told(result, course), course)


def ungraded(why: str) -> bytes:
    """No points, and the reason, in the form of Gradescope."""
    marks = {"score": 0, "output": clean(why), "output_format": "text"}
    return msgspec.json.encode(marks | {"stdout_visibility": "hidden", "tests": []})
