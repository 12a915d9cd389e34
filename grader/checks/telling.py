"""Write *Expected* and *Got* with enough digits to look different."""

import math
from collections.abc import Callable, Iterable
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


def decimals_to_tell(wanted: Iterable[float], got: Iterable[float], least: int) -> int:
    """Return how many decimals make *Expected* and *Got* look different: `least`, or up to 15."""
    off = max((abs(a - b) for a, b in zip(wanted, got, strict=True)), default=1.0)
    return min(15, max(least, math.ceil(-math.log10(off)))) if 0 < off < math.inf else least
