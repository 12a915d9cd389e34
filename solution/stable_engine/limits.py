"""Impulses within limits: contacts push and never pull, and friction holds only so much."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf

from .contact import Contact
from .network import Network, bodies_of
from .row import Row

TURNS = 16  # of changing all rows that are wrong, without fewer; then one is changed at a time
MOST_TURNS = 200
FREE = 1e30  # 1/kg, the pivot of a row that takes no impulse
ROUNDING = 2.0**-52  # share of a number


class LimitedRow(Row):
    """A contact as a row of a network, whose total impulse stays within limits.

    Which body is A does not depend on the contact's.
    """

    __slots__ = ("at", "c", "high", "low", "total")

    def __init__(self, c: Contact) -> None:
        a, b = c.a, c.b
        if b.inv_mass and (b.x < a.x or (b.x == a.x and b.y < a.y)):
            a, b = b, a
        super().__init__(a, b, 0.0, 0.0)
        self.c = c
        self.update_normal()
        self.low, self.high = 0.0, inf  # kg px/s
        self.total = 0.0  # kg px/s, its impulse so far
        self.at = 0.0  # -1 at the lower limit, 1 at the upper one, 0 between them

    def update_normal(self) -> None:
        """Take over the normal of the contact."""
        sign = 1.0 if self.end_a is self.c.a else -1.0
        self.nx, self.ny = sign * self.c.nx, sign * self.c.ny

    def take(self, j: float) -> None:
        self.apply_impulse(j)
        self.total += j

    def begin(self, least: float) -> None:
        """Choose a side to begin with."""
        self.at = 0.0
        if self.total <= self.low and self.rhs <= least:
            self.at = -1.0
        elif self.total >= self.high and self.rhs >= -least:
            self.at = 1.0

    def excess(self) -> float:
        """Return what its impulse lacks to the limit that it is at, or is beyond; else 0."""
        if self.at < 0 or self.total < self.low:
            return self.low - self.total
        return self.high - self.total if self.at > 0 or self.total > self.high else 0.0

    def is_wrong(self, least: float) -> bool:
        """Return whether it is beyond a limit, or at one while its bodies need less there."""
        if self.at:
            return self.at * self.rhs < -least
        return not self.low <= self.total <= self.high

    def switch(self) -> None:
        """Go to the limit that it is beyond, or leave the one it is at."""
        self.at = 0.0 if self.at else -1.0 if self.total < self.low else 1.0


def solve_between(
    network: Network[Row],
    limited: Sequence[LimitedRow],
    aim: Callable[[], None],
    taken: dict[Row, float],
    most: float,
) -> bool:
    """Take rows at a limit there, and solve for all others. Add their impulses to those taken.

    Return False, and take none, if any would be more than `most` (kg px/s).
    """
    fixed = [row for row in limited if row.at]
    for row in fixed:
        j = row.excess()
        taken[row] += j
        row.take(j)
    aim()
    for row in fixed:
        row.pivot, row.rhs = FREE, 0.0
    network.solve()
    for row in fixed:
        row.rhs = 0.0
    if not all([abs(one.rhs) <= most for one in network.rows]):
        return False
    for one in network.rows:
        taken[one] += one.rhs
        one.take(one.rhs)
    return True


def solve_within(
    network: Network[Row],
    limited: Sequence[LimitedRow],
    aim: Callable[[], None],
    least: float,
    accepts: Callable[[], bool] | None = None,
) -> None:
    """Find the impulses of all rows together: those of `limited` stay within their limits.

    aim sets each row's pivot and rhs, see Network.solve. Each turn solves for some rows, then lets
    go of those beyond their limits, and takes those that still lack more than `least` px/s (block
    pivoting, Júdice and Pires 1994). If that does not end, or `accepts` refuses its end, or if
    impulses get so large that speeds are rounded by more than `least`, nothing changes.
    """
    before = [(body, body.vx, body.vy, body.w) for body in bodies_of(network.rows)]
    lightest = min([body.m for body, *_ in before if body.inv_mass])
    most = least / ROUNDING * lightest  # kg px/s
    taken = dict.fromkeys(network.rows, 0.0)  # kg px/s
    aim()
    for row in limited:
        row.begin(least)
    fewest, patience = len(limited) + 1, TURNS
    for _ in range(MOST_TURNS):
        if not solve_between(network, limited, aim, taken, most):
            break
        aim()
        wrong = [row for row in limited if row.is_wrong(least)]
        if not wrong:
            if accepts is None or accepts():
                return
            break
        patience -= 1
        if len(wrong) < fewest:
            fewest, patience = len(wrong), TURNS
        for row in wrong if patience > 0 else wrong[:1]:
            row.switch()
    for one, j in taken.items():
        one.take(-j)
    for body, vx, vy, w in before:
        body.vx, body.vy, body.w = vx, vy, w
