"""Settled piles in every engine, in steps of 1/120 s: the overlap, and what it costs."""

import math
from dataclasses import replace

from .compiled import Compiled
from .costs import shares
from .engines import Stable
from .measures import run
from .questions import COMPILED, LESSON, PYMUNK, STABLE, Question, measure_overlap
from .runs import add_costs, run_setting
from .scenes import pile

SETTLE = 6.0  # s
SETTLE_RATE, SETTLE_SUBSTEPS = 60, 8
LARGE = 200  # balls: larger piles run as machine code only, where there is ours
SUBSTEPS = (1, 2, 3, 4)  # of the stable engine


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

    Each engine first runs on until the pile lies as that engine leaves it. The fewest substeps of
    the stable engine that are accurate enough tell what a step of the same quality costs.
    """
    scene, seconds = settle_pile(count), 0.5 if count > LARGE else 2.0
    effort = replace(effort, scale=1.0)  # less time would leave the pile in motion
    question = Question("pile", lambda: scene, measure_overlap, "overlap", "px", seconds)
    runs = []
    for setting in choose_settings(count):
        tick(setting.engine)
        runs.append(run_setting(question, setting, effort))
    add_costs(runs, effort)
    for row in runs:
        row["ratio"] = shares(row["ms"], runs[0]["ms"])
    return {"balls": count, "runs": runs}


def choose_settings(count):
    """Return pymunk first, then all other settings that run a pile of this size."""
    small = count <= LARGE
    stable = [STABLE] if small or not Compiled.package else []
    stable += [COMPILED] if Compiled.package else []
    lesson = [LESSON] if small else []
    return [PYMUNK, *lesson, *(replace(one, substeps=n) for one in stable for n in SUBSTEPS)]
