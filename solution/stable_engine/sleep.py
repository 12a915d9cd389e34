"""Sleep: bodies at rest are left out of the step, so they cost nothing."""

from .body import Body, Island
from .contacts import Contacts
from .effect import Effect, WorldState

STILL_SPEED = 3.0  # px/s, of the centre and of the rim
STILL_TIME = 0.5  # s


class Sleep(Effect):
    """Balls that touch or share a joint are an island, which sleeps once all of it has lain still.

    Only whole islands may sleep: a ball alone would hang in the air when its neighbours moved on.
    An island wakes when an awake ball touches it, and when anything is set that its rest hangs on:
    one of its balls or joints, a static body that it touches or hangs on, or the gravity.
    """

    rank = 4

    def attach(self, world: WorldState) -> None:
        super().attach(world)
        self.link_hooks = world.hooks("links")
        self.awake_changed_hooks = world.hooks("awake_changed")

    def detect(self, h: float) -> None:
        """Wake islands that an awake ball touches, and those that these touch in turn."""
        contacts = self.world.effects.get("Contacts")
        while isinstance(contacts, Contacts) and (touched := sleepers(contacts)):
            for body in touched:
                body.wake()
            contacts.detect(h)

    def finish(self, h: float) -> None:
        dt = h * self.world.substep_count
        ready = False
        for body in self.world.awake:
            rim = abs(body.w) * body.radius
            speed2 = body.vx * body.vx + body.vy * body.vy
            if speed2 < STILL_SPEED * STILL_SPEED and rim < STILL_SPEED:
                body.still += dt
                ready = ready or body.still > STILL_TIME
            else:
                body.still = 0.0
        if ready:
            self.put_to_sleep()

    def put_to_sleep(self) -> None:
        """Put every island to sleep that has lain still for STILL_TIME."""
        still = [i for i in self.find_islands() if min(b.still for b in i) > STILL_TIME]
        for island in still:
            Island(island, self.update_awake)
        if still:
            self.update_awake()

    def find_islands(self) -> list[list[Body]]:
        """Return the awake balls in groups, by union-find: connected ones get the same root."""
        parent = {body: body for body in self.world.awake}

        def root(body: Body) -> Body:
            while parent[body] is not body:
                parent[body] = parent[parent[body]]  # halves the path for the next search
                body = parent[body]
            return body

        for links in self.link_hooks:
            for a, b in links():
                if not (a.idle or b.idle):
                    parent[root(a)] = root(b)
        islands: dict[Body, list[Body]] = {}
        for body in self.world.awake:
            islands.setdefault(root(body), []).append(body)
        return list(islands.values())

    def update_awake(self) -> None:
        """Update the world's list of awake bodies, and tell the effects."""
        self.world.awake = [body for body in self.world.bodies if not body.idle]
        for awake_changed in self.awake_changed_hooks:
            awake_changed()


def sleepers(contacts: Contacts) -> list[Body]:
    """Return the sleeping balls in a contact: one is only found where the other body is awake."""
    return [body for c in contacts.touching for body in (c.a, c.b) if body.asleep]
