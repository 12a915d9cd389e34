"""Test that *Expected* and *Got* always differ, by digits that matter."""

from grader.checks.digits import say_apart


def in_digits(value: float, digits: int) -> str:
    return f"({value:.{digits}f}, 0.50) px/s"


def test_digits_are_added_until_the_numbers_differ():
    assert say_apart(in_digits, 0.6065, 0.60651) == (
        "(0.60650, 0.50) px/s",
        "(0.60651, 0.50) px/s",
    )


def test_a_minus_before_zero_tells_nothing():
    assert say_apart(in_digits, 0.0, -2e-5) == ("(0.00000, 0.50) px/s", "(-0.00002, 0.50) px/s")
