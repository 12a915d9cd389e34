"""Friction: what touches does not slide freely."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from .contacts import Contact, Contacts
from .effect import Effect

if TYPE_CHECKING:
    from .body import Body
    from .world import World

Row=tuple


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
        rubbing = [c for c in self.contacts.contacts if c.mu > 0]
        self.ball_rows = [ball_row(c) for c in rubbing if not c.b.is_static]
        self.wall_rows = [wall_row(c) for c in rubbing if c.b.is_static]

    def warm_start(self, h: float) -> None:
        for c, a, b, _, _, _, _, _, _, ax, ay, aw, bx, by, bw in self.ball_rows:
            jt = c.jt
            if jt:
                a.vx -= ax * jt
                a.vy -= ay * jt
                a.w -= aw * jt
                b.vx += bx * jt
                b.vy += by * jt
                b.w -= bw * jt
        for c, a, _, _, _, _, _, ax, ay, aw in self.wall_rows:
            jt = c.jt
            if jt:
                a.vx -= ax * jt
                a.vy -= ay * jt
                a.w -= aw * jt

    def relax(self, h: float) -> None:
        for c, a, b, tx, ty, ra, rb, mt, mu, ax, ay, aw, bx, by, bw in self.ball_rows:
            limit = mu * c.jn
            before = c.jt
            if limit or before:
                jt = before - mt * ((b.vx - a.vx) * tx + (b.vy - a.vy) * ty - b.w * rb - a.w * ra)
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
        for c, a, tx, ty, ra, mt, mu, ax, ay, aw in self.wall_rows:
            limit = mu * c.jn
            before = c.jt
            if limit or before:
                jt = before + mt * (a.vx * tx + a.vy * ty + a.w * ra)
                if jt > limit:
                    jt = limit
                elif jt < -limit:
                    jt = -limit
                c.jt = jt
                jt -= before
                a.vx -= ax * jt
                a.vy -= ay * jt
                a.w -= aw * jt

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


def ball_row(c):
    a, b, tx, ty = c.a, c.b, -c.ny, c.nx
    ma, mb=a.inv_mass,b.inv_mass
    return c, a, b, tx, ty, a.radius, b.radius, c.mt, c.mu, tx*ma, ty*ma, a.radius*a.inv_inertia, tx*mb, ty*mb, b.radius*b.inv_inertia

def wall_row(c):
    a, b, tx, ty = c.a, c.b, -c.ny, c.nx
    return c, a, tx, ty, a.radius, c.mt, c.mu, tx*a.inv_mass, ty*a.inv_mass, a.radius*a.inv_inertia
