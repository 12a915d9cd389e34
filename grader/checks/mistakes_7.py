"""Known mistakes in TODO 7a to 7c, as models of what then stands in the space.

Those of 7d are the ones of TODO 6 and stand with them.
"""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.judge.lab import STEP, Pair
from grader.judge.misconceptions import Undecided, alike, mistake, truth

# ---------------------------------------------------------------- 7a: the gravity, px/s²


@truth("gravity")
def right_gravity() -> Pair:
    return 0.0, 980.0


def wrong_gravity(name: str, meaning: str, *pulls: Pair) -> None:
    for pull in pulls:
        mistake("7a", name, meaning, about="gravity")(lambda pull=pull: pull)


wrong_gravity("no-gravity", "Nothing pulls the bodies down.", (0.0, 0.0))
wrong_gravity(
    "gravity-points-up",
    "The sign is wrong: y grows down on the screen, so a pull down is positive.",
    (0.0, -980.0),
)
wrong_gravity(
    "gravity-in-metres",
    "That is gravity in m/s²; lengths are px here, and the mini engine's is 980 px/s².",
    (0.0, 9.8),
    (0.0, 9.81),
    (0.0, -9.8),
    (0.0, -9.81),
)
wrong_gravity(
    "gravity-of-one-step",
    "That is the speed that one step adds, in px/s; pymunk multiplies by the step's length itself.",
    (0.0, 980.0 * STEP),
)
wrong_gravity(
    "gravity-of-another-scene",
    "That is the gravity of pymunk's own examples; this scene has the mini engine's.",
    (0.0, 900.0),
    (0.0, 981.0),
    (0.0, 1000.0),
)
wrong_gravity(
    "gravity-points-sideways",
    "The two numbers are the wrong way round: x first, then y.",
    (980.0, 0.0),
    (-980.0, 0.0),
)


# ---------------------------------------------------------------- 7b: the moment of a ball


@truth("moment")
def right_moment(radius: float, mass: float) -> float:
    return exact.disc_moment(mass, radius)


@mistake(
    "7b",
    "moment-is-infinite",
    "An infinite moment never turns: the balls slide and never roll.",
    about="moment",
)
def infinite_moment(radius: float, mass: float) -> float:
    return math.inf


@mistake(
    "7b",
    "moment-of-a-ring",
    "That is the moment of a ring, with all its mass at the rim; the inner radius must be 0.",
    about="moment",
)
def ring(radius: float, mass: float) -> float:
    return mass * radius**2


@mistake(
    "7b",
    "diameter-instead-of-radius",
    "That is the moment of a ball twice as wide; the outer radius is radius.",
    about="moment",
)
def with_diameter(radius: float, mass: float) -> float:
    return exact.disc_moment(mass, 2 * radius)


@mistake(
    "7b",
    "moment-of-a-box",
    "That is the moment of a square box as wide as the ball; there is one for circles.",
    about="moment",
)
def box(radius: float, mass: float) -> float:
    return mass * 2 * (2 * radius) ** 2 / 12


@mistake(
    "7b",
    "moment-of-a-small-box",
    "That is the moment of a square box as wide as the radius; there is one for circles.",
    about="moment",
)
def small_box(radius: float, mass: float) -> float:
    return mass * 2 * radius**2 / 12


@mistake(
    "7b",
    "moment-of-a-sphere",
    "2/5 m r² is the moment of a sphere; in two dimensions a ball is a disc.",
    about="moment",
)
def sphere(radius: float, mass: float) -> float:
    return mass * radius**2 * 2 / 5


@mistake(
    "7b",
    "mass-is-left-out",
    "That is the moment of a disc of mass 1; a heavier ball is harder to turn.",
    about="moment",
)
def without_mass(radius: float, mass: float) -> float:
    return exact.disc_moment(1.0, radius)


@mistake(
    "7b",
    "mass-and-radius-swapped",
    "Mass and radius have changed places: the mass comes first, then the inner and outer radius.",
    about="moment",
)
def swapped(radius: float, mass: float) -> float:
    return exact.disc_moment(radius, mass)


