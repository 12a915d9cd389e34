"""The world."""

import math

from pygame import Vector2

from .collision.detector import ContactDetector
from .settings import ITERATIONS


class DampingModel:
    def __init__(self, rate):
        self.rate = rate

    def kept_share(self, dt):
        return math.exp(-self.rate * dt)


class World:
    def __init__(self, gravity=(0, 980), linear_damping=0.05, angular_damping=0.3):
        self.gravity = Vector2(gravity)
        self.linear_damping = linear_damping
        self.angular_damping = angular_damping
        self.bodies = []
        self.joints = []
        self.contacts = []

    def add(self, body):
        self.bodies.append(body)
        return body

    @property
    def dynamic_bodies(self):
        return [body for body in self.bodies if not body.is_static]

    def find_contacts(self):
        return ContactDetector(self.bodies).detect()

    def solve_contact(self, c, dt):
        c.solve()

    def step(self, dt):
        self._apply_forces(dt)
        self.contacts = self.find_contacts()
        self._solve(dt)
        self._move(dt)

    def _apply_forces(self, dt):
        keep_velocity = DampingModel(self.linear_damping).kept_share(dt)
        keep_spin = DampingModel(self.angular_damping).kept_share(dt)
        for body in self.dynamic_bodies:
            body.accelerate(self.gravity, dt)
            body.damp(keep_velocity, keep_spin)

    def _solve(self, dt):
        for contact in self.contacts:
            contact.prepare(dt)
        for joint in self.joints:
            joint.prepare(dt)
        for _ in range(ITERATIONS):
            for contact in self.contacts:
                self.solve_contact(contact, dt)
            for joint in self.joints:
                joint.solve()

    def _move(self, dt):
        for body in self.dynamic_bodies:
            body.move(dt)
