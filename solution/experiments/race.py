"""Races: time at equal accuracy against pymunk, piles of 8 to 1000 balls, and the same step."""

import math
from dataclasses import dataclass, replace

from .compiled import Compiled
from .costs import wall_times
from .dials import COMPILED, LAUNCHED, LESSON, PYMUNK, QUESTIONS, STABLE
from .engines import Lesson, Pymunk, Stable
from .measures import deepest_overlap, finite, run
from .scenes import pile

RATES = (120, 240, 480, 960)  # of pymunk, steps per second
PASSES = (10, 40, 160, 640)  # of pymunk
SECONDS = 10.0  # pymunk sinks slowly: a shorter run flatters it
SLOPS = (None, 0.0)  # px: the overlap pymunk leaves alone, its own choice (0.1) and none


# ---------------------------------------------------------------- equal accuracy


@dataclass(frozen=True)
class Rival:
    """pymunk with its iterations and step, and with the overlap that it leaves alone."""

    rate: int
    passes: int
    slop: object  # px, or None for its own choice

    def build(self, scene):
        engine = replace(PYMUNK, rate=self.rate, passes=self.passes).build(scene)
        if self.slop is not None:
            engine.space.collision_slop = self.slop
        return engine

    @property
    def dt(self):
        return 1 / self.rate


def equal_accuracy(name, effort, tick=lambda setting: None):
    """The cheapest pymunk that sinks no more than the stable engine at its defaults."""
    question = QUESTIONS[name]
    rates, passes = (RATES[::2], PASSES[:2]) if effort.quick else (RATES, PASSES)
    stable = attempt(question, STABLE, effort)
    rows = []
    for slop in SLOPS:
        rivals = []
        for rate in rates:
            for count in passes:
                tick((rate, count))
                rivals.append(attempt(question, Rival(rate, count, slop), effort))
        rows.append(cheapest(stable, rivals, slop, effort))
    return {"title": question.title, "stable": stable["sink"], "rows": rows}


def attempt(question, setting, effort):
    """One run: its sink, or a word for how it gave up."""
    engine = setting.build(question.scene())
    seconds = effort.scale * SECONDS
    sink = question.ask(engine, seconds, setting.dt)["sink"]
    sink = sink if isinstance(sink, str) or math.isfinite(sink) else "NaN"
    return {"setting": setting, "engine": engine, "sink": sink}


def cheapest(stable, rivals, slop, effort):
    """The fastest rival as accurate as the stable engine, in shares of its time, and the closest.

    A negative sink is a stack pushed apart: its size counts, as for any error.
    """
    going = [(one["engine"], one["setting"].dt) for one in [stable, *rivals]]
    unit, *taken = wall_times(going, effort.rounds)
    known = [
        (abs(one["sink"]), seconds, one["setting"])
        for one, seconds in zip(rivals, taken, strict=True)
        if not isinstance(one["sink"], str)
    ]
    goal = stable["sink"]
    there = [] if isinstance(goal, str) else [row for row in known if row[0] <= goal]
    best = min(there, key=lambda row: row[1], default=None)
    closest = min(known, key=lambda row: row[0], default=None)
    return {
        "slop": slop,
        "reached": best is not None,
        "best": described(best, unit),
        "closest": described(closest, unit),
    }


def described(row, unit):
    if row is None:
        return None
    sink, seconds, setting = row
    return {
        "sink": sink,
        "ratio": seconds / unit,
        "rate": setting.rate,
        "passes": setting.passes,
    }


# ---------------------------------------------------------------- piles of any size

SETTLE = 6.0  # s
STABLE_RATE, STABLE_SUBSTEPS = 60, 8
SLEEP_LIMIT = 20.0  # s: after that a pile that is not asleep will not be


def settled(count):
    """A pile of so many balls at rest, as a scene; the stable engine brings it to rest.

    The bin grows with the root of the number, so that piles of all sizes have one shape.
    """
    scene = pile(count, 600 * math.sqrt(count / 200))
    engine = Stable(scene, STABLE_SUBSTEPS)
    run(engine, SETTLE, 1 / STABLE_RATE)
    bodies = list(scene.bodies)
    for i in scene.moving():
        now = engine.read(i)
        bodies[i] = replace(bodies[i], pos=(now.x, now.y), vel=(now.vx, now.vy), omega=now.omega)
    return replace(scene, bodies=bodies)


