"""How balls fly between the impacts of a step, forwards, and back to a touch."""

from math import cos, hypot, sin

from .body import Body, State, state_of
from .contact import Contact
from .contacts import Contacts
from .cores import CORE, Point, core_of, way_out
from .frame import Frame
from .rods import Rods
from .springs import Spring, share_before
from .stop import Stop
from .sweep import free_share

DEEPEST = 2.0  # radii that a ball may fly into a wall off which it will bounce


class Flight:
    """The free flight of balls: under gravity, forces and soft springs, and with their rods.

    Balls at the other ends of springs fly with them, and keep what the impact changes for them.
    With semi-implicit Euler a velocity lags half a substep behind the position.
    """

    __slots__ = (
        *("contacts", "world", "h", "least_speed", "held", "stops", "bends", "walls", "rests"),
        *("bearing", "frame_of", "pivots", "springs_of", "stiff", "before", "in_contact", "moved"),
        *("partners", "changes", "time", "is_simple"),
    )

    def __init__(self, contacts: Contacts, h: float, least_speed: float) -> None:
        rods, springs = contacts.rods, contacts.springs
        self.contacts = contacts
        self.world = contacts.world
        self.h = h  # s, of a substep
        self.least_speed = least_speed  # px/s, slower impacts are ignored
        self.held: set[Body] = set()  # balls at static bodies that cannot go back
        self.stops: dict[Body, Stop] = {}  # of balls that a wall stopped after an impact
        self.bends: dict[Body, list[Point]] = {}  # where balls were hit, and flew straight on
        self.walls: dict[Body, list[Body]] = {}  # at which a ball is: it may fly into them
        self.rests: dict[Body, list[Contact]] = {}  # at faces on which a ball rested
        self.bearing: dict[Body, list[Contact]] = {}  # those of them that bear it now
        self.frame_of: dict[Body, Frame] = {}
        self.pivots: dict[Body, Body] = {}  # of balls that swing on one rod
        if rods:
            rods.find_frames()
            self.frame_of = rods.frame_of
            self.pivots = find_pivots(rods)
        self.springs_of: dict[Body, list[Spring]] = {}
        self.stiff: set[Body] = set()  # bodies whose springs swing too fast to follow
        if springs:
            stiff = springs.find_stiff(h)
            self.springs_of = springs.springs_of
            self.stiff = {body for spring in stiff for body in (spring.end_a, spring.end_b)}
        # of bodies on springs: mirrored impacts, resolved in turn, must not see each other's moves
        self.before: dict[Body, State] = {}
        self.in_contact: set[Body] = set()
        if self.springs_of:
            self.before = {body: state_of(body) for body in self.springs_of}
            self.in_contact.update([body for c in contacts.touching for body in (c.a, c.b)])
        self.moved: set[Body] = set()  # by the present impact
        self.partners: dict[Body, State] = {}  # balls on springs that fly with these
        self.changes: list[tuple[Body, list[float]]] = []  # of the states of partners
        self.time = 0.0  # s, where all these are, after the end of the step
        self.is_simple = not (self.springs_of or self.world.forces)  # whether only gravity pulls

    def can_all_go_back(self, bodies: list[Body]) -> bool:
        """Return whether balls can be moved back to a touch, with all that hangs on their rods."""
        for body in bodies:
            if body in self.held:
                return False
            if body.joint_count:
                frame = self.frame_of.get(body)
                if body in self.stiff or (frame and not self.is_loose(frame, body)):
                    return False
        return True

    def is_loose(self, frame: Frame, body: Body) -> bool:
        """Return whether a frame can be moved back: it hangs on one rod, or flies freely."""
        if frame.hangs:
            return body in self.pivots
        odd = self.held, self.springs_of, self.bearing, self.world.forces
        return not any([ball in some for ball in frame.balls for some in odd])

    def add_partners(self, hit: list[Body]) -> None:
        """Let the balls on springs of those hit fly with them, as if nothing had hit these."""
        free = [body for body in hit if body not in self.stiff]
        springs = [spring for body in free for spring in self.springs_of.get(body, [])]
        apart = hit, self.partners, self.frame_of
        for body in [end for spring in springs for end in (spring.end_a, spring.end_b)]:
            if not (body.is_static or any([body in some for some in apart])):
                self.partners[body] = state_of(body)
                body.x, body.y, body.vx, body.vy = self.before[body]
        self.moved = {*hit, *self.partners}

    def frames_of(self, balls: list[Body]) -> list[Frame]:
        """Return each frame of rods that any of these balls is in."""
        if not self.frame_of:
            return []
        return list(dict.fromkeys([self.frame_of[b] for b in balls if b in self.frame_of]))

    def end_partners(self) -> None:
        """Put the balls that flew with others back, and note what has changed on their flight."""
        for body, state in self.partners.items():
            if body not in self.stops:
                pairs = zip(state_of(body), self.before[body], strict=True)
                self.changes.append((body, [now - before for now, before in pairs]))
            body.x, body.y, body.vx, body.vy = state
        self.moved, self.partners, self.time = set(), {}, 0.0

    def pass_on(self) -> None:
        """Let springs pass impacts on to other balls, when all are over: order would matter."""
        for body, (x, y, vx, vy) in self.changes:
            body.vx, body.vy = body.vx + vx, body.vy + vy
            if body not in self.in_contact:  # else it might get into another body
                body.x, body.y = body.x + x, body.y + y

    def fly(self, hit: list[Body], seconds: float) -> None:
        """Let balls fly back to an impact, or on. One that flies on far stops before a wall."""
        if self.springs_of and seconds < 0:
            self.add_partners(hit)
        free = self.fly_on_rods(hit, seconds) if self.frame_of else hit
        if not self.springs_of:
            is_plain = self.is_simple and not (self.bearing or self.pivots)
            for body in free:
                if seconds > 0:
                    self.bends.setdefault(body, []).append((body.x, body.y))
                acceleration = self.world.g if is_plain else self.acceleration(body)
                time = self.own_time(body, seconds) if self.contacts.stops else seconds
                self.fly_ball(body, acceleration, time)
        else:
            self.fly_on_springs([*free, *self.partners], seconds)
            if seconds > 0:
                self.end_partners()

    def fly_on_rods(self, hit: list[Body], seconds: float) -> list[Body]:
        """Let balls on rods fly for a time, or back. Return the others."""
        for body in [body for body in hit if body in self.pivots]:
            self.swing(body, seconds)
        for frame in self.frames_of([body for body in hit if body not in self.pivots]):
            self.fly_frame(frame, seconds)
        return [body for body in hit if body not in self.frame_of]

    def fly_on_springs(self, free: list[Body], seconds: float) -> None:
        """Let balls on springs fly for a time, or back, in parts: their forces change."""
        parts = self.world.substep_count
        times = [self.own_time(body, seconds) / parts for body in free]
        for _ in range(parts):
            before = [(body, self.acceleration(body)) for body in free]
            flown = [
                self.fly_ball(body, acceleration, time)
                for (body, acceleration), time in zip(before, times, strict=True)
            ]
            self.time += seconds / parts
            after = [self.acceleration(body) for body in free]  # with the same speeds for all
            for (body, acceleration), now, time in zip(before, after, flown, strict=True):
                self.adjust(body, acceleration, now, time)

    def own_time(self, body: Body, seconds: float) -> float:
        """Return for how long a ball flies: back for less time if a wall stopped it before."""
        stop = self.contacts.stops.get(body)
        if stop is None or seconds > 0:
            return seconds
        late, stop.late = stop.late, 0.0
        return min(seconds + late, 0.0)

    def fly_ball(self, body: Body, acceleration: tuple[float, float], seconds: float) -> float:
        """Let a ball fly on with an acceleration (px/s²). Return for how long (s) it could."""
        ax, ay = acceleration
        mean = (self.h + seconds) / 2
        x, y = (body.vx + ax * mean) * seconds, (body.vy + ay * mean) * seconds
        if self.stops:
            self.stops.pop(body, None)
        core = CORE * body.r
        if seconds > 0 and (body.is_bullet or x * x + y * y > core * core):
            share = self.share_before_wall(body, x, y)
            if share < 1:
                late = seconds * (1 - share)
                end = body.x + x, body.y + y, body.vx + ax * seconds, body.vy + ay * seconds
                x, y, seconds = x * share, y * share, seconds * share
                at = body.x + x, body.y + y, body.vx + ax * seconds, body.vy + ay * seconds
                self.stops[body] = Stop(at, end, seconds, late)
        body.x += x
        body.y += y
        if body.w:
            body.turn += body.w * seconds
        body.vx += ax * seconds
        body.vy += ay * seconds
        return seconds

    def share_before_wall(self, body: Body, x: float, y: float) -> float:
        """Return how much of a way (px) a ball can fly, 1 if no wall stops it."""
        known = self.walls.get(body, []) if hypot(x, y) <= DEEPEST * body.r else []
        others = [s for s in self.world.statics if s not in known]
        return free_share(body, others, core_of(body), (body.x, body.y), x, y)

    def adjust(
        self, body: Body, before: tuple[float, float], now: tuple[float, float], seconds: float
    ) -> None:
        """Adjust a velocity to the acceleration (px/s²) now, after a flight with that before."""
        (ax, ay), (now_x, now_y) = before, now
        body.vx += (now_x - ax) * (seconds - self.h) / 2
        body.vy += (now_y - ay) * (seconds - self.h) / 2

    def swing(self, body: Body, seconds: float) -> None:
        """Turn a ball about the pivot of its rod for a time, or back."""
        pivot, (ax, ay) = self.pivots[body], self.acceleration(body)
        x, y = body.x - pivot.x, body.y - pivot.y
        mean = (self.h + seconds) / 2
        spin = (x * (body.vy + ay * mean) - y * (body.vx + ax * mean)) / (x * x + y * y or 1.0)
        c, s = cos(spin * seconds), sin(spin * seconds)
        vx, vy = body.vx + ax * seconds, body.vy + ay * seconds
        body.x, body.y = pivot.x + c * x - s * y, pivot.y + s * x + c * y
        body.vx, body.vy = c * vx - s * vy, s * vx + c * vy
        body.turn += body.w * seconds
        before = c * ax - s * ay, s * ax + c * ay
        self.adjust(body, before, self.acceleration(body), seconds)

    def fly_frame(self, frame: Frame, seconds: float) -> None:
        """Let a frame fly and turn for a time, or back, as if it were rigid."""
        ax, ay = self.acceleration(frame.balls[0])
        vx, vy = frame.velocity()
        x, y, spin = frame.spin(vx, vy)
        c, s = cos(spin * seconds), sin(spin * seconds)
        way_x = x + (vx + ax * (self.h + seconds) / 2) * seconds
        way_y = y + (vy + ay * (self.h + seconds) / 2) * seconds
        for b in frame.balls:
            dx, dy, dvx, dvy = b.x - x, b.y - y, b.vx - vx, b.vy - vy
            b.x, b.y = way_x + c * dx - s * dy, way_y + s * dx + c * dy
            b.vx, b.vy = vx + c * dvx - s * dvy, vy + s * dvx + c * dvy
            b.vx += ax * seconds
            b.vy += ay * seconds
            b.turn += b.w * seconds

    def acceleration(self, body: Body) -> tuple[float, float]:
        """Return the acceleration of a body (px/s²) between impacts."""
        if not body.inv_mass:
            return 0.0, 0.0
        if self.is_simple and not (body in self.bearing or body in self.pivots):
            return self.world.g
        x, y = self.world.acceleration(body)
        for spring in self.springs_of.get(body, []) if body not in self.stiff else []:
            other = spring.other_end(body)
            if other in self.stiff:
                continue  # it does not fly along, so momentum would be lost
            here, there = state_of(body), state_of(other)
            if other not in self.moved:
                there = self.unhit(other)
                if body in self.partners and not other.is_static:  # or it alone would change
                    here = self.unhit(body)
            fx, fy = spring.pull_between(here, there)
            x, y = x + fx * body.inv_mass, y + fy * body.inv_mass
        if body in self.pivots:
            rod_x, rod_y = body.x - self.pivots[body].x, body.y - self.pivots[body].y
            share = (x * rod_x + y * rod_y) / (rod_x * rod_x + rod_y * rod_y or 1.0)
            x, y = x - share * rod_x, y - share * rod_y
        bearing = self.bearing.get(body)
        if bearing:
            for into, at in way_out([(x * c.nx + y * c.ny, c.nx, c.ny) for c in bearing]):
                x, y = x - bearing[at].nx * into, y - bearing[at].ny * into
        return x, y

    def unhit(self, body: Body) -> State:
        """Return where a ball would be now, straight on or back from where it was before."""
        x, y, vx, vy = self.before[body]
        return x + vx * self.time, y + vy * self.time, vx, vy

    def closing_acceleration(self, c: Contact) -> tuple[float, float]:
        """Return the acceleration (px/s²) with which A and B are drawn together, below 0 apart.

        Also return by how much (px/s) a velocity lags behind the position: with semi-implicit
        Euler half a substep.
        """
        falls = not c.b.inv_mass and self.world.g != (0.0, 0.0)
        if self.is_simple and not (falls or self.bearing or self.pivots):
            return 0.0, 0.0
        (ax, ay), (bx, by) = self.acceleration(c.a), self.acceleration(c.b)
        g = (ax - bx) * c.nx + (ay - by) * c.ny
        return g, g * self.h / 2

    def stiff_lag(self, c: Contact) -> float:
        """Return by how much (px/s) a closing speed lags by the stretch of springs that are stiff.

        All springs of a ball count, or one that is held between two walls would gain energy.
        """
        lag = 0.0
        for body, nx, ny in ((c.a, c.nx, c.ny), (c.b, -c.nx, -c.ny)):
            for spring in self.springs_of.get(body, []) if body in self.stiff else []:
                other = spring.other_end(body)
                dx, dy = other.x - body.x, other.y - body.y
                distance = hypot(dx, dy)
                if distance > 0:
                    share = share_before(self.h * self.h * spring.crowd)
                    pull = share * spring.k * (distance - spring.rest) * body.inv_mass  # px/s²
                    lag += pull * (dx * nx + dy * ny) / distance * self.h / 2
        return lag

    def rest(self, c: Contact) -> None:
        """Let a face bear a ball if it presses on it."""
        if c.jn > 0 and abs(c.closing_speed()) <= self.least_speed:
            self.rests.setdefault(c.a, []).append(c)
            self.bearing[c.a] = self.rests[c.a]

    def release(self, body: Body) -> None:
        """Let faces bear a ball only if it is slow there after an impact.

        Only the velocity of a ball that falls lags behind.
        """
        bearing = [c for c in self.rests[body] if abs(c.closing_speed()) <= self.least_speed]
        if bearing != self.bearing[body]:
            x, y = self.acceleration(body)
            self.bearing[body] = bearing
            now_x, now_y = self.acceleration(body)
            body.vx += (x - now_x) * self.h / 2
            body.vy += (y - now_y) * self.h / 2


def find_pivots(rods: Rods) -> dict[Body, Body]:
    """Return the pivot of each ball whose only joint is a rod to a body at rest."""
    pivots: dict[Body, Body] = {}
    for rod in rods.awake:
        for ball, pivot in ((rod.end_a, rod.end_b), (rod.end_b, rod.end_a)):
            if pivot.is_static and not pivot.is_kinematic and ball.joint_count == 1:
                pivots[ball] = pivot
    return pivots
