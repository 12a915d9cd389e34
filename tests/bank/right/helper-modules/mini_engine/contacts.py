"""Where two bodies touch. TODO 1 lives in circle_box."""

from dataclasses import dataclass
from typing import Any

from pygame.math import Vector2 as V

from .shapes import Box, Circle
from .vectors import clamped


@dataclass(eq=False)
class Contact:
    a: Any
    b: Any
    normal: V
    depth: float
    point: V
    jn: float = 0.0
    jt: float = 0.0
    target: float = 0.0


def circle_circle(a, b):
    r = a.shape.radius + b.shape.radius
    way = b.pos - a.pos
    far = way.length()
    if far >= r:
        return None
    n = way / far if far else V(0, 1)
    return Contact(a, b, n, r - far, a.pos + a.shape.radius * n)


def circle_box(a, b):
    # TODO 1: find the contact of a circle and a box
    closest = clamped(a.pos, b.pos - b.shape.half, b.pos + b.shape.half)
    return from_outside(a, b, closest) if closest - a.pos else from_inside(a, b)
    # END TODO 1


def from_outside(a, b, closest):
    n = closest - a.pos
    far = n.length()
    if far < a.shape.radius:
        return Contact(a, b, n / far, a.shape.radius - far, closest)


def from_inside(a, b):
    best = None
    for n, wall in (
        (V(1, 0), b.pos.x - b.shape.half.x),
        (V(-1, 0), -b.pos.x - b.shape.half.x),
        (V(0, 1), b.pos.y - b.shape.half.y),
        (V(0, -1), -b.pos.y - b.shape.half.y),
    ):
        gap = n.dot(a.pos) - wall
        if best is None or gap < best.depth - a.shape.radius:
            best = Contact(a, b, n, a.shape.radius + gap, a.pos - n * gap)
    return best


def collide(a, b):
    match a.shape, b.shape:
        case Circle(), Circle():
            return circle_circle(a, b)
        case Circle(), Box():
            return circle_box(a, b)
        case Box(), Circle():
            return circle_box(b, a)
    return None
