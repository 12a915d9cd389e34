"""Rigid bodies."""

from __future__ import annotations

from pygame import Vector2

from ..geometry import Shape


class Body:
    """One rigid body. A mass of 0 makes it static."""

    def __init__(
        self,
        shape: Shape,
        pos: Vector2 | tuple[float, float],
        mass: float = 0.0,
        restitution: float = 0.3,
        friction: float = 0.6,
        color: tuple[int, int, int] = (170, 190, 220),
    ) -> None:
        self.shape = shape
        self.pos = Vector2(pos)
        self.vel = Vector2(0, 0)
        self.angle = 0.0
        self.omega = 0.0
        self.inv_mass = 0.0 if mass == 0 else 1.0 / mass
        self.inv_inertia = shape.inverse_inertia(mass)
        self.restitution = restitution
        self.friction = friction
        self.color = color

    @property
    def is_static(self) -> bool:
        return self.inv_mass == 0

    def accelerate(self, acceleration: Vector2, dt: float) -> None:
        self.vel += acceleration * dt

    def damp(self, keep_velocity: float, keep_spin: float) -> None:
        self.vel *= keep_velocity
        self.omega *= keep_spin

    def move(self, dt: float) -> None:
        self.pos += self.vel * dt
        self.angle += self.omega * dt
