"""Contacts and rods against dials: questions with exact answers, and settings to answer them.

A question runs an engine and returns errors by name, a number each or a word for how it gave up.
"""

import math
from dataclasses import dataclass, replace

from .compiled import Compiled
from .edits import EDITS
from .engines import BOX2D_PASSES, ENGINES, PASSES, SUBSTEPS, Lesson, Pymunk, Stable
from .measures import (
    deepest_overlap,
    energy_height,
    run,
    speed,
    stretches,
    swinging,
    watch,
    worst_stretch,
)
from .scenes import (
    BOUNCE,
    Ball,
    G,
    Scene,
    chain,
    cradle,
    drop,
    incline,
    pendulum,
    pile,
    slide,
    stack,
    tower,
)

LAUNCHED = 1.0  # px: a heavy ball that rises by more was thrown, and did not sink
RATE = 120  # steps per second, of the lesson
RATES = (60, 90, 120, 240, 480)
CHANCE = 0.5  # a pile's overlap with other balls: from 0.015 to 0.031 px in the stable engine
SHARED = "shared substeps"  # of the lesson's engine: they share the 8 passes of a step


# ---------------------------------------------------------------- settings


@dataclass(frozen=True)
class Setting:
    """An engine and where its dials stand."""

    engine: str
    rate: int = RATE  # steps per second
    passes: int = 8  # of all but the stable engine
    substeps: int = 1
    edits: tuple = ()  # of the lesson's engine
    slop: float | None = None  # px: the overlap that pymunk leaves alone, or its own choice (0.1)

    def build(self, scene):
        if self.engine == "lesson":
            return Lesson(scene, self.passes, self.substeps, self.edits)
        if self.engine == "stable":
            return Stable(scene, self.substeps)
        if self.engine == "compiled":
            return Compiled(scene, self.substeps)
        if self.engine == "pymunk":
            return Pymunk(scene, self.passes, self.substeps, self.slop)
        return ENGINES[self.engine](scene, self.passes, self.substeps)

    @property
    def dt(self):
        return 1 / self.rate

    def solves(self, engine):
        """How often contacts and rods are solved per second, as they are now.

        The stable engine looks at each twice per substep: to solve it and to relax it.
        """
        passes = 2 if self.engine == "stable" else self.passes
        ties = engine.contacts() + len(engine.scene.rods)
        return self.rate * self.substeps * passes * ties


LESSON = Setting("lesson")
STABLE = Setting("stable", substeps=SUBSTEPS)
COMPILED = Setting("compiled", substeps=SUBSTEPS)
PYMUNK = Setting("pymunk", passes=PASSES)
BOX2D = Setting("box2d", passes=BOX2D_PASSES)


def dials(quick=False):
    """Rows of (engine, dial, [(value, setting), ...]); each passes through the engine's default.

    Quick rows have the first and the last value and the default: what a dial does is judged by the
    first and the last, so it comes out the same.
    """
    rates = (60, 120, 480) if quick else RATES
    fewer = slice(None, None, 2) if quick else slice(None)
    rows = [
        ("lesson", "passes", by_passes(LESSON, (4, 8, 64) if quick else (4, 8, 16, 32, 64))),
        ("lesson", "step", by_rate(LESSON, rates)),
        ("lesson", SHARED, shared_passes((1, 2, 8) if quick else (1, 2, 4, 8))),
        ("lesson", "edits", by_edits(quick)),
        ("stable", "substeps", by_substeps(STABLE, (1, 2, 4, 8, 16)[fewer])),
        ("stable", "step", by_rate(STABLE, rates)),
        ("pymunk", "passes", by_passes(PYMUNK, (5, 10, 80) if quick else (5, 10, 20, 40, 80))),
        ("pymunk", "step", by_rate(PYMUNK, rates)),
        ("pymunk", "substeps", by_substeps(PYMUNK, (1, 2, 4, 8, 16)[fewer])),
    ]
    if "box2d" in ENGINES:
        passes = (4, 8, 64) if quick else (4, 8, 16, 32, 64)
        rows.append(("box2d", "passes", by_passes(BOX2D, passes)))
        rows.append(("box2d", "step", by_rate(BOX2D, rates)))
    return rows


