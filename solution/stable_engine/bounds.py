"""For the broad phase: bodies that are near each other, and the room in which each may move."""

from __future__ import annotations

from .body import Body
from .contact import Contact

MOST_BODIES = 2**29  # and no id is larger
ROOM = 0.1  # radii, on each side of a body that can move


class Pair:
    """Two bodies that are near each other, and their contact while they touch."""

    __slots__ = ("a", "b", "contact", "is_watched")

    def __init__(self, a: Body, b: Body) -> None:
        self.a = a  # always a ball with mass: the one with the higher id
        self.b = b
        self.contact: Contact | None = None
        self.is_watched = True  # whether it is looked at in each step


class Bounds:
    """The room in which a body's centre may move, and the box that holds the body meanwhile.

    The box goes from low to high along the axis of the sweep, from side_low to side_high across.
    The sweep finds the rank of the box in its order. The box crosses some lanes, first to last.
    """

    __slots__ = (
        *("body", "near", "pairs", "margin", "extra", "left", "right", "top", "bottom"),
        *("vx", "vy", "high", "low", "side_high", "side_low", "first_lane", "last_lane", "rank"),
    )

    def __init__(self, body: Body) -> None:
        self.body = body
        self.near = False  # whether any other body is near
        self.pairs: list[Pair] = []  # of its body and those that are near
        self.margin = ROOM * min(body.hx, body.hy)  # px, room on each side
        self.extra = 0.0  # s, of motion in a room beyond that of others
        self.left = self.right = body.x  # px
        self.top = self.bottom = body.y  # px
        self.vx, self.vy = body.vx, body.vy  # px/s, when the room was made
        self.low = self.high = self.side_low = self.side_high = 0.0  # px
        self.first_lane = self.last_lane = self.rank = 0

    def holds(self) -> bool:
        """Return whether the body is still in its room."""
        x, y = self.body.x, self.body.y
        return self.left <= x <= self.right and self.top <= y <= self.bottom

    def leaves(self, dt: float) -> bool:
        """Return whether the body, if nothing pushes it, will be out of its room in dt seconds."""
        body = self.body
        x, y = body.x + body.vx * dt, body.y + body.vy * dt
        return not (self.left <= x <= self.right and self.top <= y <= self.bottom)

    def make_room(self, back: float, ahead: float) -> None:
        """Make room for a body's path, from `back` seconds ago to `ahead` s from now."""
        body, margin = self.body, self.margin
        x, y, vx, vy = body.x, body.y, body.vx, body.vy
        self.vx, self.vy = vx, vy
        left, right = (-vx * back, vx * ahead) if vx > 0 else (vx * ahead, -vx * back)
        top, bottom = (-vy * back, vy * ahead) if vy > 0 else (vy * ahead, -vy * back)
        self.left, self.right = x + left - margin, x + right + margin
        self.top, self.bottom = y + top - margin, y + bottom + margin

    def make_room_to_fall(self, fall_x: float, fall_y: float) -> None:
        """Make more room for a body that falls by so many px."""
        self.left, self.right = self.left + min(fall_x, 0.0), self.right + max(fall_x, 0.0)
        self.top, self.bottom = self.top + min(fall_y, 0.0), self.bottom + max(fall_y, 0.0)

    def find_start(self, dt: float) -> None:
        """Set last_x, last_y (dt seconds ago) of a body that flew straight out of its room."""
        body = self.body
        body.last_x = max(self.left, min(body.x - body.vx * dt, self.right))
        body.last_y = max(self.top, min(body.y - body.vy * dt, self.bottom))

    def update_box(self, upright: bool, margin: float) -> None:
        """Work out the box, with margin px added at its low ends."""
        hx, hy = self.body.hx, self.body.hy
        if upright:
            self.low, self.high = self.top - hy - margin, self.bottom + hy
            self.side_low, self.side_high = self.left - hx - margin, self.right + hx
        else:
            self.low, self.high = self.left - hx - margin, self.right + hx
            self.side_low, self.side_high = self.top - hy - margin, self.bottom + hy


def pair_number(a: Body, b: Body) -> int:
    """Return a number that only this pair of bodies has, whichever comes first."""
    return max(a.id, b.id) * MOST_BODIES + min(a.id, b.id)
