"""The hard cases, side by side: what each engine does where engines go wrong.

python -m experiments.hard_cases [--quick] [--markdown FILE]

Settings: steps of 1/120 s, and 4 substeps of the stable engine, unless a case says otherwise. The
exit status is 1 when the stable engine misses what must hold.
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
RAMS = ((100, 1000), (200, 400, 600, 800, 1000), (0, 1, 6, 17, 34), (50, 54))  # kg, px/s, °, px
HAVE_SPRINGS = tuple(name for name in ENGINES if name != "lesson")
GAINED = 0.01  # share: nothing drives a chain, but its energy is known to the step only
NEVER_RISES = 1 / math.sqrt(0.75)  # the largest swing of semi-implicit Euler while omega h < 1


def at_most(key, words, limit):
    """Return a figure that should be 0 and must stay below a limit."""
    return Figure(key, words, 0.0, "<", limit)


def nothing(key, words):
    """Return a figure that must be exactly 0."""
    return Figure(key, words, 0.0, "<=", 0.0)


# While a substep can follow a spring, it keeps its swing. A stiffer one is damped.
FOLLOWED = Figure("swing", "swing, share of the first", 1.0, "<", NEVER_RISES - 1 + 1e-6)
BOUNDED = at_most("gain", "swing gained, share of the first", NEVER_RISES - 1 + 1e-6)

# ---------------------------------------------------------------- stacks and piles

SINKS = [at_most("sink", "top sinks, px", 1), at_most("speed", "late speed, px/s", 1e-3)]
LAUNCHED = nothing("rise", "it is launched, px")
DEEPEST = [at_most("overlap", "deepest overlap, px", 0.1)]
RESTS = [nothing("drift", "drift, px"), at_most("depth", "depth, px", 0.001)]

STACKS = [
    Case("tower of 20 equal balls in a slot", [scenes.tower], trials.settle, SINKS),
    *(
        Case(f"heavy ball on a light one, 1:{ratio}", [partial(scenes.stack, 1, ratio)],
             trials.settle, [at_most("sink", "it sinks, px", limit), LAUNCHED])
        for ratio, limit in ((10, 0.1), (100, 0.4), (1000, 4))
    ),
    Case("pile of 200, 1/60 s in 8 substeps", [scenes.pile], trials.overlaps, DEEPEST,
         seconds=2.5, dt=2 * DT, substeps=8, longer={"full": {"seconds": 6}}),
    Case("pile of 200", [scenes.pile], trials.overlaps, DEEPEST, seconds=6, quick=False),
    Case("ball at rest for 10 s", [scenes.resting], trials.rest, RESTS,
         longer={"full": {"title": "ball at rest for 10 min", "seconds": 600}}),
]  # fmt: skip

# ---------------------------------------------------------------- bad starts

OVERLAPPING = each(scenes.overlapping, "mass", (1, 100))
PARTED = [
    at_most("speed", "top speed, px/s", 300),
    nothing("overlap", "overlap left, px"),
    Figure("spread", "narrower spread, px", math.inf, ">", 20),
]
FREED = [at_most("speed", "top speed, px/s", 300), at_most("overlap", "overlap left, px", 0.001)]
ESCAPES = [nothing("escapes", "with an escape or NaN")]


def boxes(make, few, many, most, words):
    """Return the arguments of a case with a few boxes, and with more for longer runs."""
    longer = {
        length: {"title": f"{count} {words}", "scenes": each(make, "seed", range(count)),
                 "seconds": seconds}
        for length, count, seconds in (("full", many, 2), ("soak", most, 4))
    }  # fmt: skip
    scenes_of = each(make, "seed", range(few))
    return {"title": f"{few} {words}", "scenes": scenes_of, "seconds": 1, "longer": longer}


BAD_STARTS = [
    Case("two balls that overlap by 30 px, 1:1 and 1:100", OVERLAPPING, trials.separate,
         [at_most("speed", "speed gained, px/s", 1)], seconds=2),
    Case("10 balls with the same centre", [scenes.coincident], trials.separate, PARTED, seconds=2),
    *(
        Case(f"two balls squeezed by 8 px, 1:{mass}", [partial(scenes.squeezed, 8, mass)],
             trials.separate, [at_most("speed", "top speed, px/s", 1)], seconds=2)
        for mass in (1, 100)
    ),
    Case("centre on corner, face, centre of a box", each(scenes.inside_ledge, "pos", INSIDE),
         trials.separate, FREED, seconds=2),
    Case(**boxes(scenes.closed_box, 6, 60, 2000, "random closed boxes"),
         trial=trials.escape, figures=ESCAPES, total=True),
    *(
        Case(**boxes(scenes.wild_box, 5, 50, 1000, f"wild boxes, all effects, steps {words}"),
             trial=partial(trials.escape, steps=steps), figures=ESCAPES, total=True,
             engines=("stable",))
        for words, steps in (("1/120 s", None), ("at random, 1/1000 to 1/50 s", at_random))
    ),
    Case("100 rams by 100 kg and 1000 kg, wall of 20 px",
         [partial(scenes.rammer, *ram) for ram in product(*RAMS)],
         trials.ram, [nothing("through", "that get through")], seconds=0.5, total=True),
]  # fmt: skip

# ---------------------------------------------------------------- fast balls and bouncing

TUNNEL = [nothing("through", "that tunnel")]
NEAR_MISSES = [
    partial(scenes.near_miss, speed, start)
    for speed in (100, 300, *BULLET_SPEEDS)
    for start in range(100, 140, 9)
]
BOUNCES = each(scenes.drop, "restitution", (0.2, 0.3, 0.5, 0.8, 0.9))

FAST = [
    *(
        Case(f"102 bullets at {speed} px/s, ledge of 20 px",
             each(scenes.shot, "start", STARTS, speed=float(speed)),
             trials.shoot, TUNNEL, seconds=0.3, total=True)
        for speed in BULLET_SPEEDS
    ),
    Case("102 balls that are no bullets at 2448 px/s, ledge of 20 px",
         each(scenes.shot, "start", STARTS, bullet=False),
         trials.shoot, TUNNEL, seconds=0.3, total=True),
    Case("bullets that miss a corner by 0.5 px", NEAR_MISSES, trials.graze,
         [nothing("deflection", "deflection, share of speed")]),
    Case("bouncing with e = 1 for 60 s", [scenes.drop], trials.bounce_on,
         [Figure("apex", "last apex, share of the first", 1.0, "share", 1e-6)], seconds=60),
    Case("first rebound, e = 0.2, 0.3, 0.5, 0.8, 0.9", BOUNCES, trials.bounce_once,
         [Figure("rebound", "height, share of e²", 1.0, "share", 5e-4)], seconds=5),
    *(
        Case(f"Newton's cradle with gaps of {gap} px", [partial(scenes.cradle, gap)],
             trials.cradle_transfer, [at_most("error", "worst speed, px/s off", 1e-9)], seconds=1)
        for gap in (0, 0.5, 5)
    ),
]  # fmt: skip

# ---------------------------------------------------------------- rolling, and far from usual

DEPTH = [at_most("share", "depth, radii", 0.05)]
SLOPES = each(scenes.incline, "friction", (0.1, 0.2, 0.4, 0.6, 0.8, 1.0))

ROLLING = [
    Case("a sliding ball ends up rolling", [scenes.slide], trials.roll,
         [Figure("speed", "speed, px/s", 200.0, "share", 1e-9)], seconds=2),
    Case("slope from which a ball slides, μ = 0.1 to 1", SLOPES, trials.slip_angle,
         [at_most("off", "off atan(3 μ), °", trials.SLIP)], seconds=1),
    Case("spin of 10,000 rad/s", [partial(scenes.on_floor, omega=1e4)], trials.roll,
         [Figure("speed", "speed after 1 s, px/s", 0.6 * G, "share", 1e-6)], seconds=1),
    Case("rolling over seams, 9 to 3000 px/s", each(scenes.seams, "speed", SEAM_SPEEDS),
         trials.roll_over_seams, [at_most("hop", "highest hop, px", 0.01)], seconds=3),
    Case("at rest 1e4 to 1e9 px from the origin", each(scenes.resting, "far", (1e4, 1e6, 1e8, 1e9)),
         trials.rest, DEPTH, seconds=5),
    Case("at rest with a radius of 0.01 to 1e5 px",
         each(scenes.resting, "radius", (0.01, 0.1, 1, 100, 1e4, 1e5)),
         trials.rest, DEPTH, seconds=5),
]  # fmt: skip

# ---------------------------------------------------------------- rods and springs

SWINGS_ON = [
    at_most("period", "error of its period, share", 3e-5),
    at_most("energy", "worst energy error, share", 0.005),
]
HEAVY_CHAIN, SWINGING = partial(scenes.chain, 10, bob=100.0), partial(scenes.chain, 20, (20.0, 0.0))
LONGER_SWING = {
    "full": {"title": "swinging chain of 20 for 1200 steps"},
    "soak": {"title": "swinging chain of 20 for 10,000 steps", "seconds": 10_000 * DT},
}

RODS = [
    *(
        Case(f"pendulum in steps of 1/{hertz} s", [scenes.pendulum], trials.swing,
             [Figure("stretch", "stretch, px", 0.0, "<" if hertz == 120 else "", 0.01)],
             dt=1 / hertz)
        for hertz in (30, 60, 120, 240)
    ),
    Case("pendulum for 60 s", [scenes.pendulum], trials.swing, SWINGS_ON, seconds=60),
    Case("hanging chain of 20", [scenes.chain], trials.hang_chain,
         [at_most("whole", "stretch, px", 1)]),
    Case("hanging chain of 10, last ball 100:1", [HEAVY_CHAIN], trials.hang_chain,
         [at_most("whole", "stretch, px", 5)]),
    Case("swinging chain of 20 for 10 s", [SWINGING], trials.hang_chain,
         [at_most("worst", "worst link, px", 1)], longer=LONGER_SWING),
    *(
        Case(f"swinging chain of {links} for {seconds} s",
             [partial(scenes.chain, links, (20.0, 0.0))], trials.swing_on,
             [at_most("gain", "energy gained, share", GAINED),
              Figure("kept", "energy kept, share", 1.0)],
             seconds=seconds, quick=links == 3)
        for links, seconds in ((3, 20), (10, 60))
    ),
    *(
        Case(f"spring with k/m = {number(stiffness, 1)}/s²",
             [partial(scenes.oscillator, stiffness)],
             trials.oscillate, [figure], engines=HAVE_SPRINGS)
        for stiffness, figure in ((1e2, FOLLOWED), (1e4, FOLLOWED), (1e6, BOUNDED), (1e9, BOUNDED))
    ),
    Case("spring of 1 Hz for 60 s", [scenes.oscillator], trials.ring_down,
         [Figure("energy", "mean energy, share", 1.0, "share", 1e-3)],
         seconds=60, engines=HAVE_SPRINGS),
]  # fmt: skip

# ---------------------------------------------------------------- steps that vary, and once more

UNEVEN = [
    Case(f"{title}, steps {words}", [make], partial(trials.vary, steps=steps),
         [at_most("rise", "launched, px", 0.5)], seconds=3, longer={"full": {"seconds": 10}})
    for title, make in (
        ("stack of 10", partial(scenes.stack, *[1] * 10)),
        ("hanging chain of 20", scenes.chain),
    )
    for words, steps in PATTERNS.items()
]  # fmt: skip

SMALL_PILE = partial(scenes.pile, 40, 150)
AGAIN = [
    Case("pile of 40 for 1 s, done twice", [SMALL_PILE], trials.run_twice,
         [nothing("bits", "numbers that differ")], seconds=1,
         longer={"full": {"title": "pile of 40 for 2 s, done twice", "seconds": 2}}),
    Case("pile of 40 for 2 s, added in another order", [SMALL_PILE], trials.reorder,
         [Figure("shift", "largest shift, px")], seconds=2),
]  # fmt: skip

CASES = STACKS + BAD_STARTS + FAST + ROLLING + RODS + UNEVEN + AGAIN + LIMITS

if __name__ == "__main__":
    print(use_compiled())
    sys.exit(main("Hard cases, side by side", CASES))
