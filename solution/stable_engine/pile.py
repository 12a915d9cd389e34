"""Piles: where much presses on little, contacts and rods are solved together."""

from math import hypot

from .contact import Contact, is_at_face
from .joint import Joint
from .limits import FREE, LimitedRow, solve_within
from .network import Network, bodies_of
from .order import Group
from .row import Row
from .springs import Spring

CALM = 0.5  # 1/s, in units of the world, by a squared ratio of masses; passes may leave this speed
STEEPEST = 1000.0  # a larger ratio counts as this, or rounding would decide what presses
FAR = 0.5  # radii; where a ball moves by more in a substep, its contacts are other ones by then
PUSHED = 0.1  # share by which a contact gives way, per ratio: many firm ones have no solution
FRAMED = 1.0  # the same where frames of rods press
SOFTEST = 1e-2  # the most of both
HARDEST = 1e-6  # the least of both, and all in a tower, where firm ones do have a solution
RELAXED = 1e-3  # of that share, what is left after the move


class Load(LimitedRow):
    """A contact in a pile."""

    __slots__ = ("give", "pressed", "ratio")

    def __init__(self, c: Contact, ratio: float) -> None:
        super().__init__(c)
        self.ratio = ratio  # of the heavier body, or its frame, to the lighter ball
        self.give = 0.0  # the share that it gives way
        self.pressed = -1.0  # kg px/s, beside rods its impulse before the move

    def aim(self, group: Group, h: float) -> None:
        """Set rhs to the speed (px/s) that the bodies lack, and the pivot."""
        c, a, b = self.c, self.end_a, self.end_b
        speed = (b.vx - a.vx) * self.nx + (b.vy - a.vy) * self.ny
        gap = (b.x - a.x) * self.nx + (b.y - a.y) * self.ny - c.reach
        rate = 0.0 if group.has_moved else group.load_rate
        give = self.give * RELAXED if group.has_moved else self.give
        self.pivot = (1 + give) / c.mn
        presses = c.jn > 0 if self.pressed < 0 else self.pressed > 0
        if gap > group.least and not (group.has_moved and presses):
            self.rhs = -speed - gap / h
        else:
            push = max(rate * gap, -group.max_push_speed)
            self.rhs = -speed - push - give * c.jn / c.mn

    def take(self, j: float) -> None:
        super().take(j)
        self.c.jn = self.total


class Pile:
    """Contacts, rods of frames, and stiff springs, that balls connect.

    A pass over contacts takes from a body of mass M only the share m / (M + m) of its speed, if the
    ball below has mass m. So what a pass leaves is solved exactly, for the contacts that press.
    """

    __slots__ = (
        *("balls", "bodies", "calm", "h", "is_wild", "lengths", "loads", "network", "rods", "rows"),
        *("springs", "statics", "turning"),
    )

    def __init__(self, loads: list[Load], joints: list[Joint], unit: float, softest: float) -> None:
        self.loads = loads
        self.springs = [joint for joint in joints if isinstance(joint, Spring)]
        self.rods = [joint for joint in joints if not isinstance(joint, Spring)]
        self.rows: list[Row] = [*loads, *joints]
        self.bodies = bodies_of(self.rows)
        masses = [body.m for body in self.bodies if body.m]
        ratio = max(max(masses) / min(masses), *[load.ratio for load in self.loads])
        for load in self.loads:
            given = (FRAMED if self.rods else PUSHED) / ratio
            load.give = max(min(given, softest), HARDEST)
        self.calm = CALM * unit / min(ratio, STEEPEST) ** 2  # px/s
        self.lengths: list[float] = []  # px, of its rods after the move
        turning = [load for load in loads if not (joints and is_at_face(load.c))]
        self.turning = bodies_of(turning)  # at contacts that are other ones once these moved far
        self.is_wild = False  # whether they move far in this substep
        self.network: Network[Row] | None = None  # of all rows, once it was needed

    def note_lengths(self, h: float) -> None:
        """Note the lengths that rods will have after the move, before contacts change them."""
        self.lengths = [length_after(rod, h) for rod in self.rods]
        self.is_wild = any(
            [b.inv_mass > 0 and hypot(b.vx, b.vy) * h > FAR * b.r for b in self.turning]
        )

    def forget_impacts(self) -> None:
        """Begin a substep with impulses no larger than those of the substep before the last.

        The warm start would repeat an impact, and passes would not take that back. With frames,
        begin with none: where a ball sits between balls of a frame, impulses can be so large that
        the least turn of the frame would throw it.
        """
        for load in self.loads:
            c, before = load.c, load.c.jn
            lower(c, 0.0 if self.rods else c.last)
            c.last = before

    def end(self) -> None:
        """Lower impulses to those before a move: a step without this pile begins with them."""
        for load in self.loads if self.rods else []:
            lower(load.c, min(load.c.last, load.pressed))

    def settle(self, balls: Group, statics: Group, h: float) -> None:
        """Solve for all impulses, if a pass over these groups has left more than a calm speed."""
        if self.is_wild:
            return
        self.balls, self.statics, self.h = balls, statics, h
        for load in self.loads:
            load.update_normal()
        lack = self.lack()
        if lack > self.calm:
            self.press(lack)
        for load in self.loads if self.rods and not balls.has_moved else []:
            load.pressed = load.c.jn

    def lack(self) -> float:
        """Return the most that a contact or joint lacks, in px/s."""
        self.aim()
        pressing = [load.rhs if load.c.jn == 0 else abs(load.rhs) for load in self.loads]
        return max([0.0, *pressing, *[abs(one.rhs) for one in (*self.rods, *self.springs)]])

    def press(self, lack: float) -> None:
        """Apply the impulses of the contacts that press, and of the rods.

        Change nothing if more (px/s) would then lack than before, as where rods turn very far.
        """
        if self.network is None:
            self.network = Network(self.rows)
        for load in self.loads:
            load.total = load.c.jn
        is_sure = self.balls.has_moved or not self.rods
        accepts = None if is_sure else lambda: self.lack() <= lack
        solve_within(self.network, self.loads, self.aim, self.calm, accepts)

    def aim(self) -> None:
        """Set each row's pivot and rhs."""
        h, has_moved = self.h, self.balls.has_moved
        for load in self.loads:
            load.aim(self.balls if load.end_b.inv_mass else self.statics, h)
        for rod, length in zip(self.rods, self.lengths, strict=True):
            rod.ask(0.0 if has_moved else rod.speed() + (length - length_after(rod, h)) / h)
        for spring in self.springs:
            if has_moved:  # a spring acts before the move alone
                spring.pivot, spring.rhs = FREE, 0.0
            else:
                spring.aim()


def lower(c: Contact, most: float) -> None:
    """Lower the impulses of a contact until the normal one is at most this (kg px/s)."""
    before, c.jn = c.jn, max(min(c.jn, most), 0.0)
    if c.jn < before:
        c.jt *= c.jn / before  # friction without its load would throw balls


def length_after(rod: Joint, h: float) -> float:
    """Return the length (px) of a rod after a move of h seconds."""
    a, b = rod.end_a, rod.end_b
    return hypot(b.x - a.x + (b.vx - a.vx) * h, b.y - a.y + (b.vy - a.vy) * h)
