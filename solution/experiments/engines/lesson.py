"""The lesson's engine, which you complete in this folder."""

from pygame import Vector2

import mini_engine
from mini_engine import ITERATIONS

from ..scenes import Ball
from .builder import Builder, State, Touch


class Lesson(Builder):
    """The lesson's engine, which you complete in this folder. It has no springs."""

    name = "lesson"

    def __init__(self, scene, passes=ITERATIONS, substeps=1):
        self.scene, self.substeps = scene, substeps
        self.world = mini_engine.World(scene.gravity, *self.damping())
        self.world.iterations = passes
        self.fill()

    def rod(self, a, b):
        rod = mini_engine.DistanceJoint(self.bodies[a], self.bodies[b])
        self.world.joints.append(rod)

    def spring(self, s):
        """Leave out a spring: this engine has none."""

    def add(self, data):
        surface = self.surface(data)
        if isinstance(data, Ball):
            shape = mini_engine.Circle(data.radius)
            body = mini_engine.Body(shape, data.pos, data.mass, **surface)
            body.vel, body.omega = Vector2(data.vel), data.omega
        else:
            body = mini_engine.Body(mini_engine.Box(Vector2(data.half)), data.pos, 0.0, **surface)
        return self.world.add(body)

    def step(self, dt):
        for _ in range(self.substeps):
            self.world.step(dt / self.substeps)

    def read(self, i):
        body = self.bodies[i]
        return State(*body.pos, *body.vel, body.angle, body.omega)

    def throw(self, i, velocity):
        self.bodies[i].vel = Vector2(velocity)

    def touches(self):
        return [Touch(*c.point, *c.normal, c.jn) for c in self.world.contacts]

    def asleep(self):
        """Count the bodies that sleep, once bonus task B1 is done."""
        return sum(getattr(body, "asleep", False) for body in self.bodies)
