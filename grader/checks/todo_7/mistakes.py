"""Known mistakes in TODO 7a to 7c, as models of what then stands in the space.

Those of 7d are the ones of TODO 6 and stand with them.
"""

import math
from collections.abc import Callable
from functools import partial

from grader.checks import exact
from grader.judge.lab import STEP, Pair
from grader.judge.misconceptions import Model, Undecided, always, are_close, mistake, truth

# ---------------------------------------------------------------- 7a: the gravity, px/s²


truth("gravity", always((0.0, 980.0)))

known_7a = partial(mistake, "7a", "gravity")

known_7a("no-gravity", "Nothing pulls the bodies down.", always((0.0, 0.0)))
known_7a(
    "gravity-points-up",
    "The sign is wrong: y grows down on the screen, so a pull down is positive.",
    always((0.0, -980.0)),
)
known_7a(
    "gravity-in-metres",
    "That is gravity in m/s²; lengths are px here, and the mini engine's is 980 px/s².",
    always((0.0, 9.8)),
    always((0.0, 9.81)),
    always((0.0, -9.8)),
    always((0.0, -9.81)),
)
known_7a(
    "gravity-of-one-step",
    "That is the speed that one step adds, in px/s; pymunk multiplies by the step's length itself.",
    always((0.0, 980.0 * STEP)),
)
known_7a(
    "gravity-of-another-scene",
    "That is the gravity of pymunk's own examples; this scene has the mini engine's.",
    always((0.0, 900.0)),
    always((0.0, 981.0)),
    always((0.0, 1000.0)),
)
known_7a(
    "gravity-points-sideways",
    "The two numbers are the wrong way round: x first, then y.",
    always((980.0, 0.0)),
    always((-980.0, 0.0)),
)


# ---------------------------------------------------------------- 7b: the moment of a ball


truth("moment", lambda radius, mass: exact.disc_moment(mass, radius))

known_7b = partial(mistake, "7b", "moment")

known_7b(
    "moment-is-infinite",
    "An infinite moment never turns: the balls slide and never roll.",
    lambda radius, mass: math.inf,
)
known_7b(
    "moment-of-a-ring",
    "That is the moment of a ring, with all its mass at the rim: a full disc, with no hole, "
    "has half of it.",
    lambda radius, mass: mass * radius**2,
)
known_7b(
    "diameter-instead-of-radius",
    "That is the moment of a ball twice as wide; the outer radius is radius.",
    lambda radius, mass: exact.disc_moment(mass, 2 * radius),
)
known_7b(
    "moment-of-a-box",
    "That is the moment of a square box as wide as the ball; there is one for circles.",
    lambda radius, mass: mass * 2 * (2 * radius) ** 2 / 12,
)
known_7b(
    "moment-of-a-small-box",
    "That is the moment of a square box as wide as the radius; there is one for circles.",
    lambda radius, mass: mass * 2 * radius**2 / 12,
)
known_7b(
    "moment-of-the-bob",
    "That is the bob's moment, for every ball: use this ball's mass and radius.",
    lambda radius, mass: exact.disc_moment(6.0, 24.0),
)
known_7b(
    "radius-of-the-bob",
    "That is the moment of a ball as wide as the bob, 24 px; use this ball's radius.",
    lambda radius, mass: exact.disc_moment(mass, 24.0),
)
known_7b(
    "a-hole-of-a-pixel",
    "That is a disc with a hole of 1 px: the inner radius must be 0.",
    lambda radius, mass: mass * (1.0 + radius**2) / 2,
)
known_7b(
    "moment-of-a-sphere",
    "2/5 m r² is the moment of a sphere; in two dimensions a ball is a disc.",
    lambda radius, mass: mass * radius**2 * 2 / 5,
)
known_7b(
    "half-twice",
    "That is half of a disc's moment: its factor is 1/2, of mass times radius squared.",
    lambda radius, mass: exact.disc_moment(mass, radius) / 2,
)
known_7b(
    "mass-is-left-out",
    "That is the moment of a disc of mass 1; a heavier ball is harder to turn.",
    lambda radius, mass: exact.disc_moment(1.0, radius),
)
known_7b(
    "mass-and-radius-swapped",
    "Mass and radius have changed places: the mass comes first, then the inner and outer radius.",
    lambda radius, mass: exact.disc_moment(radius, mass),
)
known_7b(
    "radius-is-not-squared",
    "The radius counts squared: a ball twice as wide and as heavy is four times as hard to turn.",
    lambda radius, mass: mass * radius / 2,
)
known_7b(
    "inverse-of-the-moment",
    "That is 1 / I, as the mini engine keeps it; pymunk wants the moment I itself.",
    lambda radius, mass: 1 / exact.disc_moment(mass, radius),
)
known_7b(
    "half-the-radius",
    "That is the moment of a ball half as wide; the outer radius is radius.",
    lambda radius, mass: exact.disc_moment(mass, radius / 2),
)
known_7b(
    "mass-for-moment",
    "That is the mass; how hard a ball is to turn also depends on how far out its mass is.",
    lambda radius, mass: mass,
)


