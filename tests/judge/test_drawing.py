"""Hypothesis draws the recorded examples, and still has the private names that we use.

A failure after an upgrade means that properties are tried on other examples, so that marks may
change: see what hypothesis changed, adapt `grader/judge/drawing.py`, and run `make verify`.
"""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.internal.conjecture import providers

from grader.judge.drawing import EXAMPLES, JUDGE_SETTINGS, NO_CONSTANTS, kept_examples, seeded

RECORDED = [  # the first of 25
    (0, 0.0),
    (-5, 0.0),
    (-5, -0.062757042),
    (320, -7.474856849),
    (-878, 6.757686256),
    (734, -9.661609368),
    (446, 6.589854925),
    (872, 0.0),
    (465, 7.52425202),
    (555, -0.065812652),
    (-12, 1.9),
    (-429, -5.61916789),
]


@given(n=st.integers(-1000, 1000), x=st.floats(-10.0, 10.0))
def a_property(lab, n: int, x: float) -> None:
    lab.append((n, x))


@settings(max_examples=3, database=None)
@given(n=st.integers())
def one_with_settings(lab, n: int) -> None:
    lab.append(n)


def drawn(function, seed: int | None = 1) -> list:
    found: list = []
    with seeded(function, seed):
        function(lab=found)
    return found


def test_the_examples_are_those_that_were_recorded():
    found = drawn(a_property)
    assert len(found) == EXAMPLES
    assert [(n, round(x, 9)) for n, x in found[: len(RECORDED)]] == RECORDED


def test_constants_of_modules_would_come_in_by_the_name_that_is_shut(
    monkeypatch: pytest.MonkeyPatch,
):
    def count_of(number: int) -> int:
        providers.CONSTANTS_CACHE.cache.clear()
        return sum(n == number for seed in range(20) for n, _ in drawn(a_property, seed))

    usual = count_of(777)
    constants = type(NO_CONSTANTS)()
    constants.add(777)
    monkeypatch.setattr(providers, "_get_local_constants", lambda: constants)
    assert count_of(777) > usual + 5
    monkeypatch.undo()
    assert count_of(777) == usual


def test_the_judges_settings_hold_where_a_property_has_none_of_its_own():
    """The names that decide this are set by hypothesis' own decorators."""
    assert hasattr(one_with_settings, "_hypothesis_internal_settings_applied")
    assert not hasattr(a_property, "_hypothesis_internal_settings_applied")
    with seeded(a_property, None):
        assert a_property._hypothesis_internal_use_settings is JUDGE_SETTINGS
    assert len(drawn(one_with_settings)) == 3


def test_examples_are_kept_as_they_come_and_can_be_asked_again():
    inner = a_property.hypothesis.inner_test
    with kept_examples(a_property) as examples:
        assert a_property.hypothesis.inner_test is not inner
        found = drawn(a_property)
    assert a_property.hypothesis.inner_test is inner
    again: list = []
    for example in examples:
        example(lab=again)
    assert again == found == drawn(a_property)


def test_what_is_no_property_has_no_examples():
    with kept_examples(lambda lab: None) as examples:
        pass
    assert examples == []
