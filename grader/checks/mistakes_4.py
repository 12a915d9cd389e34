"""Known mistakes in TODO 4, as models of the friction in total after each pass."""

import math
from collections.abc import Callable, Sequence

from grader.checks import exact
from grader.checks.exact import Pair, Rubbing, clamped
from grader.judge.misconceptions import Undecided, mistake, truth

Totals = tuple[float, ...]
Rule = Callable[[float, float, float], float]  # total so far, total wanted, limit -> new total

truth("friction")(exact.friction_totals)


def known(name: str, meaning: str, rule: Rule) -> None:
    """A mistake in what is done with the right limit."""
    register(name, meaning, lambda mu, jn: math.sqrt(mu[0] * mu[1]) * jn, rule)


def known_limit(name: str, meaning: str, limit: Callable[[Pair, float], float]) -> None:
    """A mistake in the limit, with the right clamp."""
    register(name, meaning, limit, lambda total, wanted, limit: clamped(wanted, limit))


def register(name: str, meaning: str, limit_of: Callable[[Pair, float], float], rule: Rule) -> None:
    @mistake("4", name, meaning, about="friction")
    def model(mu: Pair, k: float, passes: Sequence[Rubbing]) -> Totals:
        if not (mu[0] and mu[1]):
            raise Undecided  # an engine may leave friction out where there is none
        totals = [0.0]
        for each in passes:
            limit = limit_of(mu, each.pressed(k))
            totals.append(rule(totals[-1], totals[-1] - each.slip / k, limit))
        return tuple(totals[1:])


known(
    "no-limit",
    "The friction impulse has no limit; it may not exceed sqrt(mu_a mu_b) * jn either way.",
    lambda total, wanted, limit: wanted,
)
known(
    "clamps-the-increment",
    "Each pass's change is clamped; the clamp is for the total, or passes add up beyond it.",
    lambda total, wanted, limit: total + clamped(wanted - total, limit),
)
known(
    "always-at-the-limit",
    "Friction always pushes with all its limit; where less ends the slip, it must stop there.",
    lambda total, wanted, limit: math.copysign(limit, wanted),
)
known(
    "no-friction-beyond-the-limit",
    "Beyond the limit there is no friction at all; a sliding body is held back by the limit.",
    lambda total, wanted, limit: wanted if abs(wanted) <= limit else 0.0,
)
known(
    "no-friction-at-all",
    "Friction does nothing; the total is to be kept within the limit, not away.",
    lambda total, wanted, limit: 0.0,
)

for sign in (1, -1):  # which way is positive is the engine's own business

    def turned(rule: Rule, sign: int = sign) -> Rule:
        return lambda total, wanted, limit: sign * rule(sign * total, sign * wanted, limit)

    known(
        "limits-one-direction",
        "Friction is limited in one direction only; the limit holds for slip both ways.",
        turned(lambda total, wanted, limit: min(wanted, limit)),
    )
    known(
        "clamps-like-the-normal",
        "The total is kept at 0 or more, like jn; friction acts in both directions.",
        turned(lambda total, wanted, limit: max(0.0, min(wanted, limit))),
    )
    known(
        "loses-the-direction",
        "Beyond the limit, friction pushes the same way whichever way the body slips.",
        turned(lambda total, wanted, limit: limit if abs(wanted) > limit else wanted),
    )

known_limit(
    "friction-of-a-only",
    "The limit uses the first body's friction only; it takes both, sqrt(mu_a mu_b).",
    lambda mu, jn: mu[0] * jn,
)
known_limit(
    "friction-of-b-only",
    "The limit uses the second body's friction only; it takes both, sqrt(mu_a mu_b).",
    lambda mu, jn: mu[1] * jn,
)
known_limit(
    "forgets-the-root",
    "The frictions are multiplied, and the square root of the product is missing.",
    lambda mu, jn: mu[0] * mu[1] * jn,
)
known_limit(
    "averages-the-frictions",
    "The limit uses the arithmetic mean of both frictions; it takes the geometric one.",
    lambda mu, jn: (mu[0] + mu[1]) / 2 * jn,
)
known_limit(
    "smaller-friction",
    "The limit uses the smaller friction, as bounces use restitution; it takes sqrt(mu_a mu_b).",
    lambda mu, jn: min(mu) * jn,
)
known_limit(
    "forgets-jn",
    "The limit lacks jn: without pressure there is no friction, and more of it holds more.",
    lambda mu, jn: math.sqrt(mu[0] * mu[1]),
)
known_limit(
    "root-over-jn-too",
    "The square root covers jn as well; only the frictions are under it.",
    lambda mu, jn: math.sqrt(mu[0] * mu[1] * jn),
)
