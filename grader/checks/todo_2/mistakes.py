"""Known mistakes in TODO 2, as models of what effective_mass then returns."""

import math
from collections.abc import Callable
from functools import partial

from grader.checks import exact
from grader.checks.exact import Lever, Pair, cross, inverse
from grader.judge.misconceptions import Undecided, mistake, truth

Sum = Callable[[Lever, Lever, Pair], float]


def like(a: Lever, b: Lever, axis: Pair) -> dict[str, str]:
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


truth("effective_mass", exact.effective_mass, like, {"the sum": [0]})

known = partial(mistake, "2", "effective_mass")


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


known(
    "no-spin-terms",
    "Only the masses are in the sum; a body also gives way by turning.",
    lambda a, b, axis: masses(a, b),
)
known(
    "second-body-forgotten",
    "The second body's spin term is left out; both bodies turn.",
    lambda a, b, axis: masses(a, b) + spin_term(a, axis),
)
known(
    "first-body-forgotten",
    "The first body's spin term is left out; both bodies turn.",
    lambda a, b, axis: masses(a, b) + spin_term(b, axis),
)
known(
    "one-term-is-enough",
    "The second body's spin term is left out where the first one turns; both bodies turn.",
    lambda a, b, axis: masses(a, b) + (spin_term(a, axis) if a.mass else spin_term(b, axis)),
)
known(
    "masses-forgotten",
    "The spin terms replace 1/m_a + 1/m_b; they must be added to them.",
    lambda a, b, axis: spin_term(a, axis) + spin_term(b, axis),
)
known(
    "terms-are-subtracted",
    "The spin terms count as negative; turning makes a body give way more, so they are added.",
    lambda a, b, axis: masses(a, b) - spin_term(a, axis) - spin_term(b, axis),
)
known(
    "cross-is-not-squared",
    "The cross product is not squared: a term can come out negative.",
    with_term(lambda lever, axis: lever_cross(lever, axis) * inverse(lever.inertia)),
)
known(
    "dot-for-cross",
    "The dot product is the part of the arm along the axis; the part across it turns a body.",
    with_term(
        lambda lever, axis: (lever.rx * axis[0] + lever.ry * axis[1]) ** 2 * inverse(lever.inertia)
    ),
)
known(
    "whole-arm",
    "The whole arm counts; only its part across the axis can turn a body: ra x axis.",
    with_term(lambda lever, axis: math.hypot(lever.rx, lever.ry) ** 2 * inverse(lever.inertia)),
)
known(
    "inverse-mass-for-inverse-inertia",
    "The spin terms are divided by the mass, not by the inertia.",
    with_term(lambda lever, axis: lever_cross(lever, axis) ** 2 * inverse(lever.mass)),
)


def divided(a: Lever, b: Lever, axis: Pair) -> float:
    if not (a.mass and b.mass):
        raise Undecided  # a division by 0
    return with_term(lambda lever, axis: lever_cross(lever, axis) ** 2 * lever.inertia)(a, b, axis)


known(
    "divides-by-the-inverse",
    "inv_inertia is 1/I already, and 0 for a static body: multiply by it.",
    divided,
)
known(
    "inverse-inertia-is-squared",
    "The inverse inertia is squared too; only the cross product is to be squared.",
    with_term(lambda lever, axis: (lever_cross(lever, axis) * inverse(lever.inertia)) ** 2),
)
known(
    "inertia-forgotten",
    "The spin terms lack the inertia: multiply each by its body's inv_inertia.",
    with_term(lambda lever, axis: lever_cross(lever, axis) ** 2 if lever.mass else 0.0),
    with_term(lambda lever, axis: lever_cross(lever, axis) ** 2),
)
known(
    "inertia-forgotten-in-the-first",
    "The spin term of the first body lacks its inertia: multiply it by a.inv_inertia.",
    lambda a, b, axis: masses(a, b) + lever_cross(a, axis) ** 2 + spin_term(b, axis),
)
known(
    "inertia-forgotten-in-the-second",
    "The spin term of the second body lacks its inertia: multiply it by b.inv_inertia.",
    lambda a, b, axis: masses(a, b) + spin_term(a, axis) + lever_cross(b, axis) ** 2,
)
known(
    "size-for-the-square",
    "The cross product counts by its size and is not squared: abs() makes no square.",
    with_term(lambda lever, axis: abs(lever_cross(lever, axis)) * inverse(lever.inertia)),
)
known(
    "doubled-for-the-square",
    "The cross product is doubled, * 2, and not squared, ** 2.",
    with_term(lambda lever, axis: 2 * lever_cross(lever, axis) * inverse(lever.inertia)),
)
known(
    "half-of-the-terms",
    "The spin terms are half of what they must be; they have no factor of their own.",
    with_term(lambda lever, axis: spin_term(lever, axis) / 2),
)
known(
    "second-term-replaces-the-sum",
    "Only B's spin term is left: add it to total, or it takes the place of all the rest.",
    lambda a, b, axis: spin_term(b, axis),
)
known(
    "first-inertia-for-both",
    "Both spin terms use the inertia of A; the second body has one of its own.",
    lambda a, b, axis: (
        masses(a, b) + spin_term(a, axis) + lever_cross(b, axis) ** 2 * inverse(a.inertia)
    ),
)
known(
    "sum-before-the-square",
    "The two cross products are added before they are squared; each body has a term of its own.",
    lambda a, b, axis: (
        masses(a, b)
        + (lever_cross(a, axis) + lever_cross(b, axis)) ** 2
        * (inverse(a.inertia) + inverse(b.inertia))
    ),
)
known(
    "first-arm-for-both",
    "Both spin terms use ra; the second body has an arm of its own, rb.",
    lambda a, b, axis: (
        masses(a, b) + spin_term(a, axis) + spin_term(b._replace(rx=a.rx, ry=a.ry), axis)
    ),
)
known(
    "inertias-swapped",
    "Each arm goes with the other body's inertia; ra belongs to a, rb to b.",
    lambda a, b, axis: (
        masses(a, b)
        + lever_cross(a, axis) ** 2 * inverse(b.inertia)
        + lever_cross(b, axis) ** 2 * inverse(a.inertia)
    ),
)
known(
    "returns-the-inverse",
    "The sum comes back as 1 / sum; the callers divide by it themselves.",
    lambda a, b, axis: 1 / exact.effective_mass(a, b, axis),
)


def arms_crossed(a: Lever, b: Lever, axis: Pair) -> float:
    both = cross((a.rx, a.ry), (b.rx, b.ry)) ** 2
    return masses(a, b) + both * (inverse(a.inertia) + inverse(b.inertia))


known(
    "arms-are-crossed",
    "The two arms are crossed with each other; it is ra x axis, and rb x axis.",
    arms_crossed,
)
known(
    "mass-counts-twice",
    "The inverse inertia is multiplied by the inverse mass as well; the mass is in it already.",
    with_term(
        lambda lever, axis: (
            lever_cross(lever, axis) ** 2 * inverse(lever.inertia) * inverse(lever.mass)
        )
    ),
)