# ---------------------------------------------------------------- 7c: what holds the bob

PIVOT, BOB = (700.0, 90.0), (840.0, 90.0)  # px
Rod = tuple[str, Pair, Pair, bool]  # kind, far end, end on the bob, whether the far end moves


def pin(far_end: Pair, on_bob: Pair = (0.0, 0.0), moves: bool = False) -> Rod:
    """Return a pin joint to a point of the bob, which is measured from its centre."""
    return "PinJoint", far_end, (BOB[0] + on_bob[0], BOB[1] + on_bob[1]), moves


def right_rod() -> list[Rod]:
    return [pin(PIVOT)]


truth("rods", right_rod)


def length_off(off: int) -> Callable[[list[Rod]], int]:
    """Return a rod in the right place that is too long (1) or too short (-1)."""

    def model(rods: list[Rod]) -> int:
        if not are_close(rods, right_rod()):
            raise Undecided
        return off

    return model


truth("length", length_off(0))
mistake(
    "7c",
    "length",
    "rod-is-too-short",
    "The rod is shorter than 140 px, the way from (700, 90) to the bob when it is joined.",
    length_off(-1),
)
mistake(
    "7c",
    "length",
    "rod-is-too-long",
    "The rod is longer than 140 px, the way from (700, 90) to the bob when it is joined.",
    length_off(1),
)

known_7c = partial(mistake, "7c", "rods")


def held_by(rod: Rod) -> Model:
    return always([rod])


known_7c(
    "joint-is-not-in-the-space",
    "Nothing holds the bob: a joint works only once space.add() was called with it.",
    always([]),
)
known_7c(
    "rod-from-the-corner",
    "The rod starts at (0, 0), the corner of the window: the first anchor belongs at (700, 90).",
    held_by(pin((0.0, 0.0))),
)
known_7c(
    "bob-anchor-in-screen-coordinates",
    "An anchor is measured from its own body's centre: the bob's centre is (0, 0) there.",
    held_by(pin(PIVOT, on_bob=BOB)),
    held_by(pin(PIVOT, on_bob=PIVOT)),
    held_by(pin((0.0, 0.0), on_bob=BOB)),
)
known_7c(
    "far-anchor-counted-twice",
    "The body at the far end is at (700, 90) already, and the anchor leads as far again from "
    "there: its own centre is (0, 0).",
    held_by(pin((2 * PIVOT[0], 2 * PIVOT[1]))),
)
known_7c(
    "anchors-the-wrong-way-round",
    "The anchors have changed places: the first is for the first body, the second for the other.",
    held_by(pin((0.0, 0.0), on_bob=PIVOT)),
)
known_7c(
    "rod-at-the-rim",
    "The rod holds the bob by its rim and turns it; it must hold the bob's centre.",
    *(
        held_by(pin(PIVOT, on_bob=rim))
        for rim in ((-24.0, 0.0), (24.0, 0.0), (0.0, -24.0), (0.0, 24.0))
    ),
)
known_7c(
    "rod-on-a-moving-body",
    "The body at the other end of the rod moves as well; space.static_body never does.",
    held_by(pin(PIVOT, moves=True)),
)
known_7c(
    "rope-instead-of-rod",
    "A SlideJoint that may get shorter is a rope: it pulls and never pushes.",
    held_by(("SlideJoint", PIVOT, BOB, False)),
)
known_7c(
    "slack-of-two",
    "Between its min and max a SlideJoint holds nothing; a rod has one length.",
    held_by(("SlideJoint with slack", PIVOT, BOB, False)),
)
known_7c(
    "spring-instead-of-rod",
    "A DampedSpring gives way; a rod keeps its length.",
    held_by(("DampedSpring", PIVOT, BOB, False)),
)
known_7c(
    "pivot-turns-the-bob",
    "A PivotJoint at (700, 90) nails the bob to its rod and turns it; a pin joint does not.",
    held_by(("PivotJoint", PIVOT, PIVOT, False)),
)
known_7c(
    "bob-is-nailed-to-the-wall",
    "A PivotJoint at the bob's own place nails it there; the rod turns about (700, 90).",
    held_by(("PivotJoint", BOB, BOB, False)),
)
