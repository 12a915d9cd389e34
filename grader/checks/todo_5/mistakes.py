"""Known mistakes in TODO 5, as models of the shares of speed and spin that are left."""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import truth

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


truth("damping", keep_shares, describe_rates, {"the speed": [0], "the spin": [1]}, apart=True)

known_damping = known_in("5", "damping")


def known(name: str, *models: Model) -> None:
    """Register each model, also for a world that skips damping if both rates are 0."""
    for model in models:
        known_damping(name, left_out_at_zero(model), model)


def left_out_at_zero(model: Model) -> Model:
    return lambda linear, angular, dt, steps: (
        model(linear, angular, dt, steps) if linear or angular else (1.0, 1.0)
    )


def per_step(factor: Factor) -> Model:
    """Return both shares from the share that one step keeps at a rate."""
    return lambda linear, angular, dt, steps: (
        factor(linear, dt) ** steps,
        factor(angular, dt) ** steps,
    )


known("the-same-share-every-step", per_step(lambda rate, dt: 0.99))
known(
    "one-percent-per-frame",
    per_step(lambda rate, dt: 0.99 ** (60 * dt)),
    per_step(lambda rate, dt: 0.99 ** (120 * dt)),
    per_step(lambda rate, dt: 0.99**dt),
)
known("rate-without-the-step", per_step(lambda rate, dt: math.exp(-rate)))
known("a-step-length-of-its-own", per_step(lambda rate, dt: math.exp(-rate / 120)))
known("a-sixtieth-for-every-step", per_step(lambda rate, dt: math.exp(-rate / 60)))
known("sixty-for-the-step", per_step(lambda rate, dt: math.exp(-rate * 60)))
known("rate-left-out", per_step(lambda rate, dt: math.exp(-dt)))
known("rates-typed-in", lambda linear, angular, dt, steps: keep_shares(0.05, 0.3, dt, steps))
known("damped-twice", per_step(lambda rate, dt: math.exp(-2 * rate * dt)))
known("step-times-the-share", per_step(lambda rate, dt: math.exp(-rate) * dt))
known("straight-line-instead-of-exp", per_step(lambda rate, dt: 1 - rate * dt))
known("one-over-instead-of-exp", per_step(lambda rate, dt: 1 / (1 + rate * dt)))
known("rate-taken-for-a-share", per_step(lambda rate, dt: max(0.0, 1 - rate) ** dt))
known("a-share-typed-in", per_step(lambda rate, dt: 0.95), per_step(lambda rate, dt: 0.95**dt))
known("rate-over-the-step", per_step(lambda rate, dt: math.exp(-rate / dt)))
known("rate-to-the-step", per_step(lambda rate, dt: rate**dt))
known("rate-lost-in-every-step", per_step(lambda rate, dt: 1 - rate))
known("share-times-the-step", per_step(lambda rate, dt: 0.99 * dt))
known("grows-instead-of-fading", per_step(lambda rate, dt: math.exp(rate * dt)))
known("keeps-what-it-should-lose", per_step(lambda rate, dt: 1 - math.exp(-rate * dt)))
known(
    "spin-is-not-damped",
    lambda linear, angular, dt, steps: (exact.compute_share(linear, dt * steps), 1.0),
)
known(
    "speed-is-not-damped",
    lambda linear, angular, dt, steps: (1.0, exact.compute_share(angular, dt * steps)),
)
known(
    "one-rate-for-both",
    lambda linear, angular, dt, steps: keep_shares(linear, linear, dt, steps),
    lambda linear, angular, dt, steps: keep_shares(angular, angular, dt, steps),
)
known(
    "rates-are-swapped", lambda linear, angular, dt, steps: keep_shares(angular, linear, dt, steps)
)
