"""The stable engine under the lesson's names: a step of 8 passes has 4 substeps, and so on."""

from collections.abc import Iterable

from stable_engine import Body, Bounce, Box, Circle, Contacts, Friction, Rods
from stable_engine import Rod as DistanceJoint
from stable_engine import World as StableWorld

__all__ = ["Body", "Box", "Circle", "DistanceJoint", "World"]


class World:
    """A world of the stable engine, made when it is first stepped: by then all is in it."""

    def __init__(
        self, gravity: Iterable[float], linear_damping: float = 0.0, angular_damping: float = 0.0
    ) -> None:
        self.gravity = gravity
        self.iterations = 8
        self.bodies: list[Body] = []
        self.joints: list[DistanceJoint] = []
        self.world: StableWorld | None = None

    def add(self, body: Body) -> Body:
        self.bodies.append(body)
        return body

    def step(self, dt: float) -> None:
        if self.world is None:
            effects = [Contacts(), Friction(), Bounce(), Rods()]
            self.world = StableWorld(self.gravity, max(1, self.iterations // 2), effects)
            for body in self.bodies:
                self.world.add(body)
            for rod in self.joints:
                self.world.add(rod)
        self.world.step(dt)
