"""Hits of one moment: the impulses of contacts, friction and rods, solved together."""

from collections.abc import Sequence

from .contact import Contact
from .limits import LimitedRow, solve_within
from .network import Network
from .row import Row

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


def resolve_at_once(hits: list[Hit], rods: list[Row]) -> None:
    """Make bodies separate at the speeds that are wanted, or faster.

    Normal impulses come first, then friction limited by them, so no energy is created. Rods are to
    keep their lengths.
    """
    least = LEAST * max([hit.wanted - hit.speed() for hit in hits])
    reach(hits, rods, least)
    reach([Rub(hit) for hit in hits if hit.mu * hit.total], rods, least)


def reach(rows: Sequence[Hit], rods: list[Row], least: float) -> None:
    """Give rows the impulses that they need together, and rods those that hold them."""
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
