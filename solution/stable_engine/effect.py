"""What an effect is: something a scene declares, called at fixed moments of a step."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar

from .validate import require

if TYPE_CHECKING:
    from collections.abc import Iterable

    from .body import Body
    from .contacts import Contact
    from .world import World


class Effect:
    """Base of all effects. The world calls the hooks an effect overrides, and no others.

    h is the length of a substep in seconds. At each moment effects of lower rank come first.
    """

    rank: ClassVar[int]
    world: World

    def join(self, world: World) -> None:
        """Become part of a world, once."""
        self.world = world

    def take(self, thing: Any) -> None:
        """Add something to this effect's own list."""

    # once per step

    def detect(self, h: float) -> None:
        """Find out who touches whom."""

    def impact(self, h: float) -> None:
        """Change velocities at a blow, before any force acts."""

    def prepare(self, h: float) -> None:
        """Work out what all substeps of this step share."""

    def finish(self, h: float) -> None:
        """Look at the step once it is over."""

    # once per substep

    def force(self, h: float) -> None:
        """Change velocities as forces do."""

    def warm_start(self, h: float) -> None:
        """Apply the impulses of the substep before."""

    def solve(self, h: float) -> None:
        """Correct velocities, errors of position included, before bodies move."""

    def relax(self, h: float) -> None:
        """Take back the speed that correcting positions took, after bodies have moved."""

    # between effects

    def meet(self, c: Contact) -> None:
        """Fill in what this effect needs of a new contact."""

    def strike(self, c: Contact, jn: float) -> None:
        """Answer a blow of impulse jn (kg px/s) along the normal of a contact."""

    def links(self) -> Iterable[tuple[Body, Body]]:
        """Pairs of bodies that must sleep and wake together."""
        return ()

    def rouse(self) -> None:
        """Take note of who is awake now: bodies fell asleep or woke."""


class Joint:
    """Something between the centres of two bodies, given to the effect it names.

    Raises ValueError when a and b are the same body or both static.
    """

    __slots__ = ("a", "b")
    effect: ClassVar[str]

    def __init__(self, a: Body, b: Body) -> None:
        name = type(self).__name__
        require(a is not b, f"{name}.b", f"the same body as a, at {a.pos}", "another body")
        static = a.is_static and b.is_static
        require(not static, f"{name}.b", f"static like a, at {b.pos}", "a body with mass")
        self.a = a
        self.b = b

    @property
    def awake(self) -> bool:
        """Whether any end of it can move."""
        return not (self.a.idle and self.b.idle)


def softness(hertz: float, zeta: float, h: float) -> tuple[float, float]:
    """Make a constraint a damped spring of that frequency and damping ratio, stable at any step.

    Returns (rate, keep): the share of an error put right per second, and the share of the rigid
    impulse that is kept. Source: Erin Catto, Soft Constraints, GDC 2011; Solver2D, 2024.
    """
    omega = 2 * math.pi * hertz
    damping = 2 * zeta + h * omega
    stiffness = h * omega * damping
    return omega * h * omega / (1 + stiffness), stiffness / (1 + stiffness)
