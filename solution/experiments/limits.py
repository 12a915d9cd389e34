"""How far each engine holds: the largest value of one setting, found by halving."""

import math
from dataclasses import replace
from functools import partial

from . import scenes
from .battery import Case, Figure
from .measures import GaveUp, finite, run, sinking, stretches
from .scenes import DT

CLOSE = 1.05  # the first value that fails is at most so many times the last that holds
BULLETS = 20  # of each speed, from as many places


def farthest(bench, scene, make, holds, low, high, whole=False):
    """The largest value from low to high at which a scene holds, 0 if none; high if all do.

    make(value) is the scene and the step (s); holds(engine, seconds, dt) whether it is as it should
    be in the end. Between a value that holds and one that does not their mean in ratio is tried.
    """

    def good(value):
        tried, dt = make(value)
        engine = bench.build(tried)
        try:
            return bool(holds(engine, bench.seconds, dt)) and finite(engine)
        except (GaveUp, ValueError):
            return False

    best, worst = 0.0, high
    if good(high):
        best = high
    elif good(low):
        best = low
        while worst / best > CLOSE and not (whole and worst - best <= 1):
            middle = math.sqrt(best * worst)
            middle = min(max(round(middle), best + 1), worst - 1) if whole else middle
            if good(middle):
                best = middle
            else:
                worst = middle
    bench.built.clear()  # among them are those that gave up, as was asked
    return {"most": best}


# ---------------------------------------------------------------- what holds


def carries(engine, seconds, dt):
    """Whether the last ball sinks by less than a quarter of its width and is never launched."""
    radius = engine.scene.bodies[engine.scene.moving()[-1]].radius
    sink, rise, _ = sinking(engine, seconds, dt)
    return abs(sink) < radius / 2 and rise < 1


def stands(engine, seconds, dt):
    """Whether the last ball sinks by less than 1 px, is never launched, and all come to rest."""
    sink, rise, fastest = sinking(engine, seconds, dt)
    return abs(sink) < 1 and rise < 1 and fastest < 1


def hangs(engine, seconds, dt):
    """Whether a chain stretches by less than one hundredth of its length."""
    run(engine, seconds, dt)
    bodies = engine.scene.bodies
    length = sum(math.dist(bodies[a].pos, bodies[b].pos) for a, b in engine.scene.rods)
    return sum(stretches(engine)) < length / 100


def stops(engine, seconds, dt):
    """Whether every bullet of a row is on its own side of the ledge."""
    run(engine, seconds, dt)
    return all(engine.read(i).y < 0 for i in engine.scene.moving())


def volley(speed):
    """Bullets side by side, from as many places as there are, at a ledge 20 px thick."""
    one = scenes.shot(float(speed))
    _, bullet = one.bodies
    ledge = scenes.Block((0, 10), (30.0 * BULLETS, 10))
    x, y = bullet.pos
    row = [replace(bullet, pos=(x + 30 * (i - BULLETS / 2), y - 1.37 * i)) for i in range(BULLETS)]
    return replace(one, bodies=[ledge, *row])


# ---------------------------------------------------------------- the rows


def limit(title, words, need, make, holds, low, high, seconds=4.0, whole=False):
    trial = partial(farthest, make=make, holds=holds, low=low, high=high, whole=whole)
    figure = Figure("most", words, math.inf, ">", need)
    return Case(title, [scenes.free_fall], trial, [figure], seconds, quick=False)


LIMITS = [
    limit(
        "limit: heavy ball on a ball of 1 kg",
        "kg that it carries",
        1000,
        lambda mass: (scenes.stack(1, mass), DT),
        carries,
        1.0,
        1e6,
    ),
    limit(
        "limit: tower of equal balls",
        "balls that stand",
        20,
        lambda count: (scenes.tower(count), DT),
        stands,
        1,
        64,
        10.0,
        whole=True,
    ),
    limit(
        "limit: hanging chain",
        "links that hang within 1 %",
        20,
        lambda count: (scenes.chain(count), DT),
        hangs,
        1,
        256,
        10.0,
        whole=True,
    ),
    limit(
        "limit: hanging chain of 10",
        "kg of its last ball, within 1 %",
        20,
        lambda mass: (scenes.chain(10, bob=mass), DT),
        hangs,
        1.0,
        1e6,
    ),
    limit(
        "limit: stack of 10",
        "s of a step that carries it",
        1 / 60,
        lambda dt: (scenes.stack(*[1] * 10), dt),
        carries,
        1 / 960,
        1 / 4,
    ),
    limit(
        "limit: bullets, ledge of 20 px",
        "px/s that it stops",
        200_000,
        lambda speed: (volley(speed), DT),
        stops,
        100.0,
        1e7,
        0.3,
    ),
]
