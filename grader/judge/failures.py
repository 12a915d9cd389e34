"""Define the exceptions by which a check fails, with the words of its result."""

from collections.abc import Callable
from dataclasses import dataclass

from grader.judge.rubric import Check, Todo
from grader.protocol import Piece, Raised

REMEMBERS = (
    "In a program that has just started, this gives another answer: it depends on earlier calls, "
    "or on chance. It must depend on the arguments of this call alone."
)
TRESPASS = "{name} must change only what its docstring names."
ENDLESS = "it used up its"  # the first words about a check that ran out of processor time
MOST_NAMES = 3  # in one sentence
KEPT = (
    "A value is kept from call to call in {names}: an answer that depends on it may change each "
    "time."
)


class NotYet(Exception):
    """The submission gave a wrong answer."""

    def __init__(self, ran: str, expected: str, got: str, meaning: str = "") -> None:
        super().__init__(got)
        self.ran, self.expected, self.got, self.meaning = ran, expected, got, meaning


class Broke(Exception):
    """The submission's own code raised, or its process ended without an answer."""

    def __init__(
        self, ran: str, got: str, raised: Raised | None = None, late: bool = False
    ) -> None:
        super().__init__(got)
        self.ran, self.got, self.raised = ran, got, raised
        self.late = late  # whether its time was over; then `got` has no words of the submission


@dataclass(frozen=True)
class Failing:
    """A failed check, with all that is needed to run it again."""

    todo: Todo
    check: Check
    again: Callable[..., None]  # runs the failed example in a lab
    pieces: list[Piece]  # of the reference
    secret: str | None = None  # see secret_of


def secret_of(seed: int | None, todo: Todo, check: Check) -> str | None:
    """Return the text from which a check's numbers are made; None for the usual numbers."""
    return None if seed is None else f"{seed} {todo.id} {check.id}"
