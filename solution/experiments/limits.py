"""Limits of each engine: the largest value of one setting that holds, found by halving."""

import math
from dataclasses import replace
from functools import partial

from . import scenes
from .battery import Case, Figure
from .measures import GaveUp, finite, run, sinking, stretches
from .scenes import DT

CLOSE = 1.05  # the first value that fails is at most so many times the last that holds
BULLETS = 20  # of each speed, from as many places


def find_farthest(bench, scene, make, holds, ends, whole=False):
    """Return the largest value between the two ends at which a scene holds, or 0 for none.

    make(value) returns the scene and the step (s); holds(engine, seconds, dt) is true if all is as
    it should be in the end. Between a value that holds and one that does not, the search tries
    their mean in ratio.
    """

    def good(value):
        tried, dt = make(value)
        engine = bench.build(tried)
        try:
            return bool(holds(engine, bench.seconds, dt)) and finite(engine)
        except (GaveUp, ValueError):
            return False

    low, high = ends
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
    bench.built.clear()  # some of them gave up, as a search must
    return {"most": best}


def carries(engine, seconds, dt):
    """Return true if the last ball sinks by less than a quarter of its width and never rises."""
    radius = engine.scene.bodies[engine.scene.moving()[-1]].radius
    sink, rise, _ = sinking(engine, seconds, dt)
    return abs(sink) < radius / 2 and rise < 1


def stands(engine, seconds, dt):
    """Return true if the last ball sinks by less than 1 px, never rises, and all come to rest."""
    sink, rise, fastest = sinking(engine, seconds, dt)
    return abs(sink) < 1 and rise < 1 and fastest < 1


def hangs(engine, seconds, dt):
    """Return true if a chain stretches by less than one hundredth of its length."""
    run(engine, seconds, dt)
    bodies = engine.scene.bodies
    length = sum(math.dist(bodies[a].pos, bodies[b].pos) for a, b in engine.scene.rods)
    return sum(stretches(engine)) < length / 100


def stops(engine, seconds, dt):
    """Return true if every bullet of a row is on its own side of the ledge."""
    run(engine, seconds, dt)
    return all(engine.read(i).y < 0 for i in engine.scene.moving())


def fire_volley(speed):
    """Return bullets side by side, each from another height, above a ledge 20 px thick."""
    one = scenes.shot(float(speed))
    _, bullet = one.bodies
    ledge = scenes.Block((0, 10), (30.0 * BULLETS, 10))
    x, y = bullet.pos
    row = [replace(bullet, pos=(x + 30 * (i - BULLETS / 2), y - 1.37 * i)) for i in range(BULLETS)]
    return replace(one, bodies=[ledge, *row])


def limit(title, words, need, make, holds, ends, seconds=4.0, whole=False):
    """Return a case that looks for the largest value within the two ends."""
    trial = partial(find_farthest, make=make, holds=holds, ends=ends, whole=whole)
    figure = Figure("most", words, math.inf, ">", need)
    return Case(f"limit: {title}", [scenes.free_fall], trial, [figure], seconds, quick=False)


LIMITS = [
    limit("heavy ball on a ball of 1 kg", "kg that it carries", 1000,
          lambda mass: (scenes.stack(1, mass), DT), carries, (1, 1e6)),
    limit("tower of equal balls", "balls that stand", 20,
          lambda count: (scenes.tower(count), DT), stands, (1, 64), 10, whole=True),
    limit("hanging chain", "links that hang within 1 %", 20,
          lambda count: (scenes.chain(count), DT), hangs, (1, 256), 10, whole=True),
    limit("hanging chain of 10", "kg of its last ball, within 1 %", 20,
          lambda mass: (scenes.chain(10, bob=mass), DT), hangs, (1, 1e6)),
    limit("stack of 10", "s of a step that carries it", 1 / 60,
          lambda dt: (scenes.stack(*[1] * 10), dt), carries, (1 / 960, 1 / 4)),
    limit("bullets, ledge of 20 px", "px/s that it stops", 200_000,
          lambda speed: (fire_volley(speed), DT), stops, (100, 1e7), 0.3),
]  # fmt: skip
