"""Keep fast and hard-pressed balls out of static bodies."""

from math import hypot, inf
from operator import itemgetter

from .body import Body, State, state_of
from .bounds import pair_number
from .contact import Contact, collide, leave_as_entered
from .detection import Detection
from .soft import SAME_DIRECTION
from .stop import Stop, lose_energy, rewind
from .sweep import NO_HIT, drop_covered, first_hit, first_stop, free_share, has_entered

CORE = 0.5  # radii
SWEEP_FROM = 0.5  # radii, a bullet that moves further in one step is swept
OVERLAP = 1e-6  # radii, the overlap of a stopped bullet, so that the next step finds the contact
SEAM = 1e-9  # a squared sine; faces that turn less are one
CORNER_PASSES = 4  # of keeping cores out: a ball put back may meet another static body

Point = tuple[float, float]  # px
Face = tuple[float, float, float, float]  # how far (px) and how fast (px/s) into it, and its normal
Way = tuple[float, float, float]  # how far (px) or how fast (px/s) into a face, and its normal
HOW_FAR = itemgetter(0)


class Cores:
    """The cores of balls: no static body may enter them, however fast or hard pressed a ball is.

    From deep in a static body, a ball might leave on the other side. The core is half as wide as
    the ball, so that a sliding ball does not catch on a seam.
    """

    __slots__ = ("contacts", "starts", "world")

    def __init__(self, contacts: Detection) -> None:
        self.contacts = contacts
        self.world = contacts.world
        self.starts: list[tuple[Body, float, float]] = []  # of bullets, where their step began

    def keep_out(self, h: float) -> None:
        """Put balls back whose cores met a static body in this step, or are in one."""
        contacts = self.contacts
        for bullet, x, y in self.starts:
            if hypot(bullet.x - x, bullet.y - y) > SWEEP_FROM * bullet.r:
                self.sweep(bullet, (x, y), bullet.r, OVERLAP * bullet.r, h)
        leavers = contacts.broad_phase.find_leavers(contacts.last_dt)
        for one in [*leavers] if self.world.statics else []:  # to stop one may make others leave
            if not one.near:
                one.find_start(contacts.last_dt)
            self.stop_core(one.body, h)
        for body in contacts.beside_static:  # most calls of stop_core would do nothing
            if body.flown < inf or abs(body.x - body.last_x) + abs(body.y - body.last_y) > body.r:
                self.stop_core(body, h)
        statics = contacts.statics.contacts
        for _ in range(CORNER_PASSES if statics else 0):
            faces: dict[Body, list[Face]] = {}
            for c in statics:
                a, b = c.a, c.b
                gap = (b.x - a.x) * c.nx + (b.y - a.y) * c.ny - c.reach + c.found - c.gap
                if gap < -CORE * a.r and c.found < a.r:  # else its way was swept
                    self.find_way_out(c, gap, faces)
            if not faces:
                break
            for body, entered in faces.items():
                self.put_out(body, entered)
                self.stop_core(body, h)

    def stop_core(self, body: Body, h: float) -> None:
        """Stop a ball that moved far, or was hit, where its core met a static body."""
        distance = abs(body.x - body.last_x) + abs(body.y - body.last_y)
        is_far = distance > body.r > 0 or (distance > 0 and body.flown < inf)
        if is_far and not body.is_static:
            self.sweep(body, (body.last_x, body.last_y), CORE * body.r, 0.0, h)

    def stop_hit(self, body: Body, beside: list[Contact], bends: list[Point]) -> bool:
        """Stop a ball where impacts took its core through a static body. Return whether they did.

        Its contacts are `beside`; it flew straight from each of its bends to the next. In the next
        step it comes from where it is now.
        """
        x, y, core = body.last_x, body.last_y, CORE * body.r
        dx, dy = body.x - x, body.y - y
        is_in = False
        for c in beside:
            is_in = is_in or (c.gap < -core and not c.b.inv_mass)
        if dx * dx + dy * dy <= core * core and not is_in:
            return False
        share = free_share(body, self.world.statics, core_of(body), (x, y), dx, dy)
        if share < 1 and bends and self.is_free(body, bends):
            share = 1.0
        if share < 1:
            body.x, body.y = x + dx * share, y + dy * share
            for c in beside:
                c.nx, c.ny, c.gap = collide(c.a, c.b)
                c.found = c.gap
            self.contacts.note_impact(body, 0.0)
        body.last_x, body.last_y = body.x, body.y
        return share < 1

    def is_free(self, body: Body, bends: list[Point]) -> bool:
        """Return whether no static body stopped the core of a ball on its way over these bends."""
        radius = core_of(body) - self.contacts.touching_gap
        x, y = body.last_x, body.last_y
        for to_x, to_y in [*bends, (body.x, body.y)]:
            if first_stop(self.world.statics, radius, x, y, to_x - x, to_y - y) < NO_HIT:
                return False
            x, y = to_x, to_y
        return True

    def find_way_out(self, c: Contact, gap: float, faces: dict[Body, list[Face]]) -> None:
        """Note what puts back and stops a ball whose core entered a static body, or went deeper.

        `gap` is along the normal at the start of the step; past a corner the new normal counts,
        unless the ball went through the body.
        """
        a, b = c.a, c.b
        nx, ny, now = leave_as_entered(c, *collide(a, b))
        has_turned = nx * c.nx + ny * c.ny < SAME_DIRECTION
        is_through = has_turned and (c.found < -a.r or has_entered(a, b))
        if is_through:
            nx, ny, now = c.nx, c.ny, gap
        back = min(c.found, -CORE * a.r) - now
        if back > self.contacts.touching_gap and (is_through or not self.contacts.find_cover(c)):
            closing = max((a.vx - b.vx) * nx + (a.vy - b.vy) * ny, 0.0)
            faces.setdefault(a, []).append((back, closing, nx, ny))

    def put_out(self, body: Body, faces: list[Face]) -> None:
        """Put a ball out of faces, and take its speed into them away."""
        for far, at in way_out([(back, nx, ny) for back, _, nx, ny in faces]):
            _, _, nx, ny = faces[at]
            body.x, body.y = body.x - nx * far, body.y - ny * far
        for fast, at in way_out([(closing, nx, ny) for _, closing, nx, ny in faces]):
            _, _, nx, ny = faces[at]
            body.vx, body.vy = body.vx - nx * fast, body.vy - ny * fast
        self.contacts.broad_phase.note_leaver(body)

    def sweep(
        self, body: Body, start: tuple[float, float], radius: float, overlap: float, h: float
    ) -> None:
        """Stop a ball of this radius at the first static body on its way from `start`, if any.

        There it overlaps by `overlap` px: the next step finds the contact and resolves the impact.
        """
        statics = self.world.statics
        if self.contacts.ignored:
            statics = [s for s in statics if pair_number(body, s) not in self.contacts.ignored]
        x, y = start
        dx, dy = body.x - x, body.y - y
        # a little smaller, or rounding would decide whether a ball that slides along is stopped
        gap = self.contacts.touching_gap
        fraction = first_hit(statics, radius - gap, x, y, dx, dy)
        if fraction < NO_HIT and radius == body.r:  # cores may meet any corner
            statics = drop_covered(statics, radius - gap, x, y, dx, dy, gap)
            fraction = first_hit(statics, radius - gap, x, y, dx, dy)
        if fraction < NO_HIT:
            fraction = min(fraction, first_hit(statics, radius, x, y, dx, dy))
            fraction += overlap / hypot(dx, dy)
        if fraction < 1:
            self.stop(body, (dx, dy), fraction, h)

    def stop(self, body: Body, way: tuple[float, float], fraction: float, h: float) -> None:
        """Put a ball back to where it was after this fraction of its way (px), and note when."""
        contacts = self.contacts
        end = state_of(body)
        springs = contacts.springs
        if springs and body.joint_count:
            stiff = springs.stiff_around(body, h)
            stored = springs.energy_in(stiff)
            rewind(body, way, fraction, self.acceleration, h)
            self.take_along(springs.others_on(stiff, body), end[0] - body.x, end[1] - body.y, h)
            lose_energy(body, springs.energy_in(stiff) - stored)
        else:
            rewind(body, way, fraction, self.acceleration, h)
        is_on_rod = contacts.rods is not None and contacts.rods.holds(body)
        earlier = contacts.stops.get(body)
        before = earlier.time if earlier else contacts.last_dt
        time = fraction * before
        late = 0.0 if is_on_rod else contacts.last_dt - time  # its rods would take others along
        first: State | None = earlier.end if earlier else end
        if body.is_bullet and not is_on_rod:
            first = None
        contacts.stops[body] = Stop(state_of(body), first, time, late)
        flown = body.flown if body.flown < inf else contacts.last_dt
        body.flown = flown - (1 - fraction) * before
        contacts.flying.append(body)
        contacts.broad_phase.lead(contacts.broad_phase.rooms[body])

    def take_along(self, bodies: list[Body], dx: float, dy: float, h: float) -> None:
        """Put balls back by (dx, dy) px with one that they are stiffly tied to, up to a wall.

        If they went on alone, they would stretch springs by more energy than all had. They go
        straight from where they were at the start of the step, as they may be in a wall by now.
        Those whose cores were in a static body stay: the way out of it is not known.
        """
        contacts = self.contacts
        deep = {c.a for c in contacts.statics.contacts if c.found < -CORE * c.a.r}
        for body in [body for body in bodies if body not in deep]:
            room = contacts.broad_phase.rooms[body]
            if not room.near:
                room.find_start(contacts.last_dt)
            x, y = body.last_x, body.last_y
            way = body.x - dx - x, body.y - dy - y
            share = free_share(body, self.world.statics, CORE * body.r, (x, y), *way)
            back = body.x - x - way[0] * share, body.y - y - way[1] * share
            rewind(body, back, 0.0, self.acceleration, h)
            contacts.broad_phase.note_leaver(body)

    def acceleration(self, body: Body) -> tuple[float, float]:
        """Return the acceleration of a body (px/s²) by gravity, forces and soft springs."""
        x, y = self.world.acceleration(body)
        springs = self.contacts.springs
        if springs and body.joint_count:
            by_x, by_y = springs.acceleration(body, self.contacts.h)
            x, y = x + by_x, y + by_y
        return x, y


