"""Restitution: bodies that hit each other bounce off."""

from math import sqrt

from .contact import Contact
from .contacts import RESTING_SPEED, Contacts
from .effect import Effect, WorldState

PASSES = 20  # within one step, in which an impact travels from ball to ball


class Bounce(Effect):
    """Newton's law: bodies that collide faster than RESTING_SPEED separate at e times that speed.

    e is the smaller restitution of the two. Impacts are resolved one contact at a time, before any
    force of the step acts, again and again until no pair closes in fast any more: this is how an
    impact travels through a row of balls. Slower contacts stay with the solver, or a resting
    ball would hop.
    """

    rank = 6

    def attach(self, world: WorldState) -> None:
        super().attach(world)
        self.contacts: Contacts = world.need("Contacts", self)

    def is_used(self) -> bool:
        return any(body.e > 0 for body in self.world.bodies)

    def begin_contact(self, c: Contact) -> None:
        c.e = min(c.a.e, c.b.e)

    def impact(self, h: float) -> None:
        bouncing = [c for c in self.contacts.touching if c.e > 0]
        if max([abs(c.closing_speed()) for c in bouncing], default=0) <= RESTING_SPEED:
            return
        for _ in range(PASSES):
            if not any([self.resolve(c, h) for c in bouncing]):
                break
        self.contacts.changed = True
        for c in bouncing:
            if c.gap < 0 and separating(c):
                c.gap = 0.0

    def resolve(self, c: Contact, h: float) -> bool:
        """Bounce a pair that closes in fast. Returns whether it did."""
        closing = c.closing_speed()
        if closing <= RESTING_SPEED:
            return False
        if c.b.is_static:
            self.contacts.apply_impact(c, closing + self.rebound_speed(c, closing, h))
        else:
            self.contacts.apply_impact(c, closing + c.e * closing)
        return True

    def rebound_speed(self, c: Contact, closing: float, h: float) -> float:
        """Return the speed (px/s) at which a ball leaves a static body, exact for any step size.

        A contact is found after the ball has crossed the surface and has gained speed below it. So
        e is applied to the speed at the surface, which follows from conservation of energy.
        With semi-implicit Euler velocities lag half a substep behind positions.
        """
        gx, gy = self.world.g
        g = gx * c.nx + gy * c.ny  # px/s², into the surface; negative at a ceiling
        if g == 0:
            return c.e * closing
        lag = g * h / 2
        fallen = -2 * g * c.gap  # px²/s², what the fall from the surface to here adds to speed²
        speed = max(closing + lag, 0.0)
        crossing = max(speed * speed - fallen, 0.0)
        return sqrt(max(c.e * c.e * crossing + fallen, 0.0)) + lag


def separating(c: Contact) -> bool:
    """Return whether a pair has bounced off. The solver must not push it out as well, or it rises
    higher.

    So it counts as just touching. It stays a contact: without one, a rod or a heavy ball that still
    moves towards the wall would press the ball into it.
    """
    return c.closing_speed() < -RESTING_SPEED
