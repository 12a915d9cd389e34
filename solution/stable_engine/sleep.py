"""Sleep: bodies at rest are left out of the step, so they cost nothing."""

from math import hypot, sqrt

from .body import Body, Island
from .contacts import Contacts
from .effect import Effect, WorldState

# speeds are in units of the world per second, see World.unit
STILL_SPEED = 3.0  # of the centre and of the rim
GAINED_SPEED = 0.03  # in STILL_TIME; a ball that gains more is on a gentle slope, not at rest
STILL_TIME = 0.5  # s
LOOK_EVERY = 8  # steps between checks, as a check of all awake balls costs as much as moving them


class Sleep(Effect):
    """Put islands to sleep that have lain still: balls that touch each other or share a joint.

    Only whole islands sleep: a single ball would hang in the air when its neighbours moved on. An
    island must rest on a static body or hang on one. Without gravity, it may also float, if it does
    not move at all. An island wakes when an awake ball touches it, or when a program changes one of
    its balls or joints, a static body that it touches or hangs on, or the gravity.
    """

    __slots__ = ("awake_changed_hooks", "link_hooks", "since", "steps", "supported")
    rank = 4

    def __init__(self) -> None:
        self.since, self.steps = 0.0, 0  # s and steps since the last check

    def attach(self, world: WorldState) -> None:
        super().attach(world)
        self.link_hooks = world.hooks("links")
        self.awake_changed_hooks = world.hooks("awake_changed")

    def detect(self, h: float) -> None:
        """Wake islands that an awake ball touches, and those that these touch in turn."""
        world = self.world
        if len(world.awake) + len(world.statics) == len(world.bodies):
            return
        contacts = world.effects.get("Contacts")
        while isinstance(contacts, Contacts) and (touched := sleepers(contacts)):
            for body in touched:
                body.wake()
            contacts.detect(h)

    def finish(self, h: float) -> None:
        self.since += h * self.world.substep_count
        self.steps += 1
        if self.steps < LOOK_EVERY:
            return
        dt, self.since, self.steps = self.since, 0.0, 0
        ready, slow = False, STILL_SPEED * self.world.unit
        slow2 = slow * slow
        for body in self.world.awake:
            speed2 = body.vx * body.vx + body.vy * body.vy
            if speed2 < slow2 and abs(body.w) * body.r < slow:
                if not body.still:
                    body.calm = speed2
                body.still += dt
                ready = ready or body.still > STILL_TIME
            else:
                body.still = 0.0
        if ready:
            self.put_to_sleep()

    def put_to_sleep(self) -> None:
        """Put islands to sleep that have lain still for STILL_TIME."""
        still = [i for i in self.find_islands() if self.is_still(i)]
        for island in still:
            Island(island, self.update_awake)
        if still:
            self.update_awake()

    def is_still(self, island: list[Body]) -> bool:
        """Return whether an island has lain still for STILL_TIME, and nothing sets it in motion.

        A ball that has gained speed starts the time again.
        """
        if min([body.still for body in island]) <= STILL_TIME:
            return False
        gained = GAINED_SPEED * self.world.unit
        for body in island:
            if hypot(body.vx, body.vy) > sqrt(body.calm) + gained:
                body.still = 0.0
        if min([body.still for body in island]) == 0:
            return False
        moves = any([body.vx or body.vy or body.w for body in island])
        return any([body in self.supported for body in island]) or not (moves or any(self.world.g))

    def find_islands(self) -> list[list[Body]]:
        """Return the awake balls in groups, by union-find: connected balls get the same root.

        Also list in `supported` the balls that touch something static or are tied to it. A ball on
        a moving kinematic body does not lie still.
        """
        self.supported: set[Body] = set()
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
                elif not (a.idle and b.idle):
                    ball, other = (b, a) if a.idle else (a, b)
                    self.supported.add(ball)
                    if other.is_kinematic and (other.vx or other.vy or other.w):
                        ball.still = 0.0
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
    """Return the sleeping balls in contacts, which all have one awake body."""
    return [body for c in contacts.touching for body in (c.a, c.b) if body.sleeps]
