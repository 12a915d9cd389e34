"""Rows that share balls, solved together: elimination in a sparse matrix (LDLᵀ)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Generic, TypeVar

from .body import Body
from .row import Row

AnyRow = TypeVar("AnyRow", bound=Row)
Thing = TypeVar("Thing")

HEAVY = 2.5  # ratio of masses; where more presses on less, passes would leave much


class Coupling:
    """The effect of the impulse of one row on the speed of another.

    They share a ball, or each shares one with a row that is eliminated earlier. The matrix is
    symmetric; once the order is known, `one` is eliminated before `other`.
    """

    __slots__ = ("one", "other", "share", "spin", "value", "weight")

    def __init__(self, one: Row, other: Row) -> None:
        self.one = one
        self.other = other
        self.weight = 0.0  # 1/kg, of the balls they share; negative between links of a chain
        self.spin = 0.0  # 1/kg, of the spins of these balls, between rows with arms
        self.value = 0.0  # 1/kg, the entry of the matrix
        self.share = 0.0  # how much of `one` is taken off `other`


Fill = tuple[Coupling, Coupling, Coupling]
# a row that is eliminated, its couplings to later rows, and the changes that it makes to those
Elimination = tuple[Row, list[Coupling], list[Fill]]


class Network(Generic[AnyRow]):
    """Connected rows in the order of elimination: next is the one with the fewest couplings left.

    So a chain or tree costs as much per row as a pass that treats each row alone.
    """

    def __init__(self, rows: list[AnyRow]) -> None:
        self.rows = rows
        beside = couple(rows)
        self.couplings = [c for row in beside for c in beside[row].values() if c.one is row]
        self.filled: list[Coupling] = []
        self.eliminations: list[Elimination] = []
        while beside:
            row = min(beside, key=lambda one: len(beside[one]))
            self.eliminations.append(self.eliminate(row, beside))

    def eliminate(self, row: Row, beside: dict[Row, dict[Row, Coupling]]) -> Elimination:
        """Remove a row from those left, and couple its neighbours to each other."""
        couplings: list[Coupling] = []
        fills: list[Fill] = []
        for other, c in beside.pop(row).items():
            del beside[other][row]
            c.one, c.other = row, other
            for before in couplings:
                there = beside[other].get(before.other)
                if there is None:
                    there = Coupling(before.other, other)
                    beside[other][before.other] = beside[before.other][other] = there
                    self.filled.append(there)
                fills.append((before, c, there))
            couplings.append(c)
        return row, couplings, fills

    def solve(self) -> None:
        """Find the impulses that together give each row its speed.

        Each row has `pivot`, its change of speed per unit of impulse (1/kg), and `rhs`, the
        change of speed to reach (px/s). Afterwards `rhs` holds its impulse (kg px/s).
        """
        for c in self.couplings:
            one, other = c.one, c.other
            c.value = c.weight * (one.nx * other.nx + one.ny * other.ny) + c.spin
        for c in self.filled:
            c.value = 0.0
        for row, couplings, fills in self.eliminations:
            if couplings:
                pivot, rhs = row.pivot, row.rhs
                for c in couplings:
                    share = c.share = c.value / pivot
                    other = c.other
                    other.pivot -= share * c.value
                    other.rhs -= share * rhs
                for c, d, filled in fills:
                    filled.value -= c.share * d.value
        for row, couplings, _ in reversed(self.eliminations):
            rhs = row.rhs / row.pivot
            for c in couplings:
                rhs -= c.share * c.other.rhs
            row.rhs = rhs


def couple(rows: Sequence[Row]) -> dict[Row, dict[Row, Coupling]]:
    """Return the couplings of rows that share balls, by pair of rows."""
    beside: dict[Row, dict[Row, Coupling]] = {row: {} for row in rows}
    at: dict[Body, list[tuple[Row, float, float]]] = {}
    for row in rows:
        a, b = row.end_a, row.end_b
        for body, sign, arm in ((a, -1.0, row.arm_a), (b, 1.0, row.arm_b)):
            if body.is_static:
                continue
            for other, its_sign, its_arm in at.setdefault(body, []):
                c = beside[row].get(other)
                if c is None:
                    c = beside[row][other] = beside[other][row] = Coupling(other, row)
                c.weight += sign * its_sign * body.inv_mass
                c.spin += arm * its_arm * body.inv_inertia
            at[body].append((row, sign, arm))
    return beside


def bodies_of(rows: Sequence[Row]) -> list[Body]:
    """Return the bodies at the ends of rows, each once."""
    return list(dict.fromkeys([body for one in rows for body in (one.end_a, one.end_b)]))


def connect(rows: list[AnyRow]) -> list[Network[AnyRow]]:
    """Return a network for each set of rows that balls connect."""
    return [Network(group) for group in connected(rows, couple(rows))]


def tied_to(rows: list[AnyRow], ball: Body) -> list[AnyRow]:
    """Return the rows that balls connect with this one, directly or through others."""
    groups = connected(rows, couple(rows))
    return next((group for group in groups if ball in bodies_of(group)), [])


def connected(things: list[Thing], beside: Mapping[Any, Iterable[Any]]) -> list[list[Thing]]:
    """Return groups of things that are connected directly or through others, in the same order."""
    first_of: dict[Any, Thing] = {}
    for first in things:
        ahead: list[Any] = [first]
        while ahead:
            one = ahead.pop()
            if one not in first_of:
                first_of[one] = first
                ahead += beside[one]
    groups: dict[Thing, list[Thing]] = {}
    for thing in things:
        groups.setdefault(first_of[thing], []).append(thing)
    return list(groups.values())
