"""More vector maths."""

from pygame.math import Vector2 as V


def turned_left(v):
    return V(-v.y, v.x)


def clamped(v, low, high):
    from physics_utils import between

    return V(between(low.x, v.x, high.x), between(low.y, v.y, high.y))


def closing_speed(a, b, axis):
    return (b.vel - a.vel) * axis
