"""Rows about rest, sleep, bad starts, and steps that vary."""

import math
from dataclasses import replace
from functools import partial

from .. import scenes
from ..measures import deepest_overlap, run, states, top_speed, watch
from ..scenes import BOUNCE, TOUCH, Ball, Block, G, Scene, floor, pile, resting, stack, tower
from ..steps import PATTERNS, lasting
from .row import NEVER, SEEN, STILL, Row, late, off, off_after, run_for
from .ties import centre_off, stays

ASLEEP = (*TOUCH, "Sleep")


def top_moves(trial, scene, seconds=10):
    """Return the largest rise (px) of the last ball, or its sink in the end if larger."""
    engine, top = trial.build(scene), scene.moving()[-1]
    start = engine.read(top).y
    falls = watch(engine, seconds, lambda: engine.read(top).y - start)
    return max(falls[-1], -min(falls))


def late_speed(trial, scene, seconds=10):
    """Return the top speed (px/s) of the last second."""
    engine = run_for(trial, scene, seconds - 1)
    return max(watch(engine, 1, lambda: top_speed(engine)))


def overlaps(trial, scene, seconds=3):
    """Return the deepest overlap (px) in the end."""
    return deepest_overlap(run_for(trial, scene, seconds))


def rises_in_steps(trial, scene, steps, seconds=5):
    """Return the largest rise (px) of any ball above its start, in steps that vary."""
    engine, moving = trial.build(scene), scene.moving()
    starts = [engine.read(i).y for i in moving]
    rise = 0.0
    for dt in lasting(seconds, steps()):
        engine.step(dt)
        rise = max(rise, *(y - engine.read(i).y for i, y in zip(moving, starts, strict=True)))
    return rise


def neat(rows, count, friction=0.6):
    """Make rows of balls one above the other, in a slot just as wide."""
    balls = [
        Ball((20 * (i - (count - 1) / 2), -10 - 20 * row), friction=friction)
        for row in range(rows)
        for i in range(count)
    ]
    return Scene([*scenes.slot(20 * count, 20 * (rows + 4)), *balls])


def pyramid(rows):
    """Make a pyramid of balls in a slot: each ball lies between two of the row below."""
    balls = [
        Ball((20 * i + 10 * row - 10 * (rows - 1), -10 - row * 10 * math.sqrt(3)))
        for row in range(rows)
        for i in range(rows - row)
    ]
    return Scene([*scenes.slot(20 * rows, 20 * rows), *balls])


def in_corner(degrees):
    """Make a ball at rest in a corner, with gravity that points into it."""
    way = math.radians(degrees)
    walls = [Block((0, 50), (300, 50)), Block((60, -100), (50, 200))]
    return Scene([*walls, Ball((0, -10))], gravity=(G * math.cos(way), G * math.sin(way)))


# ---------------------------------------------------------------- sleep


def alone(vel=(0.0, 0.0), gravity=(0.0, 0.0)):
    return Scene([Ball((0, 0), vel=vel)], ASLEEP, gravity=gravity)


def wakes(trial, scene, fast, seconds, **exact):
    """Rest for 3 s, throw the second body, and return the error (px) of the last one."""
    engine = run_for(trial, scene, 3)
    engine.throw(1, (fast, 0.0))
    run(engine, seconds)
    return off(engine.read(len(scene.bodies) - 1), exact)


def two_high():
    return Scene([floor(friction=0.0), *(Ball((0, y), friction=0.0) for y in (-10, -30))], ASLEEP)


def two_apart():
    balls = [Ball((x, -10), friction=0.0, restitution=1.0) for x in (0, 100)]
    return Scene([floor(friction=0.0), *balls], (*BOUNCE, "Sleep"))


# ---------------------------------------------------------------- bad starts


def ends_still(trial, scene, seconds=3):
    """Return the top speed (px/s) in the end."""
    return top_speed(run_for(trial, scene, seconds))


def escapes(trial, scene, seconds=2):
    """Count the balls whose centre is in a wall, or beyond it, in the end."""
    half = scene.bodies[3].pos[0] - scene.bodies[3].half[0]
    engine = run_for(trial, scene, seconds)
    now = [engine.read(i) for i in scene.moving()]
    return sum(not (abs(s.x) < half and abs(s.y) < half) for s in now)


def bits_differ(trial, scene, seconds=1):
    """Count the numbers that differ in any bit when the run is repeated."""
    first, second = (states(run_for(trial, scene, seconds)) for _ in range(2))
    return sum(a != b for a, b in zip(first, second, strict=True))


def shifted_tower(far):
    scene = tower(5)
    for body in scene.bodies:
        body.pos = body.pos[0] + far, body.pos[1] + far
    return scene


