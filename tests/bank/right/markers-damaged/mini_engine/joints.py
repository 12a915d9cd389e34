"""The rod, with one of its marker lines lost."""

from pygame import Vector2

from .constants import BETA


class DistanceJoint:
    def __init__(self, a, b):
        self.a, self.b = a, b
        self.length = (b.pos - a.pos).length()
        self.axis = Vector2(0, 1)
        self.bias = self.k = 0.0

    def prepare(self, dt):
        offset = self.b.pos - self.a.pos
        distance = offset.length()
        self.axis = offset / distance if distance > 0 else Vector2(0, 1)
        self.bias = -BETA / dt * (distance - self.length)
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        # TODO 3: hold the rod's length
        if self.k == 0:
            return
        speed = (self.b.vel - self.a.vel).dot(self.axis)
        impulse = self.axis * ((self.bias - speed) / self.k)
        self.a.vel -= impulse * self.a.inv_mass
        self.b.vel += impulse * self.b.inv_mass
