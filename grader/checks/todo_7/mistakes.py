"""Known mistakes in TODO 7a to 7c, as models of the bodies and joints in the space.

TODO 6 has those of 7d.
"""

import math

from grader.checks import exact
from grader.checks.mistakes import Models, register
from grader.checks.todo_7.checks import BOB, PIVOT, Rod
from grader.judge.explain.misconceptions import Kind, Model, Undecided, always, are_close, kinds
from grader.judge.lab import STEP, Pair

# ---------------------------------------------------------------- 7a: the gravity, px/s²

kinds["gravity"] = Kind(always((0.0, 980.0)))
GRAVITIES = {
    "no-gravity": [(0.0, 0.0)],
    "gravity-points-up": [(0.0, -980.0)],
    "gravity-in-metres": [(0.0, 9.8), (0.0, 9.81), (0.0, -9.8), (0.0, -9.81)],
    "gravity-of-one-step": [(0.0, 980.0 * STEP)],
    "gravity-of-another-scene": [(0.0, 900.0), (0.0, 981.0), (0.0, 1000.0)],
    "gravity-points-sideways": [(980.0, 0.0), (-980.0, 0.0)],
}
register("7a", "gravity", ((name, always(g)) for name, some in GRAVITIES.items() for g in some))


# ---------------------------------------------------------------- 7b: the moment of a ball

kinds["moment"] = Kind(lambda radius, mass: exact.disc_moment(mass, radius))
MOMENTS: Models = (
    ("moment-is-infinite", lambda radius, mass: math.inf),
    ("moment-of-a-ring", lambda radius, mass: mass * radius**2),
    ("diameter-instead-of-radius", lambda radius, mass: exact.disc_moment(mass, 2 * radius)),
    ("moment-of-a-box", lambda radius, mass: mass * 2 * (2 * radius) ** 2 / 12),
    ("moment-of-a-small-box", lambda radius, mass: mass * 2 * radius**2 / 12),
    ("moment-of-the-bob", lambda radius, mass: exact.disc_moment(6.0, 24.0)),
    ("radius-of-the-bob", lambda radius, mass: exact.disc_moment(mass, 24.0)),
    ("a-hole-of-a-pixel", lambda radius, mass: mass * (1.0 + radius**2) / 2),
    ("moment-of-a-sphere", lambda radius, mass: mass * radius**2 * 2 / 5),
    ("half-twice", lambda radius, mass: exact.disc_moment(mass, radius) / 2),
    ("mass-is-left-out", lambda radius, mass: exact.disc_moment(1.0, radius)),
    ("mass-and-radius-swapped", lambda radius, mass: exact.disc_moment(radius, mass)),
    ("radius-is-not-squared", lambda radius, mass: mass * radius / 2),
    ("inverse-of-the-moment", lambda radius, mass: 1 / exact.disc_moment(mass, radius)),
    ("half-the-radius", lambda radius, mass: exact.disc_moment(mass, radius / 2)),
    ("mass-for-moment", lambda radius, mass: mass),
)
register("7b", "moment", MOMENTS)


# ---------------------------------------------------------------- 7c: what holds the bob

CORNER = (0.0, 0.0)  # px
RIMS = ((-24.0, 0.0), (24.0, 0.0), (0.0, -24.0), (0.0, 24.0))  # px, from the bob's centre


def pin(far_end: Pair, on_bob: Pair = (0.0, 0.0), moves: bool = False) -> Rod:
    """Return a pin joint to a point of the bob, which is measured from its centre."""
    return Rod("PinJoint", far_end, (BOB[0] + on_bob[0], BOB[1] + on_bob[1]), moves)


kinds["rods"] = Kind(always([pin(PIVOT)]))
JOINTS: dict[str, list[Rod]] = {  # one of them instead of the right one
    "rod-from-the-corner": [pin(CORNER)],
    "bob-anchor-in-screen-coordinates": [pin(PIVOT, BOB), pin(PIVOT, PIVOT), pin(CORNER, BOB)],
    "far-anchor-counted-twice": [pin((2 * PIVOT[0], 2 * PIVOT[1]))],
    "anchors-the-wrong-way-round": [pin(CORNER, PIVOT)],
    "rod-at-the-rim": [pin(PIVOT, rim) for rim in RIMS],
    "rod-on-a-moving-body": [pin(PIVOT, moves=True)],
    "rope-instead-of-rod": [Rod("SlideJoint", PIVOT, BOB, False)],
    "slack-of-two": [Rod("SlideJoint with slack", PIVOT, BOB, False)],
    "spring-instead-of-rod": [Rod("DampedSpring", PIVOT, BOB, False)],
    "pivot-turns-the-bob": [Rod("PivotJoint", PIVOT, PIVOT, False)],
    "bob-is-nailed-to-the-wall": [Rod("PivotJoint", BOB, BOB, False)],
}


def length_off(off: int) -> Model:
    """Return a rod at the right position that is too long (1) or too short (-1)."""

    def model(rods: list[Rod]) -> int:
        if not are_close(rods, [pin(PIVOT)]):
            raise Undecided
        return off

    return model


kinds["length"] = Kind(length_off(0))
register("7c", "length", [("rod-is-too-short", length_off(-1)), ("rod-is-too-long", length_off(1))])
register("7c", "rods", [("joint-is-not-in-the-space", always([]))])
register("7c", "rods", ((name, always([each])) for name, some in JOINTS.items() for each in some))
