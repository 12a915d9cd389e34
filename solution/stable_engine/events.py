"""Events of a step for the program: which pairs met, and which parted."""

from __future__ import annotations

from math import hypot, inf
from operator import itemgetter
from typing import TYPE_CHECKING

from .contact import Contact, collide
from .sweep import moment_of_touch

if TYPE_CHECKING:
    from .detection import Detection


class Events:
    """The pairs for which Contacts will call on_hit and on_part, and when in the step."""

    __slots__ = ("again", "contacts", "gone", "hits", "parted")

    def __init__(self, contacts: Detection) -> None:
        self.contacts = contacts
        self.hits: dict[Contact, tuple[float, float]] = {}  # how long ago (s), and how fast (px/s)
        self.parted: dict[Contact, float] = {}  # how long ago (s)
        self.gone: dict[Contact, None] = {}  # contacts that last after their bodies parted
        self.again: dict[Contact, None] = {}  # those of them whose bodies seem to meet again

    def note_hit(self, c: Contact, at: float = 0.0) -> None:
        """Note that two bodies began to touch, `at` seconds ago or as they have flown."""
        if self.contacts.tells_hit:
            self.hits.pop(c, None)  # hits of one moment are in the order of impacts
            ago, speed = self.meeting_of(c)
            self.hits[c] = at or ago, speed

    def note_part(self, c: Contact) -> None:
        """Note that two bodies parted, before other pairs met."""
        if c in self.gone:
            del self.gone[c]
        elif self.contacts.tells_part and c not in self.contacts.landings.speeds:
            self.parted[c] = inf
            if c in self.hits:
                self.hits[c] = inf, self.hits[c][1]

    def note_again(self, c: Contact) -> None:
        """Note that two bodies which had parted seem to touch again."""
        del self.gone[c]
        self.again[c] = None
        self.note_hit(c)

    def note_gone(self, c: Contact) -> None:
        """Note that a contact ends, as its bodies are apart at the end of the step."""
        if c in self.gone:
            del self.gone[c]
        else:
            self.note_parted(c)

    def note_parted(self, c: Contact) -> None:
        """Note that two bodies are apart at the end of the step, after their last hit."""
        if c in self.again:
            self.hits.pop(c, None)
        elif self.contacts.tells_part:
            self.parted[c] = self.hits[c][0] if c in self.hits else inf

    def find_gone(self) -> None:
        """Find the pairs that are apart at the end of the step though their contacts last.

        The next step may bring them together again, which is a new hit. Slow ones that gravity may
        turn back within a step have not parted. No pair parts twice in a step.
        """
        contacts = self.contacts
        fast = contacts.speculative_speed + hypot(*contacts.world.g) * contacts.last_dt  # px/s
        before, self.gone, parted = self.gone, {}, {(c.a, c.b) for c in self.parted}
        for c in contacts.touching:
            if c not in before:
                is_fast = abs(c.closing_speed()) > fast and c not in contacts.landings.speeds
                if (
                    not is_fast
                    or (c.a, c.b) in parted
                    or collide(c.a, c.b)[2] <= contacts.touching_gap
                ):
                    continue
                self.note_parted(c)
            self.gone[c] = None
        self.again = {}

    def meeting_of(self, c: Contact) -> tuple[float, float]:
        """Return how long ago (s) A and B began to touch, and how fast (px/s) they did."""
        contacts, a, b = self.contacts, c.a, c.b
        ago, nx, ny = moment_of_touch(a, b, contacts.flight_of(a, b))
        if ago == 0:  # before this step, if a program has put them there
            return (0.0 if contacts.last_dt else inf), max(c.closing_speed(), 0.0)
        (gx, gy), falls = contacts.world.g, b.is_static and not a.joint_count
        since = contacts.h / 2 - ago if falls else 0.0  # s: velocities lag half a substep behind
        speed = (a.vx - b.vx + gx * since) * nx + (a.vy - b.vy + gy * since) * ny
        return ago, max(speed, 0.0)  # what rolls onto a body does not fall

    def tell(self) -> None:
        """Call on_hit and on_part, in order, for bodies that are still in the world."""
        contacts = self.contacts
        parted = [(ago, c, None) for c, ago in self.parted.items()]
        events: list[tuple[float, Contact, float | None]] = [
            *[part for part in parted if part[1] not in self.hits],  # before hits of that moment
            *[(ago, c, speed) for c, (ago, speed) in self.hits.items()],
            *[part for part in parted if part[1] in self.hits],
        ]
        self.hits, self.parted = {}, {}
        for _, c, speed in sorted(events, key=itemgetter(0), reverse=True):
            if c.a.world is c.b.world is contacts.world:
                if speed is not None and contacts.tells_hit:
                    contacts.tells_hit(c.a, c.b, speed)
                elif speed is None and contacts.tells_part:
                    contacts.tells_part(c.a, c.b)
