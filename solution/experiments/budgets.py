"""What error each engine reaches in a given time per frame, what an equal error takes, and more.

Six scenes, each with one error whose exact value is 0. Every engine makes ever more substeps of its
steps of 1/120 s, until a frame takes longer than the largest budget: those settings are its ladder.
The time of each is measured again and again, so that it has a range.
"""

import math
from dataclasses import replace
from itertools import count
from statistics import median

from .answers import EXACT, FRAMES, answer, milliseconds
from .compiled import Compiled
from .costs import repeated_times, shares, spread, time_slice
from .dials import (
    BOX2D,
    COMPILED,
    LESSON,
    PYMUNK,
    SHARE,
    STABLE,
    Question,
    or_fell_through,
    rebounds,
    sink,
    worst_link,
)
from .engines import ENGINES
from .measures import run, speed, swing_energy, watch
from .scenes import chain, drop, pendulum, stack, tower, train

BUDGETS, QUICK_BUDGETS = (1.0, 4.0, 16.0), (1.0,)  # ms of each frame
GAIN = 2  # of a step of the ladder: substeps
CATCH_UP = 1.3  # a setting that takes longer than the largest budget by this factor is not run


def half_swing(engine, seconds, dt):
    """How far half a swing of a pendulum is off, from one passage of the lowest point to the next.

    The bob is body 1 and the peg at x = 0. When x is 0 comes from the four places around it.
    """
    places = [engine.read(1).x, *watch(engine, seconds, lambda: engine.read(1).x, dt)]
    sides = range(2, len(places) - 1)
    passages = [when_zero(places[i - 2 : i + 2], i - 2) for i in sides if crosses(places, i)]
    if len(passages) < 2:
        return {"half a swing": "never swings back"}
    found = (passages[1] - passages[0]) * dt
    return {"half a swing": abs(2 * found / engine.scene.exact["period"] - 1)}


def crosses(places, i):
    """Whether the bob passes x = 0 between place i - 1 and place i."""
    return (places[i - 1] > 0) != (places[i] > 0)


def when_zero(places, first):
    """The step at which x is 0, by the cubic through four places, of which this is the first."""
    when = 0.0
    for i, x in enumerate(places):
        others = [other for j, other in enumerate(places) if j != i]
        when += (first + i) * math.prod(other / (other - x) for other in others)
    return when


def apexes(engine, seconds, dt):
    """The worst of the first three apexes of a ball that keeps half its speed."""
    return {"apex": rebounds(engine, seconds, dt)["apex"]}


def push(engine, seconds, dt):
    """How far the speeds of a train are off, the worst ball's, when it has rolled for so long."""
    run(engine, seconds, dt)
    exact = engine.scene.exact["acceleration"] * seconds
    off = max(abs(speed(engine.read(i)) / exact - 1) for i in engine.scene.moving())
    return or_fell_through(engine, {"speed": off})


SCENES = {
    "pendulum": Question("pendulum", pendulum, half_swing, {"half a swing": SHARE}, 2.4),
    "chain": Question(
        "swinging chain", lambda: chain(20, (20, 0)), worst_link, {"worst link": "px"}, 3
    ),
    "tower": Question("tower of 20", tower, sink, {"sink": "px"}, 2),
    "heavy on light": Question("100 kg on 1 kg", lambda: stack(1, 100), sink, {"sink": "px"}, 2),
    "bounce": Question(
        "three bounces", lambda: drop(restitution=0.5), apexes, {"apex": SHARE}, 2.5
    ),
    "friction": Question("train of 10 on a slope", train, push, {"speed": SHARE}, 1),
}


ALL = ("lesson", "stable", "compiled", "pymunk", "box2d")


def families():
    """Each engine's settings with one substep; a ladder climbs from each of them.

    The lesson's engine may also share out its passes, and pymunk is also told to leave no overlap
    alone: of its own accord it leaves 0.1 px.
    """
    found = {
        "lesson": [LESSON, replace(LESSON, passes=1)],
        "stable": [replace(STABLE, substeps=1)],
        "compiled": [replace(COMPILED, substeps=1)] if Compiled.package else [],
        "pymunk": [PYMUNK, replace(PYMUNK, slop=0.0)],
        "box2d": [BOX2D] if "box2d" in ENGINES else [],
    }
    return {engine: settings for engine, settings in found.items() if settings}


def study(name, effort, tick=lambda engine: None):
    """One scene: the errors and times of all engines' settings, and what follows from them."""
    question = SCENES[name]
    (error, unit), *_ = question.units.items()
    budgets = QUICK_BUDGETS if effort.quick else BUDGETS
    runs = []
    for engine, settings in families().items():
        tick(engine)
        for setting in settings:
            runs += climb(question, setting, budgets[-1], effort)
    going = [(row.pop("in motion"), row.pop("dt")) for row in runs]
    taken = repeated_times(going, effort.repeats, effort.rounds)
    for row, times in zip(runs, taken, strict=True):
        row["ms"] = milliseconds(times)
    engines = list(families())
    return {
        "title": question.title,
        "error": error,
        "unit": unit,
        "seconds": effort.seconds(question),
        "runs": runs,
        "within": {
            engine: [within(runs, engine, ms) | {"budget": ms} for ms in budgets]
            for engine in engines
        },
        "equal": equal(runs, engines),
    }