def pile_row(count, effort, tick=lambda name: None):
    """One settled pile in every engine: time per simulated second, and the deepest overlap.

    Each engine first runs on until the pile lies as that engine leaves it.
    """
    tick("settling")
    scene = settled(count)
    sleepy = replace(scene, effects=(*scene.effects, "Sleep"))
    rates = {"lesson": LESSON.rate, "stable": STABLE_RATE, "pymunk": PYMUNK.rate}
    engines = {
        "lesson": Lesson(scene),
        "stable": Stable(scene, STABLE_SUBSTEPS),
        "pymunk": Pymunk(scene),
    }
    if Compiled.package:
        engines["compiled"], rates["compiled"] = Compiled(scene, STABLE_SUBSTEPS), STABLE_RATE
    row = {"balls": count}
    for name, engine in engines.items():
        tick(name)
        row[name] = {"overlap": after(engine, 1 / rates[name], 0.5 if count > 200 else 2.0)}
    tick("asleep")
    engines["asleep"], rates["asleep"] = fall_asleep(sleepy), STABLE_RATE
    row["asleep"] = {"asleep": engines["asleep"].asleep()}
    going = [(engine, 1 / rates[name]) for name, engine in engines.items()]
    taken = wall_times(going, 4 if count > 200 else effort.rounds)
    for name, seconds in zip(engines, taken, strict=True):
        row[name]["ms"] = None if seconds is None else 1000 * seconds
        row[name]["ratio"] = seconds / taken[0] if seconds and taken[0] else None
    return row


SAME_STEP = (1, 2, 3, 4)  # substeps of the stable engine


def same_step(count, effort, tick=lambda name: None):
    """A settled pile in steps of 1/120 s: overlap, and time in shares of pymunk's.

    The stable engine comes with each number of substeps: the fewest that are accurate enough tell
    what a step of the same quality takes.
    """
    tick("settling")
    scene = settled(count)
    stables = [STABLE, COMPILED] if Compiled.package else [STABLE]
    dials = [replace(setting, substeps=n) for setting in stables for n in SAME_STEP]
    settings = [PYMUNK, LESSON, *dials]
    engines = [setting.build(scene) for setting in settings]
    overlaps = []
    for setting, engine in zip(settings, engines, strict=True):
        tick(setting.engine)
        overlaps.append(after(engine, setting.dt, 2.0))
    going = [(engine, setting.dt) for setting, engine in zip(settings, engines, strict=True)]
    unit, *others = wall_times(going, effort.rounds)
    ratios = [1.0, *(seconds / unit if seconds and unit else None for seconds in others)]
    rows = [
        {"engine": setting.engine, "substeps": setting.substeps, "overlap": deepest, "ratio": ratio}
        for setting, deepest, ratio in zip(settings, overlaps, ratios, strict=True)
    ]
    return {"balls": count, "rows": rows}


def after(engine, dt, seconds):
    """The deepest overlap after so long, or a word for how the engine gave up."""
    try:
        run(engine, seconds, dt)
    except Exception:  # NaN, or a student's code
        return "NaN"
    if not finite(engine):
        return "NaN"
    if any(engine.read(i).y > LAUNCHED for i in engine.scene.moving()):
        return "falls through"
    return deepest_overlap(engine)


def fall_asleep(scene):
    """The pile in the stable engine, run until all balls sleep or SLEEP_LIMIT has passed."""
    engine = Stable(scene, STABLE_SUBSTEPS)
    for _ in range(round(SLEEP_LIMIT * STABLE_RATE)):
        if engine.asleep() == len(scene.moving()):
            break
        engine.step(1 / STABLE_RATE)
    return engine


def growth(rows, name, few=200, many=1000):
    """How much more a ball costs in the larger pile than in the smaller, or None."""
    by_count = {row["balls"]: row[name].get("ms") for row in rows}
    if not by_count.get(few) or not by_count.get(many):
        return None
    return by_count[many] / by_count[few] * few / many
