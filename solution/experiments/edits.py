"""Three small edits to the lesson's engine that cost next to nothing, each to switch on by name.

bounce: bounce from the velocity before this step's gravity, not after it
rods: aim each rod at where its ends will be once the step has moved them
arms: against a static body, turn the ball at its radius, not at radius - depth
"""

import math

from pygame import Vector2

from mini_engine import DistanceJoint, World
from mini_engine.solver import apply_impulse, target_speed

EDITS = ("bounce", "rods", "arms")


class EditedWorld(World):
    """The lesson's world with the edits of these names; with none it is the lesson's own."""

    def __init__(self, edits, *settings):
        super().__init__(*settings)
        self.edits = edits
        self.targets = {}

    def step(self, dt):
        if "bounce" in self.edits:  # nothing has moved since: the same contacts, the same depths
            self.targets = {(c.a, c.b): target_speed(c, dt) for c in self.find_contacts()}
        super().step(dt)

    def solve_contact(self, c, dt):
        if "bounce" in self.edits:
            c.target = self.targets[c.a, c.b]
        super().solve_contact(c, dt)

    def find_contacts(self):
        contacts = super().find_contacts()
        if "arms" in self.edits:
            for c in contacts:
                if c.b.is_static:
                    c.point = c.a.pos + c.normal * c.a.shape.radius
                elif c.a.is_static:
                    c.point = c.b.pos - c.normal * c.b.shape.radius
        return contacts


class AimedRod(DistanceJoint):
    """A rod whose impulse gives it the right length after the move, not a bias towards it."""

    def prepare(self, dt):
        super().prepare(dt)
        self.dt = dt
        self.offset = self.b.pos - self.a.pos

    def solve(self):
        """One pass: find j with |ahead + axis k dt j| = length, where ahead is B seen from A.

        Nothing happens when no impulse along the axis can reach the length in one step.
        """
        ahead = self.offset + (self.b.vel - self.a.vel) * self.dt
        along = ahead.dot(self.axis)
        root2 = along**2 - ahead.length_squared() + self.length**2
        if root2 < 0:
            return
        impulse = self.axis * ((math.sqrt(root2) - along) / (self.k * self.dt))
        centre = Vector2()  # where the rod holds its ends: no lever arm
        apply_impulse(self.a, self.b, impulse, centre, centre)
