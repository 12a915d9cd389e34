"""Loads: where much presses on little, contacts and rods are solved together."""

from math import hypot, inf

from .body import Body
from .contact import Contact, is_at_face
from .effect import Direction
from .joint import Joint
from .limits import Limited, solve_within
from .network import Network, bodies_of

HEAVY = 2.5  # times the lightest ball at a contact
TALL = 13.3  # weights of its effective mass; a contact that bears more carries a tower. Not whole,
# so that rounding does not decide between towers of equal balls
LEANING = 0.1  # a sine; a tower leans less
SUNK = 0.01  # in units of the world; a contact that gives way by less sinks too little to be seen
BEARING = 0.05  # weights of its effective mass; a contact with less bears nothing
DEEP = 0.05  # of both radii; balls that overlap by more were thrown at each other
TIED = 0.005  # the same for balls on rods: these take over what a push leaves
RESTING = 30.0  # 1/s, in units of the world; a ball that bounces faster is left to impacts
CALM = 0.5  # 1/s, in units of the world, by the square of that ratio: passes may leave this speed
STEEPEST = 1000.0  # a larger ratio counts as this, or rounding would decide what presses
MOST_ROWS = 128  # contacts and rods of a pile; a larger one is left to passes
FEW_ROWS = 32  # the same where balls were thrown at each other
FAR = 0.5  # radii; where a ball moves by more in a substep, its contacts are other ones by then
PUSHED = 0.1  # share by which a contact gives way, per ratio: many firm ones have no solution
FRAMED = 1.0  # the same where frames of rods press
SOFTEST = 1e-2  # the most of both
HARDEST = 1e-6  # the least of both, and all in a tower, where firm ones do have a solution
GENTLE = 0.1  # share of the highest push, for balls on rods of equal masses that overlap
RELAXED = 1e-3  # of that share, what is left after the move
WEDGED = 0.9  # cosine; a ball between faces that turn less is pressed as by a heavier one
PARALLEL = 1 - 1e-9  # cosine, of faces that are one
OPPOSITE = -0.5  # cosine; faces that turn further apart clamp what is between them
TRIES = 3  # of a pile with rods, before the move: a length is no linear function of the speeds
TURNING = 0.01  # rad in a substep; rods that turn by more pull at balls that contacts hold
LEVEL = 1e-6  # a sine; contacts that rise by less do not bear what is above


class Stage:
    """What contacts aim at: to part at the rates of their bias, or once bodies moved, to stop."""

    __slots__ = ("ball_rate", "h", "has_moved", "least", "most", "static_rate")

    def __init__(self, h: float, most: float, least: float) -> None:
        self.h = h  # s
        self.most = most  # px/s, overlap is pushed out no faster
        self.least = least  # px, a larger gap may be closed
        self.has_moved = True
        self.ball_rate = self.static_rate = 0.0  # 1/s, before the move


class Load(Limited):
    """A contact in a pile."""

    __slots__ = ("give", "haste", "pressed", "ratio")

    def __init__(self, c: Contact, ratio: float) -> None:
        super().__init__(c)
        self.ratio = ratio  # of the heavier body, or its frame, to the lighter ball
        self.give = 0.0  # the share that it gives way
        self.haste = 1.0  # the share of the highest speed at which overlap is pushed out
        self.pressed = -1.0  # kg px/s, beside rods its impulse before the move

    def aim(self, stage: Stage) -> None:
        """Set rhs to the speed (px/s) that the bodies lack, and the pivot."""
        c, a, b = self.c, self.end_a, self.end_b
        speed = (b.vx - a.vx) * self.nx + (b.vy - a.vy) * self.ny
        gap = (b.x - a.x) * self.nx + (b.y - a.y) * self.ny - c.reach
        rate = stage.ball_rate if b.inv_mass else stage.static_rate
        give = self.give * RELAXED if stage.has_moved else self.give
        self.pivot = (1 + give) / c.mn
        presses = c.jn > 0 if self.pressed < 0 else self.pressed > 0
        if gap > stage.least and not (stage.has_moved and presses):
            self.rhs = -speed - gap / stage.h
        else:
            push = max(rate * gap, -stage.most * self.haste)
            self.rhs = -speed - push - give * c.jn / c.mn

    def take(self, j: float, has_moved: bool) -> None:
        super().take(j, has_moved)
        self.c.jn = self.total


