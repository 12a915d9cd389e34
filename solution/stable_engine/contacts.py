"""Contacts: bodies do not pass through each other."""

from math import hypot, pi

from .body import Body
from .contact import Contact, is_at_face, turn_normals
from .cores import Cores
from .crowd import gather_crowd, part_crowd
from .detection import REDETECT_DISTANCE, Detection, OnHit, OnPart
from .effect import Direction
from .order import Group, Stage, give_places, put_in_order
from .pile import Pile
from .piles import BEARING, find_piles
from .soft import Pace, softness
from .springs import Springs
from .squeeze import Squeeze, find_squeezes
from .strikes import stop_strikes
from .unload import take_off

FREQUENCY = 0.24  # of a contact of two balls, per substep; against a static body it is doubled
LEAST_DAMPING = 10.0  # ratio, so high that overlap is pushed out without a bounce
SUBSTEP_DAMPING = 2.5  # ratio, per substep of a step: see Contacts.prepare
STIFFENING = 0.07  # of a substep, per step
# lengths are in units of the world, see World.unit
FAR_APART = 1e6  # radii: no step takes a ball as far
MAX_PUSH_SPEED = 300.0  # 1/s, overlap is pushed out no faster
SINKING = 1.0  # 1/s, how fast a load on springs may come to explain an overlap
MOST_PASSES = 16  # in which to take back the speed of a push
LEFT_BEHIND = 0.1  # of the speed of a body that recedes; slower balls stay behind


