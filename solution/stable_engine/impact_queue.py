"""The queue of impacts that are due in a step."""

from bisect import insort
from heapq import heappop, heappush

from .contact import Contact

MOST_IMPACTS = 100  # of a contact in one step
SAME = 1e-6  # share by which the speeds of mirrored impacts may differ

# of an impact that is due: when (s) the two touched, before now and so below 0, a number that tells
# it from others of the same contact, and their closing speed (px/s)
Impact = tuple[float, int, float, Contact]


class ImpactQueue:
    """Impacts that are due. The earliest comes first, and of one moment the hardest.

    Impacts belong to one moment if the fastest body moves by less than a gap (px) between them.
    """

    __slots__ = ("counts", "due", "early", "fastest", "gap", "number", "queue")

    def __init__(self, gap: float) -> None:
        self.gap = gap  # px
        self.due: dict[Contact, Impact] = {}
        self.queue: list[Impact] = []  # the earliest first, also those no longer due
        self.early: list[Impact] = []  # of the moment that was taken last
        self.counts: dict[Contact, int] = {}  # of impacts so far
        self.fastest = 0.0  # px/s, of all impacts
        self.number = 0  # of impacts found so far

    def add(self, c: Contact, ago: float, speed: float) -> None:
        """Add an impact of a contact, unless it had too many in this step."""
        if self.counts.get(c, 0) < MOST_IMPACTS:
            self.number += 1
            self.due[c] = impact = -ago, self.number, speed, c
            heappush(self.queue, impact)
            if speed > self.fastest:
                self.fastest = speed

    def take_first(self) -> tuple[list[Contact], float]:
        """Return the hardest of the earliest impacts, and how long (s) ago they touched."""
        if len(self.due) == 1:
            early, self.queue = [*self.due.values()], []
        else:
            early = self.find_early()
        group, self.early = [early[0][3]], []
        if len(early) > 1:
            # the gap in px/s as well: rounding would decide between slow ones
            hard = max([speed for _, _, speed, _ in early])
            hard -= max(SAME * hard, self.gap)
            group = [c for _, _, speed, c in early if speed >= hard]
            self.early = [impact for impact in early if impact[2] < hard]
        for c in group:
            del self.due[c]
            self.counts[c] = self.counts.get(c, 0) + 1
        return group, -early[0][0]

    def find_early(self) -> list[Impact]:
        """Return the earliest impacts, in order: first those left of the moment before."""
        queue, fastest, gap = self.queue, self.fastest, self.gap
        early = [impact for impact in self.early if self.is_due(impact)] if self.early else []
        while queue and (not early or (queue[0][0] - early[0][0]) * fastest <= gap):
            impact = heappop(queue)
            if self.is_due(impact):
                insort(early, impact)
        while (early[-1][0] - early[0][0]) * fastest > gap:
            heappush(queue, early.pop())
        return early

    def is_due(self, impact: Impact) -> bool:
        """Return whether an impact is neither over nor found anew."""
        _, number, _, c = impact
        return c in self.due and self.due[c][1] == number