@mistake(
    "7b",
    "radius-is-not-squared",
    "The radius counts squared: a ball twice as wide and as heavy is four times as hard to turn.",
    about="moment",
)
def radius_not_squared(radius: float, mass: float) -> float:
    return mass * radius / 2


@mistake(
    "7b",
    "mass-for-moment",
    "That is the mass; how hard a ball is to turn also depends on how far out its mass is.",
    about="moment",
)
def mass_for_moment(radius: float, mass: float) -> float:
    return mass


# ---------------------------------------------------------------- 7c: what holds the bob

PIVOT, BOB = (700.0, 90.0), (840.0, 90.0)  # px
Rod = tuple[str, Pair, Pair, bool]  # kind, far end, end on the bob, whether the far end moves


def pin(far_end: Pair, on_bob: Pair = (0.0, 0.0), moves: bool = False) -> Rod:
    """A pin joint to a point of the bob, which is measured from its centre."""
    return "PinJoint", far_end, (BOB[0] + on_bob[0], BOB[1] + on_bob[1]), moves


@truth("rods")
def right_rod() -> list[Rod]:
    return [pin(PIVOT)]


def length_off(off: int) -> Callable[[list[Rod]], int]:
    """A rod in the right place that is too long (1) or too short (-1)."""

    def model(rods: list[Rod]) -> int:
        if not alike(rods, right_rod()):
            raise Undecided
        return off

    return model


truth("length")(length_off(0))
mistake(
    "7c",
    "rod-is-too-short",
    "The rod is shorter than 140 px, the way from (700, 90) to the bob when it is joined.",
    about="length",
)(length_off(-1))
mistake(
    "7c",
    "rod-is-too-long",
    "The rod is longer than 140 px, the way from (700, 90) to the bob when it is joined.",
    about="length",
)(length_off(1))


def wrong_rods(name: str, meaning: str, *rods: Rod) -> None:
    for rod in rods:
        mistake("7c", name, meaning, about="rods")(lambda rod=rod: [rod])


@mistake(
    "7c",
    "joint-is-not-in-the-space",
    "Nothing holds the bob: a joint works only once space.add() was called with it.",
    about="rods",
)
def no_rod() -> list[Rod]:
    return []


wrong_rods(
    "rod-from-the-corner",
    "The rod starts at (0, 0), the corner of the window: the first anchor belongs at (700, 90).",
    pin((0.0, 0.0)),
)
wrong_rods(
    "bob-anchor-in-screen-coordinates",
    "An anchor is measured from its own body's centre: the bob's centre is (0, 0) there.",
    pin(PIVOT, on_bob=BOB),
    pin(PIVOT, on_bob=PIVOT),
    pin((0.0, 0.0), on_bob=BOB),
)
wrong_rods(
    "anchors-the-wrong-way-round",
    "The anchors have changed places: the first is for the first body, the second for the other.",
    pin((0.0, 0.0), on_bob=PIVOT),
)
wrong_rods(
    "rod-at-the-rim",
    "The rod holds the bob by its rim and turns it; it must hold the bob's centre.",
    *(pin(PIVOT, on_bob=rim) for rim in ((-24.0, 0.0), (24.0, 0.0), (0.0, -24.0), (0.0, 24.0))),
)
wrong_rods(
    "rod-on-a-moving-body",
    "The body at the other end of the rod moves as well; space.static_body never does.",
    pin(PIVOT, moves=True),
)
wrong_rods(
    "rope-instead-of-rod",
    "A SlideJoint that may get shorter is a rope: it pulls and never pushes.",
    ("SlideJoint", PIVOT, BOB, False),
)
wrong_rods(
    "spring-instead-of-rod",
    "A DampedSpring gives way; a rod keeps its length.",
    ("DampedSpring", PIVOT, BOB, False),
)
wrong_rods(
    "pivot-turns-the-bob",
    "A PivotJoint at (700, 90) nails the bob to its rod and turns it; a pin joint does not.",
    ("PivotJoint", PIVOT, PIVOT, False),
)
wrong_rods(
    "bob-is-nailed-to-the-wall",
    "A PivotJoint at the bob's own place nails it there; the rod turns about (700, 90).",
    ("PivotJoint", BOB, BOB, False),
)
