"""Races: settled piles of 8 to 1000 balls in every engine, and in the same step as pymunk."""

import math
from dataclasses import replace

from .answers import milliseconds
from .compiled import Compiled
from .costs import repeated_times, shares
from .dials import COMPILED, LAUNCHED, LESSON, PYMUNK, STABLE
from .engines import Lesson, Pymunk, Stable
from .measures import deepest_overlap, finite, run
from .scenes import pile

# ---------------------------------------------------------------- piles of any size

SETTLE = 6.0  # s
STABLE_RATE, STABLE_SUBSTEPS = 60, 8
LARGE = 200  # balls: what has more takes its time
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
        row[name] = {"overlap": after(engine, 1 / rates[name], time_to_lie(count))}
    tick("asleep")
    engines["asleep"], rates["asleep"] = fall_asleep(sleepy), STABLE_RATE
    row["asleep"] = {"asleep": engines["asleep"].asleep()}
    going = [(engine, 1 / rates[name]) for name, engine in engines.items()]
    taken = repeated_times(going, effort.repeats, 1 if count > LARGE else effort.rounds)
    for name, times in zip(engines, taken, strict=True):
        row[name]["ms"] = milliseconds(times)
        row[name]["ratio"] = shares(taken[0], times)
    return row


SAME_STEP = (1, 2, 3, 4)  # substeps of the stable engine


def same_step(count, effort, tick=lambda name: None):
    """A settled pile in steps of 1/120 s: overlap, and time in shares of pymunk's.

    The stable engine comes with each number of substeps: the fewest that are accurate enough tell
    what a step of the same quality takes. A large pile is run as machine code alone, where
    there is ours.
    """
    tick("settling")
    scene = settled(count)
    stables = [COMPILED] if Compiled.package else []
    if count <= LARGE or not stables:
        stables = [STABLE, *stables]
    lesson = [LESSON] if count <= LARGE else []
    dials = [replace(setting, substeps=n) for setting in stables for n in SAME_STEP]
    settings = [PYMUNK, *lesson, *dials]
    engines = [setting.build(scene) for setting in settings]
    overlaps = []
    for setting, engine in zip(settings, engines, strict=True):
        tick(setting.engine)
        overlaps.append(after(engine, setting.dt, time_to_lie(count)))
    going = [(engine, setting.dt) for setting, engine in zip(settings, engines, strict=True)]
    taken = repeated_times(going, effort.repeats, effort.rounds)
    ratios = [shares(times, taken[0]) for times in taken]
    rows = [
        {"engine": setting.engine, "substeps": setting.substeps, "overlap": deepest, "ratio": ratio}
        for setting, deepest, ratio in zip(settings, overlaps, ratios, strict=True)
    ]
    return {"balls": count, "rows": rows}


def time_to_lie(count):
    """How long a pile runs on until it lies as an engine leaves it, s."""
    return 0.5 if count > LARGE else 2.0


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
    grown = shares(by_count.get(many), by_count.get(few))
    return grown and [factor * few / many for factor in grown]
