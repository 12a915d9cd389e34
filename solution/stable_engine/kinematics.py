"""Kinematic bodies: they move by their own velocity, and push whatever is in their way."""

from .effect import Users


class Kinematics(Users):
    """Move bodies that are kinematic=True by their velocity and spin, which nothing else changes.

    They carry and push balls with any force, as lifts, paddles and pistons do. They pass through
    each other and through static bodies. One that moves by more than a ball's radius in a step may
    pass through the ball.
    """

    __slots__ = ()
    pushes_all = False
    rank = -1  # moves bodies before any other effect relaxes

    def detect(self, h: float) -> None:
        """Wake sleepers near moving kinematic bodies."""
        world = self.world
        if world.anybody_sleeps():
            for body in self.bodies:
                if body.vx or body.vy:
                    world.call("static_moved", body)

    def relax(self, h: float) -> None:
        """Move kinematic bodies, at the same time as the balls."""
        for body in self.bodies:
            body.x += body.vx * h
            body.y += body.vy * h
            body.turn += body.w * h

    def coast(self, dt: float) -> None:
        self.relax(dt)
        self.detect(dt)
