"""The right answers, in closed form: plain numbers in, plain numbers out."""

import math
from typing import NamedTuple


class Disc(NamedTuple):
    x: float
    y: float
    r: float


class Rect(NamedTuple):
    x: float
    y: float
    hx: float  # half extents
    hy: float


class Touch(NamedTuple):
    """A contact: unit normal from A to B, depth in px, the point."""

    nx: float
    ny: float
    depth: float
    px: float
    py: float


def circle_box(disc: Disc, rect: Rect) -> list[Touch | None]:
    """The contact of a disc with a box; several answers where faces are equally near."""
    x = min(max(disc.x, rect.x - rect.hx), rect.x + rect.hx)
    y = min(max(disc.y, rect.y - rect.hy), rect.y + rect.hy)
    dx, dy = x - disc.x, y - disc.y
    distance = math.hypot(dx, dy)
    if distance >= disc.r:
        return [None]
    if distance > 0:
        return [Touch(dx / distance, dy / distance, disc.r - distance, x, y)]
    faces = [
        (disc.x - (rect.x - rect.hx), Touch(1, 0, 0, rect.x - rect.hx, disc.y)),
        ((rect.x + rect.hx) - disc.x, Touch(-1, 0, 0, rect.x + rect.hx, disc.y)),
        (disc.y - (rect.y - rect.hy), Touch(0, 1, 0, disc.x, rect.y - rect.hy)),
        ((rect.y + rect.hy) - disc.y, Touch(0, -1, 0, disc.x, rect.y + rect.hy)),
    ]
    nearest = min(gap for gap, _ in faces)
    return [touch._replace(depth=disc.r + gap) for gap, touch in faces if gap <= nearest + 1e-9]


def damped(rate: float, seconds: float) -> float:
    """The share of a speed that is left after so many seconds at a rate per second."""
    return math.exp(-rate * seconds)
