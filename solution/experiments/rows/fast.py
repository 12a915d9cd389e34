"""Rows about fast balls: nothing solid is passed, and what misses is not touched."""

import math
from functools import partial

from ..measures import run
from ..scenes import BULLETS, Ball, Block, Scene, near_miss, rammer, shot
from .row import Row, law, never, velocity_off

COUNT = 20


def volley(fast, thick=20.0, radius=10.0, bullet=True):
    """Make bullets side by side, each from another height, above a ledge."""
    ledge = Block((0, thick / 2), (40.0 * COUNT, thick / 2))
    balls = [
        Ball(
            (40.0 * (i - COUNT / 2), -100 - 1.37 * i * fast / 2448),
            radius,
            vel=(0, fast),
            bullet=bullet,
        )
        for i in range(COUNT)
    ]
    return Scene([ledge, *balls], BULLETS, gravity=(0, 0))


def tunnel(trial, scene, seconds=0.4):
    """Count the bodies that are beyond the ledge in the end."""
    engine = trial.build(scene)
    run(engine, seconds)
    return sum(not engine.read(i).y < 0 for i in scene.moving())


def get_through(trial, scene):
    """Count the bodies that are beyond the wall at x = 0 in the end."""
    engine = trial.build(scene)
    run(engine, 0.5)
    return sum(not engine.read(i).x < 0 for i in scene.moving())


def deflected(trial, scene):
    """Return how far (px/s) the velocity of what flies past is off."""
    engine, vel = trial.build(scene), scene.bodies[1].vel
    run(engine, max(0.1, 300 / math.hypot(*vel)))
    return velocity_off(engine.read(1), vel)


def rebounds(trial, scene, exact):
    """Return how far (px/s) the velocity after the hit is off."""
    engine = trial.build(scene)
    run(engine, max(0.1, 300 / scene.bodies[1].vel[1]))
    return velocity_off(engine.read(1), (0, exact))


def duel(fast, mass=1.0):
    """Make two bullets that fly at each other; e = 1, no friction."""
    ideal = {"restitution": 1.0, "friction": 0.0, "bullet": True}
    first = Ball((-403, 0), vel=(fast, 0), **ideal)
    second = Ball((400, 0), mass=mass, vel=(-fast, 0), **ideal)
    return Scene([first, second], ("Contacts", "Bounce", "Bullets"), gravity=(0, 0))


def after_duel(trial, scene):
    """Return how far (px/s) either velocity is off."""
    engine = trial.build(scene)
    run(engine, max(0.1, 1000 / scene.bodies[0].vel[0]))
    a, b = scene.bodies
    common = (a.vel[0] + b.mass * b.vel[0]) / (1 + b.mass)
    return max(
        velocity_off(engine.read(i), (2 * common - body.vel[0], 0)) for i, body in enumerate((a, b))
    )


def cage(fast):
    """Make a bullet that flies to and fro between two walls."""
    walls = [Block((x, 0), (5, 50), 1.0, 0) for x in (-105, 105)]
    ball = Ball((0, 0), 10, vel=(fast, 0), restitution=1.0, friction=0.0, bullet=True)
    return Scene([*walls, ball], ("Contacts", "Bounce", "Bullets"), gravity=(0, 0))


def stays_in(trial, scene):
    """Return how far (px/s) its speed is off after a second; all of it if it is out."""
    engine, fast = trial.build(scene), scene.bodies[2].vel[0]
    run(engine, 1)
    state = engine.read(2)
    return abs(abs(state.vx) - fast) if abs(state.x) < 100 else fast


# fmt: off
def make_rows():
    solid = "Bodies are solid at any speed."
    for fast in (1000.0, 2448.0, 10_000.0, 50_000.0, 200_000.0):
        yield Row(f"bullets: 20 at {fast:,.0f} px/s, ledge of 20 px", solid, partial(volley, fast),
                  tunnel, never(), quick=fast == 10_000)
        yield Row(f"fast balls: 20 at {fast:,.0f} px/s that are no bullets, ledge of 20 px", solid,
                  partial(volley, fast, bullet=False), tunnel, never())
    for fast in (500.0, 5000.0):
        yield Row(f"bullets: 20 of radius 2 at {fast:,.0f} px/s, ledge of 2 px", solid,
                  partial(volley, fast, 2.0, 2.0), tunnel, never())
    for fast in (300.0, 2448.0, 20_000.0):
        yield Row(f"bullets: one that misses a corner by half a pixel at {fast:,.0f} px/s",
                  "What touches nothing flies straight on.", partial(near_miss, fast), deflected,
                  law(fast), quick=fast == 2448)
    for fast in (500.0, 5000.0, 50_000.0):
        scene = partial(shot, fast, 100.0, 0.5)
        yield Row(f"bullets: rebound at {fast:,.0f} px/s, e = 0.5",
                  "What lands at speed v leaves at e v.", scene,
                  partial(rebounds, exact=-0.5 * fast), law(fast))
        for mass in (1.0, 10.0):
            yield Row(f"bullets: two that meet at {fast:,.0f} px/s, 1:{mass:g}",
                      "They meet; momentum and energy give both velocities.",
                      partial(duel, fast, mass), after_duel, law(fast))
    for fast in (1000.0, 10_000.0):
        yield Row(f"bullets: to and fro at {fast:,.0f} px/s", "With e = 1 it stays in and as fast.",
                  partial(cage, fast), stays_in, law(fast))
    for mass, speed in ((100.0, 600.0), (1000.0, 600.0), (1000.0, 1000.0)):
        yield Row(f"ram: {mass:g} kg on a rod behind 1 kg, {speed:g} px/s, wall of 20 px", solid,
                  partial(rammer, mass, speed), get_through, never(), needs=("rods that push",))
