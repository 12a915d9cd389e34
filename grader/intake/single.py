"""Grade one submission in any form, as one of a class: what other programs call."""

from collections.abc import Callable
from pathlib import Path

from grader.intake.packing import open_submission
from grader.judge import grade as judge
from grader.judge.children import Worker
from grader.judge.grade import DEFAULT_OPTIONS, Options
from grader.judge.result import Result


def grade(
    path: Path | str,
    options: Options = DEFAULT_OPTIONS,
    worker: Worker | None = None,
    say: Callable[[str], None] = lambda note: None,
) -> Result:
    """Grade the submission at `path`: a folder, an archive or a Python file.

    A full grade takes seconds; the same submission and options always give the same marks. What
    cannot be imported or does not end is graded, with the reason. Raises CannotGrade, with a
    sentence that says what to do, where a person must look or the options cannot be kept.

    `say` gets notes on the files, such as a name that was mended. A `worker` that is handed in,
    from `start_worker`, serves more than one grade and stays open.
    """
    with open_submission(Path(path), say, options.course.modules) as folder:
        return judge.grade(folder, options, worker)
