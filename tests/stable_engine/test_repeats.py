"""Test that repeated runs give identical bits, in any order of adding bodies."""

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
