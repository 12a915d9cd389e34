"""Foresee the landings of balls on rods or springs."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from .body import Body
from .bounds import Pair
from .contact import Contact, collide
from .sweep import NO_HIT, hit_body

if TYPE_CHECKING:
    from .detection import Detection


class Landings:
    """Landings of balls on rods or springs: their contacts begin before the bodies meet.

    In an overlap, rods would work against the push out of it, and the push would load springs.
    """

    __slots__ = ("contacts", "pairs", "speeds", "springs")

    def __init__(self, contacts: Detection) -> None:
        self.contacts = contacts
        self.springs = 0  # how many there were when these were found
        self.pairs: list[Pair] = []  # near ones with a ball on a joint
        # of contacts whose bodies do not press each other yet: at which speed (px/s) they will meet
        self.speeds: dict[Contact, float] = {}

    def lands(self, a: Body, b: Body) -> bool:
        """Return whether one of these is on a joint, and they will not bounce off each other."""
        contacts = self.contacts
        if contacts.lets_none_pass and a.e and b.e:
            return False
        return contacts.is_on_joint(a) or contacts.is_on_joint(b)

    def foresee(self, dt: float) -> None:
        """Begin the contacts of balls on joints that will land on something in dt seconds."""
        contacts, world = self.contacts, self.contacts.world
        if self.speeds:
            self.speeds = {c: self.speeds[c] for c in contacts.touching if c in self.speeds}
        for pair in self.pairs:
            if pair.contact:
                continue
            a, b = pair.a, pair.b
            gx, gy = world.g if b.is_static else (0.0, 0.0)
            dx, dy = (a.vx - b.vx + gx * dt) * dt, (a.vy - b.vy + gy * dt) * dt
            reach = a.r + b.r + abs(dx) + abs(dy)
            if b.r and (a.x - b.x) ** 2 + (a.y - b.y) ** 2 > reach * reach:
                continue
            nx, ny, gap = collide(a, b)
            is_near = gap > contacts.touching_gap and gap * gap < dx * dx + dy * dy
            if (
                is_near
                and self.lands(a, b)
                and hit_body(b, a.r, a.x - b.x, a.y - b.y, dx, dy) < NO_HIT
            ):
                c = contacts.meet(pair, nx, ny, gap)
                speed = c.closing_speed()
                square = speed * speed + 2 * gap * (gx * nx + gy * ny)
                self.speeds[c] = sqrt(max(square, 0.0))

    def end(self) -> None:
        """Note the hits of contacts that were foreseen, once their bodies press each other."""
        for c in [c for c in self.speeds if c.jn > 0 or c.last > 0]:
            speed = self.speeds.pop(c)
            if self.contacts.tells_hit:
                ago = self.contacts.last_dt - c.found / speed if speed else 0.0
                self.contacts.events.hits[c] = max(ago, 0.0), speed
