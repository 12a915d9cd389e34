"""A body, as a dataclass."""

import math
from dataclasses import dataclass, field

from pygame import Vector2

from .shapes import Box, Circle
from .validate import require

STATE = ("pos.x", "pos.y", "vel.x", "vel.y", "angle", "omega")


@dataclass(eq=False)
class Body:
    """One rigid body; mass 0 makes it static."""

    shape: Circle | Box
    pos: Vector2
    mass: float = 0.0
    restitution: float = 0.3
    friction: float = 0.6
    color: tuple = (170, 190, 220)
    vel: Vector2 = field(default_factory=Vector2, init=False)
    angle: float = field(default=0.0, init=False)
    omega: float = field(default=0.0, init=False)
    inv_mass: float = field(default=0.0, init=False)
    inv_inertia: float = field(default=0.0, init=False)
    asleep: bool = field(default=False, init=False)
    still_for: float = field(default=0.0, init=False)
    support: list = field(default_factory=list, init=False, repr=False)

    def __post_init__(self):
        require(0 <= self.mass < math.inf, "Body.mass", self.mass, "a finite number, 0 (static) or more")
        if isinstance(self.shape, Box):
            require(self.mass == 0, "Body.mass", self.mass, "0 for a Box, which is always static")
        require(0 <= self.restitution <= 1, "Body.restitution", self.restitution, "from 0 to 1")
        require(0 <= self.friction < math.inf, "Body.friction", self.friction, "a finite number, 0 or more")
        self.pos = Vector2(self.pos)
        self.before = Vector2(self.pos), 0.0
        if self.mass:
            self.inv_mass = 1.0 / self.mass
            self.inv_inertia = 2.0 / (self.mass * self.shape.radius * self.shape.radius)
        self.check()

    @property
    def is_static(self):
        """Whether no force can move this body."""
        return not self.inv_mass

    def check(self):
        """Raise ValueError naming the first number that is NaN or infinite."""
        for name, number in zip(STATE, (*self.pos, *self.vel, self.angle, self.omega), strict=True):
            require(math.isfinite(number), f"Body.{name}", number, "finite")
