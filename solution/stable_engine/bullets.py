"""Bullets: fast balls do not get into static bodies."""

from .contact import RESTING_SPEED
from .contacts import Contacts
from .effect import Users


class Bullets(Users):
    """Continuous collision detection: a bullet's step is swept, and ends at its first hit.

    Contacts stop any fast ball, but only once its core is in the static body, and softly: a ball
    of 200,000 px/s still gets through a thin one. Where Bounce is declared, fast balls also meet
    each other on their way, bullets or not.
    """

    __slots__ = ("contacts",)
    rank = 7

    def attach(self) -> None:
        self.contacts: Contacts = self.world.need("Contacts", self)

    def impact(self, h: float) -> None:
        """Stop a bullet that did not bounce: a soft contact would give way too far."""
        fast, least = RESTING_SPEED * self.world.unit, self.contacts.touching_gap
        for c in self.contacts.touching if self.bodies else []:
            if c.gap <= least and (c.a.is_bullet or c.b.is_bullet) and c.closing_speed() > fast:
                c.push_apart(c.mn * c.closing_speed())

    def prepare(self, h: float) -> None:
        self.contacts.cores.starts = [(bullet, bullet.x, bullet.y) for bullet in self.bodies]
