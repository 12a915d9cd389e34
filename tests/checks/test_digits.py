"""Test that *Expected* and *Got* always differ, by digits that matter."""

from grader.checks.digits import A_AND_B, say, say_apart

SPEED = "({:.{n}f}, 0.50) px/s"


def test_digits_are_added_until_the_numbers_differ():
    assert say_apart(SPEED, 0.6065, 0.60651) == ("(0.60650, 0.50) px/s", "(0.60651, 0.50) px/s")


def test_a_minus_before_zero_tells_nothing():
    assert say_apart(SPEED, 0.0, -2e-5) == ("(0.00000, 0.50) px/s", "(-0.00002, 0.50) px/s")


def test_pairs_of_numbers_fill_one_sentence_and_a_missing_answer_is_none():
    assert say(A_AND_B, ((1.0, -0.0), [2.0, 3.0]), 1) == "A (1.0, 0.0), B (2.0, 3.0) px/s"
    assert say(A_AND_B, None, 1) == "None"
