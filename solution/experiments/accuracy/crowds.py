"""Settled piles and a gas in every engine, in steps of 1/120 s: the error, and what it costs."""

import math
from dataclasses import replace
from functools import cache, partial

from ..compiled import Compiled
from ..engines import Stable
from ..measures import run
from ..rows.hits import gas
from ..scenes import pile
from .costs import shares
from .questions import COMPILED, LESSON, PYMUNK, STABLE, Question, measure_overlap, measure_warming
from .runs import add_times, describe, run_setting

SETTLE = 6.0  # s
SETTLE_RATE, SETTLE_SUBSTEPS = 60, 8
SUBSTEPS = (1, 4)  # of the stable engine


@cache
def settle_pile(count):
    """Return a pile of `count` balls at rest, as a scene; the stable engine brings it to rest.

    The bin grows with the root of the number, so that piles of all sizes have one shape.
    """
    scene = pile(count, 600 * math.sqrt(count / 200))
    engine = Stable(scene, SETTLE_SUBSTEPS)
    run(engine, SETTLE, 1 / SETTLE_RATE)
    bodies = list(scene.bodies)
    for i in scene.moving():
        now = engine.read(i)
        bodies[i] = replace(bodies[i], pos=(now.x, now.y), vel=(now.vx, now.vy), omega=now.omega)
    return replace(scene, bodies=bodies)


def ask_pile(count):
    """Return the question how deep the balls of a pile at rest overlap."""
    scene = partial(settle_pile, count)
    return Question(f"pile of {count}", scene, measure_overlap, "overlap", "px", 2.0)


GAS = Question("gas of 200", partial(gas, 200), measure_warming, "energy off", "of the start", 2.0)
CROWDS = [ask_pile(40), ask_pile(200), GAS]


def study_crowd(question, effort, tick=lambda engine: None):
    """Return the error in each engine, once piles have settled, and its time, pymunk's being 1."""
    effort = replace(effort, scale=1.0)  # less time would leave a pile in motion
    runs = []
    for setting in choose_settings():
        tick(setting.engine)
        runs.append(run_setting(question, setting, effort))
    add_times(runs, effort)
    for row in runs:
        row["ratio"] = shares(row["ms"], runs[0]["ms"])
    return {**describe(question, effort), "runs": runs}


def choose_settings():
    """Return the settings that run a crowd, pymunk first."""
    stable = [STABLE, COMPILED] if Compiled.package else [STABLE]
    return [PYMUNK, LESSON, *(replace(one, substeps=n) for one in stable for n in SUBSTEPS)]
