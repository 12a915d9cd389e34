"""Write *Expected* and *Got* with enough digits to look different."""

from collections.abc import Callable
from typing import TypeVar

from grader.judge.lab import Lab
from grader.judge.numbers import without_minus_zero

FLOAT_DIGITS = 17  # what a float has
Answer = TypeVar("Answer")


def want_told(
    lab: Lab,
    holds: bool,
    say: Callable[[Answer, int], str],
    right: Answer,
    got: Answer,
    digits: int = 3,
    expected: str = "{}",
    meaning: str = "",
) -> None:
    """Fail the check unless it `holds`, with both told apart; `expected` is said around the right.

    Most checks pass, so words are made where they are needed only.
    """
    if not holds:
        told = told_apart(say, right, got, digits)
        lab.want(False, expected.format(told[0]), told[1], meaning)


def told_apart(
    say: Callable[[Answer, int], str], right: Answer, got: Answer, digits: int = 3
) -> tuple[str, str]:
    """Return what was expected and what came, with so many digits, or as many as it takes to
    differ.
    """
    told = without_minus_zero(say(right, digits)), without_minus_zero(say(got, digits))
    if told[0] == told[1] and digits < FLOAT_DIGITS:
        return told_apart(say, right, got, digits + 1)
    return told
