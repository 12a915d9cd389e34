"""The order in which contacts are solved: one that looks the same in a mirror."""

from bisect import insort
from collections import Counter
from collections.abc import Callable
from itertools import groupby
from math import hypot
from operator import attrgetter

from .body import Body
from .contact import Contact

PLACE = attrgetter("place")
FEW = 0.1  # share of the contacts in order; so many new ones are put in one by one
LEFT = 1e-9  # share of an impulse that is nothing but rounding


class Group:
    """Contacts that are solved alike: ball against ball, or ball against static body."""

    __slots__ = (
        *("bias_rate", "contacts", "has_moved", "in_turn", "is_mirrored", "least", "load_rate"),
        *("mass_scale", "max_push_speed", "moves_b", "ordered", "sorted", "ties", "sortings"),
    )

    def __init__(self, moves_b: bool) -> None:
        self.moves_b = moves_b  # whether an impulse moves B
        self.contacts: list[Contact] = []
        self.in_turn: list[Contact] = []  # those of them that are solved one after the other
        self.ties: list[Tie] = []  # the others
        self.ordered: list[Contact] = []  # the contacts when they were put in order
        self.sorted: list[Contact] = []  # those in order
        self.sortings = 0  # how often they were put in order
        self.is_mirrored = False  # whether any two of them had the same place then
        self.bias_rate = self.mass_scale = 0.0  # see softness
        self.load_rate = 0.0  # 1/s, of piles: any step explains a load by the same overlap
        self.has_moved = False  # whether bodies have moved in this substep
        self.max_push_speed = 0.0  # px/s, overlap is pushed out no faster
        self.least = 0.0  # px and px/s, less counts as 0; at 0, rounding would decide

    def borne(self, c: Contact) -> float:
        """Return the overlap (px) that the load of a contact explains."""
        return (1 - self.mass_scale) / self.bias_rate * c.jn / c.mn


Stage = Callable[[Group, list[Contact], float], None]


class Tie:
    """Contacts that share balls and the same place in the order, as a mirror makes them.

    They are solved at once. One after the other, the first one would have to do more than the last.
    """

    def __init__(self, contacts: list[Contact], grain: float) -> None:
        self.contacts = contacts
        self.least = grain / 4  # px and px/s; less counts as 0
        self.balls = balls_of(contacts)
        self.share = share_of_each(contacts)

    def solve(self, stage: Stage, group: Group, h: float) -> None:
        """Solve each contact as if it were alone, and add up a share of what that changes.

        A contact that lets go does so wholly: what is left of an impulse would pull.
        """
        if self.is_idle(group):
            return
        changes = []
        before = [(ball, ball.vx, ball.vy, ball.w) for ball in self.balls]
        for c in self.contacts:
            jn, jt = c.jn, c.jt
            stage(group, [c], h)
            share = 1.0 if c.jn < LEFT * jn else self.share
            c.jn, c.jt = jn + share * (c.jn - jn), jt + share * (c.jt - jt)
            for ball, vx, vy, w in before:
                change = share * (ball.vx - vx), share * (ball.vy - vy), share * (ball.w - w)
                changes.append((ball, change))
                ball.vx, ball.vy, ball.w = vx, vy, w
        for ball, (vx, vy, w) in changes:
            ball.vx += vx
            ball.vy += vy
            ball.w += w

    def is_idle(self, group: Group) -> bool:
        """Return whether no contact presses or would press, as mostly with a ball between walls."""
        least = -self.least
        for c in self.contacts:
            if c.jn or c.jt:
                return False
            a, b, nx, ny = c.a, c.b, c.nx, c.ny
            if (b.vx - a.vx) * nx + (b.vy - a.vy) * ny < least:
                return False
            gap = (b.x - a.x) * nx + (b.y - a.y) * ny - c.reach
            if group.bias_rate * gap < least:
                return False
        return True


def give_places(
    contacts: list[Contact], g: tuple[float, float], grain: float, number: float
) -> bool:
    """Give new contacts their places: from below upwards, and from the middle of all outwards.

    Without gravity, only the latter. Rounding may part equal places by a `grain` (px). The
    `number` of this call comes last, so that only contacts that begin together have the same place.
    Return whether any two have, as in a mirrored scene.
    """
    middle_x = middle_y = 0.0
    count = float(len(contacts))  # a float: compiled, it divides faster
    for c in contacts:
        a, b = c.a, c.b
        x, y = a.x + a.r * c.nx, a.y + a.r * c.ny
        if b.inv_mass:  # the same whichever is A
            x, y = (a.x + b.x) / 2, (a.y + b.y) / 2
        c.place = x, y, number
        middle_x += x / count
        middle_y += y / count
    gx, gy = g
    g_size, coarse = hypot(gx, gy), grain * 2.0**52  # a float so large has no digits below a grain
    for c in contacts:
        x, y, _ = c.place
        off_x, off_y = x - middle_x, y - middle_y
        if g_size:
            up, off = -(x * gx + y * gy) / g_size, abs(off_x * gy - off_y * gx) / g_size
        else:
            up, off = 0.0, hypot(off_x, off_y)
        c.place = (up + coarse) - coarse, (off + coarse) - coarse, number
    return len(contacts) > 1 and len({c.place for c in contacts}) < len(contacts)


def put_in_order(group: Group, grain: float, is_mirrored: bool) -> None:
    """Put the contacts of a group in order; is_mirrored tells whether any may have the same place.

    Most were in it before, so there is little to sort.
    """
    if group.contacts == group.ordered:
        return
    before, group.sortings = group.sortings, group.sortings + 1
    new = [c for c in group.contacts if c.sorting != before]
    for c in group.contacts:
        c.sorting = group.sortings
    kept = [c for c in group.sorted if c.sorting == group.sortings]
    if len(new) <= FEW * len(kept):
        for c in new:
            insort(kept, c, key=PLACE)
    else:
        kept = sorted(kept + new, key=PLACE)
    group.sorted = kept
    group.ordered, group.in_turn, group.ties = group.contacts, group.sorted, []
    group.is_mirrored = False
    if is_mirrored:
        find_ties(group, grain)


def find_ties(group: Group, grain: float) -> None:
    """Find the contacts of a group that have the same place."""
    group.in_turn = []
    for same in in_same_place(group.sorted):
        group.is_mirrored = group.is_mirrored or len(same) > 1
        if len(same) > 1 and share_of_each(same) < 1:
            group.ties.append(Tie(same, grain))
        else:
            group.in_turn += same


def in_same_place(contacts: list[Contact]) -> list[list[Contact]]:
    """Return contacts that are in order, as lists of those in the same place."""
    return [list(same) for _, same in groupby(contacts, PLACE)]


def share_of_each(contacts: list[Contact]) -> float:
    """Return the share of its work that a contact may do at once with others at the same ball."""
    balls = Counter([b for c in contacts for b in (c.a, c.b) if not b.is_static])
    return 1 / max(balls.values())


def balls_of(contacts: list[Contact]) -> list[Body]:
    """Return the balls of contacts, each once."""
    balls: dict[Body, None] = {}
    for c in contacts:
        balls[c.a] = None
        if c.b.inv_mass:
            balls[c.b] = None
    return list(balls)
