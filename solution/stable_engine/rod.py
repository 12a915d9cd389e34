"""A rod: two centres keep their distance."""

from .body import Body
from .joint import Joint
from .validate import require

ROUNDING = 1e-9  # share of a length


class Rod(Joint):
    """A rigid rod that keeps the distance a and b start with. It pulls and pushes."""

    __slots__ = ("j",)
    effect = "Rods"

    def __init__(self, a: Body, b: Body) -> None:
        super().__init__(a, b)
        self.fitting(self.rest)
        self.j = 0.0  # kg px/s, accumulated impulse before the move, positive when it pushes

    def may_touch(self) -> bool:
        """Return whether it leaves a gap between its ends; a contact would fight a shorter rod."""
        return self.rest > (self.end_a.r + self.end_b.r) * (1 + ROUNDING)

    def fitting(self, length: float) -> float:
        found = super().fitting(length)
        require(found > 0, "Rod.length", found, "above 0: move a and b apart first")
        return found
