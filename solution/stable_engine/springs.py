"""Springs: Hooke's law, with damping."""

from .body import Body
from .joint import Joint, Joints
from .validate import not_negative


class Spring(Joint):
    """Pulls or pushes a and b to a distance of length px: the one they start with, unless given.

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
    """Spring forces that stay stable at any stiffness, while a soft spring keeps its energy.

    The divisor is that of an implicit step: it limits a stiff spring to what one substep can
    follow, and is nearly 1 for a soft one.
    """

    rank = 1

    def force(self, h: float) -> None:
        for spring in self.awake:
            spring.measure()
            k, c = spring.stiffness, spring.damping
            force = -k * (spring.distance - spring.length) - c * spring.speed()
            spring.apply_impulse(h * force / (1 + h * (c + h * k) / spring.m))
