"""Continuous collision detection: find where a ball's flight first hits a static body."""

from math import copysign, sqrt

from .body import Body
from .contact import Contact, is_over_face
from .shapes import Segment

NO_HIT = 1.0
BEFORE = 0.01  # radii that are left between a ball and a wall
GRAZING = 1e-9  # share of a distance: a ball that flies along a wall does not hit it


def moment_of_touch(a: Body, b: Body, dt: float) -> tuple[float, float, float]:
    """Return how long ago (s) a ball began to touch a body, and the unit normal from A to B then.

    Both have flown straight since. Return 0 if they did not begin to touch within dt seconds.
    """
    stays = b.inv_mass == 0 and not b.is_kinematic
    vx, vy = (a.vx, a.vy) if stays else (a.vx - b.vx, a.vy - b.vy)
    dx, dy = vx * dt, vy * dt
    x, y = a.x - b.x - dx, a.y - b.y - dy
    fraction = hit_body(b, a.r, x, y, dx, dy)
    if fraction >= NO_HIT:
        return 0.0, 0.0, 0.0
    x, y = seen_from_nearest(b, x + dx * fraction, y + dy * fraction)
    distance = sqrt(x * x + y * y)
    return (1 - fraction) * dt, -x / distance, -y / distance


def seen_before(a: Body, b: Body, ago: float) -> tuple[float, float]:
    """Return where a ball was some seconds ago, seen from the centre of B. Both flew straight."""
    x, y = a.x - b.x - a.vx * ago, a.y - b.y - a.vy * ago
    if b.is_static and not b.is_kinematic:
        return x, y  # a belt does not move
    return x + b.vx * ago, y + b.vy * ago


def was_at_face(c: Contact, ago: float) -> bool:
    """Return whether a ball with the normal of a contact was at a flat face some seconds ago."""
    return is_over_face(c.b, c.nx, c.ny, *seen_before(c.a, c.b, ago))


def first_hit(
    statics: list[Body], radius: float, x: float, y: float, dx: float, dy: float
) -> float:
    """Return the time of impact of a ball that moves from (x, y) by (dx, dy), or NO_HIT.

    The time is a fraction of the step: 0 at its start, 1 at its end.
    """
    fraction = NO_HIT
    for s in within_reach(statics, radius, x, y, dx, dy):
        fraction = min(fraction, hit_body(s, radius, x - s.x, y - s.y, dx, dy))
    return fraction


def has_entered(a: Body, b: Body) -> bool:
    """Return whether the centre of a ball entered a static body on its straight way in the step."""
    x, y = a.last_x - b.x, a.last_y - b.y
    return hit_body(b, 0.0, x, y, a.x - a.last_x, a.y - a.last_y) < NO_HIT


def drop_covered(
    statics: list[Body], radius: float, x: float, y: float, dx: float, dy: float, edge: float
) -> list[Body]:
    """Return the bodies that a ball on its way may meet, but not at a corner that others cover."""
    near, kept = within_reach(statics, radius, x, y, dx, dy), []
    for s in near:
        fraction = hit_body(s, radius, x - s.x, y - s.y, dx, dy)
        at_x, at_y = x + dx * fraction, y + dy * fraction
        far_x, far_y = seen_from_nearest(s, at_x - s.x, at_y - s.y)
        share = -radius / (sqrt(far_x * far_x + far_y * far_y) or 1.0)
        to = far_x * share, far_y * share
        others = [other for other in near if other is not s and fraction < NO_HIT]
        if not any([covers(o, at_x - o.x, at_y - o.y, *to, edge) for o in others]):
            kept.append(s)
    return kept


def covers(s: Body, x: float, y: float, to_x: float, to_y: float, edge: float) -> bool:
    """Return whether a point is on a body, along which a ball at (x, y) comes nearer.

    The point is (to_x, to_y) from the ball's centre, and up to `edge` px off the body.
    """
    reach = sqrt(to_x * to_x + to_y * to_y)
    if distance_from(s, x, y) >= reach * (1 - GRAZING):
        return False
    return distance_from(s, x + to_x, y + to_y) <= edge


def first_stop(
    statics: list[Body], radius: float, x: float, y: float, dx: float, dy: float
) -> float:
    """Return the time of impact as first_hit does. A ball that starts closer gets no closer."""
    fraction = NO_HIT
    for s in within_reach(statics, radius, x, y, dx, dy):
        near = min(radius, distance_from(s, x - s.x, y - s.y) * (1 - GRAZING))
        fraction = min(fraction, hit_body(s, near, x - s.x, y - s.y, dx, dy))
    return fraction


