"""The hard cases, side by side: what each engine does where engines go wrong.

python -m experiments.hard_cases [--quick] [--markdown FILE]

Settings: steps of 1/120 s, and 4 substeps of the stable engine, unless a case says else. The exit
status is 1 when the stable engine misses what must hold.
"""

import math
import sys
from functools import partial
from itertools import product

from . import scenes, trials
from .battery import Case, Figure, each, main, number
from .compiled import use_compiled
from .engines import ENGINES
from .limits import LIMITS
from .scenes import DT, G
from .steps import PATTERNS, at_random

BULLET_SPEEDS = (1000, 2448, 10_000, 50_000, 200_000)  # px/s
STARTS = [100 + 0.2 * i for i in range(102)]  # px, all phases of a step of 20.4 px
INSIDE = ((150, -10), (0, -10), (150, 0), (0, 0), (149, -9), (0, 9.9))  # corner, faces, centre ...
SEAM_SPEEDS = (9, 30, 100, 300, 1000, 3000)  # px/s
RAMS = ((200, 400, 600, 800, 1000), (0, 1, 6, 17, 34), (50, 54))  # px/s, degrees, px
HAVE_SPRINGS = tuple(name for name in ENGINES if name != "lesson")
GAINED = 0.01  # share: nothing drives a chain, but its energy is known to the step only
NEVER_RISES = 1 / math.sqrt(0.75)  # the largest swing of semi-implicit Euler while omega h < 1


def at_most(key, words, limit):
    """A figure that should be 0 and must stay below a limit."""
    return Figure(key, words, 0.0, "<", limit)


def nothing(key, words):
    """A figure that must be exactly 0."""
    return Figure(key, words, 0.0, "<=", 0.0)


# While a substep can follow a spring, it keeps its swing. A stiffer one is damped.
FOLLOWED = Figure("swing", "swing, share of the first", 1.0, "<", NEVER_RISES - 1 + 1e-6)
BOUNDED = at_most("gain", "swing gained, share of the first", NEVER_RISES - 1 + 1e-6)

# ---------------------------------------------------------------- stacks and piles

STACKS = [
    Case(
        "tower of 20 equal balls in a slot",
        [scenes.tower],
        trials.settle,
        [at_most("sink", "top sinks, px", 1), at_most("speed", "late speed, px/s", 1e-3)],
    ),
    *[
        Case(
            f"heavy ball on a light one, 1:{ratio}",
            [partial(scenes.stack, 1, ratio)],
            trials.settle,
            [at_most("sink", "it sinks, px", limit), nothing("rise", "it is launched, px")],
        )
        for ratio, limit in ((10, 0.1), (100, 0.4), (1000, 4))
    ],
    Case(
        "pile of 200, 1/60 s in 8 substeps",
        [scenes.pile],
        trials.overlaps,
        [at_most("overlap", "deepest overlap, px", 0.1)],
        seconds=2.5,
        dt=2 * DT,
        substeps=8,
        longer={"full": {"seconds": 6}},
    ),
    Case(
        "pile of 200",
        [scenes.pile],
        trials.overlaps,
        [at_most("overlap", "deepest overlap, px", 0.1)],
        seconds=6,
        quick=False,
    ),
    Case(
        "ball at rest for 10 s",
        [scenes.resting],
        trials.rest,
        [nothing("drift", "drift, px"), at_most("depth", "depth, px", 0.001)],
        longer={"full": {"title": "ball at rest for 10 min", "seconds": 600}},
    ),
]

# ---------------------------------------------------------------- bad starts

