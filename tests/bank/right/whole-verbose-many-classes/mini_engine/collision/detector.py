"""Finding contacts."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from pygame import Vector2

from ..dynamics.body import Body
from ..geometry import Circle
from .contact import Contact


def circle_circle(a: Body, b: Body) -> Contact | None:
    offset = b.pos - a.pos
    distance = offset.length()
    reach = a.shape.radius + b.shape.radius
    if distance >= reach:
        return None
    normal = Vector2(0, 1)
    if distance > 0:
        normal = offset / distance
    return Contact(a, b, normal, reach - distance, a.pos + normal * a.shape.radius)


def circle_box(a: Body, b: Body) -> Contact | None:
    offset = a.pos - b.pos
    closest = b.shape.closest_to(offset)
    is_inside = closest.x == offset.x and closest.y == offset.y
    if is_inside:
        return circle_inside_box(a, b, offset)
    way = closest - offset
    distance = way.length()
    if distance >= a.shape.radius:
        return None
    return Contact(a, b, way / distance, a.shape.radius - distance, b.pos + closest)


def circle_inside_box(a: Body, b: Body, offset: Vector2) -> Contact:
    half = b.shape.half
    gap_left, gap_right = half.x + offset.x, half.x - offset.x
    gap_top, gap_bottom = half.y + offset.y, half.y - offset.y
    gap = min(gap_left, gap_right, gap_top, gap_bottom)
    if gap == gap_top:
        way_out = Vector2(0, -1)
    elif gap == gap_bottom:
        way_out = Vector2(0, 1)
    elif gap == gap_left:
        way_out = Vector2(-1, 0)
    else:
        way_out = Vector2(1, 0)
    return Contact(a, b, -way_out, a.shape.radius + gap, a.pos + way_out * gap)


def collide(a: Body, b: Body) -> Contact | None:
    a_is_circle = isinstance(a.shape, Circle)
    b_is_circle = isinstance(b.shape, Circle)
    if a_is_circle and b_is_circle:
        return circle_circle(a, b)
    if a_is_circle:
        return circle_box(a, b)
    if b_is_circle:
        return circle_box(b, a)
    return None


class ContactDetector:
    """Looks at all pairs."""

    def __init__(self, bodies: list[Body]) -> None:
        self.bodies = bodies

    def pairs(self) -> Iterator[tuple[Body, Body]]:
        for a, b in combinations(self.bodies, 2):
            if not (a.is_static and b.is_static):
                yield a, b

    def detect(self) -> list[Contact]:
        contacts = []
        for a, b in self.pairs():
            contact = collide(a, b)
            if contact is not None:
                contacts.append(contact)
        return contacts