def within_reach(
    statics: list[Body], radius: float, x: float, y: float, dx: float, dy: float
) -> list[Body]:
    """Return the bodies whose boxes a ball that moves from (x, y) by (dx, dy) may touch."""
    reach_x, reach_y = abs(dx) + radius, abs(dy) + radius
    near: list[Body] = []
    for s in statics:
        if abs(x - s.x) <= s.hx + reach_x and abs(y - s.y) <= s.hy + reach_y:
            near.append(s)
    return near


def distance_from(s: Body, x: float, y: float) -> float:
    """Return how far (px) a point, seen from the centre of s, is from that body: 0 if inside."""
    rim = s.r if s.segment is None else s.segment.rim
    x, y = seen_from_nearest(s, x, y)
    return max(sqrt(x * x + y * y) - rim, 0.0)


def seen_from_nearest(s: Body, x: float, y: float) -> tuple[float, float]:
    """Return where a point is, seen from the nearest point of s; x and y are from its centre.

    That is the centre of a circle, a point of a segment's axis, and any point of a box.
    """
    if s.r:
        return x, y
    if s.segment is not None:
        near_x, near_y = s.segment.nearest(x, y)
        return x - near_x, y - near_y
    return x - max(-s.hx, min(x, s.hx)), y - max(-s.hy, min(y, s.hy))


def free_share(
    body: Body, statics: list[Body], core: float, start: tuple[float, float], dx: float, dy: float
) -> float:
    """Return how much of a way from `start` a ball's core (px) can go, 1 if nothing stops it.

    It stops a little before a static body, so that the next step finds the contact.
    """
    share = first_stop(statics, core, start[0], start[1], dx, dy)
    return max(share - BEFORE * body.r / sqrt(dx * dx + dy * dy), 0.0) if share < NO_HIT else 1.0


def hit_body(s: Body, radius: float, x: float, y: float, dx: float, dy: float) -> float:
    """Return the time of impact with a body; the ball starts at (x, y) from the centre of s."""
    if s.r:
        return hit_point(s.r + radius, x, y, dx, dy)
    if s.segment is None:
        return hit_box(s, radius, x, y, dx, dy)
    return hit_segment(s.segment, radius, x, y, dx, dy)


def hit_box(s: Body, radius: float, x: float, y: float, dx: float, dy: float) -> float:
    """Return the time of impact of a point with a box grown by the ball's radius."""
    enter, leave = stay_in_box(x, y, dx, dy, s.hx + radius, s.hy + radius)
    if enter >= leave:
        return NO_HIT
    at_x, at_y = x + dx * enter, y + dy * enter
    if abs(at_x) > s.hx and abs(at_y) > s.hy:
        return hit_point(radius, x - copysign(s.hx, at_x), y - copysign(s.hy, at_y), dx, dy)
    return enter or NO_HIT


def stay_in_box(
    x: float, y: float, dx: float, dy: float, hx: float, hy: float, edge: float = 0.0
) -> tuple[float, float]:
    """Return when a point enters and leaves a box of these half sizes, as fractions of the step.

    It never does where both are NO_HIT. Along an edge, it is in the box up to `edge` px outside.
    """
    enter, leave = 0.0, NO_HIT
    for start, move, half in ((x, dx, hx), (y, dy, hy)):
        if move:
            side = copysign(half, move)
            enter = max(enter, (-side - start) / move)
            leave = min(leave, (side - start) / move)
        elif abs(start) >= half + edge:
            return NO_HIT, NO_HIT
    return enter, leave


def hit_segment(wall: Segment, radius: float, x: float, y: float, dx: float, dy: float) -> float:
    """Return the time of impact of a point with a segment grown by the ball's radius."""
    reach, ux, uy = wall.rim + radius, wall.ux, wall.uy
    along, off = x * ux + y * uy, y * ux - x * uy
    ahead, across = dx * ux + dy * uy, dy * ux - dx * uy
    fraction = 0.0
    if abs(off) > reach:
        if off * across >= 0:
            return NO_HIT
        fraction = (abs(off) - reach) / abs(across)
    at = along + ahead * fraction
    if abs(at) <= wall.reach:
        return fraction or NO_HIT
    return hit_point(reach, along - copysign(wall.reach, at), off, ahead, across)


def hit_point(reach: float, x: float, y: float, dx: float, dy: float) -> float:
    """Return the time at which a ball at (x, y) from a point comes within reach (px)."""
    length2, ahead, outside = dx * dx + dy * dy, x * dx + y * dy, x * x + y * y - reach * reach
    root2 = ahead * ahead - length2 * outside
    if outside <= 0 or ahead >= 0 or root2 < 0 or length2 == 0:
        return NO_HIT
    return (-ahead - sqrt(root2)) / length2
