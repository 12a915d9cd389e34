"""Test that repeated runs give identical bits, in any order of adding bodies."""

import random

import pytest
from samples import sample
from worlds_for_tests import build, build_playground, state

from experiments.measures import run
from experiments.scenes import (
    BOUNCE,
    EFFECTS,
    chain,
    closed_box,
    pile,
    shuffled,
    stack,
)
from stable_engine import Body, Bounce, Box, Circle, Contacts, Friction, World

LOST_DIGITS = 1e-6  # px; sums in another order differ by rounding, which impacts magnify


@pytest.mark.parametrize(
    "make",
    [
        pytest.param(lambda: build(pile(40, 150)), marks=pytest.mark.soak),
        pytest.param(lambda: build(closed_box(3)), marks=pytest.mark.soak),
        lambda: build(chain(20, (20, 0))),
        lambda: build_playground(EFFECTS),
        lambda: build(pile(40, 150), *BOUNCE, "Sleep"),
    ],
    ids=["pile", "closed box", "chain", "playground", "sleepers"],
)
def test_the_same_run_twice_gives_identical_bits(make):
    first, second = make(), make()
    run(first, 2)
    run(second, 2)
    assert state(first) == state(second)


@pytest.mark.parametrize("seed", sample(range(3), 3))
@pytest.mark.parametrize("scene", [pile(40, 150), stack(1, 100)], ids=["pile", "stack"])
def test_the_order_of_adding_bodies_changes_no_bit(scene, seed):
    other, order = shuffled(scene, seed)
    straight, shuffled_world = build(scene), build(other)
    run(straight, 2)
    run(shuffled_world, 2)
    for i, body in zip(order, shuffled_world.bodies, strict=True):
        twin = straight.bodies[i]
        assert (body.x, body.y, body.w) == (twin.x, twin.y, twin.w)


def heap(seed, side=1, far=()):
    """Return the places of six balls that fell on each other, mirrored for side -1."""
    rng, surface = random.Random(seed), {"friction": 0.5, "restitution": 0.4}
    world = World(effects=[Contacts(), Friction(), Bounce()])
    world.add(Body(Box((300, 50)), (0, 50), **surface))
    places = [(side * rng.uniform(-30, 30), -40 - 30 * i) for i in range(6)]
    fallen = [world.add(Body(Circle(12), place, mass=1, **surface)) for place in places]
    for place in far:
        world.add(Body(Circle(12), place, mass=1, **surface))
    run(world, 1.5)
    return [place for ball in fallen for place in (side * ball.x, ball.y)]


@pytest.mark.parametrize("seed", sample(range(20), 10))
def test_a_mirrored_copy_of_a_heap_moves_alike(seed):
    assert heap(seed, -1) == pytest.approx(heap(seed), abs=LOST_DIGITS)


@pytest.mark.parametrize("seed", sample(range(20), 10))
def test_a_ball_far_off_changes_nothing(seed):
    assert heap(seed, far=[(5000, -40)]) == pytest.approx(heap(seed), abs=LOST_DIGITS)
