"""Hits of one moment: the impulses of contacts, friction and rods, solved together."""

from collections.abc import Sequence
from math import sqrt

from .contact import Contact
from .flight import Flight
from .frame import Frame
from .limits import LimitedRow, solve_within
from .network import Network
from .order import balls_of
from .row import Row
from .time_of_impact import speed_at_touch

LEAST = 1e-9  # share of the speed of the hardest impact of a moment; less may be left


class Hit(LimitedRow):
    """A contact whose impact is resolved together with others of the same moment."""

    __slots__ = ("mu", "wanted")

    def __init__(self, c: Contact, law: tuple[float, float]) -> None:
        super().__init__(c)
        self.wanted, share = law  # px/s, the speed at which to separate
        self.mu = c.mu * share


class Rub(Hit):
    """The friction of a contact after its impact: it slows the slip, as far as a limit."""

    __slots__ = ()

    def __init__(self, hit: Hit) -> None:
        super().__init__(hit.c, (0.0, 0.0))
        c = hit.c
        c.set_arms(c.gap)
        self.m = c.mt
        self.nx, self.ny = -self.ny, self.nx
        self.arm_a, self.arm_b = c.arm_a, c.arm_b
        if self.end_a is not c.a:
            self.arm_a, self.arm_b = c.arm_b, c.arm_a
        self.high = hit.mu * hit.total
        self.low = -self.high

    def speed(self) -> float:
        rims = self.end_a.w * self.arm_a + self.end_b.w * self.arm_b
        return super().speed() - rims

    def apply_impulse(self, j: float) -> None:
        super().apply_impulse(j)
        self.end_a.w -= self.arm_a * j * self.end_a.inv_inertia
        self.end_b.w -= self.arm_b * j * self.end_b.inv_inertia


def resolve(group: list[Contact], frames: list[Frame], flight: Flight) -> None:
    """Make contacts separate at the speeds of the law, or faster.

    Normal impulses come first, then friction limited by them, so no energy is created.
    """
    for frame in frames:
        frame.hold()
    hits = [Hit(c, law_of(c, flight)) for c in group]
    rods = [Row(rod.end_a, rod.end_b, rod.nx, rod.ny) for frame in frames for rod in frame.rods]
    least = LEAST * max([hit.wanted - hit.speed() for hit in hits])
    resolve_at_once(hits, rods, least)
    resolve_at_once([Rub(hit) for hit in hits if hit.mu * hit.total], rods, least)
    for body in balls_of(group) if flight.rests else []:
        if body in flight.rests and body not in flight.frame_of:
            flight.release(body)


def law_of(c: Contact, flight: Flight) -> tuple[float, float]:
    """Return the speed (px/s) at which a pair separates.

    At any step size a ball leaves a wall exactly: e is applied to its speed at the surface. If
    it was not moved back there, conservation of energy gives that speed, and the present one.

    Also return the share of the impulse without the speed gained below the surface.
    """
    closing, e = c.closing_speed(), c.e
    g, lag = flight.closing_acceleration(c)
    lag += flight.stiff_lag(c) if flight.stiff else 0.0
    if g == lag == 0:
        return e * closing, 1.0
    crossing = max(speed_at_touch(c, closing, g, lag), 0.0)
    gap = c.gap if abs(c.gap) > flight.contacts.touching_gap else 0.0
    most = (closing + lag) * (closing + lag)
    parting = sqrt(max(min(e * e * crossing * crossing - 2 * g * gap, most), 0.0)) + lag
    whole = parting + closing
    return parting, min((1 + e) * crossing / whole, 1.0) if whole > 0 else 1.0


def resolve_at_once(rows: Sequence[Hit], rods: list[Row], least: float) -> None:
    """Give the rows the impulses that they need together. Rods are to keep their lengths."""
    if not rows:
        return
    if len(rows) == 1 and not rods:
        row = rows[0]
        row.ask(row.wanted)
        row.take(max(row.low, min(row.rhs * row.m, row.high)))
        return

    def aim() -> None:
        for row in rows:
            row.ask(row.wanted)
        for rod in rods:
            rod.ask(0.0)

    network: Network[Row] = Network([*rows, *rods])
    for _ in range(2):  # the second takes back what firmness has left
        solve_within(network, rows, aim, least)
