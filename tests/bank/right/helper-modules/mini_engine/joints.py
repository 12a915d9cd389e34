"""The rod. TODO 3 lives in DistanceJoint.solve."""

from pygame.math import Vector2 as V

from . import vectors
from .constants import BETA


class DistanceJoint:
    def __init__(self, a, b):
        self.a, self.b = a, b
        self.length = a.pos.distance_to(b.pos)
        self.axis, self.bias, self.k = V(0, 1), 0.0, 0.0

    def prepare(self, dt):
        way = self.b.pos - self.a.pos
        if way:
            self.axis = way.normalize()
        self.bias = -BETA / dt * (way.length() - self.length)
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        # TODO 3: hold the rod's length
        if self.k:
            self.push((self.bias - vectors.closing_speed(self.a, self.b, self.axis)) / self.k)
        # END TODO 3

    def push(self, size):
        for body, sign in ((self.a, -1), (self.b, 1)):
            body.vel = body.vel + sign * size * body.inv_mass * self.axis
