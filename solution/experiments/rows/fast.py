"""Rows about fast balls: they pass nothing solid, and touch nothing that they miss."""

from functools import partial

from ..scenes import BULLETS, Ball, Block, Scene, near_miss, rammer, shot
from .bounces import between_walls, keeps_flying
from .hits import after_head_on
from .row import NEVER, Row, law, run_for, velocity_off_after

COUNT = 20
SMOOTH_BULLETS = ("Contacts", "Bounce", "Bullets")


def volley(fast, thick=20.0, radius=10.0, bullet=True):
    """Make bullets side by side above a ledge, each at a different height."""
    ledge = Block((0, thick / 2), (40.0 * COUNT, thick / 2))
    places = [(40.0 * (i - COUNT / 2), -100 - 1.37 * i * fast / 2448) for i in range(COUNT)]
    balls = [Ball(place, radius, vel=(0, fast), bullet=bullet) for place in places]
    return Scene([ledge, *balls], BULLETS, gravity=(0, 0))


def get_through(trial, scene, axis, seconds):
    """Count the bodies that are beyond the wall at x = 0, or the ledge at y = 0, in the end."""
    engine = run_for(trial, scene, seconds)
    return sum(not getattr(engine.read(i), axis) < 0 for i in scene.moving())


def duel(fast, mass=1.0):
    """Make two bullets that fly at each other; e = 1, no friction."""
    ideal = {"restitution": 1.0, "friction": 0.0, "bullet": True}
    first = Ball((-403, 0), vel=(fast, 0), **ideal)
    second = Ball((400, 0), mass=mass, vel=(-fast, 0), **ideal)
    return Scene([first, second], SMOOTH_BULLETS, gravity=(0, 0))


def thrown_at_others(fast):
    """Make balls that are thrown at balls at rest, from different places; nothing bounces."""
    thrown = [Ball((-100 - 0.56 * i * fast / 1000, 40 * i), vel=(fast, 0)) for i in range(COUNT)]
    others = [Ball((0, 40 * i)) for i in range(COUNT)]
    return Scene([*thrown, *others], ("Contacts",), gravity=(0, 0))


def pass_each_other(trial, scene, seconds):
    """Count the thrown balls that are beyond the balls they were thrown at."""
    engine = run_for(trial, scene, seconds)
    return sum(engine.read(i).x > engine.read(i + COUNT).x for i in range(COUNT))


# fmt: off
def make_rows():
    solid, passed = "Bodies are solid at any speed.", partial(get_through, axis="y", seconds=0.4)
    for fast in (1000.0, 2448.0, 10_000.0, 50_000.0, 200_000.0):
        yield Row(f"bullets: 20 at {fast:,.0f} px/s, ledge of 20 px", solid, partial(volley, fast),
                  passed, NEVER, quick=fast == 10_000)
        yield Row(f"fast balls: 20 at {fast:,.0f} px/s that are no bullets, ledge of 20 px", solid,
                  partial(volley, fast, bullet=False), passed, NEVER)
    for fast in (500.0, 5000.0):
        yield Row(f"bullets: 20 of radius 2 at {fast:,.0f} px/s, ledge of 2 px", solid,
                  partial(volley, fast, 2.0, 2.0), passed, NEVER)
    for fast in (300.0, 2448.0, 20_000.0):
        miss = partial(near_miss, fast)
        yield Row(f"bullets: one that misses a corner by half a pixel at {fast:,.0f} px/s",
                  "What touches nothing flies straight on.", miss,
                  partial(velocity_off_after, exact=miss().bodies[1].vel,
                          seconds=max(0.1, 300 / fast)), law(fast), quick=fast == 2448)
    for fast in (500.0, 5000.0, 50_000.0):
        scene, seconds = partial(shot, fast, 100.0, 0.5), max(0.1, 300 / fast)
        yield Row(f"bullets: rebound at {fast:,.0f} px/s, e = 0.5",
                  "What lands at speed v leaves at e v.", scene,
                  partial(velocity_off_after, exact=(0, -0.5 * fast), seconds=seconds), law(fast))
        for mass in (1.0, 10.0):
            yield Row(f"bullets: two that meet at {fast:,.0f} px/s, 1:{mass:g}",
                      "They meet; momentum and energy give both velocities.",
                      partial(duel, fast, mass),
                      partial(after_head_on, seconds=max(0.1, 1000 / fast)), law(fast))
    for fast in (1000.0, 10_000.0):
        yield Row(f"bullets: to and fro at {fast:,.0f} px/s", "With e = 1 it stays in and as fast.",
                  partial(between_walls, fast, 5, SMOOTH_BULLETS),
                  partial(keeps_flying, seconds=1), law(fast))
    for fast in (3000.0, 6000.0):
        yield Row(f"fast balls: 20 thrown at 20 others at {fast:,.0f} px/s, no bounce", solid,
                  partial(thrown_at_others, fast), partial(pass_each_other, seconds=0.4), NEVER)
    for mass, speed in ((100.0, 600.0), (1000.0, 600.0), (1000.0, 1000.0)):
        yield Row(f"ram: {mass:g} kg on a rod behind 1 kg, {speed:g} px/s, wall of 20 px", solid,
                  partial(rammer, mass, speed), partial(get_through, axis="x", seconds=0.5),
                  NEVER, needs=("rods that push",))