def core_of(body: Body) -> float:
    """Return the radius (px) of a ball that no static body enters in impacts: all of a bullet."""
    return body.r if body.is_bullet else CORE * body.r


def way_out(ways: list[Way]) -> list[tuple[float, int]]:
    """Return how far along which of these a ball gets out of faces, by so much of each or more.

    Two faces are left at once: one after the other, a ball would not leave a V in its middle.
    """
    farthest = max(ways, key=HOW_FAR)
    far, nx, ny = farthest
    first = ways.index(farthest)
    if far <= 0 or len(ways) == 1:
        return [(far, first)] if far > 0 else []
    cosines = [nx * x + ny * y for _, x, y in ways]
    left = [way[0] - far * cosine for way, cosine in zip(ways, cosines, strict=True)]
    second = left.index(max(left))
    if left[second] <= 0:
        return [(far, first)]
    far, more = split(far, ways[second][0], cosines[second])
    return [way for way in ((far, first), (more, second)) if way[0] > 0]


def split(one: float, other: float, cosine: float) -> tuple[float, float]:
    """Return the lengths along two directions that together reach as far along both as asked."""
    rest = 1 - cosine * cosine
    if one <= cosine * other or rest < SEAM:
        return (0.0, other) if other > one else (one, 0.0)
    if other <= cosine * one:
        return one, 0.0
    return (one - cosine * other) / rest, (other - cosine * one) / rest
