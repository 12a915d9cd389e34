"""Write *Expected* and *Got* with enough digits to look different."""

from collections.abc import Iterator
from typing import Any

from grader.judge.lab import Lab
from grader.judge.numbers import without_minus_zero

FLOAT_DIGITS = 17  # digits of a float
A_AND_B = "A ({:.{n}f}, {:.{n}f}), B ({:.{n}f}, {:.{n}f}) px/s"  # two velocities


def want_answer(
    lab: Lab,
    holds: bool,
    words: str,
    right: Any,
    got: Any,
    digits: int = 3,
    expected: str = "{}",
    meaning: str = "",
) -> None:
    """Fail the check unless it `holds`; print the answer and the right one with enough digits.

    `words` is a template of an answer, with a field such as `{:.{n}f}` per number; `expected` is
    text around the right one.
    """
    if not holds:
        wanted, came = say_apart(words, right, got, digits)
        lab.want(False, expected.format(wanted), came, meaning)


def say_apart(words: str, right: Any, got: Any, digits: int = 3) -> tuple[str, str]:
    """Return both answers in words, with `digits` digits or as many as they need to differ."""
    both = say(words, right, digits), say(words, got, digits)
    if both[0] == both[1] and digits < FLOAT_DIGITS:
        return say_apart(words, right, got, digits + 1)
    return both


def say(words: str, answer: Any, digits: int) -> str:
    """Return an answer in words: a number, pairs of numbers, or None."""
    if answer is None:
        return "None"
    return without_minus_zero(words.format(*list_numbers(answer), n=digits))


def list_numbers(answer: Any) -> Iterator[float]:
    """Yield the numbers of an answer in order."""
    if isinstance(answer, tuple | list):
        for each in answer:
            yield from list_numbers(each)
    else:
        yield answer
