"""Springs: Hooke's law, with damping."""

from .body import Body
from .joint import Joint, Joints
from .validate import not_negative


class Spring(Joint):
    """Pulls or pushes a and b to a distance of length px: the one they start with, unless given.

    stiffness is force per px of stretch (kg/s²), damping is force per px/s (kg/s).
    """

    __slots__ = ("c", "k")
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
        self.k = not_negative("Spring.stiffness", stiffness)
        self.c = not_negative("Spring.damping", damping)
        if length is not None:
            self.rest = self.fitting(length)

    @property
    def stiffness(self) -> float:
        """Force per px of stretch, in kg/s². Setting it wakes both ends."""
        return self.k

    @stiffness.setter
    def stiffness(self, value: float) -> None:
        self.k = not_negative("Spring.stiffness", value)
        self.changed()

    @property
    def damping(self) -> float:
        """Force per px/s, in kg/s. Setting it wakes both ends."""
        return self.c

    @damping.setter
    def damping(self, value: float) -> None:
        self.c = not_negative("Spring.damping", value)
        self.changed()


class Springs(Joints[Spring]):
    """Spring forces that stay stable at any stiffness, while a soft spring keeps its energy.

    The divisor is that of an implicit step: it limits a stiff spring to what one substep can
    follow, and is nearly 1 for a soft one. What a substep cannot follow is damped. Kept, it would
    grow without end where a rod or a contact holds the same ball.
    """

    rank = 1

    def force(self, h: float) -> None:
        for spring in self.awake:
            spring.measure()
            k, c = spring.k, spring.c
            turn2 = h * h * k / spring.m  # rad², by how far it swings in a substep
            c += h * k * (1 - 1 / (1 + turn2 * turn2 * turn2))
            force = -k * (spring.distance - spring.rest) - c * spring.speed()
            spring.apply_impulse(h * force / (1 + h * (c + h * k) / spring.m))