class Pile:
    """Contacts, and rods of frames, that balls connect.

    A pass over contacts takes from a body of mass M only the share m / (M + m) of its speed, if the
    ball below has mass m. So what a pass leaves is solved exactly, for the contacts that press.
    """

    __slots__ = (
        *("bodies", "calm", "is_wild", "lengths", "loads", "network", "rods", "rows", "stage"),
        *("tries", "turning"),
    )

    def __init__(self, loads: list[Load], rods: list[Joint], unit: float, softest: float) -> None:
        self.loads = loads
        self.rods = rods
        self.rows: list[Joint] = [*loads, *rods]
        self.bodies = bodies_of(self.rows)
        masses = [body.m for body in self.bodies if body.m]
        ratio = max(max(masses) / min(masses), *[load.ratio for load in self.loads])
        for load in self.loads:
            given = (FRAMED if self.rods else PUSHED) / ratio
            load.give = max(min(given, softest), HARDEST)
            load.haste = GENTLE if self.rods and ratio <= HEAVY else 1.0
        self.calm = CALM * unit / min(ratio, STEEPEST) ** 2  # px/s
        self.lengths: list[float] = []  # px, of its rods after the move
        self.tries = TRIES if rods else 1
        turning = [load for load in loads if not (rods and is_at_face(load.c))]
        self.turning = bodies_of(turning)  # at contacts that are other ones once these moved far
        self.is_wild = False  # whether they move far in this substep
        self.network: Network[Joint] | None = None  # of all rows, once it was needed

    def look(self, h: float) -> None:
        """Note the lengths that rods will have after the move, before contacts change them."""
        self.lengths = [length_after(rod, h) for rod in self.rods]
        self.is_wild = any(
            [b.inv_mass > 0 and hypot(b.vx, b.vy) * h > FAR * b.r for b in self.turning]
        )

    def forget_impacts(self) -> None:
        """Begin a substep with impulses no larger than those of the substep before the last.

        The warm start would repeat an impact, and passes would not take that back. With frames,
        begin with none: where a ball sits between balls of a frame, impulses can be so large that
        the least turn of the frame would throw it.
        """
        for load in self.loads:
            c, before = load.c, load.c.jn
            lower(c, 0.0 if self.rods else c.last)
            c.last = before

    def end(self) -> None:
        """Lower impulses to those before a move: a step without this pile begins with them."""
        for load in self.loads if self.rods else []:
            lower(load.c, min(load.c.last, load.pressed))

    def settle(self, stage: Stage) -> None:
        """Solve for all impulses, if a pass has left more than a calm speed."""
        if self.is_wild:
            return
        self.stage = stage
        for load in self.loads:
            load.follow()
        for _ in range(1 if stage.has_moved else self.tries):
            lack = self.lack()
            if lack <= self.calm or not self.press(lack):
                break
        for load in self.loads if self.rods and not stage.has_moved else []:
            load.pressed = load.c.jn

    def lack(self) -> float:
        """Return the most that a contact or rod lacks, in px/s."""
        most = 0.0
        for load in self.loads:
            load.aim(self.stage)
            most = max(most, load.rhs if load.c.jn == 0 else abs(load.rhs))
        return max([most, *[abs(speed) for speed in self.lacking()]])

    def lacking(self) -> list[float]:
        """Return the speeds (px/s) that rods lack to keep their lengths."""
        if self.stage.has_moved:
            return [-rod.speed() for rod in self.rods]
        h = self.stage.h
        both = zip(self.rods, self.lengths, strict=True)
        return [(length - length_after(rod, h)) / h for rod, length in both]

    def press(self, lack: float) -> bool:
        """Apply the impulses of the contacts that press, and of the rods, and return True.

        Change nothing if more (px/s) would then lack than before, as where rods turn very far.
        """
        if self.network is None:
            self.network = Network(self.rows)
        for load in self.loads:
            load.total = load.c.jn
        return solve_within(
            *(self.network, self.loads, self.aim, self.calm, self.stage.has_moved),
            lambda: self.stage.has_moved or not self.rods or self.lack() <= lack,
        )

    def aim(self) -> None:
        """Set each row's pivot and rhs."""
        for load in self.loads:
            load.aim(self.stage)
        for rod, speed in zip(self.rods, self.lacking(), strict=True):
            rod.ask(rod.speed() + speed)


def lower(c: Contact, most: float) -> None:
    """Lower the impulses of a contact until the normal one is at most this (kg px/s)."""
    before, c.jn = c.jn, max(min(c.jn, most), 0.0)
    if c.jn < before:
        c.jt *= c.jn / before  # friction without its load would throw balls


