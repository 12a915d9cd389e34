"""Settled piles in every engine, in steps of 1/120 s: the overlap, and what it costs."""

import math
from dataclasses import replace

from ..compiled import Compiled
from ..engines import Stable
from ..measures import run
from ..scenes import pile
from .costs import shares
from .questions import COMPILED, LESSON, PYMUNK, STABLE, Question, measure_overlap
from .runs import add_times, run_setting

SETTLE = 6.0  # s
SETTLE_RATE, SETTLE_SUBSTEPS = 60, 8
SUBSTEPS = (1, 4)  # of the stable engine


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


def study_pile(count, effort, tick=lambda engine: None):
    """Return the overlap of a settled pile in each engine, and its time in shares of pymunk's.

    Each engine first runs until the pile has settled in that engine.
    """
    scene = settle_pile(count)
    effort = replace(effort, scale=1.0)  # less time would leave the pile in motion
    question = Question(f"pile of {count}", lambda: scene, measure_overlap, "overlap", "px", 2.0)
    runs = []
    for setting in choose_settings():
        tick(setting.engine)
        runs.append(run_setting(question, setting, effort))
    add_times(runs, effort)
    for row in runs:
        row["ratio"] = shares(row["ms"], runs[0]["ms"])
    return {"title": question.title, "balls": count, "runs": runs}


def choose_settings():
    """Return the settings that run a pile, pymunk first."""
    stable = [STABLE, COMPILED] if Compiled.package else [STABLE]
    return [PYMUNK, LESSON, *(replace(one, substeps=n) for one in stable for n in SUBSTEPS)]
