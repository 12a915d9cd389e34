"""The stable engine."""

import stable_engine

from ..scenes import Ball
from .builder import SUBSTEPS, Builder, State, Touch


class Stable(Builder):
    """The stable engine, with the effects of the scene."""

    name = "stable"
    package = stable_engine  # or its compiled copy: see compiled.py

    def __init__(self, scene, substeps=SUBSTEPS):
        self.scene, self.substeps = scene, substeps
        effects = [self.effect(name) for name in scene.effects]
        self.world = self.package.World(scene.gravity, substeps, effects, unit=scene.unit)
        self.fill()
        self.complaints = self.world.check()  # with this call, no step warns

    def effect(self, name):
        make = getattr(self.package, name)
        return make(*self.scene.damping) if name == "Damping" else make()

    def rod(self, a, b):
        self.world.add(self.package.Rod(self.bodies[a], self.bodies[b]))

    def spring(self, s):
        ends = self.bodies[s.a], self.bodies[s.b]
        self.world.add(self.package.Spring(*ends, s.stiffness, s.damping, s.length))

    def add(self, data):
        surface = {"restitution": data.restitution, "friction": data.friction}
        if isinstance(data, Ball):
            bullet = data.bullet and "Bullets" in self.scene.effects
            shape = self.package.Circle(data.radius)
            body = self.package.Body(shape, data.pos, data.mass, bullet=bullet, **surface)
            body.vel, body.omega = data.vel, data.omega
        else:
            body = self.package.Body(self.package.Box(data.half), data.pos, **surface)
        return self.world.add(body)

    def step(self, dt):
        self.world.step(dt)

    def lag(self, dt):
        """Return 0: between steps velocities belong to the time of the positions."""
        return 0.0

    def read(self, i):
        body = self.bodies[i]
        return State(body.x, body.y, body.vx, body.vy, body.angle, body.w)

    def throw(self, i, velocity):
        self.bodies[i].vel = velocity

    def touches(self):
        """Return contacts: the point is on the rim of the first body, a ball.

        Impulses are those of the latest substep, times the number of substeps.
        """
        effect = self.world.effects.get("Contacts")
        found = []
        for c in effect.touching if effect else ():
            x, y = (place + c.a.shape.radius * n for place, n in ((c.a.x, c.nx), (c.a.y, c.ny)))
            found.append(Touch(x, y, c.nx, c.ny, c.jn * self.substeps))
        return found

    def asleep(self):
        return sum(body.asleep for body in self.bodies)
