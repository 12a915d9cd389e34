"""Find contacts: which bodies touch, and since when (the near pairs are in broad_phase.py)."""

from collections.abc import Callable
from math import hypot, inf, sqrt

from .body import Body
from .bounds import Bounds, Pair, pair_number
from .broad_phase import BroadPhase
from .contact import RESTING_SPEED, Contact, collide, is_over_face, leave_as_entered
from .effect import Effect
from .events import Events
from .landings import Landings
from .order import Group
from .rods import Rods
from .soft import SAME_DIRECTION
from .springs import Springs, any_stiff
from .stop import Stop
from .sweep import covers, moment_of_touch, seen_before
from .validate import function

# lengths are in units of the world, see World.unit
SPECULATIVE_SPEED = 10.0  # 1/s, slower pairs get a contact before they touch
RESTING_STEPS = 3.7  # hits slower than gravity's speed after so many do not bounce
LEAST_SPEED = 0.001  # 1/s: the same without gravity
FAR = 0.125  # of both radii; balls that approach by more in a step may have passed each other
TOUCHING = 1e-6  # a gap that counts as touching: rounding
REDETECT_DISTANCE = 1e-4  # contacts stay valid until a body moves further

OnHit = Callable[[Body, Body, float], object]
OnPart = Callable[[Body, Body], object]


