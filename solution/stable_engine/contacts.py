"""Contacts: bodies do not pass through each other."""

from collections.abc import Callable
from math import hypot

from .body import Body
from .broad_phase import BroadPhase
from .contact import Contact, behind_face, collide
from .effect import Effect
from .soft import SAME_DIRECTION, Pace, softness
from .sweep import stop_at_first_hit
from .world import World

FREQUENCY = 0.24  # of a contact of two balls, per substep; against a static body it is doubled
DAMPING_RATIO = 10.0  # so high that overlap is pushed out without a bounce
STIFFENING = 0.07  # of a substep, per step
MAX_PUSH_SPEED = 300.0  # px/s, overlap is pushed out no faster
RESTING_SPEED = 30.0  # px/s, a slower impact does not bounce
SPECULATIVE_SPEED = 10.0  # px/s, slower pairs get a contact before they touch
CORE = 0.5  # radii
REDETECT_DISTANCE = 1e-4  # px, contacts stay valid until a body has moved further

OnHit = Callable[[Body, Body, float], object]


class Group:
    """Contacts that are solved alike: those of two balls, or those of balls and static bodies."""

    __slots__ = ("bias_rate", "contacts", "mass_scale", "moves_b")

    def __init__(self, moves_b: bool) -> None:
        self.moves_b = moves_b  # whether an impulse moves B
        self.contacts: list[Contact] = []
        self.bias_rate = self.mass_scale = 0.0  # see softness