BAD_STARTS = [
    Case(
        "two balls that overlap by 30 px, 1:1 and 1:100",
        each(scenes.overlapping, "mass", (1, 100)),
        trials.separate,
        [at_most("speed", "speed gained, px/s", 1)],
        seconds=2,
    ),
    Case(
        "10 balls with the same centre",
        [scenes.coincident],
        trials.separate,
        [
            at_most("speed", "top speed, px/s", 300),
            nothing("overlap", "overlap left, px"),
            Figure("spread", "narrower spread, px", math.inf, ">", 20),
        ],
        seconds=2,
    ),
    *[
        Case(
            f"two balls squeezed by 8 px, 1:{mass}",
            [partial(scenes.squeezed, 8, mass)],
            trials.separate,
            [at_most("speed", "top speed, px/s", 1)],
            seconds=2,
        )
        for mass in (1, 100)
    ],
    Case(
        "centre on corner, face, centre of a box",
        each(scenes.inside_ledge, "pos", INSIDE),
        trials.separate,
        [at_most("speed", "top speed, px/s", 300), at_most("overlap", "overlap left, px", 0.001)],
        seconds=2,
    ),
    Case(
        "6 random closed boxes",
        each(scenes.closed_box, "seed", range(6)),
        trials.escape,
        [nothing("escapes", "with an escape or NaN")],
        seconds=1,
        total=True,
        longer={
            "full": {
                "title": "60 random closed boxes",
                "scenes": each(scenes.closed_box, "seed", range(60)),
                "seconds": 2,
            },
            "soak": {
                "title": "2000 random closed boxes",
                "scenes": each(scenes.closed_box, "seed", range(2000)),
                "seconds": 4,
            },
        },
    ),
    *[
        Case(
            f"5 wild boxes, all effects, steps {words}",
            each(scenes.wild_box, "seed", range(5)),
            partial(trials.escape, steps=steps),
            [nothing("escapes", "with an escape or NaN")],
            seconds=1,
            total=True,
            engines=("stable",),
            longer={
                "full": {
                    "title": f"50 wild boxes, all effects, steps {words}",
                    "scenes": each(scenes.wild_box, "seed", range(50)),
                    "seconds": 2,
                },
                "soak": {
                    "title": f"1000 wild boxes, all effects, steps {words}",
                    "scenes": each(scenes.wild_box, "seed", range(1000)),
                    "seconds": 4,
                },
            },
        )
        for words, steps in (("1/120 s", None), ("at random, 1/1000 to 1/50 s", at_random))
    ],
    Case(
        "100 rams by 100 kg and 1000 kg, wall of 20 px",
        [partial(scenes.rammer, *ram) for ram in product((100, 1000), *RAMS)],
        trials.ram,
        [nothing("through", "that get through")],
        seconds=0.5,
        total=True,
    ),
]

# ---------------------------------------------------------------- fast balls and bouncing

FAST = [
    *[
        Case(
            f"102 bullets at {speed} px/s, ledge of 20 px",
            each(scenes.shot, "start", STARTS, speed=float(speed)),
            trials.shoot,
            [nothing("through", "that tunnel")],
            seconds=0.3,
            total=True,
        )
        for speed in BULLET_SPEEDS
    ],
    Case(
        "102 balls that are no bullets at 2448 px/s, ledge of 20 px",
        each(scenes.shot, "start", STARTS, bullet=False),
        trials.shoot,
        [nothing("through", "that tunnel")],
        seconds=0.3,
        total=True,
    ),
    Case(
        "bullets that miss a corner by 0.5 px",
        [
            partial(scenes.near_miss, speed, start)
            for speed in (100, 300, *BULLET_SPEEDS)
            for start in range(100, 140, 9)
        ],
        trials.graze,
        [nothing("deflection", "deflection, share of speed")],
    ),
    Case(
        "bouncing with e = 1 for 60 s",
        [scenes.drop],
        trials.bounce_on,
        [Figure("apex", "last apex, share of the first", 1.0, "share", 1e-6)],
        seconds=60,
    ),
    Case(
        "first rebound, e = 0.2, 0.3, 0.5, 0.8, 0.9",
        each(scenes.drop, "restitution", (0.2, 0.3, 0.5, 0.8, 0.9)),
        trials.bounce_once,
        [Figure("rebound", "height, share of e²", 1.0, "share", 5e-4)],
        seconds=5,
    ),
    *[
        Case(
            f"Newton's cradle with gaps of {gap} px",
            [partial(scenes.cradle, gap)],
            trials.cradle_transfer,
            [at_most("error", "worst speed, px/s off", 1e-9)],
            seconds=1,
        )
        for gap in (0, 0.5, 5)
    ],
]

# ---------------------------------------------------------------- rolling, and far from usual

ROLLING = [
    Case(
        "a sliding ball ends up rolling",
        [scenes.slide],
        trials.roll,
        [Figure("speed", "speed, px/s", 200.0, "share", 1e-9)],
        seconds=2,
    ),
    Case(
        "spin of 10,000 rad/s",
        [partial(scenes.on_floor, omega=1e4)],
        trials.roll,
        [Figure("speed", "speed after 1 s, px/s", 0.6 * G, "share", 1e-6)],
        seconds=1,
    ),
    Case(
        "rolling over seams, 9 to 3000 px/s",
        each(scenes.seams, "speed", SEAM_SPEEDS),
        trials.roll_over_seams,
        [at_most("hop", "highest hop, px", 0.01)],
        seconds=3,
    ),
    Case(
        "at rest 1e4 to 1e9 px from the origin",
        each(scenes.resting, "far", (1e4, 1e6, 1e8, 1e9)),
        trials.rest,
        [at_most("share", "depth, radii", 0.05)],
        seconds=5,
    ),
    Case(
        "at rest with a radius of 0.01 to 1e5 px",
        each(scenes.resting, "radius", (0.01, 0.1, 1, 100, 1e4, 1e5)),
        trials.rest,
        [at_most("share", "depth, radii", 0.05)],
        seconds=5,
    ),
]

