"""Write *Expected* and *Got* with enough digits to look different."""

from collections.abc import Callable
from typing import TypeVar

from grader.judge.lab import Lab
from grader.judge.numbers import without_minus_zero

FLOAT_DIGITS = 17  # digits of a float
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
    """Fail the check unless it `holds`; print the answer and the right one with enough digits.

    `expected` is a template for the right answer. Most checks pass, so the words are made on
    demand.
    """
    if not holds:
        wanted, came = say_apart(say, right, got, digits)
        lab.want(False, expected.format(wanted), came, meaning)


def say_apart(
    say: Callable[[Answer, int], str], right: Answer, got: Answer, digits: int = 3
) -> tuple[str, str]:
    """Return both answers in words, with `digits` digits or as many as they need to differ."""
    both = without_minus_zero(say(right, digits)), without_minus_zero(say(got, digits))
    if both[0] == both[1] and digits < FLOAT_DIGITS:
        return say_apart(say, right, got, digits + 1)
    return both
