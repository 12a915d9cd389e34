"""Test the same scenes in Box2D, if it is installed."""

from dataclasses import replace

import pytest

pytest.importorskip("Box2D", reason="needs Box2D 2.3, of the extra `box2d`")

from experiments.engines import ENGINES
from experiments.measures import energy, finite, run
from experiments.scenes import (
    NAMED,
    TOUCH,
    Ball,
    Scene,
    oscillator,
    tower,
)

Box2d = ENGINES["box2d"]


@pytest.mark.parametrize("name", NAMED)
def test_every_scene_of_the_window_runs(name):
    engine = Box2d(NAMED[name]())
    run(engine, 0.2)
    assert finite(engine)


def test_a_spring_has_its_frequency():
    engine = Box2d(oscillator())
    run(engine, 0.5)  # half a period of 1 Hz
    assert engine.read(1).x == pytest.approx(50, abs=10)
    assert energy(engine) > 0


def test_balls_sleep_only_where_that_is_declared():
    for effects, asleep in ((TOUCH, 0), ((*TOUCH, "Sleep"), 5)):
        engine = Box2d(replace(tower(5), effects=effects))
        run(engine, 3)
        assert engine.asleep() == asleep


def test_effects_that_are_not_declared_do_nothing():
    scene = Scene([Ball((0, 0)), Ball((5, 0))], effects=(), gravity=(0, 0))
    engine = Box2d(scene)
    run(engine, 1)
    assert engine.read(1).x == pytest.approx(5)
    assert engine.contacts() == 0
