"""Bullets: fast balls do not get into static bodies."""

from math import hypot

from .contacts import RESTING_SPEED, Contacts
from .effect import Users

SWEEP_FROM = 0.5  # radii, a bullet that moves further in one step is swept
OVERLAP = 0.05  # radii, the overlap of a stopped bullet, so that the next step finds the contact


class Bullets(Users):
    """Continuous collision detection: a bullet's step is swept, and ends at its first hit.

    Contacts stop any fast ball, but only once its core is in the static body, and softly: a ball
    of 200,000 px/s still gets through a thin one. Where Bounce is declared, fast balls also meet
    each other on their way, bullets or not.
    """

    __slots__ = ("contacts", "starts")
    rank = 7

    def attach(self) -> None:
        self.contacts: Contacts = self.world.need("Contacts", self)

    def impact(self, h: float) -> None:
        """Stop a bullet that did not bounce: a soft contact would give way too far."""
        fast = RESTING_SPEED * self.world.unit
        for c in self.contacts.touching if self.bodies else []:
            if (c.a.is_bullet or c.b.is_bullet) and c.closing_speed() > fast:
                c.push_apart(c.mn * c.closing_speed())

    def prepare(self, h: float) -> None:
        self.starts = [(bullet, bullet.x, bullet.y) for bullet in self.bodies]

    def finish(self, h: float) -> None:
        cores = self.contacts.cores
        for bullet, x, y in self.starts:
            if hypot(bullet.x - x, bullet.y - y) > SWEEP_FROM * bullet.r:
                overlap = OVERLAP * bullet.r
                cores.sweep(bullet, (x, y), bullet.r, overlap, h)
