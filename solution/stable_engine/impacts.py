"""Impacts: their order, those at one moment, and the positions afterwards."""

from collections import defaultdict
from math import hypot, inf

from .body import Body, State, state_of
from .bounds import Pair, pair_number
from .contact import Contact, collide, leave_as_entered
from .contacts import Contacts
from .detection import FAR
from .faces import Faces
from .flight import DEEPEST, Flight
from .frame import Frame
from .impact_queue import ImpactQueue
from .law import resolve
from .order import balls_of
from .sweep import has_entered, moment_of_touch, was_at_face
from .time_of_impact import ARC_PASSES, TimeOfImpact

MOVED = 0.01  # radii; a ball that was hit and moved by less meets nothing new


class Impacts:
    """The impacts of one step, until no pair closes in fast any more.

    The earliest impact in the world comes first. At one moment the hardest comes first, equally
    hard ones together: so an impact travels through a row of balls, and a mirrored scene stays
    mirrored. Pairs that still close in slowly are left to the next step.

    A contact is found after the touch, so balls are moved back to it, along the way they flew: see
    Flight. There they bounce, by the normal at the touch, and fly on. So nothing is left in a wall
    or in another ball, from which a push would lift it for nothing, and angular momentum is kept.
    If they meet others on the way, these impacts join the queue. Where the way back is not known,
    on stiff springs, hanging chains and static corners that they touched before, balls stay; energy
    gives their speeds. Rods pass an impact on at once: they are rows beside the contacts, and all
    are solved together.
    """

    __slots__ = (
        *("begun", "contacts", "touching_gap", "dt", "reach", "least_speed", "queue", "passing"),
        *("beside", "flight", "frame_of", "faces", "times", "returned", "met"),
    )

    def __init__(self, contacts: Contacts, least_speed: float, h: float) -> None:
        self.begun = set(contacts.begun)
        self.contacts = contacts
        self.touching_gap = contacts.touching_gap
        self.dt = h * contacts.world.substep_count  # s
        self.reach = contacts.speculative_speed * self.dt  # px, a gap that slow ones close at once
        self.least_speed = least_speed  # px/s, slower impacts are ignored
        self.queue = ImpactQueue(self.touching_gap)
        self.passing: dict[Body, State] = {}  # balls that fly on into walls, and where they stopped
        self.beside: dict[Body, list[Contact]] = defaultdict(list)  # the contacts of each ball
        self.flight = Flight(contacts, h, least_speed)
        self.frame_of = self.flight.frame_of
        self.faces = Faces(self.flight)
        self.times = TimeOfImpact(contacts, self.faces)
        self.returned: list[Frame] = []  # frames a ball of which a wall stopped
        self.met: list[Contact] = []  # contacts that began through an impact

    def find(self, fast: list[Contact]) -> None:
        """Find all impacts of fast bodies. For a new contact, the moment of its touch counts."""
        for c in self.contacts.statics.contacts:
            self.faces.note(c, c.gap)
        if self.contacts.may_pass():
            self.let_pass()
            self.queue.due.clear()
            fast = select_fast(self.contacts.touching, self.least_speed)
        for c in fast:
            self.find_impact(c, c in self.begun or c.a.flown < inf or c.b.flown < inf)

    def let_pass(self) -> None:
        """Let balls that a face stopped fly on to the end of the step, if they will bounce off it.

        They are moved back to the touch from there, so no time is lost.
        """
        self.link(self.contacts.touching)
        stopped: dict[Frame, float] = {}
        for body, stop in self.contacts.stops.items():
            if stop.end and state_of(body) == stop.at:
                flown, late = body.flown, stop.late
                since = self.contacts.last_dt - stop.time
                body.flown, stop.late = flown + since, 0.0
                if self.try_to_pass(body, stop.end):
                    continue
                body.flown, stop.late = flown, late
                frame = self.frame_of.get(body)
                if frame and not frame.hangs:
                    stopped[frame] = max(since, stopped.get(frame, 0.0))
        for frame, since in stopped.items():
            if not any([ball in self.flight.springs_of for ball in frame.balls]):
                self.rewind_frame(frame, since)
                self.returned.append(frame)

    def rewind_frame(self, frame: Frame, ago: float) -> None:
        """Let a frame fly back to a touch, as a wall stopped one of its balls so long (s) ago.

        Without the others, the ball would be off the lengths of its rods.
        """
        walls: list[Contact] = []
        for ball in frame.balls:
            stop = self.contacts.stops.get(ball)
            if stop and stop.end:
                walls += [c for c in self.beside.get(ball, []) if c.b.is_static]
                ball.x, ball.y, ball.vx, ball.vy = stop.end
                self.passing.pop(ball, None)
        left = self.contacts.last_dt
        for _ in range(ARC_PASSES):
            self.flight.fly_frame(frame, -ago)
            left -= ago
            for c in walls:
                self.faces.measure(c)
            walls = [c for c in walls if c.closing_speed() > self.least_speed]
            if not walls:
                break
            ago = min(max([-c.gap / c.closing_speed() for c in walls]), left)
        for ball in frame.balls:
            for c in self.beside.get(ball, []):
                self.faces.measure(c)

    def try_to_pass(self, body: Body, end: State) -> bool:
        """Put a ball that a wall stopped where it would be, if it will bounce off from there."""
        stop = state_of(body)
        is_near = hypot(end[0] - stop[0], end[1] - stop[1]) <= DEEPEST * body.r
        if not (is_near and self.flight.can_all_go_back([body])):
            return False
        walls = [c for c in self.beside.get(body, []) if c.b.is_static]
        self.put(body, end)
        walls = [c for c in walls if not self.find_impact(c, c in self.begun)]
        known = {c for c in walls if c in self.queue.due and self.queue.due[c][0] < 0}
        sunk = [c for c in walls if self.faces.added_depth(c) > self.touching_gap]
        if known and known.issuperset(sunk):
            self.passing[body] = stop
            return True
        self.put(body, stop)
        return False

    def return_to_stops(self, bodies: list[Body]) -> None:
        """Put balls that walls stopped back there, as they will not bounce off them."""
        for body in bodies:
            if body in self.contacts.stops:
                self.contacts.stops[body].late = 0.0
            if body in self.passing:
                self.put(body, self.passing.pop(body))

    def put(self, body: Body, state: State) -> None:
        """Put a ball that nothing has hit yet elsewhere."""
        body.x, body.y, body.vx, body.vy = state
        if body in self.flight.before:
            self.flight.before[body] = state
        for c in self.beside.get(body, []):
            self.faces.measure(c)

    def find_impact(self, c: Contact, is_new: bool = False) -> bool:
        """Note an impact if the pair closes in fast, or did before it passed each other.

        Return whether it would be at a corner that another body covers: this is no impact.
        """
        self.queue.due.pop(c, None)
        if not is_new and (c.closing_speed() <= self.least_speed or self.is_open(c)):
            return False
        now = c.nx, c.ny, c.gap
        ago = self.times.turn_back(c) if c.gap < 0 or is_new else 0.0
        speed = c.closing_speed()
        is_covered = speed > self.least_speed and not c.b.r and self.is_covered(c, ago)
        if is_covered or speed <= self.least_speed:
            c.nx, c.ny, c.gap = now
        elif ago > 0 or not self.is_open(c):
            self.queue.add(c, ago, speed)
        return is_covered

    def is_covered(self, c: Contact, ago: float = 0.0) -> bool:
        """Return whether a ball was at a corner some seconds ago that another body covers.

        If it touched that body in this step and has left it since, the two meet.
        """
        pair = self.contacts.find_cover(c, ago)
        if pair and pair.contact is None:
            self.meet_cover(pair)
        return pair is not None

    def meet_cover(self, pair: Pair) -> None:
        """Add the contact of a ball and a static body that it touched, and then flew past."""
        a, b = pair.a, pair.b
        ago, nx, ny = moment_of_touch(a, b, self.contacts.flight_of(a, b))
        if ago > 0:
            if not self.beside:
                self.link(self.contacts.touching)
            c = self.contacts.meet(pair, nx, ny, ((b.vx - a.vx) * nx + (b.vy - a.vy) * ny) * ago)
            self.contacts.events.note_hit(c, ago)
            self.add_contacts([c])
            self.find_impact(c, is_new=True)

    def uncover(self, group: list[Contact]) -> list[Contact]:
        """Return contacts, those of other bodies instead where these cover their corners now."""
        found: dict[Contact, None] = {}
        for c in group:
            pair = None if c.b.r else self.contacts.find_cover(c)
            if pair and pair.contact:
                c = pair.contact
                self.faces.measure(c)
            found[c] = None
        return list(found)

    def is_open(self, c: Contact) -> bool:
        """Return whether a pair is still to meet: they are apart, far or fast."""
        if c.gap <= self.touching_gap:
            return False
        return c.gap > self.reach or c.closing_speed() * self.dt > FAR * (c.a.r + c.b.r)

    def resolve_all(self) -> None:
        """Resolve all impacts, and those that they cause, until no pair closes in fast."""
        if not self.beside:
            self.link(self.contacts.touching)
        while self.queue.due:
            self.resolve_first()
        if self.passing:
            self.return_to_stops(list(self.passing))
        for c in self.times.turned:
            if c.gap != c.found:  # else it was measured since
                self.times.turn_on(c, 0.0)
        deep: dict[Body, list[Contact]] = {}
        for c in self.faces.normals:
            self.faces.measure(c)
            if c.gap < 0:
                deep.setdefault(c.a, []).append(c)
        for faces in deep.values():
            self.faces.lift(faces)
        self.flight.pass_on()
        self.contacts.drop_untouched(self.begun.difference(self.queue.counts))
        if self.contacts.crowd:
            self.leave_crowd()
        self.keep_inside()

    def leave_crowd(self) -> None:
        """Take pairs out of the crowd that impacts have moved apart: they only seemed deep.

        They would be pushed apart when they next meet, before their impact.
        """
        crowd = self.contacts.crowd.items()
        self.contacts.crowd = {c: put for c, put in crowd if c.found <= -self.touching_gap}

    def keep_inside(self) -> None:
        """Stop balls before walls, if an impact took them through: on them, or by a joint."""
        contacts, phase = self.contacts, self.contacts.broad_phase
        moved = [*contacts.hit_ago]
        if self.flight.springs_of or self.frame_of:
            moved += [body for body, _ in self.flight.changes]
            frames = [*self.flight.frames_of(moved), *self.returned]
            moved += [ball for frame in frames for ball in frame.balls]
            moved = list(dict.fromkeys(moved))
        bends, beside = self.flight.bends, self.beside
        stopped: list[Body] = []
        for body in moved:
            if body not in contacts.hit_ago:
                contacts.note_impact(body, 0.0)  # so the next step may stop it before a wall
            phase.lead(phase.rooms[body])
            if contacts.cores.stop_hit(body, beside.get(body, []), bends.get(body, [])):
                stopped.append(body)
        if stopped:
            self.find_pairs(stopped)

    def is_alone(self, c: Contact) -> bool:
        """Return whether an impact affects no other contact."""
        if self.frame_of and (c.a in self.frame_of or c.b in self.frame_of):
            return False
        return len(self.beside[c.a]) == 1 and not (c.b.inv_mass and len(self.beside[c.b]) > 1)

    def resolve_alone(self, c: Contact, ago: float) -> list[Body]:
        """Resolve an impact, some seconds ago, that affects no other contact. Return its balls."""
        hit = [c.a, c.b] if c.b.inv_mass else [c.a]
        if ago > 0 and self.flight.can_all_go_back(hit):
            self.resolve_at_touch([c], hit, ago, [])
            self.faces.measure(c)
            for body in hit:
                self.note_impact(body, ago)
        else:
            self.return_to_stops(hit)
            resolve([c], [], self.flight)
        return hit

    def resolve_first(self) -> None:
        """Resolve the first impacts, and find those that they cause."""
        group, ago = self.queue.take_first()
        events = self.contacts.events
        for c in group if events.hits or events.again else []:
            is_new = c in self.begun or c in events.again
            if is_new and c in events.hits and self.queue.counts[c] == 1:
                events.note_hit(c, ago)
            events.again.pop(c, None)
        foreseen = self.contacts.landings.speeds
        for c in group if foreseen else []:
            if foreseen.pop(c, None) is not None:
                events.note_hit(c, ago)
        if len(group) == 1 and self.is_alone(group[0]):
            hit = self.resolve_alone(group[0], ago)
        else:
            hit = self.resolve_together(group, ago)
        self.meet_others(hit)

    def resolve_together(self, group: list[Contact], ago: float) -> list[Body]:
        """Resolve impacts of one moment, some seconds ago, with all rods. Return their balls."""
        hit = balls_of(group)
        if ago > 0 and not self.flight.can_all_go_back(hit):
            self.return_passed(group, ago)
            ago = 0.0
        if ago == 0:
            self.return_to_stops(hit)
            self.times.see_from_here(group)
        frames = self.flight.frames_of(hit)
        for frame in frames:
            others = [ball for ball in frame.balls if ball in self.beside or ball.is_bullet]
            hit += [ball for ball in others if ball not in hit]
        if ago > 0:
            self.resolve_at_touch(group, hit, ago, frames)
        else:
            resolve(group, frames, self.flight)
        self.look_around(hit, ago)
        return hit

    def return_passed(self, group: list[Contact], ago: float) -> None:
        """Return balls to a touch, some seconds ago, if they have passed others that stay here."""
        passed = []
        for c in group:
            nx, ny, _ = collide(c.a, c.b)
            if c.b.inv_mass and (c.a.vx - c.b.vx) * nx + (c.a.vy - c.b.vy) * ny < 0:
                passed.append(c)
        for body in balls_of(passed):
            if self.flight.can_all_go_back([body]):
                self.flight.fly([body], -ago)
                self.passing.pop(body, None)
                for c in self.beside[body]:
                    self.faces.measure(c)

    def resolve_at_touch(
        self, group: list[Contact], hit: list[Body], ago: float, frames: list[Frame]
    ) -> None:
        """Move bodies back to the touch, some seconds ago. Resolve it, and let them fly on."""
        walls: dict[Body, tuple[float, float]] = {}
        for c in group:
            wall = c.b
            if not wall.inv_mass and (wall.vx or wall.vy) and wall not in walls:
                walls[wall] = wall.x, wall.y
                if wall.is_kinematic:
                    wall.x -= wall.vx * ago
                    wall.y -= wall.vy * ago
                elif c in self.faces.normals:
                    back = (wall.vx * c.nx + wall.vy * c.ny) * ago  # a belt does not move
                    wall.x -= c.nx * back
                    wall.y -= c.ny * back
        self.flight.fly(hit, -ago)
        for body in hit if self.passing else []:
            self.passing.pop(body, None)
        for c in group:
            self.faces.measure(c)
        resolve(self.uncover(group) if frames else group, frames, self.flight)
        for wall, (x, y) in walls.items():
            wall.x, wall.y = x, y
        self.flight.fly(hit, ago)

    def note_impact(self, body: Body, ago: float) -> None:
        """Note that a ball was hit some seconds ago, and has flown since, or until a wall."""
        stop = self.flight.stops.get(body)
        if stop:
            ago = max(ago - stop.late, 0.0)
        self.contacts.note_impact(body, ago)

    def look_around(self, hit: list[Body], ago: float) -> None:
        """Find impacts of balls that were hit, and perhaps moved back to the moment of the hit."""
        for body in hit:
            self.note_impact(body, ago)
        around = list(dict.fromkeys([c for body in hit for c in self.beside[body]]))
        if ago > 0:
            for c in around:
                self.faces.measure(c)
        for c in around:
            self.queue.due.pop(c, None)
        for c in select_fast(around, self.least_speed):
            self.find_impact(c, is_new=ago > 0)

    def link(self, contacts: list[Contact]) -> None:
        """Add to the contacts of each ball, and to the balls that static bodies hold."""
        for c in contacts:
            self.beside[c.a].append(c)
            if c.b.inv_mass:
                self.beside[c.b].append(c)
            elif not (c in self.faces.normals or c in self.begun or self.is_covered(c)):
                self.flight.held.add(c.a)

    def find_pairs(self, moved: list[Body]) -> None:
        """Find the near pairs of bodies that impacts have moved, if out of their rooms."""
        phase, thrown = self.contacts.broad_phase, []
        for body in moved:
            if not phase.rooms[body].holds():
                thrown.append(body)
        if thrown:
            found = phase.follow(thrown, self.dt, self.reach)
            self.contacts.add_pairs(found)

    def meet_others(self, hit: list[Body]) -> None:
        """Find impacts of balls that were hit with bodies which they did not touch before."""
        met: list[Contact] = []
        self.find_pairs(hit)
        for body in hit:
            x, y, far = body.x - body.last_x, body.y - body.last_y, MOVED * body.r
            if x * x + y * y > far * far:
                for pair in self.contacts.broad_phase.rooms[body].pairs:
                    if pair.contact is None:
                        self.add_if_touching(pair, met)
        if met:
            self.take_in(met, hit)

    def take_in(self, met: list[Contact], hit: list[Body]) -> None:
        """Find the impacts of contacts that began as balls were hit."""
        self.add_contacts(met)
        for body in hit:
            stop = self.flight.stops.get(body)
            if stop and stop.end and any([c.a is body and c.b.is_static for c in met]):
                flown = body.flown
                self.contacts.note_impact(body, flown + stop.late)
                if not self.try_to_pass(body, stop.end):
                    self.contacts.note_impact(body, flown)
        for c in met:
            self.find_impact(c, is_new=True)

    def add_contacts(self, met: list[Contact]) -> None:
        """Take in contacts that began through impacts."""
        self.met += met
        self.begun.update(met)
        for c in met:
            self.faces.note(c, 0.0)
        self.link(met)

    def add_if_touching(self, pair: Pair, met: list[Contact]) -> None:
        """Add the contact of a near pair to those that have met, if impacts have made it touch."""
        a, b, ignored = pair.a, pair.b, self.contacts.ignored
        if a in self.passing or b in self.passing or (ignored and pair_number(a, b) in ignored):
            return
        if b.inv_mass:
            nx, ny, gap = collide(a, b)
        else:
            nx, ny, gap = seen_from_start(a, b, self.contacts.flight_of(a, b))
        dx, dy = (a.vx - b.vx) * self.dt, (a.vy - b.vy) * self.dt
        if gap > 0 and gap * gap > dx * dx + dy * dy:
            return
        if gap < 0 or self.contacts.have_passed(a, b, gap):
            c = self.contacts.meet(pair, nx, ny, gap)
            self.contacts.events.note_hit(c)
            met.append(c)


def select_fast(contacts: list[Contact], least_speed: float) -> list[Contact]:
    """Return the contacts whose bodies have velocities that differ by more than this (px/s)."""
    fast: list[Contact] = []
    square = least_speed * least_speed
    for c in contacts:
        a, b = c.a, c.b
        vx, vy = a.vx - b.vx, a.vy - b.vy
        if vx * vx + vy * vy > square:
            fast.append(c)
    return fast


def seen_from_start(a: Body, b: Body, since: float) -> tuple[float, float, float]:
    """Return normal and gap of a ball and a static body, from the side where the ball was.

    A ball that flew past the end of a segment, straight since so long (s) ago, is not behind it.
    """
    before, now, x, y = Contact(a, b), collide(a, b), a.x, a.y
    a.x, a.y = a.last_x, a.last_y
    before.nx, before.ny, _ = collide(a, b)
    a.x, a.y = x, y
    seen = leave_as_entered(before, *now)
    if b.segment is None or seen == now:
        return seen
    ago, nx, ny = moment_of_touch(a, b, since)
    if ago > 0:
        if was_at_face(before, ago):
            return seen
        return nx, ny, ((b.vx - a.vx) * nx + (b.vy - a.vy) * ny) * ago
    return seen if has_entered(a, b) else now
