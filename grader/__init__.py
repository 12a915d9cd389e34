"""The judge of the physics-engine assignment: grades a submission without ever importing it.

For programs of your own:

    from grader import CannotGrade, Options, Result, grade, shipped_reference
    from grader import Course, WrongCourse, read_course

`grade(path, options)` returns a `Result`, and raises `CannotGrade` where there is nothing to grade.
It asks all that there is, unless `Options(course=read_course())` says otherwise.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from grader.judge.course import Course, WrongCourse, read_course
    from grader.judge.grade import Options, grade, shipped_reference
    from grader.judge.result import Result
    from grader.judge.submission import CannotGrade

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
    "Options": "grader.judge.grade",
    "Result": "grader.judge.result",
    "WrongCourse": "grader.judge.course",
    "grade": "grader.judge.grade",
    "read_course": "grader.judge.course",
    "shipped_reference": "grader.judge.grade",
}


def __getattr__(name: str) -> object:
    """Load the judge only when it is asked for: children of the worker import this package too."""
    if name not in MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(MODULES[name]), name)
