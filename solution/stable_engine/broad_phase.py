"""Which bodies are near each other: sort and sweep."""

from collections.abc import Iterator, Sequence
from operator import itemgetter

from .body import Body

Interval = tuple[float, float, float, float, Body]  # low, high, side_low, side_high


def near_pairs(bodies: Sequence[Body], margin: float) -> Iterator[tuple[Body, Body]]:
    """Pairs whose bounding boxes come within margin px, one of the two awake; higher id first.

    A sweep along the axis on which the balls are spread wider meets each box when it begins. The
    boxes begun before and not yet ended are the only ones it can be near.
    """
    moving: list[Interval] = []
    idle: list[Interval] = []
    for box in sorted(intervals(bodies, margin), key=itemgetter(0)):
        low, _, side_low, side_high, a = box
        moving = [other for other in moving if other[1] > low]
        near = [b for _, _, start, end, b in moving if start < side_high and end > side_low]
        if a.idle:
            idle.append(box)
        else:
            moving.append(box)
            idle = [other for other in idle if other[1] > low]
            near += [b for _, _, start, end, b in idle if start < side_high and end > side_low]
        for b in near:
            yield (a, b) if a.id > b.id else (b, a)


def intervals(bodies: Sequence[Body], margin: float) -> list[Interval]:
    """The bounding boxes, first along the longer axis, then across; low ends moved by margin."""
    m = margin
    if longer_down(bodies):
        return [(b.y - b.hy - m, b.y + b.hy, b.x - b.hx - m, b.x + b.hx, b) for b in bodies]
    return [(b.x - b.hx - m, b.x + b.hx, b.y - b.hy - m, b.y + b.hy, b) for b in bodies]


def longer_down(bodies: Sequence[Body]) -> bool:
    """Whether the awake balls are spread wider down the screen than across it."""
    xs = [b.x for b in bodies if not b.idle]
    ys = [b.y for b in bodies if not b.idle]
    return max(ys) - min(ys) > max(xs) - min(xs)
