"""Unload contacts: bodies that press less, or leave, take off the impulses kept under them."""

from math import hypot

from .body import Body
from .contact import Contact
from .effect import Direction


def take_off(contacts: list[Contact], lost: dict[Body, float], direction: Direction) -> None:
    """Take the impulses (kg px/s) that bodies have lost off the contacts that bear them.

    All that a body has lost goes through the contacts ahead of it in the direction, in the ratio of
    what they bear, to the bodies there. A body that leaves has lost infinity: it bears nothing
    either. Without a static body, nothing bears what touched it.
    """
    beside: dict[Body, list[Contact]] = {}
    for c in contacts:
        beside.setdefault(c.a, []).append(c)
        beside.setdefault(c.b, []).append(c)
    x, y = direction
    found = in_touch([*lost], beside)
    for body in sorted(found, key=lambda body: body.x * x + body.y * y):
        if body.is_static:
            for c in [c for ball in found if ball.m for c in beside.get(ball, [])]:
                c.jn = c.jt = 0.0
        elif body in lost:
            unload(body, lost, beside.get(body, []), direction)


def unload(
    ball: Body, lost: dict[Body, float], contacts: list[Contact], direction: Direction
) -> None:
    """Lower the impulses of a ball's contacts by what it lost, and note what those ahead lose."""
    x, y = direction
    size = hypot(x, y) or 1.0
    sides = [(c, c.b, 1.0) if c.a is ball else (c, c.a, -1.0) for c in contacts]
    ahead = [(c, other, (c.nx * x + c.ny * y) / size * side) for c, other, side in sides]
    borne = sum([c.jn * max(share, 0.0) for c, _, share in ahead])
    left = max(1 - lost[ball] / borne, 0.0) if borne else 0.0
    for c, other, share in ahead:
        if share > 0 and not other.is_static:
            lost[other] = lost.get(other, 0.0) + c.jn * (1 - left) * share
        c.jn *= left
        c.jt *= left


def in_touch(bodies: list[Body], beside: dict[Body, list[Contact]]) -> list[Body]:
    """Return these bodies and the balls that touch them, directly or through other balls."""
    found, ahead = dict.fromkeys(bodies), [*bodies]
    while ahead:
        near = [b for c in beside.get(ahead.pop(), []) for b in (c.a, c.b) if not b.is_static]
        ahead += [b for b in dict.fromkeys(near) if b not in found]
        found.update(dict.fromkeys(near))
    return list(found)
