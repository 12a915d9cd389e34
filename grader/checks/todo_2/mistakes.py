"""Known mistakes in TODO 2, as models of what effective_mass then returns."""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.checks.exact import Lever, Pair, cross, inverse
from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import Undecided, truth

Sum = Callable[[Lever, Lever, Pair], float]


def describe_turning(a: Lever, b: Lever, axis: Pair) -> dict[str, str]:
    """Return which body can turn, and how it is pushed, in words."""
    moving = [name for name, each in (("A", a), ("B", b)) if each.mass]
    turns = {"A": "only A can turn", "B": "only B can turn", "AB": "both can turn"}
    words = {"moves": turns["".join(moving)]} if moving else {}
    levels = {0.0: "the axis is upright", 1.0: "the axis is level"}
    words["_axis"] = levels.get(abs(axis[0]), "the axis is aslant")
    sides = {name: turning_way(each, axis) for name, each in (("A", a), ("B", b)) if each.mass}
    if sides:
        words["_way"] = " and ".join(f"{name} {way}" for name, way in sides.items())
    return words


def turning_way(lever: Lever, axis: Pair) -> str:
    turns = cross((lever.rx, lever.ry), axis)
    if not turns:
        return "is pushed along its arm"
    return f"has a cross product {'above' if turns > 0 else 'below'} 0"


truth("effective_mass", exact.effective_mass, describe_turning, {"the sum": [0]})

known = known_in("2", "effective_mass")


def masses(a: Lever, b: Lever) -> float:
    return inverse(a.mass) + inverse(b.mass)


def with_term(term: Callable[[Lever, Pair], float]) -> Sum:
    """Return the sum with another spin term for each body."""

    def model(a: Lever, b: Lever, axis: Pair) -> float:
        return masses(a, b) + term(a, axis) + term(b, axis)

    return model


def spin_term(lever: Lever, axis: Pair) -> float:
    return lever_cross(lever, axis) ** 2 * inverse(lever.inertia)


def lever_cross(lever: Lever, axis: Pair) -> float:
    return cross((lever.rx, lever.ry), axis)


known("no-spin-terms", lambda a, b, axis: masses(a, b))
known("second-body-forgotten", lambda a, b, axis: masses(a, b) + spin_term(a, axis))
known("first-body-forgotten", lambda a, b, axis: masses(a, b) + spin_term(b, axis))
known(
    "one-term-is-enough",
    lambda a, b, axis: masses(a, b) + (spin_term(a, axis) if a.mass else spin_term(b, axis)),
)
known("masses-forgotten", lambda a, b, axis: spin_term(a, axis) + spin_term(b, axis))
known(
    "terms-are-subtracted",
    lambda a, b, axis: masses(a, b) - spin_term(a, axis) - spin_term(b, axis),
)
known(
    "cross-is-not-squared",
    with_term(lambda lever, axis: lever_cross(lever, axis) * inverse(lever.inertia)),
)
known(
    "dot-for-cross",
    with_term(
        lambda lever, axis: (lever.rx * axis[0] + lever.ry * axis[1]) ** 2 * inverse(lever.inertia)
    ),
)
known(
    "whole-arm",
    with_term(lambda lever, axis: math.hypot(lever.rx, lever.ry) ** 2 * inverse(lever.inertia)),
)
known(
    "inverse-mass-for-inverse-inertia",
    with_term(lambda lever, axis: lever_cross(lever, axis) ** 2 * inverse(lever.mass)),
)


@known("divides-by-the-inverse")
def divides_by_the_inverse(a: Lever, b: Lever, axis: Pair) -> float:
    if not (a.mass and b.mass):
        raise Undecided  # a division by 0
    return with_term(lambda lever, axis: lever_cross(lever, axis) ** 2 * lever.inertia)(a, b, axis)


known(
    "inverse-inertia-is-squared",
    with_term(lambda lever, axis: (lever_cross(lever, axis) * inverse(lever.inertia)) ** 2),
)
known(
    "inertia-forgotten",
    with_term(lambda lever, axis: lever_cross(lever, axis) ** 2 if lever.mass else 0.0),
    with_term(lambda lever, axis: lever_cross(lever, axis) ** 2),
)
known(
    "inertia-forgotten-in-the-first",
    lambda a, b, axis: masses(a, b) + lever_cross(a, axis) ** 2 + spin_term(b, axis),
)
known(
    "inertia-forgotten-in-the-second",
    lambda a, b, axis: masses(a, b) + spin_term(a, axis) + lever_cross(b, axis) ** 2,
)
known(
    "size-for-the-square",
    with_term(lambda lever, axis: abs(lever_cross(lever, axis)) * inverse(lever.inertia)),
)
known(
    "doubled-for-the-square",
    with_term(lambda lever, axis: 2 * lever_cross(lever, axis) * inverse(lever.inertia)),
)
known("half-of-the-terms", with_term(lambda lever, axis: spin_term(lever, axis) / 2))
known("second-term-replaces-the-sum", lambda a, b, axis: spin_term(b, axis))
known(
    "first-inertia-for-both",
    lambda a, b, axis: (
        masses(a, b) + spin_term(a, axis) + lever_cross(b, axis) ** 2 * inverse(a.inertia)
    ),
)
known(
    "sum-before-the-square",
    lambda a, b, axis: (
        masses(a, b)
        + (lever_cross(a, axis) + lever_cross(b, axis)) ** 2
        * (inverse(a.inertia) + inverse(b.inertia))
    ),
)
known(
    "first-arm-for-both",
    lambda a, b, axis: (
        masses(a, b) + spin_term(a, axis) + spin_term(b._replace(rx=a.rx, ry=a.ry), axis)
    ),
)
known(
    "inertias-swapped",
    lambda a, b, axis: (
        masses(a, b)
        + lever_cross(a, axis) ** 2 * inverse(b.inertia)
        + lever_cross(b, axis) ** 2 * inverse(a.inertia)
    ),
)
known("returns-the-inverse", lambda a, b, axis: 1 / exact.effective_mass(a, b, axis))


@known("arms-are-crossed")
def arms_are_crossed(a: Lever, b: Lever, axis: Pair) -> float:
    both = cross((a.rx, a.ry), (b.rx, b.ry)) ** 2
    return masses(a, b) + both * (inverse(a.inertia) + inverse(b.inertia))


known(
    "mass-counts-twice",
    with_term(
        lambda lever, axis: (
            lever_cross(lever, axis) ** 2 * inverse(lever.inertia) * inverse(lever.mass)
        )
    ),
)
