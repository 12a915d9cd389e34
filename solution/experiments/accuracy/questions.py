"""Questions with exact answers, settings of each engine, and dials of the lesson's engine.

A question runs an engine and returns its error: a number, or a word for how the engine gave up.
"""

import math
from dataclasses import dataclass, replace
from functools import partial

from ..compiled import Compiled
from ..engines import ENGINES, SUBSTEPS
from ..engines.box2d import PASSES as BOX2D_PASSES
from ..engines.chipmunk import PASSES
from ..measures import deepest_overlap, energy_height, run, watch, worst_stretch
from ..rows.hits import energy_gain
from ..scenes import chain, drop, find_pendulum_angle, pendulum, pendulum_period, stack, tower

LAUNCHED = 1.0  # px: a ball that rises by more was thrown
RATE = 120  # steps per second, of the lesson
SHARED = "shared substeps"  # of the lesson's engine: they share the 8 passes of a step


def plural(count, one, more=""):
    return f"{count} {one if count == 1 else more or one + 's'}"


@dataclass(frozen=True)
class Setting:
    """An engine and the values of its dials."""

    engine: str
    passes: int | None = None  # None: the engine has none
    rate: int = RATE  # steps per second
    substeps: int = 1
    slop: float | None = None  # px: overlap that pymunk accepts; None: its default, 0.1

    def __str__(self):
        dials = [plural(self.passes, "pass", "passes")] if self.passes else []
        dials += [plural(self.substeps, "substep")] if self.substeps > 1 else []
        dials += [f"slop {self.slop:g}"] if self.slop is not None else []
        dials += [f"1/{self.rate} s"] if self.rate != RATE else []
        return ", ".join([self.engine, *dials])

    def build(self, scene):
        """Return the engine with a scene in it."""
        dials = {"passes": self.passes, "substeps": self.substeps, "slop": self.slop}
        given = {name: value for name, value in dials.items() if value is not None}
        builder = Compiled if self.engine == "compiled" else ENGINES[self.engine]
        return builder(scene, **given)

    @property
    def dt(self):
        return 1 / self.rate


LESSON = Setting("lesson", 8)
STABLE = Setting("stable", substeps=SUBSTEPS)
COMPILED = replace(STABLE, engine="compiled")
PYMUNK = Setting("pymunk", PASSES)
BOX2D = Setting("box2d", BOX2D_PASSES)


def dials(quick=False):
    """Return {dial: {value: setting}} of the lesson's engine; each dial has the default too.

    Quick rows have the first, the last and the default value: verdicts depend on these only.
    """
    passes, rates, counts = (4, 8, 16, 32, 64), (60, 90, 120, 240, 480), (1, 2, 4, 8)
    if quick:
        passes, rates, counts = (4, 8, 64), (60, 120, 480), (1, 2, 8)
    return {
        "passes": {n: replace(LESSON, passes=n) for n in passes},
        "step": {f"1/{n}": replace(LESSON, rate=n) for n in rates},
        SHARED: {n: replace(LESSON, substeps=n, passes=8 // n) for n in counts},
    }


def families():
    """Return each engine's settings with one substep, to be increased.

    The lesson's engine also comes with one pass, and pymunk also without accepted overlap.
    """
    found = {
        "lesson": [LESSON, replace(LESSON, passes=1)],
        "stable": [replace(STABLE, substeps=1)],
        "compiled": [replace(COMPILED, substeps=1)] if Compiled.package else [],
        "pymunk": [PYMUNK, replace(PYMUNK, slop=0.0)],
        "box2d": [BOX2D] if BOX2D.engine in ENGINES else [],
    }
    return {engine: settings for engine, settings in found.items() if settings}


@dataclass
class Question:
    """A scene, and how to measure one error in it."""

    title: str
    scene: object  # makes it
    ask: object  # ask(engine, seconds, dt) returns the error
    error: str
    unit: str
    seconds: float


def measure_sink(engine, seconds, dt):
    """Return the deepest sink of a stack's top: some engines push it up again."""
    top = engine.scene.moving()[-1]
    start = engine.read(top).y
    drops = watch(engine, seconds, lambda: engine.read(top).y - start, dt)
    sunk = "launched" if min(drops) < -LAUNCHED else max(0.0, *drops)
    return refuse_fallen(engine, sunk)


def refuse_fallen(engine, error):
    """Return the error, or a word when a ball is below the floor at y = 0."""
    fallen = any(engine.read(i).y > 0 for i in engine.scene.moving())
    return "falls through" if fallen else error


def measure_stretch(engine, seconds, dt):
    """Return the largest stretch of any rod."""
    return max(watch(engine, seconds, lambda: worst_stretch(engine), dt))


def measure_overlap(engine, seconds, dt):
    """Return the deepest overlap at the end."""
    run(engine, seconds, dt)
    return refuse_fallen(engine, deepest_overlap(engine))


def measure_warming(engine, seconds, dt):
    """Return the change of the energy of motion, as a share."""
    return abs(energy_gain(engine, engine.scene, seconds, dt))


def measure_lag(engine, seconds, dt):
    """Return the largest distance of a pendulum's bob, body 1, from its exact position."""
    length, worst = engine.scene.bodies[1].pos[0], 0.0
    for step, state in enumerate(watch(engine, seconds, lambda: engine.read(1), dt), 1):
        angle = find_pendulum_angle(step * dt, length)
        exact = length * math.sin(angle), length * math.cos(angle)
        worst = max(worst, math.dist(state[:2], exact))
    return worst


def measure_apexes(engine, seconds, dt):
    """Return the worst error of the first three apexes of a ball that keeps half its speed."""
    height, e = energy_height(engine, 1, dt) - 10, 0.5
    apexes, before = [], engine.read(1).vy
    for _ in range(round(seconds / dt)):
        engine.step(dt)
        vy = engine.read(1).vy
        if vy < 0 <= before:
            apexes.append(energy_height(engine, 1, dt) - 10)
        before = vy
    if len(apexes) < 3:
        return "stops bouncing"
    return max(abs(apexes[k] / (height * e ** (2 * k + 2)) - 1) for k in range(3))


swinging = partial(chain, 20, (20, 0))
heavy_on_light = partial(stack, 1, 100)
half_bounce = partial(drop, restitution=0.5)

QUESTIONS = {
    "tower": Question("tower of 20", tower, measure_sink, "sink", "px", 2),
    "stack": Question("100 kg on 1 kg", heavy_on_light, measure_sink, "sink", "px", 2),
    "chain": Question("swinging chain", swinging, measure_stretch, "worst link", "px", 3),
    "pendulum": Question("pendulum", pendulum, measure_lag, "distance", "px", pendulum_period()),
    "bounce": Question("three bounces", half_bounce, measure_apexes, "apex", "of the exact", 2.5),
}
