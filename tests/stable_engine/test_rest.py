"""Test that a step may skip work while nobody is near or all part, and moves all the same."""

import math
import random

import pytest

from stable_engine import (
    Body,
    Bounce,
    Box,
    Circle,
    Contacts,
    Damping,
    Friction,
    Rod,
    Rods,
    Spring,
    Springs,
    World,
)
from stable_engine.broad_phase import BroadPhase

DT = 1 / 120


def push(world):
    world.bodies[-1].apply_force((-9e4, 0))


def turn_gravity(world):
    world.gravity = (-600, 0)


def throw(world):
    world.bodies[-1].vel = (-900, 0)


def slow_down(world):
    world.effects["Damping"].linear = 2.0


def take_more_substeps(world):
    world.substeps = 12


def add(world):
    x, y = world.bodies[-1].pos
    world.add(Body(Circle(5), (x - 40, y), 1.0))


def remove(world):
    world.remove(world.bodies[1])


CHANGES = [push, turn_gravity, throw, slow_down, take_more_substeps, add, remove]


def film(gravity, speed, change):
    """Return all states of balls that fly apart and to a floor, and how many steps Contacts skip.

    Something changes after 40 steps.
    """
    rng = random.Random(7)
    world = World(gravity, 4, [Contacts(), Bounce(), Friction(), Damping(0, 0)])
    world.add(Body(Box((900, 20)), (0, 700), restitution=1.0))
    for i in range(8):
        ball = world.add(Body(Circle(10), (120 * i - 420, 0), 1.0, restitution=0.9))
        ball.vel = (rng.uniform(-speed, speed), rng.uniform(-speed, speed))
    states, skipped = [], 0
    for step in range(240):
        if step == 40:
            change(world)
        world.step(DT)
        skipped += world.effects["Contacts"].is_at_rest()
        states += [x for b in world.bodies for x in (b.x, b.y, b.vx, b.vy, b.w)]
    return states, skipped


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize(("gravity", "speed"), [((0, 980), 3), ((0, 0), 3), ((0, 0), 300)])
def test_what_a_step_skips_changes_nothing(gravity, speed, change, monkeypatch):
    """Neither rest, nor one long fall instead of substeps: to rounding, they are the same."""
    states, skipped = film(gravity, speed, change)
    monkeypatch.setattr(World, "is_falling", lambda world: False)
    monkeypatch.setattr(Contacts, "stays", lambda contacts, h: False)
    slow, none = film(gravity, speed, change)
    assert states == pytest.approx(slow, rel=1e-9, abs=1e-9)
    assert skipped > none == 0


def swarm(tie, seed):
    """Return all states of a sparse swarm that a tied or a steered ball crosses, and the rests."""
    rng = random.Random(seed)
    world = World((0, 0), 4, [Contacts(), Bounce(), Rods(), Springs()])
    balls = []
    for i in range(12):
        place = 120 * (i % 4) + rng.uniform(-40, 40), 120 * (i // 4) + rng.uniform(-40, 40)
        balls.append(world.add(Body(Circle(10), place, 1.0, restitution=1.0)))
        balls[-1].vel = rng.uniform(-40, 40), rng.uniform(-40, 40)
    first, second = (world.add(Body(Circle(10), (x, -150), 1.0)) for x in (0, 60))
    first.vel, second.vel = (100, 250), (100, 350)
    if tie in (Rod, Spring):
        world.add(tie(first, second) if tie is Rod else Spring(first, second, 300, 0, 60))
    states, rests = [], 0
    for step in range(150):
        if tie is None and step % 2:
            first.vel += (math.sin(step / 9) * 20, 0)
        elif tie is push:
            first.apply_force((math.sin(step / 9) * 2400, 0))
        world.step(DT)
        rests += world.effects["Contacts"].is_at_rest()
        states += [x for b in world.bodies for x in (b.x, b.y, b.vx, b.vy, b.w)]
    return states, rests


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("tie", [Rod, Spring, None, push])
def test_what_a_tied_or_steered_ball_meets_is_not_skipped(tie, seed, monkeypatch):
    """Contacts rest beside it, but look where it goes: all moves as if they never rested."""
    states, rests = swarm(tie, seed)
    monkeypatch.setattr(Contacts, "stays", lambda contacts, h: False)
    monkeypatch.setattr(BroadPhase, "skip_pairs", lambda *_: None)
    slow, none = swarm(tie, seed)
    assert states == pytest.approx(slow, rel=1e-6, abs=1e-6)
    assert rests >= none == 0
