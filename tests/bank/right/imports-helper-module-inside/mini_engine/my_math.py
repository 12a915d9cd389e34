"""My helpers."""

import math


def clamp(x, low, high):
    return max(low, min(x, high))


def decay(rate, dt):
    return math.exp(-rate * dt)
