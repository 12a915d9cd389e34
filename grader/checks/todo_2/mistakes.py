"""Known mistakes in TODO 2, as models of what effective_mass then returns."""

import math
from collections.abc import Callable
from typing import NamedTuple

from grader.checks import exact
from grader.checks.exact import Lever, Pair, cross, inverse
from grader.checks.mistakes import Models, register
from grader.judge.explain.misconceptions import Kind, kinds


def describe_turning(a: Lever, b: Lever, axis: Pair) -> dict[str, str]:
    """Return which body can turn, and how it is pushed, in words."""
    moving = [name for name, each in (("A", a), ("B", b)) if each.mass]
    turns = {"A": "only A can turn", "B": "only B can turn", "AB": "both can turn"}
    words = {"moves": turns["".join(moving)]} if moving else {}
    levels = {0.0: "the axis is upright", 1.0: "the axis is level"}
    words["_axis"] = levels.get(abs(axis[0]), "the axis is aslant")
    sides = {name: describe_push(each, axis) for name, each in (("A", a), ("B", b)) if each.mass}
    if sides:
        words["_way"] = " and ".join(f"{name} {way}" for name, way in sides.items())
    return words


def describe_push(lever: Lever, axis: Pair) -> str:
    turns = cross((lever.rx, lever.ry), axis)
    if not turns:
        return "is pushed along its arm"
    return f"has a cross product {'above' if turns > 0 else 'below'} 0"


kinds["effective_mass"] = Kind(exact.effective_mass, describe_turning, {"the sum": [0]})


class Side(NamedTuple):
    """One body's part of the sum, with its inverse mass and its inverse inertia."""

    mass: float
    inertia: float
    arm: Pair
    axis: Pair

    @property
    def cross(self) -> float:
        return cross(self.arm, self.axis)

    @property
    def dot(self) -> float:
        return self.arm[0] * self.axis[0] + self.arm[1] * self.axis[1]

    @property
    def spin(self) -> float:
        """Return the right spin term."""
        return self.cross**2 * self.inertia


def take_sides(a: Lever, b: Lever, axis: Pair) -> tuple[Side, ...]:
    return tuple(
        Side(inverse(each.mass), inverse(each.inertia), (each.rx, each.ry), axis) for each in (a, b)
    )


def with_term(term: Callable[[Side], float]) -> Callable[[Side, Side], float]:
    """Return the sum with another spin term for each body."""
    return lambda a, b: a.mass + b.mass + term(a) + term(b)


MODELS: Models = (
    ("no-spin-terms", lambda a, b: a.mass + b.mass),
    ("second-body-forgotten", lambda a, b: a.mass + b.mass + a.spin),
    ("first-body-forgotten", lambda a, b: a.mass + b.mass + b.spin),
    ("one-term-is-enough", lambda a, b: a.mass + b.mass + (a.spin if a.mass else b.spin)),
    ("masses-forgotten", lambda a, b: a.spin + b.spin),
    ("terms-are-subtracted", lambda a, b: a.mass + b.mass - a.spin - b.spin),
    ("cross-is-not-squared", with_term(lambda side: side.cross * side.inertia)),
    ("dot-for-cross", with_term(lambda side: side.dot**2 * side.inertia)),
    ("whole-arm", with_term(lambda side: math.hypot(*side.arm) ** 2 * side.inertia)),
    ("inverse-mass-for-inverse-inertia", with_term(lambda side: side.cross**2 * side.mass)),
    ("divides-by-the-inverse", with_term(lambda side: side.cross**2 / side.inertia)),
    ("inverse-inertia-is-squared", with_term(lambda side: side.spin * side.inertia)),
    ("inertia-forgotten", with_term(lambda side: side.cross**2 if side.mass else 0.0)),
    ("inertia-forgotten", with_term(lambda side: side.cross**2)),
    ("inertia-forgotten-in-the-first", lambda a, b: a.mass + b.mass + a.cross**2 + b.spin),
    ("inertia-forgotten-in-the-second", lambda a, b: a.mass + b.mass + a.spin + b.cross**2),
    ("size-for-the-square", with_term(lambda side: abs(side.cross) * side.inertia)),
    ("doubled-for-the-square", with_term(lambda side: 2 * side.cross * side.inertia)),
    ("half-of-the-terms", with_term(lambda side: side.spin / 2)),
    ("second-term-replaces-the-sum", lambda a, b: b.spin),
    ("first-inertia-for-both", lambda a, b: a.mass + b.mass + a.spin + b.cross**2 * a.inertia),
    (
        "sum-before-the-square",
        lambda a, b: a.mass + b.mass + (a.cross + b.cross) ** 2 * (a.inertia + b.inertia),
    ),
    ("first-arm-for-both", lambda a, b: a.mass + b.mass + a.spin + a.cross**2 * b.inertia),
    (
        "inertias-swapped",
        lambda a, b: a.mass + b.mass + a.cross**2 * b.inertia + b.cross**2 * a.inertia,
    ),
    ("returns-the-inverse", lambda a, b: 1 / with_term(lambda side: side.spin)(a, b)),
    (
        "arms-are-crossed",
        lambda a, b: a.mass + b.mass + cross(a.arm, b.arm) ** 2 * (a.inertia + b.inertia),
    ),
    ("mass-counts-twice", with_term(lambda side: side.spin * side.mass)),
)
register("2", "effective_mass", MODELS, take_sides)
