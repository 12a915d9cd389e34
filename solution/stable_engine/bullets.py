"""Bullets: fast balls do not pass through static bodies."""

from math import copysign, hypot, sqrt

from .body import Body
from .contacts import RESTING_SPEED, Contacts
from .effect import Effect
from .world import World

SWEEP_FROM = 0.5  # radii, a bullet that moves further in one step is swept
OVERLAP = 0.05  # radii, how deep a stopped bullet overlaps, so that the next step finds the contact
NO_HIT = 1.0


class Bullets(Effect):
    """Continuous collision detection: a bullet's step is swept, and ends where it first hits.

    The step counts as one straight flight. Only the position is put back. The bullet keeps its
    velocity, so that the next step finds a contact and resolves the impact.
    """

    rank = 7

    def __init__(self) -> None:
        self.bullets: list[Body] = []

    def attach(self, world: World) -> None:
        super().attach(world)
        self.contacts: Contacts = world.need("Contacts", self)

    def add(self, body: Body) -> None:
        self.bullets.append(body)

    def impact(self, h: float) -> None:
        """Stop a bullet that did not bounce: a soft contact would give way too far."""
        if self.bullets:
            for c in self.contacts.touching:
                if (c.a.bullet or c.b.bullet) and c.closing_speed() > RESTING_SPEED:
                    self.contacts.apply_impact(c, c.closing_speed())

    def prepare(self, h: float) -> None:
        self.starts = [(bullet.x, bullet.y) for bullet in self.bullets]

    def finish(self, h: float) -> None:
        for bullet, (x, y) in zip(self.bullets, self.starts, strict=True):
            dx, dy = bullet.x - x, bullet.y - y
            length = hypot(dx, dy)
            if length > SWEEP_FROM * bullet.radius:
                fraction = self.first_hit(bullet.radius, x, y, dx, dy)
                if fraction < NO_HIT:
                    fraction = min(fraction + OVERLAP * bullet.radius / length, 1.0)
                    bullet.x, bullet.y = x + dx * fraction, y + dy * fraction

    def first_hit(self, radius: float, x: float, y: float, dx: float, dy: float) -> float:
        """The time of impact of a ball that moves from (x, y) by (dx, dy), or NO_HIT.

        As a fraction of the step, 0 at its start and 1 at its end.
        """
        fraction = NO_HIT
        for s in self.world.statics:
            hit = hit_circle if s.radius else hit_box
            fraction = min(fraction, hit(s, radius, x - s.x, y - s.y, dx, dy))
        return fraction


def hit_circle(s: Body, radius: float, x: float, y: float, dx: float, dy: float) -> float:
    """The time of impact with a circle; the ball starts at (x, y) from the centre of s."""
    return hit_point(s.radius + radius, x, y, dx, dy)


def hit_box(s: Body, radius: float, x: float, y: float, dx: float, dy: float) -> float:
    """The time of impact with a box: a point against its faces moved out, its corners rounded."""
    enter, leave = 0.0, NO_HIT
    for start, move, half in ((x, dx, s.hx + radius), (y, dy, s.hy + radius)):
        if move == 0:
            if abs(start) >= half:
                return NO_HIT
        else:
            side = copysign(half, move)
            enter = max(enter, (-side - start) / move)
            leave = min(leave, (side - start) / move)
    if enter == 0 or enter >= leave:
        return NO_HIT
    at_x, at_y = x + dx * enter, y + dy * enter
    if abs(at_x) > s.hx and abs(at_y) > s.hy:
        return hit_point(radius, x - copysign(s.hx, at_x), y - copysign(s.hy, at_y), dx, dy)
    return enter


def hit_point(reach: float, x: float, y: float, dx: float, dy: float) -> float:
    """The time at which something that starts at (x, y) from a point is within reach (px)."""
    length2, ahead, outside = dx * dx + dy * dy, x * dx + y * dy, x * x + y * y - reach * reach
    root2 = ahead * ahead - length2 * outside
    if outside <= 0 or ahead >= 0 or root2 < 0:
        return NO_HIT
    return (-ahead - sqrt(root2)) / length2
