"""Bullets: fast balls do not pass through static bodies."""

from __future__ import annotations

from math import copysign, sqrt
from typing import TYPE_CHECKING

from .contacts import RESTING_SPEED, Contacts
from .effect import Effect

if TYPE_CHECKING:
    from .body import Body
    from .world import World

FAR = 0.5  # radii moved in one step that call for a sweep
BITE = 0.05  # radii of overlap a stopped bullet is left with, so that the next step finds a contact


class Bullets(Effect):
    """Replays a bullet's whole step as one straight line and stops it where it first touches.

    Only its place changes: it keeps its velocity, and the next step answers the hit.
    """

    rank = 7

    def __init__(self) -> None:
        self.bullets: list[Body] = []
        self.starts: list[tuple[float, float]] = []

    def join(self, world: World) -> None:
        super().join(world)
        self.contacts = world.need(Contacts, self)

    def take(self, body: Body) -> None:
        self.bullets.append(body)

    def prepare(self, h: float) -> None:
        self.starts = [(b.x, b.y) for b in self.bullets]

    def finish(self, h: float) -> None:
        for b, (x, y) in zip(self.bullets, self.starts, strict=True):
            dx, dy = b.x - x, b.y - y
            length = sqrt(dx * dx + dy * dy)
            if length > FAR * b.radius:
                statics = [s for s in self.world.bodies if s.is_static]
                share = min([hit(s, b.radius, x, y, dx, dy) for s in statics], default=1.0)
                if share < 1:
                    share = min(share + BITE * b.radius / length, 1.0)
                    b.x, b.y = x + dx * share, y + dy * share


def hit(s: Body, radius: float, x: float, y: float, dx: float, dy: float) -> float:
    """The share of the way (dx, dy) from (x, y) until the ball first touches s; 1 or more: never"""
    x -= s.x
    y -= s.y
    if s.radius:
        return hit_circle(s.radius + radius, x, y, dx, dy)
    begin, end = 0.0, 1.0
    for start, way, half in ((x, dx, s.hx + radius), (y, dy, s.hy + radius)):
        if way == 0:
            if abs(start) >= half:
                return 1.0
        else:
            enter, leave = sorted(((-half - start) / way, (half - start) / way))
            begin, end = max(begin, enter), min(end, leave)
    if begin >= end or begin == 0:
        return 1.0
    at_x, at_y = x + dx * begin, y + dy * begin
    if abs(at_x) > s.hx and abs(at_y) > s.hy:  # a corner
        return hit_circle(radius, x - copysign(s.hx, at_x), y - copysign(s.hy, at_y), dx, dy)
    return begin


def hit_circle(reach: float, x: float, y: float, dx: float, dy: float) -> float:
    """When a point from (x, y) on its way (dx, dy) comes within reach of the origin."""
    way2 = dx * dx + dy * dy
    ahead = x * dx + y * dy
    outside = x * x + y * y - reach * reach
    inside_root = ahead * ahead - way2 * outside
    if outside <= 0 or ahead >= 0 or inside_root < 0:
        return 1.0
    return (-ahead - sqrt(inside_root)) / way2
