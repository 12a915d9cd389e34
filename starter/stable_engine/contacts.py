"""Contacts: bodies do not pass through each other."""

from math import hypot

from .body import Body
from .broad_phase import near_pairs
from .contact import Contact, collide
from .effect import Effect
from .soft import SAME_WAY, softness
from .world import World

STIFFNESS = 0.24  # frequency of a contact of two balls, per substep; a static body doubles it
ZETA = 10.0  # damping ratio of a contact
PUSH_SPEED = 300.0  # px/s, overlap is pushed out no faster
RESTING_SPEED = 30.0  # px/s, a slower blow does not bounce
SLOW = 10.0  # px/s, bodies that move slower past each other touch ahead of time
STAY = 1e-4  # px, contacts are good until a body has moved further

BallRow = tuple[Contact, Body, Body, float, float, float, float, float, float, float, float]
WallRow = tuple[Contact, Body, Body, float, float, float, float, float, float]


class Contacts(Effect):
    """Contacts found once per step and solved in every substep as stiff, damped springs.

    In the rows, ax and ay are what a unit of impulse takes from A's velocity, bx and by what it
    gives to B's; centres that are reach px apart along the normal just touch. Ball rows and wall
    rows differ in that no impulse moves B.
    """

    rank = 3

    def __init__(self) -> None:
        self.touching: list[Contact] = []
        self.fresh = False  # whether this step looked for contacts
        self.places: list[tuple[Body, float, float]] = []  # of all bodies when last looked
        self.known: dict[tuple[int, int], Contact] = {}
        self.known_asleep: dict[tuple[int, int], Contact] = {}
        self.spared: set[tuple[int, int]] = set()

    def join(self, world: World) -> None:
        super().join(world)
        self.meet_hooks = world.hooks("meet")
        self.strike_hooks = world.hooks("strike")

    def detect(self, h: float) -> None:
        bodies = self.world.bodies
        moved = [abs(body.x - x) + abs(body.y - y) > STAY for body, x, y in self.places]
        self.fresh = len(moved) < len(bodies) or any(moved)
        if self.fresh:
            self.places = [(body, body.x, body.y) for body in bodies]
            self.touching = self.find_contacts(h * self.world.substeps)

    def find_contacts(self, dt: float) -> list[Contact]:
        """The contacts of all bodies where they are now, with the impulses they had before.

        Bodies that overlap touch. So do slow ones that may meet within dt seconds; of fast ones
        nobody knows yet whether they will miss each other.
        """
        margin = SLOW * dt
        known, found = self.known, {}
        for a, b in near_pairs(self.world.bodies, self.world.awake, margin):
            nx, ny, gap = collide(a, b)
            if gap > 0 and (gap > margin or hypot(b.vx - a.vx, b.vy - a.vy) > SLOW):
                continue
            pair = a.id, b.id
            c = known.get(pair)
            if c is None:
                if pair in self.spared:
                    continue
                c = self.new_contact(a, b)
            elif nx * c.nx + ny * c.ny < SAME_WAY:
                c.jn = c.jt = 0.0
            c.nx, c.ny, c.gap = nx, ny, gap
            found[pair] = c
        self.known = found
        return list(found.values())

    def new_contact(self, a: Body, b: Body) -> Contact:
        """A contact that other effects have filled in."""
        c = Contact(a, b, mn=1 / (a.inv_mass + b.inv_mass))
        for meet in self.meet_hooks:
            meet(c)
        return c

    def spare(self, a: Body, b: Body) -> None:
        """Never let A and B touch: something else holds them overlapping."""
        self.spared |= {(a.id, b.id), (b.id, a.id)}
        self.known = {pair: c for pair, c in self.known.items() if pair not in self.spared}
        self.places = []

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
        self.ball_spring = softness(STIFFNESS / h, ZETA, h)
        self.wall_spring = softness(2 * STIFFNESS / h, ZETA, h)
        if not self.fresh:
            return
        self.ball_rows: list[BallRow] = []
        self.wall_rows: list[WallRow] = []
        for c in self.touching:
            a, b, nx, ny, mn = c.a, c.b, c.nx, c.ny, c.mn
            ax, ay = nx * a.inv_mass, ny * a.inv_mass
            reach = (b.x - a.x) * nx + (b.y - a.y) * ny - c.gap
            if b.inv_mass:
                bx, by = nx * b.inv_mass, ny * b.inv_mass
                self.ball_rows.append((c, a, b, nx, ny, mn, reach, ax, ay, bx, by))
            else:
                self.wall_rows.append((c, a, b, nx, ny, mn, reach, ax, ay))

    def warm_start(self, h: float) -> None:
        for c, a, b, _, _, _, _, ax, ay, bx, by in self.ball_rows:
            jn = c.jn
            a.vx -= ax * jn
            a.vy -= ay * jn
            b.vx += bx * jn
            b.vy += by * jn
        for c, a, _, _, _, _, _, ax, ay in self.wall_rows:
            jn = c.jn
            a.vx -= ax * jn
            a.vy -= ay * jn

    def solve(self, h: float) -> None:
        rate, keep = self.ball_spring
        for c, a, b, nx, ny, mn, reach, ax, ay, bx, by in self.ball_rows:
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
        rate, keep = self.wall_spring
        for c, a, b, nx, ny, mn, reach, ax, ay in self.wall_rows:
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

    def relax(self, h: float) -> None:
        for c, a, b, nx, ny, mn, reach, ax, ay, bx, by in self.ball_rows:
            speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
            before = c.jn
            if not before:
                gap = (b.x - a.x) * nx + (b.y - a.y) * ny - reach
                if gap > 0:
                    speed += gap / h
            jn = before - mn * speed
            if jn < 0:
                jn = 0.0
            c.jn = jn
            jn -= before
            a.vx -= ax * jn
            a.vy -= ay * jn
            b.vx += bx * jn
            b.vy += by * jn
        for c, a, b, nx, ny, mn, reach, ax, ay in self.wall_rows:
            speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
            before = c.jn
            if not before:
                gap = (b.x - a.x) * nx + (b.y - a.y) * ny - reach
                if gap > 0:
                    speed += gap / h
            jn = before - mn * speed
            if jn < 0:
                jn = 0.0
            c.jn = jn
            jn -= before
            a.vx -= ax * jn
            a.vy -= ay * jn

    def links(self) -> list[tuple[Body, Body]]:
        return [(c.a, c.b) for c in self.touching]

    def rouse(self) -> None:
        """Keep what sleepers know of their contacts: they wake as calm as they fell asleep."""
        self.places = []
        self.known = self.known_asleep | self.known
        self.known_asleep = {pair: c for pair, c in self.known.items() if c.a.asleep}
