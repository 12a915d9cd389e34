"""The common parts of rods and springs."""

from math import hypot
from typing import ClassVar, Generic, TypeVar

from .body import Body
from .effect import Effect
from .row import Row
from .validate import not_negative, refuse, require


class Joint(Row):
    """A constraint along the line between the centres of a and b, which turns neither.

    Setting one of its numbers later on wakes both. Raises ValueError if a number makes no sense, if
    a and b are the same body, or if both are static.
    """

    __slots__ = ("distance", "dx", "dy", "given", "rest")
    effect: ClassVar[str]  # the name of the effect that owns it

    def __init__(self, a: Body, b: Body) -> None:
        name = f"{type(self).__name__}.b"
        for body in (a, b):
            if not isinstance(body, Body):
                refuse(f"an end of {type(self).__name__}", body, "a Body")
        require(a is not b, name, f"the same body as a, at {a.pos}", "another body")
        static = a.is_static and b.is_static
        require(not static, name, f"static like a, at {b.pos}", "a body with mass")
        super().__init__(a, b, 0.0, 1.0)
        self.given = 0.0  # kg px/s, the impulse of the latest substep so far
        self.measure()
        self.rest = self.distance  # px, its length

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.a!r}, {self.b!r}, length {self.rest:g})"

    @property
    def a(self) -> Body:
        """Return the first end, which stays the same."""
        return self.end_a

    @property
    def b(self) -> Body:
        """Return the second end, which stays the same."""
        return self.end_b

    @property
    def length(self) -> float:
        """Return its length at rest, in px. Setting it wakes both ends."""
        return self.rest

    @length.setter
    def length(self, value: float) -> None:
        self.rest = self.fitting(value)
        self.changed()

    @property
    def impulse(self) -> float:
        """Return the latest substep's impulse (kg px/s): above 0 it pushes, below 0 it pulls.

        Divide it by the length of a substep for the force.
        """
        return self.given

    def other_end(self, body: Body) -> Body:
        """Return the body at the other end."""
        return self.end_b if body is self.end_a else self.end_a

    def fitting(self, length: float) -> float:
        """Return a length as a float. Raises ValueError if the joint cannot have it."""
        return not_negative(f"{type(self).__name__}.length", length)

    def changed(self) -> None:
        """Wake both ends, and tell the effects of the new value."""
        self.end_b.wake()
        self.end_a.changed()

    def measure(self) -> None:
        """Update distance and direction from A to B."""
        self.dx, self.dy = self.end_b.x - self.end_a.x, self.end_b.y - self.end_a.y  # px
        self.distance = hypot(self.dx, self.dy)  # px
        if self.distance > 0:
            self.nx, self.ny = self.dx / self.distance, self.dy / self.distance
        else:
            self.nx, self.ny = 0.0, 1.0

    def take(self, j: float) -> None:
        self.apply_impulse(j)
        self.given += j


AnyJoint = TypeVar("AnyJoint", bound=Joint)


class Joints(Effect, Generic[AnyJoint]):
    """An effect with a list of joints. Those between sleeping bodies are skipped."""

    __slots__ = ("awake", "is_stale", "joints")
    pushes_all = False

    def __init__(self) -> None:
        self.joints: list[AnyJoint] = []
        self.awake: list[AnyJoint] = []
        self.is_stale = False  # whether what was found out about them must be found anew

    def add(self, joint: AnyJoint) -> None:
        self.joints.append(joint)
        self.awake.append(joint)
        self.is_stale = True
        self.world.update_hooks()

    def remove(self, joint: AnyJoint) -> None:
        self.joints.remove(joint)
        self.awake_changed()

    def joints_at(self, body: Body) -> list[AnyJoint]:
        """Return the joints that have this body at an end."""
        return [joint for joint in self.joints if body in (joint.end_a, joint.end_b)]

    def forget(self, body: Body) -> None:
        for joint in self.joints_at(body):
            self.world.remove(joint)

    def body_changed(self, body: Body) -> None:
        for joint in self.joints_at(body):
            joint.weigh()
        self.is_stale = True

    def static_moved(self, body: Body) -> None:
        for joint in self.joints_at(body):
            joint.end_a.wake()
            joint.end_b.wake()

    def is_used(self) -> bool:
        return bool(self.joints)

    def is_idle(self) -> bool:
        return not self.awake

    def links(self) -> list[tuple[Body, Body]]:
        return [(joint.end_a, joint.end_b) for joint in self.awake]

    def awake_changed(self) -> None:
        was_idle, self.is_stale = self.is_idle(), True
        self.awake = [joint for joint in self.joints if not (joint.end_a.idle and joint.end_b.idle)]
        if self.is_idle() != was_idle:
            self.world.update_hooks()
