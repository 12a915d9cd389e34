"""The right answers, in closed form: plain numbers in, plain numbers out.

An oracle is a function that would give away the code of a TODO. Students get its recorded answers.
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from grader.judge import recorded


class Disc(NamedTuple):
    x: float
    y: float
    r: float


class Rect(NamedTuple):
    x: float
    y: float
    hx: float  # half extents
    hy: float


class Touch(NamedTuple):
    """A contact: unit normal from A to B, depth in px, the point."""

    nx: float
    ny: float
    depth: float
    px: float
    py: float


@recorded.oracle()
def circle_box(disc: Disc, rect: Rect) -> list[Touch | None]:
    """Return the contact of a disc with a box; several where faces are equally near."""
    x = min(max(disc.x, rect.x - rect.hx), rect.x + rect.hx)
    y = min(max(disc.y, rect.y - rect.hy), rect.y + rect.hy)
    dx, dy = x - disc.x, y - disc.y
    distance = math.hypot(dx, dy)
    if distance >= disc.r:
        return [None]
    if distance > 0:
        return [Touch(dx / distance, dy / distance, disc.r - distance, x, y)]
    ways = ways_out(disc, rect)
    shortest = min(touch.depth for touch in ways)
    return [touch for touch in ways if touch.depth <= shortest + 1e-9]


@recorded.oracle()
def ways_out(disc: Disc, rect: Rect) -> list[Touch]:
    """Return the contacts by which a centre inside could leave: left, right, top, bottom."""
    left, right = rect.x - rect.hx, rect.x + rect.hx
    top, bottom = rect.y - rect.hy, rect.y + rect.hy
    return [
        Touch(1, 0, disc.r + (disc.x - left), left, disc.y),
        Touch(-1, 0, disc.r + (right - disc.x), right, disc.y),
        Touch(0, 1, disc.r + (disc.y - top), disc.x, top),
        Touch(0, -1, disc.r + (bottom - disc.y), disc.x, bottom),
    ]


MAX_STEPS = 8  # in a frame
STEP_SIZES = [1 / 30, 1 / 60, 1 / 120, 1 / 240, 1 / 480]  # s
# Values that properties draw for damping: rates per second, and steps in s.
RATES = [0.001, 0.05, 0.0625, *(number / 8 for number in range(25)), *map(float, range(4, 21))]
DAMPED_STEPS = [*STEP_SIZES, 1 / 24, 1 / 50, 1 / 118, 1 / 100, 1 / 1000, 0.1, 0.25]


@recorded.oracle(RATES, DAMPED_STEPS)
def compute_share(rate: float, seconds: float) -> float:
    """Return the share of a speed that remains after some seconds at a rate per second."""
    return math.exp(-rate * seconds)


# ---------------------------------------------------------------- impulses: TODO 2, 3 and 4

BETA = 0.2  # share of an error corrected in one step
Pair = tuple[float, float]


def inverse(mass: float) -> float:
    """Return 1 / mass, in 1/kg. A mass of 0 marks a static body, which no impulse moves."""
    return 1 / mass if mass else 0.0


class Lever(NamedTuple):
    """A disc, and the arm from its centre to the point where it is pushed."""

    mass: float  # kg, 0 = static
    radius: float  # px
    rx: float
    ry: float

    @property
    def inertia(self) -> float:
        return 0.5 * self.mass * self.radius**2  # kg px²


def cross(first: Pair, second: Pair) -> float:
    return first[0] * second[1] - first[1] * second[0]


@recorded.oracle()
def effective_mass(a: Lever, b: Lever, axis: Pair) -> float:
    """Return inverse masses plus spin terms, in 1/kg."""
    turning = (cross((each.rx, each.ry), axis) ** 2 * inverse(each.inertia) for each in (a, b))
    return inverse(a.mass) + inverse(b.mass) + sum(turning)


class Rod(NamedTuple):
    """A rod at the start of a step."""

    mass_a: float  # kg, 0 = static
    mass_b: float
    length: float  # px, meant
    offset: Pair  # px, from A to B now
    vel_a: Pair
    vel_b: Pair
    dt: float  # s

    @property
    def k(self) -> float:
        return inverse(self.mass_a) + inverse(self.mass_b)

    @property
    def axis(self) -> Pair:
        distance = math.hypot(*self.offset)
        return self.offset[0] / distance, self.offset[1] / distance

    @property
    def speed(self) -> float:
        """Return the speed of B away from A, px/s."""
        (ax, ay), (bx, by), (x, y) = self.vel_a, self.vel_b, self.axis
        return (bx - ax) * x + (by - ay) * y

    @property
    def momentum(self) -> Pair:
        (ax, ay), (bx, by) = self.vel_a, self.vel_b
        return self.mass_a * ax + self.mass_b * bx, self.mass_a * ay + self.mass_b * by

    @property
    def with_swapped_ends(self) -> "Rod":
        """Return the same rod with its ends swapped."""
        x, y = self.offset
        ends = self.mass_b, self.mass_a, self.length, (-x, -y), self.vel_b, self.vel_a
        return Rod(*ends, self.dt)

    @property
    def bias(self) -> float:
        """Return the speed of B away from A that corrects the share BETA of the error, px/s."""
        return -BETA / self.dt * (math.hypot(*self.offset) - self.length)


@recorded.oracle()
def push_ends(rod: Rod, impulse: float) -> tuple[Pair, Pair]:
    """Return the velocities of A and B after an impulse along the axis; above 0 it parts them."""
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    a, b = impulse * inverse(rod.mass_a), impulse * inverse(rod.mass_b)
    return (ax - a * x, ay - a * y), (bx + b * x, by + b * y)


@recorded.oracle()
def solve_rod(rod: Rod) -> tuple[Pair, Pair]:
    """Return the velocities of A and B after a pass over the rod."""
    return push_ends(rod, (rod.bias - rod.speed) / rod.k)


class Spring(NamedTuple):
    """A spring between the ends of a rod; `length` is its rest length."""

    rod: Rod
    stiffness: float  # kg/s²
    damping: float  # kg/s

    @property
    def stretch(self) -> float:
        return math.hypot(*self.rod.offset) - self.rod.length


@recorded.oracle()
def apply_spring(spring: Spring) -> tuple[Pair, Pair]:
    """Return the velocities of A and B after a step of the spring's force (Hooke's law)."""
    rod = spring.rod
    force = spring.stiffness * spring.stretch + spring.damping * rod.speed
    return push_ends(rod, -force * rod.dt)


class Discs(NamedTuple):
    """Two discs that touch; the normal leads from A to B, and mass 0 marks a static body."""

    mu: Pair
    mass: Pair  # kg
    normal: Pair = (0.0, 1.0)
    radius: Pair = (10.0, 10.0)  # px
    drift: Pair = (0.0, 0.0)  # px/s, of both together, where both can move

    @property
    def k(self) -> float:
        """Return the change of speed by one unit of impulse, 1/kg, where nothing turns."""
        return inverse(self.mass[0]) + inverse(self.mass[1])


@recorded.oracle()
def clamp(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))


@recorded.oracle()
def friction(mu: Pair, k: float, closing: float, slip: float) -> float:
    """Return the friction impulse on B along its slip in a step, kg px/s; k in 1/kg."""
    return clamp(-slip / k, math.sqrt(mu[0] * mu[1]) * max(closing / k, 0.0))


# ---------------------------------------------------------------- integrators

State = tuple[float, float]  # x in px, v in px/s
Accel = Callable[[float], float]


def polynomial(coefficients: Sequence[float]) -> Accel:
    """Return the acceleration c0 + c1 x + c2 x² + ..."""
    return lambda x: math.fsum(c * x**power for power, c in enumerate(coefficients))


@recorded.oracle()
def semi_implicit_euler(x: float, v: float, dt: float, accel: Accel) -> State:
    v += dt * accel(x)
    return x + dt * v, v


@recorded.oracle()
def velocity_verlet(x: float, v: float, dt: float, accel: Accel) -> State:
    """Kick half a step (change v), move a whole one, kick half a step."""
    half_way = v + dt / 2 * accel(x)
    x += dt * half_way
    return x, half_way + dt / 2 * accel(x)


@recorded.oracle()
def rk4(x: float, v: float, dt: float, accel: Accel) -> State:
    """Take a step of the classical Runge-Kutta method for (x, v)' = (v, accel(x))."""
    total_dx = total_dv = 0.0
    dx, dv = v, accel(x)
    for weight, reach in ((1, dt / 2), (2, dt / 2), (2, dt), (1, 0.0)):
        total_dx, total_dv = total_dx + weight * dx, total_dv + weight * dv
        dx, dv = v + reach * dv, accel(x + reach * dx)
    return x + dt / 6 * total_dx, v + dt / 6 * total_dv


# ---------------------------------------------------------------- pymunk


def pymunk_fall(gravity: float, dt: float, steps: int) -> tuple[float, float]:
    """Return distance and speed of a fall from rest; pymunk moves bodies, then accelerates them."""
    return gravity * dt**2 * steps * (steps - 1) / 2, gravity * dt * steps


def disc_moment(mass: float, radius: float) -> float:
    return mass * radius**2 / 2


def rolling_speed(speed: float) -> float:
    """Return the speed of a full disc once it rolls; friction only decides when that is."""
    return speed * 2 / 3


# ---------------------------------------------------------------- pictures: bonus task B5

Place = tuple[float, float, float]  # x and y in px, an angle in rad


@recorded.oracle()
def part_of_the_way(before: Place, now: Place, share: float) -> Place:
    """Return position and angle at this share of the way from `before` to `now`."""
    x, y, angle = (begin + (end - begin) * share for begin, end in zip(before, now, strict=True))
    return x, y, angle
