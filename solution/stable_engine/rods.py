"""Rods: two centres keep their distance."""

from math import hypot

from .body import Body
from .contacts import Contacts, pair_both_ways
from .joint import Joint, Joints
from .soft import SAME_DIRECTION, Pace, softness
from .validate import require

FREQUENCY = 0.25  # of a rod, per substep
DAMPING_RATIO = 5.0
STIFFENING = 0.02  # of a substep, per step
ROUNDING = 1e-9  # share of a length
TURNING_SHARE = 0.2  # of what relax finds missing, kept for relax; the rest is kept for solve


class Rod(Joint):
    """A rigid rod that keeps the distance a and b start with. It pulls and pushes."""

    __slots__ = ("j", "turning")
    effect = "Rods"

    def __init__(self, a: Body, b: Body) -> None:
        super().__init__(a, b)
        self.fitting(self.rest)
        self.j = 0.0  # kg px/s, accumulated impulse, positive when it pushes
        self.turning = 0.0  # kg px/s, that of relax: what turns the motion of a rod that swings

    def fitting(self, length: float) -> float:
        found = super().fitting(length)
        require(found > 0, "Rod.length", found, "above 0: move a and b apart first")
        return found


class Rods(Joints[Rod]):
    """Rods as soft constraints on the length they will have after the move.

    With the speed along the axis alone, a swinging rod would stretch in every move. relax works
    along the axis after the move: along the one before, a pendulum would lose energy. Half of what
    turns a swinging rod is needed before the move and half after it, so relax has a warm start of
    its own: with all of it before the move, a swinging chain would gain energy.

    If the ends would pass each other in this step, use the speed along the present axis; the
    direction after the move would drive them on.
    """

    rank = 2

    def __init__(self) -> None:
        super().__init__()
        self.pace = Pace(STIFFENING)

    def add(self, rod: Rod) -> None:
        super().add(rod)
        self.let_touch(rod, may_touch(rod))

    def remove(self, rod: Rod) -> None:
        super().remove(rod)
        self.let_touch(rod, True)

    def body_changed(self, body: Body) -> None:
        super().body_changed(body)
        for rod in self.joints:
            if body in (rod.a, rod.b):
                self.let_touch(rod, may_touch(rod))

    def let_touch(self, rod: Rod, may: bool) -> None:
        """Let the ends of a rod touch or not."""
        contacts = self.world.effects.get("Contacts")
        if not isinstance(contacts, Contacts):
            return
        if may:
            contacts.ignored -= pair_both_ways(rod.a, rod.b)
        else:
            contacts.ignore_pair(rod.a, rod.b)

    def awake_changed(self) -> None:
        super().awake_changed()
        self.pace.awake_changed(len(self.awake) < len(self.joints))

    def prepare(self, h: float) -> None:
        self.spring = softness(FREQUENCY / self.pace.follow(h), DAMPING_RATIO, h)

    def warm_start(self, h: float) -> None:
        for rod in self.awake:
            rod.measure()
            rod.apply_impulse(rod.j)

    def solve(self, h: float) -> None:
        bias_rate, mass_scale = self.spring
        for rod in self.awake:
            a, b = rod.a, rod.b
            dx, dy = rod.dx + (b.vx - a.vx) * h, rod.dy + (b.vy - a.vy) * h
            if dx * rod.nx + dy * rod.ny > 0:
                speed = (hypot(dx, dy) - rod.distance) / h
            else:
                speed = rod.speed()
            error = rod.distance - rod.rest
            j = mass_scale * (rod.j - rod.m * speed) - rod.m * bias_rate * error
            rod.apply_impulse(j - rod.j)
            rod.j = j

    def relax(self, h: float) -> None:
        for rod in self.awake:
            nx, ny = rod.nx, rod.ny
            rod.measure()
            if nx * rod.nx + ny * rod.ny < SAME_DIRECTION:
                rod.j = rod.turning = 0.0
            rod.apply_impulse(rod.turning)
        for rod in self.awake:
            j = -rod.m * rod.speed()
            rod.apply_impulse(j)
            rod.turning += TURNING_SHARE * j
            rod.j += (1 - TURNING_SHARE) * j


def may_touch(rod: Rod) -> bool:
    """Return whether a rod leaves a gap between its ends: a contact would fight a shorter one."""
    return rod.rest > (rod.a.radius + rod.b.radius) * (1 + ROUNDING)
