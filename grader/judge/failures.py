"""Define how a check fails: the exceptions that carry the words of its result."""

from collections.abc import Callable
from dataclasses import dataclass

from grader.judge.rubric import Check, Todo
from grader.protocol import Piece, Raised

REMEMBERS = (
    "Asked alone, by a program that has just started, this comes out otherwise: it hangs on "
    "earlier calls, or on chance. The answer must follow from what is given to this call alone."
)
TRESPASS = "{name} must leave everything as it is but what its docstring names."
ENDLESS = "it used up its"  # how the words of a check begin that ran out of processor time
MOST_NAMES = 3  # in one sentence
KEPT = (
    "Something is kept from call to call in {names}: an answer that hangs on it is another one "
    "each time."
)


class NotYet(Exception):
    """The submission gave an answer, and it is not the right one."""

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
        self.late = late  # it had no time left, which is all that `got` says


@dataclass(frozen=True)
class Failing:
    """A failed check: what ran last, and the pieces of the reference that stood in."""

    todo: Todo
    check: Check
    again: Callable[..., None]  # takes a lab
    pieces: list[Piece]
    secret: str | None = None  # see secret_of


def secret_of(seed: int | None, todo: Todo, check: Check) -> str | None:
    """Return what the numbers of a check are drawn by; None where they are the usual ones."""
    return None if seed is None else f"{seed} {todo.id} {check.id}"
