"""Finding out where two bodies touch. TODO 1 lives in circle_box."""

from pygame import Vector2

from .shapes import Circle


class Contact:
    """Two overlapping bodies, and what the solver has done to part them."""

    def __init__(self, a, b, normal, depth, point):
        self.a = a
        self.b = b
        self.normal = normal  # unit vector from A to B
        self.depth = depth  # px of overlap
        self.point = point  # px
        self.jn = 0.0  # kg px/s, accumulated normal impulse, never negative
        self.jt = 0.0  # kg px/s, accumulated friction impulse
        self.target = 0.0  # px/s, wanted speed of B away from A


class OutsideContact(Contact):
    """The centre is outside the box."""

    def __init__(self, a, b, closest):
        way = closest - a.pos
        super().__init__(a, b, way.normalize(), a.shape.radius - way.length(), closest)


class InsideContact(Contact):
    """The centre is inside the box."""

    def __init__(self, a, b, gap, out):
        super().__init__(a, b, -out, a.shape.radius + gap, a.pos + out * gap)


def circle_circle(a, b):
    """The Contact of two circles, or None when they do not overlap."""
    offset = b.pos - a.pos
    distance = offset.length()
    reach = a.shape.radius + b.shape.radius
    if distance >= reach:
        return None
    normal = offset / distance if distance > 0 else Vector2(0, 1)
    return Contact(a, b, normal, reach - distance, a.pos + normal * a.shape.radius)


def circle_box(a, b):
    """The Contact of circle a and box b, or None when they do not overlap.

    Clamp the circle's centre into the box to get the box's closest point.
    Centre outside: the normal points from the centre to that point, the depth is radius - distance.
    Centre inside or on the edge (the closest point is the centre): leave through the nearest face,
    gap px away. The normal still points into the box, opposite to the way out; the depth is
    radius + gap and the point lies on that face.
    """
    # TODO 1: find the contact of a circle and a box
    half = b.shape.half
    d = a.pos - b.pos
    closest = b.pos + Vector2(max(-half.x, min(d.x, half.x)), max(-half.y, min(d.y, half.y)))
    if abs(d.x) > half.x or abs(d.y) > half.y:
        contact = OutsideContact(a, b, closest)
        return contact if contact.depth > 0 else None
    gap_x, gap_y = half.x - abs(d.x), half.y - abs(d.y)
    if gap_x < gap_y:
        return InsideContact(a, b, gap_x, Vector2(1 if d.x > 0 else -1, 0))
    return InsideContact(a, b, gap_y, Vector2(0, 1 if d.y > 0 else -1))
    # END TODO 1


def collide(a, b):
    """The Contact of any two bodies, with the circle as A, or None. Two boxes never collide."""
    if isinstance(a.shape, Circle):
        return circle_circle(a, b) if isinstance(b.shape, Circle) else circle_box(a, b)
    return circle_box(b, a) if isinstance(b.shape, Circle) else None
