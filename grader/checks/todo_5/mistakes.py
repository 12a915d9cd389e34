"""Known mistakes in TODO 5, as models of the shares of speed and spin that are left."""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.judge.misconceptions import mistake, truth

Shares = tuple[float, float]
Model = Callable[[float, float, float, int], Shares]  # both rates, dt, the number of steps
Factor = Callable[[float, float], float]  # what one step keeps, from a rate and dt


def right(linear: float, angular: float, dt: float, steps: int) -> Shares:
    return exact.damped(linear, dt * steps), exact.damped(angular, dt * steps)


def like(linear: float, angular: float, dt: float, steps: int) -> dict[str, str]:
    """Return the rates and the steps, in words."""
    words = {}
    words["_rates"] = f"the rates are {'equal' if linear == angular else 'different'}"
    words["_step"] = f"a step is 1/{1 / dt:.4g} s"
    return words


truth("damping", right, like, {"the speed": [0], "the spin": [1]}, apart=True)


def known(name: str, meaning: str, *models: Model) -> None:
    """Each model also in a world that leaves the damping out where both rates are 0."""
    for model in models:
        mistake("5", "damping", name, meaning, left_out_at_zero(model), model)


def left_out_at_zero(model: Model) -> Model:
    return lambda linear, angular, dt, steps: (
        model(linear, angular, dt, steps) if linear or angular else (1.0, 1.0)
    )


def per_step(factor: Factor) -> Model:
    """Return both shares from what one step keeps at a rate."""
    return lambda linear, angular, dt, steps: (
        factor(linear, dt) ** steps,
        factor(angular, dt) ** steps,
    )


known(
    "the-same-share-every-step",
    "Every step loses 1 %, so more steps lose more: 0.99^60, 0.99^120, 0.99^240.",
    per_step(lambda rate, dt: 0.99),
)
known(
    "one-percent-per-frame",
    "The loss ignores the two rates; a step of dt seconds must keep exp(-rate * dt).",
    per_step(lambda rate, dt: 0.99 ** (60 * dt)),
    per_step(lambda rate, dt: 0.99 ** (120 * dt)),
    per_step(lambda rate, dt: 0.99**dt),
)
known(
    "rate-without-the-step",
    "Every step keeps exp(-rate) of the speed; a step of dt seconds must keep exp(-rate * dt).",
    per_step(lambda rate, dt: math.exp(-rate)),
)
known(
    "a-step-length-of-its-own",
    "Every step loses as much as one of 1/120 s; it must lose what its own dt asks for.",
    per_step(lambda rate, dt: math.exp(-rate / 120)),
)
known(
    "a-sixtieth-for-every-step",
    "Every step loses as much as one of 1/60 s; it must lose what its own dt asks for.",
    per_step(lambda rate, dt: math.exp(-rate / 60)),
)
known(
    "sixty-for-the-step",
    "Every step keeps exp(-rate * 60): the step is dt seconds long, not 60.",
    per_step(lambda rate, dt: math.exp(-rate * 60)),
)
known(
    "rate-left-out",
    "Every step keeps exp(-dt), whatever the rate: the rate belongs in it, -rate * dt.",
    per_step(lambda rate, dt: math.exp(-dt)),
)
known(
    "rates-typed-in",
    "The loss is that of the usual rates, 0.05 and 0.3, whatever rates the world has.",
    lambda linear, angular, dt, steps: right(0.05, 0.3, dt, steps),
)
known(
    "damped-twice",
    "A step damps twice: it keeps exp(-2 * rate * dt).",
    per_step(lambda rate, dt: math.exp(-2 * rate * dt)),
)
known(
    "step-times-the-share",
    "A step keeps exp(-rate) * dt: dt belongs in the exponent, in brackets.",
    per_step(lambda rate, dt: math.exp(-rate) * dt),
)
known(
    "straight-line-instead-of-exp",
    "1 - rate * dt is close for short steps only; exp(-rate * dt) holds for every step.",
    per_step(lambda rate, dt: 1 - rate * dt),
)
known(
    "one-over-instead-of-exp",
    "1 / (1 + rate * dt) is close for short steps only; exp(-rate * dt) holds for every step.",
    per_step(lambda rate, dt: 1 / (1 + rate * dt)),
)
known(
    "rate-taken-for-a-share",
    "The rate is taken for the share lost per second; at a rate of 1, exp(-1) = 37% must be left.",
    per_step(lambda rate, dt: max(0.0, 1 - rate) ** dt),
)
known(
    "a-share-typed-in",
    "A share is typed in, 0.95; the world's rates decide: exp(-rate * dt).",
    per_step(lambda rate, dt: 0.95),
    per_step(lambda rate, dt: 0.95**dt),
)
known(
    "rate-over-the-step",
    "The rate is divided by dt: a step of dt seconds keeps exp(-rate * dt).",
    per_step(lambda rate, dt: math.exp(-rate / dt)),
)
known(
    "rate-to-the-step",
    "The rate itself is raised to dt: the base is e, exp(-rate * dt).",
    per_step(lambda rate, dt: rate**dt),
)
known(
    "rate-lost-in-every-step",
    "Every step keeps 1 - rate, however short it is: a step of dt seconds keeps exp(-rate * dt).",
    per_step(lambda rate, dt: 1 - rate),
)
known(
    "share-times-the-step",
    "A step keeps 0.99 * dt, next to nothing: it must keep exp(-rate * dt).",
    per_step(lambda rate, dt: 0.99 * dt),
)
known(
    "grows-instead-of-fading",
    "The sign is missing: exp(rate * dt) makes bodies faster.",
    per_step(lambda rate, dt: math.exp(rate * dt)),
)
known(
    "keeps-what-it-should-lose",
    "The share to lose is kept: exp(-rate * dt) is what is left after a step, not what goes.",
    per_step(lambda rate, dt: 1 - math.exp(-rate * dt)),
)
known(
    "spin-is-not-damped",
    "The spin is not damped at all.",
    lambda linear, angular, dt, steps: (exact.damped(linear, dt * steps), 1.0),
)
known(
    "speed-is-not-damped",
    "The speed is not damped at all.",
    lambda linear, angular, dt, steps: (1.0, exact.damped(angular, dt * steps)),
)
known(
    "one-rate-for-both",
    "Speed and spin use the same rate; each has a rate of its own.",
    lambda linear, angular, dt, steps: right(linear, linear, dt, steps),
    lambda linear, angular, dt, steps: right(angular, angular, dt, steps),
)
known(
    "rates-are-swapped",
    "The speed fades with angular_damping and the spin with linear_damping.",
    lambda linear, angular, dt, steps: right(angular, linear, dt, steps),
)
