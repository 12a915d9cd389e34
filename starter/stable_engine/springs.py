"""Springs: Hooke's law, with damping."""

from .body import Body
from .joint import Joint, Joints
from .validate import not_negative


class Spring(Joint):
    """Draws a and b to a distance of length px: the one they start with, unless given.

    stiffness is force per px of stretch (kg/s²), damping is force per px/s (kg/s).
    """

    __slots__ = ("damping", "stiffness")
    effect = "Springs"

    def __init__(
        self,
        a: Body,
        b: Body,
        stiffness: float,
        damping: float = 0.0,
        length: float | None = None,
    ) -> None:
        super().__init__(a, b)
        self.stiffness = not_negative("Spring.stiffness", stiffness)
        self.damping = not_negative("Spring.damping", damping)
        if length is not None:
            self.length = not_negative("Spring.length", length)


class Springs(Joints[Spring]):
    """Forces that no stiffness can blow up, and a gentle spring keeps its energy.

    The divisor caps what a spring does at what one substep can carry.
    """

    rank = 1

    def force(self, h: float) -> None:
        for spring in self.awake:
            spring.measure()
            k, c = spring.stiffness, spring.damping
            force = -k * (spring.distance - spring.length) - c * spring.speed()
            spring.push(h * force / (1 + h * (c + h * k) / spring.m))
