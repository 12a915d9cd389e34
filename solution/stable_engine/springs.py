"""Springs: Hooke's law, with damping."""

from math import expm1, hypot

from .body import Body, State, state_of
from .joint import Joint, Joints
from .network import Network, bodies_of, connect, tied_to
from .row import Row
from .validate import not_negative

NUMEROV = 1 / 12  # of how the stretch curves in a substep: see Springs
STIFF = 0.25  # a spring is stiff if (omega h)² and its damping in a substep are more than this
FIRM = 0.04  # (omega dt)² of a step; overlaps that press a softer spring hardly load it
MOST_SWAY = 1e9  # rad²; no more counts, as its sixth power might be no number
SWAYS = 0.5  # rad², of a light ball between tight springs in a substep; less is left alone
SMALL = 1e-3  # below it, a series is more exact than the quotient
LEAST_DRAG = 1e-12  # share of the mass: a spring without drag would have no row in the network


class Spring(Joint):
    """Pull or push a and b to `length` px apart, by default the initial distance.

    stiffness is force per px of stretch (kg/s²), damping is force per px/s (kg/s).

    In a substep of h s, it is stiff if (omega h)² + rate h > 0.25: without damping, if omega h is
    above 0.5. At both ends, omega² (1/s²) adds up the stiffness of all springs by the mass of the
    end, and rate (1/s) their damping. A spring that is not stiff keeps its energy but for damping.
    """

    __slots__ = ("c", "crowd", "drag", "k", "pull", "rate", "tied", "vx", "vy")
    effect = "Springs"

    def __init__(
        self,
        a: Body,
        b: Body,
        stiffness: float,
        damping: float = 0.0,
        length: float | None = None,
    ) -> None:
        super().__init__(a, b)
        self.crowd = 0.0  # 1/s², its maximum omega², from all springs at its ends
        self.rate = 0.0  # 1/s, at which damping slows it at most, by all springs at its ends
        self.tied = False  # whether any of its ends has another spring
        self.pull = 0.0  # kg px/s, from its stretch in a substep
        self.drag = 0.0  # kg, impulse per px/s between its ends
        self.vx = self.vy = 0.0  # px/s, of B as seen from A in the move before
        self.k = not_negative("Spring.stiffness", stiffness)
        self.c = not_negative("Spring.damping", damping)
        if length is not None:
            self.rest = self.fitting(length)

    @property
    def stiffness(self) -> float:
        """Return the force per px of stretch, in kg/s². Setting it wakes both ends."""
        return self.k

    @stiffness.setter
    def stiffness(self, value: float) -> None:
        self.k = not_negative("Spring.stiffness", value)
        self.changed()

    @property
    def damping(self) -> float:
        """Return the force per px/s, in kg/s. Setting it wakes both ends."""
        return self.c

    @damping.setter
    def damping(self, value: float) -> None:
        self.c = not_negative("Spring.damping", value)
        self.changed()

    def is_stiff(self, h: float) -> bool:
        """Return whether it, with all springs at its ends, swings too fast for substeps of h s."""
        return (self.crowd * h + self.rate) * h > STIFF

    def aim(self) -> None:
        """Set pivot and rhs for Network.solve: the impulse that its stretch after the move asks."""
        give = 1 / self.drag
        self.pivot = 1 / self.m + give
        self.rhs = (self.pull - self.given) * give - self.speed()

    def sway(self, h: float) -> float:
        """Return the drag (kg) across it with which a light end swings no faster than h allows.

        Between tight springs it might: then its swing would grow. Others need none.
        """
        tight = -self.given * h / self.distance if self.distance else 0.0  # kg
        turn2 = 2 * tight / self.m  # rad², of that swing in a substep of h seconds, squared
        share = 1 - 1 / (1 + min(turn2 / 2, MOST_SWAY) ** 6)
        return tight * share if turn2 > SWAYS else 0.0

    def pull_between(self, here: State, there: State, ago: float = 0.0) -> tuple[float, float]:
        """Return the force (kg px/s²) on an end with the state `here`, the other being `there`.

        It may pull as it did so many seconds ago.
        """
        dx, dy, vx, vy = [b - a for a, b in zip(here, there, strict=True)]
        distance = hypot(dx, dy)
        if distance == 0:
            return 0.0, 0.0
        nx, ny = dx / distance, dy / distance
        force = self.k * (distance - self.rest) + (self.c - self.k * ago) * (vx * nx + vy * ny)
        return force * nx, force * ny