class Detection(Effect):
    """The part of Contacts that finds them, once per step, and tells the program of new ones."""

    __slots__ = (
        *("tells_hit", "tells_part", "events", "touching", "begun", "renewed", "changed"),
        *("lets_none_pass", "last_dt", "flying", "hit_ago", "stops"),
        *("broad_phase", "crowd", "beside_static", "landings", "rods", "balls", "statics"),
        *("groups", "unpaired", "ignored", "h", "touching_gap", "speculative_speed", "springs"),
        *("is_resting", "was_idle"),
    )

    def __init__(self, on_hit: OnHit | None = None, on_part: OnPart | None = None) -> None:
        self.on_hit, self.on_part = on_hit, on_part
        self.events = Events(self)
        self.touching: list[Contact] = []
        self.begun: list[Contact] = []  # contacts that are new in this step
        self.changed = False  # whether any contact was found anew, began or ended
        self.renewed: list[Contact] = []  # those found anew, whose rows must be renewed
        self.lets_none_pass = False  # for Bounce: whether balls that touched and passed on count
        self.last_dt = 0.0  # s, of the step that ends; 0 once its impacts are resolved
        self.h = 0.0  # s, the substep of the kept impulses
        self.flying: list[Body] = []  # balls that were hit in the step before, or stopped
        self.hit_ago: dict[Body, float] = {}  # s, since the last impact of a ball in this step
        self.stops: dict[Body, Stop] = {}  # of balls that static bodies stopped in this step
        self.broad_phase = BroadPhase()
        self.crowd: dict[Contact, bool] = {}  # of bodies that part_crowd separates
        self.beside_static: dict[Body, None] = {}  # balls that are near static bodies
        self.balls, self.statics = Group(moves_b=True), Group(moves_b=False)
        self.groups: list[Group] = []  # of these two, those with any contact
        self.unpaired: dict[int, Contact] = {}  # of sleeping bodies, by their pair's number
        self.ignored: set[int] = set()  # numbers of pairs
        self.is_resting = False  # while nobody is near, see Contacts.finish
        self.was_idle = True  # before contacts were found

    @property
    def on_hit(self) -> OnHit | None:
        """Return the function that is told of pairs that begin to touch. Set it at any time."""
        return self.tells_hit

    @on_hit.setter
    def on_hit(self, value: OnHit | None) -> None:
        self.tells_hit = function("Contacts.on_hit", value, "two bodies and a speed")

    @property
    def on_part(self) -> OnPart | None:
        """Return the function that is told of pairs that part. Set it at any time."""
        return self.tells_part

    @on_part.setter
    def on_part(self, value: OnPart | None) -> None:
        self.tells_part = function("Contacts.on_part", value, "two bodies")

    def attach(self) -> None:
        self.touching_gap = TOUCHING * self.world.unit  # px
        self.speculative_speed = SPECULATIVE_SPEED * self.world.unit  # px/s
        self.landings = Landings(self)
        self.rods, self.springs = self.world.find(Rods), self.world.find(Springs)

    def detect(self, h: float) -> None:
        world, phase, dt = self.world, self.broad_phase, h * self.world.substep_count
        self.was_idle = not self.groups
        self.is_resting = False
        if self.last_dt == 0:  # a program may have changed velocities
            phase.is_free = phase.is_free and world.steered is not None
            for body in world.steered or []:
                if body in phase.rooms:
                    phase.lead(phase.rooms[body])
        springs = len(self.springs.joints) if self.springs else 0
        if len(phase.bounds) != len(world.members) or springs > self.landings.springs:
            phase.take(world.members)
            phase.tied = self.find_rooms_on_joints() if self.has_joints() else []
        self.landings.springs = springs
        phase.foresees = bool(self.rods and self.rods.awake) or self.has_firm_springs(dt)
        renews = phase.is_stale or len(phase.leavers) > 0
        found = self.renew_pairs(dt) if renews else []
        phase.list_near()
        moved = self.note_moved()
        if renews or moved:
            self.changed = True
            for pair in found:  # where nothing has moved as well
                body = pair.b if pair.a.idle else pair.a
                body.has_moved = phase.rooms[body].near
            if self.landings.speeds:
                self.landings.end()
            self.find_contacts(dt)
            if self.touching or self.groups:
                self.group_contacts()
            if self.unpaired:
                self.end_unpaired()
            if phase.foresees and (self.landings.pairs or self.landings.speeds):
                self.landings.foresee(dt)
            phase.add_looks(len(phase.watched) - len(self.touching), dt)
        self.note_idle()

    def note_idle(self) -> None:
        """Let the world update its hooks after the impacts if this has become idle or busy."""
        self.world.is_outdated = self.was_idle == bool(self.groups)

    def note_moved(self) -> bool:
        """Note which bodies with others near have moved since their contacts were last found.

        Return whether any has.
        """
        far = REDETECT_DISTANCE * self.world.lengths
        far2, any_moved = far * far, False
        for one in self.broad_phase.near:
            body = one.body
            dx, dy = body.x - body.last_x, body.y - body.last_y
            body.has_moved = dx * dx + dy * dy > far2
            if body.has_moved:
                body.last_x, body.last_y, any_moved = body.x, body.y, True
        return any_moved

    def renew_pairs(self, dt: float) -> list[Pair]:
        """Return the near pairs that are new."""
        phase, g = self.broad_phase, self.world.g
        bearing = self.touching if g != (0.0, 0.0) else []
        held = {body for c in bearing for body in (c.a, c.b)}
        back = self.last_dt if self.lets_none_pass else 0.0
        if phase.is_stale:  # all pairs are new
            self.beside_static, self.landings.pairs = {}, []
            for c in self.touching:
                self.unpaired[pair_number(c.a, c.b)] = c
            phase.is_free = not (self.world.are_all_pushed or self.touching)
        found = phase.renew(g, held, dt, back, self.speculative_speed * dt)
        self.add_pairs(found)
        return found

    def add_pairs(self, found: list[Pair]) -> None:
        """Note new near pairs, with the contacts they had, and drop those to ignore."""
        phase = self.broad_phase
        if self.ignored:
            phase.ignore(self.ignored)
        if self.unpaired:
            self.keep_contacts(found)
        for pair in found:
            if not pair.b.inv_mass:
                self.beside_static[pair.a] = None
        for pair in found if self.has_joints() else []:
            a, b = pair.a, pair.b
            is_led = self.is_on_joint(a) or self.is_on_joint(b)
            if is_led and pair_number(a, b) not in self.ignored:
                self.landings.pairs.append(pair)

    def keep_contacts(self, found: list[Pair]) -> None:
        """Give new near pairs the contacts that their bodies had before."""
        touched = {c.a for c in self.unpaired.values()}
        kept: list[Contact] = []
        for pair in found:
            if pair.a in touched:
                pair.contact = self.unpaired.pop(pair_number(pair.a, pair.b), None)
                if pair.contact:
                    kept.append(pair.contact)
        self.touching = [*self.touching, *kept]

    def find_contacts(self, dt: float) -> None:
        """Find the present contacts of bodies that have moved, with the impulses they had before.

        Bodies that touch are in contact, and so are slow ones that may touch within dt seconds: a
        speculative contact lets them close the gap and no more. Fast ones get none, as they may
        still miss each other.
        """
        touching: list[Contact] = []
        renewed: list[Contact] = []
        slow, touching_gap = self.speculative_speed, self.touching_gap
        margin, slow2 = slow * dt, slow * slow
        back = self.last_dt if self.lets_none_pass else 0.0
        stops, gone = self.stops, self.events.gone
        for pair in self.broad_phase.watched:
            a, b, c = pair.a, pair.b, pair.contact
            if not (a.has_moved or b.has_moved) and (c is None or c.gap == c.found):
                if c:
                    touching.append(c)
                continue
            dx, dy, reach = b.x - a.x, b.y - a.y, a.r + b.r + margin
            dvx, dvy = b.vx - a.vx, b.vy - a.vy
            if b.r:
                if back:
                    reach += sqrt(dvx * dvx + dvy * dvy) * back
                if stops:
                    reach += self.way_left(a) + self.way_left(b)
                is_apart = dx * dx + dy * dy > reach * reach
            else:
                out_x, out_y = abs(dx) - b.hx - reach, abs(dy) - b.hy - reach
                is_apart = out_x > 0 or out_y > 0
                if is_apart and back and c is None:
                    way = (abs(a.vx) + abs(a.vy) + abs(b.vx) + abs(b.vy)) * back
                    is_apart = out_x > way or out_y > way or was_apart(a, b, reach, back)
            if not is_apart:
                nx, ny, gap = collide(a, b)
                if gap > touching_gap:
                    closing = dvx * nx + dvy * ny
                    is_fast = abs(closing) > slow if c else dvx * dvx + dvy * dvy > slow2
                    is_apart = gap > margin or is_fast
                    if is_apart and back and (b.r or c is None):
                        is_apart = not self.have_passed(a, b, gap)
            if is_apart:
                if c:
                    pair.contact = None
                    self.events.note_part(c)
                continue
            if c is None:
                c = pair.contact = self.make_contact(a, b, nx, ny)
                self.events.note_hit(c)
                if gap < -touching_gap and self.last_dt == 0:  # a program has put them there
                    self.crowd[c] = True
            elif gone and c in gone:
                self.events.note_again(c)
            if not b.r:
                nx, ny, gap = leave_as_entered(c, nx, ny, gap)
            if nx * c.nx + ny * c.ny < SAME_DIRECTION:
                c.jn = c.jt = 0.0
            c.nx, c.ny, c.gap, c.found = nx, ny, gap, gap
            touching.append(c)
            renewed.append(c)
            if b.inv_mass and (gap < -a.r or gap < -b.r):
                self.crowd.setdefault(c, False)
        self.touching, self.renewed = touching, [*self.renewed, *renewed]

    def group_contacts(self) -> None:
        """Put contacts into their groups, and count those of balls with other balls."""
        for c in self.balls.contacts:
            c.a.touches = c.b.touches = 0
        balls: list[Contact] = []
        statics: list[Contact] = []
        for c in self.touching:
            if c.b.inv_mass:
                balls.append(c)
                c.a.touches += 1
                c.b.touches += 1
            else:
                statics.append(c)
        self.balls.contacts, self.statics.contacts = balls, statics
        self.groups = [group for group in (self.balls, self.statics) if group.contacts]

    def make_contact(self, a: Body, b: Body, nx: float, ny: float) -> Contact:
        """Return a new contact with this normal, filled in by the other effects."""
        c = Contact(a, b)
        c.nx, c.ny = nx, ny
        for begin_contact in self.world.hooks["begin_contact"]:
            begin_contact(c)
        self.begun.append(c)
        is_fresh = a.is_fresh or (b.inv_mass > 0 and b.is_fresh)
        if is_fresh and c.closing_speed() > -self.speculative_speed:
            a.is_pressed = b.is_pressed = True
        return c

    def meet(self, pair: Pair, nx: float, ny: float, gap: float) -> Contact:
        """Add the contact of two bodies that meet, beside those found, and wake them."""
        pair.a.wake()
        pair.b.wake()
        c = pair.contact = self.make_contact(pair.a, pair.b, nx, ny)
        c.gap = c.found = gap
        self.touching.append(c)
        group = self.balls if c.b.inv_mass else self.statics
        group.contacts = [*group.contacts, c]  # a new list, as its order is new
        if c.b.inv_mass:
            c.a.touches += 1
            c.b.touches += 1
        self.groups = [group for group in (self.balls, self.statics) if group.contacts]
        return c

    def end_contacts(self, parting: list[Contact]) -> None:
        """End contacts of bodies that an impact has thrown apart, if no rod brings them back.

        If a spring does, that is a new impact: a contact would stop it without a bounce. Pairs that
        have parted in this step already stay: none parts twice in one.
        """
        ended: list[Contact] = []
        parted = {(c.a, c.b) for c in self.events.parted} if self.events.parted else ()
        rods = self.rods
        for c in parting:
            a, b = c.a, c.b
            if rods and (rods.holds(a) or rods.holds(b)):
                continue
            is_moving = not b.inv_mass and (b.vx or b.vy)  # a static body that follows
            is_foreseen = c in self.landings.speeds  # and nobody was told of it
            if is_moving or is_foreseen or c.jn or c.jt or (a, b) in parted:
                continue
            if collide(a, b)[2] > self.touching_gap:
                ended.append(c)
                self.events.note_gone(c)
        if ended:
            self.drop_contacts(ended)

    def leaving_speed(self) -> float:
        """Return the speed (px/s) from which bodies leave each other, whatever gravity does."""
        return self.speculative_speed + hypot(*self.world.g) * self.last_dt

    def drop_contacts(self, ended: list[Contact]) -> None:
        """Drop contacts of bodies that are near each other, without a call of on_part."""
        touching, begun = dict.fromkeys(self.touching), dict.fromkeys(self.begun)
        for c in ended:
            touching.pop(c, None)
            begun.pop(c, None)
            for pair in self.broad_phase.rooms[c.a].pairs:
                if pair.contact is c:
                    pair.contact = None
        self.touching, self.begun = list(touching), list(begun)
        self.group_contacts()
        self.note_idle()

    def drop_untouched(self, new: set[Contact]) -> None:
        """Drop new contacts of bodies that were hit by others and so did not touch.

        Before a step none are new: the program has been told of all.
        """
        missed: list[Contact] = []
        for c in new if self.last_dt else ():
            was_hit, gap = c.a in self.hit_ago or c.b in self.hit_ago, collide(c.a, c.b)[2]
            touch = gap <= self.touching_gap or self.have_passed(c.a, c.b, gap)
            if was_hit and not touch and c not in self.landings.speeds:
                missed.append(c)
                self.events.hits.pop(c, None)
        if missed:
            self.drop_contacts(missed)

    def end_unpaired(self) -> None:
        """End the contacts of bodies that are no longer near each other, except sleeping ones.

        Those keep their impulses: with a warm start, a pile wakes calmly.
        """
        unpaired, self.unpaired = self.unpaired, {}
        for number, c in unpaired.items():
            if c.a.asleep and c.b.idle:
                self.unpaired[number] = c
            else:
                self.events.note_part(c)

    def find_cover(self, c: Contact, ago: float = 0.0) -> Pair | None:
        """Return the pair of a ball and the static body that covers a corner, or None.

        The ball is at a corner or end with the normal of this contact some seconds ago, or is now.
        If the corner is on another body, along which the ball comes nearer, the two are one there:
        the ball touches that body, and not the corner.
        """
        a, b = c.a, c.b
        has_flown = ago > 0
        nx, ny, gap = (c.nx, c.ny, 0.0) if has_flown else collide(a, b)
        if has_flown:
            ago -= self.late_by(a)
        if b.r or is_over_face(b, nx, ny, *seen_before(a, b, ago)):
            return None
        reach = a.r + gap
        for pair in self.broad_phase.rooms[a].pairs:
            b = pair.b
            may_touch = pair.contact or (has_flown and pair_number(a, b) not in self.ignored)
            if b.is_static and pair.contact is not c and may_touch:
                x, y = seen_before(a, b, ago)
                if covers(b, x, y, nx * reach, ny * reach, self.touching_gap):
                    return pair
        return None

    def have_passed(self, a: Body, b: Body, gap: float) -> bool:
        """Return whether two bodies have touched on their way here and passed each other.

        That is known of balls that flew straight, or almost so with joints.
        """
        is_late = len(self.stops) > 0 and self.late_by(a) + self.late_by(b) > 0
        vx, vy = (a.vx - b.vx, a.vy - b.vy) if b.r or b.is_kinematic else (a.vx, a.vy)
        seconds = self.flight_of(a, b)
        way = sqrt(vx * vx + vy * vy) * seconds
        if not is_late and (way <= gap or way <= FAR * (a.r + b.r)):
            return False
        if (a.joint_count or b.joint_count) and (self.is_led_far(a) or self.is_led_far(b)):
            return False
        return (self.look_back_late(a, b) if is_late else moment_of_touch(a, b, seconds))[0] > 0

    def slow_speed(self, dt: float) -> float:
        """Return the speed (px/s) up to which hits do not bounce in steps of dt seconds.

        Gravity gives that much in a few steps; without gravity all but the slowest bounce.
        """
        unit, g = self.world.unit, hypot(*self.world.g)
        return min(RESTING_SPEED * unit, RESTING_STEPS * g * dt + LEAST_SPEED * unit)

    def has_joints(self) -> bool:
        """Return whether there is any rod or spring that does not sleep."""
        rods, springs = self.rods, self.springs
        return bool((rods and rods.awake) or (springs and springs.awake))

    def has_firm_springs(self, dt: float) -> bool:
        """Return whether any spring swings too fast for overlaps of a step of dt seconds."""
        return self.springs is not None and self.springs.are_firm(dt)

    def find_rooms_on_joints(self) -> list[Bounds]:
        """Return the rooms of balls on joints."""
        return [one for one in self.broad_phase.moving if self.is_on_joint(one.body)]

    def is_on_joint(self, body: Body) -> bool:
        """Return whether a body is a ball on a rod or spring."""
        rods, springs = self.rods, self.springs
        return bool((rods and rods.holds(body)) or (springs and springs.holds(body)))

    def is_led_far(self, body: Body) -> bool:
        """Return whether rods or stiff springs may lead a ball by more than its radius in a step.

        The common velocity of a frame of rods does not count.
        """
        if not body.joint_count:
            return False
        x = y = 0.0
        if self.rods and self.rods.holds(body):
            x, y = self.rods.frame_of[body].velocity()
        elif self.springs and not any_stiff(self.springs.springs_of.get(body, []), self.h):
            return False
        return hypot(body.vx - x, body.vy - y) * self.last_dt > body.r

    def late_by(self, body: Body) -> float:
        """Return by how much (s) a ball is behind the others, as a static body stopped it."""
        return self.stops[body].late if body in self.stops else 0.0

    def may_pass(self) -> bool:
        """Return whether any ball may fly on into the static body that stopped it."""
        return len(self.stops) > 0 and any([stop.end for stop in self.stops.values()])

    def way_left(self, body: Body) -> float:
        """Return how far (px) a ball would have flown on, had no wall stopped it."""
        return sqrt(body.vx * body.vx + body.vy * body.vy) * self.late_by(body)

    def look_back_late(self, a: Body, b: Body) -> tuple[float, float, float]:
        """Return how long ago (s) two bodies began to touch, and the normal, if a wall stopped one.

        Return zeros if the wall came first. As if nothing had stopped it, it counts as further on.
        """
        by_a, by_b = self.late_by(a), self.late_by(b)
        since = min(a.flown + by_a, b.flown + by_b, self.last_dt)
        ax, ay, bx, by = a.x, a.y, b.x, b.y
        a.x, a.y, b.x, b.y = ax + a.vx * by_a, ay + a.vy * by_a, bx + b.vx * by_b, by + b.vy * by_b
        ago, nx, ny = moment_of_touch(a, b, since)
        a.x, a.y, b.x, b.y = ax, ay, bx, by
        return (ago, nx, ny) if ago >= max(by_a, by_b) else (0.0, 0.0, 0.0)

    def flight_of(self, a: Body, b: Body) -> float:
        """Return how long (s) two bodies have flown freely: a step, if none was hit or stopped."""
        least = a.flown if a.flown < b.flown else b.flown
        return least if least < inf and self.last_dt else self.last_dt

    def note_impact(self, body: Body, ago: float) -> None:
        """Note that a ball was hit some seconds ago, and has flown freely since."""
        self.hit_ago[body] = body.flown = ago

    def finish(self, h: float) -> None:
        """Note how long (s) each ball has flown freely, and begin a new list of hits."""
        if self.changed:
            self.begun, self.renewed, self.changed = [], [], False
        self.last_dt = h * self.world.substep_count
        for body in self.flying:
            body.flown = inf
        for body, ago in self.hit_ago.items():
            body.flown = ago + self.last_dt
        self.flying, self.hit_ago, self.stops = [*self.hit_ago], {}, {}

    def tell(self, h: float) -> None:
        if self.tells_hit or self.tells_part:
            self.events.find_gone()
        self.last_dt, self.stops = 0.0, {}  # impacts are over; a program may change anything now
        if self.events.hits or self.events.parted:
            self.events.tell()

    def let_touch(self, a: Body, b: Body, may: bool) -> None:
        if may:
            self.ignored.discard(pair_number(a, b))
            self.broad_phase.bounds = []
        else:
            self.ignored.add(pair_number(a, b))
            for c in [c for c in self.of_body(a) if b in (c.a, c.b)]:
                self.events.note_part(c)
            self.drop(a, b)

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
            for begin_contact in self.world.hooks["begin_contact"]:
                begin_contact(c)
        self.wake_beside(body)
        self.broad_phase.bounds = []

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
        if world.anybody_sleeps():
            self.wake_beside(body)
            for other in world.members:
                dx, dy = abs(other.x - body.x), abs(other.y - body.y)
                if other.asleep and dx < other.hx + body.hx and dy < other.hy + body.hy:
                    other.wake()

    def forget(self, body: Body) -> None:
        """Wake whatever touches the body: it may have rested on it."""
        body.flown, body.touches = inf, 0
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
        speeds = self.landings.speeds.items()
        self.landings.speeds = {c: v for c, v in speeds if not ends <= {c.a, c.b}}
        self.unpaired = {n: c for n, c in self.unpaired.items() if not ends <= {c.a, c.b}}
        self.broad_phase.bounds = []

    def is_idle(self) -> bool:
        return not self.groups

    def is_used(self) -> bool:
        return len(self.world.members) > 1

    def links(self) -> list[tuple[Body, Body]]:
        return [(c.a, c.b) for c in self.touching]

    def awake_changed(self) -> None:
        self.broad_phase.bounds = []


def was_apart(a: Body, b: Body, reach: float, back: float) -> bool:
    """Return whether the boxes of a ball and a static body, at this reach (px), were always apart.

    That is since `back` seconds ago, if both flew straight.
    """
    x, y, vx, vy = a.x - b.x, a.y - b.y, a.vx, a.vy
    if b.is_kinematic:
        vx, vy = vx - b.vx, vy - b.vy
    out, away = (x, vx) if x > 0 else (-x, -vx)
    if out > b.hx + reach and (away <= 0 or out - away * back > b.hx + reach):
        return True
    out, away = (y, vy) if y > 0 else (-y, -vy)
    return out > b.hy + reach and (away <= 0 or out - away * back > b.hy + reach)
