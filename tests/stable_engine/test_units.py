"""Test the same scene in other units of length, and the speeds at which bodies sleep."""

from itertools import pairwise

import pytest

from experiments.measures import watch
from experiments.scenes import DT, G
from stable_engine import (
    Body,
    Bounce,
    Box,
    Bullets,
    Circle,
    Contacts,
    Friction,
    Rod,
    Rods,
    Sleep,
    Spring,
    Springs,
    World,
)


def scene(length, names):
    """Make falling balls, a pendulum and a spring above a floor, with lengths in `length` per
    px."""
    effects = [Contacts(), Friction(), Bounce(), Rods(), Springs(), Bullets()]
    world = World((0, G * length), 4, [*effects, *names], unit=length)

    def ball(x, y, vx=0.0, bullet=False):
        shape = Circle(10 * length)
        body = Body(shape, (x * length, y * length), 1.0, 0.6, 0.4, bullet=bullet)
        body.vel = (vx * length, 0)
        return world.add(body)

    world.add(Body(Box((400 * length, 20 * length)), (0, 20 * length), 0, 0.6, 0.4))
    ball(-300, -150, 60), ball(-200, -80, -20), ball(-100, -10.5), ball(0, -200, bullet=True)
    peg = world.add(Body(Circle(5 * length), (150 * length, -200 * length)))
    world.add(Rod(peg, ball(220, -200)))
    world.add(Spring(peg, ball(150, -120), 40.0, 0.5, 60 * length))
    return world


@pytest.mark.parametrize("length", [0.01, 1 / 64, 1000.0])
@pytest.mark.parametrize("names", [(), (Sleep,)])
def test_a_scene_in_another_unit_moves_the_same(length, names):
    pixels, other = (scene(one, [name() for name in names]) for one in (1.0, length))
    for _ in range(360):
        pixels.step(DT)
        other.step(DT)
        for a, b in zip(pixels.bodies, other.bodies, strict=True):
            assert (b.x / length, b.y / length) == pytest.approx((a.x, a.y), abs=1e-7, rel=1e-9)
            assert a.asleep == b.asleep


@pytest.mark.parametrize("length", [1 / 128, 16.0])
@pytest.mark.parametrize("speed", [200.0, 2000.0])
def test_powers_of_two_change_no_bit(length, speed):
    """In such units every number has the same digits, so nothing may depend on the unit."""

    def thrown(unit):
        world = World((0, G * unit), 4, [Contacts(), Friction(), Bounce(), Rods()], unit=unit)
        world.add(Body(Box((400 * unit, 20 * unit)), (0, 120 * unit), 0, 0.6, 0.4))
        spots = [(25 * i * unit, -10 * i * i * unit) for i in range(6)]
        row = [world.add(Body(Circle(6 * unit), spot, 1.0, 0.6, 0.4)) for spot in spots]
        for i, ball in enumerate(row):
            ball.vel = (speed * unit * (-1) ** i, speed * unit / (i + 1))
        for a, b in pairwise(row):
            world.add(Rod(a, b))
        return world

    pixels, other = thrown(1.0), thrown(length)
    for _ in range(240):
        pixels.step(DT)
        other.step(DT)
        for a, b in zip(pixels.bodies, other.bodies, strict=True):
            assert (b.x / length, b.y / length, b.w) == (a.x, a.y, a.w)


# ---------------------------------------------------------------- sleep


def sleepy_world(gravity, *effects, unit=1.0):
    return World(gravity, 4, [Contacts(), Friction(), Sleep(), *effects], unit=unit)


def test_balls_that_hold_each_other_do_not_hang_in_the_air():
    world = sleepy_world((0, 1.0), Rods())
    a, b = (world.add(Body(Circle(10), (x, 0), 1.0)) for x in (0, 50))
    world.add(Rod(a, b))
    assert all(watch(world, 2, lambda: bool(world.awake)))
    assert a.y == pytest.approx(2, rel=0.01)
