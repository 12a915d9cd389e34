"""A published test set, on all engines.

python -m experiments.published [--quick] [--markdown FILE]

Adrian Boeing and Thomas Bräunl compared physics engines in "Evaluation of real-time physics
simulation systems" (GRAPHITE 2007, doi:10.1145/1321261.1321312), with the Physics Abstraction
Layer, PAL. These are their tests, for an engine of balls: integrator, restitution, friction,
constraints, collision, stacks. Emma Sundling's master's thesis "Validation toolbox for a physics
engine" (Umeå University, 2016) asks for falling, sliding and swinging bodies too.
"""

import math
import sys
from functools import partial

from . import scenes, trials
from .battery import Case, Figure, each, main
from .compiled import use_compiled
from .scenes import DT, G

FALL = 2.0  # s
DEGREES = 0.07  # 1 px/s of slip in 1 s takes a slope up to 0.06 degrees too steep; 0.01 for halving
HEIGHTS = (20, 290, 2000)  # px


def one_step(height):
    """How far (px) a ball that fell from a height gets in a step: so deep it may get unseen."""
    return math.sqrt(2 * G * height) * DT + G * DT**2


def heights(height):
    """Ten heights (px) within the way of one step: the overlap depends on how the steps fall."""
    return [height + one_step(height) * i / 10 for i in range(10)]


INTEGRATOR = [
    Case(
        f"integrator: {FALL:g} s of free fall",
        [partial(scenes.free_fall, FALL)],
        trials.fall,
        [
            Figure("error", "error of its place, px"),
            Figure("beyond", "beyond what is known of it, px", 0.0, "<", 1e-9),
        ],
        seconds=FALL,
    ),
]

RESTITUTION = [
    Case(
        f"restitution {e}",
        [partial(scenes.drop, restitution=e)],
        trials.bounce_once,
        [Figure("share", "height of the bounce, share", e**2, "share" if e else "<", 5e-4)],
        seconds=5,
    )
    for e in (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
]

FRICTION = [
    Case(
        f"friction {friction}",
        [partial(scenes.incline, friction=friction)],
        trials.slip_angle,
        [Figure("degrees", "slides from, °", math.degrees(math.atan(3 * friction)), "<", DEGREES)],
        seconds=1,
    )
    for friction in (0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
]

CONSTRAINTS = [
    Case(
        f"constraints: {words} chain of {links}",
        [partial(scenes.chain, links, step)],
        trials.hang_chain,
        [Figure(key, figure, 0.0, "<" if links <= 20 else "", 1)],
        seconds=5,
        longer={"full": {"seconds": 10}},
    )
    for words, step, key, figure in (
        ("hanging", (0.0, 20.0), "whole", "stretch in all, px"),
        ("swinging", (20.0, 0.0), "worst", "worst link ever, px"),
    )
    for links in (5, 10, 20, 40)
]

COLLISION = [
    Case(
        f"collision: fall from {height} px",
        each(scenes.drop, "height", heights(height), restitution=0.0),
        trials.crash,
        [
            Figure("deepest", "deepest overlap ever, px", 0.0, "<", one_step(heights(height)[-1])),
            Figure("left", "overlap left, px", 0.0, "<", 1e-3),
        ],
        seconds=5,
    )
    for height in HEIGHTS
]

STACKING = [
    Case(
        "stacking: balls in a slot, top sinks by less than 1 px",
        [partial(scenes.tower, 1)],
        trials.tallest,
        [Figure("count", "tallest", math.inf, ">", 19)],
        seconds=5,
        longer={"full": {"seconds": 10}},
    ),
]

CASES = INTEGRATOR + RESTITUTION + FRICTION + CONSTRAINTS + COLLISION + STACKING

if __name__ == "__main__":
    print(use_compiled())
    sys.exit(main("The test set of Boeing and Bräunl, 2007", CASES))
