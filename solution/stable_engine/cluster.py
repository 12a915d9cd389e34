"""A cluster: balls that move together, with their energy and angular momentum."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from .body import Body

if TYPE_CHECKING:
    from .world import World


class Cluster:
    """Balls that fly freely together, or hang on static bodies."""

    def __init__(self, ends: list[Body], world: World) -> None:
        self.world = world
        self.ends = ends
        self.balls = [body for body in ends if not body.is_static]
        self.hangs = len(self.balls) < len(ends)
        self.mass = sum([ball.m for ball in self.balls])  # kg

    def change_speeds(self, vx: float, vy: float) -> None:
        """Change all velocities by (vx, vy) px/s, also those of the bodies it hangs on."""
        for body in self.ends:
            body.vx += vx
            body.vy += vy

    def fall(self, seconds: float) -> None:
        """Add the speed of a fall of so many seconds."""
        gx, gy = self.world.g
        for ball in self.balls:
            ball.vx += gx * seconds
            ball.vy += gy * seconds

    def velocity(self) -> tuple[float, float]:
        """Return the velocity (px/s) of the centre of mass, 0 if it hangs on a static body."""
        if self.hangs:
            return 0.0, 0.0
        momentum_x = sum([ball.m * ball.vx for ball in self.balls])
        return momentum_x / self.mass, sum([ball.m * ball.vy for ball in self.balls]) / self.mass

    def spin(self, vx: float, vy: float) -> tuple[float, float, float]:
        """Return the centre of mass (px), and the spin (rad/s) about it by angular momentum."""
        x = sum([b.m * b.x for b in self.balls]) / self.mass
        y = sum([b.m * b.y for b in self.balls]) / self.mass
        turn = sum([b.m * ((b.x - x) * (b.vy - vy) - (b.y - y) * (b.vx - vx)) for b in self.balls])
        inertia = sum([b.m * squares(b.x - x, b.y - y) for b in self.balls])
        return x, y, turn / inertia if inertia else 0.0

    def twice_energy(self) -> float:
        """Return twice the kinetic energy (kg px²/s²), relative to the centre of mass."""
        vx, vy = self.velocity()
        return sum([b.m * squares(b.vx - vx, b.vy - vy) for b in self.balls])

    def twice_potential(self) -> float:
        """Return twice the potential energy (kg px²/s²), 0 if all fall together."""
        if not self.hangs:
            return 0.0
        gx, gy = self.world.g
        return -sum([2 * b.m * (gx * b.x + gy * b.y) for b in self.balls])

    def scale_speeds(self, wanted: float) -> None:
        """Scale the speeds about the centre of mass until twice_energy is `wanted` (kg px²/s²).

        A frame that flies freely keeps its spin, and so its angular momentum: the rest is scaled.
        """
        vx, vy = self.velocity()
        x, y, spin = (0.0, 0.0, 0.0) if self.hangs else self.spin(vx, vy)
        turning = [(vx - spin * (b.y - y), vy + spin * (b.x - x)) for b in self.balls]
        pairs = list(zip(self.balls, turning, strict=True))
        fixed = sum([b.m * squares(tx - vx, ty - vy) for b, (tx, ty) in pairs])
        scaled = sum([b.m * squares(b.vx - tx, b.vy - ty) for b, (tx, ty) in pairs])
        if scaled > 0 and wanted != scaled + fixed:
            share = sqrt(max(wanted - fixed, 0.0) / scaled)
            for b, (tx, ty) in pairs:
                b.vx = tx + (b.vx - tx) * share
                b.vy = ty + (b.vy - ty) * share


def squares(x: float, y: float) -> float:
    """Return the sum of two squares. Powers are rounded in other ways in another unit."""
    return x * x + y * y
