"""What is known about two bodies that overlap."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pygame import Vector2

from ..dynamics.impulse import apply_impulse, effective_mass
from ..geometry import spin_velocity
from ..settings import BETA, RESTING_SPEED, SLOP

if TYPE_CHECKING:
    from ..dynamics.body import Body


class Contact:
    """Two overlapping bodies. normal is a unit vector from a to b."""

    def __init__(self, a: Body, b: Body, normal: Vector2, depth: float, point: Vector2) -> None:
        self.a = a
        self.b = b
        self.normal = normal
        self.depth = depth
        self.point = point
        self.jn = 0.0
        self.jt = 0.0
        self.target = 0.0

    @property
    def arm_a(self) -> Vector2:
        return self.point - self.a.pos

    @property
    def arm_b(self) -> Vector2:
        return self.point - self.b.pos

    @property
    def tangent(self) -> Vector2:
        return Vector2(-self.normal.y, self.normal.x)

    def relative_speed(self, axis: Vector2) -> float:
        """Speed along axis of b as seen from a."""
        velocity_a = self.a.vel + spin_velocity(self.a.omega, self.arm_a)
        velocity_b = self.b.vel + spin_velocity(self.b.omega, self.arm_b)
        return (velocity_b - velocity_a).dot(axis)

    def impulse_for(self, axis: Vector2, change: float) -> float:
        """The impulse along axis that changes the speed by change."""
        return change / effective_mass(self.a, self.b, self.arm_a, self.arm_b, axis)

    def apply(self, axis: Vector2, size: float) -> None:
        apply_impulse(self.a, self.b, axis * size, self.arm_a, self.arm_b)

    def prepare(self, dt: float) -> None:
        """Choose the target speed."""
        closing = -self.relative_speed(self.normal)
        bounce = 0.0
        if closing > RESTING_SPEED:
            bounce = min(self.a.restitution, self.b.restitution) * closing
        push_out = BETA / dt * max(self.depth - SLOP, 0.0)
        self.target = max(bounce, push_out)

    def solve(self) -> None:
        """One pass."""
        self.solve_normal()
        self.solve_friction()

    def solve_normal(self) -> None:
        change = self.target - self.relative_speed(self.normal)
        total = self.jn + self.impulse_for(self.normal, change)
        if total < 0:
            total = 0.0
        self.apply(self.normal, total - self.jn)
        self.jn = total

    def solve_friction(self) -> None:
        limit = math.sqrt(self.a.friction * self.b.friction) * self.jn
        total = self.jt + self.impulse_for(self.tangent, -self.relative_speed(self.tangent))
        if total > limit:
            total = limit
        if total < -limit:
            total = -limit
        self.apply(self.tangent, total - self.jt)
        self.jt = total
