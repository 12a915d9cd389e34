"""Shapes and the two vector products of flat physics. Nothing to do here."""

import math

from pygame import Vector2

from .validate import require


def cross(a, b):
    """The 2D cross product, a number: positive when b lies clockwise of a on the screen."""
    return a.x * b.y - a.y * b.x


def spin_velocity(omega, r):
    """Velocity (px/s) that a spin of omega (rad/s) gives a point at r (px) from the centre."""
    return Vector2(-omega * r.y, omega * r.x)


class Circle:
    """A disc. radius in px."""

    def __init__(self, radius):
        require(0 < radius < math.inf, "Circle.radius", radius, "a finite number above 0")
        self.radius = radius


class Box:
    """A rectangle that never turns. half holds half its width and half its height in px."""

    def __init__(self, half):
        self.half = Vector2(half)
        valid = 0 < self.half.x < math.inf and 0 < self.half.y < math.inf
        require(valid, "Box.half", self.half, "two finite numbers above 0")