# fmt: off
def make_pile_rows():
    rigid = "Balls are rigid and forces cancel: nothing sinks, nothing is thrown."
    rests = "Friction and gravity hold it, and nothing drives it: it comes to rest."
    for radius in (1.0, 10.0, 100.0):
        yield Row(f"rest: ball of radius {radius:g} for 10 s", rigid, partial(resting, radius),
                  partial(stays, seconds=10), SEEN)
    for degrees in (30, 45, 80):
        yield Row(f"rest: in a corner, gravity at {degrees}°", rigid, partial(in_corner, degrees),
                  stays, SEEN)
    for count in (5, 10, 20, 40):
        yield Row(f"tower: {count} equal balls, top", rigid, partial(tower, count), top_moves,
                  SEEN, quick=count == 10)
        yield Row(f"tower: {count} equal balls, late speed", rests, partial(tower, count),
                  late_speed, STILL)
    for mass in (10, 100, 1000, 10_000):
        yield Row(f"heavy on light: 1:{mass}", rigid, partial(stack, 1, mass), top_moves, SEEN,
                  quick=mass == 100)
    yield Row("heavy on light: 1, 10, 100, 1000 kg", rigid, partial(stack, 1, 10, 100, 1000),
              top_moves, SEEN)
    yield Row("light on heavy: 1000:1", rigid, partial(stack, 1000, 1), top_moves, SEEN)
    for count in (6, 12):
        yield Row(f"tower: {count} balls of 1 kg and 100 kg in turns", rigid,
                  partial(stack, *[1, 100] * (count // 2)), top_moves, SEEN)
    for rows, count in ((3, 10), (5, 20), (8, 20)):
        yield Row(f"neat pile: {rows} rows of {count}, late speed", rests,
                  partial(neat, rows, count), late_speed, STILL, quick=rows == 3)
        yield Row(f"neat pile: {rows} rows of {count}, overlap", rigid, partial(neat, rows, count),
                  overlaps, SEEN)
    for rows in (4, 8):
        yield Row(f"pyramid: {rows} rows, late speed", rests, partial(pyramid, rows), late_speed,
                  STILL)
        yield Row(f"pyramid: {rows} rows, top", rigid, partial(pyramid, rows), top_moves, SEEN)
    for count in (40, 100):
        bin_of = partial(pile, count, 200.0 if count == 40 else 300.0)
        yield Row(f"rained pile: {count} balls, late speed", rests, bin_of, late_speed, STILL)
        yield Row(f"rained pile: {count} balls, overlap", rigid, bin_of, overlaps, SEEN,
                  quick=count == 40)
    for title, make in (("stack of 10", partial(stack, *[1] * 10)),
                        ("hanging chain of 20", scenes.chain)):
        for words, steps in PATTERNS.items():
            yield Row(f"uneven steps: {title}, {words}", "Nothing that rests starts to rise.", make,
                      partial(rises_in_steps, steps=steps), SEEN, quick="every" in words)


def make_sleep_rows():
    newton = "Newton's law; that a body is slow and that it may sleep change nothing."
    yield Row("sleep: drifts at 2 px/s", newton, partial(alone, (2.0, 0.0)),
              partial(off_after, seconds=10, x=20.0, y=0.0), SEEN, quick=True)
    yield Row("sleep: falls at 1 px/s²", newton, partial(alone, gravity=(0.0, 1.0)),
              partial(off_after, seconds=5, x=0.0, y=12.5), SEEN)
    yield Row("sleep: thrown up, at 10 px/s²", newton, partial(alone, (0.0, -20.0), (0.0, 10.0)),
              partial(off_after, seconds=5, x=0.0, y=25.0), SEEN)
    for degrees in (0.05, 0.1):
        way = G * math.sin(math.radians(degrees)) / 3 * 25
        yield Row(f"sleep: on a slope of {degrees}°", "A disc rolls down at ⅔ g sin θ.",
                  lambda degrees=degrees: replace(scenes.incline(degrees), effects=ASLEEP),
                  partial(off_after, seconds=5, x=way), SEEN, quick=degrees == 0.1)
    yield Row("sleep: the ball below is thrown away", "What loses its support falls.", two_high,
              partial(wakes, fast=2000.0, seconds=2, y=-10), SEEN)
    yield Row("sleep: a ball hits one that sleeps", "Equal balls swap their speeds, asleep or not.",
              two_apart, partial(wakes, fast=200.0, seconds=0.8, x=180.0), late(4 * 200))
    yield Row("sleep: a tower", "Balls are rigid and forces cancel.",
              lambda: replace(tower(10), effects=ASLEEP), top_moves, SEEN)


def make_start_rows():
    no_energy = "What starts at rest has no energy to give: pushed apart, it ends at rest."
    parts = "Solid bodies do not stay in each other."
    overlapping = scenes.overlapping
    for title, make in (
        ("two balls overlap by 30 px", overlapping),
        ("two balls overlap by 30 px, 1:100", partial(overlapping, 30.0, 100.0)),
        ("10 balls with the same centre", scenes.coincident),
        ("ball with its centre in a ledge", partial(scenes.inside_ledge, (3, 4))),
        ("ball with its centre on a corner", partial(scenes.inside_ledge, (150, -10))),
    ):
        yield Row(f"bad start: {title}, speed", no_energy, make, ends_still, STILL,
                  quick="1:100" in title)
        yield Row(f"bad start: {title}, overlap", parts, make, overlaps, SEEN)
    for mass in (1, 100):
        yield Row(f"bad start: squeezed by 8 px, 1:{mass}", no_energy,
                  partial(scenes.squeezed, 8, mass), ends_still, STILL)
    yield Row("bad start: two balls overlap by 30 px, 1:100, centre of mass",
              "Nothing from outside acts: the centre of mass stays.",
              partial(overlapping, 30.0, 100.0), partial(centre_off, seconds=3), SEEN)
    for seed in range(6):
        yield Row(f"closed box: masses 1000:1, rods, overlaps, number {seed}", "Walls are solid.",
                  partial(scenes.closed_box, seed), escapes, NEVER, needs=("rods that push",),
                  quick=seed == 0)
    yield Row("once more: pile of 40", "The same start has the same future, bit by bit.",
              partial(pile, 40, 200.0), bits_differ, NEVER)
    for far in (1e4, 1e6):
        yield Row(f"far away: tower of 5, {far:,.0f} px off", "The laws are the same everywhere.",
                  partial(shifted_tower, far), top_moves, SEEN)
