"""The shapes of bodies. Lengths are in px."""

import math
from collections.abc import Iterable

from .validate import pair, require


class Circle:
    """A disc."""

    def __init__(self, radius: float) -> None:
        require(0 < radius < math.inf, "Circle.radius", radius, "a finite number above 0")
        self.radius = float(radius)


class Box:
    """A rectangle that never turns. half holds half its width and half its height."""

    def __init__(self, half: Iterable[float]) -> None:
        self.half = pair("Box.half", half)
        require(min(self.half) > 0, "Box.half", self.half, "two finite numbers above 0")