def by_passes(setting, counts):
    return [(n, replace(setting, passes=n)) for n in counts]


def by_rate(setting, rates):
    return [(f"1/{rate}", replace(setting, rate=rate)) for rate in rates]


def by_substeps(setting, counts):
    return [(n, replace(setting, substeps=n)) for n in counts]


def shared_passes(counts):
    """So many substeps that share the eight passes of one step."""
    return [(n, replace(LESSON, substeps=n, passes=8 // n)) for n in counts]


def by_edits(quick):
    sets = [(), EDITS] if quick else [(), *((edit,) for edit in EDITS), EDITS]
    names = {(): "none", EDITS: "all"}
    return [(names.get(s, *s[:1]), replace(LESSON, edits=s)) for s in sets]


# ---------------------------------------------------------------- questions


@dataclass
class Question:
    """What is asked of a scene. Its errors are numbers, or words for how an engine gave up."""

    title: str
    scene: object  # makes it
    ask: object  # ask(engine, seconds, dt)
    units: dict  # name of an error: its unit
    seconds: float
    quick: bool = True  # whether it belongs to the quick run
    chance: float = 0.0  # the share of an error that the start decides: see pile


def or_fell_through(engine, errors):
    """The errors, or that they mean nothing because a ball is below the floor at y = 0."""
    if any(engine.read(i).y > 0 for i in engine.scene.moving()):
        return dict.fromkeys(errors, "falls through")
    return errors


def sink(engine, seconds, dt):
    """How far the top of a stack ever comes down: some engines let it sink and push it up again."""
    top = engine.scene.moving()[-1]
    start = engine.read(top).y
    drops = watch(engine, seconds, lambda: engine.read(top).y - start, dt)
    sunk = "launched" if min(drops) < -LAUNCHED else max(0.0, *drops)
    return or_fell_through(engine, {"sink": sunk})


def swing(engine, seconds, dt):
    """A pendulum's rod, period and energy."""
    stretch, period, change = swinging(engine, seconds, dt)
    off = "never swings back"
    if period is not None:
        off = abs(period / engine.scene.exact["period"] - 1)
    return {"stretch": stretch, "period": off, "energy": abs(change) / 140}


def hang(engine, seconds, dt):
    """How much longer a hanging chain gets."""
    run(engine, seconds, dt)
    return {"stretch": sum(stretches(engine))}


def worst_link(engine, seconds, dt):
    return {"worst link": max(watch(engine, seconds, lambda: worst_stretch(engine), dt))}


def settle(engine, seconds, dt):
    run(engine, seconds, dt)
    return or_fell_through(engine, {"overlap": deepest_overlap(engine)})


def keep_bouncing(engine, seconds, dt):
    """How far the apex of a ball that loses nothing is off in the end."""
    start = energy_height(engine, 1, dt) - 10
    run(engine, seconds, dt)
    return or_fell_through(engine, {"apex": abs((energy_height(engine, 1, dt) - 10) / start - 1)})


def rebounds(engine, seconds, dt):
    """The first three apexes of a ball with e = 0.5, h e^2k, and when it reaches the third."""
    height, e = energy_height(engine, 1, dt) - 10, 0.5
    apexes, times = [], []
    before = engine.read(1).vy
    for i in range(round(seconds / dt)):
        engine.step(dt)
        vy = engine.read(1).vy
        if vy < 0 <= before:
            apexes.append(energy_height(engine, 1, dt) - 10)
            times.append((i + 1) * dt - (vy + G * engine.lag(dt)) / G)
        before = vy
    if len(apexes) < 3:
        return {"apex": "stops bouncing", "time": "stops bouncing"}
    exact = math.sqrt(2 * height / G) * (1 + 2 * e + 2 * e**2 + e**3)
    worst = max(abs(apexes[k] / (height * e ** (2 * k + 2)) - 1) for k in range(3))
    return {"apex": worst, "time": abs(times[2] / exact - 1)}


def roll(engine, seconds, dt):
    """When a sliding ball would roll, seen from its slip after 0.1 s, and its speed in the end."""
    first = round(0.1 / dt)
    run(engine, first * dt, dt)
    ball = engine.read(1)
    slip = abs(ball.vx - 10 * ball.omega) / 300
    when = first * dt / (1 - slip) if slip < 1 else math.inf
    run(engine, seconds - first * dt, dt)
    last = engine.read(1).vx
    errors = {"time": abs(when / (300 / (3 * 0.6 * G)) - 1), "speed": abs(last / 200 - 1)}
    return or_fell_through(engine, errors)


def accelerate(engine, seconds, dt):
    run(engine, seconds / 2, dt)
    before = engine.read(1).vx
    run(engine, seconds / 2, dt)
    found = (engine.read(1).vx - before) / (round(seconds / 2 / dt) * dt)
    return or_fell_through(
        engine, {"acceleration": abs(found / engine.scene.exact["acceleration"] - 1)}
    )


def pass_on(engine, seconds, dt):
    """A cradle: the last ball should leave with all the speed, the others rest."""
    run(engine, seconds, dt)
    *others, last = (engine.read(i) for i in engine.scene.moving())
    exact = engine.scene.exact["last"]
    rest = max(speed(state) for state in others) / exact
    return {"last": abs(last.vx / exact - 1), "others": rest}


def hit(speed=300.0, e=0.8):
    """A ball of 1 kg hits one of 3 kg head on, with no gravity."""
    surface = {"restitution": e, "friction": 0.0}
    balls = [Ball((-60, 0), vel=(speed, 0.0), **surface), Ball((0, 0), mass=3.0, **surface)]
    exact = {"speeds": ((1 - 3 * e) / 4 * speed, (1 + e) / 4 * speed), "momentum": speed}
    return Scene(balls, BOUNCE, gravity=(0, 0), exact=exact)


def collide(engine, seconds, dt):
    run(engine, seconds, dt)
    found = [engine.read(i).vx for i in (0, 1)]
    exact = engine.scene.exact
    off = max(abs(v - right) for v, right in zip(found, exact["speeds"], strict=True))
    momentum = found[0] + 3 * found[1]
    whole = exact["momentum"]
    return {"speeds": off / whole, "momentum": abs(momentum / whole - 1)}


def small_pile():
    return pile(40, 268)


SINK = {"sink": "px"}
SHARE = "of the exact"

QUESTIONS = {
    "tower": Question("tower of 20 balls", tower, sink, SINK, 2),
    "stack": Question("100 kg on 1 kg", lambda: stack(1, 100), sink, SINK, 2),
    "pendulum": Question(
        "pendulum let go at 90°",
        pendulum,
        swing,
        {"stretch": "px", "period": SHARE, "energy": "of the rod's length, as height"},
        30,
    ),
    "hanging": Question("hanging chain of 20", lambda: chain(20), hang, {"stretch": "px"}, 4),
    "swinging": Question(
        "swinging chain of 20", lambda: chain(20, (20, 0)), worst_link, {"worst link": "px"}, 3
    ),
    "pile": Question(
        "pile of balls", small_pile, settle, {"overlap": "px"}, 5, quick=False, chance=CHANCE
    ),
    "bounce": Question("ball that keeps all its speed", drop, keep_bouncing, {"apex": SHARE}, 60),
    "rebounds": Question(
        "ball that keeps half its speed",
        lambda: drop(restitution=0.5),
        rebounds,
        {"apex": SHARE, "time": SHARE},
        2.5,
    ),
    "slide": Question("slide that ends rolling", slide, roll, {"time": SHARE, "speed": SHARE}, 2),
    "rolling": Question("slope of 20°, rolling", incline, accelerate, {"acceleration": SHARE}, 2),
    "sliding": Question(
        "slope of 75°, sliding", lambda: incline(75), accelerate, {"acceleration": SHARE}, 2
    ),
    "cradle": Question("cradle of 5", cradle, pass_on, {"last": SHARE, "others": SHARE}, 1),
    "hit": Question("two-ball hit", hit, collide, {"speeds": SHARE, "momentum": SHARE}, 1),
}


def questions(quick=False):
    """The names of the questions of a run. A pile is chaotic: a quick look at it says nothing."""
    return [name for name, question in QUESTIONS.items() if question.quick or not quick]
