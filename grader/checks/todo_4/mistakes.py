"""Known mistakes in TODO 4, as models of the friction in a step."""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.checks.exact import Pair, clamped
from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import Undecided, truth

Limit = Callable[[Pair, float], float]  # both frictions, jn -> the limit
Rule = Callable[[float, float, float], float]  # total so far, total wanted, limit -> new total
Model = Callable[[Pair, float, float, float], float]  # as exact.friction
PASSES = 8  # of the solver in a step
DEPTH = 0.265625  # px, the overlap of all discs


def describe_slip(mu: Pair, k: float, closing: float, slip: float) -> dict[str, str]:
    """Describe how the two discs rub."""
    limit = math.sqrt(mu[0] * mu[1]) * max(closing / k, 0.0)
    return {
        "ways": f"B slips {'forwards' if slip > 0 else 'backwards'}",
        "_mu": f"the two frictions are {'equal' if mu[0] == mu[1] else 'different'}",
        "limit": f"the limit is {'' if abs(slip / k) > limit else 'not '}reached",
        "_pressure": "the two are pressed" if limit else "nothing presses",
    }


truth("friction", exact.friction, describe_slip, {"the friction": []})

known = known_in("4", "friction")


def with_limit_and_rule(limit_of: Limit, rule: Rule) -> Model:
    """Return the friction of all passes with this limit, and this rule for the total."""

    def model(mu: Pair, k: float, closing: float, slip: float) -> float:
        if not (mu[0] and mu[1]):
            raise Undecided  # an engine may skip friction of 0
        total, limit = 0.0, limit_of(mu, max(closing / k, 0.0))
        for _ in range(PASSES):
            total = rule(total, total - (slip + k * total) / k, limit)
        return total

    return model


# ---------------------------------------------------------------- the right clamp, another limit


def with_limit(limit_of: Limit) -> Model:
    return with_limit_and_rule(limit_of, lambda total, wanted, limit: clamped(wanted, limit))


known("friction-of-a-only", with_limit(lambda mu, jn: mu[0] * jn))
known("friction-of-b-only", with_limit(lambda mu, jn: mu[1] * jn))
known("root-is-forgotten", with_limit(lambda mu, jn: mu[0] * mu[1] * jn))
known("root-over-jn-too", with_limit(lambda mu, jn: math.sqrt(mu[0] * mu[1] * jn)))
known("arithmetic-mean-of-mu", with_limit(lambda mu, jn: (mu[0] + mu[1]) / 2 * jn))
known("smaller-mu", with_limit(lambda mu, jn: min(mu) * jn))
known("six-tenths", with_limit(lambda mu, jn: 0.6 * jn))
known("rough-is-one", with_limit(lambda mu, jn: math.sqrt(min(mu[0], 1.0) * min(mu[1], 1.0)) * jn))
known("limit-without-mu", with_limit(lambda mu, jn: jn))
known("limit-without-jn", with_limit(lambda mu, jn: math.sqrt(mu[0] * mu[1])))
known("limit-comes-from-the-depth", with_limit(lambda mu, jn: math.sqrt(mu[0] * mu[1]) * DEPTH))


# ---------------------------------------------------------------- the right limit, another clamp


def with_clamp(rule: Rule, sign: int = 1) -> Model:
    """Return the friction with the right limit and this rule.

    With sign -1, the rule is for totals that count the other way.
    """
    return with_limit_and_rule(
        lambda mu, jn: math.sqrt(mu[0] * mu[1]) * jn,
        lambda total, wanted, limit: sign * rule(sign * total, sign * wanted, limit),
    )


known("no-limit", with_clamp(lambda total, wanted, limit: wanted))
known("no-friction-at-all", with_clamp(lambda total, wanted, limit: 0.0))
known(
    "clamps-the-increment",
    with_clamp(lambda total, wanted, limit: total + clamped(wanted - total, limit)),
)
known(
    "total-for-the-lower-bound",
    with_clamp(lambda total, wanted, limit: max(-wanted, min(wanted, limit))),
)


@known("always-at-the-limit")
@with_clamp
def always_at_the_limit(total: float, wanted: float, limit: float) -> float:
    if abs(wanted) < 1e-9:
        raise Undecided  # either way
    return math.copysign(limit, wanted)


@known("against-the-slip")
@with_clamp
def against_the_slip(total: float, wanted: float, limit: float) -> float:
    if math.isclose(wanted, total, rel_tol=1e-9, abs_tol=1e-9):
        raise Undecided  # no slip: either way
    return math.copysign(min(abs(wanted), limit), wanted - total)


