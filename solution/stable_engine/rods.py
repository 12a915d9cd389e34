"""Rods: two centres keep their distance."""

from math import hypot, sqrt

from .body import Body
from .contacts import Contacts
from .joint import Joint, Joints
from .network import Network, connect
from .soft import SAME_DIRECTION, Pace, softness
from .validate import require

FREQUENCY = 0.25  # of a rod, per substep
DAMPING_RATIO = 5.0
STIFFENING = 0.02  # of a substep, per step
PASSES = 6  # of Newton's method: a length is no linear function of the speeds
NEAR = 1e-5  # share of a length; a pass that begins so near is the last
EXACT = 1e-10  # share of a length, at which the passes end
LOOSE = 0.003  # share of a length; if the last pass is off by more, it is soft
GUARDED = 0.9  # cosine; where a rod turns further in a substep, none may gain energy
TURNED = 0.8  # cosine of what a rod may turn by in a substep
FIRM = 1 + 1e-9  # times a pivot: where there are more rods than needed, a matrix has no inverse
ROUNDING = 1e-9  # share of a length


class Rod(Joint):
    """A rigid rod that keeps the distance a and b start with. It pulls and pushes."""

    __slots__ = ("j",)
    effect = "Rods"

    def __init__(self, a: Body, b: Body) -> None:
        super().__init__(a, b)
        self.fitting(self.rest)
        self.j = 0.0  # kg px/s, accumulated impulse, positive when it pushes

    @property
    def impulse(self) -> float:
        """Return the impulse (kg px/s) of the latest substep: positive if it pushes, negative if it
        pulls. Divide it by the length of a substep for the force.
        """
        return self.j

    def fitting(self, length: float) -> float:
        found = super().fitting(length)
        require(found > 0, "Rod.length", found, "above 0: move a and b apart first")
        return found


class Rods(Joints[Rod]):
    """Rods on the length they will have after the move, solved together (SHAKE and RATTLE).

    With the speed along the axis alone, a swinging rod would stretch in every move. relax works
    along the axis after the move: along the one before, a pendulum would lose energy.

    An error of length that is there is taken back softly. Where a rod of a frame turns far in one
    substep, the speeds of its balls are scaled, so that rods do no work. Where it turns even
    further, all are soft, and may take energy. If its ends would pass each other, use the speed
    along the present axis; the direction after the move would drive them on.
    """

    rank = 2

    def __init__(self) -> None:
        super().__init__()
        self.pace = Pace(STIFFENING)
        self.frames: list[Frame] = []
        self.frame_of: dict[Body, Frame] = {}
        self.is_stale = False

    def add(self, rod: Rod) -> None:
        super().add(rod)
        self.is_stale = True
        self.let_touch(rod, may_touch(rod))

    def remove(self, rod: Rod) -> None:
        super().remove(rod)
        self.let_touch(rod, True)

    def body_changed(self, body: Body) -> None:
        super().body_changed(body)
        self.is_stale = True
        for rod in self.joints:
            if body in (rod.a, rod.b):
                self.let_touch(rod, may_touch(rod))

    def let_touch(self, rod: Rod, may: bool) -> None:
        """Let the ends of a rod touch or not."""
        contacts = self.world.effects.get("Contacts")
        if not isinstance(contacts, Contacts):
            return
        if may:
            contacts.heed_pair(rod.a, rod.b)
        else:
            contacts.ignore_pair(rod.a, rod.b)

    def awake_changed(self) -> None:
        super().awake_changed()
        self.is_stale = True
        self.pace.awake_changed(len(self.awake) < len(self.joints))

    def prepare(self, h: float) -> None:
        self.spring = softness(FREQUENCY / self.pace.follow(h), DAMPING_RATIO, h)
        self.find_frames()

    def find_frames(self) -> None:
        """Find the rods that balls connect, if there are others than before."""
        if self.is_stale:
            self.is_stale = False
            self.frames = [Frame(network) for network in connect(self.awake)]
            self.frame_of = {ball: frame for frame in self.frames for ball in frame.balls}

    def warm_start(self, h: float) -> None:
        for rod in self.awake:
            rod.measure()
            rod.apply_impulse(rod.j)

    def solve(self, h: float) -> None:
        bias_rate, mass_scale = self.spring
        for frame in self.frames:
            frame.keep_lengths(h, bias_rate / mass_scale, 1 / mass_scale)

    def relax(self, h: float) -> None:
        for frame in self.frames:
            frame.take_back_stretching()


