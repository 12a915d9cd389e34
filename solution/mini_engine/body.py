"""A body: a shape with a place, a velocity and a mass. Nothing to do here."""

import math

from pygame import Vector2

from .shapes import Box
from .validate import require


class Body:
    """One rigid body.

    Mass 0 makes a static body: inv_mass and inv_inertia are both 0, so no impulse moves or turns
    it. A Box is static only. Raises ValueError when a value makes no sense.
    """

    def __init__(self, shape, pos, mass=0.0, restitution=0.3, friction=0.6, color=(170, 190, 220)):
        require(0 <= mass < math.inf, "Body.mass", mass, "a finite number, 0 (static) or more")
        if isinstance(shape, Box):
            require(mass == 0, "Body.mass", mass, "0 for a Box, which is always static")
        require(0 <= restitution <= 1, "Body.restitution", restitution, "from 0 to 1")
        require(0 <= friction < math.inf, "Body.friction", friction, "a finite number, 0 or more")
        self.shape = shape
        self.pos = Vector2(pos)  # px
        self.vel = Vector2(0, 0)  # px/s
        self.angle = 0.0  # rad, clockwise on the screen
        self.omega = 0.0  # rad/s
        self.inv_mass = 0.0  # 1/kg
        self.inv_inertia = 0.0  # 1/(kg px²)
        if mass > 0:
            self.inv_mass = 1 / mass
            self.inv_inertia = 1 / (0.5 * mass * shape.radius**2)  # a disc: ½ m r²
        self.restitution = restitution
        self.friction = friction
        self.color = color
        self.check()

    @property
    def is_static(self):
        """Return whether no force can move this body."""
        return self.inv_mass == 0

    def check(self):
        """Raise ValueError naming the first number that is NaN or infinite."""
        state = (*self.pos, *self.vel, self.angle, self.omega)
        if not all(map(math.isfinite, state)):
            names = ("pos.x", "pos.y", "vel.x", "vel.y", "angle", "omega")
            for name, number in zip(names, state, strict=True):
                require(math.isfinite(number), f"Body.{name}", number, "finite")
