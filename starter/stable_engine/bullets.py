"""Bullets: fast balls do not pass through static bodies."""

from math import copysign, hypot, sqrt

from .body import Body
from .contacts import RESTING_SPEED, Contacts
from .effect import Effect
from .world import World

FAR = 0.5  # radii, who moves further in one step is swept
BITE = 0.05  # radii, how deep a stopped bullet overlaps, so that the next step finds the contact
NEVER = 1.0


class Bullets(Effect):
    """Replays a bullet's step as one straight flight and stops it where it first hits.

    Only its place changes. It keeps its velocity, and the next step answers the blow.
    """

    rank = 7

    def __init__(self) -> None:
        self.bullets: list[Body] = []

    def join(self, world: World) -> None:
        super().join(world)
        self.contacts: Contacts = world.need("Contacts", self)

    def take(self, body: Body) -> None:
        self.bullets.append(body)

    def impact(self, h: float) -> None:
        """Stop a bullet that did not bounce: it is too fast to be stopped softly."""
        if self.bullets:
            for c in self.contacts.touching:
                if (c.a.bullet or c.b.bullet) and c.closing_speed() > RESTING_SPEED:
                    self.contacts.blow(c, c.closing_speed())

    def prepare(self, h: float) -> None:
        self.starts = [(bullet.x, bullet.y) for bullet in self.bullets]

    def finish(self, h: float) -> None:
        for bullet, (x, y) in zip(self.bullets, self.starts, strict=True):
            dx, dy = bullet.x - x, bullet.y - y
            way = hypot(dx, dy)
            if way > FAR * bullet.radius:
                share = self.first_hit(bullet.radius, x, y, dx, dy)
                if share < NEVER:
                    share = min(share + BITE * bullet.radius / way, 1.0)
                    bullet.x, bullet.y = x + dx * share, y + dy * share

    def first_hit(self, radius: float, x: float, y: float, dx: float, dy: float) -> float:
        """The share of its way (dx, dy) from (x, y) that a ball flies freely, or NEVER."""
        share = NEVER
        for s in self.world.statics:
            hit = hit_circle if s.radius else hit_box
            share = min(share, hit(s, radius, x - s.x, y - s.y, dx, dy))
        return share


def hit_circle(s: Body, radius: float, x: float, y: float, dx: float, dy: float) -> float:
    """When the ball, now at (x, y) from the centre of s, hits a circle."""
    return hit_point(s.radius + radius, x, y, dx, dy)


def hit_box(s: Body, radius: float, x: float, y: float, dx: float, dy: float) -> float:
    """When it hits a box: its faces moved out by radius, its corners rounded."""
    enter, leave = 0.0, NEVER
    for start, way, half in ((x, dx, s.hx + radius), (y, dy, s.hy + radius)):
        if way == 0:
            if abs(start) >= half:
                return NEVER
        else:
            side = copysign(half, way)
            enter = max(enter, (-side - start) / way)
            leave = min(leave, (side - start) / way)
    if enter == 0 or enter >= leave:
        return NEVER
    at_x, at_y = x + dx * enter, y + dy * enter
    if abs(at_x) > s.hx and abs(at_y) > s.hy:
        return hit_point(radius, x - copysign(s.hx, at_x), y - copysign(s.hy, at_y), dx, dy)
    return enter


def hit_point(reach: float, x: float, y: float, dx: float, dy: float) -> float:
    """When something at (x, y) from a point comes within reach of it."""
    way2, ahead, outside = dx * dx + dy * dy, x * dx + y * dy, x * x + y * y - reach * reach
    root2 = ahead * ahead - way2 * outside
    if outside <= 0 or ahead >= 0 or root2 < 0:
        return NEVER
    return (-ahead - sqrt(root2)) / way2
