"""Contacts: bodies do not pass through each other."""

from collections.abc import Callable
from math import hypot, inf, sqrt

from .body import Body, State, state_of
from .broad_phase import BroadPhase, Pair
from .contact import Contact, collide, the_way_it_came
from .effect import Direction, Effect
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
from .rods import Frame, Rods
from .soft import SAME_DIRECTION, Pace, softness
from .springs import Springs
from .sweep import NO_HIT, first_hit, hit_body, moment_of_touch, put_back
from .validate import refuse

FREQUENCY = 0.24  # of a contact of two balls, per substep; against a static body it is doubled
LEAST_DAMPING = 10.0  # ratio, so high that overlap is pushed out without a bounce
SUBSTEP_DAMPING = 2.5  # ratio, per substep of a step: see Contacts.prepare
STIFFENING = 0.07  # of a substep, per step
# lengths are in units of the world, see World.unit
RESTING_SPEED = 30.0  # 1/s, a slower impact does not bounce
SPECULATIVE_SPEED = 10.0  # 1/s, slower pairs get a contact before they touch
CORE = 0.5  # radii
FAR = 0.125  # of both radii; balls that approach by more in a step may have passed each other
SEAM = 1e-9  # a squared sine; faces that turn less are one
CORNER_PASSES = 4  # of keeping cores out: a ball put back may meet another static body
MAX_PUSH_SPEED = 300.0  # 1/s, overlap is pushed out no faster
CROWDED = 0.1  # radii, by which balls that bear a load overlap in a crowd
PARTED = 0.3  # share of an overlap that a step takes from balls in a crowd
TOUCHING = 1e-6  # a gap that counts as touching: rounding
MOST_BODIES = 2**29  # and no id is larger
REDETECT_DISTANCE = 1e-4  # contacts stay valid until a body moves further

OnHit = Callable[[Body, Body, float], object]
OnPart = Callable[[Body, Body], object]


