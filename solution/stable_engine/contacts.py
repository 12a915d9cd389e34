"""Contacts: bodies do not pass through each other."""

from __future__ import annotations

from math import copysign, cos, hypot, sin
from typing import TYPE_CHECKING

from pygame import Vector2

from .broad_phase import near_pairs
from .effect import Effect, softness

if TYPE_CHECKING:
    from .body import Body
    from .world import World

MARGIN = 2.0  # px, a gap narrower than this makes a contact ahead of time
STIFFNESS = 0.125  # frequency of a contact between balls, times h; static bodies are twice as stiff
ZETA = 10.0  # damping ratio of a contact
PUSH_SPEED = 300.0  # px/s, overlap is pushed out no faster
SAME_WAY = 0.9  # cosine; a normal that turned further starts without impulses
GOLDEN_ANGLE = 2.399963  # rad

Touch = tuple[float, float, float]  # nx, ny, gap
Row = tuple["Contact", "Body", "Body", float, float, float, float]  # a, b, nx, ny, reach, mn


class Contact:
    """Two bodies that touch or soon will. It lives as long as they stay near each other."""

    __slots__ = ("a", "b", "e", "gap", "jn", "jt", "mn", "mt", "mu", "nx", "ny")

    def __init__(self, a: Body, b: Body) -> None:
        self.a = a  # a ball
        self.b = b
        self.nx = self.ny = 0.0  # unit normal from A to B
        self.gap = 0.0  # px, negative when they overlap
        self.mn = 1 / (a.inv_mass + b.inv_mass)  # kg, effective mass along the normal
        self.mt = 0.0  # kg, effective mass along the tangent
        self.mu = 0.0  # friction of the pair
        self.e = 0.0  # restitution of the pair
        self.jn = 0.0  # kg px/s, accumulated normal impulse, never negative
        self.jt = 0.0  # kg px/s, accumulated friction impulse

    @property
    def normal(self) -> Vector2:
        """The unit normal from A to B."""
        return Vector2(self.nx, self.ny)

    def closing_speed(self) -> float:
        """How fast A and B come together, in px/s."""
        a, b = self.a, self.b
        return (a.vx - b.vx) * self.nx + (a.vy - b.vy) * self.ny


