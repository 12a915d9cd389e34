"""Friction: what touches does not slide freely."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from .contacts import Contact, Contacts
from .effect import Effect

if TYPE_CHECKING:
    from .body import Body
    from .world import World

Row = tuple[Contact, "Body", "Body", float, float, float, float, float, float]


class Friction(Effect):
    """Coulomb's law: the friction impulse is at most mu jn, mu = sqrt(mu_a mu_b)."""

    rank = 5

    def __init__(self) -> None:
        self.ball_rows: list[Row] = []
        self.wall_rows: list[Row] = []

    def join(self, world: World) -> None:
        super().join(world)
        self.contacts = world.need(Contacts, self)

    def meet(self, c: Contact) -> None:
        a, b = c.a, c.b
        spin = a.radius**2 * a.inv_inertia + b.radius**2 * b.inv_inertia
        c.mt = 1 / (a.inv_mass + b.inv_mass + spin)
        c.mu = sqrt(a.friction * b.friction)

    def prepare(self, h: float) -> None:
        rows = [
            (c, c.a, c.b, -c.ny, c.nx, c.a.radius, c.b.radius, c.mt, c.mu)
            for c in self.contacts.contacts
            if c.mu > 0
        ]
        self.ball_rows = [row for row in rows if row[2].inv_mass]
        self.wall_rows = [row for row in rows if not row[2].inv_mass]

    def warm_start(self, h: float) -> None:
        for c, a, b, tx, ty, ra, rb, _, _ in self.ball_rows:
            jt = c.jt
            if jt:
                px, py = tx * jt, ty * jt
                a.vx -= px * a.inv_mass
                a.vy -= py * a.inv_mass
                a.w -= ra * jt * a.inv_inertia
                b.vx += px * b.inv_mass
                b.vy += py * b.inv_mass
                b.w -= rb * jt * b.inv_inertia
        for c, a, _, tx, ty, ra, _, _, _ in self.wall_rows:
            jt = c.jt
            if jt:
                a.vx -= tx * jt * a.inv_mass
                a.vy -= ty * jt * a.inv_mass
                a.w -= ra * jt * a.inv_inertia

    def relax(self, h: float) -> None:
        for c, a, b, tx, ty, ra, rb, mt, mu in self.ball_rows:
            limit = mu * c.jn
            if limit == 0 and c.jt == 0:
                continue
            slip = (b.vx - a.vx) * tx + (b.vy - a.vy) * ty - b.w * rb - a.w * ra
            jt = c.jt - mt * slip
            if jt > limit:
                jt = limit
            elif jt < -limit:
                jt = -limit
            change = jt - c.jt
            c.jt = jt
            px, py = tx * change, ty * change
            a.vx -= px * a.inv_mass
            a.vy -= py * a.inv_mass
            a.w -= ra * change * a.inv_inertia
            b.vx += px * b.inv_mass
            b.vy += py * b.inv_mass
            b.w -= rb * change * b.inv_inertia
        for c, a, _, tx, ty, ra, _, mt, mu in self.wall_rows:
            limit = mu * c.jn
            if limit == 0 and c.jt == 0:
                continue
            jt = c.jt + mt * (a.vx * tx + a.vy * ty + a.w * ra)
            if jt > limit:
                jt = limit
            elif jt < -limit:
                jt = -limit
            change = jt - c.jt
            c.jt = jt
            a.vx -= tx * change * a.inv_mass
            a.vy -= ty * change * a.inv_mass
            a.w -= ra * change * a.inv_inertia

    def strike(self, c: Contact, jn: float) -> None:
        a, b = c.a, c.b
        tx, ty = -c.ny, c.nx
        slip = (b.vx - a.vx) * tx + (b.vy - a.vy) * ty - b.w * b.radius - a.w * a.radius
        limit = c.mu * jn
        jt = max(-limit, min(limit, -c.mt * slip))
        a.vx -= tx * jt * a.inv_mass
        a.vy -= ty * jt * a.inv_mass
        a.w -= a.radius * jt * a.inv_inertia
        b.vx += tx * jt * b.inv_mass
        b.vy += ty * jt * b.inv_mass
        b.w -= b.radius * jt * b.inv_inertia
