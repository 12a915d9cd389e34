"""Test the bonus tasks' physics: springs against pymunk's and at their limit, sleepers, the
grid."""

import cmath
import math
import random

import pymunk
import pytest
from pygame import Vector2

import mini_engine
from mini_engine import STEP, Body, BonusWorld, Box, Circle, SpringJoint

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


def test_a_spring_swings_beside_pymunks_damped_spring():
    """Each may differ from the closed form by about rate · STEP, in position or time."""
    space = pymunk.Space()
    bob = pymunk.Body(2, 100)
    bob.position = LONG + 30, 0
    space.add(bob, pymunk.DampedSpring(space.static_body, bob, (0, 0), (0, 0), LONG, 800, 4))
    theirs = []
    for _ in range(120):
        space.step(STEP)
        theirs.append(bob.position.x - LONG)
    ours = swing(800, 4, 2, 120)
    assert max(abs(a - b) for a, b in zip(ours, theirs, strict=True)) < 30 * 20 * STEP
    rate, fading = math.sqrt(800 / 2), 4 / (2 * 2)
    for number, each in enumerate(ours, 1):
        time = number * STEP
        exact = 30 * math.exp(-fading * time) * math.cos(math.sqrt(rate**2 - fading**2) * time)
        assert abs(each - exact) < 30 * rate * STEP


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


def test_a_sleeper_keeps_its_place_to_the_last_bit_and_wakes_for_a_ball_that_rolls_in():
    world = BonusWorld(linear_damping=0, angular_damping=0)
    world.sleeping = world.grid = True
    world.add(Body(Box((1000, 50)), (0, 50)))
    first, *others = (world.add(Body(Circle(10), (40 * n, -9.75), 1, 0)) for n in range(3))
    for _ in range(120):
        world.step(STEP)
    assert first.asleep and all(body.asleep for body in others)
    places = [Vector2(body.pos) for body in others]
    rolling = world.add(Body(Circle(10), (-60, -9.75), 1, 0))
    rolling.vel, rolling.omega = Vector2(100, 0), 10
    for _ in range(55):  # 40 px to the first, but not 20 px more to the next
        world.step(STEP)
    assert not first.asleep and [body.pos for body in others] == places


def test_the_grid_finds_the_pairs_that_touch_and_few_others():
    rng = random.Random(3)
    bodies = [
        Body(Circle(10), (rng.uniform(-450, 450), rng.uniform(-300, 300)), 1) for _ in range(200)
    ]
    pairs = mini_engine.near_pairs(bodies)
    assert len(set(pairs)) == len(pairs) < 199 * 200 / 2 / 10
    touching = {
        (a, b)
        for i, a in enumerate(bodies)
        for b in bodies[i + 1 :]
        if (a.pos - b.pos).length() < 20
    }
    assert touching and touching <= set(pairs)