class Contacts(Effect):
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
        *("on_hit", "on_part", "hits", "parted", "touching", "begun", "changed", "lets_none_pass"),
        *("last_dt", "flying", "hit_ago", "stopped", "broad_phase", "crowd"),
        *("beside_static", "early", "ends", "on_rods", "round", "springs", "rods"),
        *("balls", "statics", "groups", "beginnings", "is_mirrored", "unpaired", "ignored", "pace"),
        *("h", "touching_gap", "slow", "max_push_speed", "begin_contact_hooks", "piles", "stage"),
        "has_friction",
    )
    rank = 3

    def __init__(self, on_hit: OnHit | None = None, on_part: OnPart | None = None) -> None:
        if on_hit is not None and not callable(on_hit):
            refuse("Contacts.on_hit", on_hit, "a function of two bodies and a speed, or None")
        if on_part is not None and not callable(on_part):
            refuse("Contacts.on_part", on_part, "a function of two bodies, or None")
        self.on_hit, self.on_part = on_hit, on_part
        self.hits: list[tuple[Body, Body, float]] = []  # of this step, if on_hit is set
        self.parted: list[tuple[Body, Body]] = []  # in this step, if on_part is set
        self.touching: list[Contact] = []
        self.begun: list[Contact] = []  # contacts that are new in this step
        self.changed = False  # whether contacts are new, so that their rows must be renewed
        self.lets_none_pass = False  # for Bounce: whether balls that touched and passed on count
        self.last_dt = 0.0  # s, of the step that ends; 0 once its impacts are resolved
        self.flying: list[Body] = []  # balls that were hit in the step before, or stopped
        self.hit_ago: dict[Body, float] = {}  # s, since the last impact of a ball in this step
        self.stopped: dict[Body, float] = {}  # s, into the step, until a static body stopped it
        # of a stopped ball: where it is, and where it would be
        self.ends: dict[Body, tuple[State, State]] = {}
        self.broad_phase = BroadPhase()
        self.crowd: dict[Contact, None] = {}  # of balls that part_crowd separates
        # contacts of balls on rods that will touch: the speeds (px/s) at which they will meet
        self.early: dict[Contact, float] = {}
        self.on_rods: list[Pair] = []  # near pairs with a ball on rods, or on springs beside these
        self.beside_static: dict[Body, None] = {}  # balls that are near static bodies
        self.balls, self.statics = Group(moves_b=True), Group(moves_b=False)
        self.groups: list[Group] = []  # of these two, those with any contact
        self.round: list[Contact] = []  # those of two round bodies
        self.beginnings = 0.0  # in how many steps any contact has begun
        self.is_mirrored = False  # whether contacts may have the same place in the order
        self.unpaired: dict[int, Contact] = {}  # of sleeping bodies, by their pair's number
        self.ignored: set[int] = set()  # numbers of pairs
        self.piles: list[Pile] = []  # with heavy bodies
        self.stage = Stage(0.0, 0.0, 0.0)  # of the substep, if there are piles
        self.pace = Pace(STIFFENING)
        self.h = 0.0  # s, the substep of the kept impulses

    def attach(self) -> None:
        self.touching_gap = TOUCHING * self.world.unit  # px
        self.slow = SPECULATIVE_SPEED * self.world.unit  # px/s
        self.max_push_speed = MAX_PUSH_SPEED * self.world.unit  # px/s
        self.begin_contact_hooks = self.world.hooks["begin_contact"]
        self.has_friction = "Friction" in self.world.effects
        springs = self.world.effects.get("Springs")
        self.springs = springs if isinstance(springs, Springs) else None
        rods = self.world.effects.get("Rods")
        self.rods = rods if isinstance(rods, Rods) else None

    def detect(self, h: float) -> None:
        world, phase, dt = self.world, self.broad_phase, h * self.world.substep_count
        if len(phase.bounds) != len(world.bodies):
            phase.take(world.bodies)
            rods = self.rods
            phase.tied = [one for one in phase.moving if rods.holds(one.body)] if rods else []
        renews = phase.is_stale or len(phase.leavers) > 0
        moved = renews or self.any_moved()
        if renews:
            self.renew_pairs(dt)
        if moved:
            self.changed = True
            for one in phase.near:
                body = one.body
                body.last_x, body.last_y = body.x, body.y
                body.touches = 0
            if self.early:
                self.end_early()
            self.find_contacts(dt)

    def any_moved(self) -> bool:
        """Return whether a body with others near has moved since contacts were last found."""
        far = REDETECT_DISTANCE * self.world.unit
        far2 = far * far
        self.broad_phase.list_near()
        for one in self.broad_phase.near:
            body = one.body
            dx, dy = body.x - body.last_x, body.y - body.last_y
            if dx * dx + dy * dy > far2:
                return True
        return False

    def renew_pairs(self, dt: float) -> None:
        """Find the near pairs that are new, and keep the contacts of bodies that still touch."""
        phase, g = self.broad_phase, self.world.g
        if phase.is_stale:  # all pairs are new
            self.beside_static, self.on_rods = {}, []
            for c in self.touching:
                self.unpaired[pair_number(c.a, c.b)] = c
        bearing = self.touching if g != (0.0, 0.0) else []
        held = {c.a for c in bearing} | {c.b for c in bearing}
        back = self.last_dt if self.lets_none_pass else 0.0
        found = phase.renew(g, held, dt, back, self.slow * dt)
        phase.list_near()
        self.take_in(found)
        touched = {c.a for c in self.unpaired.values()}
        for pair in found if touched else []:
            if pair.a in touched:
                pair.contact = self.unpaired.pop(pair_number(pair.a, pair.b), None)

    def take_in(self, found: list[Pair]) -> None:
        """Note new near pairs, and drop those to ignore."""
        phase = self.broad_phase
        if self.ignored:
            phase.pairs = [p for p in phase.pairs if pair_number(p.a, p.b) not in self.ignored]
        for pair in found:
            if pair.b.is_static:
                self.beside_static[pair.a] = None
        for pair in found if self.rods and self.rods.awake else []:
            a, b = pair.a, pair.b
            if (a.joint_count or b.joint_count) and pair_number(a, b) not in self.ignored:
                self.on_rods.append(pair)

    def find_contacts(self, dt: float) -> None:
        """Find the present contacts of all bodies, with the impulses they had before.

        Bodies that touch are in contact, and so are slow ones that may touch within dt seconds: a
        speculative contact lets them close the gap and no more. Fast ones get none, as they may
        still miss each other.
        """
        touching: list[Contact] = []
        balls: list[Contact] = []
        statics: list[Contact] = []
        slow, touching_gap = self.slow, self.touching_gap
        margin, slow2 = slow * dt, slow * slow
        back = self.last_dt if self.lets_none_pass else 0.0
        for pair in self.broad_phase.pairs:
            a, b = pair.a, pair.b
            if b.r:
                dx, dy, reach = b.x - a.x, b.y - a.y, a.r + b.r + margin
                if back:
                    dvx, dvy = b.vx - a.vx, b.vy - a.vy
                    reach += sqrt(dvx * dvx + dvy * dvy) * back
                if dx * dx + dy * dy > reach * reach:
                    if pair.contact:
                        self.end_contact(pair)
                    continue
            dvx, dvy = b.vx - a.vx, b.vy - a.vy
            nx, ny, gap = collide(a, b)
            if (
                gap > touching_gap
                and (
                    gap > margin
                    or (pair.contact and abs(dvx * nx + dvy * ny) > slow)
                    or (not pair.contact and dvx * dvx + dvy * dvy > slow2)
                )
                and not (back and self.have_passed(a, b, gap))
            ):
                if pair.contact:
                    self.end_contact(pair)
                continue
            c = pair.contact
            if c is None:
                c = pair.contact = self.make_contact(a, b, nx, ny)
            if not b.r:
                nx, ny, gap = the_way_it_came(c, nx, ny, gap)
            if nx * c.nx + ny * c.ny < SAME_DIRECTION:
                c.jn = c.jt = 0.0
            c.nx, c.ny, c.gap, c.found = nx, ny, gap, gap
            touching.append(c)
            if b.inv_mass:
                balls.append(c)
                a.touches += 1
                b.touches += 1
                if gap < -a.r or gap < -b.r:
                    self.crowd[c] = None
            else:
                statics.append(c)
        self.touching, self.balls.contacts, self.statics.contacts = touching, balls, statics
        was_idle = not self.groups
        self.groups = [group for group in (self.balls, self.statics) if group.contacts]
        if self.on_rods or self.early:
            self.foresee(dt)
        if (not self.groups) != was_idle:
            self.world.update_hooks()
        self.broad_phase.add_looks(len(self.broad_phase.pairs) - len(touching), dt)
        if self.unpaired:
            self.end_unpaired()

    def lands(self, a: Body, b: Body) -> bool:
        """Return whether one of these is on rods, and they will not bounce off each other."""
        if self.rods is None or (self.lets_none_pass and a.e and b.e):
            return False
        return self.rods.holds(a) or self.rods.holds(b)

    def foresee(self, dt: float) -> None:
        """Begin the contacts of balls on rods that will land on something in dt seconds.

        In an overlap, rods would work against the push out of it. So these contacts begin before
        their bodies meet, and it is noted at which speed (px/s) they will.
        """
        if self.early:
            self.early = {c: self.early[c] for c in self.touching if c in self.early}
        for pair in self.on_rods:
            a, b = pair.a, pair.b
            if pair.contact is None and self.lands(a, b):
                gx, gy = self.world.g if b.is_static else (0.0, 0.0)
                dx, dy = (a.vx - b.vx + gx * dt) * dt, (a.vy - b.vy + gy * dt) * dt
                nx, ny, gap = collide(a, b)
                is_near = gap > self.touching_gap and gap * gap < dx * dx + dy * dy
                if is_near and hit_body(b, a.r, a.x - b.x, a.y - b.y, dx, dy) < NO_HIT:
                    c = self.meet(pair, nx, ny, gap, is_early=True)
                    speed = c.closing_speed()
                    square = speed * speed + 2 * gap * (gx * nx + gy * ny)
                    self.early[c] = sqrt(max(square, 0.0))

    def end_early(self) -> None:
        """Note the hits of contacts that were foreseen, once their bodies press each other."""
        for c in [c for c in self.early if c.jn > 0 or c.last > 0]:
            speed = self.early.pop(c)
            if self.on_hit:
                self.hits.append((c.a, c.b, speed))

    def make_contact(
        self, a: Body, b: Body, nx: float, ny: float, is_early: bool = False
    ) -> Contact:
        """Return a new contact with this normal, filled in by the other effects."""
        c = Contact(a, b)
        c.nx, c.ny = nx, ny
        for begin_contact in self.begin_contact_hooks:
            begin_contact(c)
        self.begun.append(c)
        if (a.is_fresh or (b.inv_mass and b.is_fresh)) and c.closing_speed() > -self.slow:
            a.is_pressed = b.is_pressed = True
        if self.on_hit and not is_early:
            self.hits.append((a, b, self.meeting_speed(c)))
        return c

    def meeting_speed(self, c: Contact) -> float:
        """Return the speed (px/s) at which A and B came together when they began to touch."""
        a, b = c.a, c.b
        ago, nx, ny = moment_of_touch(a, b, self.flight_of(a, b))
        if ago == 0:
            return max(c.closing_speed(), 0.0)
        (gx, gy), falls = self.world.g, b.is_static and not a.joint_count
        since = self.h / 2 - ago if falls else 0.0  # s, as velocities lag half a substep behind
        return (a.vx - b.vx + gx * since) * nx + (a.vy - b.vy + gy * since) * ny

    def meet(self, pair: Pair, nx: float, ny: float, gap: float, is_early: bool = False) -> Contact:
        """Add the contact of two bodies that meet, beside those found, and wake them."""
        pair.a.wake()
        pair.b.wake()
        c = pair.contact = self.make_contact(pair.a, pair.b, nx, ny, is_early)
        c.gap = c.found = gap
        self.touching.append(c)
        group = self.balls if c.b.inv_mass else self.statics
        group.contacts = [*group.contacts, c]  # a new list, as its order is new
        if c.b.inv_mass:
            c.a.touches += 1
            c.b.touches += 1
        self.groups = [group for group in (self.balls, self.statics) if group.contacts]
        return c

    def end_contact(self, pair: Pair) -> None:
        """End the contact of two bodies that have parted."""
        c, pair.contact = pair.contact, None
        if self.on_part and c not in self.early:
            self.parted.append((pair.a, pair.b))

    def end_unpaired(self) -> None:
        """End the contacts of bodies that are no longer near each other, except sleeping ones.

        Those keep their impulses: with a warm start, a pile wakes calmly.
        """
        unpaired, self.unpaired = self.unpaired, {}
        for number, c in unpaired.items():
            if c.a.sleeps and c.b.idle:
                self.unpaired[number] = c
            elif c not in self.early and self.on_part:
                self.parted.append((c.a, c.b))

    def have_passed(self, a: Body, b: Body, gap: float) -> bool:
        """Return whether two free balls have touched on their way here and passed each other."""
        vx, vy = a.vx - b.vx, a.vy - b.vy
        seconds = self.flight_of(a, b)
        way = sqrt(vx * vx + vy * vy) * seconds
        if way <= gap or way <= FAR * (a.r + b.r) or not b.r:
            return False
        if a.joint_count or b.joint_count or self.was_stopped(a) or self.was_stopped(b):
            return False
        return moment_of_touch(a, b, seconds)[0] > 0

    def flight_of(self, a: Body, b: Body) -> float:
        """Return how long (s) two bodies have flown freely: a step, if none was hit or stopped."""
        least = min(a.flown, b.flown)
        return least if least < inf and self.last_dt else self.last_dt

    def note_impact(self, body: Body, ago: float) -> None:
        """Note that a ball was hit some seconds ago, and has flown freely since."""
        self.hit_ago[body] = body.flown = ago

    def was_stopped(self, body: Body) -> bool:
        """Return whether a bullet met something static in the step before."""
        return body.is_bullet and body in self.stopped

    def let_touch(self, a: Body, b: Body, may: bool) -> None:
        if may:
            self.ignored.discard(pair_number(a, b))
            self.broad_phase.bounds = []
        else:
            self.ignored.add(pair_number(a, b))
            self.drop(a, b)

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

    def tell(self, h: float) -> None:
        """Call on_hit and on_part, for bodies that are still in the world."""
        self.last_dt, self.ends = 0.0, {}  # impacts are over; a program may change anything now
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

    def all_contacts(self) -> list[Contact]:
        """Return all contacts, also those between sleeping bodies."""
        return list(dict.fromkeys([*self.touching, *self.unpaired.values()]))

    def of_body(self, body: Body) -> list[Contact]:
        """Return the contacts of a body, also while it sleeps."""
        return [c for c in self.all_contacts() if body in (c.a, c.b)]

    def wake_beside(self, body: Body) -> None:
        """Wake whatever touches a body."""
        for c in self.of_body(body):
            c.a.wake()
            c.b.wake()

    def body_changed(self, body: Body) -> None:
        """Fill in the body's contacts anew, and wake whatever touches it."""
        for c in self.of_body(body):
            c.weigh()
            for begin_contact in self.begin_contact_hooks:
                begin_contact(c)
        self.wake_beside(body)
        self.broad_phase.bounds = []

    def unload(self, lost: dict[Body, float], direction: Direction) -> None:
        """Lower the kept impulses under bodies that press less.

        The next step begins with these; unchanged, they would throw balls up.
        """
        impulses = {body: force * self.h for body, force in lost.items()}
        take_off(self.all_contacts(), impulses, direction)

    def body_moved(self, body: Body) -> None:
        """Look for near pairs anew. Nobody flew to where a program has put the body."""
        body.flown = inf
        gaps = [] if body.is_static else [collide(c.a, c.b)[2] for c in self.of_body(body)]
        if gaps and min(gaps) > self.touching_gap:
            self.world.relieve({body: inf})
        self.broad_phase.bounds = []

    def static_moved(self, body: Body) -> None:
        """Wake the bodies that sleep on a static body or touch it now."""
        world = self.world
        if len(world.awake) + len(world.statics) < len(world.bodies):
            self.wake_beside(body)
            for other in world.bodies:
                dx, dy = abs(other.x - body.x), abs(other.y - body.y)
                if other.sleeps and dx < other.hx + body.hx and dy < other.hy + body.hy:
                    other.wake()

    def forget(self, body: Body) -> None:
        """Wake whatever touches the body: it may have rested on it."""
        body.flown = inf
        self.flying = [other for other in self.flying if other is not body]
        self.hit_ago.pop(body, None)
        self.wake_beside(body)
        self.drop(body, body)

    def drop(self, a: Body, b: Body) -> None:
        """Drop all contacts of A and B, without a call of on_part."""
        ends = {a, b}
        for c in self.touching:
            c.a.is_pressed = c.b.is_pressed = False
        self.touching = [c for c in self.touching if not ends <= {c.a, c.b}]
        self.early = {c: v for c, v in self.early.items() if not ends <= {c.a, c.b}}
        self.unpaired = {n: c for n, c in self.unpaired.items() if not ends <= {c.a, c.b}}
        self.broad_phase.bounds = []

    def is_idle(self) -> bool:
        return not self.groups

    def is_used(self) -> bool:
        return len(self.world.bodies) > 1

    def links(self) -> list[tuple[Body, Body]]:
        return [(c.a, c.b) for c in self.touching]

    def awake_changed(self) -> None:
        self.broad_phase.bounds = []
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


def pair_number(a: Body, b: Body) -> int:
    """Return a number that only this pair of bodies has, whichever comes first."""
    return max(a.id, b.id) * MOST_BODIES + min(a.id, b.id)
