"""Flat faces in the impacts of a step: a ball stays on its side of a face."""

from math import sqrt

from .contact import Contact, collide, is_at_face
from .flight import Flight
from .soft import SAME_DIRECTION


class Faces:
    """The flat faces of static bodies at which balls are, and how deep in them these were."""

    def __init__(self, flight: Flight, slow: float) -> None:
        self.flight = flight
        self.slow = slow  # px/s, slower impacts are ignored
        # their normals, and how far (px) along it the centres are at a touch
        self.normals: dict[Contact, tuple[float, float, float]] = {}
        self.depths: dict[Contact, float] = {}  # px, the gap before

    def note(self, c: Contact, depth: float) -> None:
        """Note the face that a ball is at, if any, and the gap before (px) as its depth.

        Also note whether the face bears the ball.
        """
        if c.b.is_static and is_at_face(c) and c.a not in self.flight.pivots:
            self.depths[c] = depth
            if not c.a.is_bullet:
                self.flight.walls.setdefault(c.a, []).append(c.b)
            reach = (c.b.x - c.a.x) * c.nx + (c.b.y - c.a.y) * c.ny - c.gap
            self.normals[c] = c.nx, c.ny, reach
            if c.jn > 0 and abs(c.closing_speed()) <= self.slow:
                self.flight.bearing.setdefault(c.a, []).append(c)

    def look(self, c: Contact) -> None:
        """Find normal and gap of a contact anew. A ball stays on its side of a face."""
        nx, ny, gap = collide(c.a, c.b)
        if c in self.normals:
            face_x, face_y, reach = self.normals[c]
            below = (c.b.x - c.a.x) * face_x + (c.b.y - c.a.y) * face_y - reach
            if below < 0 and nx * face_x + ny * face_y < SAME_DIRECTION:
                nx, ny, gap = face_x, face_y, below
        c.nx, c.ny, c.gap, c.found = nx, ny, gap, gap

    def added_depth(self, c: Contact) -> float:
        """Return by how much (px) a ball is deeper in a face than it was at first."""
        return min(self.depths[c], 0.0) - c.gap

    def lift(self, c: Contact) -> None:
        """Put a ball onto a face that stops it, but not higher than it was at first.

        One that leaves the face pays with its speed, as if it had risen there.
        """
        up = self.added_depth(c)
        if up > 0:
            g, lag = self.flight.pull(c)
            speed = -c.closing_speed() - lag
            if speed > 0:
                slower = speed - sqrt(max(speed * speed - 2 * g * up, 0.0))
                c.a.vx += c.nx * slower
                c.a.vy += c.ny * slower
            c.a.x -= c.nx * up
            c.a.y -= c.ny * up
            c.gap = c.found = c.gap + up
