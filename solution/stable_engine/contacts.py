"""Contacts: bodies do not pass through each other."""

from collections.abc import Callable
from math import hypot

from .body import Body
from .broad_phase import FAR, Bounds, BroadPhase
from .contact import Contact, collide, the_way_it_came
from .effect import Effect, WorldState
from .soft import SAME_DIRECTION, Pace, softness
from .sweep import NO_HIT, first_hit, moment_of_touch, stop_at_first_hit
from .validate import refuse

FREQUENCY = 0.24  # of a contact of two balls, per substep; against a static body it is doubled
DAMPING_RATIO = 10.0  # so high that overlap is pushed out without a bounce
STIFFENING = 0.07  # of a substep, per step
# lengths are in units of the world, see World.unit
RESTING_SPEED = 30.0  # 1/s, a slower impact does not bounce
SPECULATIVE_SPEED = 10.0  # 1/s, slower pairs get a contact before they touch
CORE = 0.5  # radii
CORNER_PASSES = 4  # of keeping cores out: put back from one static body, a ball may meet another
MAX_PUSH_SPEED = 300.0  # 1/s, overlap is pushed out no faster
TOUCHING = 1e-6  # bodies that are no further apart touch, but for what numbers are rounded to
REDETECT_DISTANCE = 1e-4  # contacts stay valid until a body has moved further

