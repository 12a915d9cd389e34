"""A rod between two bodies."""

from pygame import Vector2

from .constants import BETA
from .validate import require


class DistanceJoint:
    """A rigid rod between the centres of a and b that keeps the distance they start with.

    It pulls and pushes, and turns neither body. Raises ValueError for one body twice or two static.
    """

    def __init__(self, a, b):
        require(a is not b, "DistanceJoint.b", f"the same body as a, at {a.pos}", "another body")
        static = a.is_static and b.is_static
        require(not static, "DistanceJoint.b", f"static like a, at {b.pos}", "a body with mass")
        self.a, self.b = a, b
        self.length = (b.pos - a.pos).length()  # px
        self.axis = Vector2(0, 1)  # unit vector from A to B
        self.bias = 0.0  # px/s, wanted speed of B away from A
        self.k = 0.0  # 1/kg, change of that speed per unit of impulse

    def prepare(self, dt):
        """Measure the rod at the start of a step of dt seconds."""
        offset = self.b.pos - self.a.pos
        distance = offset.length()
        self.axis = offset / distance if distance > 0 else Vector2(0, 1)
        self.bias = -BETA / dt * (distance - self.length)
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        """One pass: bring the speed of B away from A, along the axis, to bias.

        The impulse is (bias - speed) / k, equal and opposite on the two bodies. Nothing happens
        when k is 0.
        """
        # TODO 3: hold the rod's length
        # Push a and b apart, or pull them together, by the impulse described above.
        # END TODO 3