class Frame:
    """Rods that balls connect."""

    def __init__(self, network: Network[Rod]) -> None:
        self.network = network
        self.rods = network.joints
        ends = dict.fromkeys([body for rod in self.rods for body in (rod.end_a, rod.end_b)])
        self.balls = [body for body in ends if not body.is_static]
        self.hangs = len(self.balls) < len(ends)
        self.most = -1.0  # kg px²/s², the energy that it may have, or -1 for any
        self.lost = 0.0  # kg px²/s², what it has lost while it turned fast, and may gain again
        self.work = 0.0  # kg px²/s², that its rods have done in this substep, if they are firm
        self.is_off = False  # whether a rod was torn or hit before this substep
        self.gave_way = False  # whether its rods may take energy in this substep

    def keep_lengths(self, h: float, bias: float, soft: float) -> None:
        """Choose velocities with which all rods have their lengths after the move (SHAKE).

        bias is the share per second of an error of length that is taken back, soft by how much
        more a rod gives way where it turns too far in a substep for Newton's method.
        """
        is_soft = False
        for left in range(PASSES - 1, -1, -1):
            off, turned = self.look_ahead(h, bias)
            if off <= EXACT:
                break
            is_soft = turned < TURNED or (left == 0 and off > LOOSE)
            if self.most < 0 and (is_soft or turned < GUARDED):
                self.most = self.energy_before(h)
            if is_soft:
                for rod in self.rods:
                    rod.pivot = soft / rod.m
                    rod.rhs -= (soft - 1) * rod.j / rod.m
            self.apply()
            for rod in self.rods:
                rod.j += rod.rhs
            if is_soft or off < NEAR:
                break
        if self.most >= 0:
            self.gave_way = is_soft or self.is_off
            self.work = self.energy(*self.velocity()) - self.most

    def look_ahead(self, h: float, bias: float) -> tuple[float, float]:
        """Set the changes of speed that keep each rod's length in the move to come.

        Returns how far (share of its length) the worst is off, and the cosine by which one turns.
        """
        off, turned = 0.0, 1.0
        for rod in self.rods:
            a, b = rod.end_a, rod.end_b
            dx, dy = rod.dx + (b.vx - a.vx) * h, rod.dy + (b.vy - a.vy) * h
            ahead, distance = dx * rod.nx + dy * rod.ny, hypot(dx, dy)
            turn = ahead / distance if distance else -1.0  # a cosine
            speed = (distance - rod.distance) / h if ahead > 0 else rod.speed()
            speed += bias * (rod.distance - rod.rest)
            rod.pivot, rod.rhs = FIRM / rod.m, -speed / turn if turn > TURNED else -speed
            off = max(off, abs(speed) * h / rod.rest)
            turned = min(turned, turn)
        return off, turned

    def apply(self) -> None:
        """Give all rods the changes of speed that they want. rhs holds the impulses then."""
        self.network.solve()
        for rod in self.rods:
            rod.apply_impulse(rod.rhs)

    def hold(self) -> None:
        """Pass an impact on: take from the balls all speed along the rods."""
        for rod in self.rods:
            rod.measure()
            rod.pivot, rod.rhs = FIRM / rod.m, -rod.speed()
        self.apply()

    def take_back_stretching(self) -> None:
        """Take from the balls all speed along the rods, where these are now (RATTLE)."""
        for rod in self.rods:
            nx, ny = rod.nx, rod.ny
            rod.measure()
            if nx * rod.nx + ny * rod.ny < SAME_DIRECTION:
                rod.j = 0.0
            rod.pivot, rod.rhs = FIRM / rod.m, -rod.speed()
        if self.most < 0:
            self.apply()
            self.lost = 0.0
            return
        self.work -= self.energy(*self.velocity())
        self.apply()
        self.keep_energy()

    def energy_before(self, h: float) -> float:
        """Return the energy that the balls had before the rods acted in this substep.

        Find out as well whether any rod is off its length, or would be without impulses: one that
        was torn or hit takes energy.
        """
        self.is_off = False
        for rod in self.rods:
            rod.apply_impulse(-rod.j)
        for rod in self.rods:
            off = abs(rod.distance - rod.rest) + abs(rod.speed()) * h
            self.is_off = self.is_off or off > LOOSE * rod.rest
        energy = self.energy(*self.velocity())
        for rod in self.rods:
            rod.apply_impulse(rod.j)
        return energy

    def velocity(self) -> tuple[float, float]:
        """Return the velocity (px/s) of the whole frame, 0 where it hangs on something static."""
        if self.hangs:
            return 0.0, 0.0
        mass = sum([ball.m for ball in self.balls])
        momentum_x = sum([ball.m * ball.vx for ball in self.balls])
        return momentum_x / mass, sum([ball.m * ball.vy for ball in self.balls]) / mass

    def energy(self, vx: float, vy: float) -> float:
        """Return twice the energy (kg px²/s²) of the balls, seen at a velocity."""
        return sum([b.m * ((b.vx - vx) ** 2 + (b.vy - vy) ** 2) for b in self.balls])

    def keep_energy(self) -> None:
        """Scale the speeds of the balls as seen from the whole, so that rods do no work.

        Some may take energy, see energy_before. The balls never get more than they had.
        """
        vx, vy = self.velocity()
        energy = self.energy(vx, vy)
        most = self.most + self.lost
        wanted = min(energy if self.gave_way else max(-self.work, 0.0), most)
        self.lost = most - wanted
        if energy > 0 and wanted != energy:
            share = sqrt(wanted / energy)
            for ball in self.balls:
                ball.vx = vx + (ball.vx - vx) * share
                ball.vy = vy + (ball.vy - vy) * share
        self.most = -1.0


def may_touch(rod: Rod) -> bool:
    """Return whether a rod leaves a gap between its ends: a contact would fight a shorter one."""
    return rod.rest > (rod.a.r + rod.b.r) * (1 + ROUNDING)
