"""A spring between two bodies."""

import math

from pygame import Vector2

from ..validate import require


class SpringJoint:
    """A spring between the centres of a and b, with damping.

    stiffness in kg/s², that is kg px/s² per px of stretch; damping in kg/s; length in px, the
    distance at rest, by default the one it starts with. Raises ValueError when a value makes no
    sense, or when a and b are the same body.
    """

    def __init__(self, a, b, stiffness, damping=0.0, length=None):
        require(a is not b, "SpringJoint.b", f"the same body as a, at {a.pos}", "another body")
        self.a = a
        self.b = b
        self.stiffness = stiffness  # kg/s²
        self.damping = damping  # kg/s
        self.length = (b.pos - a.pos).length() if length is None else length  # px
        for field in ("stiffness", "damping", "length"):
            value = getattr(self, field)
            sound = 0 <= value < math.inf
            require(sound, f"SpringJoint.{field}", value, "a finite number, 0 or more")

    def apply(self, dt):
        """Pull and push for a step of dt seconds, as a force: with the opposite impulses force·dt.

        By Hooke's law the force (kg px/s²) that draws A and B together is
        stiffness · (distance - length) + damping · (speed of B away from A).
        """
        offset = self.b.pos - self.a.pos
        distance = offset.length()
        axis = offset / distance if distance > 0 else Vector2(0, 1)  # from A to B
        # TODO B2: pull the ends together
        # Nothing pulls yet.
        # END TODO B2
