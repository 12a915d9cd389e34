"""Questions with exact answers, the settings of each engine, and the dials that change them.

A question runs an engine and returns its error: a number, or a word for how the engine gave up.
"""

import math
from dataclasses import dataclass, replace
from functools import partial

from .compiled import Compiled
from .engines import BOX2D_PASSES, ENGINES, PASSES, SUBSTEPS
from .measures import deepest_overlap, energy_height, run, watch, worst_stretch
from .scenes import chain, drop, pendulum, stack, tower

LAUNCHED = 1.0  # px: a ball that rises by more was thrown, and did not sink
RATE = 120  # steps per second, of the lesson
SHARED = "shared substeps"  # of the lesson's engine: they share the 8 passes of a step


@dataclass(frozen=True)
class Setting:
    """An engine and the values of its dials."""

    engine: str
    passes: int | None = None  # None: the engine has none
    rate: int = RATE  # steps per second
    substeps: int = 1
    slop: float | None = None  # px: overlap that pymunk leaves alone; None: its own choice, 0.1

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
    """Return rows of (engine, dial, {value: setting}); each includes the engine's default.

    Quick rows have the first value, the last and the default: verdicts depend on these only.
    """

    def row(setting, dial, values, quick_values):
        chosen = quick_values if quick else values
        return setting.engine, dial, {value: replace(setting, **{dial: value}) for value in chosen}

    def steps(setting):
        rates = (60, 120, 480) if quick else (60, 90, 120, 240, 480)
        return setting.engine, "step", {f"1/{n}": replace(setting, rate=n) for n in rates}

    counts = (1, 2, 8) if quick else (1, 2, 4, 8)
    shared = {n: replace(LESSON, substeps=n, passes=8 // n) for n in counts}
    passes, substeps = ((4, 8, 16, 32, 64), (4, 8, 64)), ((1, 2, 4, 8, 16), (1, 4, 16))
    rows = [
        row(LESSON, "passes", *passes),
        steps(LESSON),
        ("lesson", SHARED, shared),
        row(STABLE, "substeps", *substeps),
        steps(STABLE),
        row(PYMUNK, "passes", (5, 10, 20, 40, 80), (5, 10, 80)),
        steps(PYMUNK),
        row(PYMUNK, "substeps", *substeps),
    ]
    if BOX2D.engine in ENGINES:
        rows += [row(BOX2D, "passes", *passes), steps(BOX2D)]
    return rows


def families():
    """Return each engine's settings with one substep, from which its substeps are increased.

    The lesson's engine also comes with one pass, and pymunk also without any overlap allowed.
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
    """Return how far the top of a stack comes down at most: some engines push it up again."""
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


def measure_half_swing(engine, seconds, dt):
    """Return the error of half a period, between two passages of the lowest point.

    The bob is body 1 and the peg at x = 0. A cubic through four positions tells when x is 0.
    """
    xs = [engine.read(1).x, *watch(engine, seconds, lambda: engine.read(1).x, dt)]
    crossings = [i for i in range(2, len(xs) - 1) if (xs[i - 1] > 0) != (xs[i] > 0)]
    if len(crossings) < 2:
        return "never swings back"
    first, second = (i - 2 + find_zero(xs[i - 2 : i + 2]) for i in crossings[:2])
    return abs(2 * (second - first) * dt / engine.scene.exact["period"] - 1)


def find_zero(xs):
    """Return the step at which x is 0, by the cubic through the values at steps 0, 1, 2, 3."""
    step = 0.0
    for i, x in enumerate(xs):
        others = [other for j, other in enumerate(xs) if j != i]
        step += i * math.prod(other / (other - x) for other in others)
    return step


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


SHARE = "of the exact"

swinging = partial(chain, 20, (20, 0))
heavy_on_light = partial(stack, 1, 100)
half_bounce = partial(drop, restitution=0.5)

# Every engine at more and more substeps, as long as a frame has time for them.
LADDERS = {
    "pendulum": Question("pendulum", pendulum, measure_half_swing, "half a swing", SHARE, 2.4),
    "chain": Question("swinging chain", swinging, measure_stretch, "worst link", "px", 3),
    "tower": Question("tower of 20", tower, measure_sink, "sink", "px", 2),
    "heavy on light": Question("100 kg on 1 kg", heavy_on_light, measure_sink, "sink", "px", 2),
    "bounce": Question("three bounces", half_bounce, measure_apexes, "apex", SHARE, 2.5),
}

# Every dial of every engine.
DIALS = {
    "tower": Question("tower of 20 balls", tower, measure_sink, "sink", "px", 2),
    "stack": Question("100 kg on 1 kg", heavy_on_light, measure_sink, "sink", "px", 2),
    "pendulum": Question("pendulum let go at 90°", pendulum, measure_stretch, "stretch", "px", 30),
    "swinging": Question("swinging chain of 20", swinging, measure_stretch, "worst link", "px", 3),
}