def length_after(rod: Joint, h: float) -> float:
    """Return the length (px) of a rod after a move of h seconds."""
    a, b = rod.end_a, rod.end_b
    return hypot(b.x - a.x + (b.vx - a.vx) * h, b.y - a.y + (b.vy - a.vy) * h)


def find_piles(
    contacts: list[Contact],
    rods: list[Joint],
    loads: dict[Body, float],
    tied: set[Contact],
    unit: float,
) -> list[Pile]:
    """Return the piles in which a body, or a frame, is much heavier than a ball at its contact.

    So are those with balls thrown at each other, unless they bounce or joints hold them. loads are
    the masses (kg) that press where they are not the bodies' own, as in frames of rods. unit is
    that of the world.
    """
    ratios = [ratio_of(c, loads) if loads else c.ratio for c in contacts]
    firsts = find_firsts(contacts, ratios, loads, tied, unit)
    if not firsts:
        return []
    count = len(contacts)
    ends = [(c.a, c.b) for c in contacts] + [(rod.end_a, rod.end_b) for rod in rods]
    beside: dict[Body, list[int]] = {}  # the places of each ball's contacts and rods
    for place, (a, b) in enumerate(ends):
        if a.inv_mass:
            beside.setdefault(a, []).append(place)
        if b.inv_mass:
            beside.setdefault(b, []).append(place)
    piles: list[Pile] = []
    seen: set[int] = set()
    for first, most in firsts:
        if first not in seen:
            places = sorted(places_from(ends[first], ends, beside, most))
            seen.update(places)
            if not 1 < len(places) <= most:
                continue
            bodies = [body for at in places for body in ends[at]]
            if most == MOST_ROWS or not any([body.joint_count for body in bodies]):
                rows = [Load(contacts[at], ratios[at]) for at in places if at < count]
                held = [rods[at - count] for at in places if at >= count]
                if not is_clamped(rows):
                    piles.append(Pile(rows, held, unit, SOFTEST))
    return piles


def find_wedged(contacts: list[Contact]) -> dict[Body, float]:
    """Return the balls between faces that are nearly parallel, as in a narrow or a flat V.

    The impulse at each face grows as if the ball had the mass (kg) returned with it.
    """
    firsts: dict[Body, Contact] = {}
    wedged: dict[Body, float] = {}
    for c in contacts:
        first = firsts.setdefault(c.a, c)
        alike = abs(first.nx * c.nx + first.ny * c.ny)
        if WEDGED < alike < PARALLEL:
            wedged[c.a] = max(wedged.get(c.a, 0.0), c.a.m / (1 - alike))
    return wedged


def find_firsts(
    contacts: list[Contact],
    ratios: list[float],
    loads: dict[Body, float],
    tied: set[Contact],
    unit: float,
) -> list[tuple[int, int]]:
    """Return the places of contacts that make a pile, each with the most rows it may have."""
    heavy: list[tuple[int, int]] = []
    deep: list[tuple[int, int]] = []
    for place, (c, ratio) in enumerate(zip(contacts, ratios, strict=True)):
        is_deep = c.gap < -DEEP * (c.a.r + c.b.r)
        is_tied = c in tied and (c.a in loads or c.b in loads)
        is_slow = not c.e or abs(c.closing_speed()) < RESTING * unit
        if (ratio > HEAVY or is_tied) and is_slow:
            heavy.append((place, MOST_ROWS))
        elif is_deep and c.b.inv_mass and not c.e:
            deep.append((place, FEW_ROWS))
    return heavy + deep


def find_towers(
    contacts: list[Contact], piles: list[Pile], tall: float, weight: float, unit: float
) -> list[Pile]:
    """Return the piles of balls in a row that bear much, besides these other piles.

    There each ball touches at most two others, and the row has no way round. A contact bears much
    if its impulse is more than `tall` (px/s) times its mass. weight is that of 1 kg in a substep.
    """
    beside: dict[Body, list[Contact]] = {}
    for c in contacts:
        if c.a.touches <= 2 and c.b.touches <= 2:
            for body in (c.a, c.b):
                if body.inv_mass:
                    beside.setdefault(body, []).append(c)
    towers: list[Pile] = []
    seen = {body for pile in piles for body in pile.bodies}
    for first, near in beside.items():
        if first not in seen and any([c.jn > tall * c.mn for c in near]):
            balls = in_touch([first], beside)
            rows = dict.fromkeys([c for ball in balls for c in beside[ball]])
            seen.update(balls)
            links = 2 * len([c for c in rows if c.b.inv_mass])
            is_row = links == sum([b.touches for b in balls]) and links < 2 * len(balls)
            if is_row and len(balls) <= MOST_ROWS and not any([b.joint_count for b in balls]):
                loads = [
                    Load(c, max(c.jn / (weight * c.mn), c.ratio))
                    for c in rows
                    if c.jn > BEARING * weight * c.mn
                ]
                if not is_clamped(loads):
                    towers.append(Pile(loads, [], unit, HARDEST))
    return towers


