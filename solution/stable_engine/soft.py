"""Soft constraints: as stiff as the step allows, and stable at any stiffness."""

import math

SAME_DIRECTION = 0.9  # cosine; an impulse is not kept along a direction that has turned further


def softness(hertz: float, zeta: float, h: float) -> tuple[float, float]:
    """Make a constraint a damped spring of this frequency and damping ratio, stable at any h.

    Returns (bias_rate, mass_scale): the share of a position error corrected per second, and the
    share of the rigid constraint's impulse to apply. Source: Erin Catto, "Solver2D", 2024.
    """
    omega = 2 * math.pi * hertz
    firmness = h * omega * (2 * zeta + h * omega)
    return h * omega**2 / (1 + firmness), firmness / (1 + firmness)
