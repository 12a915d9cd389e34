"""Sleep: bodies that lie still cost nothing."""

from __future__ import annotations

from .body import Body
from .contacts import Contacts
from .effect import Effect
from .world import World

STILL_SPEED = 3.0  # px/s, of the centre and of the rim
STILL_TIME = 0.5  # s


class Island:
    """Bodies that fell asleep together and wake together."""

    def __init__(self, bodies: list[Body], sleep: Sleep) -> None:
        self.bodies = bodies
        self.sleep = sleep
        for body in bodies:
            body.island = self
            body.asleep = body.idle = True
            body.vx = body.vy = body.w = 0.0

    def wake(self) -> None:
        """Wake them all."""
        for body in self.bodies:
            body.island = None
            body.asleep = body.idle = False
            body.still = 0.0
        self.sleep.rouse_all()


class Sleep(Effect):
    """Balls that touch or share a joint are an island, which sleeps once all of it lies still.

    It wakes when a ball that is awake touches it, or when place, velocity or spin of one of its
    balls is set. Moving a static body from under it does not wake it.
    """

    rank = 4

    def join(self, world: World) -> None:
        super().join(world)
        self.link_hooks = world.hooks("links")
        self.rouse_hooks = world.hooks("rouse")

    def detect(self, h: float) -> None:
        """Wake whoever is touched by somebody awake, and whoever that touches in turn."""
        contacts = self.world.effects.get("Contacts")
        while isinstance(contacts, Contacts) and (touched := sleepers(contacts)):
            for body in touched:
                body.wake()
            contacts.detect(h)

    def finish(self, h: float) -> None:
        dt = h * self.world.substeps
        tired = False
        for body in self.world.awake:
            rim = abs(body.w) * body.radius
            if body.vx**2 + body.vy**2 < STILL_SPEED**2 and rim < STILL_SPEED:
                body.still += dt
                tired = tired or body.still > STILL_TIME
            else:
                body.still = 0.0
        if tired:
            self.tuck_in()

    def tuck_in(self) -> None:
        """Let every island sleep that has lain still long enough."""
        still = [i for i in self.find_islands() if min(b.still for b in i) > STILL_TIME]
        for island in still:
            Island(island, self)
        if still:
            self.rouse_all()

    def find_islands(self) -> list[list[Body]]:
        """The awake balls in groups, by union-find: linked ones get the same leader."""
        leader = {body: body for body in self.world.awake}

        def lead(body: Body) -> Body:
            while leader[body] is not body:
                leader[body] = leader[leader[body]]
                body = leader[body]
            return body

        for links in self.link_hooks:
            for a, b in links():
                if not (a.idle or b.idle):
                    leader[lead(a)] = lead(b)
        islands: dict[Body, list[Body]] = {}
        for body in self.world.awake:
            islands.setdefault(lead(body), []).append(body)
        return list(islands.values())

    def rouse_all(self) -> None:
        """Tell the world and its effects who is awake now."""
        self.world.awake = [body for body in self.world.bodies if not body.idle]
        for rouse in self.rouse_hooks:
            rouse()


def sleepers(contacts: Contacts) -> list[Body]:
    """The sleeping balls that somebody awake touches."""
    return [body for c in contacts.touching for body in (c.a, c.b) if body.asleep]
