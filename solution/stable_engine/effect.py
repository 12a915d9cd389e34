"""The base of all effects: the hooks that they may override."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from .body import Body

if TYPE_CHECKING:
    from .contact import Contact
    from .world import World

Direction = tuple[float, float]
Push = tuple[float, float, float]  # kg px/s² along x and y, and kg px²/s²


class Effect:
    """Base of all effects. The world calls the hooks an effect overrides, and no others.

    So an undeclared effect costs nothing, and a declared one no empty calls. h is the length of a
    substep in seconds. At each stage effects of lower rank come first.
    """

    __slots__ = ("world",)
    rank: ClassVar[int]
    pushes_all: ClassVar[bool] = True  # whether its substeps push bodies off joints and contacts
    world: World  # set when it joins one

    def __repr__(self) -> str:
        return f"{type(self).__name__}()"

    def attach(self) -> None:
        """Look up the other effects that this one needs: its world knows all of them by now."""

    def add(self, thing: Any) -> None:
        """Add a body or joint to this effect's own list."""

    def remove(self, thing: Any) -> None:
        """Take a joint off this effect's own list."""

    def is_used(self) -> bool:
        """Return whether anything in the world uses this effect.

        Asked by World.check alone.
        """
        return True

    def is_idle(self) -> bool:
        """Return whether the hooks of the substeps have nothing to do now.

        Call the world's update_hooks when that changes.
        """
        return False

    def is_at_rest(self) -> bool:
        """Return whether the hooks of the step have nothing to do now either, but for `rest`."""
        return False

    # once per step

    def detect(self, h: float) -> None:
        """Collision detection at the end of a step: find out which bodies touch.

        Also called before a step, when a program has changed anything in between.
        """

    def impact(self, h: float) -> None:
        """Resolve impacts: change velocities at once, after all forces of the step have acted."""

    def prepare(self, h: float) -> None:
        """Work out values that all substeps of this step use."""

    def finish(self, h: float) -> None:
        """Correct or note the result of the step."""

    def rest(self, h: float) -> None:
        """Take the place of `finish` while the effect is at rest."""

    def coast(self, dt: float) -> None:
        """Advance by a step of dt seconds in which no ball is awake: no other hook is called."""

    def tell(self, h: float) -> None:
        """Call the program's functions after the step; these may change the world."""

    # once per substep

    def force(self, h: float) -> None:
        """Change velocities as forces do."""

    def warm_start(self, h: float) -> None:
        """Apply the impulses of the last substep again, which are nearly right."""

    def solve(self, h: float) -> None:
        """Correct velocities by impulses, and position errors by extra velocity (the bias)."""

    def relax(self, h: float) -> None:
        """After bodies have moved, take back the speed of the bias."""

    # at the start and end of a step, see Lags

    def press(self, h: float) -> None:
        """Mark bodies that this effect holds (is_pressed), so that their velocities do not lag."""

    def lag(self, seconds: float) -> None:
        """Change lag_x and lag_y of bodies by what it adds to velocities in so many seconds.

        That is h / 2, below 0 at the start of a step.
        """

    # between effects

    def begin_contact(self, c: Contact) -> None:
        """Fill in this effect's fields of a new or changed contact, such as its friction."""

    def body_changed(self, body: Body) -> None:
        """Take over a new mass, friction or restitution of a body."""

    def unload(self, lost: dict[Body, float], direction: Direction) -> None:
        """Prepare for bodies to press less, by forces (kg px/s²), or infinity if they leave.

        Only their ratio counts in the direction, x and y.
        """

    def body_moved(self, body: Body) -> None:
        """Take over a body's position that the program has set."""

    def static_moved(self, body: Body) -> None:
        """Wake bodies affected by a static body's new position, velocity or spin."""

    def forget(self, body: Body) -> None:
        """Drop every reference to a body that leaves the world."""

    def links(self) -> list[tuple[Body, Body]]:
        """Return the pairs of bodies that this effect makes sleep and wake together."""
        return []

    def drag(self, rates: dict[Body, float]) -> None:
        """Add the rate (1/s) at which this effect alone slows each awake body."""

    def let_touch(self, a: Body, b: Body, may: bool) -> None:
        """Let two bodies touch, or pass through each other: a joint may hold them overlapping."""

    def wake(self, island: list[Body]) -> None:
        """Wake the bodies of an island, which sleep together."""

    def awake_changed(self) -> None:
        """Update lists of awake bodies, after some fell asleep or woke."""


class Users(Effect):
    """An effect with a list of the bodies that use it."""

    __slots__ = ("bodies",)

    def __init__(self) -> None:
        self.bodies: list[Body] = []

    def add(self, body: Body) -> None:
        self.bodies.append(body)

    def forget(self, body: Body) -> None:
        if body in self.bodies:
            self.bodies.remove(body)

    def is_used(self) -> bool:
        return bool(self.bodies)
