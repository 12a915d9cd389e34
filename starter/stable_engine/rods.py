"""Rods: two centres keep their distance."""

from math import hypot

from .body import Body
from .contacts import Contacts
from .joint import Joint, Joints
from .soft import SAME_WAY, softness
from .validate import require

STIFFNESS = 0.25  # frequency of a rod, per substep
ZETA = 5.0  # damping ratio of a rod


class Rod(Joint):
    """A rigid rod that keeps the distance a and b start with. It pulls and pushes."""

    __slots__ = ("j",)
    effect = "Rods"

    def __init__(self, a: Body, b: Body) -> None:
        super().__init__(a, b)
        require(self.length > 0, "Rod.length", self.length, "above 0: move a and b apart first")
        self.j = 0.0  # kg px/s, accumulated impulse, positive when it pushes


class Rods(Joints[Rod]):
    """Soft rods that aim at the length they will have after the move.

    Relaxing works along the axis after the move: along the old one a pendulum loses energy.
    """

    rank = 2

    def take(self, rod: Rod) -> None:
        super().take(rod)
        contacts = self.world.effects.get("Contacts")
        if isinstance(contacts, Contacts) and rod.length < rod.a.radius + rod.b.radius:
            contacts.spare(rod.a, rod.b)

    def prepare(self, h: float) -> None:
        self.spring = softness(STIFFNESS / h, ZETA, h)

    def warm_start(self, h: float) -> None:
        for rod in self.awake:
            rod.measure()
            rod.push(rod.j)

    def solve(self, h: float) -> None:
        rate, keep = self.spring
        for rod in self.awake:
            a, b = rod.a, rod.b
            ahead = hypot(rod.dx + (b.vx - a.vx) * h, rod.dy + (b.vy - a.vy) * h)
            speed = (ahead - rod.distance) / h
            error = rod.distance - rod.length
            j = keep * (rod.j - rod.m * speed) - rod.m * rate * error
            rod.push(j - rod.j)
            rod.j = j

    def relax(self, h: float) -> None:
        for rod in self.awake:
            nx, ny = rod.nx, rod.ny
            rod.measure()
            if nx * rod.nx + ny * rod.ny < SAME_WAY:
                rod.j = 0.0
            j = rod.j - rod.m * rod.speed()
            rod.push(j - rod.j)
            rod.j = j