known(
    "lets-go-beyond-the-limit",
    with_clamp(lambda total, wanted, limit: wanted if abs(wanted) <= limit else 0.0),
)
known("clamps-from-above-only", with_clamp(lambda total, wanted, limit: min(limit, wanted)))
known("clamps-from-below-only", with_clamp(lambda total, wanted, limit: max(-limit, wanted)))

# Which way a total counts as positive is each engine's own business.
for sign in (1, -1):
    known(
        "limit-never-below-zero",
        with_clamp(lambda total, wanted, limit: max(0.0, min(limit, wanted)), sign),
    )
    known(
        "loses-the-sign",
        with_clamp(lambda total, wanted, limit: min(abs(wanted), limit), sign),
        with_clamp(lambda total, wanted, limit: limit if abs(wanted) > limit else wanted, sign),
    )
    known("clamp-is-turned-round", with_clamp(lambda total, wanted, limit: -limit, sign))


known("half-the-limit", with_limit(lambda mu, jn: math.sqrt(mu[0] * mu[1]) * jn / 2))
known("twice-the-limit", with_limit(lambda mu, jn: math.sqrt(mu[0] * mu[1]) * jn * 2))


@known("limit-grows-with-the-slip")
def limit_grows_with_the_slip(mu: Pair, k: float, closing: float, slip: float) -> float:
    if not (mu[0] and mu[1]):
        raise Undecided
    total, limit = 0.0, math.sqrt(mu[0] * mu[1]) * max(closing / k, 0.0)
    for _ in range(PASSES):
        now = slip + k * total
        total = max(-limit * now, min(limit * now, total - now / k))
    return total


def kept_as_wanted(applied: Rule) -> Model:
    """Return the friction of a contact that stores the wanted total and applies a part of it.

    `applied` takes the stored total, the wanted total, and the limit.
    """

    def model(mu: Pair, k: float, closing: float, slip: float) -> float:
        if not (mu[0] and mu[1]):
            raise Undecided
        total = kept = 0.0
        limit = math.sqrt(mu[0] * mu[1]) * max(closing / k, 0.0)
        for _ in range(PASSES):
            wanted = kept - (slip + k * total) / k
            total, kept = total + applied(kept, wanted, limit), wanted
        return total

    return model


known(
    "result-goes-to-the-contact",
    kept_as_wanted(lambda kept, wanted, limit: wanted - clamped(wanted, limit)),
    kept_as_wanted(
        lambda kept, wanted, limit: (
            wanted - (kept if abs(wanted) <= limit else math.copysign(limit, wanted))
        )
    ),
)
for sign in (1, -1):
    known(
        "lower-limit-without-its-minus",
        with_clamp(lambda total, wanted, limit: limit if wanted > limit else -limit, sign),
    )


# ---------------------------------------------------------------- another limit and another clamp


LIMITS: dict[str, Limit] = {
    "friction-of-a-only": lambda mu, jn: mu[0] * jn,
    "friction-of-b-only": lambda mu, jn: mu[1] * jn,
    "root-is-forgotten": lambda mu, jn: mu[0] * mu[1] * jn,
    "arithmetic-mean-of-mu": lambda mu, jn: (mu[0] + mu[1]) / 2 * jn,
    "smaller-mu": lambda mu, jn: min(mu) * jn,
    "six-tenths": lambda mu, jn: 0.6 * jn,
}
RULES: tuple[tuple[str, Rule], ...] = (
    ("clamps-the-increment", lambda total, wanted, limit: total + clamped(wanted - total, limit)),
    ("lets-go-beyond-the-limit", lambda total, wanted, limit: wanted * (abs(wanted) <= limit)),
    ("clamps-from-above-only", lambda total, wanted, limit: min(limit, wanted)),
    ("clamps-from-below-only", lambda total, wanted, limit: max(-limit, wanted)),
    ("loses-the-sign", lambda total, wanted, limit: limit if abs(wanted) > limit else wanted),
    ("loses-the-sign", lambda total, wanted, limit: -limit if abs(wanted) > limit else wanted),
)


for limit_name, limit_of in LIMITS.items():
    for rule_name, rule in RULES:
        known(
            f"{limit_name}+{rule_name}",
            with_limit_and_rule(limit_of, rule),
        )
known("jn-counts-twice", with_limit(lambda mu, jn: math.sqrt(mu[0] * mu[1]) * jn**2))
