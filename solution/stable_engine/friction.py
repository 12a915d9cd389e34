"""Friction: bodies that touch do not slide freely, and balls roll."""

from math import sqrt

from .contact import Contact
from .contacts import Contacts
from .effect import Effect
from .order import Group

CALM = 1e-7  # share of the limit; smaller changes are skipped


class Friction(Effect):
    """Coulomb's law: the friction impulse is at most mu jn, with mu = sqrt(mu_a mu_b).

    The tangent is the normal turned clockwise.
    """

    __slots__ = ("contacts",)
    rank = 5

    def attach(self) -> None:
        self.contacts: Contacts = self.world.need("Contacts", self)
        self.contacts.has_friction = True

    def is_used(self) -> bool:
        return any(body.mu > 0 for body in self.world.bodies)

    def is_idle(self) -> bool:
        return not self.contacts.groups

    def begin_contact(self, c: Contact) -> None:
        c.mu = sqrt(c.a.mu * c.b.mu)
        if c.mu == 0:
            c.jt = 0.0

    def solve(self, h: float) -> None:
        """Apply friction to contacts that press now; in relax alone, a pile would never rest.

        It makes bodies come together where heavy ones press: that is left neither to the move
        nor to the next substep.
        """
        for group in self.contacts.groups:
            self.rub(group, group.in_turn, h)
            for tie in group.ties:
                tie.solve(self.rub, group, h)
        self.contacts.settle()

    def relax(self, h: float) -> None:
        self.solve(h)

    def rub(self, group: Group, contacts: list[Contact], h: float) -> None:
        """Slow the slip of each contact, as far as its normal impulse allows."""
        moves_b = group.moves_b
        for c in contacts:
            limit, before = c.mu * c.jn, c.jt
            if limit or before:
                a, b = c.a, c.b
                nx, ny = c.nx, c.ny
                rims = b.w * c.arm_b + a.w * c.arm_a
                jt = before - c.mt * ((b.vy - a.vy) * nx - (b.vx - a.vx) * ny - rims)
                if jt > limit:
                    jt = limit
                elif jt < -limit:
                    jt = -limit
                calm = CALM * limit
                if -calm <= jt - before <= calm:
                    continue
                c.jt = jt
                jt -= before
                change = jt * a.inv_mass
                a.vx += ny * change
                a.vy -= nx * change
                a.w -= c.arm_a * a.inv_inertia * jt
                if moves_b:
                    change = jt * b.inv_mass
                    b.vx -= ny * change
                    b.vy += nx * change
                    b.w -= c.arm_b * b.inv_inertia * jt
