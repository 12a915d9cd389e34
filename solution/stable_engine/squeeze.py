"""Balls that static bodies squeeze, and friction holds: they keep little of the squeeze."""

from __future__ import annotations

from math import hypot
from operator import attrgetter
from typing import TYPE_CHECKING

from .body import Body
from .contact import RESTING_SPEED, Contact

if TYPE_CHECKING:
    from .contacts import Contacts

BORNE = 40.0  # weights of a ball; static bodies need no larger impulses beside what it carries
HELD = 0.1  # of the normal impulse; with less, friction does not hold what is squeezed

IMPULSE = attrgetter("jn")


class Squeeze:
    """Two contacts of a ball with static bodies that press it against each other."""

    __slots__ = ("c", "most", "other")

    def __init__(self, c: Contact, other: Contact, most: float) -> None:
        self.c, self.other = c, other  # the one that presses more first
        self.most = most  # kg px/s, what that one may keep

    def ease(self) -> None:
        """Take equal and opposite impulses from both, along the line between their points.

        So the ball feels neither a push nor a torque. It would creep by those of one contact alone.
        """
        c, other = self.c, self.other
        less = min(c.jn - self.most, other.jn)
        if less > 0:
            turn = less * (c.nx * other.ny - c.ny * other.nx) / (1 - opposed(c, other))
            c.jn -= less
            c.jt += turn
            other.jn -= less
            other.jt -= turn


def opposed(c: Contact, other: Contact) -> float:
    """Return the cosine of the angle between two normals: -1 if they are opposite."""
    return c.nx * other.nx + c.ny * other.ny


def find_squeezes(contacts: Contacts, h: float) -> list[Squeeze]:
    """Return the squeezes that store more than anything bears: weights, and what others press.

    Once friction gives way, these would throw the ball.
    """
    world, statics = contacts.world, contacts.statics.contacts
    kept = max(RESTING_SPEED * world.unit, BORNE * hypot(*world.g) * h)  # px/s
    large = [c for c in statics if c.jn > kept * c.mn and abs(c.jt) > HELD * c.jn]
    most = {c.a: kept * c.mn for c in large if not c.a.joint_count}
    if not most:
        return []
    for c in contacts.balls.contacts:
        for body in (c.a, c.b):
            if body in most:
                most[body] += c.jn
    pressed: dict[Body, list[Contact]] = {}
    for c in statics:
        if c.a in most:
            pressed.setdefault(c.a, []).append(c)
    squeezes: list[Squeeze] = []
    for a, pressing in pressed.items():
        pressing.sort(key=IMPULSE, reverse=True)
        if len(pressing) > 1:
            c, other = pressing[0], pressing[1]
            if c.jn > most[a] and opposed(c, other) < 0:
                squeezes.append(Squeeze(c, other, most[a]))
    return squeezes
