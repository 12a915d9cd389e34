"""The engines of the leaderboard: how to make each one, and its name there."""

from collections import namedtuple

import pymunk

from .. import compiled
from . import SUBSTEPS, Lesson, Pymunk, Stable
from .box2d import Box2D, Box2d, Box2d3, pyb2d3
from .npm import NODE, Planck, Rapier

# make(scene, substeps=number) builds the scene. lacks: what it does not have. its_own: its substeps
# where all others take the same number; None for that number.
Contestant = namedtuple("Contestant", "name words make lacks its_own", defaults=((), None))

SLOP = 0.01  # px, the overlap that pymunk is told to accept
RODS_PUSH = "rods that push"


def tuned_pymunk(scene, substeps):
    return Pymunk(scene, substeps=substeps, slop=SLOP * scene.unit)


def list_contestants():
    """Return the installed engines, and a sentence for each missing one."""
    found = [
        Contestant("lesson", "lesson's engine", Lesson, ("Springs",)),
        Contestant("stable", "stable engine", Stable),
    ]
    missing = []
    if compiled.find(compiled.FOLDERS):
        found.append(Contestant("compiled", "stable engine, compiled", compiled.Compiled))
    else:
        missing.append("The compiled stable engine: python -m experiments.compiled")
    words = f"pymunk {pymunk.version}"
    found += [
        Contestant("pymunk", f"{words} as it comes", Pymunk, its_own=1),
        Contestant("pymunk4", f"{words}, {SUBSTEPS} substeps, slop {SLOP}", tuned_pymunk),
    ]
    npm = NODE.versions if NODE else {}
    for there, words, engine, lacks, how in (
        (Box2D, f"Box2D {Box2D and Box2D.__version__}", Box2d, (), "pip install Box2D"),
        (pyb2d3, "Box2D v3.1", Box2d3, (), "pip install pyb2d3"),
        (npm.get("rapier"), f"Rapier {npm.get('rapier')}", Rapier, (RODS_PUSH,),
         "npm install @dimforge/rapier2d-compat"),
        (npm.get("planck"), f"planck {npm.get('planck')}", Planck, (), "npm install planck"),
    ):  # fmt: skip
        if there:
            found.append(Contestant(engine.name, words, engine, lacks))
        else:
            missing.append(f"{engine.__name__}: {how}")
    return found, missing