# ---------------------------------------------------------------- rods and springs

RODS = [
    *[
        Case(
            f"pendulum in steps of 1/{hertz} s",
            [scenes.pendulum],
            trials.swing,
            [Figure("stretch", "stretch, px", 0.0, "<" if hertz == 120 else "", 0.01)],
            dt=1 / hertz,
        )
        for hertz in (30, 60, 120, 240)
    ],
    Case(
        "pendulum for 60 s",
        [scenes.pendulum],
        trials.swing,
        [
            at_most("period", "error of its period, share", 3e-5),
            at_most("energy", "worst energy error, share", 0.005),
        ],
        seconds=60,
    ),
    Case(
        "hanging chain of 20",
        [scenes.chain],
        trials.hang_chain,
        [at_most("whole", "stretch, px", 1)],
    ),
    Case(
        "hanging chain of 10, last ball 100:1",
        [partial(scenes.chain, 10, bob=100.0)],
        trials.hang_chain,
        [at_most("whole", "stretch, px", 5)],
    ),
    Case(
        "swinging chain of 20 for 10 s",
        [partial(scenes.chain, 20, (20.0, 0.0))],
        trials.hang_chain,
        [at_most("worst", "worst link, px", 1)],
        longer={
            "full": {"title": "swinging chain of 20 for 1200 steps"},
            "soak": {
                "title": "swinging chain of 20 for 10,000 steps",
                "seconds": 10_000 * DT,
            },
        },
    ),
    *[
        Case(
            f"swinging chain of {links} for {seconds} s",
            [partial(scenes.chain, links, (20.0, 0.0))],
            trials.swing_on,
            [Figure("gain", "energy gained, share", 0.0, "<", GAINED)],
            seconds=seconds,
            quick=links == 3,
        )
        for links, seconds in ((3, 20), (10, 60))
    ],
    *[
        Case(
            f"spring with k/m = {number(stiffness, 1)}/s²",
            [partial(scenes.oscillator, stiffness)],
            trials.oscillate,
            [figure],
            engines=HAVE_SPRINGS,
        )
        for stiffness, figure in ((1e2, FOLLOWED), (1e4, FOLLOWED), (1e6, BOUNDED), (1e9, BOUNDED))
    ],
    Case(
        "spring of 1 Hz for 60 s",
        [scenes.oscillator],
        trials.ring_down,
        [Figure("energy", "mean energy, share", 1.0, "share", 1e-3)],
        seconds=60,
        engines=HAVE_SPRINGS,
    ),
]

# ---------------------------------------------------------------- once more

AGAIN = [
    Case(
        "pile of 40 for 1 s, done twice",
        [partial(scenes.pile, 40, 150)],
        trials.run_twice,
        [nothing("bits", "numbers that differ")],
        seconds=1,
        longer={"full": {"title": "pile of 40 for 2 s, done twice", "seconds": 2}},
    ),
    Case(
        "pile of 40 for 2 s, added in another order",
        [partial(scenes.pile, 40, 150)],
        trials.reorder,
        [Figure("shift", "largest shift, px")],
        seconds=2,
    ),
]

# ---------------------------------------------------------------- steps that vary

UNEVEN = [
    Case(
        f"{title}, steps {words}",
        [make],
        partial(trials.vary, steps=steps),
        [at_most("rise", "launched, px", 0.5)],
        seconds=3,
        longer={"full": {"seconds": 10}},
    )
    for title, make in (
        ("stack of 10", partial(scenes.stack, *[1] * 10)),
        ("hanging chain of 20", scenes.chain),
    )
    for words, steps in PATTERNS.items()
]

CASES = STACKS + BAD_STARTS + FAST + ROLLING + RODS + UNEVEN + AGAIN + LIMITS

if __name__ == "__main__":
    print(use_compiled())
    sys.exit(main("Hard cases, side by side", CASES))
