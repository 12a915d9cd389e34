"""Shapes and vector products."""

from __future__ import annotations

from abc import ABC, abstractmethod

from pygame import Vector2


def cross(a: Vector2, b: Vector2) -> float:
    """2D cross product."""
    return a.x * b.y - a.y * b.x


def spin_velocity(omega: float, r: Vector2) -> Vector2:
    """Velocity of a point at r on a body that turns with omega."""
    return Vector2(-omega * r.y, omega * r.x)


class Shape(ABC):
    """Anything a body can look like."""

    @abstractmethod
    def inverse_inertia(self, mass: float) -> float:
        """One over the moment of inertia; 0 for a mass of 0."""


class Circle(Shape):
    """A disc."""

    def __init__(self, radius: float) -> None:
        self.radius = radius

    def inverse_inertia(self, mass: float) -> float:
        if mass == 0:
            return 0.0
        return 1.0 / (0.5 * mass * self.radius**2)


class Box(Shape):
    """An axis-aligned rectangle; static only."""

    def __init__(self, half: Vector2) -> None:
        self.half = Vector2(half)

    def inverse_inertia(self, mass: float) -> float:
        if mass != 0:
            raise ValueError(f"A box must be static, but its mass is {mass}.")
        return 0.0

    def closest_to(self, offset: Vector2) -> Vector2:
        """The point of the box that is closest to offset, both as seen from its centre."""
        return Vector2(
            max(-self.half.x, min(self.half.x, offset.x)),
            max(-self.half.y, min(self.half.y, offset.y)),
        )
