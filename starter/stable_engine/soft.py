"""Soft constraints: as firm as the step allows."""

import math

SAME_WAY = 0.9  # cosine; an impulse is not kept along a direction that has turned further


def softness(hertz: float, zeta: float, h: float) -> tuple[float, float]:
    """Make a constraint a damped spring of this frequency and damping ratio, stable at any h.

    Returns (rate, keep): the share of an error put right per second, and the share of a rigid
    constraint's impulse that is kept. Source: Erin Catto, "Solver2D", 2024.
    """
    omega = 2 * math.pi * hertz
    firmness = h * omega * (2 * zeta + h * omega)
    return h * omega**2 / (1 + firmness), firmness / (1 + firmness)
