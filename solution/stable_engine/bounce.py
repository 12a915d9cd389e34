"""Restitution: bodies that hit each other bounce off."""

from .contact import Contact
from .contacts import FAR_APART, Contacts
from .effect import Effect
from .impacts import Impacts, select_fast


class Bounce(Effect):
    """Newton's law: bodies that collide fast enough separate at e times that speed.

    e is the smaller restitution of the two. Impacts are resolved at the end of a step, see Impacts,
    so what is drawn has bounced. Slower contacts stay with the solver, or a resting ball would hop.
    """

    __slots__ = ("contacts",)
    rank = 6

    def attach(self) -> None:
        self.contacts: Contacts = self.world.need("Contacts", self)
        self.contacts.lets_none_pass = True

    def is_used(self) -> bool:
        return any(body.e > 0 for body in self.world.members)

    def begin_contact(self, c: Contact) -> None:
        c.e = min(c.a.e, c.b.e)

    def impact(self, h: float) -> None:
        if not self.contacts.groups:
            return
        contacts = self.contacts
        slow = contacts.slow_speed(max(h, contacts.pace.h) * self.world.substep_count)
        fast = select_fast(contacts.touching, slow)
        may_hit = contacts.begun and (fast or contacts.may_pass())
        if not may_hit and max([abs(c.closing_speed()) for c in fast], default=0.0) <= slow:
            return
        impacts = Impacts(contacts, slow, h)
        impacts.find(fast)
        if impacts.queue.due or impacts.returned:
            impacts.resolve_all()
            for c in impacts.met:  # only the next step may push balls apart or stop them
                if not c.b.is_static:
                    c.gap = FAR_APART * c.a.r
        contacts.changed, contacts.renewed = True, contacts.touching
        parting, least = [], max(slow, contacts.leaving_speed())
        for c in select_fast(contacts.touching, slow):
            closing = c.closing_speed()
            if c.gap < 0 and closing < -slow:
                # Pushed out as well, it would rise too high. It stays a contact: without one, a rod
                # or a heavy ball that still moves towards the wall would press it into that.
                c.gap = 0.0
            elif closing > slow and impacts.is_open(c) and not contacts.landings.lands(c.a, c.b):
                c.gap = FAR_APART * c.a.r
            if closing <= -least:
                parting.append(c)
        contacts.end_contacts(parting)
