"""Contacts: bodies do not pass through each other."""

from math import hypot, inf, sqrt

from .body import Body, State, state_of
from .contact import Contact, collide, the_way_it_came
from .detection import REDETECT_DISTANCE, Detection, OnHit, OnPart, pair_number
from .effect import Direction
from .joint import Joint
from .loads import (
    BEARING,
    DEEP,
    HEAVY,
    LEANING,
    SUNK,
    TALL,
    TIED,
    TURNING,
    Pile,
    Stage,
    find_piles,
    find_towers,
    find_wedged,
    take_off,
)
from .order import PLACE, Group, give_places, in_same_place, put_in_order
from .rods import Frame
from .soft import SAME_DIRECTION, Pace, softness
from .springs import Springs
from .sweep import NO_HIT, first_hit, put_back

FREQUENCY = 0.24  # of a contact of two balls, per substep; against a static body it is doubled
LEAST_DAMPING = 10.0  # ratio, so high that overlap is pushed out without a bounce
SUBSTEP_DAMPING = 2.5  # ratio, per substep of a step: see Contacts.prepare
STIFFENING = 0.07  # of a substep, per step
# lengths are in units of the world, see World.unit
RESTING_SPEED = 30.0  # 1/s, a slower impact does not bounce
CORE = 0.5  # radii
SEAM = 1e-9  # a squared sine; faces that turn less are one
CORNER_PASSES = 4  # of keeping cores out: a ball put back may meet another static body
MAX_PUSH_SPEED = 300.0  # 1/s, overlap is pushed out no faster
CROWDED = 0.1  # radii, by which balls that bear a load overlap in a crowd
PARTED = 0.3  # share of an overlap that a step takes from balls in a crowd


