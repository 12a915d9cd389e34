"""Test the same scenes in Box2D, if it is installed."""

import math
from dataclasses import replace

import pytest

pytest.importorskip("Box2D", reason="needs Box2D 2.3, of the extra `box2d`")

from experiments.engines import ENGINES
from experiments.measures import energy, finite, run
from experiments.scenes import (
    NAMED,
    TOUCH,
    Ball,
    G,
    Scene,
    drop,
    oscillator,
    pendulum,
    slide,
    tower,
)

Box2d = ENGINES["box2d"]


@pytest.mark.parametrize("name", NAMED)
def test_every_scene_of_the_window_runs(name):
    engine = Box2d(NAMED[name]())
    run(engine, 0.2)
    assert finite(engine)


def test_a_state_is_in_px_and_starts_as_the_scene_says():
    ball = Ball((30, -50), 10, 2.0, (70, -90), 3.0)
    state = Box2d(Scene([ball])).read(0)
    assert tuple(state) == pytest.approx((30, -50, 70, -90, 0, 3), rel=1e-6)


def test_a_ball_falls_rolls_bounces_and_swings():
    falling = Box2d(Scene([Ball((0, 0))], effects=()))
    run(falling, 1)
    assert falling.read(0).y == pytest.approx(G / 2, rel=0.01)
    rolling = Box2d(slide())
    run(rolling, 2)
    assert rolling.read(1).vx == pytest.approx(200, rel=0.01)
    bouncing = Box2d(drop(restitution=0.5))
    run(bouncing, 0.8)
    assert bouncing.read(1).vy == pytest.approx(-0.5 * math.sqrt(2 * G * 290), rel=0.3)
    swinging = Box2d(pendulum())
    run(swinging, 1)
    assert math.hypot(*swinging.read(1)[:2]) == pytest.approx(140, rel=1e-3)


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
