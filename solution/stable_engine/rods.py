"""Rods keep the distance of two centres. Those that balls connect are solved as a frame."""

from .body import Body
from .frame import Frame
from .joint import Joint, Joints
from .molecule import Molecule, find_molecules
from .network import connect
from .soft import Pace, softness
from .springs import Springs
from .validate import require

FREQUENCY = 0.25  # of a rod, per substep
DAMPING_RATIO = 5.0
STIFFENING = 0.02  # of a substep, per step
ROUNDING = 1e-9  # share of a length


class Rod(Joint):
    """A rigid rod that keeps the distance a and b start with. It pulls and pushes."""

    __slots__ = ("j",)
    effect = "Rods"

    def __init__(self, a: Body, b: Body) -> None:
        super().__init__(a, b)
        self.fitting(self.rest)
        self.j = 0.0  # kg px/s, accumulated impulse before the move, positive when it pushes

    def may_touch(self) -> bool:
        """Return whether it leaves a gap between its ends; a contact would fight a shorter rod."""
        return self.rest > (self.end_a.r + self.end_b.r) * (1 + ROUNDING)

    def fitting(self, length: float) -> float:
        found = super().fitting(length)
        require(found > 0, "Rod.length", found, "above 0: move a and b apart first")
        return found


class Rods(Joints[Rod]):
    """Rods with the right length after the move, solved together (SHAKE and RATTLE).

    If only the speed along the axis were removed, a swinging rod would stretch in every move. relax
    uses the axis after the move: with the one before, a pendulum would lose energy.

    If a rod of a frame turns far in a substep, or light balls between heavy ones move fast, the
    frame cuts the substep into parts: soft rods would lose a fifth of the energy of a fast
    dumbbell. With masses that differ much, it does so until impulses are steady. Where rods are
    torn, turn too fast for that, or hang on bodies that move apart, they give way: the parts alone
    would give them energy. Existing errors of length are corrected softly. If a rod's ends would
    pass each other, the speed along the present axis counts, as that after the move would drive
    them on. Frames that stiff springs tie are solved with these first, see Molecule.
    """

    __slots__ = ("frame_of", "frames", "known", "molecules", "pace", "spring", "springs")
    rank = 2

    def __init__(self) -> None:
        super().__init__()
        self.pace = Pace(STIFFENING)
        self.frames: list[Frame] = []
        self.frame_of: dict[Body, Frame] = {}
        self.molecules: list[Molecule] = []
        self.known: tuple[object, object, float] = None, None, 0.0  # for what these were found

    def attach(self) -> None:
        self.springs = self.world.find(Springs)  # those of the scene, if it declares any

    def add(self, rod: Rod) -> None:
        super().add(rod)
        self.world.call("let_touch", rod.a, rod.b, rod.may_touch())

    def remove(self, rod: Rod) -> None:
        super().remove(rod)
        self.world.call("let_touch", rod.a, rod.b, True)

    def body_changed(self, body: Body) -> None:
        super().body_changed(body)
        for rod in self.joints_at(body):
            self.world.call("let_touch", rod.a, rod.b, rod.may_touch())

    def prepare(self, h: float) -> None:
        self.spring = softness(FREQUENCY / self.pace.follow(h), DAMPING_RATIO, h)
        self.find_frames()
        if self.springs:
            self.find_molecules(self.springs, h)

    def find_frames(self) -> None:
        """Find the frames again, if rods were added or removed."""
        if self.is_stale:
            self.is_stale = False
            self.frames = [Frame(network, self.world) for network in connect(self.awake)]
            self.frame_of = {ball: frame for frame in self.frames for ball in frame.balls}

    def find_molecules(self, springs: Springs, h: float) -> None:
        """Find frames that stiff springs tie, if rods, springs or the substep have changed."""
        frames, networks, last = self.known
        if not (frames is self.frames and networks is springs.networks and last == h):
            self.known = self.frames, springs.networks, h
            self.molecules = find_molecules(self.frames, self.frame_of, springs, h)

    def lag(self, seconds: float) -> None:
        """Let rods act on what others add; a frame is pressed if any of its balls is."""
        self.find_frames()
        for frame in self.frames:
            if any([ball.is_pressed for ball in frame.balls]):
                for ball in frame.balls:
                    ball.is_pressed = True
            else:
                frame.hold_lags()

    def holds(self, body: Body) -> bool:
        """Return whether a body is a ball on one of these."""
        self.find_frames()
        return body in self.frame_of

    def warm_start(self, h: float) -> None:
        for rod in self.awake:
            rod.measure()
            rod.given = 0.0
            rod.apply_impulse(rod.j)

    def solve(self, h: float) -> None:
        bias_rate, mass_scale = self.spring
        bias = bias_rate / mass_scale
        for molecule in self.molecules:
            molecule.solve(h, bias)
        for frame in self.frames:
            frame.keep_lengths(h, bias, 1 / mass_scale)

    def relax(self, h: float) -> None:
        for frame in self.frames:
            frame.take_back_stretching(h)
