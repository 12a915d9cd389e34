"""The shapes of bodies. Lengths are in px."""

from collections.abc import Iterable

from .validate import pair, positive, require


class Circle:
    """A disc."""

    def __init__(self, radius: float) -> None:
        self.size = positive("Circle.radius", radius)

    @property
    def radius(self) -> float:
        """Return the radius in px, which stays the same."""
        return self.size

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