class Sway(Row):
    """The motion of the ends of a tight spring across it, as a row of a network."""

    __slots__ = ()

    def __init__(self, spring: Spring, drag: float) -> None:
        super().__init__(spring.end_a, spring.end_b, -spring.ny, spring.nx)
        self.pivot, self.rhs = 1 / self.m + 1 / drag, -self.speed()


class Springs(Joints[Spring]):
    """Springs as soft constraints, solved together: stable at any stiffness and damping.

    A soft spring pulls by its present stretch, and keeps its energy. A stiff one, see Spring, would
    swing wider and wider. So the stiffer it is, the more it pulls by its stretch after the move,
    which damps motion too fast for a substep.
    Impulses add up over substeps, so that a chain hangs by Hooke's law.

    By its stretch alone, a spring swings too fast by (omega h)² / 24. So a twelfth of the
    change of its speed counts as extra stretch: Numerov's method, with an error of h⁴. Damping acts
    partly by the speed before the substep and partly by that after it, see part_after.
    """

    __slots__ = ("last", "networks", "springs_of")
    rank = 1

    def __init__(self) -> None:
        super().__init__()
        self.networks: list[Network[Spring]] = []
        self.springs_of: dict[Body, list[Spring]] = {}
        self.last = 0.0  # s, the substep of the last step

    def prepare(self, h: float) -> None:
        """Take impacts out of the swing."""
        self.find_networks()
        self.relax(h)

    def find_networks(self) -> None:
        """Find the networks again, if springs were added, changed or removed."""
        if self.is_stale:
            self.is_stale = False
            self.networks = connect(self.awake)
            self.find_crowds()

    def find_crowds(self) -> None:
        """Find how fast each spring may swing and slow down, with all springs at its ends."""
        self.springs_of = {}
        for spring in self.awake:
            for body in (spring.end_a, spring.end_b):
                self.springs_of.setdefault(body, []).append(spring)
        sums = {
            end: (sum([s.k for s in at]) * end.inv_mass, sum([s.c for s in at]) * end.inv_mass)
            for end, at in self.springs_of.items()
        }
        for spring in self.awake:
            (k_a, c_a), (k_b, c_b) = sums[spring.end_a], sums[spring.end_b]
            spring.crowd, spring.rate = k_a + k_b, c_a + c_b
            ends = spring.end_a, spring.end_b
            spring.tied = any([not end.is_static and len(self.springs_of[end]) > 1 for end in ends])

    def find_stiff(self, h: float) -> list[Spring]:
        """Return the springs that are stiff in substeps of h seconds."""
        self.find_networks()
        return [spring for spring in self.awake if spring.is_stiff(h)]

    def acceleration(self, body: Body, h: float) -> tuple[float, float]:
        """Return the acceleration (px/s²) of a body by its springs that are not stiff."""
        x = y = 0.0
        for spring in self.springs_of.get(body, []):
            if not spring.is_stiff(h):
                fx, fy = spring.pull_between(state_of(body), state_of(spring.other_end(body)))
                x, y = x + fx * body.inv_mass, y + fy * body.inv_mass
        return x, y

    def holds(self, body: Body) -> bool:
        """Return whether a body is a ball on one of these."""
        self.find_networks()
        return body.inv_mass > 0 and body in self.springs_of

    def are_firm(self, dt: float) -> bool:
        """Return whether any swings so fast that overlaps of a step of dt seconds matter to it."""
        self.find_networks()
        return any([spring.crowd * dt * dt > FIRM for spring in self.awake])

    def stiff_around(self, body: Body, h: float) -> list[Spring]:
        """Return the stiff springs that tie a ball to others, these to more, and so on."""
        return tied_to(self.find_stiff(h), body)

    def others_on(self, springs: list[Spring], body: Body) -> list[Body]:
        """Return the balls on these springs, without one."""
        return [end for end in bodies_of(springs) if end.inv_mass and end is not body]

    def energy_in(self, springs: list[Spring]) -> float:
        """Return the energy (kg px²/s²) in some springs."""
        energy = 0.0
        for spring in springs:
            a, b = spring.end_a, spring.end_b
            stretch = hypot(b.x - a.x, b.y - a.y) - spring.rest
            energy += spring.k * stretch * stretch / 2
        return energy

    def warm_start(self, h: float) -> None:
        for spring in self.awake:
            spring.measure()
            k = spring.k
            turn2 = h * h * spring.crowd  # rad², its swing in a substep, squared
            ahead = 1 - share_before(turn2)  # the share of the stretch after the move
            heavier = (1 - ahead) * NUMEROV * h * h * k  # kg
            last = h * spring.c * part_after(h * spring.rate)  # kg, damping by the speed after
            first = h * spring.c - last
            before = spring.vx * spring.nx + spring.vy * spring.ny
            spring.pull = (heavier - first) * before - h * k * (spring.distance - spring.rest)
            spring.drag = max(last + ahead * h * h * k + heavier, LEAST_DRAG * spring.m)
            spring.apply_impulse(spring.given)

    def solve(self, h: float) -> None:
        for spring in self.awake:
            spring.aim()
        for network in self.networks:
            network.solve()
        for spring in self.awake:
            spring.take(spring.rhs)
        drags = [(spring, spring.sway(h)) for spring in self.awake if spring.tied]
        sways = [Sway(spring, drag) for spring, drag in drags if drag]
        for across in connect(sways) if sways else []:
            across.solve()
            for sway in across.rows:
                sway.apply_impulse(sway.rhs)

    def lag(self, seconds: float) -> None:
        """Add the pull of soft springs: that of a third of a substep before, as it changes.

        Where any spring of a network is stiff, only gravity lags, or momentum would not be kept;
        nothing does where a contact or static body holds it, or what joints tie it to. If other
        substeps make it soft or stiff, its velocities lag from then on, or no more.
        """
        self.find_networks()
        h, before = 2 * abs(seconds), self.last if seconds < 0 else 0.0
        for network in self.networks:
            is_stiff, was_stiff = any_stiff(network.rows, h), any_stiff(network.rows, before)
            is_held = (is_stiff or was_stiff) and self.is_held(network)
            if not is_stiff or (before and not was_stiff):
                self.lag_softly(network.rows, seconds, before if was_stiff else 0.0)
                gx, gy = self.world.g
                for body in bodies_of(network.rows) if was_stiff and is_held else []:
                    body.lag_x += gx * before / 2
                    body.lag_y += gy * before / 2
            elif is_held:
                for body in bodies_of(network.rows):
                    body.is_pressed = True
        self.last = h

    def is_held(self, network: Network[Spring]) -> bool:
        """Return whether a contact or static body holds a network, or what joints tie it to."""
        return any([body.is_pressed or body.is_static for body in self.bodies_around(network)])

    def bodies_around(self, network: Network[Spring]) -> list[Body]:
        """Return all bodies that joints connect with a network, and its own."""
        bodies = bodies_of(network.rows)
        if all([body.joint_count == len(self.springs_of[body]) for body in bodies]):
            return bodies
        effects = self.world.effects.values()
        joints = [one for effect in effects if isinstance(effect, Joints) for one in effect.awake]
        ball = next(body for body in bodies if not body.is_static)
        return bodies_of(tied_to(joints, ball))

    def lag_softly(self, springs: list[Spring], seconds: float, before: float) -> None:
        """Let velocities lag by the pull of springs in so many seconds.

        If these were stiff in substeps of `before` s, velocities are half of that older already.
        """
        h = 2 * abs(seconds)
        for spring in springs:
            a, b = spring.end_a, spring.end_b
            age = before / 2 * share_before(before * before * spring.crowd)  # s
            lag = seconds * share_before(h * h * spring.crowd) + age
            fx, fy = spring.pull_between(state_of(a), state_of(b), h / 3)
            a.lag_x += fx * a.inv_mass * lag
            a.lag_y += fy * a.inv_mass * lag
            b.lag_x -= fx * b.inv_mass * lag
            b.lag_y -= fy * b.inv_mass * lag

    def relax(self, h: float) -> None:
        """Keep the speeds of this move for the next one."""
        for spring in self.awake:
            spring.vx = spring.end_b.vx - spring.end_a.vx
            spring.vy = spring.end_b.vy - spring.end_a.vy

    def drag(self, rates: dict[Body, float]) -> None:
        for spring in self.awake:
            for body in (spring.end_a, spring.end_b) if spring.c else ():
                rates[body] = rates.get(body, 0.0) + spring.c * body.inv_mass


def any_stiff(springs: list[Spring], h: float) -> bool:
    """Return whether any of these springs is stiff in substeps of h seconds."""
    return any([spring.is_stiff(h) for spring in springs])


def share_before(turn2: float) -> float:
    """Return the share of a pull that is by the stretch before the move; turn2 is in rad².

    That is all of the pull of a soft spring: the rest takes energy.
    """
    return 1 / (1 + turn2 * turn2 * turn2) if turn2 > STIFF else 1.0


def part_after(lost: float) -> float:
    """Return the part of damping that must act by the speed after a substep, 0.5 to 1.

    `lost` is the damping rate times the substep. With this part, what damping alone leaves of a
    speed is exactly exp(-lost).
    """
    if lost < SMALL:
        return 0.5 + lost / 12
    return 1 / -expm1(-lost) - 1 / lost
