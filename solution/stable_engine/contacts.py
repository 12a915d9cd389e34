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

RESTING_SPEED = 30.0  # px/s, a slower blow does not bounce
SLOW = 10.0
WALL = 0.5
STIFFNESS = 0.22  # frequency of a contact between balls, times h; static bodies are twice as stiff
ZETA = 10.0  # damping ratio of a contact
PUSH_SPEED = 300.0  # px/s, overlap is pushed out no faster
SAME_WAY = 0.9  # cosine; a normal that turned further starts without impulses
GOLDEN_ANGLE = 2.399963  # rad

Touch = tuple[float, float, float]  # nx, ny, gap
BallRow = tuple[
    "Contact", "Body", "Body", float, float, float, float, float, float, float, float
]
WallRow = tuple["Contact", "Body", float, float, float, float, float, float]


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
        self.ball_rows: list[BallRow] = []
        self.wall_rows: list[WallRow] = []

    def join(self, world: World) -> None:
        super().join(world)
        self.meet_hooks = world.hooks("meet")
        self.strike_hooks = world.hooks("strike")

    def detect(self, h: float) -> None:
        self.contacts = self.find_contacts(h * self.world.substeps)

    def find_contacts(self, dt: float) -> list[Contact]:
        """The contacts of all bodies where they are now, impulses kept from the step before.

        Bodies that overlap are in contact, and so are those that will touch in dt seconds, if slow.
        Faster ones may yet miss each other.
        """
        margin = SLOW * dt
        known, found = self.known, {}
        for a, b in near_pairs(self.world.bodies, margin):
            nx, ny, gap = circle_circle(a, b) if b.radius else circle_box(a, b)
            if gap > 0 and (gap > margin or speed2(a, b) > SLOW**2):
                continue
            pair = a.id, b.id
            c = known.get(pair)
            if c is None:
                c = Contact(a, b)
                for meet in self.meet_hooks:
                    meet(c)
            elif c.nx * nx + c.ny * ny < SAME_WAY:
                c.jn = c.jt = 0.0
            c.nx, c.ny, c.gap = nx, ny, gap
            found[pair] = c
        self.known = found
        return list(found.values())

    def prepare(self, h: float) -> None:
        self.ball_spring = softness(STIFFNESS / h, ZETA, h)
        self.wall_spring = softness(WALL / h, ZETA, h)
        self.ball_rows = [ball_row(c) for c in self.contacts if not c.b.is_static]
        self.wall_rows = [wall_row(c) for c in self.contacts if c.b.is_static]

    def warm_start(self, h: float) -> None:
        for c, a, b, _, _, _, _, ax, ay, bx, by in self.ball_rows:
            jn = c.jn
            a.vx -= ax * jn
            a.vy -= ay * jn
            b.vx += bx * jn
            b.vy += by * jn
        for c, a, _, _, _, _, ax, ay in self.wall_rows:
            a.vx -= ax * c.jn
            a.vy -= ay * c.jn

    def solve(self, h: float) -> None:
        rate, keep = self.ball_spring
        for c, a, b, nx, ny, reach, mn, ax, ay, bx, by in self.ball_rows:
            gap = (b.x - a.x) * nx + (b.y - a.y) * ny - reach
            speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
            before = c.jn
            if gap > 0:
                jn = before - mn * (speed + gap / h)
            else:
                push = rate * gap
                if push < -PUSH_SPEED:
                    push = -PUSH_SPEED
                jn = keep * before - mn * (keep * speed + push)
            if jn < 0:
                jn = 0.0
            c.jn = jn
            jn -= before
            a.vx -= ax * jn
            a.vy -= ay * jn
            b.vx += bx * jn
            b.vy += by * jn
        rate, keep = self.wall_spring
        for c, a, nx, ny, wall, mn, ax, ay in self.wall_rows:
            gap = wall - a.x * nx - a.y * ny
            speed = -a.vx * nx - a.vy * ny
            before = c.jn
            if gap > 0:
                jn = before - mn * (speed + gap / h)
            else:
                push = rate * gap
                if push < -PUSH_SPEED:
                    push = -PUSH_SPEED
                jn = keep * before - mn * (keep * speed + push)
            if jn < 0:
                jn = 0.0
            c.jn = jn
            jn -= before
            a.vx -= ax * jn
            a.vy -= ay * jn

    def relax(self, h: float) -> None:
        for c, a, b, nx, ny, reach, mn, ax, ay, bx, by in self.ball_rows:
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
        for c, a, nx, ny, wall, mn, ax, ay in self.wall_rows:
            gap = wall - a.x * nx - a.y * ny
            speed = -a.vx * nx - a.vy * ny
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

    def links(self) -> list[tuple[Body, Body]]:
        return [(c.a, c.b) for c in self.contacts]

    def rouse(self) -> None:
        """Keep what sleepers' contacts know, so that they wake as calm as they fell asleep."""
        self.known = self.of_sleepers | self.known
        self.of_sleepers = {key: c for key, c in self.known.items() if c.a.asleep}


def ball_row(c: Contact) -> BallRow:
    a, b, nx, ny = c.a, c.b, c.nx, c.ny
    reach = (b.x - a.x) * nx + (b.y - a.y) * ny - c.gap
    ma, mb = a.inv_mass, b.inv_mass
    return c, a, b, nx, ny, reach, c.mn, nx * ma, ny * ma, nx * mb, ny * mb


def wall_row(c: Contact) -> WallRow:
    a, nx, ny = c.a, c.nx, c.ny
    wall = a.x * nx + a.y * ny + c.gap
    return c, a, nx, ny, wall, c.mn, nx * a.inv_mass, ny * a.inv_mass


def speed2(a, b):
    return (b.vx-a.vx)**2+(b.vy-a.vy)**2

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
