"""The names that every engine answers to.

An engine here is a scene in motion: step(dt) advances it by dt seconds, read(i) returns the state
of the body at index i of the scene's list, and contacts() and asleep() count. In the window,
throw(i, velocity) gives a body another velocity, drop(ball) adds one, and touches() lists where
bodies touch.
"""

import time
from collections import namedtuple

from ..scenes import Ball

SUBSTEPS = 4  # of the stable engine, in a step of 1/120 s

State = namedtuple("State", "x y vx vy angle omega")
# A contact: its point, the unit normal towards the second body, and the impulse (kg px/s) of the
# latest step along it; None where the engine does not give it.
Touch = namedtuple("Touch", "x y nx ny impulse")


def is_moving(data):
    """Return whether a body of a scene can move."""
    return isinstance(data, Ball) and data.mass > 0


class Builder:
    """The base of all builders. Each one has add(data), rod(a, b) and spring(s)."""

    def fill(self):
        """Add the scene's bodies, and the rods and springs that it declares."""
        scene = self.scene
        self.bodies = [self.add(data) for data in scene.bodies]
        for a, b in scene.rods if "Rods" in scene.effects else ():
            self.rod(a, b)
        for spring in scene.springs if "Springs" in scene.effects else ():
            self.spring(spring)

    def surface(self, data):
        """Return a body's friction and restitution: 0 where the scene lacks their effects."""
        effects = self.scene.effects
        friction = data.friction if "Friction" in effects else 0.0
        restitution = data.restitution if "Bounce" in effects else 0.0
        return {"friction": friction, "restitution": restitution}

    def damping(self):
        """Return the rates (1/s) at which velocity and spin decay."""
        return self.scene.damping if "Damping" in self.scene.effects else (0.0, 0.0)

    def drop(self, ball):
        """Add a ball while the scene runs."""
        self.scene.bodies.append(ball)
        self.bodies.append(self.add(ball))

    def lag(self, dt):
        """Return how long (s) velocities lag behind positions: half a step of Euler's."""
        return dt / self.substeps / 2

    def spent(self):
        """Return the processor time (s) that counts as this engine's."""
        return time.thread_time()

    def contacts(self):
        """Count the contacts."""
        return len(self.touches())

    def asleep(self):
        """Count the bodies that sleep."""
        return 0
