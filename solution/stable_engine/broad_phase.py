"""Find the pairs of bodies that are near each other, by sort and sweep: the broad phase."""

from math import inf, sqrt
from operator import attrgetter

from .body import Body
from .bounds import Bounds, Pair, pair_number
from .sweep import NO_HIT, hit_point

SWEEP = 8  # checks of near pairs per body that can move, which cost as much as a sweep
LONGEST = 2.0  # s of motion in a room
WIDER = 1.1  # ratio of the spreads along both axes at which the sweep changes its axis
LANE = 6.0  # width of a lane, in half widths of a ball
FEW = 4  # boxes in a lane; up to so many, ended ones may stay
ROUNDING = 1e-3  # steps
MANY = 30  # bodies that leave their rooms at once: a sweep costs less than a search for each
SOON = 8  # steps; if two balls meet sooner, all pairs are looked at until then
SHARE = 0.25  # of the bodies that can move: without gravity, at least so many

LOW = attrgetter("low")
RANK = attrgetter("rank")


class BroadPhase:
    """The pairs of bodies that are near each other, found by a sweep.

    Each body has room to move. Two bodies are near if their boxes, rooms included, overlap. No
    other pair can touch until a body leaves its room. Then it gets a new one, and its box is
    compared with all others. The sweep is repeated once the rooms have lasted as long as they
    should, or if many bodies leave theirs at once. New rooms are longer if the last ones lasted
    long, and shorter if many near pairs did not touch.

    The sweep goes along the axis on which moving bodies are spread wider. A new box can
    only be near boxes that began before and have not ended. Lanes along the sweep leave few of
    these to compare. A lane is at least as wide as the mean box, or long boxes would cross many.
    Boxes that have ended are dropped now and then, which costs less than dropping each at once.
    Until the next sweep, a new box is compared with all boxes of the lanes that it crosses.
    """

    def __init__(self) -> None:
        self.bounds: list[Bounds] = []  # of all bodies, in the order of the last sweep
        self.rooms: dict[Body, Bounds] = {}  # in the order of the world's list
        self.moving: list[Bounds] = []  # of those that can move
        self.widest = 0.0  # px, half of the widest that can move
        self.narrowest = 0.0  # px, the least width of a lane
        self.tied: list[Bounds] = []  # of balls on joints, whose landings may be foreseen
        self.foresees = False  # whether they are
        self.pairs: list[Pair] = []
        self.watched = self.pairs  # all, or while it is quiet those of bodies that may be pushed
        self.spare: list[Pair] = []  # pairs of the last sweep: reuse is cheaper
        self.near: list[Bounds] = []  # of bodies that can move and have others near
        self.far: list[Bounds] = []  # of the others that can move
        self.is_listed = False  # whether these two lists are up to date
        self.leavers: list[Bounds] = []  # of bodies that have left their rooms
        self.lanes: list[list[Bounds]] = []  # the boxes that cross each since the last sweep
        self.lanes_per_px = 0.0
        self.hull = 0.0, 0.0, 0.0, 0.0  # px, what the sweep has covered, along it and across
        self.is_quiet = False  # whether no near pair will touch unless something pushes
        self.is_stale = True  # whether all rooms are renewed in the next step
        self.upright = False  # whether the sweep goes along y
        self.ahead = LONGEST  # s of motion in a room
        self.age = 0.0  # s, of the rooms
        self.end = -1.0  # s, the age up to which a body that nothing pushes stays in its room
        self.falls = False  # whether gravity pushes all
        self.is_free = False  # whether nothing else has pushed any since the sweep, but for these:
        self.led: dict[Bounds, None] = {}  # of bodies on joints, or that the program has pushed
        self.looks = 0  # checks of pairs that did not touch, since the last sweep

    def take(self, bodies: list[Body]) -> None:
        """Begin anew, with these bodies."""
        self.bounds = [Bounds(body) for body in bodies]
        self.rooms = {one.body: one for one in self.bounds}
        self.moving = [b for b in self.bounds if not b.body.idle or b.body.is_kinematic]
        halves = [max(b.body.hx, b.body.hy) for b in self.moving]
        self.widest, self.narrowest = max(halves), LANE * sum(halves) / len(halves)
        self.is_stale = True

    def find_leavers(self, dt: float) -> list[Bounds]:
        """Note that dt seconds have passed, and which bodies have left their rooms. Return these.

        The next detect makes room for them.
        """
        self.age += dt
        late, doubtful = self.is_late(dt), self.moving
        if self.is_free and not late:
            doubtful = list(self.led)
        elif not (late or self.falls):
            self.list_near()
            # of bodies with nobody near, only those can leave whose velocity has changed
            far = [b for b in self.far if b.body.vx != b.vx or b.body.vy != b.vy]
            doubtful = self.near + far
        self.leavers = leavers = []
        for one in doubtful:  # the test of holds, without the cost of a call for each
            body = one.body
            if not (one.left <= body.x <= one.right and one.top <= body.y <= one.bottom):
                leavers.append(one)
        for one in self.tied if self.foresees else []:
            if one.leaves(dt) and one.holds():
                one.extra = dt
                leavers.append(one)
        count = len(leavers)
        are_many = count > MANY and (self.falls or count > SHARE * len(self.moving))
        is_over = late or not self.is_free
        if (leavers and (late or are_many)) or (is_over and self.is_quiet):
            self.is_stale = True
        return leavers

    def note_leaver(self, body: Body) -> None:
        """Note a body that was put elsewhere since find_leavers, if it is out of its room."""
        one = self.rooms[body]
        if not one.holds() and one not in self.leavers:
            self.leavers.append(one)
            self.is_stale = self.is_stale or self.is_quiet

    def renew(
        self, g: tuple[float, float], held: set[Body], dt: float, back: float, margin: float
    ) -> list[Pair]:
        """Make room for the leavers, or for all if rooms are stale. Return the new near pairs.

        Those are pairs of boxes within margin px. Rooms also cover the path of the last `back`
        seconds, and the fall of bodies that nothing holds.
        """
        if self.is_stale:
            self.set_ahead(dt)
            self.leavers = self.moving
            self.is_quiet, self.falls = False, g != (0.0, 0.0)
            self.end, self.pairs, self.spare = self.ahead, [], self.pairs
            self.watched = self.pairs
            self.led = {one: None for one in self.moving if one.body.joint_count}
        count, ahead = len(self.pairs), max(self.ahead - self.age, dt)
        fall_x, fall_y = g[0] * ahead * ahead / 2, g[1] * ahead * ahead / 2
        for one in self.leavers:
            one.make_room(back, ahead + one.extra)
        for one in self.leavers if self.falls else []:
            if not (one.body in held or one.body.idle):
                one.make_room_to_fall(fall_x, fall_y)
        if self.is_stale:
            self.sweep(margin)
            if self.is_free:
                self.skip_pairs(dt, margin, back)
        else:
            self.search(self.leavers, margin)
        self.leavers, self.is_stale = [], False
        return self.pairs[count:]

    def follow(self, bodies: list[Body], dt: float, margin: float) -> list[Pair]:
        """Make room for bodies that were thrown out of theirs. Return the new near pairs.

        Rooms also cover the path since the throw, at most a step: others may be on it.
        """
        leavers, count = [self.rooms[body] for body in bodies], len(self.pairs)
        for one in leavers:
            one.make_room(min(one.body.flown, dt), max(self.ahead - self.age, dt))
        self.search(leavers, margin)
        return self.pairs[count:]

    def list_near(self) -> None:
        """List the bodies that can move and have others near, and the rest, if any has changed."""
        if not self.is_listed:
            self.is_listed = True
            self.near = [one for one in self.moving if one.near]
            self.far = [] if self.falls else [one for one in self.moving if not one.near]

    def set_ahead(self, dt: float) -> None:
        """Choose the length of new rooms by how the last ones did."""
        if self.is_crowded() or not self.is_late(dt):
            self.ahead = max(self.ahead / 2, dt)
        elif 4 * self.looks < SWEEP * len(self.moving):
            self.ahead = min(2 * self.ahead, LONGEST)
        self.age, self.looks = 0.0, 0

    def is_late(self, dt: float) -> bool:
        """Return whether rooms have lasted as long as they should, in steps of dt seconds."""
        return self.age > self.end + ROUNDING * dt

    def skip_pairs(self, dt: float, margin: float, back: float) -> None:
        """Look at no pair until two balls come within margin px, if nothing pushes.

        All fly straight on, or fall alike. A static body counts as if a ball came near it, and so
        do balls that may have passed each other in the last `back` seconds. Pairs of bodies that
        may be pushed are looked at in each step.
        """
        self.looks += len(self.pairs)
        seconds, first = self.ahead + 2 * dt, NO_HIT
        for pair in self.pairs:
            a, b = pair.a, pair.b
            if a.joint_count or b.joint_count:
                continue
            x, y, reach = a.x - b.x, a.y - b.y, a.r + b.r + margin
            dx, dy = (a.vx - b.vx) * seconds, (a.vy - b.vy) * seconds
            near = reach + sqrt(dx * dx + dy * dy) * back / seconds
            if b.is_static or x * x + y * y <= near * near:
                return
            first = min(first, hit_point(reach, x, y, dx, dy))
        if first < NO_HIT:
            end = first * seconds - 2 * dt
            if end < SOON * dt:
                return
            self.end = end
        self.is_quiet = True
        self.is_listed = False
        self.watched = []
        for pair in self.pairs:
            pair.is_watched = False
        for one in self.moving:
            one.near = one.body.has_moved = False
        for one in self.led:
            self.lead(one)

    def lead(self, one: Bounds) -> None:
        """Note that something may push a body, so it is looked at in each step."""
        self.led[one] = None
        for pair in one.pairs if self.is_quiet else []:
            if not pair.is_watched:
                pair.is_watched = True
                self.watched.append(pair)
                self.rooms[pair.a].near = self.rooms[pair.b].near = True
                self.is_listed = False

    def ignore(self, numbers: set[int]) -> None:
        """Drop the pairs with these numbers."""
        dropped = {pair for pair in self.pairs if pair_number(pair.a, pair.b) in numbers}
        for pair in dropped:
            pair.is_watched = True  # so that nothing adds it again
        is_all = self.watched is self.pairs
        self.pairs = [pair for pair in self.pairs if pair not in dropped]
        kept = [pair for pair in self.watched if pair not in dropped]
        self.watched = self.pairs if is_all else kept

    def hold_led(self, dt: float) -> bool:
        """Return whether bodies that may be pushed are in their rooms, with nobody near.

        Those on joints must be there in dt seconds as well.
        """
        stays = all([one.holds() and not one.pairs for one in self.led])
        return stays and not (self.foresees and any([one.leaves(dt) for one in self.tied]))

    def add_looks(self, count: int, dt: float) -> None:
        """Count checks of pairs that did not touch. After many, the next step has smaller rooms."""
        self.looks += count
        if self.is_crowded() and self.ahead > dt:
            self.is_stale = True

    def is_crowded(self) -> bool:
        """Return whether checks of pairs that did not touch cost more than a sweep."""
        return self.looks > SWEEP * len(self.moving)

    def search(self, leavers: list[Bounds], margin: float) -> None:
        """Add the pairs of leavers that are newly near. Those no longer near stay on the list."""
        for one in leavers:
            one.update_box(self.upright, margin)
            before, last_before = one.first_lane, one.last_lane
            self.find_lanes([one])
            for index in range(one.first_lane, one.last_lane + 1):
                if not before <= index <= last_before:
                    self.lanes[index].append(one)
        for one in leavers:
            a = one.body
            known = [a, *[body for pair in one.pairs for body in (pair.a, pair.b)]]
            for other in self.find_near(one, known):
                self.pair_up(one, other)

    def find_near(self, one: Bounds, known: list[Body]) -> list[Bounds]:
        """Return the boxes that overlap this one, but of known bodies, in the order of the sweep.

        Add those bodies to the known ones: a box may be in several lanes.
        """
        low, high, side_low, side_high = one.low, one.high, one.side_low, one.side_high
        left, right, top, bottom = self.hull
        lanes = self.lanes[one.first_lane : one.last_lane + 1]
        if low < left or high > right or side_low < top or side_high > bottom:
            lanes = [self.bounds]
        found: list[Bounds] = []
        for lane in lanes:
            for other in lane:
                if (
                    other.low < high
                    and other.high > low
                    and other.side_low < side_high
                    and other.side_high > side_low
                    and other.body not in known
                ):
                    found.append(other)
                    known.append(other.body)
        found.sort(key=RANK)
        return found

    def pair_up(self, one: Bounds, other: Bounds) -> None:
        """Add two bodies to the near pairs, if at least one can move."""
        a, b = one.body, other.body
        if a.idle and b.idle:
            return
        if a.id < b.id:
            a, b = b, a
        pair = self.spare.pop() if self.spare else Pair(a, b)
        pair.a, pair.b, pair.contact = a, b, None
        self.pairs.append(pair)
        if self.watched is not self.pairs:
            self.watched.append(pair)
        one.pairs.append(pair)
        other.pairs.append(pair)
        pair.is_watched = True
        if not (one.near and other.near):
            one.near = other.near = True
            self.is_listed = False

    def sweep(self, margin: float) -> None:
        """Add all pairs of boxes within margin px, if at least one can move."""
        self.make_lanes(margin)
        lanes, (left, right, top, bottom) = self.lanes, self.hull
        begun: list[list[Bounds]] = [[] for _ in lanes]  # the boxes in each that have not ended
        self.find_lanes(self.bounds)
        for rank, one in enumerate(self.bounds):
            one.rank = rank
            low, side_low, side_high = one.low, one.side_low, one.side_high
            if low >= right or one.high <= left or side_low >= bottom or side_high <= top:
                continue  # far from all bodies that can move
            first = one.first_lane
            for index in range(first, one.last_lane + 1):
                met = begun[index]
                if len(met) > FEW:
                    met = begun[index] = [other for other in met if other.high > low]
                for other in met:
                    if (
                        other.high > low
                        and other.side_low < side_high
                        and other.side_high > side_low
                        and (index == first or index == other.first_lane)
                    ):
                        self.pair_up(one, other)
                met.append(one)
                lanes[index].append(one)

    def make_lanes(self, margin: float) -> None:
        """Choose the axis of the sweep, work out all boxes, and make empty lanes along it."""
        left, right, top, bottom = self.find_hull(self.widest + margin)
        taller = (bottom - top) / (right - left)
        upright = taller > (1 / WIDER if self.upright else WIDER)
        self.is_listed = False
        for one in self.bounds:
            if one.pairs:
                one.near, one.pairs = False, []
            one.update_box(upright, margin)
        breadth = 0.0  # px, the sum over all boxes
        for one in self.moving:
            breadth += one.side_high - one.side_low
        lane = max(self.narrowest, breadth / len(self.moving))
        self.upright = upright
        self.bounds = sorted(self.rooms.values(), key=LOW)
        if upright:
            left, right, top, bottom = top, bottom, left, right
        self.hull = left, right, top, bottom
        count = min(int((bottom - top) / lane), int(sqrt(len(self.bounds)))) + 1
        self.lanes_per_px = count / (bottom - top)
        self.lanes = [[] for _ in range(count + 1)]

    def find_lanes(self, boxes: list[Bounds]) -> None:
        """Find the lanes that boxes cross."""
        (_, _, top, bottom), per_px, last = self.hull, self.lanes_per_px, len(self.lanes) - 1
        for one in boxes:
            low, high = one.side_low, one.side_high
            one.first_lane = int((low - top) * per_px) if low > top else 0
            one.last_lane = int((high - top) * per_px) if high < bottom else last

    def find_hull(self, edge: float) -> tuple[float, float, float, float]:
        """Return left, right, top and bottom of all rooms, with an edge (px) around them."""
        left = top = inf
        right = bottom = -inf
        for one in self.moving:
            if one.left < left:
                left = one.left
            if one.right > right:
                right = one.right
            if one.top < top:
                top = one.top
            if one.bottom > bottom:
                bottom = one.bottom
        return left - edge, right + edge, top - edge, bottom + edge
