"""Springs: Hooke's law with damping."""

from __future__ import annotations

from math import hypot

from .body import Body
from .effect import Effect, Joint
from .validate import not_negative


class Spring(Joint):
    """Pulls a and b towards the distance length in px: the distance they start with, unless given.

    stiffness in kg/s² (force per px), damping in kg/s (force per px/s).
    """

    __slots__ = ("damping", "length", "stiffness")
    effect = "Springs"

    def __init__(
        self,
        a: Body,
        b: Body,
        stiffness: float,
        damping: float = 0.0,
        length: float | None = None,
    ) -> None:
        super().__init__(a, b)
        start = hypot(b.x - a.x, b.y - a.y)
        self.stiffness = not_negative("Spring.stiffness", stiffness)
        self.damping = not_negative("Spring.damping", damping)
        self.length = not_negative("Spring.length", start if length is None else length)


class Springs(Effect):
    """The divisor caps a spring at what one substep can carry.

    Any stiffness is stable, and a gentle spring loses no energy.
    """

    rank = 1

    def __init__(self) -> None:
        self.springs: list[Spring] = []
        self.awake: list[Spring] = []

    def take(self, spring: Spring) -> None:
        self.springs.append(spring)
        self.awake.append(spring)

    def force(self, h: float) -> None:
        for s in self.awake:
            a, b, k, c = s.a, s.b, s.stiffness, s.damping
            dx, dy = b.x - a.x, b.y - a.y
            distance = hypot(dx, dy) or 1e-9
            nx, ny = dx / distance, dy / distance
            speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
            pull = h * (k * (distance - s.length) + c * speed)
            j = pull / (1 + h * (c + h * k) * (a.inv_mass + b.inv_mass))
            a.vx += nx * j * a.inv_mass
            a.vy += ny * j * a.inv_mass
            b.vx -= nx * j * b.inv_mass
            b.vy -= ny * j * b.inv_mass

    def links(self) -> list[tuple[Body, Body]]:
        return [(spring.a, spring.b) for spring in self.awake]

    def rouse(self) -> None:
        self.awake = [spring for spring in self.springs if spring.awake]
