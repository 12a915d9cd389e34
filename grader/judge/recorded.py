"""Look up recorded answers, which a student's copy of the checks has instead of closed forms.

Some right answers are worked out by code that is as good as the code of a TODO, and so are the
known mistakes. A release asks both what the checks can ask, and writes the answers to
`recorded.json` beside the copy of the checks. The kit itself has no such file.
"""

import json
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, TypeVar

import msgspec
from msgspec import Struct

from grader.judge.rubric import CHECKS

Answers = dict[str, Any]  # by the `key` of what was asked
Function = TypeVar("Function", bound=Callable[..., Any])

oracles: dict[str, tuple[Sequence[float], ...]] = {}  # name -> all that may be asked, or nothing


class RecordedMistake(Struct, frozen=True):
    """A known mistake, and what it answers; what is missing it leaves undecided."""

    todo: str
    id: str
    meaning: str
    about: str
    answers: Answers
    apart: bool = True


class Recorded(Struct, frozen=True):
    oracles: dict[str, Answers] = {}
    right: dict[str, Answers] = {}  # the right answers to observations, by what they are about
    traits: dict[str, Answers] = {}  # what these are like
    parts: dict[str, dict[str, list[int]]] = {}  # of an answer
    separate: list[str] = []  # what has a mistake in one part alone
    mistakes: list[RecordedMistake] = []


def oracle(*values: Sequence[float]) -> Callable[[Function], Function]:
    """Mark a function that students get the answers of and not the code.

    Without `values` its answers are those that the checks ask of it on the solution. A check that
    asks at random is hidden from students, unless `values` say what each argument may be.
    """

    def mark(function: Function) -> Function:
        oracles[function.__name__] = values
        return function

    return mark


def key(inputs: Any) -> str:
    """Return the same text for the same numbers, be they int or float, in a tuple or in a list.

    Numbers are the same to twelve digits: sine and cosine differ in the last one on other machines.
    """
    return json.dumps(plain(inputs))


def plain(value: Any) -> Any:
    if isinstance(value, tuple | list):
        return [plain(each) for each in value]
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(f"{value:.12g}") + 0.0  # no -0.0
    return value


@cache
def load_recorded() -> Recorded | None:
    """Return the table of this copy of the checks; None in the kit."""
    path = CHECKS / "recorded.json"
    return msgspec.convert(json.loads(path.read_bytes()), Recorded) if path.exists() else None


def answer(name: str, *inputs: Any) -> Any:
    """Return what the oracle of this name says; a student's copy calls it in the oracle's place."""
    table = load_recorded()
    answers = table.oracles.get(name, {}) if table else {}
    if key(inputs) not in answers:
        raise LookupError(f"this copy of the checks has no recorded answer of {name} to {inputs}")
    return answers[key(inputs)]
