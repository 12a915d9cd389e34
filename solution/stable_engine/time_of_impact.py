"""The time of an impact: how long ago two bodies began to touch, and their normal then."""

from math import sqrt

from .body import state_of
from .contact import Contact, collide, is_at_face, is_over_face
from .contacts import Contacts
from .faces import Faces
from .frame import Frame
from .soft import SAME_DIRECTION
from .sweep import moment_of_touch, seen_before, was_at_face

ARC = 1.1  # ratio by which the touch may lie further back for flights on an arc
ARC_PASSES = 4  # of Newton's method, to find the touch of a ball on an arc


class TimeOfImpact:
    """Look back at the flights of two bodies, for the moment of their touch."""

    __slots__ = ("contacts", "faces", "flight", "touching_gap", "turned")

    def __init__(self, contacts: Contacts, faces: Faces) -> None:
        self.contacts = contacts
        self.faces = faces
        self.flight = faces.flight
        self.touching_gap = contacts.touching_gap
        self.turned: list[Contact] = []  # contacts with the normal of their touch

    def turn_back(self, c: Contact) -> float:
        """Turn a contact's normal back to that of the touch. Return the time (s) since then.

        A flat face of a static body has one normal, unless the ball came past its end. Other
        normals stay unless the two began to touch while both flew freely. Nothing flies through a
        wall.
        """
        a, b = c.a, c.b
        since = self.contacts.flight_of(a, b)
        if since <= 0:
            return 0.0
        is_face, stops = not b.inv_mass and is_at_face(c), self.contacts.stops
        late = self.contacts.late_by(a) if stops else 0.0
        if a.joint_count or b.joint_count:
            frame = self.flight.frame_of.get(a)
            if frame and not frame.hangs and is_face and self.flight.is_loose(frame, a):
                return self.time_on_arc(c, frame, since)
            if self.contacts.is_led_far(a) or self.contacts.is_led_far(b):
                return 0.0
        if is_face:
            ago = self.time_below(c, since)
            if ago > 0 and was_at_face(c, ago):
                return ago + late
        if stops and (late or self.contacts.late_by(b)):
            ago, nx, ny = self.contacts.look_back_late(a, b)
        else:
            ago, nx, ny = self.look_back(c, since)
            if ago == 0:
                is_arc = a in self.flight.frame_of or b in self.flight.frame_of
                ago, nx, ny = moment_of_touch(a, b, since * ARC if is_arc else since)
                ago = min(ago, since)
        turn = nx * c.nx + ny * c.ny  # a cosine
        if turn <= 0 and not b.inv_mass:
            is_through = turn < 0 and is_face and is_over_face(b, nx, ny, *seen_before(a, b, ago))
            if is_through or a.joint_count:  # with joints it did not fly straight
                return 0.0
        if ago > 0 and (nx, ny) != (c.nx, c.ny):
            c.nx, c.ny = nx, ny
            c.gap = -c.closing_speed() * ago
            self.turned.append(c)
            if is_face and (turn <= 0 or not was_at_face(c, ago)):
                self.faces.normals.pop(c, None)
        if ago > 0 and not (late or b.inv_mass) and was_at_face(c, ago):
            ago = self.time_below(c, since) or ago
        return ago

    def see_from_here(self, group: list[Contact]) -> None:
        """Take over present normals of balls on joints that stay here, but not if they differ much.

        With others, angular momentum is not kept, but balls do not pass each other.
        """
        for c in group:
            if c.b.inv_mass and (c.a.joint_count or c.b.joint_count):
                self.turn_on(c, SAME_DIRECTION)

    def turn_on(self, c: Contact, cosine: float) -> None:
        """Take over the present normal of a contact, unless it has turned further than this."""
        nx, ny, gap = collide(c.a, c.b)
        if nx * c.nx + ny * c.ny > cosine:
            c.nx, c.ny, c.gap, c.found = nx, ny, gap, gap

    def time_below(self, c: Contact, since: float) -> float:
        """Return how long ago (s) a ball fell through a flat face; 0 if not `since` then.

        In that time it may have been hit, so this has slack for a fall; a load overlaps before it.
        """
        g, lag = self.flight.closing_acceleration(c)
        closing = c.closing_speed()
        speed = (speed_at_touch(c, closing, g, lag) + closing + lag) / 2
        deeper = -c.gap - speed * since
        if c.gap >= 0 or deeper > self.slack(c, since, g):
            return 0.0
        return since if deeper >= 0 else -c.gap / speed

    def time_on_arc(self, c: Contact, frame: Frame, since: float) -> float:
        """Return how long ago (s) a ball on rods passed a flat face; 0 if not `since` then."""
        a, b, ago, gap = c.a, c.b, 0.0, c.gap
        if gap >= 0:
            return 0.0
        before = [(ball, state_of(ball), ball.turn) for ball in frame.balls]
        x, y = a.x, a.y
        for _ in range(ARC_PASSES):
            speed = c.closing_speed()
            if speed <= self.flight.least_speed or abs(gap) <= self.touching_gap:
                break
            more = min(-gap / speed, since - ago)
            ago += more
            self.flight.fly_frame(frame, -more)
            way_x, way_y = a.x - x + b.vx * ago, a.y - y + b.vy * ago
            gap = c.gap - way_x * c.nx - way_y * c.ny
        for ball, (at_x, at_y, vx, vy), turn in before:
            ball.x, ball.y, ball.vx, ball.vy, ball.turn = at_x, at_y, vx, vy, turn
        g, _ = self.flight.closing_acceleration(c)
        return ago if abs(gap) <= self.slack(c, since, g) else 0.0

    def slack(self, c: Contact, since: float, g: float) -> float:
        """Return how much deeper (px) a ball may be in a face, as it fell or was under a load."""
        return self.touching_gap + abs(g) * since * since + self.faces.depth(c)

    def look_back(self, c: Contact, since: float) -> tuple[float, float, float]:
        """Return `since` (s) and the normal if two round bodies began to close in then, else zeros.

        One of them was hit then, while they touched: by rounding alone, or under a load.
        """
        a, b = c.a, c.b
        vx, vy = b.vx - a.vx, b.vy - a.vy
        x, y = b.x - a.x - vx * since, b.y - a.y - vy * since
        distance = sqrt(x * x + y * y)
        gap = distance - a.r - b.r
        if gap > self.touching_gap or x * vx + y * vy >= 0 or not b.r:
            return 0.0, 0.0, 0.0
        was_hit = since in (self.contacts.hit_ago.get(a), self.contacts.hit_ago.get(b))
        is_loaded = was_hit and distance > 0 and not (a.joint_count or b.joint_count)
        if gap < -self.touching_gap and not is_loaded:
            return 0.0, 0.0, 0.0
        return since, x / distance, y / distance


def speed_at_touch(c: Contact, closing: float, g: float, lag: float) -> float:
    """Return how fast (px/s) a pair came together when it touched.

    For g and lag, see Flight.closing_acceleration.
    """
    speed = closing + lag
    return sqrt(max(speed * abs(speed) + 2 * g * c.gap, 0.0)) if g else speed
