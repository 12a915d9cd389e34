"""The queue of impacts that are due in a step."""

from bisect import insort
from heapq import heappop, heappush

from .contact import Contact

MOST_IMPACTS = 100  # of a contact in one step
SAME = 1e-6  # share by which the speeds of mirrored impacts may differ

Entry = tuple[float, int, Contact]  # in a queue: s from now, so below 0, and an impact's number


class Impact:
    """An impact that is due: how long ago (s) the two touched, and their closing speed (px/s).

    number tells it from others of the same contact.
    """

    __slots__ = ("ago", "number", "speed")

    def __init__(self, ago: float, speed: float, number: int) -> None:
        self.ago = ago
        self.speed = speed
        self.number = number


class ImpactQueue:
    """Impacts that are due. The earliest comes first, and of one moment the hardest.

    Impacts belong to one moment if the fastest body moves by less than a gap (px) between them.
    """

    def __init__(self, gap: float) -> None:
        self.gap = gap  # px
        self.due: dict[Contact, Impact] = {}
        self.queue: list[Entry] = []  # of those due, the earliest first
        self.early: list[Entry] = []  # of those due, at the moment that was taken last
        self.counts: dict[Contact, int] = {}  # of impacts so far
        self.fastest = 0.0  # px/s, of all impacts
        self.number = 0  # of impacts found so far

    def add(self, c: Contact, ago: float, speed: float) -> None:
        """Add an impact of a contact, unless it had too many in this step."""
        if self.counts.get(c, 0) < MOST_IMPACTS:
            self.number += 1
            self.due[c] = Impact(ago, speed, self.number)
            heappush(self.queue, (-ago, self.number, c))
            self.fastest = max(self.fastest, speed)

    def take_first(self) -> tuple[list[Contact], float]:
        """Return the hardest of the earliest impacts, and how long (s) ago they touched."""
        due = self.due
        early = self.find_early()
        earliest = early[0][0]
        group = [early[0][2]]
        self.early = []
        if len(early) > 1:
            # the gap in px/s as well: rounding would decide between slow ones
            hard = max([due[c].speed for _, _, c in early])
            hard -= max(SAME * hard, self.gap)
            group = [c for _, _, c in early if due[c].speed >= hard]
            self.early = [entry for entry in early if due[entry[2]].speed < hard]
        for c in group:
            del due[c]
            self.counts[c] = self.counts.get(c, 0) + 1
        return group, -earliest

    def find_early(self) -> list[Entry]:
        """Return the earliest impacts, in order: first those left of the moment before."""
        queue, fastest, gap = self.queue, self.fastest, self.gap
        early = [entry for entry in self.early if self.is_due(entry)]
        while queue and (not early or (queue[0][0] - early[0][0]) * fastest <= gap):
            entry = heappop(queue)
            if self.is_due(entry):
                insort(early, entry)
        while (early[-1][0] - early[0][0]) * fastest > gap:
            heappush(queue, early.pop())
        return early

    def is_due(self, entry: Entry) -> bool:
        """Return whether an entry of the queue is neither over nor found anew."""
        impact = self.due.get(entry[2])
        return impact is not None and impact.number == entry[1]
