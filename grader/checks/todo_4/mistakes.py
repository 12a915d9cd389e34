"""Known mistakes in TODO 4, as models of the friction in a step."""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.checks.exact import Pair, clamp
from grader.checks.mistakes import Models, register
from grader.judge.explain.misconceptions import Kind, Undecided, kinds

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


kinds["friction"] = Kind(exact.friction, describe_slip, {"the friction": []})


def right_limit(mu: Pair, jn: float) -> float:
    return math.sqrt(mu[0] * mu[1]) * jn


def right_rule(total: float, wanted: float, limit: float) -> float:
    return clamp(wanted, limit)


def with_both(limit_of: Limit, rule: Rule) -> Model:
    """Return the friction after all passes, with this limit and this rule for the total."""

    def model(mu: Pair, k: float, closing: float, slip: float) -> float:
        if not (mu[0] and mu[1]):
            raise Undecided  # an engine may skip friction of 0
        total, limit = 0.0, limit_of(mu, max(closing / k, 0.0))
        for _ in range(PASSES):
            total = rule(total, total - (slip + k * total) / k, limit)
        return total

    return model


def with_limit(limit_of: Limit) -> Model:
    return with_both(limit_of, right_rule)


def with_rule(rule: Rule, sign: int = 1) -> Model:
    """Return the friction with the right limit and this rule.

    With `sign` -1, the rule takes totals of the opposite sign.
    """
    return with_both(
        right_limit,
        lambda total, wanted, limit: sign * rule(sign * total, sign * wanted, limit),
    )


def always_at_the_limit(total: float, wanted: float, limit: float) -> float:
    if abs(wanted) < 1e-9:
        raise Undecided  # either way
    return math.copysign(limit, wanted)


def against_the_slip(total: float, wanted: float, limit: float) -> float:
    if math.isclose(wanted, total, rel_tol=1e-9, abs_tol=1e-9):
        raise Undecided  # no slip: either way
    return math.copysign(min(abs(wanted), limit), wanted - total)


def limit_grows_with_the_slip(mu: Pair, k: float, closing: float, slip: float) -> float:
    def rule(total: float, wanted: float, limit: float) -> float:
        return clamp(wanted, limit * (slip + k * total))

    return with_both(right_limit, rule)(mu, k, closing, slip)


def keep_wanted(applied: Rule) -> Model:
    """Return the friction of a contact that stores the wanted total and applies a part of it.

    `applied` takes the stored total, the wanted total, and the limit.
    """

    def model(mu: Pair, k: float, closing: float, slip: float) -> float:
        if not (mu[0] and mu[1]):
            raise Undecided
        total = stored = 0.0
        limit = right_limit(mu, max(closing / k, 0.0))
        for _ in range(PASSES):
            wanted = stored - (slip + k * total) / k
            total, stored = total + applied(stored, wanted, limit), wanted
        return total

    return model


def apply_overshoot(stored: float, wanted: float, limit: float) -> float:
    return wanted - clamp(wanted, limit)


def apply_change(stored: float, wanted: float, limit: float) -> float:
    return wanted - (stored if abs(wanted) <= limit else math.copysign(limit, wanted))


LIMITS: dict[str, Limit] = {
    "friction-of-a-only": lambda mu, jn: mu[0] * jn,
    "friction-of-b-only": lambda mu, jn: mu[1] * jn,
    "root-is-forgotten": lambda mu, jn: mu[0] * mu[1] * jn,
    "arithmetic-mean-of-mu": lambda mu, jn: (mu[0] + mu[1]) / 2 * jn,
    "smaller-mu": lambda mu, jn: min(mu) * jn,
    "six-tenths": lambda mu, jn: 0.6 * jn,
    "root-over-jn-too": lambda mu, jn: math.sqrt(mu[0] * mu[1] * jn),
    "rough-is-one": lambda mu, jn: math.sqrt(min(mu[0], 1.0) * min(mu[1], 1.0)) * jn,
    "limit-without-mu": lambda mu, jn: jn,
    "limit-without-jn": lambda mu, jn: right_limit(mu, 1.0),
    "limit-comes-from-the-depth": lambda mu, jn: right_limit(mu, DEPTH),
    "half-the-limit": lambda mu, jn: right_limit(mu, jn) / 2,
    "twice-the-limit": lambda mu, jn: right_limit(mu, jn) * 2,
    "jn-counts-twice": lambda mu, jn: right_limit(mu, jn) * jn,
}
RULES: tuple[tuple[str, Rule], ...] = (
    ("clamps-the-increment", lambda total, wanted, limit: total + clamp(wanted - total, limit)),
    ("lets-go-beyond-the-limit", lambda total, wanted, limit: wanted * (abs(wanted) <= limit)),
    ("clamps-from-above-only", lambda total, wanted, limit: min(limit, wanted)),
    ("clamps-from-below-only", lambda total, wanted, limit: max(-limit, wanted)),
    ("loses-the-sign", lambda total, wanted, limit: limit if abs(wanted) > limit else wanted),
    ("loses-the-sign", lambda total, wanted, limit: -limit if abs(wanted) > limit else wanted),
    ("no-limit", lambda total, wanted, limit: wanted),
    ("no-friction-at-all", lambda total, wanted, limit: 0.0),
    ("total-for-the-lower-bound", lambda total, wanted, limit: max(-wanted, min(wanted, limit))),
    ("always-at-the-limit", always_at_the_limit),
    ("against-the-slip", against_the_slip),
)
# Which way a total counts as positive is each engine's own business.
EITHER_WAY: tuple[tuple[str, Rule], ...] = (
    ("limit-never-below-zero", lambda total, wanted, limit: max(0.0, min(limit, wanted))),
    ("loses-the-sign", lambda total, wanted, limit: min(abs(wanted), limit)),
    ("clamp-is-turned-round", lambda total, wanted, limit: -limit),
    (
        "lower-limit-without-its-minus",
        lambda total, wanted, limit: limit if wanted > limit else -limit,
    ),
)
IN_PAIRS = 6  # of the limits and of the rules that are combined

MODELS: Models = (
    *((name, with_limit(limit)) for name, limit in LIMITS.items()),
    *((name, with_rule(rule)) for name, rule in RULES),
    *((name, with_rule(rule, sign)) for name, rule in EITHER_WAY for sign in (1, -1)),
    ("limit-grows-with-the-slip", limit_grows_with_the_slip),
    ("result-goes-to-the-contact", keep_wanted(apply_overshoot)),
    ("result-goes-to-the-contact", keep_wanted(apply_change)),
    *(
        (f"{limit_name}+{rule_name}", with_both(limit, rule))
        for limit_name, limit in [*LIMITS.items()][:IN_PAIRS]
        for rule_name, rule in RULES[:IN_PAIRS]
    ),
)
register("4", "friction", MODELS)
