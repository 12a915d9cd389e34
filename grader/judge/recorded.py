"""Look up recorded answers: a student's copy of the checks has them instead of closed forms.

The code of some right answers would give away a TODO, and so would the code of known mistakes. A
release calls both with all possible inputs of the checks, and writes the answers to `recorded.json`
beside the copy of the checks. The kit itself has no such file.
"""

import json
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, TypeVar

import msgspec
from msgspec import Struct

from grader.judge.rubric import CHECKS

Answers = dict[str, Any]  # answers, by the `key` of their inputs
Function = TypeVar("Function", bound=Callable[..., Any])

oracles: dict[str, tuple[Sequence[float], ...]] = {}  # oracle -> the values of each argument


class RecordedMistake(Struct, frozen=True):
    """A known mistake and its answers; it is undecided about other questions."""

    todo: str
    id: str
    meaning: str
    about: str
    answers: Answers
    apart: bool = True


class RecordedKind(Struct, frozen=True):
    """A kind of question; see Kind."""

    right: Answers
    traits: Answers
    parts: dict[str, list[int]]
    apart: bool


class RecordedAnswers(Struct, frozen=True):
    oracles: dict[str, Answers] = {}
    kinds: dict[str, RecordedKind] = {}
    mistakes: list[RecordedMistake] = []


def oracle(*values: Sequence[float]) -> Callable[[Function], Function]:
    """Mark a function whose answers students get, but not its code.

    `values` lists the values of each argument. Without it, the answers that the checks ask of the
    solution are recorded, and checks with random inputs are hidden from students.
    """

    def mark(function: Function) -> Function:
        oracles[function.__name__] = values
        return function

    return mark


def key(inputs: Any) -> str:
    """Return the same text for equal numbers, int or float, in a tuple or in a list.

    Twelve digits count, since sine and cosine differ in the last one on other machines.
    """
    return json.dumps(plain(inputs))


def plain(value: Any) -> Any:
    if isinstance(value, tuple | list):
        return [plain(each) for each in value]
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(f"{value:.12g}") + 0.0  # no -0.0
    return value


@cache
def load_recorded() -> RecordedAnswers | None:
    """Return the recorded answers of this copy of the checks; None in the kit."""
    path = CHECKS / "recorded.json"
    return (
        msgspec.convert(json.loads(path.read_bytes()), RecordedAnswers) if path.exists() else None
    )


def answer(name: str, *inputs: Any) -> Any:
    """Return an oracle's recorded answer; a student's copy calls this instead of the oracle."""
    table = load_recorded()
    answers = table.oracles.get(name, {}) if table else {}
    if key(inputs) not in answers:
        raise LookupError(f"this copy of the checks has no recorded answer of {name} to {inputs}")
    return answers[key(inputs)]