class Contacts(Detection):
    """Contacts found once per step and solved in every substep as soft constraints.

    on_hit(a, b, speed) is called at the end of a step for each pair that began to touch in it, with
    the speed (px/s) at which the two met: the earliest hit first. on_part(a, b) is called for each
    pair that no longer touches at the end of a step, before pairs that met later. `a` is a ball
    with mass, `b` any body. Both functions may add and remove bodies, and can be set later on.
    Bodies that are removed do not part; those that a rod ties so close that they overlap do.

    Without Bounce, what hits a row of bodies fast stops at its touch, with what is ahead: see
    stop_strikes. Flush static bodies are one: at a corner that another one covers, a contact does
    nothing.

    Each stage solves contacts of static bodies last, so that these hold best. Where passes would
    leave much, all that balls connect is then solved together, see Pile: where a body is more than
    2.5 times as heavy as a ball that it touches, or kinematic, in a narrow or flat V, in a tall
    tower, where balls on rods land or overlap, and where stiff springs press balls.
    """

    __slots__ = (
        *("beginnings", "has_friction", "max_push_speed", "pace", "piles"),
        *("cores", "drifts", "held", "push", "squeezed"),
    )
    rank = 3

    def __init__(self, on_hit: OnHit | None = None, on_part: OnPart | None = None) -> None:
        super().__init__(on_hit, on_part)
        self.squeezed: list[Squeeze] = []  # of balls that keep less of it
        # those of a short step, with their impulses before: jn, jt and last
        self.held: list[tuple[Contact, float, float, float]] = []
        self.beginnings = 0.0  # in how many steps any contact has begun
        self.piles: list[Pile] = []  # with heavy bodies
        self.has_friction = False  # which may hold squeezes
        self.drifts = False  # whether nothing presses bodies together
        self.push: Stage = push  # of passes, unless there are piles: see Friction
        self.pace = Pace(STIFFENING)

    def attach(self) -> None:
        super().attach()
        self.max_push_speed = MAX_PUSH_SPEED * self.world.unit  # px/s
        for group in (self.balls, self.statics):
            group.max_push_speed = self.max_push_speed
            group.least = self.touching_gap / 2
        self.cores = Cores(self)

    def prepare(self, h: float) -> None:
        """Set the stiffness of contacts by the substep, their damping by the number of substeps.

        Balls may overlap by their motion in a step, however short its substeps are. Damping slows
        the push out of that overlap: a push within a few substeps would give a pile energy, and
        more the shorter they are.
        """
        if h != self.h:
            self.keep_forces(h)
        pace = self.pace.follow(h)
        if h < pace:
            self.held = [(c, c.jn, c.jt, c.last) for c in self.touching]
        if not (self.groups or self.piles or self.crowd):
            return
        self.drifts = self.lets_none_pass and self.is_drifting()
        if self.has_friction:
            self.squeezed = find_squeezes(self, h)
        hertz = FREQUENCY / pace
        damping = max(LEAST_DAMPING, SUBSTEP_DAMPING * self.world.substep_count)
        for group in self.groups:
            rate = hertz if group.moves_b else 2 * hertz
            group.bias_rate, group.mass_scale = softness(rate, damping, h)
            group.load_rate = softness(rate, damping, pace)[0] * (h / pace)
        if not self.changed:
            return
        if self.crowd:
            omega = 2 * pi * hertz  # 1/s, at which contacts of balls swing
            most, give = self.max_push_speed / omega, 1 / (h * omega * omega)
            self.crowd = gather_crowd(self, most, give)
            for c in self.crowd:  # they just touch, so that the solver does not push them apart
                c.gap = max(c.gap, self.touching_gap)
        self.leave_covered()
        if self.begun and not self.lets_none_pass:
            stop_strikes(self, h * self.world.substep_count)
        self.find_order()
        if self.begun:  # impulses may reach all others
            self.renewed = self.touching
        if self.springs and self.has_firm_springs(h * self.world.substep_count):
            self.spare_springs(self.springs, h)
        for c in self.renewed:
            a, b = c.a, c.b
            distance = (b.x - a.x) * c.nx + (b.y - a.y) * c.ny
            c.reach = distance - c.gap
            if c.mu:
                c.set_arms(distance - a.r - b.r)
        self.piles = find_piles(self, self.piles, h, pace)

    def is_drifting(self) -> bool:
        """Return whether nothing presses bodies together: no force, joint or moving static body."""
        world = self.world
        if world.g != (0.0, 0.0) or world.forces or world.hooks["force"]:
            return False
        is_alone = len(world.hooks["warm_start"]) == 1
        return is_alone and not any([body.vx or body.vy or body.w for body in world.statics])

    def spare_springs(self, springs: Springs, h: float) -> None:
        """Slow the push out of overlaps where springs press: its work on them is energy for free.

        It takes no more power than a push of one weight. Overlap that a steady load explains stays.
        """
        most = hypot(*self.world.g) * h  # px/s
        more = SINKING * self.world.unit * h * self.world.substep_count  # px
        for c in self.renewed:
            if c.gap < 0 and c.jn > most * c.mn and (springs.holds(c.a) or springs.holds(c.b)):
                group = self.balls if c.b.inv_mass else self.statics
                c.sunk = min(group.borne(c), c.sunk + more)
                c.gap -= min(c.gap + c.sunk, 0.0) * (1 - most * c.mn / c.jn)

    def leave_covered(self) -> None:
        """Let contacts at corners that other bodies cover do nothing, as at a seam of flush boxes.

        What these bear passes on to the others.
        """
        tilted = [c for c in self.statics.contacts if not c.b.r and c.nx and c.ny]
        for c in [c for c in tilted if not is_at_face(c)]:
            pair = self.find_cover(c)
            if pair and pair.contact:
                pair.contact.jn += c.jn
                pair.contact.jt += c.jt
                c.jn = c.jt = 0.0
                c.gap = FAR_APART * c.a.r
                self.renewed = [*self.renewed, c]

    def find_order(self) -> None:
        """Find the contacts solved in turn, with their order, and those solved at once.

        The order depends on where contacts began alone, and looks the same in a mirror.
        """
        grain, is_mirrored = self.touching_gap, any([group.is_mirrored for group in self.groups])
        if self.begun:
            self.beginnings += 1
            if give_places(self.begun, self.world.g, grain, self.beginnings):
                is_mirrored = True
        for group in self.groups:
            put_in_order(group, grain, is_mirrored)

    def keep_forces(self, h: float) -> None:
        """Scale the kept impulses to a substep of h seconds, so that the forces stay the same."""
        if self.h > 0:
            for c in self.touching:
                c.jn *= h / self.h
                c.jt *= h / self.h
                c.last *= h / self.h
        self.h = h

    def steady_forces(self, h: float) -> None:
        """After a step shorter than those before, take over only a share of the forces in it.

        What stops a body in a short time is a large force: in a longer step it would throw it.
        """
        share = h / self.pace.h
        for c, jn, jt, last in self.held:
            c.jn, c.jt = jn + share * (c.jn - jn), jt + share * (c.jt - jt)
            c.last = last + share * (c.last - last)
        self.held = []

    def warm_start(self, h: float) -> None:
        """Apply both impulses of each contact: one pass costs less than one for each."""
        if self.drifts:
            self.forget_impacts()
        for pile in self.piles:
            pile.forget_impacts()
        for squeeze in self.squeezed:
            squeeze.ease()
        for group in self.groups:
            moves_b = group.moves_b
            for c in group.contacts:
                a, b = c.a, c.b
                jn, jt = c.jn, c.jt
                if not jn:
                    continue  # nor does friction
                nx, ny = c.nx, c.ny
                jx, jy = nx * jn - ny * jt, ny * jn + nx * jt
                a.vx -= jx * a.inv_mass
                a.vy -= jy * a.inv_mass
                if moves_b:
                    b.vx += jx * b.inv_mass
                    b.vy += jy * b.inv_mass
                if jt:
                    a.w -= c.spin_a * jt
                    b.w -= c.spin_b * jt

    def forget_impacts(self) -> None:
        """Begin a substep without impulses: where nothing presses, they were impacts."""
        for c in self.touching:
            c.jn = c.jt = 0.0

    def solve(self, h: float) -> None:
        for pile in self.piles:
            pile.note_lengths(h)
        self.press_on(h, has_moved=False)
        self.settle(h)

    def relax(self, h: float) -> None:
        if self.changed:
            turn_normals(self.renewed)
        self.press_on(h, has_moved=True)
        if self.drifts:
            self.take_back(h)
        for pile in self.piles:
            if pile.rods or not self.has_friction:  # else friction settles it
                pile.settle(self.balls, self.statics, h)

    def take_back(self, h: float) -> None:
        """Relax until no bodies that a push has parted still separate: they would gain energy."""
        most = self.touching_gap / h  # px/s
        for _ in range(MOST_PASSES):
            if all([not c.jn or c.closing_speed() > -most for c in self.touching]):
                return
            self.press_on(h, has_moved=True)

    def press_on(self, h: float, has_moved: bool) -> None:
        """Push bodies in a pass over contacts, before the move or after it."""
        self.balls.has_moved = self.statics.has_moved = has_moved
        self.go_over(push if self.piles else self.push, h)

    def go_over(self, stage: Stage, h: float) -> None:
        """Pass over contacts, one after the other: those of static bodies last."""
        for group in self.groups:
            stage(group, group.in_turn, h)
            for tie in group.ties:
                tie.solve(stage, group, h)

    def settle(self, h: float) -> None:
        """Solve piles for what passes have left, of contacts or of friction."""
        for pile in self.piles:
            pile.settle(self.balls, self.statics, h)

    def rest(self, h: float) -> None:
        """Count the time, and begin again in the last step before bodies may leave their rooms.

        The end of a room is left out, as velocities lag behind positions when rooms are made.
        """
        if self.stays(h) and self.broad_phase.hold_led(h * self.world.substep_count):
            self.broad_phase.age += h * self.world.substep_count
            return
        self.is_resting = False
        self.world.update_hooks()
        self.prepare(h)
        self.finish(h)

    def stays(self, h: float) -> bool:
        """Return whether all bodies fall freely in their rooms in this step, and in equal ones."""
        phase, world = self.broad_phase, self.world
        phase.is_free = phase.is_free and not (self.groups or world.are_all_pushed)
        for body in world.forces:
            phase.lead(phase.rooms[body])
        return (
            phase.is_free and phase.age + h * (world.substep_count + 1) <= phase.end and h == self.h
        )

    def finish(self, h: float) -> None:
        """Part crowds, and put balls back that got into static bodies.

        Contacts rest while all bodies fall freely in the rooms made for that, with nobody near.
        """
        phase = self.broad_phase
        stays = self.stays(h)
        if self.held:
            self.steady_forces(h)
        super().finish(h)
        if self.crowd:
            deepest = part_crowd(self, self.max_push_speed * self.last_dt)
            if deepest < REDETECT_DISTANCE * self.world.unit:
                self.crowd = {}
        self.cores.keep_out(h)
        if stays and not (
            phase.near or phase.leavers or phase.is_stale or self.crowd or self.cores.starts
        ):
            self.is_resting = self.pace.h == h
            if self.is_resting:
                self.last_dt = 0.0
                self.world.update_hooks()

    def press(self, h: float) -> None:
        """Mark bodies that contacts hold: by more than rounding, or the weight of a falling pair.

        Those that have bounced off are free.
        """
        if h != self.h:
            self.keep_forces(h)
        least = self.touching_gap / h + BEARING * hypot(*self.world.g) * h  # px/s
        for c in self.touching:
            is_new = c.jn > least * c.mn and not (c.a.is_pressed and c.b.is_pressed)
            if is_new and c.closing_speed() > -self.speculative_speed:
                c.a.is_pressed = c.b.is_pressed = True

    def is_at_rest(self) -> bool:
        return self.is_resting and not self.world.has_changed

    def unload(self, lost: dict[Body, float], direction: Direction) -> None:
        """Lower the kept impulses under bodies that press less.

        The next step begins with these; unchanged, they would throw balls up.
        """
        self.broad_phase.is_free = False  # gravity may have changed
        impulses = {body: force * self.h for body, force in lost.items()}
        take_off(self.all_contacts(), impulses, direction)

    def static_moved(self, body: Body) -> None:
        """Unload balls from which a static body recedes: the impulses kept would pull them along.

        Gravity lets balls follow a lift.
        """
        super().static_moved(body)
        (gx, gy), dt = self.world.g, self.h * self.world.substep_count
        contacts = self.all_contacts() if body.vx or body.vy else []
        for c in [c for c in contacts if c.b is body]:
            away = body.vx * c.nx + body.vy * c.ny
            follows = max(gx * c.nx + gy * c.ny, 0.0) * dt
            if c.jn and c.closing_speed() + follows < -away * LEFT_BEHIND < 0:
                impulse, c.jn, c.jt = c.jn, 0.0, 0.0
                take_off(contacts, {c.a: impulse}, (-c.nx, -c.ny))

    def awake_changed(self) -> None:
        super().awake_changed()
        self.pace.awake_changed(any([c.a.asleep for c in self.all_contacts()]))


def push(group: Group, contacts: list[Contact], h: float) -> None:
    """Push overlapping bodies apart, and stop those that would overlap after the move.

    After the move, stop those that still come together, and take back the speed of a push.
    """
    has_moved, most, least = group.has_moved, -group.max_push_speed, group.least
    moves_b, bias_rate, mass_scale = group.moves_b, group.bias_rate, group.mass_scale
    for c in contacts:
        a, b = c.a, c.b
        nx, ny, mn = c.nx, c.ny, c.mn
        speed = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny
        before = c.jn
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
        c.jn = jn
        jn -= before
        change = jn * a.inv_mass
        a.vx -= nx * change
        a.vy -= ny * change
        if moves_b:
            change = jn * b.inv_mass
            b.vx += nx * change
            b.vy += ny * change
