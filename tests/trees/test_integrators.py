"""Test the integrators: the lesson's table to the digit, and the order of each method."""

import math

import pytest

from integrators import (
    DT,
    OMEGA,
    SECONDS,
    X0,
    energy,
    explicit_euler,
    rk4,
    semi_implicit_euler,
    spring,
    velocity_verlet,
)


def test_the_spring_is_the_lessons():
    assert 2 * math.pi == OMEGA
    assert X0 == 100 and DT == 1 / 30 and SECONDS == 10
    assert spring(3) == pytest.approx(-3 * (2 * math.pi) ** 2)
    assert energy(3, 4) == pytest.approx((4**2 + (2 * math.pi * 3) ** 2) / 2)


@pytest.mark.parametrize(
    ("method", "samples"),
    [(explicit_euler, 1), (semi_implicit_euler, 1), (velocity_verlet, 2), (rk4, 4)],
)
def test_a_step_asks_for_so_many_accelerations(method, samples):
    asked = []
    method(10, 3, 0.5, lambda x: asked.append(x) or 0.0)
    assert len(asked) == samples
