"""The broad phase: which bodies are near each other, by sort and sweep."""

from collections.abc import Iterator
from operator import itemgetter

from .body import Body

Interval = tuple[float, float, float, float, Body]  # low, high, side_low, side_high


def near_pairs(bodies: list[Body], awake: list[Body], margin: float) -> Iterator[tuple[Body, Body]]:
    """Pairs whose bounding boxes come within margin px, one of the two awake; higher id first.

    A sweep along the axis on which the awake bodies are spread wider. It meets each box where it
    begins; the boxes that began before and have not ended are the only ones it can be near.
    """
    active: list[Interval] = []
    for interval in sorted(intervals(bodies, awake, margin), key=itemgetter(0, 2)):
        low, _, side_low, side_high, a = interval
        active = [other for other in active if other[1] > low]
        for b in [b for _, _, start, end, b in active if start < side_high and end > side_low]:
            if not (a.idle and b.idle):
                yield (a, b) if a.id > b.id else (b, a)
        active.append(interval)


def intervals(bodies: list[Body], awake: list[Body], m: float) -> list[Interval]:
    """The bounding boxes near awake bodies, longer axis first, low ends moved out by m px."""
    left, right = min([b.x - b.hx for b in awake]) - m, max([b.x + b.hx for b in awake]) + m
    top, bottom = min([b.y - b.hy for b in awake]) - m, max([b.y + b.hy for b in awake]) + m
    boxes = [
        (b.x - b.hx - m, b.x + b.hx, b.y - b.hy - m, b.y + b.hy, b)
        for b in bodies
        if b.x + b.hx > left and b.x - b.hx < right and b.y + b.hy > top and b.y - b.hy < bottom
    ]
    if bottom - top > right - left:
        return [(y0, y1, x0, x1, b) for x0, x1, y0, y1, b in boxes]
    return boxes
