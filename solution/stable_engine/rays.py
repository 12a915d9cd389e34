"""Cast rays: which body a straight line meets first, and where."""

from math import copysign, hypot
from typing import NamedTuple

from pygame import Vector2

from .body import Body
from .sweep import NO_HIT, hit_body, seen_from_nearest, stay_in_box

ROUNDING = 1e-12  # share of the way, and of a box, by which a ray may miss an edge


class RayHit(NamedTuple):
    """Where a ray first meets a body."""

    body: Body
    point: Vector2  # px
    normal: Vector2  # unit vector, out of the body
    distance: float  # px, from the start of the ray


def cast_ray(
    bodies: list[Body], start: tuple[float, float], end: tuple[float, float]
) -> RayHit | None:
    """Return where a ray from start first meets one of the bodies, at its end or before, or None.

    Edges belong to bodies: a ray along the edge of a box meets the box. At equal distances, the
    first body in the list counts.
    """
    x, y = start
    dx, dy = end[0] - x, end[1] - y
    nearest, met = 1 + 2 * ROUNDING, None
    if not (dx or dy):
        return None
    for body in bodies:
        # on twice the way, as hits at the very end do not count there
        fraction = 2 * meet_body(body, x - body.x, y - body.y, 2 * dx, 2 * dy)
        if fraction < nearest:
            nearest, met = fraction, body
    if met is None:
        return None
    nearest = min(nearest, 1.0)
    x, y = x + dx * nearest, y + dy * nearest
    normal = normal_at(met, x - met.x, y - met.y, dx, dy)
    return RayHit(met, Vector2(x, y), Vector2(normal), hypot(dx, dy) * nearest)


def meet_body(body: Body, x: float, y: float, dx: float, dy: float) -> float:
    """Return the share of the way at which a ray from (x, y) enters a body, or NO_HIT."""
    if body.r or body.segment is not None:
        return hit_body(body, 0.0, x, y, dx, dy)
    enter, leave = stay_in_box(x, y, dx, dy, body.hx, body.hy, ROUNDING * (body.hx + body.hy))
    return enter if 0 < enter <= leave else NO_HIT


def normal_at(body: Body, x: float, y: float, dx: float, dy: float) -> tuple[float, float]:
    """Return the unit normal of a body where a ray enters it, at (x, y) from its centre."""
    wall = body.segment
    if wall is not None and wall.rim == 0:
        side = copysign(1.0, dx * wall.uy - dy * wall.ux)
        return -wall.uy * side, wall.ux * side
    if wall is None and not body.r:
        if dy == 0 or (dx != 0 and body.hx - abs(x) < body.hy - abs(y)):
            return copysign(1.0, x), 0.0
        return 0.0, copysign(1.0, y)
    x, y = seen_from_nearest(body, x, y)
    distance = hypot(x, y)
    return x / distance, y / distance
