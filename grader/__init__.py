"""The judge of the physics-engine assignment: grades a submission without ever importing it.

For programs of your own:

    from grader import CannotGrade, Options, Result, grade, shipped_reference

`grade(path, options)` returns a `Result`, and raises `CannotGrade` where there is nothing to grade.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from grader.judge.grade import Options, grade, shipped_reference
    from grader.judge.result import Result
    from grader.judge.submission import CannotGrade

__version__ = "0.1.0"
__all__ = ["CannotGrade", "Options", "Result", "__version__", "grade", "shipped_reference"]

MODULES = {
    "CannotGrade": "grader.judge.submission",
    "Options": "grader.judge.grade",
    "Result": "grader.judge.result",
    "grade": "grader.judge.grade",
    "shipped_reference": "grader.judge.grade",
}


def __getattr__(name: str) -> object:
    """Load the judge only when it is asked for: children of the worker import this package too."""
    if name not in MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(MODULES[name]), name)
