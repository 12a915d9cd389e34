"""Joints."""

from abc import ABC, abstractmethod

from pygame import Vector2

from ..settings import BETA


class Constraint(ABC):
    @abstractmethod
    def prepare(self, dt): ...

    @abstractmethod
    def solve(self): ...


class DistanceJoint(Constraint):
    """A rod."""

    def __init__(self, a, b):
        self.a = a
        self.b = b
        self.length = (b.pos - a.pos).length()
        self.axis = Vector2(0, 1)
        self.bias = 0.0
        self.k = 0.0

    def prepare(self, dt):
        offset = self.b.pos - self.a.pos
        distance = offset.length()
        self.axis = Vector2(0, 1) if distance == 0 else offset / distance
        error = distance - self.length
        self.bias = -BETA / dt * error
        self.k = self.a.inv_mass + self.b.inv_mass

    def solve(self):
        if self.k == 0:
            return
        relative_velocity = self.b.vel - self.a.vel
        speed = relative_velocity.dot(self.axis)
        size = (self.bias - speed) / self.k
        self.a.vel -= self.axis * (size * self.a.inv_mass)
        self.b.vel += self.axis * (size * self.b.inv_mass)
