"""Crowds: balls whose centre is in another ball are moved apart, and get no speed by that."""

from .contact import Contact, collide
from .order import PLACE, in_same_place

CROWDED = 0.1  # radii, by which balls that bear a load overlap in a crowd
PARTED = 0.3  # share of an overlap that a step takes from balls in a crowd

Crowd = dict[Contact, None]


def gather_crowd(crowd: Crowd, begun: list[Contact], touching: list[Contact], slow: float) -> Crowd:
    """Return the contacts of a crowd. Balls that it is moved against in this step join it.

    `begun` are the contacts that are new. One joins unless it closes in faster than `slow` (px/s).
    """
    members = {body for c in crowd for body in (c.a, c.b)}
    for c in begun:
        met = not (c.b.is_static or members.isdisjoint((c.a, c.b)))
        if met and c.closing_speed() <= slow:
            crowd[c] = None
    return {c: None for c in touching if c in crowd and is_crowded(c)}


def is_crowded(c: Contact) -> bool:
    """Return whether two balls still overlap much, or a little without a load."""
    return c.jn == 0 or c.gap < -CROWDED * min(c.a.r, c.b.r)


def part_crowd(crowd: Crowd, most: float) -> float:
    """Move the balls of a crowd apart, each pair by at most so many px. Return the deepest overlap.

    They are moved and get no speed: impulses between many balls at one position would leave
    some speed, which is energy from nothing. So they turn about each other more slowly.
    """
    deepest = 0.0
    for same in in_same_place(sorted(crowd, key=PLACE)):
        for c, (nx, ny, gap) in [(c, collide(c.a, c.b)) for c in same]:
            a, b = c.a, c.b
            deepest = max(deepest, -gap)
            way = min(max(-PARTED * gap, 0.0), most)
            slip = (b.vy - a.vy) * nx - (b.vx - a.vx) * ny
            slower = 0.0 if c.e else -slip * way / (gap + a.r + b.r + way)
            dx, dy = nx * way * c.mn, ny * way * c.mn
            dvx, dvy = -ny * slower * c.mn, nx * slower * c.mn
            a.x, a.y = a.x - dx * a.inv_mass, a.y - dy * a.inv_mass
            b.x, b.y = b.x + dx * b.inv_mass, b.y + dy * b.inv_mass
            a.vx, a.vy = a.vx - dvx * a.inv_mass, a.vy - dvy * a.inv_mass
            b.vx, b.vy = b.vx + dvx * b.inv_mass, b.vy + dvy * b.inv_mass
            a.still = b.still = 0.0
    return deepest