def climb(question, setting, budget, effort):
    """The runs of a ladder, up to the first that takes longer than the budget by far."""
    runs = []
    for step in count():
        higher = replace(setting, substeps=GAIN**step)
        trial = higher.build(question.scene())
        taken = [time_slice(trial, higher.dt) for _ in range(3)]
        slow = None not in taken and 1000 * min(taken) / FRAMES > CATCH_UP * budget
        asked = higher.engine == "stable" and higher.substeps <= STABLE.substeps  # see equal
        if slow and not asked:
            return runs
        found = answer(question, higher, effort)
        (error,) = found["errors"].values()
        runs.append(
            {
                "engine": setting.engine,
                "passes": None if setting.engine in ("stable", "compiled") else setting.passes,
                "substeps": higher.substeps,
                "slop": setting.slop,
                "error": error,
                "in motion": found["in motion"],
                "dt": higher.dt,
            }
        )
        if None in taken:
            return runs
    return runs


# ---------------------------------------------------------------- what follows


def least(runs, budget, which):
    """The smallest error of the runs that fit, or a word: how they gave up, or that none fits.

    which is that of the three times that spread gives of a run.
    """
    fitting = [row["error"] for row in runs if row["ms"] and spread(row["ms"])[which] <= budget]
    known = [error for error in fitting if not isinstance(error, str)]
    return min(known, default=(fitting or ["too slow"])[-1])


def within(runs, engine, budget):
    """The smallest error an engine reaches in so many ms a frame, in its middle repeat.

    With it what it reaches in its fastest repeat, and in its slowest.
    """
    ours = [row for row in runs if row["engine"] == engine]
    fast, middle, slow = (least(ours, budget, which) for which in range(3))
    return {"error": middle, "range": [fast, slow]}


def winners(scene):
    """The engines with the smallest error in the largest budget, as far as repeats tell them apart.

    Errors below EXACT are all the same.
    """
    last = {engine: cells[-1]["range"] for engine, cells in scene["within"].items()}
    known = {
        engine: [max(end, EXACT) for end in ends]
        for engine, ends in last.items()
        if not any(isinstance(end, str) for end in ends)
    }
    least = min((max(ends) for ends in known.values()), default=0.0)
    return [engine for engine, ends in known.items() if min(ends) <= least]


def equal(runs, engines):
    """The time each engine takes for the error of the stable engine at its defaults, or less.

    Errors below EXACT are all the same. The time is that of the setting that takes least, in shares
    of the stable engine's. Where none gets there in the largest budget, the closest is given.
    """
    (goal,) = (r for r in runs if r["engine"] == "stable" and r["substeps"] == STABLE.substeps)
    aim = -1.0 if isinstance(goal["error"], str) else max(goal["error"], EXACT)
    rows = []
    for engine in engines:
        ours = [row for row in runs if row["engine"] == engine and row["ms"]]
        known = [row for row in ours if not isinstance(row["error"], str)]
        there = [row for row in known if row["error"] <= aim]
        best = min(there, key=lambda row: median(row["ms"]), default=None)
        closest = min(known, key=lambda row: row["error"], default=None)
        shown = best or closest
        found = {"engine": engine, "reached": best is not None}
        if shown:
            found |= {key: shown[key] for key in ("error", "passes", "substeps", "slop")}
            found["ratio"] = shares(shown["ms"], goal["ms"])
        rows.append(found)
    return {"goal": goal["error"], "rows": rows}


# ---------------------------------------------------------------- the energy of a chain

LINKS = 10
LOOKS, QUICK_LOOKS = (1, 10, 60), (1, 10)  # s, when the energy is looked at


def chain_energy(effort, tick=lambda engine: None):
    """The energy that a swinging chain still has, as a share of what it is let go with.

    Nothing takes any, so the share should be 1. It is the mean over one second up to each look.
    """
    scene = chain(LINKS, (20, 0))
    rows = []
    for setting in (LESSON, STABLE, PYMUNK, BOX2D):
        if setting.engine in ENGINES:
            tick(setting.engine)
            rows.append({"engine": setting.engine, "shares": kept(setting, scene, effort)})
    return {"links": LINKS, "looks": QUICK_LOOKS if effort.quick else LOOKS, "rows": rows}


def kept(setting, scene, effort):
    """The share at each look, or a word for how the engine gave up."""
    engine, past, found = setting.build(scene), 0.0, []
    first = swing_energy(engine, setting.dt)
    for look in QUICK_LOOKS if effort.quick else LOOKS:
        try:
            run(engine, effort.scale * (look - 1 - past), setting.dt)
            seen = watch(engine, effort.scale, lambda: swing_energy(engine, setting.dt), setting.dt)
        except Exception as problem:  # NaN, or a student's code
            return [*found, type(problem).__name__]
        share = sum(seen) / len(seen) / first
        found.append(share if math.isfinite(share) else "NaN")
        past = look
    return found
