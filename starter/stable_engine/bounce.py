"""Bounce: bodies that hit each other spring back."""

from math import sqrt

from .contact import Contact
from .contacts import RESTING_SPEED, Contacts
from .effect import Effect
from .world import World

PASSES = 20  # how often a blow is handed on within one step


class Bounce(Effect):
    """Bodies that meet faster than RESTING_SPEED part at e times that speed, e the smaller of two.

    Blows come before any force of the step, one after the other, and are handed on from ball to
    ball until none closes in fast any more.
    """

    rank = 6

    def join(self, world: World) -> None:
        super().join(world)
        self.contacts: Contacts = world.need("Contacts", self)

    def meet(self, c: Contact) -> None:
        c.e = min(c.a.restitution, c.b.restitution)

    def impact(self, h: float) -> None:
        bouncing = [c for c in self.contacts.touching if c.e > 0]
        if max([abs(c.closing_speed()) for c in bouncing], default=0) <= RESTING_SPEED:
            return
        for _ in range(PASSES):
            if not any([self.answer(c, h) for c in bouncing]):
                break
        self.contacts.fresh = True
        self.contacts.touching = [c for c in self.contacts.touching if not leaving(c)]

    def answer(self, c: Contact, h: float) -> bool:
        """Let a pair bounce if it closes in fast. Whether it did."""
        closing = c.closing_speed()
        if closing <= RESTING_SPEED:
            return False
        if c.b.is_static:
            self.contacts.blow(c, closing + self.rebound(c, closing, h))
        else:
            self.contacts.blow(c, closing + c.e * closing)
        return True

    def rebound(self, c: Contact, closing: float, h: float) -> float:
        """The speed (px/s) at which a ball leaves a static body, exact whatever the step.

        The ball crossed the surface a moment ago, slower, and will cross it again on its way out;
        energy tells how fast. With semi-implicit Euler speeds lag half a substep behind places.
        """
        gx, gy = self.world.gravity
        g = gx * c.nx + gy * c.ny  # px/s², into the surface
        if g <= 0:
            return c.e * closing
        lag = g * h / 2
        fallen = -2 * g * c.gap  # px²/s², what falling from the surface to here adds to speed²
        crossing = max((closing + lag) ** 2 - fallen, 0)
        return sqrt(max(c.e**2 * crossing + fallen, 0)) + lag


def leaving(c: Contact) -> bool:
    """Whether a pair bounces off: pushing it out as well would lift it higher."""
    return c.e > 0 and c.closing_speed() < -RESTING_SPEED
