"""The integrator shoot-out: the lesson's table to the digit, and the order of each method."""

import math

import pytest
from programs import INTEGRATORS, SOLUTION, run_in

from integrators import (
    DT,
    OMEGA,
    SECONDS,
    X0,
    energy,
    explicit_euler,
    rk4,
    semi_implicit_euler,
    simulate,
    spring,
    velocity_verlet,
)

TABLE = """\
method               x after 10 s   error (px)  energy change
explicit_euler           39151.23    39051.231   39200205.62%
semi_implicit_euler         98.12        1.878         -2.38%
velocity_verlet             99.33        0.665         -0.01%
rk4                         99.98        0.018         -0.03%
"""


def test_the_program_prints_the_lessons_table():
    assert run_in(SOLUTION, *INTEGRATORS) == TABLE


def test_the_spring_is_the_lessons():
    assert 2 * math.pi == OMEGA
    assert X0 == 100 and DT == 1 / 30 and SECONDS == 10
    assert spring(3) == pytest.approx(-3 * (2 * math.pi) ** 2)
    assert energy(3, 4) == pytest.approx((4**2 + (2 * math.pi * 3) ** 2) / 2)


@pytest.mark.parametrize(
    ("method", "x", "error", "change"),
    [
        (explicit_euler, 39151.23, 39051.231, 39200205.62),
        (semi_implicit_euler, 98.12, 1.878, -2.38),
        (velocity_verlet, 99.33, 0.665, -0.01),
        (rk4, 99.98, 0.018, -0.03),
    ],
)
def test_a_method_ends_where_the_lesson_says(method, x, error, change):
    end, speed = simulate(method, 1 / 30, 10)
    assert round(end, 2) == x
    assert round(abs(end - 100), 3) == error
    assert round(100 * (energy(end, speed) / energy(100, 0) - 1), 2) == change


@pytest.mark.parametrize(
    ("method", "x", "v"),
    [
        (explicit_euler, 10 + 3 * 0.5, 3 + 4 * 0.5),
        (semi_implicit_euler, 10 + 5 * 0.5, 3 + 4 * 0.5),
        (velocity_verlet, 10 + 3 * 0.5 + 4 * 0.5**2 / 2, 3 + 4 * 0.5),
        (rk4, 10 + 3 * 0.5 + 4 * 0.5**2 / 2, 3 + 4 * 0.5),
    ],
)
def test_one_step_under_a_constant_acceleration(method, x, v):
    assert method(10, 3, 0.5, lambda _: 4) == pytest.approx((x, v))


@pytest.mark.parametrize(
    ("method", "samples"),
    [(explicit_euler, 1), (semi_implicit_euler, 1), (velocity_verlet, 2), (rk4, 4)],
)
def test_a_step_asks_for_so_many_accelerations(method, samples):
    asked = []
    method(10, 3, 0.5, lambda x: asked.append(x) or 0.0)
    assert len(asked) == samples


def off_phase_error(method, steps_per_second):
    """Distance from the exact (x, v / OMEGA) after 9.75 s, in px.

    Not after whole periods: there v is 0, and x alone would make the orders look too high.
    """
    x, v = simulate(method, 1 / steps_per_second, 9.75)
    return math.hypot(x - 0, v / OMEGA - X0)


@pytest.mark.parametrize(
    ("method", "steps_per_second", "order"),
    [
        (explicit_euler, 16000, 1),
        (semi_implicit_euler, 400, 1),
        (velocity_verlet, 400, 2),
        (rk4, 200, 4),
    ],
)
def test_half_the_step_divides_the_error_by_two_to_the_order(method, steps_per_second, order):
    coarse = off_phase_error(method, steps_per_second)
    fine = off_phase_error(method, 2 * steps_per_second)
    assert math.log2(coarse / fine) == pytest.approx(order, abs=0.1)


def test_semi_implicit_euler_keeps_an_energy_of_its_own():
    x, v = X0, 0.0
    for _ in range(100 * 30):
        x, v = semi_implicit_euler(x, v, DT, spring)
        kept = energy(x, v) - 0.5 * OMEGA**2 * DT * x * v
        assert kept == pytest.approx(energy(X0, 0.0), rel=1e-9)
