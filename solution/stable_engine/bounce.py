"""Bounce: what hits, springs back."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from .contacts import RESTING_SPEED, Contact, Contacts
from .effect import Effect

if TYPE_CHECKING:
    from .world import World

PASSES = 20  # how often a blow may be handed on in one step


class Bounce(Effect):
    """Bodies that meet faster than RESTING_SPEED part at e times that speed, e the smaller of two.

    Blows have a stage of their own, before any force acts in the step, and are handed on from
    ball to ball until nobody closes in fast any more.
    """

    rank = 6

    def join(self, world: World) -> None:
        super().join(world)
        self.contacts = world.need(Contacts, self)

    def meet(self, c: Contact) -> None:
        c.e = min(c.a.restitution, c.b.restitution)

    def impact(self, h: float) -> None:
        bouncing = [c for c in self.contacts.contacts if c.e > 0]
        for _ in range(PASSES):
            if not any([self.answer(c, h) for c in bouncing]):
                break
        self.contacts.contacts = [c for c in self.contacts.contacts if c.e == 0 or c.closing_speed() > -RESTING_SPEED]

    def answer(self, c: Contact, h: float) -> bool:
        """Part a pair that closes in fast. Whether it did."""
        if c.closing_speed() <= RESTING_SPEED:
            return False
        self.contacts.blow(c, self.rebound(c, h))
        return True

    def rebound(self, c: Contact, h: float) -> float:
        """How much the speed along the normal changes at a blow, in px/s.

        Against a static body it is exact whatever the step: the ball passed the surface a moment
        ago and slower, will pass it again on its way out, and its stored speed lags half a substep
        behind its position, as semi-implicit Euler has it.
        """
        closing = c.closing_speed()
        if not c.b.is_static:
            return (1 + c.e) * closing
        gx, gy = self.world.gravity
        g = gx * c.nx + gy * c.ny  # px/s², into the surface
        lag = g * h / 2  # px/s
        speed = closing + lag
        if g > 0:
            gained = 2 * g * c.gap   # px²/s², since it passed the surface: negative
            at_surface = max(speed**2 + gained, 0)
            out = sqrt(max(c.e**2 * at_surface - gained, 0))
        else:
            out = c.e * speed
        return closing + out + lag