class Contacts(Detection):
    """Contacts found once per step and solved in every substep as soft constraints.

    on_hit(a, b, speed) is called at the end of a step for each pair that began to touch in it, with
    the speed (px/s) at which the two met. on_part(a, b) is called for each pair that no longer
    touches. `a` is a ball with mass, `b` any body. Both functions may add and remove
    bodies, and can be set later on. Bodies that are removed do not part.

    Each stage solves contacts of static bodies last, so that these hold best. Where passes would
    leave much, all that balls connect is then solved together, see Pile: where a body is more than
    2.5 times as heavy as a ball that it touches, or kinematic, in a narrow or flat V, in a tall
    tower, where balls on rods land or overlap, and where balls were thrown at each other.
    """

    __slots__ = (
        *("beginnings", "has_friction", "is_mirrored", "max_push_speed", "pace", "piles", "round"),
        *("springs", "stage"),
    )
    rank = 3

    def __init__(self, on_hit: OnHit | None = None, on_part: OnPart | None = None) -> None:
        super().__init__(on_hit, on_part)
        self.round: list[Contact] = []  # those of two round bodies
        self.beginnings = 0.0  # in how many steps any contact has begun
        self.is_mirrored = False  # whether contacts may have the same place in the order
        self.piles: list[Pile] = []  # with heavy bodies
        self.stage = Stage(0.0, 0.0, 0.0)  # of the substep, if there are piles
        self.pace = Pace(STIFFENING)

    def attach(self) -> None:
        super().attach()
        self.max_push_speed = MAX_PUSH_SPEED * self.world.unit  # px/s
        self.has_friction = "Friction" in self.world.effects
        springs = self.world.effects.get("Springs")
        self.springs = springs if isinstance(springs, Springs) else None

    def prepare(self, h: float) -> None:
        """Set the stiffness of contacts by the substep, their damping by the number of substeps.

        Balls may overlap by their motion in a step, however short its substeps are. Damping slows
        the push out of that overlap: a push within a few substeps would give a pile energy, and
        more the shorter they are.
        """
        if h != self.h:
            self.keep_forces(h)
        hertz = FREQUENCY / self.pace.follow(h)
        damping = max(LEAST_DAMPING, SUBSTEP_DAMPING * self.world.substep_count)
        for group in self.groups:
            rate = hertz if group.moves_b else 2 * hertz
            group.bias_rate, group.mass_scale = softness(rate, damping, h)
        if not self.changed:
            return
        if self.crowd:
            self.gather_crowd()
        self.find_order()
        self.round = [*self.balls.contacts, *[c for c in self.statics.contacts if c.b.r]]
        is_heavy = is_deep = is_tall = False
        gx, gy = self.world.g
        weight = hypot(gx, gy) * h  # px/s, of 1 kg in a substep
        tall = inf  # px/s, by mass; a contact that bears more is left to towers
        if weight and self.balls.contacts:
            sinks = (1 - self.balls.mass_scale) / self.balls.bias_rate  # px by px/s, if it is not
            tall = max(TALL * weight, SUNK * self.world.unit / sinks)
        for c in self.touching:
            a, b, nx, ny = c.a, c.b, c.nx, c.ny
            distance = (b.x - a.x) * nx + (b.y - a.y) * ny
            c.reach = distance - c.gap
            c.set_arms(distance - a.r - b.r)
            is_heavy = is_heavy or c.ratio > HEAVY
            if c.jn > tall * c.mn:
                is_upright = abs(nx * gy - ny * gx) * h < LEANING * weight
                is_tall = is_tall or (is_upright and a.touches <= 2 and b.touches <= 2)
            else:
                is_deep = is_deep or c.gap < -DEEP * (a.r + b.r)
        for pile in self.piles:
            pile.end()
        tied = self.find_tied(h) if self.on_rods else set()
        self.piles = self.find_piles(is_heavy, is_deep, tied)
        if is_tall:
            self.piles += find_towers(self.touching, self.piles, tall, weight, self.world.unit)

    def find_tied(self, h: float) -> set[Contact]:
        """Return the contacts that may work against rods: they land, overlap, or rods turn fast."""
        tied: set[Contact] = set()
        turning = self.rods.find_turning(TURNING / h) if self.rods else set()
        for pair in self.on_rods:
            c, a, b = pair.contact, pair.a, pair.b
            if c:
                ahead = c.gap - max(c.closing_speed(), 0.0) * h * self.world.substep_count
                if ahead < -TIED * (a.r + b.r) or a in turning or b in turning:
                    tied.add(c)
        return tied

    def find_piles(self, is_heavy: bool, is_deep: bool, tied: set[Contact]) -> list[Pile]:
        """Return the piles with heavy loads: is_heavy tells whether any two masses differ much.

        is_deep tells whether any two balls overlap deep, and `tied` are contacts that may work
        against rods.
        """
        rods = self.rods
        pull = hypot(*self.world.g)
        loads = find_wedged(self.statics.contacts)  # kg, that press beside the bodies' own masses
        for body, (fx, fy, _) in self.world.forces.items() if pull else []:
            if hypot(fx, fy) > HEAVY * body.m * pull:
                loads[body] = hypot(fx, fy) / pull
        is_heavy = is_heavy or bool(loads or tied)
        frames: list[Frame] = []
        if rods and (is_heavy or is_deep or rods.any_heavy()):
            is_heavy, frames = True, rods.frames
            for frame in frames:
                loads.update(dict.fromkeys(frame.ends, frame.load))
        if not (is_heavy or is_deep):
            return []
        links: list[Joint] = [rod for frame in frames for rod in frame.rods]
        return find_piles(self.touching, links, loads, tied, self.world.unit)

    def find_order(self) -> None:
        """Find the contacts solved in turn, with their order, and those solved at once.

        The order depends on where contacts began alone, and looks the same in a mirror.
        """
        if self.begun:
            self.beginnings += 1
            g, grain = self.world.g, self.touching_gap
            if give_places(self.begun, g, grain, self.beginnings):
                self.is_mirrored = True
        was_mirrored = self.is_mirrored
        self.is_mirrored = any(
            [put_in_order(each, self.touching_gap, was_mirrored) for each in self.groups]
        )

    def keep_forces(self, h: float) -> None:
        """Scale the kept impulses to a substep of h seconds, so that the forces stay the same."""
        if self.h > 0:
            for c in self.touching:
                c.jn *= h / self.h
                c.jt *= h / self.h
                c.last *= h / self.h
        self.h = h

    def warm_start(self, h: float) -> None:
        """Apply both impulses of each contact: one pass costs less than one for each."""
        for pile in self.piles:
            pile.forget_impacts()
        for group in self.groups:
            moves_b = group.moves_b
            for c in group.contacts:
                a, b, jn, jt = c.a, c.b, c.jn, c.jt
                jx, jy = c.nx * jn - c.ny * jt, c.ny * jn + c.nx * jt
                a.vx -= jx * a.inv_mass
                a.vy -= jy * a.inv_mass
                if moves_b:
                    b.vx += jx * b.inv_mass
                    b.vy += jy * b.inv_mass
                if jt:
                    a.w -= c.arm_a * a.inv_inertia * jt
                    b.w -= c.arm_b * b.inv_inertia * jt

    def solve(self, h: float) -> None:
        for pile in self.piles:
            pile.look(h)
        for group in self.groups:
            self.push(group, group.in_turn, h)
            for tie in group.ties:
                tie.solve(self.push, group, h)
        if self.piles:
            stage = self.stage = Stage(h, self.max_push_speed, self.touching_gap / 2)
            stage.has_moved = False
            stage.ball_rate, stage.static_rate = self.balls.bias_rate, self.statics.bias_rate
            self.settle()

    def settle(self) -> None:
        """Solve piles for what passes have left. Friction calls this again after its own pass."""
        for pile in self.piles:
            pile.settle(self.stage)

    def push(self, group: Group, contacts: list[Contact], h: float) -> None:
        """Push overlapping bodies apart, and stop those that would overlap after the move."""
        most = -self.max_push_speed
        least = self.touching_gap / 2  # px and px/s; at 0, rounding would decide
        moves_b, bias_rate, mass_scale = group.moves_b, group.bias_rate, group.mass_scale
        for c in contacts:
            a, b = c.a, c.b
            nx, ny, mn = c.nx, c.ny, c.mn
            gap = (b.x - a.x) * nx + (b.y - a.y) * ny - c.reach
            speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
            before = c.jn
            if gap > least:
                jn = before - mn * (speed + gap / h)
            else:
                push = bias_rate * gap
                if push < most:
                    push = most
                jn = mass_scale * (before - mn * speed) - mn * push
            if jn < mn * least:
                jn = 0.0
            c.jn = jn
            jn -= before
            change = jn * a.inv_mass
            a.vx -= nx * change
            a.vy -= ny * change
            if moves_b:
                change = jn * b.inv_mass
                b.vx += nx * change
                b.vy += ny * change

    def relax(self, h: float) -> None:
        if self.changed:
            self.turn_normals()
        for group in self.groups:
            self.stop(group, group.in_turn, h)
            for tie in group.ties:
                tie.solve(self.stop, group, h)
        if self.piles:
            self.stage = Stage(h, self.max_push_speed, self.touching_gap / 2)
            for pile in self.piles:
                if pile.rods or not self.has_friction:  # else friction will settle it
                    pile.settle(self.stage)

    def turn_normals(self) -> None:
        """Take over the normals of round bodies after the move, or their spin would not be kept.

        Balls that have passed each other drop their impulses: taken back from behind, these would
        add energy. From a static body, a ball leaves the way it came.
        """
        for c in self.round:
            a, b = c.a, c.b
            dx, dy = b.x - a.x, b.y - a.y
            distance = sqrt(dx * dx + dy * dy)
            if distance > 0:
                nx, ny = dx / distance, dy / distance
                same = nx * c.nx + ny * c.ny
                if b.inv_mass == 0 and same < SAME_DIRECTION:
                    continue
                if same < 0:
                    c.jn = c.jt = 0.0
                c.nx, c.ny = nx, ny
                c.set_arms(distance - a.r - b.r)

    def stop(self, group: Group, contacts: list[Contact], h: float) -> None:
        """Stop bodies that still come together, and take back the speed of a push."""
        moves_b = group.moves_b
        for c in contacts:
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
            change = jn * a.inv_mass
            a.vx -= nx * change
            a.vy -= ny * change
            if moves_b:
                change = jn * b.inv_mass
                b.vx += nx * change
                b.vy += ny * change

    def finish(self, h: float) -> None:
        """Keep the core of a ball out of static bodies, however fast or hard pressed it is.

        From deep in a static body, a ball might leave on the other side.

        The core is half as wide as the ball, so that a sliding ball does not catch on a seam.
        """
        if self.crowd:
            self.part_crowd(h * self.world.substep_count)
        self.begun, self.changed = [], False
        self.last_dt = h * self.world.substep_count
        for body in self.flying:
            body.flown = inf
        for body, ago in self.hit_ago.items():
            body.flown = ago + self.last_dt
        self.flying, self.hit_ago = [*self.hit_ago], {}
        self.stopped = {}
        self.ends = {}
        for one in self.broad_phase.find_leavers(self.last_dt):
            if self.world.statics:
                if not one.near:
                    one.find_start(self.last_dt)
                self.stop_core(one.body, h)
        for body in self.beside_static:
            self.stop_core(body, h)
        for _ in range(CORNER_PASSES if self.statics.contacts else 0):
            ways: dict[Body, list[State]] = {}
            for c in self.statics.contacts:
                a, b = c.a, c.b
                gap = (b.x - a.x) * c.nx + (b.y - a.y) * c.ny - c.reach + c.found - c.gap
                if gap < -CORE * a.r:
                    self.find_way_out(c, gap, ways)
            if not ways:
                break
            for body, ways_out in ways.items():
                self.put_out(body, ways_out)
                self.stop_core(body, h)

    def press(self, h: float) -> None:
        """Mark bodies that contacts hold: by more than rounding, or the weight of a falling pair.

        Those that have bounced off are free.
        """
        least = self.touching_gap / h + BEARING * hypot(*self.world.g) * h  # px/s
        for c in self.touching:
            if c.jn > least * c.mn and c.closing_speed() > -self.slow:
                c.a.is_pressed = c.b.is_pressed = True

    def gather_crowd(self) -> None:
        """Make balls in a crowd just touch. Balls that they are moved against join the crowd."""
        members = {body for c in self.crowd for body in (c.a, c.b)}
        for c in self.begun:
            met = not (c.b.is_static or members.isdisjoint((c.a, c.b)))
            if met and c.closing_speed() <= self.slow:
                self.crowd[c] = None
        self.crowd = {c: None for c in self.touching if c in self.crowd and is_crowded(c)}
        for c in self.crowd:
            c.gap = max(c.gap, self.touching_gap)

    def part_crowd(self, dt: float) -> None:
        """Separate balls whose centre was in another ball, and balls that they meet by that.

        They are moved and get no speed: impulses between many balls at one position would leave
        some speed, which is energy from nothing. So they turn about each other more slowly.
        """
        deepest = 0.0
        for same in in_same_place(sorted(self.crowd, key=PLACE)):
            for c, (nx, ny, gap) in [(c, collide(c.a, c.b)) for c in same]:
                a, b = c.a, c.b
                deepest = max(deepest, -gap)
                way = min(max(-PARTED * gap, 0.0), self.max_push_speed * dt)
                slip = (b.vy - a.vy) * nx - (b.vx - a.vx) * ny
                slower = 0.0 if c.e else -slip * way / (gap + a.r + b.r + way)
                dx, dy = nx * way * c.mn, ny * way * c.mn
                dvx, dvy = -ny * slower * c.mn, nx * slower * c.mn
                a.x, a.y = a.x - dx * a.inv_mass, a.y - dy * a.inv_mass
                b.x, b.y = b.x + dx * b.inv_mass, b.y + dy * b.inv_mass
                a.vx, a.vy = a.vx - dvx * a.inv_mass, a.vy - dvy * a.inv_mass
                b.vx, b.vy = b.vx + dvx * b.inv_mass, b.vy + dvy * b.inv_mass
                a.still = b.still = 0.0
        if deepest < REDETECT_DISTANCE * self.world.unit:
            self.crowd = {}

    def stop_core(self, body: Body, h: float) -> None:
        """Stop a ball that moved far, or was hit, where its core met a static body."""
        distance = abs(body.x - body.last_x) + abs(body.y - body.last_y)
        is_far = distance > body.r > 0 or (distance > 0 and body.flown < inf)
        if is_far and not (body.is_bullet or body.is_static):
            self.sweep(body, (body.last_x, body.last_y), CORE * body.r, 0.0, h)

    def find_way_out(self, c: Contact, gap: float, ways: dict[Body, list[State]]) -> None:
        """Note what puts back and stops a ball whose core entered a static body, or went deeper.

        `gap` is along the normal at the start of the step; past a corner the new normal counts,
        unless the ball went through the body.
        """
        a, b = c.a, c.b
        nx, ny, now = the_way_it_came(c, *collide(a, b))
        if nx * c.nx + ny * c.ny < SAME_DIRECTION and self.went_through(c):
            nx, ny, now = c.nx, c.ny, gap
        back = min(c.found, -CORE * a.r) - now
        if back > self.touching_gap:
            closing = max((a.vx - b.vx) * nx + (a.vy - b.vy) * ny, 0.0)
            ways.setdefault(a, []).append((back, closing, nx, ny))

    def put_out(self, body: Body, ways: list[State]) -> None:
        """Put a ball out along the two longest of these ways at once: in a V, neither is first."""
        back, closing, nx, ny = max(ways)
        ways.remove((back, closing, nx, ny))
        if ways:
            back_2, closing_2, x, y = max(ways)
            back, back_2 = parts(back, back_2, nx * x + ny * y)
            closing, closing_2 = parts(closing, closing_2, nx * x + ny * y)
            push(body, x, y, back_2, closing_2)
        push(body, nx, ny, back, closing)

    def went_through(self, c: Contact) -> bool:
        """Return whether the centre of a ball was in a static body at any time in this step."""
        if c.found < -c.a.r:
            return True
        a = c.a
        way = a.x - a.last_x, a.y - a.last_y
        return first_hit([c.b], 0.0, a.last_x, a.last_y, *way) < NO_HIT

    def sweep(
        self, body: Body, start: tuple[float, float], radius: float, overlap: float, h: float
    ) -> None:
        """Stop a ball of this radius at the first static body on its way from `start`, if any.

        There it overlaps by `overlap` px: the next step finds the contact and resolves the impact.
        """
        statics = self.world.statics
        if self.ignored:
            statics = [s for s in statics if pair_number(body, s) not in self.ignored]
        x, y = start
        dx, dy = body.x - x, body.y - y
        # a little smaller, or rounding would decide whether a ball that slides along is stopped
        fraction = first_hit(statics, radius - self.touching_gap, x, y, dx, dy)
        if fraction < NO_HIT:
            fraction = min(fraction, first_hit(statics, radius, x, y, dx, dy))
            fraction += overlap / hypot(dx, dy)
        if fraction < 1:
            end = state_of(body)
            put_back(body, (dx, dy), fraction, self.pull, h)
            if not body.is_bullet:
                self.ends[body] = state_of(body), self.ends.get(body, (end, end))[1]
            before = self.stopped.get(body, self.last_dt)
            self.stopped[body] = fraction * before
            flown = body.flown if body.flown < inf else self.last_dt
            body.flown = flown - (1 - fraction) * before
            self.flying.append(body)

    def pull(self, body: Body) -> tuple[float, float]:
        """Return the acceleration of a body (px/s²) by gravity, forces and soft springs."""
        x, y = self.world.acceleration(body)
        if self.springs and body.joint_count:
            by_x, by_y = self.springs.pull(body, self.h)
            x, y = x + by_x, y + by_y
        return x, y

    def unload(self, lost: dict[Body, float], direction: Direction) -> None:
        """Lower the kept impulses under bodies that press less.

        The next step begins with these; unchanged, they would throw balls up.
        """
        impulses = {body: force * self.h for body, force in lost.items()}
        take_off(self.all_contacts(), impulses, direction)

    def awake_changed(self) -> None:
        super().awake_changed()
        self.pace.awake_changed(any([c.a.sleeps for c in self.all_contacts()]))


def push(body: Body, nx: float, ny: float, back: float, closing: float) -> None:
    """Move a ball back (px) along a normal, and take a speed (px/s) along it away."""
    body.x -= nx * back
    body.y -= ny * back
    body.vx -= nx * closing
    body.vy -= ny * closing


def parts(one: float, other: float, cosine: float) -> tuple[float, float]:
    """Return the lengths along two directions that together reach as far along both as asked."""
    rest = 1 - cosine * cosine
    if one <= cosine * other or rest < SEAM:
        return (0.0, other) if other > one else (one, 0.0)
    if other <= cosine * one:
        return one, 0.0
    return (one - cosine * other) / rest, (other - cosine * one) / rest


def is_crowded(c: Contact) -> bool:
    """Return whether two balls still overlap much, or a little without a load."""
    return c.jn == 0 or c.gap < -CROWDED * min(c.a.r, c.b.r)
