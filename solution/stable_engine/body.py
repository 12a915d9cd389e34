"""A body: a shape with a place, a velocity and a mass."""

from __future__ import annotations

from collections.abc import Iterable
from math import isfinite
from typing import TYPE_CHECKING

from pygame import Vector2

from .shapes import Box, Circle
from .validate import finite, not_negative, pair, require

if TYPE_CHECKING:
    from .sleep import Island


class Body:
    """One rigid body: plain floats inside; pos, vel and omega to read and set from outside.

    Mass 0 makes a static body, which never moves. A Box is static only. A bullet does not pass
    through static bodies, however fast it is. Raises ValueError when a value makes no sense.
    """

    __slots__ = (
        *("shape", "radius", "hx", "hy", "inv_mass", "inv_inertia", "restitution", "friction"),
        *("x", "y", "vx", "vy", "angle", "w"),
        *("id", "bullet", "idle", "asleep", "still", "island"),
    )

    def __init__(
        self,
        shape: Circle | Box,
        pos: Iterable[float],
        mass: float = 0.0,
        restitution: float = 0.3,
        friction: float = 0.6,
        bullet: bool = False,
    ) -> None:
        not_negative("Body.mass", mass)
        require(0 <= restitution <= 1, "Body.restitution", restitution, "from 0 to 1")
        require(mass > 0 or not bullet, "Body.mass", mass, "above 0 for a bullet")
        if isinstance(shape, Box):
            require(mass == 0, "Body.mass", mass, "0 for a Box, which is always static")
            self.radius = 0.0
            self.hx, self.hy = shape.half  # px, half extents of the bounding box
        else:
            self.radius = self.hx = self.hy = shape.radius
        self.shape = shape
        self.inv_mass = 1 / mass if mass else 0.0  # 1/kg
        self.inv_inertia = 2 / (mass * self.radius**2) if mass else 0.0  # 1/(kg px²), a disc
        self.restitution = float(restitution)
        self.friction = not_negative("Body.friction", friction)
        self.x, self.y = pair("Body.pos", pos)  # px
        self.vx = self.vy = 0.0  # px/s
        self.angle = 0.0  # rad, clockwise on the screen
        self.w = 0.0  # rad/s
        self.id = 0  # from 1 up for a ball in a world, from -1 down for a static body
        self.bullet = bullet
        self.idle = mass == 0  # static or asleep
        self.asleep = False
        self.still = 0.0  # s, how long it has been below STILL_SPEED
        self.island: Island | None = None  # the bodies it sleeps with

    @property
    def is_static(self) -> bool:
        """Whether no force can move this body."""
        return self.inv_mass == 0

    @property
    def pos(self) -> Vector2:
        """The centre in px. A copy: set it as a whole, which wakes the body."""
        return Vector2(self.x, self.y)

    @pos.setter
    def pos(self, value: Iterable[float]) -> None:
        self.x, self.y = pair("Body.pos", value)
        self.wake()

    @property
    def vel(self) -> Vector2:
        """The velocity in px/s. A copy: set it as a whole, which wakes the body."""
        return Vector2(self.vx, self.vy)

    @vel.setter
    def vel(self, value: Iterable[float]) -> None:
        self.vx, self.vy = pair("Body.vel", value)
        self.wake()

    @property
    def omega(self) -> float:
        """The spin in rad/s. Setting it wakes the body."""
        return self.w

    @omega.setter
    def omega(self, value: float) -> None:
        self.w = finite("Body.omega", value)
        self.wake()

    def wake(self) -> None:
        """Wake this body and all that sleep with it."""
        if self.island:
            self.island.wake()

    def check(self) -> None:
        """Raise ValueError naming the first number that is NaN or infinite."""
        if not isfinite(self.x + self.y + self.vx + self.vy + self.angle + self.w):
            pair("Body.pos", (self.x, self.y))
            pair("Body.vel", (self.vx, self.vy))
            finite("Body.angle", self.angle)
            finite("Body.omega", self.w)
