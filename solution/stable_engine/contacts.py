"""Contacts: bodies do not pass through each other."""

from __future__ import annotations

from math import copysign, cos, hypot, sin
from typing import TYPE_CHECKING

from pygame import Vector2

from .broad_phase import near_pairs
from .effect import Effect
from .soft import softness

if TYPE_CHECKING:
    from .body import Body
    from .world import World

STIFFNESS = 0.24  # frequency of a contact of two balls, per substep; a static body doubles it
ZETA = 10.0  # damping ratio of a contact
PUSH_SPEED = 300.0  # px/s, overlap is pushed out no faster
RESTING_SPEED = 30.0  # px/s, a slower blow does not bounce
SLOW = 10.0  # px/s, bodies slower than this, one seen from the other, touch ahead of time
SAME_WAY = 0.9  # cosine of the turn of a normal that ends its contact's impulses
GOLDEN_ANGLE = 2.399963  # rad

Touch = tuple[float, float, float]  # nx, ny, gap
Row = tuple["Contact", "Body", "Body", *tuple[float, ...]]


class Contact:
    """Two bodies that touch. It lives as long as they do so, step after step."""

    __slots__ = ("a", "b", "e", "gap", "jn", "jt", "mn", "mt", "mu", "nx", "ny")

    def __init__(self, a: Body, b: Body) -> None:
        self.a = a  # always a ball with mass
        self.b = b
        self.nx = self.ny = 0.0  # unit normal from A to B
        self.gap = 0.0  # px, negative when they overlap
        self.mn = 1 / (a.inv_mass + b.inv_mass)  # kg, effective mass along the normal
        self.jn = 0.0  # kg px/s, accumulated normal impulse, never negative
        self.jt = 0.0  # kg px/s, accumulated friction impulse
        self.mt = 0.0  # kg, effective mass along the tangent, from Friction
        self.mu = 0.0  # from Friction
        self.e = 0.0  # restitution, from Bounce

    @property
    def normal(self) -> Vector2:
        """The unit normal from A to B."""
        return Vector2(self.nx, self.ny)

    def closing_speed(self) -> float:
        """How fast A and B come together, in px/s."""
        a, b = self.a, self.b
        return (a.vx - b.vx) * self.nx + (a.vy - b.vy) * self.ny


