"""Friction: bodies that touch do not slide freely, and balls roll."""

from math import hypot, sqrt

from .contact import Contact
from .contacts import Contacts
from .effect import Effect
from .order import Group

ROLLING = 0.001  # of the weight: the rolling resistance of steel on steel
ROLLING_SPEED = 3.0  # 1/s, in units of the world; what rolls faster keeps its speed
CALM = 1e-7  # share of the normal impulse; smaller changes are skipped


class Friction(Effect):
    """Coulomb's law: the friction impulse is at most mu jn, with mu = sqrt(mu_a mu_b).

    The tangent is the normal turned clockwise. An impulse along one does not change the speed along
    the other: so a pass of Contacts solves each contact along both at once. It does so before the
    move and after it; in relax alone, a pile would never rest. Where piles are solved, friction
    follows them, as it depends on what they bear, and they are solved again: it makes bodies come
    together where heavy ones press.

    A ball that has touched another one, and rolls on a level face slower than 3 px/s, comes to rest
    by rolling resistance: so a pile does. Faster ones, and those alone, roll on.
    """

    __slots__ = ("contacts",)
    rank = 5

    def attach(self) -> None:
        self.contacts: Contacts = self.world.need("Contacts", self)
        self.contacts.has_friction = True
        self.contacts.push = push_and_rub

    def is_used(self) -> bool:
        return any(body.mu > 0 for body in self.world.members)

    def is_idle(self) -> bool:
        return self.contacts.is_idle()

    def begin_contact(self, c: Contact) -> None:
        c.mu = sqrt(c.a.mu * c.b.mu)
        if c.mu == 0:
            c.jt = 0.0

    def prepare(self, h: float) -> None:
        """Slow balls that roll slowly on a level face, and have touched others."""
        if not self.contacts.changed:
            return  # nothing moves
        world = self.world
        gx, gy = world.g
        pull = hypot(gx, gy)
        slow, less = ROLLING_SPEED * world.unit, ROLLING * pull * h * world.substep_count
        tilted = ROLLING * pull
        for c in self.contacts.statics.contacts:
            if not -tilted <= c.nx * gy - c.ny * gx <= tilted:
                continue
            a, b = c.a, c.b
            speed = max(hypot(a.vx, a.vy), abs(a.w) * a.r)
            if speed > slow or a.joint_count or a in world.forces:
                a.jostled = False
            elif a.touches:
                a.jostled = True
            if a.jostled and c.jn and c.mu and not (b.r or b.vx or b.vy or b.w):
                share = 1 - less / speed if speed > less else 0.0
                a.vx, a.vy, a.w = a.vx * share, a.vy * share, a.w * share

    def solve(self, h: float) -> None:
        if self.contacts.piles:
            self.contacts.go_over(rub, h)
            self.contacts.settle(h)

    def relax(self, h: float) -> None:
        self.solve(h)


def rub(group: Group, contacts: list[Contact], h: float) -> None:
    """Slow the slip of each contact, as far as its normal impulse allows."""
    for c in contacts:
        limit, held = c.mu * c.jn, c.jt
        if limit or held:
            a, b = c.a, c.b
            nx, ny = c.nx, c.ny
            rims = b.w * c.arm_b + a.w * c.arm_a
            jt = held - c.mt * ((b.vy - a.vy) * nx - (b.vx - a.vx) * ny - rims)
            c.jt = jt = max(-limit, min(jt, limit))
            jt -= held
            a.vx += ny * jt * a.inv_mass
            a.vy -= nx * jt * a.inv_mass
            a.w -= c.spin_a * jt
            b.vx -= ny * jt * b.inv_mass
            b.vy += nx * jt * b.inv_mass
            b.w -= c.spin_b * jt


def push_and_rub(group: Group, contacts: list[Contact], h: float) -> None:
    """Push bodies as `push` does, and slow the slip of each contact, in one loop: calls cost."""
    has_moved, most, least = group.has_moved, -group.max_push_speed, group.least
    moves_b, bias_rate, mass_scale = group.moves_b, group.bias_rate, group.mass_scale
    for c in contacts:
        a, b = c.a, c.b
        nx, ny, mn = c.nx, c.ny, c.mn
        vx, vy = b.vx - a.vx, b.vy - a.vy
        speed = vx * nx + vy * ny
        before, held = c.jn, c.jt
        if has_moved:
            if not before:
                gap = (b.x - a.x) * nx + (b.y - a.y) * ny - c.reach
                if gap > 0:
                    speed += gap / h
            jn = before - mn * speed
            if jn < 0:
                jn = 0.0
        else:
            gap = (b.x - a.x) * nx + (b.y - a.y) * ny - c.reach
            if gap > least:
                jn = before - mn * (speed + gap / h)
            else:
                bias = bias_rate * gap
                if bias < most:
                    bias = most
                jn = mass_scale * (before - mn * speed) - mn * bias
            if jn < mn * least:
                jn = 0.0
        jt = 0.0
        if jn:
            limit = c.mu * jn
            jt = held - c.mt * (vy * nx - vx * ny - (b.w * c.arm_b + a.w * c.arm_a))
            if jt > limit:
                jt = limit
            elif jt < -limit:
                jt = -limit
        more, turn, calm = jn - before, jt - held, CALM * jn
        if -calm <= more <= calm and -calm <= turn <= calm:
            continue
        c.jn, c.jt = jn, jt
        jx, jy = nx * more - ny * turn, ny * more + nx * turn
        a.vx -= jx * a.inv_mass
        a.vy -= jy * a.inv_mass
        a.w -= c.spin_a * turn
        if moves_b:
            b.vx += jx * b.inv_mass
            b.vy += jy * b.inv_mass
            b.w -= c.spin_b * turn
