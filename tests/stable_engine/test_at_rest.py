"""Test that piles come to rest and sleep; rows of the leaderboard limit their speed."""

import math

import pytest
from samples import sample
from worlds_for_tests import build

from experiments.measures import run
from experiments.scenes import BOUNCE, TOUCH, Ball, Scene, pile, slot


def neat(rows, columns, packed=True):
    """Make equal balls in rows, each between two of the row below it or right above one."""
    radius, rise = 10.0, math.sqrt(3) * 10 if packed else 20.0
    width = 20.0 * columns + radius * packed
    left = -width / 2 + radius
    row = [
        Ball((left + 20 * i + radius * packed * (j % 2), -radius - rise * j))
        for j in range(rows)
        for i in range(columns)
    ]
    return Scene([*slot(width, 20 * (rows + 5)), *row])


SIZES = sample([(5, 10), (5, 40), (8, 40), (15, 40)], 4)


@pytest.mark.parametrize("packed", sample([True, False], 2))
@pytest.mark.parametrize(("rows", "columns"), SIZES)
def test_a_neat_pile_sleeps(rows, columns, packed):
    sleepy = build(neat(rows, columns, packed), *TOUCH, "Sleep")
    run(sleepy, 10)
    assert sleepy.awake == []


RAINED = sample([(40, 200), (200, 600)], 2)


@pytest.mark.parametrize("effects", [BOUNCE, pytest.param(TOUCH, marks=pytest.mark.soak)])
@pytest.mark.parametrize(("count", "width"), RAINED)
def test_a_rained_pile_sleeps(count, width, effects):
    scene = pile(count, width)
    for body in scene.bodies:
        body.restitution = 0.3
    sleepy = build(scene, *effects, "Sleep")
    run(sleepy, 10)
    assert sleepy.awake == []
