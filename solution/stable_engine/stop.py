"""Stop balls at static bodies: where and when, and what is left of their velocities."""

from collections.abc import Callable
from math import sqrt

from .body import Body, State


class Stop:
    """The stop of a ball by a static body: where it is, and where it would be otherwise."""

    __slots__ = ("at", "end", "late", "time")

    def __init__(self, at: State, end: State | None, time: float, late: float) -> None:
        self.at = at
        self.end = end  # none for a bullet, which must not get into a static body
        self.time = time  # s, that it flew until then
        self.late = late  # s, by which it is behind the others; 0 once it has flown on


def rewind(
    body: Body,
    way: tuple[float, float],
    fraction: float,
    acceleration: Callable[[Body], tuple[float, float]],
    h: float,
) -> None:
    """Rewind a ball to where it was after this fraction of its way (px) in a step.

    The step counts as one straight flight. The ball keeps its velocity, less the speed gained on
    the rest of the way by its `acceleration` (px/s²).
    """
    x, y, dx, dy = body.x, body.y, way[0] * (1 - fraction), way[1] * (1 - fraction)
    found = []
    for part in (0.0, 0.5, 1.0):
        body.x, body.y = x - dx * part, y - dy * part
        found.append(acceleration(body))
    (ax, ay), (mx, my), (bx, by) = found
    ux, uy = body.vx + ax * h / 2, body.vy + ay * h / 2  # velocities lag half a substep behind
    gained = ((ax + 4 * mx + bx) * dx + (ay + 4 * my + by) * dy) / 3  # px²/s², by Simpson's rule
    speed2 = ux * ux + uy * uy
    share = share_left(speed2, gained)
    body.vx, body.vy = ux * share - bx * h / 2, uy * share - by * h / 2


def share_left(speed2: float, lost: float) -> float:
    """Return the share that is left of a speed, if its square (px²/s²) loses so much."""
    return sqrt(max(1 - lost / speed2, 0.0)) if speed2 else 1.0


def lose_energy(body: Body, energy: float) -> None:
    """Take an energy (kg px²/s²) from the motion of a ball, as far as it has any."""
    if energy > 0:
        speed2 = body.vx * body.vx + body.vy * body.vy
        share = share_left(speed2, 2 * energy * body.inv_mass)
        body.vx, body.vy = body.vx * share, body.vy * share
