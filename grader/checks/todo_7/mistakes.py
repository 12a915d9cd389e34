"""Known mistakes in TODO 7a to 7c, as models of the bodies and joints in the space.

TODO 6 has those of 7d.
"""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import Model, Undecided, always, are_close, truth
from grader.judge.lab import STEP, Pair

# ---------------------------------------------------------------- 7a: the gravity, px/s²


truth("gravity", always((0.0, 980.0)))

known_7a = known_in("7a", "gravity")

known_7a("no-gravity", always((0.0, 0.0)))
known_7a("gravity-points-up", always((0.0, -980.0)))
known_7a(
    "gravity-in-metres",
    always((0.0, 9.8)),
    always((0.0, 9.81)),
    always((0.0, -9.8)),
    always((0.0, -9.81)),
)
known_7a("gravity-of-one-step", always((0.0, 980.0 * STEP)))
known_7a(
    "gravity-of-another-scene", always((0.0, 900.0)), always((0.0, 981.0)), always((0.0, 1000.0))
)
known_7a("gravity-points-sideways", always((980.0, 0.0)), always((-980.0, 0.0)))


# ---------------------------------------------------------------- 7b: the moment of a ball


truth("moment", lambda radius, mass: exact.disc_moment(mass, radius))

known_7b = known_in("7b", "moment")

known_7b("moment-is-infinite", lambda radius, mass: math.inf)
known_7b("moment-of-a-ring", lambda radius, mass: mass * radius**2)
known_7b("diameter-instead-of-radius", lambda radius, mass: exact.disc_moment(mass, 2 * radius))
known_7b("moment-of-a-box", lambda radius, mass: mass * 2 * (2 * radius) ** 2 / 12)
known_7b("moment-of-a-small-box", lambda radius, mass: mass * 2 * radius**2 / 12)
known_7b("moment-of-the-bob", lambda radius, mass: exact.disc_moment(6.0, 24.0))
known_7b("radius-of-the-bob", lambda radius, mass: exact.disc_moment(mass, 24.0))
known_7b("a-hole-of-a-pixel", lambda radius, mass: mass * (1.0 + radius**2) / 2)
known_7b("moment-of-a-sphere", lambda radius, mass: mass * radius**2 * 2 / 5)
known_7b("half-twice", lambda radius, mass: exact.disc_moment(mass, radius) / 2)
known_7b("mass-is-left-out", lambda radius, mass: exact.disc_moment(1.0, radius))
known_7b("mass-and-radius-swapped", lambda radius, mass: exact.disc_moment(radius, mass))
known_7b("radius-is-not-squared", lambda radius, mass: mass * radius / 2)
known_7b("inverse-of-the-moment", lambda radius, mass: 1 / exact.disc_moment(mass, radius))
known_7b("half-the-radius", lambda radius, mass: exact.disc_moment(mass, radius / 2))
known_7b("mass-for-moment", lambda radius, mass: mass)


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
    """Return a rod at the right position that is too long (1) or too short (-1)."""

    def model(rods: list[Rod]) -> int:
        if not are_close(rods, right_rod()):
            raise Undecided
        return off

    return model


truth("length", length_off(0))
known_in("7c", "length")("rod-is-too-short", length_off(-1))
known_in("7c", "length")("rod-is-too-long", length_off(1))

known_7c = known_in("7c", "rods")


def held_by(rod: Rod) -> Model:
    return always([rod])


known_7c("joint-is-not-in-the-space", always([]))
known_7c("rod-from-the-corner", held_by(pin((0.0, 0.0))))
known_7c(
    "bob-anchor-in-screen-coordinates",
    held_by(pin(PIVOT, on_bob=BOB)),
    held_by(pin(PIVOT, on_bob=PIVOT)),
    held_by(pin((0.0, 0.0), on_bob=BOB)),
)
known_7c("far-anchor-counted-twice", held_by(pin((2 * PIVOT[0], 2 * PIVOT[1]))))
known_7c("anchors-the-wrong-way-round", held_by(pin((0.0, 0.0), on_bob=PIVOT)))
known_7c(
    "rod-at-the-rim",
    *(
        held_by(pin(PIVOT, on_bob=rim))
        for rim in ((-24.0, 0.0), (24.0, 0.0), (0.0, -24.0), (0.0, 24.0))
    ),
)
known_7c("rod-on-a-moving-body", held_by(pin(PIVOT, moves=True)))
known_7c("rope-instead-of-rod", held_by(("SlideJoint", PIVOT, BOB, False)))
known_7c("slack-of-two", held_by(("SlideJoint with slack", PIVOT, BOB, False)))
known_7c("spring-instead-of-rod", held_by(("DampedSpring", PIVOT, BOB, False)))
known_7c("pivot-turns-the-bob", held_by(("PivotJoint", PIVOT, PIVOT, False)))
known_7c("bob-is-nailed-to-the-wall", held_by(("PivotJoint", BOB, BOB, False)))
