"""The shapes of bodies. Lengths are in px."""

from collections.abc import Iterable
from math import hypot, inf

from .validate import not_negative, pair, positive, require


class Circle:
    """A disc."""

    def __init__(self, radius: float) -> None:
        size = positive("Circle.radius", radius)
        self.half = size, size  # px, of its bounding box

    @property
    def radius(self) -> float:
        """Return the radius in px, which stays the same."""
        return self.half[0]

    def __repr__(self) -> str:
        return f"Circle({self.radius:g})"


class Box:
    """A rectangle that never turns. half holds half its width and half its height."""

    def __init__(self, half: Iterable[float]) -> None:
        self.size = pair("Box.half", half)
        require(min(self.size) > 0, "Box.half", self.size, "two finite numbers above 0")

    @property
    def half(self) -> tuple[float, float]:
        """Return half its width and half its height, which stay the same."""
        return self.size

    def __repr__(self) -> str:
        return f"Box(({self.half[0]:g}, {self.half[1]:g}))"


class Segment:
    """A straight wall from start to end, in px, tilted as you like. It never turns.

    It is 2 * radius thick, and its ends are round: half discs of that radius around start and end.
    With a radius of 0 it is a line, and its ends are points.
    """

    def __init__(self, start: Iterable[float], end: Iterable[float], radius: float = 0.0) -> None:
        self.ends = pair("Segment.start", start), pair("Segment.end", end)
        self.rim = not_negative("Segment.radius", radius)
        (x, y), (end_x, end_y) = self.ends
        dx, dy = end_x - x, end_y - y
        length = hypot(dx, dy)
        require(0 < length < inf, "Segment.end", self.ends[1], "another point than start")
        self.reach = length / 2  # px, from its middle to its ends
        self.ux, self.uy = dx / length, dy / length  # unit vector from start to end
        self.middle = x + dx / 2, y + dy / 2
        self.half = abs(dx) / 2 + self.rim, abs(dy) / 2 + self.rim  # px, of its bounding box

    @property
    def start(self) -> tuple[float, float]:
        """Return the end it was drawn from, which stays the same."""
        return self.ends[0]

    @property
    def end(self) -> tuple[float, float]:
        """Return the end it was drawn to, which stays the same."""
        return self.ends[1]

    @property
    def radius(self) -> float:
        """Return half its thickness in px, which stays the same."""
        return self.rim

    def nearest(self, x: float, y: float) -> tuple[float, float]:
        """Return the point of its axis that is nearest to (x, y), all seen from its middle."""
        along = max(-self.reach, min(x * self.ux + y * self.uy, self.reach))
        return self.ux * along, self.uy * along

    def __repr__(self) -> str:
        (x, y), (end_x, end_y) = self.ends
        return f"Segment(({x:g}, {y:g}), ({end_x:g}, {end_y:g}), {self.rim:g})"
