"""The hand of a person at the window: it picks up balls, throws them, and drops new ones.

In all engines that are shown, the same ball of the scene is pulled to the same position.
"""

import math

from ..scenes import Ball

CATCH_UP = 0.06  # s until a ball reaches the hand
FASTEST = 1500.0  # px/s, so that no ball is pulled through a wall in one step
NEAR = 8.0  # px beyond its rim within which a ball is taken
NEW = {"radius": 15.0, "mass": 2.25, "restitution": 0.4, "friction": 0.6}


class Hand:
    """The hand's position in the scene, and the index of the ball that it holds."""

    def __init__(self):
        self.held = None
        self.at = (0.0, 0.0)

    def take(self, engine, at):
        """Take the nearest moving ball, if one is near. Return whether it holds one."""
        self.at, bodies = at, engine.scene.bodies
        reach = {}
        for i in engine.scene.moving():
            state = engine.read(i)
            reach[i] = math.dist((state.x, state.y), at) - bodies[i].radius
        nearest = min(reach, key=reach.get, default=None)
        self.held = nearest if nearest is not None and reach[nearest] < NEAR else None
        return self.held is not None

    def pull(self, engine):
        """Pull the held ball towards the hand. Returns whether there is one."""
        if self.held is None or self.held >= len(engine.scene.bodies):
            return False
        state = engine.read(self.held)
        vx, vy = ((to - now) / CATCH_UP for to, now in zip(self.at, state, strict=False))
        slower = min(1.0, FASTEST / max(math.hypot(vx, vy), 1e-9))
        engine.throw(self.held, (vx * slower, vy * slower))
        return True

    def let_go(self):
        """Release the ball; it keeps the speed that the hand gave it."""
        self.held = None


def new_ball(at):
    """Return a ball to be dropped at a place."""
    return Ball(tuple(at), **NEW)
