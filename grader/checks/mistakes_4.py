"""Known mistakes in TODO 4, as models of the friction in total after each pass."""

import math
from collections.abc import Callable, Sequence

from grader.checks import exact
from grader.checks.exact import DEPTH, Pair, Rubbing, clamped
from grader.judge.misconceptions import Undecided, mistake, truth

Limit = Callable[[Pair, float], float]  # both frictions, jn -> the limit
Rule = Callable[[float, float, float], float]  # total so far, total wanted, limit -> new total

truth("friction")(exact.friction_totals)


def register(name: str, meaning: str, limit_of: Limit, rule: Rule) -> None:
    @mistake("4", name, meaning, about="friction")
    def model(mu: Pair, k: float, passes: Sequence[Rubbing]) -> tuple[float, ...]:
        if not (mu[0] and mu[1]):
            raise Undecided  # an engine may leave friction out where there is none
        totals = [0.0]
        for each in passes:
            limit = limit_of(mu, each.pressed(k))
            totals.append(rule(totals[-1], totals[-1] - each.slip / k, limit))
        return tuple(totals[1:])


# ---------------------------------------------------------------- the right clamp, another limit


def limit(name: str, meaning: str) -> Callable[[Limit], None]:
    def known(limit_of: Limit) -> None:
        register(name, meaning, limit_of, lambda total, wanted, limit: clamped(wanted, limit))

    return known


limit("friction-of-a-only", "The limit has the friction of A alone; it takes sqrt(mu_a mu_b).")(
    lambda mu, jn: mu[0] * jn
)

limit("friction-of-b-only", "The limit has the friction of B alone; it takes sqrt(mu_a mu_b).")(
    lambda mu, jn: mu[1] * jn
)

limit("root-is-forgotten", "The two frictions are multiplied, and the square root is missing.")(
    lambda mu, jn: mu[0] * mu[1] * jn
)

limit("root-over-jn-too", "jn is under the square root; only the two frictions belong there.")(
    lambda mu, jn: math.sqrt(mu[0] * mu[1] * jn)
)

limit("arithmetic-mean-of-mu", "Half the sum of the frictions: rubber would grip even on ice.")(
    lambda mu, jn: (mu[0] + mu[1]) / 2 * jn
)

limit("smaller-mu", "The smaller friction counts, as restitution does; it takes sqrt(mu_a mu_b).")(
    lambda mu, jn: min(mu) * jn
)

limit("limit-without-mu", "The limit is jn itself: ice would grip as well as rubber.")(
    lambda mu, jn: jn
)

limit("limit-without-jn", "The limit lacks jn: the harder two bodies press, the more friction.")(
    lambda mu, jn: math.sqrt(mu[0] * mu[1])
)

limit(
    "limit-comes-from-the-depth", "The limit takes the depth of the overlap for the pressure, jn."
)(lambda mu, jn: math.sqrt(mu[0] * mu[1]) * DEPTH)


# ---------------------------------------------------------------- the right limit, another clamp


def clamp(name: str, meaning: str, sign: int = 1) -> Callable[[Rule], None]:
    """With sign -1, the rule is for totals that count the other way."""

    def known(rule: Rule) -> None:
        register(
            name,
            meaning,
            lambda mu, jn: math.sqrt(mu[0] * mu[1]) * jn,
            lambda total, wanted, limit: sign * rule(sign * total, sign * wanted, limit),
        )

    return known


clamp("no-limit", "Friction has no limit; it may be sqrt(mu_a mu_b) * jn at the most, either way.")(
    lambda total, wanted, limit: wanted
)

clamp("no-friction-at-all", "The total stays 0; keep what is wanted of it within the limit.")(
    lambda total, wanted, limit: 0.0
)

clamp(
    "clamps-the-increment", "Each change is clamped; clamp the total, or passes add up beyond it."
)(lambda total, wanted, limit: total + clamped(wanted - total, limit))


@clamp("always-at-the-limit", "Friction is always as large as its limit; less may end the slip.")
def always(total: float, wanted: float, limit: float) -> float:
    if abs(wanted) < 1e-9:
        raise Undecided  # either way
    return math.copysign(limit, wanted)


clamp(
    "lets-go-beyond-the-limit", "Beyond the limit friction is 0; a sliding body still feels it all."
)(lambda total, wanted, limit: wanted if abs(wanted) <= limit else 0.0)

clamp(
    "clamps-from-above-only", "The total has an upper limit only; slip the other way needs one too."
)(lambda total, wanted, limit: min(limit, wanted))

clamp(
    "clamps-from-below-only", "The total has a lower limit only; slip the other way needs one too."
)(lambda total, wanted, limit: max(-limit, wanted))

# Which way a total counts as positive is each engine's own business.
for sign in (1, -1):
    clamp(
        "limit-never-below-zero",
        "The total is kept from 0 up, like jn; friction acts both ways.",
        sign,
    )(lambda total, wanted, limit: max(0.0, min(limit, wanted)))
    clamp(
        "loses-the-sign", "The size is limited and the sign lost: friction acts one way only.", sign
    )(lambda total, wanted, limit: min(abs(wanted), limit))
    clamp(
        "loses-the-sign", "The size is limited and the sign lost: friction acts one way only.", sign
    )(lambda total, wanted, limit: limit if abs(wanted) > limit else wanted)
    clamp(
        "clamp-is-turned-round",
        "min and max are swapped: the total is the same whatever the slip.",
        sign,
    )(lambda total, wanted, limit: -limit)
