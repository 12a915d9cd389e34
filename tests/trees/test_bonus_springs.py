"""Test springs of the bonus tasks at the rate where they explode."""

import cmath
import math

import pytest

from mini_engine import STEP, Body, BonusWorld, Circle, SpringJoint

LONG = 1e5  # px


def swing(stiffness: float, damping: float, mass: float, steps: int) -> list[float]:
    """Return the distance of a mass on a spring from rest (px) by step, 30 px at first.

    The spring is long enough to keep its direction.
    """
    world = BonusWorld(gravity=(0, 0), linear_damping=0, angular_damping=0)
    hook = world.add(Body(Circle(5), (0, 0)))
    bob = world.add(Body(Circle(10), (LONG + 30, 0), mass))
    world.springs.append(SpringJoint(hook, bob, stiffness, damping, LONG))
    found = []
    for _ in range(steps):
        world.step(STEP)
        found.append(bob.pos.x - LONG)
    return found


@pytest.mark.parametrize("rate", [0.2, 1.98, 2.02])
def test_an_undamped_spring_explodes_where_its_rate_times_the_step_passes_2(rate: float):
    """x becomes (2 - rate²) x less the x before: cos((n + 1/2) a), with rate = 2 sin(a / 2)."""
    places = swing((rate / STEP) ** 2, 0, 1, 24)
    angle = 2 * cmath.asin(rate / 2)
    for number, place in enumerate(places, 1):
        right = 30 * (cmath.cos((number + 0.5) * angle) / cmath.cos(angle / 2)).real
        assert math.isclose(place, right, rel_tol=1e-6, abs_tol=1e-6)
    furthest = max(map(abs, places))
    if rate < 2:
        assert furthest <= 30 / math.sqrt(1 - rate**2 / 4) * (1 + 1e-6)
    else:
        assert furthest > 100 * 30
