"""Sleep: what lies still costs nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .contacts import Contacts
from .effect import Effect

if TYPE_CHECKING:
    from .body import Body
    from .world import World

STILL_SPEED = 3.0  # px/s, of the centre and of the rim
STILL_TIME = 0.5  # s


class Island:
    """Bodies that fell asleep together, and wake together."""

    def __init__(self, bodies: list[Body], sleep: Sleep) -> None:
        self.bodies = bodies
        self.sleep = sleep
        for body in bodies:
            body.asleep = body.idle = True
            body.island = self
            body.vx = body.vy = body.w = 0.0

    def wake(self) -> None:
        for body in self.bodies:
            body.asleep = body.idle = False
            body.island = None
            body.still = 0.0
        self.sleep.rouse_all()


class Sleep(Effect):
    """Bodies tied by contacts, rods and springs form an island, which sleeps and wakes as one."""

    rank = 4

    def join(self, world: World) -> None:
        super().join(world)
        self.contacts = world.effects.get("Contacts")
        self.link_hooks = world.hooks("links")
        self.rouse_hooks = world.hooks("rouse")

    def detect(self, h: float) -> None:
        """Wake who is touched by somebody awake, and whom that touches in turn."""
        if not isinstance(self.contacts, Contacts):
            return
        touched = self.touched()
        while touched:
            for body in touched:
                body.wake()
            self.contacts.detect(h)
            touched = self.touched()

    def touched(self) -> list[Body]:
        return [
            body
            for c in self.contacts.contacts
            if c.a.asleep or c.b.asleep
            for body in (c.a, c.b)
        ]

    def rouse_all(self) -> None:
        self.world.awake = [body for body in self.world.bodies if not body.idle]
        for rouse in self.rouse_hooks:
            rouse()

    def finish(self, h: float) -> None:
        dt = h * self.world.substeps
        for b in self.world.awake:
            calm = b.vx**2 + b.vy**2 < STILL_SPEED**2 and abs(b.w) * b.radius < STILL_SPEED
            b.still = b.still + dt if calm else 0.0
        if any(body.still > STILL_TIME for body in self.world.awake):
            self.tuck_in()

    def tuck_in(self) -> None:
        slept = False
        for island in self.islands():
            if all(body.still > STILL_TIME for body in island):
                Island(island, self)
                slept = True
        if slept:
            self.rouse_all()

    def islands(self) -> list[list[Body]]:
        """Awake bodies in groups, by union-find: those that are linked share a group."""
        leader = {body: body for body in self.world.awake}
        def find(body):
            while leader[body] is not body:
                leader[body] = body = leader[leader[body]]
            return body
        for links in self.link_hooks:
            for a, b in links():
                if not (a.is_static or b.is_static):
                    leader[find(a)] = find(b)
        groups = {}
        for body in self.world.awake:
            groups.setdefault(find(body), []).append(body)
        return list(groups.values())
