"""Write *Expected* and *Got* with enough digits to look different."""

from collections.abc import Callable
from typing import TypeVar

from grader.judge.lab import Lab
from grader.judge.numbers import without_minus_zero

FLOAT_DIGITS = 17  # what a float has
Answer = TypeVar("Answer")


def want_answer(
    lab: Lab,
    holds: bool,
    say: Callable[[Answer, int], str],
    right: Answer,
    got: Answer,
    digits: int = 3,
    expected: str = "{}",
    meaning: str = "",
) -> None:
    """Fail the check unless it `holds`, with an answer and the right one in words that differ.

    The text `expected` stands around the right one. Most checks pass, so words are made on demand.
    """
    if not holds:
        wanted, came = say_apart(say, right, got, digits)
        lab.want(False, expected.format(wanted), came, meaning)


def say_apart(
    say: Callable[[Answer, int], str], right: Answer, got: Answer, digits: int = 3
) -> tuple[str, str]:
    """Return both answers in words, with so many digits, or as many as it takes to differ."""
    both = without_minus_zero(say(right, digits)), without_minus_zero(say(got, digits))
    if both[0] == both[1] and digits < FLOAT_DIGITS:
        return say_apart(say, right, got, digits + 1)
    return both
