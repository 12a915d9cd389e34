"""Things I need in more than one file."""

import math


def between(low, value, high):
    return low if value < low else high if value > high else value


def coulomb(mu_a, mu_b, push):
    """The most that friction may do."""
    return math.sqrt(mu_a * mu_b) * push


def decay(rate, seconds):
    return math.exp(-rate * seconds)
