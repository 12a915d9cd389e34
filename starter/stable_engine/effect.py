"""What an effect is: something a scene declares, called at fixed moments of a step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from .validate import require

if TYPE_CHECKING:
    from .body import Body
    from .contact import Contact
    from .world import World


class Effect:
    """Base of all effects. The world calls the hooks an effect overrides, and no others.

    h is the length of a substep in seconds. At each moment effects of lower rank come first.
    """

    rank: ClassVar[int]
    world: World

    def join(self, world: World) -> None:
        """Become part of a world, once. Look up here which other effects are needed."""
        name = f"{type(self).__name__}.world"
        require(not hasattr(self, "world"), name, "another one already", "new: make a new effect")
        self.world = world

    def take(self, thing: Any) -> None:
        """Add something to this effect's own list."""

    # once per step

    def detect(self, h: float) -> None:
        """Find out who touches whom."""

    def impact(self, h: float) -> None:
        """Change velocities at a blow, before any force acts."""

    def prepare(self, h: float) -> None:
        """Work out what the substeps of this step share."""

    def finish(self, h: float) -> None:
        """Look at the step once it is over."""

    # once per substep

    def force(self, h: float) -> None:
        """Change velocities as forces do."""

    def warm_start(self, h: float) -> None:
        """Apply the impulses of the substep before once more: most will be right."""

    def solve(self, h: float) -> None:
        """Correct velocities, and errors of position by velocities, before bodies move."""

    def relax(self, h: float) -> None:
        """After bodies have moved, take back the speed that correcting positions gave them."""

    # between effects

    def meet(self, c: Contact) -> None:
        """Fill in what this effect needs of a new contact."""

    def strike(self, c: Contact, jn: float) -> None:
        """Answer a blow of jn (kg px/s) along the normal of a contact."""

    def links(self) -> list[tuple[Body, Body]]:
        """Pairs of bodies that must sleep and wake together."""
        return []

    def rouse(self) -> None:
        """Take note that bodies fell asleep or woke."""
