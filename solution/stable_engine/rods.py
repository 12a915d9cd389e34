"""Rods: two centres keep their distance."""

from __future__ import annotations

from math import hypot

from .body import Body
from .effect import Effect, Joint, softness
from .validate import require

STIFFNESS = 0.25  # frequency of a rod, times h
ZETA = 5.0  # damping ratio of a rod


class Rod(Joint):
    """A rigid rod that keeps the distance a and b start with. It pulls and pushes."""

    __slots__ = ("distance", "dx", "dy", "j", "length", "m", "nx", "ny")
    effect = "Rods"

    def __init__(self, a: Body, b: Body) -> None:
        super().__init__(a, b)
        self.length = hypot(b.x - a.x, b.y - a.y)  # px
        require(self.length > 0, "Rod.length", self.length, "above 0: move a and b apart")
        self.m = 1 / (a.inv_mass + b.inv_mass)  # kg, effective mass
        self.j = 0.0  # kg px/s, accumulated impulse, positive when it pushes
        self.dx = self.dy = self.distance = 0.0  # px, from A to B before the move
        self.nx = self.ny = 0.0  # unit vector from A to B

    def measure(self) -> None:
        """Take distance and axis from where A and B are now."""
        self.dx, self.dy = self.b.x - self.a.x, self.b.y - self.a.y
        self.distance = hypot(self.dx, self.dy) or 1e-9
        self.nx, self.ny = self.dx / self.distance, self.dy / self.distance

    def push(self, j: float) -> None:
        """Impulse j (kg px/s) on B along the axis, the opposite on A."""
        a, b = self.a, self.b
        px, py = self.nx * j, self.ny * j
        a.vx -= px * a.inv_mass
        a.vy -= py * a.inv_mass
        b.vx += px * b.inv_mass
        b.vy += py * b.inv_mass


class Rods(Effect):
    """Soft rods that aim at the length they will have after the move.

    Relaxing works along the axis after the move: along the old one a pendulum loses energy.
    """

    rank = 2

    def __init__(self) -> None:
        self.rods: list[Rod] = []
        self.awake: list[Rod] = []

    def take(self, rod: Rod) -> None:
        self.rods.append(rod)
        self.awake.append(rod)

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
            j = -rod.m * (keep * speed + rate * error) - (1 - keep) * rod.j
            rod.j += j
            rod.push(j)

    def relax(self, h: float) -> None:
        for rod in self.awake:
            a, b = rod.a, rod.b
            rod.measure()
            j = -rod.m * ((b.vx - a.vx) * rod.nx + (b.vy - a.vy) * rod.ny)
            rod.j += j
            rod.push(j)

    def links(self) -> list[tuple[Body, Body]]:
        return [(rod.a, rod.b) for rod in self.awake]

    def rouse(self) -> None:
        self.awake = [rod for rod in self.rods if rod.awake]
