"""Known mistakes in TODO 5, as models of the shares of speed and spin that are left."""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.checks.mistakes import register
from grader.judge.explain.misconceptions import Kind, kinds

Shares = tuple[float, float]
Model = Callable[[float, float, float, int], Shares]  # both rates, dt, the number of steps
Factor = Callable[[float, float], float]  # share that one step keeps, from a rate and dt


def keep_shares(linear: float, angular: float, dt: float, steps: int) -> Shares:
    return exact.compute_share(linear, dt * steps), exact.compute_share(angular, dt * steps)


def describe_rates(linear: float, angular: float, dt: float, steps: int) -> dict[str, str]:
    """Return the rates and the steps, in words."""
    words = {}
    words["_rates"] = f"the rates are {'equal' if linear == angular else 'different'}"
    words["_step"] = f"a step is 1/{1 / dt:.4g} s"
    return words


kinds["damping"] = Kind(
    keep_shares, describe_rates, {"the speed": [0], "the spin": [1]}, apart=True
)


def left_out_at_zero(model: Model) -> Model:
    """Return the model of a world that skips damping if both rates are 0."""
    return lambda linear, angular, dt, steps: (
        model(linear, angular, dt, steps) if linear or angular else (1.0, 1.0)
    )


def per_step(factor: Factor) -> Model:
    """Return the model of both shares; `factor` is the share that a step keeps."""
    return lambda linear, angular, dt, steps: (
        factor(linear, dt) ** steps,
        factor(angular, dt) ** steps,
    )


FACTORS: tuple[tuple[str, Factor], ...] = (
    ("the-same-share-every-step", lambda rate, dt: 0.99),
    ("one-percent-per-frame", lambda rate, dt: 0.99 ** (60 * dt)),
    ("one-percent-per-frame", lambda rate, dt: 0.99 ** (120 * dt)),
    ("one-percent-per-frame", lambda rate, dt: 0.99**dt),
    ("rate-without-the-step", lambda rate, dt: math.exp(-rate)),
    ("a-step-length-of-its-own", lambda rate, dt: math.exp(-rate / 120)),
    ("a-sixtieth-for-every-step", lambda rate, dt: math.exp(-rate / 60)),
    ("sixty-for-the-step", lambda rate, dt: math.exp(-rate * 60)),
    ("rate-left-out", lambda rate, dt: math.exp(-dt)),
    ("damped-twice", lambda rate, dt: math.exp(-2 * rate * dt)),
    ("step-times-the-share", lambda rate, dt: math.exp(-rate) * dt),
    ("straight-line-instead-of-exp", lambda rate, dt: 1 - rate * dt),
    ("one-over-instead-of-exp", lambda rate, dt: 1 / (1 + rate * dt)),
    ("rate-taken-for-a-share", lambda rate, dt: max(0.0, 1 - rate) ** dt),
    ("a-share-typed-in", lambda rate, dt: 0.95),
    ("a-share-typed-in", lambda rate, dt: 0.95**dt),
    ("rate-over-the-step", lambda rate, dt: math.exp(-rate / dt)),
    ("rate-to-the-step", lambda rate, dt: rate**dt),
    ("rate-lost-in-every-step", lambda rate, dt: 1 - rate),
    ("share-times-the-step", lambda rate, dt: 0.99 * dt),
    ("grows-instead-of-fading", lambda rate, dt: math.exp(rate * dt)),
    ("keeps-what-it-should-lose", lambda rate, dt: 1 - math.exp(-rate * dt)),
)
SHARES: tuple[tuple[str, Model], ...] = (
    ("rates-typed-in", lambda linear, angular, dt, n: keep_shares(0.05, 0.3, dt, n)),
    ("spin-is-not-damped", lambda linear, angular, dt, n: keep_shares(linear, 0.0, dt, n)),
    ("speed-is-not-damped", lambda linear, angular, dt, n: keep_shares(0.0, angular, dt, n)),
    ("one-rate-for-both", lambda linear, angular, dt, n: keep_shares(linear, linear, dt, n)),
    ("one-rate-for-both", lambda linear, angular, dt, n: keep_shares(angular, angular, dt, n)),
    ("rates-are-swapped", lambda linear, angular, dt, n: keep_shares(angular, linear, dt, n)),
)
for name, model in (*((name, per_step(each)) for name, each in FACTORS), *SHARES):
    register("5", "damping", [(name, left_out_at_zero(model)), (name, model)])
