"""Grade one submission in any form; the function that other programs call."""

from collections.abc import Callable
from pathlib import Path

from grader.intake.packing import open_submission
from grader.judge import grade as judge
from grader.judge.result import Result
from grader.judge.task import DEFAULT_OPTIONS, Options
from grader.judge.wall.children import Worker


def grade(
    path: Path | str,
    options: Options = DEFAULT_OPTIONS,
    worker: Worker | None = None,
    say: Callable[[str], None] = lambda note: None,
) -> Result:
    """Grade the submission at `path`: a folder, an archive or a Python file.

    A full grade takes seconds; the same submission and options always give the same marks. It also
    grades a program that cannot be imported or does not end, with the reason. Raises CannotGrade,
    with a sentence that says what to do, if it needs manual review or an option cannot be met.

    `say` gets notes on the files, such as a changed name. A `worker` from `start_worker` serves
    several grades and stays open.
    """
    with open_submission(Path(path), say, options.course.modules) as folder:
        return judge.grade(folder, options, worker)