class Contacts(Effect):
    """Contacts found once per step and solved as stiff springs in every substep.

    Springs push overlapping bodies apart gently and their impulses are carried over from substep
    to substep; relaxing afterwards takes back the speed this gave. Source: Solver2D, 2024.
    """

    rank = 3

    def __init__(self) -> None:
        self.contacts: list[Contact] = []
        self.known: dict[tuple[int, int], Contact] = {}
        self.of_sleepers: dict[tuple[int, int], Contact] = {}
        self.ball_rows: list[Row] = []
        self.wall_rows: list[Row] = []

    def join(self, world: World) -> None:
        super().join(world)
        self.meet_hooks = world.hooks("meet")
        self.strike_hooks = world.hooks("strike")

    def detect(self, h: float) -> None:
        self.contacts = self.find_contacts()

    def find_contacts(self) -> list[Contact]:
        """The contacts of all bodies where they are now, impulses kept from the step before."""
        found = {}
        for a, b in near_pairs(self.world.bodies, MARGIN):
            nx, ny, gap = collide(a, b)
            if gap >= MARGIN:
                continue
            key = (a.id, b.id)
            c = self.known.get(key)
            if c is None:
                c = Contact(a, b)
                for meet in self.meet_hooks:
                    meet(c)
            elif c.nx * nx + c.ny * ny < SAME_WAY:
                c.jn = c.jt = 0.0
            c.nx, c.ny, c.gap = nx, ny, gap
            found[key] = c
        self.known = found
        return list(found.values())

    def prepare(self, h: float) -> None:
        self.ball_rate, self.ball_keep = softness(STIFFNESS / h, ZETA, h)
        self.wall_rate, self.wall_keep = softness(2 * STIFFNESS / h, ZETA, h)
        rows = [(c, c.a, c.b, c.nx, c.ny, reach(c), c.mn) for c in self.contacts]
        self.ball_rows = [row for row in rows if row[2].inv_mass]
        self.wall_rows = [row for row in rows if not row[2].inv_mass]

    def warm_start(self, h: float) -> None:
        for c, a, b, nx, ny, _, _ in self.ball_rows:
            px, py = nx * c.jn, ny * c.jn
            a.vx -= px * a.inv_mass
            a.vy -= py * a.inv_mass
            b.vx += px * b.inv_mass
            b.vy += py * b.inv_mass
        for c, a, _, nx, ny, _, _ in self.wall_rows:
            j = c.jn * a.inv_mass
            a.vx -= nx * j
            a.vy -= ny * j

    def solve(self, h: float) -> None:
        rate, keep = self.ball_rate, self.ball_keep
        for c, a, b, nx, ny, touch, mn in self.ball_rows:
            gap = (b.x - a.x) * nx + (b.y - a.y) * ny - touch
            speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
            if gap > 0:
                jn = c.jn - mn * (speed + gap / h)
            else:
                jn = keep * (c.jn - mn * speed) - mn * max(rate * gap, -PUSH_SPEED)
            if jn < 0:
                jn = 0.0
            change = jn - c.jn
            c.jn = jn
            px, py = nx * change, ny * change
            a.vx -= px * a.inv_mass
            a.vy -= py * a.inv_mass
            b.vx += px * b.inv_mass
            b.vy += py * b.inv_mass
        rate, keep = self.wall_rate, self.wall_keep
        for c, a, b, nx, ny, touch, mn in self.wall_rows:
            gap = (b.x - a.x) * nx + (b.y - a.y) * ny - touch
            speed = -a.vx * nx - a.vy * ny
            if gap > 0:
                jn = c.jn - mn * (speed + gap / h)
            else:
                jn = keep * (c.jn - mn * speed) - mn * max(rate * gap, -PUSH_SPEED)
            if jn < 0:
                jn = 0.0
            change = (jn - c.jn) * a.inv_mass
            c.jn = jn
            a.vx -= nx * change
            a.vy -= ny * change

    def relax(self, h: float) -> None:
        for c, a, b, nx, ny, touch, mn in self.ball_rows:
            gap = (b.x - a.x) * nx + (b.y - a.y) * ny - touch
            speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
            if gap > 0:
                speed += gap / h
            jn = c.jn - mn * speed
            if jn < 0:
                jn = 0.0
            change = jn - c.jn
            c.jn = jn
            px, py = nx * change, ny * change
            a.vx -= px * a.inv_mass
            a.vy -= py * a.inv_mass
            b.vx += px * b.inv_mass
            b.vy += py * b.inv_mass
        for c, a, b, nx, ny, touch, mn in self.wall_rows:
            gap = (b.x - a.x) * nx + (b.y - a.y) * ny - touch
            speed = -a.vx * nx - a.vy * ny
            if gap > 0:
                speed += gap / h
            jn = c.jn - mn * speed
            if jn < 0:
                jn = 0.0
            change = (jn - c.jn) * a.inv_mass
            c.jn = jn
            a.vx -= nx * change
            a.vy -= ny * change

    def strike(self, c: Contact, jn: float) -> None:
        """Part A and B by impulse jn along the normal; other effects answer it too."""
        a, b = c.a, c.b
        a.vx -= c.nx * jn * a.inv_mass
        a.vy -= c.ny * jn * a.inv_mass
        b.vx += c.nx * jn * b.inv_mass
        b.vy += c.ny * jn * b.inv_mass

    def links(self) -> list[tuple[Body, Body]]:
        return [(c.a, c.b) for c in self.contacts]

    def rouse(self) -> None:
        """Keep what sleepers' contacts know, so that they wake as calm as they fell asleep."""
        self.known = self.of_sleepers | self.known
        self.of_sleepers = {key: c for key, c in self.known.items() if c.a.asleep}


def reach(c: Contact) -> float:
    """How far apart along the normal the centres are when A and B just touch, in px."""
    a, b = c.a, c.b
    return (b.x - a.x) * c.nx + (b.y - a.y) * c.ny - c.gap


def collide(a: Body, b: Body) -> Touch:
    """Normal from circle A to body B, and the gap between them."""
    return circle_circle(a, b) if b.radius else circle_box(a, b)


def circle_circle(a: Body, b: Body) -> Touch:
    """Two balls; those with the same centre part in a direction of their own per pair."""
    dx, dy = b.x - a.x, b.y - a.y
    distance = hypot(dx, dy)
    if distance > 0:
        return dx / distance, dy / distance, distance - a.radius - b.radius
    turn = (7919 * a.id + b.id) * GOLDEN_ANGLE
    return cos(turn), sin(turn), -a.radius - b.radius


def circle_box(a: Body, b: Body) -> Touch:
    """A ball and a box; a centre inside the box leaves through the nearest face."""
    x, y = a.x - b.x, a.y - b.y
    dx, dy = max(-b.hx, min(x, b.hx)) - x, max(-b.hy, min(y, b.hy)) - y
    distance = hypot(dx, dy)
    if distance > 0:
        return dx / distance, dy / distance, distance - a.radius
    out_x, out_y = b.hx - abs(x), b.hy - abs(y)
    if out_y <= out_x:
        return 0.0, -copysign(1.0, y), -a.radius - out_y
    return -copysign(1.0, x), 0.0, -a.radius - out_x