class Contacts(Effect):
    """Contacts found once per step and solved in every substep as soft constraints.

    on_hit(a, b, speed) is called at the end of a step for each two bodies that began to touch in
    it, with the speed (px/s) at which they came together. It may add and remove bodies.

    Each stage solves contacts of two balls first: the last word is that of the static bodies.
    """

    rank = 3

    def __init__(self, on_hit: OnHit | None = None) -> None:
        self.on_hit = on_hit
        self.hits: list[tuple[Body, Body, float]] = []  # of this step, where somebody asks
        self.touching: list[Contact] = []
        self.changed = False  # whether contacts are new in this step, so that rows must be too
        self.broad_phase = BroadPhase()
        self.balls, self.statics = Group(moves_b=True), Group(moves_b=False)
        self.groups = [self.balls, self.statics]
        self.cache: dict[tuple[int, int], Contact] = {}
        self.sleeping_cache: dict[tuple[int, int], Contact] = {}
        self.ignored: set[tuple[int, int]] = set()
        self.pace = Pace(STIFFENING)

    def attach(self, world: World) -> None:
        super().attach(world)
        self.begin_contact_hooks = world.hooks("begin_contact")
        self.after_impact_hooks = world.hooks("after_impact")

    def detect(self, h: float) -> None:
        bodies = self.world.bodies
        is_new = len(self.broad_phase.bounds) < len(bodies)
        self.changed = is_new or self.any_moved()
        if is_new:
            self.broad_phase.take(bodies)
        if self.changed:
            self.touching = self.find_contacts(h * self.world.substeps)

    def any_moved(self) -> bool:
        """Whether any body is no longer where contacts were last found."""
        for last in self.broad_phase.bounds:
            body = last.body
            if abs(body.x - last.x) + abs(body.y - last.y) > REDETECT_DISTANCE:
                return True
        return False

    def find_contacts(self, dt: float) -> list[Contact]:
        """The contacts of all bodies where they are now, with the impulses they had before.

        Bodies that overlap are in contact. So are slow ones that may touch within dt seconds: such
        a speculative contact lets them close the gap and no more. Fast ones may still miss each
        other, so they get none.
        """
        margin = SPECULATIVE_SPEED * dt
        cache, found = self.cache, {}
        for a, b in self.broad_phase.near_pairs(self.world.awake, margin):
            nx, ny, gap = collide(a, b)
            if gap > 0 and (gap > margin or hypot(b.vx - a.vx, b.vy - a.vy) > SPECULATIVE_SPEED):
                continue
            pair = a.id, b.id
            c = cache.get(pair)
            if c is None:
                if pair in self.ignored:
                    continue
                c = self.new_contact(a, b)
                if self.on_hit:
                    c.nx, c.ny = nx, ny
                    self.hits.append((a, b, max(c.closing_speed(), 0.0)))
            else:
                if gap < -a.radius and not b.radius:
                    nx, ny, gap = behind_face(a, b, c.nx, c.ny)
                if nx * c.nx + ny * c.ny < SAME_DIRECTION:
                    c.jn = c.jt = 0.0
            c.nx, c.ny, c.gap = nx, ny, gap
            found[pair] = c
        self.cache = found
        return list(found.values())

    def new_contact(self, a: Body, b: Body) -> Contact:
        """A contact, with what other effects need of it filled in."""
        c = Contact(a, b)
        for begin_contact in self.begin_contact_hooks:
            begin_contact(c)
        return c

    def ignore_pair(self, a: Body, b: Body) -> None:
        """Let A and B pass through each other: a joint may hold them overlapping."""
        self.ignored |= pair_both_ways(a, b)
        self.cache = {pair: c for pair, c in self.cache.items() if pair not in self.ignored}
        self.broad_phase.bounds = []

    def apply_impact(self, c: Contact, change: float) -> None:
        """Raise the speed at which A and B separate by change (px/s), with one impulse at once."""
        a, b = c.a, c.b
        jn = c.mn * change
        a.vx -= c.nx * jn * a.inv_mass
        a.vy -= c.ny * jn * a.inv_mass
        b.vx += c.nx * jn * b.inv_mass
        b.vy += c.ny * jn * b.inv_mass
        for after_impact in self.after_impact_hooks:
            after_impact(c, jn)

    def prepare(self, h: float) -> None:
        hertz = FREQUENCY / self.pace.follow(h)
        self.balls.bias_rate, self.balls.mass_scale = softness(hertz, DAMPING_RATIO, h)
        self.statics.bias_rate, self.statics.mass_scale = softness(2 * hertz, DAMPING_RATIO, h)
        if not self.changed:
            return
        self.balls.contacts = [c for c in self.touching if c.b.inv_mass]
        self.statics.contacts = [c for c in self.touching if not c.b.inv_mass]
        for c in self.touching:
            a, b, nx, ny = c.a, c.b, c.nx, c.ny
            c.ax, c.ay = nx * a.inv_mass, ny * a.inv_mass
            c.bx, c.by = nx * b.inv_mass, ny * b.inv_mass
            c.reach = (b.x - a.x) * nx + (b.y - a.y) * ny - c.gap

    def warm_start(self, h: float) -> None:
        for group in self.groups:
            moves_b = group.moves_b
            for c in group.contacts:
                a, b, jn = c.a, c.b, c.jn
                a.vx -= c.ax * jn
                a.vy -= c.ay * jn
                if moves_b:
                    b.vx += c.bx * jn
                    b.vy += c.by * jn

    def solve(self, h: float) -> None:
        for group in self.groups:
            moves_b, bias_rate, mass_scale = group.moves_b, group.bias_rate, group.mass_scale
            for c in group.contacts:
                a, b, nx, ny, mn = c.a, c.b, c.nx, c.ny, c.mn
                gap = (b.x - a.x) * nx + (b.y - a.y) * ny - c.reach
                speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
                before = c.jn
                if gap > 0:
                    jn = before - mn * (speed + gap / h)
                else:
                    push = bias_rate * gap
                    if push < -MAX_PUSH_SPEED:
                        push = -MAX_PUSH_SPEED
                    jn = mass_scale * (before - mn * speed) - mn * push
                if jn < 0:
                    jn = 0.0
                c.jn = jn
                jn -= before
                a.vx -= c.ax * jn
                a.vy -= c.ay * jn
                if moves_b:
                    b.vx += c.bx * jn
                    b.vy += c.by * jn

    def relax(self, h: float) -> None:
        for group in self.groups:
            moves_b = group.moves_b
            for c in group.contacts:
                a, b, nx, ny = c.a, c.b, c.nx, c.ny
                speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
                before = c.jn
                if not before:
                    gap = (b.x - a.x) * nx + (b.y - a.y) * ny - c.reach
                    if gap > 0:
                        speed += gap / h
                jn = before - c.mn * speed
                if jn < 0:
                    jn = 0.0
                c.jn = jn
                jn -= before
                a.vx -= c.ax * jn
                a.vy -= c.ay * jn
                if moves_b:
                    b.vx += c.bx * jn
                    b.vy += c.by * jn

    def finish(self, h: float) -> None:
        """Keep the core of a fast ball out of static bodies, and tell of hits.

        Deep in a static body, a ball might leave it on the other side.

        The core is half as wide as the ball, so that one that slides is not held up at a seam.
        """
        for last in self.broad_phase.bounds:
            body = last.body
            distance = abs(body.x - last.x) + abs(body.y - last.y)
            if distance > body.radius > 0 and not body.bullet:
                self.sweep(body, (last.x, last.y), CORE * body.radius, 0.0, h)
        if self.hits and self.on_hit:
            hits, self.hits = self.hits, []
            for a, b, speed in hits:
                if a.world and b.world:
                    self.on_hit(a, b, speed)

    def sweep(
        self, body: Body, start: tuple[float, float], radius: float, overlap: float, h: float
    ) -> None:
        """Stop a ball at the first static body on its way from start that it does not pass through.

        See stop_at_first_hit.
        """
        statics = self.world.statics
        if self.ignored:
            statics = [s for s in statics if (body.id, s.id) not in self.ignored]
        stop_at_first_hit(body, start, radius, overlap, statics, self.world.gravity, h)

    def of_body(self, body: Body) -> list[Contact]:
        """The contacts of a body, those it sleeps with among them."""
        contacts = [*self.cache.values(), *self.sleeping_cache.values()]
        return [c for c in contacts if body in (c.a, c.b)]

    def body_changed(self, body: Body) -> None:
        """Fill its contacts in anew, and wake whatever touches it."""
        for c in self.of_body(body):
            c.mn = 1 / (c.a.inv_mass + c.b.inv_mass)
            for begin_contact in self.begin_contact_hooks:
                begin_contact(c)
            c.a.wake()
            c.b.wake()
        self.broad_phase.bounds = []

    def forget(self, body: Body) -> None:
        """Wake whatever touches it: it may have lain on it."""
        for c in self.of_body(body):
            c.a.wake()
            c.b.wake()
        gone = {(c.a.id, c.b.id) for c in self.of_body(body)}
        self.cache = {pair: c for pair, c in self.cache.items() if pair not in gone}
        self.sleeping_cache = {p: c for p, c in self.sleeping_cache.items() if p not in gone}
        self.touching = [c for c in self.touching if body not in (c.a, c.b)]
        self.broad_phase.bounds = []

    def is_used(self) -> bool:
        return len(self.world.bodies) > 1

    def links(self) -> list[tuple[Body, Body]]:
        return [(c.a, c.b) for c in self.touching]

    def awake_changed(self) -> None:
        """Keep the impulses between sleeping bodies: with a warm start a pile wakes calmly."""
        self.broad_phase.bounds = []
        self.cache = self.sleeping_cache | self.cache
        self.sleeping_cache = {pair: c for pair, c in self.cache.items() if c.a.asleep}


def pair_both_ways(a: Body, b: Body) -> set[tuple[int, int]]:
    """The pair by its ids, whichever comes first."""
    return {(a.id, b.id), (b.id, a.id)}
