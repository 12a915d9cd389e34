"""Joints that share balls, solved together: elimination in a sparse matrix (LDLᵀ)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Generic, TypeVar

from .body import Body
from .joint import AnyJoint, Joint


class Coupling:
    """The effect of an impulse on one joint on the speed of another.

    They share a ball, or each shares one with a joint that is eliminated earlier. The matrix is
    symmetric; once the order is known, `one` is eliminated before `other`.
    """

    __slots__ = ("one", "other", "share", "spin", "value", "weight")

    def __init__(self, one: Joint, other: Joint) -> None:
        self.one = one
        self.other = other
        self.weight = 0.0  # 1/kg, of the balls they share; negative between links of a chain
        self.spin = 0.0  # 1/kg, of the spins of these balls, between rows with arms
        self.value = 0.0  # 1/kg, the entry of the matrix
        self.share = 0.0  # how much of the row of `one` is taken off that of `other`


Thing = TypeVar("Thing")
Fill = tuple[Coupling, Coupling, Coupling]


class Row:
    """A joint, its couplings to later ones, and the changes that eliminating it makes to those."""

    __slots__ = ("couplings", "fills", "joint")

    def __init__(self, joint: Joint, couplings: list[Coupling], fills: list[Fill]) -> None:
        self.joint = joint
        self.couplings = couplings
        self.fills = fills


class Network(Generic[AnyJoint]):
    """Connected joints in the order of elimination: next is the one with the fewest couplings left.

    So a chain or tree costs as much per joint as a pass that treats each joint alone.
    """

    def __init__(self, joints: list[AnyJoint]) -> None:
        self.joints = joints
        beside = couple(joints)
        self.couplings = [c for joint in beside for c in beside[joint].values() if c.one is joint]
        self.filled: list[Coupling] = []
        self.rows: list[Row] = []
        while beside:
            joint = min(beside, key=lambda one: len(beside[one]))
            self.rows.append(self.eliminate(joint, beside))
        self.backwards = self.rows[::-1]

    def eliminate(self, joint: Joint, beside: dict[Joint, dict[Joint, Coupling]]) -> Row:
        """Remove a joint from those left, and couple its neighbours to each other."""
        couplings: list[Coupling] = []
        fills: list[Fill] = []
        for other, c in beside.pop(joint).items():
            del beside[other][joint]
            c.one, c.other = joint, other
            for before in couplings:
                there = beside[other].get(before.other)
                if there is None:
                    there = Coupling(before.other, other)
                    beside[other][before.other] = beside[before.other][other] = there
                    self.filled.append(there)
                fills.append((before, c, there))
            couplings.append(c)
        return Row(joint, couplings, fills)

    def solve(self) -> None:
        """Find the impulses that together give each joint its speed.

        Each joint has `pivot`, its change of speed per unit of impulse (1/kg), and `rhs`, the
        change of speed to reach (px/s). Afterwards `rhs` holds its impulse (kg px/s).
        """
        for c in self.couplings:
            one, other = c.one, c.other
            c.value = c.weight * (one.nx * other.nx + one.ny * other.ny) + c.spin
        for c in self.filled:
            c.value = 0.0
        for row in self.rows:
            if row.couplings:
                joint = row.joint
                pivot, rhs = joint.pivot, joint.rhs
                for c in row.couplings:
                    share = c.share = c.value / pivot
                    other = c.other
                    other.pivot -= share * c.value
                    other.rhs -= share * rhs
                for c, d, filled in row.fills:
                    filled.value -= c.share * d.value
        for row in self.backwards:
            joint = row.joint
            rhs = joint.rhs / joint.pivot
            for c in row.couplings:
                rhs -= c.share * c.other.rhs
            joint.rhs = rhs


def couple(joints: Sequence[Joint]) -> dict[Joint, dict[Joint, Coupling]]:
    """Return the couplings of joints that share balls, by pair of joints."""
    beside: dict[Joint, dict[Joint, Coupling]] = {joint: {} for joint in joints}
    at: dict[Body, list[tuple[Joint, float, float]]] = {}
    for joint in joints:
        a, b = joint.end_a, joint.end_b
        for body, sign, arm in ((a, -1.0, joint.arm_a), (b, 1.0, joint.arm_b)):
            if body.is_static:
                continue
            for other, its_sign, its_arm in at.setdefault(body, []):
                c = beside[joint].get(other)
                if c is None:
                    c = beside[joint][other] = beside[other][joint] = Coupling(other, joint)
                c.weight += sign * its_sign * body.inv_mass
                c.spin += arm * its_arm * body.inv_inertia
            at[body].append((joint, sign, arm))
    return beside


def bodies_of(joints: Sequence[Joint]) -> list[Body]:
    """Return the bodies at the ends of joints, each once."""
    return list(dict.fromkeys([body for one in joints for body in (one.end_a, one.end_b)]))


def connect(joints: list[AnyJoint]) -> list[Network[AnyJoint]]:
    """Return a network for each set of joints that balls connect."""
    return [Network(group) for group in connected(joints, couple(joints))]


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
