"""Find the bodies that are near each other, by sort and sweep: the broad phase."""

from operator import attrgetter

from .body import Body

FAR = 0.25  # radii; a ball that has moved further in a step is fast
FEW = 8  # boxes, so few that dropping any is not worth it


class Bounds:
    """The bounding box of a body, along the axis of the sweep and across it."""

    __slots__ = ("body", "high", "low", "place", "side_high", "side_low", "x", "y")

    def __init__(self, body: Body, place: int) -> None:
        self.body = body
        self.place = place  # in the world's list
        self.x, self.y = body.x, body.y  # px, when contacts were last found
        self.low = self.high = self.side_low = self.side_high = 0.0  # px

    def update(self, upright: bool, margin: float) -> None:
        """Take over where the body is. Low ends are moved out by margin px."""
        body = self.body
        x, y, hx, hy = body.x, body.y, body.hx, body.hy
        self.x, self.y = x, y
        if upright:
            self.low, self.high = y - hy - margin, y + hy
            self.side_low, self.side_high = x - hx - margin, x + hx
        else:
            self.low, self.high = x - hx - margin, x + hx
            self.side_low, self.side_high = y - hy - margin, y + hy

    def cover_way(self, upright: bool, x: float, y: float) -> None:
        """Widen the box to cover the way from (x, y) as well."""
        along, across = x - self.x, y - self.y
        if upright:
            along, across = across, along
        self.low, self.high = self.low + min(along, 0.0), self.high + max(along, 0.0)
        self.side_low += min(across, 0.0)
        self.side_high += max(across, 0.0)

    def wins_tie(self, other: "Bounds") -> bool:
        """Return whether the sweep comes to this box first, of two that begin at one place."""
        if self.side_low != other.side_low:
            return self.side_low < other.side_low
        return self.place < other.place


ORDER = attrgetter("low", "side_low", "place")  # of the sweep


class BroadPhase:
    """A sweep along the axis on which the awake bodies are spread wider.

    It meets each box where it begins; the boxes that began before and have not ended are the only
    ones it can be near. Those that have ended are dropped once they may be half of all: that costs
    less than dropping each at once. Bodies move little from step to step, so the order of one sweep
    is nearly that of the next: a box that lies wrong is moved down to where it belongs (insertion
    sort).
    """

    def __init__(self) -> None:
        self.bounds: list[Bounds] = []  # in the order of the last sweep
        self.sorted = False
        self.upright = False  # whether the sweep goes along y
        self.fast: list[
            tuple[Bounds, float, float]
        ] = []  # whose boxes cover their ways from (x, y)

    def take(self, bodies: list[Body]) -> None:
        """Begin anew, with these bodies."""
        self.fast = []
        self.bounds = [Bounds(body, place) for place, body in enumerate(bodies)]
        self.sorted = False

    def near_pairs(self, awake: list[Body], margin: float) -> list[tuple[Body, Body]]:
        """Pairs whose bounding boxes come within margin px, one of the two awake; higher id first.

        The awake ones are among the bodies that were taken.
        """
        left, right = min([b.x - b.hx for b in awake]) - margin, max([b.x + b.hx for b in awake])
        top, bottom = min([b.y - b.hy for b in awake]) - margin, max([b.y + b.hy for b in awake])
        upright = bottom - top > right - left
        for one in self.bounds:
            one.update(upright, margin)
        for one, x, y in self.fast:
            one.cover_way(upright, x, y)
        self.sort(upright)
        if upright:
            left, right, top, bottom = top, bottom, left, right
        pairs: list[tuple[Body, Body]] = []
        active: list[Bounds] = []
        most = FEW
        for one in self.bounds:
            low, side_low, side_high = one.low, one.side_low, one.side_high
            if low >= right:
                break
            if one.high <= left or side_low >= bottom or side_high <= top:
                continue  # far from all that are awake
            if len(active) > most:
                active = [other for other in active if other.high > low]
                most = 2 * len(active) + FEW
            a = one.body
            for other in active:
                if other.side_low < side_high and other.side_high > side_low and other.high > low:
                    b = other.body
                    if not (a.idle and b.idle):
                        pairs.append((a, b) if a.id > b.id else (b, a))
            active.append(one)
        return pairs

    def sort(self, upright: bool) -> None:
        """Put the boxes into the order in which the sweep meets them."""
        bounds = self.bounds
        if not self.sorted or upright != self.upright:
            bounds.sort(key=ORDER)
            self.sorted, self.upright = True, upright
            return
        for i in range(1, len(bounds)):
            one, at = bounds[i], i
            low, before = one.low, bounds[i - 1]
            while low < before.low or (low == before.low and one.wins_tie(before)):
                bounds[at] = before
                at -= 1
                if at == 0:
                    break
                before = bounds[at - 1]
            bounds[at] = one
