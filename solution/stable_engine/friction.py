"""Friction: bodies that touch do not slide freely, and balls roll."""

from math import sqrt

from .contact import Contact
from .contacts import Contacts, Group
from .effect import Effect, WorldState


class Friction(Effect):
    """Coulomb's law: the friction impulse is at most mu jn, with mu = sqrt(mu_a mu_b).

    The tangent is the normal turned clockwise.
    """

    rank = 5

    def attach(self, world: WorldState) -> None:
        super().attach(world)
        self.contacts: Contacts = world.need("Contacts", self)
        self.balls, self.statics = Group(moves_b=True), Group(moves_b=False)
        self.groups = [self.balls, self.statics]

    def is_used(self) -> bool:
        return any(body.mu > 0 for body in self.world.bodies)

    def begin_contact(self, c: Contact) -> None:
        a, b = c.a, c.b
        spin = a.radius * a.radius * a.inv_inertia + b.radius * b.radius * b.inv_inertia
        c.mt = 1 / (a.inv_mass + b.inv_mass + spin)
        c.mu = sqrt(a.mu * b.mu)

    def after_impact(self, c: Contact, jn: float) -> None:
        a, b, tx, ty = c.a, c.b, -c.ny, c.nx
        slip = (b.vx - a.vx) * tx + (b.vy - a.vy) * ty - (b.w * b.radius + a.w * a.radius)
        limit = c.mu * jn
        jt = max(-limit, min(limit, -c.mt * slip))
        a.vx -= tx * jt * a.inv_mass
        a.vy -= ty * jt * a.inv_mass
        a.w -= a.radius * jt * a.inv_inertia
        b.vx += tx * jt * b.inv_mass
        b.vy += ty * jt * b.inv_mass
        b.w -= b.radius * jt * b.inv_inertia

    def prepare(self, h: float) -> None:
        if not self.contacts.changed:
            return
        self.balls.contacts = [c for c in self.contacts.balls.contacts if c.mu > 0]
        self.statics.contacts = [c for c in self.contacts.statics.contacts if c.mu > 0]
        for group in self.groups:
            for c in group.contacts:
                a, b, tx, ty = c.a, c.b, -c.ny, c.nx
                c.tax, c.tay, c.aw = tx * a.inv_mass, ty * a.inv_mass, a.radius * a.inv_inertia
                c.tbx, c.tby, c.bw = tx * b.inv_mass, ty * b.inv_mass, b.radius * b.inv_inertia

    def warm_start(self, h: float) -> None:
        for group in self.groups:
            moves_b = group.moves_b
            for c in group.contacts:
                jt = c.jt
                if jt:
                    a, b = c.a, c.b
                    a.vx -= c.tax * jt
                    a.vy -= c.tay * jt
                    a.w -= c.aw * jt
                    if moves_b:
                        b.vx += c.tbx * jt
                        b.vy += c.tby * jt
                        b.w -= c.bw * jt

    def relax(self, h: float) -> None:
        for group in self.groups:
            moves_b = group.moves_b
            for c in group.contacts:
                limit, before = c.mu * c.jn, c.jt
                if limit or before:
                    a, b = c.a, c.b
                    tx, ty = -c.ny, c.nx
                    rims = b.w * b.radius + a.w * a.radius
                    jt = before - c.mt * ((b.vx - a.vx) * tx + (b.vy - a.vy) * ty - rims)
                    if jt > limit:
                        jt = limit
                    elif jt < -limit:
                        jt = -limit
                    c.jt = jt
                    jt -= before
                    a.vx -= c.tax * jt
                    a.vy -= c.tay * jt
                    a.w -= c.aw * jt
                    if moves_b:
                        b.vx += c.tbx * jt
                        b.vy += c.tby * jt
                        b.w -= c.bw * jt
