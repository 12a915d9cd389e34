"""Sleep: bodies at rest are left out of the step, so they cost nothing."""

from math import hypot

from .body import UNKNOWN, Body
from .contacts import Contacts
from .effect import Effect
from .network import connected

# lengths are in units of the world, see World.unit
STILL_TIME, STILL_SPEED = 0.5, 0.5  # s; 1/s, of the centre and of the rim
LEAST_PULL = 0.06  # 1/s²; what speeds up by more is in motion, as forces do not balance
SHAKEN_TIME, SHAKEN_SPEED = 5.0, 3.0  # s; 1/s, of a ball that is shaken where it lies in a pile
SHAKEN_DISTANCE = 1.0  # within which it stays
FIRST_LOOK = 7  # steps between checks: a check of all awake balls costs as much as moving them
TWO_LOOKS = 16  # steps; 7 and 9 in turns, so that no swing is at the same point at every look
SELDOM = 32  # steps, while no ball is slow


class Sleep(Effect):
    """Put islands to sleep that have lain still: balls that touch each other or share a joint.

    A ball lies still if for 0.5 s it is slower than 0.5 px/s and its velocity changes by less than
    0.06 px/s². So whatever rolls or slides at a steady 0.5 px/s goes on for ever, and so does what
    starts, swings or turns back with more acceleration. A ball that touches another one may be
    shaken, and lies still if it stays within 1 px for 5 s. No ball lies still if it would speed up
    by 0.06 px/s² without drag: springs of angular frequency omega draw it on until it is within
    0.06 px/s² / omega² of rest. All these lengths are in units of the world.

    Only whole islands sleep: a single ball would hang in the air when its neighbours moved on. An
    island must rest on a static body or hang on one. Without gravity, it may also float, if it does
    not move at all. An island wakes when an awake ball touches it, or when a program changes one of
    its balls or joints, a static body that it touches or hangs on, or the gravity.
    """

    __slots__ = ("contacts", "left", "rates", "resting", "shaken", "since", "supported", "wait")
    rank = 4

    def __init__(self) -> None:
        self.since = 0.0  # s, of a substep of each step since the last check
        self.resting = -1  # which change of the world's hooks it made to rest
        self.wait = self.left = FIRST_LOOK  # steps from there to the next one, and from now

    def attach(self) -> None:
        self.contacts = self.world.find(Contacts)

    def detect(self, h: float) -> None:
        """Wake islands that an awake ball touches or may reach through others in this step."""
        contacts = self.contacts if self.world.anybody_sleeps() else None
        while contacts and (touched := self.find_sleepers(contacts)):
            for body in touched:
                body.wake()
            contacts.detect(h)

    def is_at_rest(self) -> bool:
        return self.resting == self.world.changes

    def find_sleepers(self, contacts: Contacts) -> list[Body]:
        """Return the sleeping balls in contacts, and those against which these may be thrown."""
        touched = [(c, body) for c in contacts.touching for body in (c.a, c.b) if body.asleep]
        found = dict.fromkeys([body for _, body in touched])
        # px, the longest way in a step: a ball that is hit flies off at most twice as fast. This is
        # their whole speed, as those that have passed each other no longer close in
        speeds = [hypot(c.a.vx - c.b.vx, c.a.vy - c.b.vy) for c, _ in touched]
        far = 2 * max(speeds, default=0.0) * contacts.last_dt
        ahead = list(found) if far > contacts.touching_gap else []
        asleep = [body for body in self.world.members if body.asleep] if ahead else []
        while ahead:
            ball = ahead.pop()
            for other in asleep:
                reach = ball.r + other.r + far
                if other not in found and hypot(other.x - ball.x, other.y - ball.y) < reach:
                    found[other] = None
                    ahead.append(other)
        return list(found)

    def finish(self, h: float) -> None:
        self.since += h
        self.left -= 1
        if self.left:
            return
        dt, self.since = self.since * self.world.substep_count, 0.0
        any_slow, ready, slow = False, False, SHAKEN_SPEED * self.world.unit
        for body in self.world.awake:
            if -slow < body.vx < slow and self.is_slow(body, slow):
                any_slow = True
                self.look_at(body, dt)
                ready = ready or body.still > STILL_TIME or body.kept > SHAKEN_TIME
            else:
                body.still, body.calm = 0.0, UNKNOWN
        if not any_slow:
            self.wait = SELDOM
            self.rest_while_free()
        else:
            self.wait = TWO_LOOKS - FIRST_LOOK if self.wait == FIRST_LOOK else FIRST_LOOK
        self.left = self.wait
        if ready:
            self.put_to_sleep()

    def rest_while_free(self) -> None:
        """Rest while nothing changes velocities, and so no ball gets slow, if nobody sleeps."""
        world, contacts = self.world, self.contacts
        is_free = contacts is None or contacts.is_at_rest()
        if is_free and world.is_falling() and not world.anybody_sleeps():
            self.resting = world.changes + 1
            world.update_hooks()

    def is_slow(self, body: Body, slow: float) -> bool:
        """Return whether the centre and the rim of a ball are slower than `slow` (px/s)."""
        return hypot(body.vx, body.vy) < slow and abs(body.w) * body.r < slow

    def look_at(self, body: Body, dt: float) -> None:
        """Measure how long a ball has kept its velocity, and how long its position."""
        unit = self.world.unit
        slow, near = STILL_SPEED * unit, SHAKEN_DISTANCE * unit
        most = LEAST_PULL * unit * dt
        vx, vy, rim = body.vx, body.vy, body.w * body.r
        before_x, before_y, before_rim = body.calm
        body.calm = vx, vy, rim
        if hypot(vx - before_x, vy - before_y) > most or abs(rim - before_rim) > most:
            body.still = 0.0
        elif hypot(vx, vy) < slow and abs(rim) < slow:
            body.still += dt
        x, y, angle = body.kept_at
        if hypot(body.x - x, body.y - y) < near and abs(body.turn - angle) * body.r < near:
            body.kept += dt
        else:
            body.kept, body.kept_at = 0.0, (body.x, body.y, body.turn)

    def put_to_sleep(self) -> None:
        """Put islands to sleep that lie still."""
        self.rates: dict[Body, float] = {}
        self.world.call("drag", self.rates)
        pile = self.contacts.balls.contacts if self.contacts else []
        self.shaken = {body for c in pile for body in (c.a, c.b)}
        still = [i for i in self.find_islands() if self.is_still(i)]
        for island in still:
            for body in island:
                body.island, body.idle = island, True
                body.vx = body.vy = body.w = body.lag_x = body.lag_y = 0.0
        if still:
            self.update_awake()

    def wake(self, island: list[Body]) -> None:
        for body in island:
            body.island, body.idle = [], False
            body.still = body.kept = 0.0
            body.calm = UNKNOWN
        self.update_awake()

    def is_still(self, island: list[Body]) -> bool:
        """Return whether all balls of an island lie still, and nothing sets them in motion."""
        if not all([self.lies_still(body) for body in island]):
            return False
        moves = any([body.vx or body.vy or body.w for body in island])
        return any([body in self.supported for body in island]) or not (moves or any(self.world.g))

    def lies_still(self, body: Body) -> bool:
        """Return whether a ball has kept its velocity or, in a pile, its position long enough.

        One that a force moves against drag keeps its velocity, but does not lie still.
        """
        is_shaken = body.kept > SHAKEN_TIME and body in self.shaken
        drag = self.rates.get(body, 0.0) * hypot(body.vx, body.vy)  # px/s²
        return (body.still > STILL_TIME or is_shaken) and drag <= LEAST_PULL * self.world.unit

    def find_islands(self) -> list[list[Body]]:
        """Return the awake balls in groups of those that are connected.

        Also list in `supported` the balls that touch something static or are tied to it. A ball on
        a moving kinematic body does not lie still.
        """
        self.supported: set[Body] = set()
        beside: dict[Body, list[Body]] = {body: [] for body in self.world.awake}
        for links in self.world.hooks["links"]:
            for a, b in links():
                if not (a.idle or b.idle):
                    beside[a].append(b)
                    beside[b].append(a)
                elif not (a.idle and b.idle):
                    ball, other = (b, a) if a.idle else (a, b)
                    self.supported.add(ball)
                    if other.is_kinematic and (other.vx or other.vy or other.w):
                        ball.still = ball.kept = 0.0
        return connected(self.world.awake, beside)

    def update_awake(self) -> None:
        """Update the world's list of awake bodies, and tell the effects."""
        self.world.awake = [body for body in self.world.members if not body.idle]
        self.world.has_changed = True
        self.world.call("awake_changed")