class Contacts(Effect):
    """Contacts found once per step and solved in every substep as stiff, damped springs.

    In the loops, ax and ay are what a unit of impulse takes from A's velocity, bx and by what it
    gives to B's. Two centres are reach px apart along the normal when their bodies just touch.
    """

    rank = 3

    def __init__(self) -> None:
        self.touching: list[Contact] = []
        self.known: dict[tuple[int, int], Contact] = {}
        self.known_asleep: dict[tuple[int, int], Contact] = {}

    def join(self, world: World) -> None:
        super().join(world)
        self.meet_hooks = world.hooks("meet")
        self.strike_hooks = world.hooks("strike")

    def detect(self, h: float) -> None:
        self.touching = self.find_contacts(h * self.world.substeps)

    def find_contacts(self, dt: float) -> list[Contact]:
        """The contacts of all bodies where they are now, with the impulses they had before.

        Bodies that overlap touch. So do slow ones that will meet within dt seconds; fast ones may
        yet miss each other.
        """
        margin = SLOW * dt
        known, found = self.known, {}
        for a, b in near_pairs(self.world.bodies, self.world.awake, margin):
            nx, ny, gap = circle_circle(a, b) if b.radius else circle_box(a, b)
            if gap > 0 and (gap > margin or hypot(b.vx - a.vx, b.vy - a.vy) > SLOW):
                continue
            pair = a.id, b.id
            c = known.get(pair)
            if c is None:
                c = Contact(a, b)
                for meet in self.meet_hooks:
                    meet(c)
            elif nx * c.nx + ny * c.ny < SAME_WAY:
                c.jn = c.jt = 0.0
            c.nx, c.ny, c.gap = nx, ny, gap
            found[pair] = c
        self.known = found
        return list(found.values())

    def blow(self, c: Contact, change: float) -> None:
        """Raise the speed at which A and B part by change (px/s), at once."""
        a, b = c.a, c.b
        jn = c.mn * change
        a.vx -= c.nx * jn * a.inv_mass
        a.vy -= c.ny * jn * a.inv_mass
        b.vx += c.nx * jn * b.inv_mass
        b.vy += c.ny * jn * b.inv_mass
        for strike in self.strike_hooks:
            strike(c, jn)

    def prepare(self, h: float) -> None:
        ball_spring = softness(STIFFNESS / h, ZETA, h)
        wall_spring = softness(2 * STIFFNESS / h, ZETA, h)
        self.rows: list[Row] = []
        for c in self.touching:
            a, b, nx, ny = c.a, c.b, c.nx, c.ny
            reach = (b.x - a.x) * nx + (b.y - a.y) * ny - c.gap
            rate, keep = ball_spring if b.inv_mass else wall_spring
            ax, ay, bx, by = nx * a.inv_mass, ny * a.inv_mass, nx * b.inv_mass, ny * b.inv_mass
            self.rows.append((c, a, b, nx, ny, reach, c.mn, rate, keep, ax, ay, bx, by))

    def warm_start(self, h: float) -> None:
        for c, a, b, _, _, _, _, _, _, ax, ay, bx, by in self.rows:
            jn = c.jn
            a.vx -= ax * jn
            a.vy -= ay * jn
            b.vx += bx * jn
            b.vy += by * jn

    def solve(self, h: float) -> None:
        for c, a, b, nx, ny, reach, mn, rate, keep, ax, ay, bx, by in self.rows:
            gap = (b.x - a.x) * nx + (b.y - a.y) * ny - reach
            speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
            before = c.jn
            if gap > 0:
                jn = before - mn * (speed + gap / h)
            else:
                push = rate * gap
                if push < -PUSH_SPEED:
                    push = -PUSH_SPEED
                jn = keep * (before - mn * speed) - mn * push
            if jn < 0:
                jn = 0.0
            c.jn = jn
            jn -= before
            a.vx -= ax * jn
            a.vy -= ay * jn
            b.vx += bx * jn
            b.vy += by * jn

    def relax(self, h: float) -> None:
        for c, a, b, nx, ny, reach, mn, _, _, ax, ay, bx, by in self.rows:
            gap = (b.x - a.x) * nx + (b.y - a.y) * ny - reach
            speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
            if gap > 0:
                speed += gap / h
            before = c.jn
            jn = before - mn * speed
            if jn < 0:
                jn = 0.0
            c.jn = jn
            jn -= before
            a.vx -= ax * jn
            a.vy -= ay * jn
            b.vx += bx * jn
            b.vy += by * jn

    def links(self) -> list[tuple[Body, Body]]:
        return [(c.a, c.b) for c in self.touching]

    def rouse(self) -> None:
        """Remember what sleepers knew of their contacts: they wake as calm as they fell asleep."""
        self.known = self.known_asleep | self.known
        self.known_asleep = {pair: c for pair, c in self.known.items() if c.a.asleep}


def circle_circle(a: Body, b: Body) -> Touch:
    """Normal and gap of two circles. Those with one centre part, each pair in its own direction."""
    dx, dy = b.x - a.x, b.y - a.y
    distance = hypot(dx, dy)
    if distance > 0:
        return dx / distance, dy / distance, distance - a.radius - b.radius
    turn = (7919 * a.id + b.id) * GOLDEN_ANGLE
    return cos(turn), sin(turn), -a.radius - b.radius


def circle_box(a: Body, b: Body) -> Touch:
    """Normal and gap of a circle and a box; a centre inside leaves through the nearest face."""
    x, y = a.x - b.x, a.y - b.y
    dx, dy = max(-b.hx, min(x, b.hx)) - x, max(-b.hy, min(y, b.hy)) - y
    distance = hypot(dx, dy)
    if distance > 0:
        return dx / distance, dy / distance, distance - a.radius
    out_x, out_y = b.hx - abs(x), b.hy - abs(y)
    if out_y <= out_x:
        return 0.0, -copysign(1.0, y), -a.radius - out_y
    return -copysign(1.0, x), 0.0, -a.radius - out_x
