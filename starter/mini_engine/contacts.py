"""Finding out where two bodies touch."""

from pygame import Vector2

from .shapes import Circle


class Contact:
    """Two overlapping bodies, and what the solver has done to part them."""

    def __init__(self, a, b, normal, depth, point):
        self.a, self.b = a, b
        self.normal = normal  # unit vector from A to B
        self.depth = depth  # px of overlap
        self.point = point  # px
        self.jn = 0.0  # kg px/s, accumulated normal impulse, never negative
        self.jt = 0.0  # kg px/s, accumulated friction impulse
        self.target = 0.0  # px/s, wanted speed of B away from A


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
    # Replace this line; until then every ball falls through the boxes.
    return None
    # END TODO 1


def collide(a, b):
    """The Contact of any two bodies, with the circle as A, or None. Two boxes never collide."""
    if isinstance(a.shape, Circle):
        return circle_circle(a, b) if isinstance(b.shape, Circle) else circle_box(a, b)
    return circle_box(b, a) if isinstance(b.shape, Circle) else None
