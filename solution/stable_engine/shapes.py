"""The shapes of bodies. Lengths are in px."""

from collections.abc import Iterable

from .validate import pair, positive, require


class Circle:
    """A disc."""

    def __init__(self, radius: float) -> None:
        self.radius = positive("Circle.radius", radius)

    def __repr__(self) -> str:
        return f"Circle({self.radius:g})"


class Box:
    """A rectangle that never turns. half holds half its width and half its height."""

    def __init__(self, half: Iterable[float]) -> None:
        self.half = pair("Box.half", half)
        require(min(self.half) > 0, "Box.half", self.half, "two finite numbers above 0")

    def __repr__(self) -> str:
        return f"Box(({self.half[0]:g}, {self.half[1]:g}))"
