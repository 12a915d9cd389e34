"""The judge of the physics-engine assignment: grades a submission without ever importing it.

For programs of your own:

    from grader import CannotGrade, Options, Result, grade, shipped_reference
    from grader import Course, WrongCourse, read_course

`grade(path, options)` takes a folder, an archive or a Python file. It returns a `Result`, and
raises `CannotGrade`, with the reason, for a submission that needs manual review. It grades all
TODOs, unless `Options(course=read_course())` names fewer.
"""

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from grader.intake.single import grade
    from grader.judge.course import Course, WrongCourse, read_course
    from grader.judge.result import Result
    from grader.judge.submission import CannotGrade
    from grader.judge.task import Options, shipped_reference

__version__ = "0.1.0"
__all__ = [
    "CannotGrade",
    "Course",
    "Options",
    "Result",
    "WrongCourse",
    "__version__",
    "grade",
    "read_course",
    "shipped_reference",
]

MODULES = {
    "CannotGrade": "grader.judge.submission",
    "Course": "grader.judge.course",
    "Options": "grader.judge.task",
    "Result": "grader.judge.result",
    "WrongCourse": "grader.judge.course",
    "grade": "grader.intake.single",
    "read_course": "grader.judge.course",
    "shipped_reference": "grader.judge.task",
}


def __getattr__(name: str) -> object:
    """Load the judge when it is first needed: children of the worker import this package too."""
    if name not in MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = MODULES[name]
    if name == "grade" and find_spec("grader.intake") is None:  # in a student's copy
        module = "grader.judge.grade"
    return getattr(import_module(module), name)
