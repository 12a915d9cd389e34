"""Friction: bodies that touch do not slide freely, and balls roll."""

from math import sqrt

from .body import Body
from .contact import Contact
from .contacts import Contacts
from .effect import Effect
from .world import World

BallRow = tuple[
    Contact, Body, Body, float, float, float, float, float, float, float, float, float, float, float
]
StaticRow = tuple[Contact, Body, Body, float, float, float, float, float, float, float, float]


class Friction(Effect):
    """Coulomb's law: the friction impulse is at most mu jn, with mu = sqrt(mu_a mu_b).

    The tangent is the normal turned clockwise. ax, ay and aw are what a unit of impulse takes from
    A's velocity and spin, bx and by what it gives to B's; it takes bw from B's spin.
    """

    rank = 5

    def attach(self, world: World) -> None:
        super().attach(world)
        self.contacts: Contacts = world.need("Contacts", self)

    def is_used(self) -> bool:
        return any(body.mu > 0 for body in self.world.bodies)

    def begin_contact(self, c: Contact) -> None:
        a, b = c.a, c.b
        spin = a.radius**2 * a.inv_inertia + b.radius**2 * b.inv_inertia
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
        self.ball_rows: list[BallRow] = []
        self.static_rows: list[StaticRow] = []
        for c in self.contacts.touching:
            if c.mu > 0:
                a, b, tx, ty, ra, rb = c.a, c.b, -c.ny, c.nx, c.a.radius, c.b.radius
                ax, ay, aw = tx * a.inv_mass, ty * a.inv_mass, ra * a.inv_inertia
                if b.inv_mass:
                    bx, by, bw = tx * b.inv_mass, ty * b.inv_mass, rb * b.inv_inertia
                    row = (c, a, b, tx, ty, ra, rb, c.mt, ax, ay, aw, bx, by, bw)
                    self.ball_rows.append(row)
                else:
                    self.static_rows.append((c, a, b, tx, ty, ra, rb, c.mt, ax, ay, aw))

    def warm_start(self, h: float) -> None:
        for c, a, b, _, _, _, _, _, ax, ay, aw, bx, by, bw in self.ball_rows:
            jt = c.jt
            if jt:
                a.vx -= ax * jt
                a.vy -= ay * jt
                a.w -= aw * jt
                b.vx += bx * jt
                b.vy += by * jt
                b.w -= bw * jt
        for c, a, _, _, _, _, _, _, ax, ay, aw in self.static_rows:
            jt = c.jt
            if jt:
                a.vx -= ax * jt
                a.vy -= ay * jt
                a.w -= aw * jt

    def relax(self, h: float) -> None:
        for c, a, b, tx, ty, ra, rb, mt, ax, ay, aw, bx, by, bw in self.ball_rows:
            limit = c.mu * c.jn
            before = c.jt
            if limit or before:
                slip = (b.vx - a.vx) * tx + (b.vy - a.vy) * ty - (b.w * rb + a.w * ra)
                jt = before - mt * slip
                if jt > limit:
                    jt = limit
                elif jt < -limit:
                    jt = -limit
                c.jt = jt
                jt -= before
                a.vx -= ax * jt
                a.vy -= ay * jt
                a.w -= aw * jt
                b.vx += bx * jt
                b.vy += by * jt
                b.w -= bw * jt
        for c, a, b, tx, ty, ra, rb, mt, ax, ay, aw in self.static_rows:
            limit = c.mu * c.jn
            before = c.jt
            if limit or before:
                slip = (b.vx - a.vx) * tx + (b.vy - a.vy) * ty - (b.w * rb + a.w * ra)
                jt = before - mt * slip
                if jt > limit:
                    jt = limit
                elif jt < -limit:
                    jt = -limit
                c.jt = jt
                jt -= before
                a.vx -= ax * jt
                a.vy -= ay * jt
                a.w -= aw * jt
