"""Grade one submission in Gradescope's container, and write its results.

The results are always valid. If nothing could be graded they have no score, not even 0, but the
reason. Only the instructor sees the printed lines.
"""

import sys
import traceback
from functools import partial
from pathlib import Path

import msgspec
from msgspec import Struct
from rich.console import Console

from grader.errors import Stop
from grader.intake.found import CannotTake, Work
from grader.intake.packing import pack
from grader.judge.course import FULL, Course
from grader.judge.grade import grade
from grader.judge.submission import CannotGrade
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.wall.isolation import Isolation
from grader.judge.wall.outer import WHOLE, call_within
from grader.judge.wall.workplace import work_folder
from grader.judge.wording import withhold_reasons
from grader.report.files import write_whole
from grader.report.sinks.gradescope import SHOWN, write_gradescope
from grader.report.terminal import Printer, show_isolation
from grader.text import clean

NO_MARK = "This is no mark, and not 0 points."
AGAIN = "Correct that and hand in again, or ask your instructor to look at it."
BY_HAND = (
    "No score was sent to Gradescope. Review the submission, and enter its points there by hand; "
    "until then, the score that Gradescope shows for it is not a mark."
)


class Settings(Struct, frozen=True):
    """The instructor's choices, kept in the zip as settings.json."""

    isolation: Isolation = "auto"
    seed: int | None = None
    course: Course = FULL


def main(top: Path) -> int:
    """Grade `top`/submission into `top`/results; exit status 1 is a fault of the grader."""
    place, status = top / "results" / "results.json", 0
    try:
        work = partial(grade_submission, top / "submission")
        write_whole(call_within(WHOLE, bytes, work, (CannotTake, CannotGrade, Stop)), place)
        return status
    except Stop as error:
        print(f"cannot grade: {clean(str(error))}")
        results = explain(f"This could not be graded: {error}.", AGAIN)
    except Exception:
        traceback.print_exc(file=sys.stdout)
        results, status = explain("The grader itself failed.", "Please tell your instructor."), 1
    print(BY_HAND)
    write_whole(results, place)
    return status


def grade_submission(submission: Path) -> bytes:
    """Read a submission like one of a class, and grade it."""
    settings = msgspec.json.decode((KIT / "settings.json").read_bytes(), type=Settings)
    reference, course = shipped_reference(), settings.course
    options = Options(reference, settings.isolation, seed=settings.seed, course=course)
    package = pack(Work("submission", (submission.resolve(),)), course.modules)
    with work_folder() as work:
        result = grade(package.unpack(work), options)
    console = Console(highlight=False, markup=False, width=100)
    for note in package.notes:
        console.print(clean(note))
    Printer(console).print(result)
    show_isolation(result, console)
    return write_gradescope(withhold_reasons(result, course), course)


def explain(why: str, next_step: str) -> bytes:
    """Return results with the reason and no score, in a test worth 0 points."""
    reason = f"{clean(why)} {NO_MARK} {next_step}"
    test = {"name": "Not graded", "status": "failed", "output": reason, **SHOWN}
    whole = {"output": reason, **SHOWN, "stdout_visibility": "hidden", "tests": [test]}
    return msgspec.json.encode(whole)
