"""Flat faces in the impacts of a step: a ball stays on its side of a face."""

from math import hypot, sqrt

from .contact import Contact, collide, is_at_face
from .cores import way_out
from .flight import Flight
from .soft import SAME_DIRECTION


class Faces:
    """The flat faces of static bodies at which balls are, and how deep in them these were."""

    __slots__ = ("flight", "normals")

    def __init__(self, flight: Flight) -> None:
        self.flight = flight
        # their normals, how far (px) along it the centres are at a touch, and the gap (px) before
        self.normals: dict[Contact, tuple[float, float, float, float]] = {}

    def note(self, c: Contact, before: float) -> None:
        """Note the face that a ball is at, if any, the gap (px) before, and whether it bears it."""
        if c.b.inv_mass == 0 and is_at_face(c) and c.a not in self.flight.pivots:
            if not c.a.is_bullet:
                self.flight.walls.setdefault(c.a, []).append(c.b)
            reach = (c.b.x - c.a.x) * c.nx + (c.b.y - c.a.y) * c.ny - c.gap
            self.normals[c] = c.nx, c.ny, reach, before
            self.flight.rest(c)

    def measure(self, c: Contact) -> None:
        """Find normal and gap of a contact anew. A ball stays on its side of a face."""
        nx, ny, gap = collide(c.a, c.b)
        if c in self.normals:
            face_x, face_y, reach, _ = self.normals[c]
            below = (c.b.x - c.a.x) * face_x + (c.b.y - c.a.y) * face_y - reach
            if below < 0 and nx * face_x + ny * face_y < SAME_DIRECTION:
                nx, ny, gap = face_x, face_y, below
        c.nx, c.ny, c.gap, c.found = nx, ny, gap, gap

    def depth(self, c: Contact) -> float:
        """Return how deep (px) a ball was in a face at first, 0 if it was not."""
        return max(-self.normals[c][3], 0.0) if c in self.normals else 0.0

    def added_depth(self, c: Contact) -> float:
        """Return by how much (px) a ball is deeper in a face than it was at first."""
        return -c.gap - self.depth(c)

    def lift(self, faces: list[Contact]) -> None:
        """Put a ball onto faces that stop it, but not higher than it was at first.

        A free frame of rods is lifted as a whole if it can pay: its rods would be stretched. What
        leaves the faces pays with its speed, as if it had risen there.
        """
        found = way_out([(self.added_depth(c), c.nx, c.ny) for c in faces])
        ways = [(far, faces[at]) for far, at in found]
        if not ways:
            return
        a, (up, c) = faces[0].a, ways[0]
        nx, ny = c.nx, c.ny
        if len(ways) > 1:
            nx, ny = sum([c.nx * far for far, c in ways]), sum([c.ny * far for far, c in ways])
            up = hypot(nx, ny)
            nx, ny = nx / up, ny / up
        frame, lifted = self.flight.frame_of.get(a), [a]
        g, speed = self.leave(ways, up, a.vx, a.vy)
        if frame and not frame.hangs:
            whole_g, whole_speed = self.leave(ways, up, *frame.velocity())
            if max(whole_speed, 0.0) ** 2 >= 2 * whole_g * up:  # else it would rise for nothing
                lifted, g, speed = frame.balls, whole_g, whole_speed
        if speed > 0:
            slower = speed - sqrt(max(speed * speed - 2 * g * up, 0.0))
            for ball in lifted:
                ball.vx += nx * slower
                ball.vy += ny * slower
        for ball in lifted:
            ball.x -= nx * up
            ball.y -= ny * up
        for c in faces:
            self.measure(c)

    def leave(
        self, ways: list[tuple[float, Contact]], up: float, vx: float, vy: float
    ) -> tuple[float, float]:
        """Return the pull (px/s²) back to faces, and the speed (px/s) away from them.

        `ways` lead `up` px out of them in all; vx and vy are the velocity of what leaves.
        """
        g = speed = 0.0
        for far, c in ways:
            pull, lag = self.flight.closing_acceleration(c)
            closing = (vx - c.b.vx) * c.nx + (vy - c.b.vy) * c.ny
            g += far / up * pull
            speed -= far / up * (closing + lag)
        return g, speed