def is_clamped(loads: list[Load]) -> bool:
    """Return whether a kinematic body presses balls against another body that does not give way.

    Then no impulses can stop the balls: a solution of all at once would grow without end.
    """
    firm = [load.c for load in loads if not load.c.b.inv_mass]
    presses = [c for c in firm if c.b.is_kinematic]
    return any([p.nx * c.nx + p.ny * c.ny < OPPOSITE for p in presses for c in firm])


def ratio_of(c: Contact, loads: dict[Body, float]) -> float:
    """Return the ratio of the masses (kg) that press at a contact."""
    most = max(loads.get(c.a, 0.0), loads.get(c.b, 0.0))
    return max(c.ratio, most / min(c.a.m, c.b.m or c.a.m)) if most else c.ratio


def places_from(
    both: tuple[Body, Body],
    ends: list[tuple[Body, Body]],
    beside: dict[Body, list[int]],
    most: int,
) -> set[int]:
    """Return the places of all that balls connect to one of these two bodies, or more than most."""
    found: set[int] = set()
    ahead = set(both)
    while ahead and len(found) <= most:
        new = {place for body in ahead for place in beside.get(body, [])} - found
        found |= new
        ahead = {body for place in new for body in ends[place]}
    return found


def take_off(contacts: list[Contact], lost: dict[Body, float], direction: Direction) -> None:
    """Take the impulses (kg px/s) that bodies have lost off the contacts that bear them.

    All that a body has lost goes through the contacts ahead of it in the direction, in the ratio of
    what they bear, to the bodies there. A body that leaves has lost infinity: it bears nothing
    either. Without a static body, nothing bears what touched it.
    """
    beside: dict[Body, list[Contact]] = {}
    for c in contacts:
        beside.setdefault(c.a, []).append(c)
        beside.setdefault(c.b, []).append(c)
    x, y = direction
    found = in_touch([*lost], beside)
    for body in sorted(found, key=lambda body: (lost.get(body) != inf, body.x * x + body.y * y)):
        if body.is_static:
            for c in [c for ball in found if ball.m for c in beside.get(ball, [])]:
                c.jn = c.jt = 0.0
        elif body in lost:
            unload(body, lost, beside.get(body, []), direction)


def unload(
    ball: Body, lost: dict[Body, float], contacts: list[Contact], direction: Direction
) -> None:
    """Lower the impulses of a ball's contacts by what it lost, and note what those ahead lose."""
    x, y = direction
    size = hypot(x, y) or 1.0
    sides = [(c, c.b, 1.0) if c.a is ball else (c, c.a, -1.0) for c in contacts]
    ahead = [(c, other, (c.nx * x + c.ny * y) / size * side) for c, other, side in sides]
    if lost[ball] < inf:
        ahead = [(c, other, share) for c, other, share in ahead if share > -LEVEL]
    borne = sum([c.jn * max(share, 0.0) for c, _, share in ahead])
    left = max(1 - lost[ball] / borne, 0.0) if borne else 0.0
    for c, other, share in ahead:
        if share > 0 and not other.is_static:
            lost[other] = lost.get(other, 0.0) + c.jn * (1 - left) * share
        c.jn *= left
        c.jt *= left


def in_touch(bodies: list[Body], beside: dict[Body, list[Contact]]) -> list[Body]:
    """Return these bodies and the balls that touch them, directly or through other balls."""
    found, ahead = dict.fromkeys(bodies), [*bodies]
    while ahead:
        near = [b for c in beside.get(ahead.pop(), []) for b in (c.a, c.b) if not b.is_static]
        ahead += [b for b in dict.fromkeys(near) if b not in found]
        found.update(dict.fromkeys(near))
    return list(found)
