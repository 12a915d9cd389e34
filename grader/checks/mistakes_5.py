"""Known mistakes in TODO 5, as models of the shares of speed and spin that are left."""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.judge.misconceptions import mistake, truth

Shares = tuple[float, float]


@truth("damping")
def right(linear: float, angular: float, dt: float, steps: int) -> Shares:
    return exact.damped(linear, dt * steps), exact.damped(angular, dt * steps)


def per_step(factor: Callable[[float, float], float]) -> Callable[..., Shares]:
    """Both shares from what one step keeps at a rate."""

    def model(linear: float, angular: float, dt: float, steps: int) -> Shares:
        return factor(linear, dt) ** steps, factor(angular, dt) ** steps

    return model


mistake(
    "5",
    "the-same-share-every-step",
    "The loss grows with the number of steps: 0.99^60, 0.99^120, 0.99^240.",
    about="damping",
)(per_step(lambda rate, dt: 0.99 if rate else 1.0))

mistake(
    "5",
    "rate-without-the-step",
    "exp(-rate) is lost in every step; a step of dt seconds may lose only exp(-rate * dt).",
    about="damping",
)(per_step(lambda rate, dt: math.exp(-rate)))

mistake(
    "5",
    "straight-line-instead-of-exp",
    "1 - rate * dt is close for short steps only; exp(-rate * dt) holds for every step.",
    about="damping",
)(per_step(lambda rate, dt: 1 - rate * dt))

mistake(
    "5",
    "grows-instead-of-fading",
    "The sign is missing: exp(rate * dt) makes bodies faster.",
    about="damping",
)(per_step(lambda rate, dt: math.exp(rate * dt)))


@mistake("5", "spin-is-not-damped", "The spin is not damped at all.", about="damping")
def spin_forgotten(linear: float, angular: float, dt: float, steps: int) -> Shares:
    return exact.damped(linear, dt * steps), 1.0


@mistake(
    "5",
    "one-rate-for-both",
    "Speed and spin use the same rate; the spin has angular_damping of its own.",
    about="damping",
)
def linear_for_both(linear: float, angular: float, dt: float, steps: int) -> Shares:
    return exact.damped(linear, dt * steps), exact.damped(linear, dt * steps)
