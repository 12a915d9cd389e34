"""The base of all effects, and the world as effects know it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar

from .body import Body, Listeners
from .validate import require

if TYPE_CHECKING:
    from .contact import Contact


class WorldState(Listeners):
    """The world as effects know it: its bodies, and the effects that the scene declares."""

    __slots__ = ("awake", "bodies", "effects", "g", "statics", "substep_count")

    g: tuple[float, float]  # px/s²
    substep_count: int
    bodies: list[Body]
    awake: list[Body]  # the balls that can move now
    statics: list[Body]
    effects: dict[str, Effect]

    @property
    def unit(self) -> float:
        """Return the length of a pixel in the lengths of the scene."""
        raise NotImplementedError

    def remove(self, thing: Any) -> None:
        """Take a body or joint out: see World.remove."""
        raise NotImplementedError

    def hooks(self, name: str, busy: bool = False) -> list[Callable[..., Any]]:
        """Return the hooks of this name that the scene's effects override, lowest rank first.

        Only those of effects that are busy, where asked for.
        """
        effects = sorted(self.effects.values(), key=lambda effect: effect.rank)
        base = getattr(Effect, name)
        return [
            getattr(e, name)
            for e in effects
            if getattr(type(e), name) is not base and not (busy and e.is_idle())
        ]

    def update_hooks(self) -> None:
        """Call in substeps the effects that have anything to do now, and no others."""
        raise NotImplementedError

    def need(self, name: str, user: object) -> Any:
        """Return the effect of that name. Raises ValueError when the scene does not declare it."""
        if name not in self.effects:
            raise ValueError(
                f"{type(user).__name__} needs {name}(), which this scene does not declare. "
                f"Declare it: World(effects=[..., {name}()])."
            )
        return self.effects[name]


class Effect:
    """Base of all effects. The world calls the hooks an effect overrides, and no others.

    So an effect that is not declared costs nothing, and one that is costs no empty calls. h is the
    length of a substep in seconds. At each stage effects of lower rank come first.
    """

    rank: ClassVar[int]
    world: WorldState

    def __repr__(self) -> str:
        return f"{type(self).__name__}()"

    def attach(self, world: WorldState) -> None:
        """Become part of a world, once. Look up here the other effects that this one needs."""
        name, found = f"World.effects' {self!r}", "in another world already"
        require(not hasattr(self, "world"), name, found, "a new one: each world has its own")
        self.world = world

    def add(self, thing: Any) -> None:
        """Add a body or joint to this effect's own list."""

    def remove(self, thing: Any) -> None:
        """Take a joint off this effect's own list."""

    def is_used(self) -> bool:
        """Return whether anything in the world has a use for this effect.

        Asked by World.check alone.
        """
        return True

    def is_idle(self) -> bool:
        """Return whether the hooks of the substeps have nothing to do now.

        When that changes, call update_hooks of the world.
        """
        return False

    # once per step

    def detect(self, h: float) -> None:
        """Collision detection: find out which bodies touch."""

    def impact(self, h: float) -> None:
        """Resolve impacts: change velocities at once, before any force of the step acts."""

    def prepare(self, h: float) -> None:
        """Work out what the substeps of this step share."""

    def finish(self, h: float) -> None:
        """Look at the result of the step."""

    def coast(self, dt: float) -> None:
        """Advance by a step of dt seconds in which no ball is awake: no other hook is called."""

    def tell(self, h: float) -> None:
        """Tell the program of the step, once all is done: it may change the world as it likes."""

    # once per substep

    def force(self, h: float) -> None:
        """Change velocities as forces do."""

    def warm_start(self, h: float) -> None:
        """Apply the impulses of the substep before once more: most are nearly right already."""

    def solve(self, h: float) -> None:
        """Correct velocities with impulses, and errors of position by velocities (the bias)."""

    def relax(self, h: float) -> None:
        """After bodies have moved, take back the speed that the bias gave them."""

    # between effects

    def begin_contact(self, c: Contact) -> None:
        """Fill in what this effect needs of a new contact, such as its friction."""

    def body_changed(self, body: Body) -> None:
        """Take over a new mass, friction or restitution of a body."""

    def lighter(self, body: Body, share: float) -> None:
        """Prepare for a body whose mass falls to this share of its old mass: 0 if it leaves."""

    def body_moved(self, body: Body) -> None:
        """Take over a position of a body that the program has set."""

    def static_moved(self, body: Body) -> None:
        """Wake the bodies that a new position, velocity or spin of a static body concerns."""

    def forget(self, body: Body) -> None:
        """Drop all that refers to a body, which leaves the world."""

    def links(self) -> list[tuple[Body, Body]]:
        """Return the pairs of bodies it connects, the edges of islands: they sleep and wake
        together.
        """
        return []

    def awake_changed(self) -> None:
        """Update lists of awake bodies, after some fell asleep or woke."""