OnHit = Callable[[Body, Body, float], object]
OnPart = Callable[[Body, Body], object]


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
    it, with the speed (px/s) at which they came together. on_part(a, b) is called for each two that
    no longer touch. Both may add and remove bodies; what is removed does not part.

    Each stage solves contacts of two balls first: the last word is that of the static bodies.
    """

    rank = 3

    def __init__(self, on_hit: OnHit | None = None, on_part: OnPart | None = None) -> None:
        if on_hit is not None and not callable(on_hit):
            refuse("Contacts.on_hit", on_hit, "a function of two bodies and a speed, or None")
        if on_part is not None and not callable(on_part):
            refuse("Contacts.on_part", on_part, "a function of two bodies, or None")
        self.on_hit, self.on_part = on_hit, on_part
        self.hits: list[tuple[Body, Body, float]] = []  # of this step, where somebody asks
        self.parted: list[tuple[Body, Body]] = []  # in this step, where somebody asks
        self.touching: list[Contact] = []
        self.begun: list[Contact] = []  # those of touching that are new in this step
        self.changed = False  # whether contacts are new in this step, so that rows must be too
        self.lets_none_pass = False  # whether balls that touched on their way count: for Bounce
        self.friction_warms = False  # whether Friction warm starts both, in one pass
        self.last_dt = 0.0  # s, of the step before
        self.flown: dict[Body, float] = {}  # s, how long a ball flew before it was stopped
        self.broad_phase = BroadPhase()
        self.balls, self.statics = Group(moves_b=True), Group(moves_b=False)
        self.groups = [self.balls, self.statics]
        self.cache: dict[tuple[int, int], Contact] = {}
        self.sleeping_cache: dict[tuple[int, int], Contact] = {}
        self.ignored: set[tuple[int, int]] = set()
        self.pace = Pace(STIFFENING)
        self.h = 0.0  # s, the substep of the impulses that are kept

    def attach(self, world: WorldState) -> None:
        super().attach(world)
        self.touching_gap = TOUCHING * world.unit  # px
        self.max_push_speed = MAX_PUSH_SPEED * world.unit  # px/s
        self.begin_contact_hooks = world.hooks("begin_contact")

    def detect(self, h: float) -> None:
        bodies = self.world.bodies
        is_new = len(self.broad_phase.bounds) < len(bodies)
        self.changed = is_new or self.any_moved()
        self.begun = []
        if is_new:
            self.broad_phase.take(bodies)
        if self.changed:
            self.touching = self.find_contacts(h * self.world.substep_count)

    def any_moved(self) -> bool:
        """Return whether any body is no longer where contacts were last found."""
        far = REDETECT_DISTANCE * self.world.unit
        for last in self.broad_phase.bounds:
            body = last.body
            if abs(body.x - last.x) + abs(body.y - last.y) > far:
                return True
        return False

    def find_contacts(self, dt: float) -> list[Contact]:
        """Return the contacts of all bodies where they are now, with the impulses they had before.

        Bodies that touch are in contact. So are slow ones that may touch within dt seconds: such
        a speculative contact lets them close the gap and no more. Fast ones may still miss each
        other, so they get none.
        """
        slow, touching, push = (
            SPECULATIVE_SPEED * self.world.unit,
            self.touching_gap,
            self.max_push_speed,
        )
        margin = slow * dt
        cache, found, deep = self.cache, {}, []
        pairs = self.broad_phase.near_pairs(self.world.awake, margin)
        any_fast = bool(self.broad_phase.fast)
        for a, b in pairs:
            nx, ny, gap = collide(a, b)
            if (
                gap > touching
                and (gap > margin or hypot(b.vx - a.vx, b.vy - a.vy) > slow)
                and not (any_fast and self.have_passed(a, b, gap))
            ):
                continue
            pair = a.id, b.id
            c = cache.get(pair)
            if c is None:
                if pair in self.ignored:
                    continue
                c = self.new_contact(a, b)
                self.begun.append(c)
                if self.on_hit:
                    c.nx, c.ny = nx, ny
                    self.hits.append((a, b, max(c.closing_speed(), 0.0)))
            else:
                nx, ny, gap = the_way_it_came(c, nx, ny, gap)
                if nx * c.nx + ny * c.ny < SAME_DIRECTION:
                    c.jn = c.jt = 0.0
            c.nx, c.ny, c.gap, c.found, c.push = nx, ny, gap, gap, push
            found[pair] = c
            if gap < -a.r or gap < -b.r < 0:
                deep.append(c)
        if self.on_part:
            gone = [pair for pair in cache if pair not in found and pair not in self.sleeping_cache]
            self.parted += [(cache[pair].a, cache[pair].b) for pair in gone]
        self.cache = found
        if len(deep) > 1:
            share_push(deep, push)
        return list(found.values())

    def have_passed(self, a: Body, b: Body, gap: float) -> bool:
        """Return whether two free balls have touched on their way here, and are past each other."""
        if (abs(a.vx - b.vx) + abs(a.vy - b.vy)) * self.last_dt <= gap or not b.r:
            return False
        if a.joint_count or b.joint_count or self.was_stopped(a) or self.was_stopped(b):
            return False
        return moment_of_touch(a, b, self.flown.get(a, self.last_dt))[0] > 0

    def was_stopped(self, body: Body) -> bool:
        """Return whether a bullet met something static in the step before."""
        return body.is_bullet and body in self.flown

    def new_contact(self, a: Body, b: Body) -> Contact:
        """Return a contact, with what other effects need of it filled in."""
        c = Contact(a, b)
        for begin_contact in self.begin_contact_hooks:
            begin_contact(c)
        return c

    def ignore_pair(self, a: Body, b: Body) -> None:
        """Let A and B pass through each other: a joint may hold them overlapping."""
        self.ignored |= pair_both_ways(a, b)
        self.cache = {pair: c for pair, c in self.cache.items() if pair not in self.ignored}
        self.broad_phase.bounds = []

    def prepare(self, h: float) -> None:
        if h != self.h:
            self.keep_forces(h)
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

    def keep_forces(self, h: float) -> None:
        """Scale the kept impulses to a substep of h seconds, so that the forces stay the same."""
        if self.h > 0:
            for c in self.touching:
                c.jn *= h / self.h
                c.jt *= h / self.h
        self.h = h

    def warm_start(self, h: float) -> None:
        if self.friction_warms:
            return
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
                a, b = c.a, c.b
                nx, ny, mn = c.nx, c.ny, c.mn
                gap = (b.x - a.x) * nx + (b.y - a.y) * ny - c.reach
                speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
                before = c.jn
                if gap > 0:
                    jn = before - mn * (speed + gap / h)
                else:
                    push = bias_rate * gap
                    if push < -c.push:
                        push = -c.push
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
                a, b = c.a, c.b
                nx, ny = c.nx, c.ny
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
        """Keep the core of a ball out of static bodies, however fast it is or hard it is pressed.

        Deep in a static body, a ball might leave it on the other side.

        The core is half as wide as the ball, so that one that slides is not held up at a seam.
        """
        self.flown, self.last_dt = {}, h * self.world.substep_count
        fast = []
        for last in self.broad_phase.bounds:
            body = last.body
            distance = abs(body.x - last.x) + abs(body.y - last.y)
            if distance > FAR * body.hx:
                fast.append((last, last.x, last.y))
                if distance > body.r:
                    self.stop_core(last, h)
        self.broad_phase.fast = fast if self.lets_none_pass else []
        for _ in range(CORNER_PASSES):
            put_back = []
            for c in self.statics.contacts:
                a, b = c.a, c.b
                gap = (b.x - a.x) * c.nx + (b.y - a.y) * c.ny - c.reach + c.found - c.gap
                if gap < -CORE * a.r and self.let_no_deeper(c, gap):
                    put_back.append(a)
            if not put_back:
                break
            for last in self.broad_phase.bounds:
                if last.body in put_back:
                    self.stop_core(last, h)

    def stop_core(self, last: Bounds, h: float) -> None:
        """Stop a ball that has gone further than its radius where its core met a static body."""
        body = last.body
        distance = abs(body.x - last.x) + abs(body.y - last.y)
        if distance > body.r > 0 and not (body.is_bullet or body.is_static):
            self.sweep(body, (last.x, last.y), CORE * body.r, 0.0, h)

    def let_no_deeper(self, c: Contact, gap: float) -> bool:
        """Put a ball back whose core got into a static body, or deeper than it was, and stop it.

        Returns whether it did. gap is along the normal with which the step began. Another one
        counts where the ball has gone round a corner since, but not where it has gone through.
        """
        a, b = c.a, c.b
        nx, ny, now = the_way_it_came(c, *collide(a, b))
        if nx * c.nx + ny * c.ny < SAME_DIRECTION and self.went_through(c):
            nx, ny, now = c.nx, c.ny, gap
        back = min(c.found, -CORE * a.r) - now
        if back <= self.touching_gap:
            return False
        a.x -= nx * back
        a.y -= ny * back
        closing = max((a.vx - b.vx) * nx + (a.vy - b.vy) * ny, 0.0)
        a.vx -= nx * closing
        a.vy -= ny * closing
        return True

    def went_through(self, c: Contact) -> bool:
        """Return whether the centre of a ball was in a static body in this step, at its start or
        later.
        """
        if c.found < -c.a.r:
            return True
        for last in self.broad_phase.bounds:
            if last.body is c.a:
                way = c.a.x - last.x, c.a.y - last.y
                return first_hit([c.b], 0.0, last.x, last.y, *way) < NO_HIT
        return False

    def tell(self, h: float) -> None:
        """Tell of hits and partings, those whose bodies are still there."""
        if self.hits and self.on_hit:
            hits, self.hits = self.hits, []
            for a, b, speed in hits:
                if a.world is b.world is self.world:
                    self.on_hit(a, b, speed)
        if self.parted and self.on_part:
            parted, self.parted = self.parted, []
            for a, b in parted:
                if a.world is b.world is self.world:
                    self.on_part(a, b)

    def sweep(
        self, body: Body, start: tuple[float, float], radius: float, overlap: float, h: float
    ) -> None:
        """Stop a ball at the first static body on its way from start that it does not pass through.

        See stop_at_first_hit.
        """
        statics = self.world.statics
        if self.ignored:
            statics = [s for s in statics if (body.id, s.id) not in self.ignored]
        fraction = stop_at_first_hit(body, start, radius, overlap, statics, self.world.g, h)
        if fraction < 1:
            self.flown[body] = fraction * h * self.world.substep_count

    def of_body(self, body: Body) -> list[Contact]:
        """Return the contacts of a body, those it sleeps with among them."""
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

    def lighter(self, body: Body, share: float) -> None:
        """Lower the impulses of the balls that carry it, by what their load loses.

        They begin the next step with the impulses of this one, and would be thrown up.
        """
        contacts = [*self.cache.values(), *self.sleeping_cache.values()]
        balls = in_touch(body, contacts)
        mass = sum([ball.m for ball in balls])
        left = 0.0 if body.is_static else (mass - body.m * (1 - share)) / mass
        for c in contacts:
            if c.a in balls:
                c.jn *= left
                c.jt *= left

    def static_moved(self, body: Body) -> None:
        """Wake the bodies that sleep on it or touch it now."""
        world = self.world
        if len(world.awake) + len(world.statics) < len(world.bodies):
            for c in self.of_body(body):
                c.a.wake()
            for other in world.bodies:
                dx, dy = abs(other.x - body.x), abs(other.y - body.y)
                if other.sleeps and dx < other.hx + body.hx and dy < other.hy + body.hy:
                    other.wake()

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
        self.sleeping_cache = {pair: c for pair, c in self.cache.items() if c.a.sleeps}
        self.pace.awake_changed(bool(self.sleeping_cache))


def in_touch(body: Body, contacts: list[Contact]) -> set[Body]:
    """Return the balls that touch a body, directly or through others; statics end the search."""
    beside: dict[Body, list[Body]] = {}
    for c in contacts:
        beside.setdefault(c.a, []).append(c.b)
        beside.setdefault(c.b, []).append(c.a)
    found, ahead = {body}, [body]
    while ahead:
        near = [b for b in beside.get(ahead.pop(), []) if b not in found and not b.is_static]
        found.update(near)
        ahead += near
    return found


def share_push(deep: list[Contact], push: float) -> None:
    """Push the slower, the more of these contacts a ball has: those with a centre in the other.

    Many balls in one place cannot part along all normals at once. Each would be pushed by all.
    """
    crowd: dict[Body, int] = {}
    for c in deep:
        for body in (c.a, c.b):
            crowd[body] = crowd.get(body, 0) + 1
    for c in deep:
        if not c.b.is_static:
            c.push = push / max(crowd[c.a], crowd[c.b])


def pair_both_ways(a: Body, b: Body) -> set[tuple[int, int]]:
    """Return the pair by its ids, whichever comes first."""
    return {(a.id, b.id), (b.id, a.id)}
