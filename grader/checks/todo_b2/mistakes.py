"""Known mistakes in TODO B2, as models of what one step of a spring does to its ends."""

import math
from functools import partial

from grader.checks import exact
from grader.checks.exact import Pair, Spring
from grader.judge.misconceptions import Undecided, mistake, truth

Ends = tuple[Pair, Pair]  # velocities of A and B, px/s

truth("spring", exact.spring_applied)

known = partial(mistake, "B2", "spring")


def pulled(spring: Spring, force: float) -> Ends:
    """After a step of a force that draws the ends together, kg px/s²."""
    return exact.pushed(spring.rod, -force * spring.rod.dt)


def brake(spring: Spring) -> float:
    return spring.damping * spring.rod.speed


known(
    "pushes-when-stretched",
    "The force is turned round: a stretched spring must pull.",
    lambda s: pulled(s, -s.stiffness * s.stretch - brake(s)),
)
known(
    "damping-drives",
    "The damping has the wrong sign: it must work against the speed.",
    lambda s: pulled(s, s.stiffness * s.stretch - brake(s)),
)
known(
    "damping-is-forgotten",
    "The damping is left out: the spring swings for ever.",
    lambda s: pulled(s, s.stiffness * s.stretch),
)
known(
    "takes-the-distance-for-the-stretch",
    "The force grows with the distance; it must grow with what that is above the length at rest.",
    lambda s: pulled(s, s.stiffness * (s.stretch + s.rod.length) + brake(s)),
)
known(
    "stretch-the-other-way",
    "The stretch is turned round: it is the distance minus the length at rest.",
    lambda s: pulled(s, -s.stiffness * s.stretch + brake(s)),
)
known(
    "only-pulls",
    "It only pulls, like a rubber band; a squeezed spring must push.",
    lambda s: pulled(s, max(0.0, s.stiffness * s.stretch + brake(s))),
)
known(
    "a-hundred-and-twentieth",
    "The force acts for 1/120 s whatever dt is; it must act for dt seconds.",
    lambda s: exact.pushed(s.rod, -(s.stiffness * s.stretch + brake(s)) / 120),
)


def brakes_all(spring: Spring) -> Ends:
    """Return the velocity of B as seen from A is braked, and not its part along the spring."""
    rod = spring.rod
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    pull = spring.stiffness * spring.stretch
    fx = rod.dt * (pull * x + spring.damping * (bx - ax))
    fy = rod.dt * (pull * y + spring.damping * (by - ay))
    a, b = exact.inverse(rod.mass_a), exact.inverse(rod.mass_b)
    return (ax + a * fx, ay + a * fy), (bx - b * fx, by - b * fy)


known(
    "damps-sideways-as-well",
    "The damping brakes what goes across the spring, too; it is for the speed along it.",
    brakes_all,
)
known(
    "forgets-the-step",
    "The force acts for dt seconds: what changes the velocities is force·dt.",
    lambda spring: exact.pushed(spring.rod, -spring.stiffness * spring.stretch - brake(spring)),
)


def without_masses(spring: Spring) -> Ends:
    rod = spring.rod
    change = (spring.stiffness * spring.stretch + brake(spring)) * rod.dt  # px/s
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    return (ax + change * x, ay + change * y), (bx - change * x, by - change * y)


known(
    "forgets-the-masses",
    "Both ends get the same change of speed; each takes it by inv_mass.",
    without_masses,
)


def times_masses(spring: Spring) -> Ends:
    rod = spring.rod
    change = (spring.stiffness * spring.stretch + brake(spring)) * rod.dt  # kg px/s
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    if not (rod.mass_a and rod.mass_b):
        raise Undecided  # a division by 0
    a, b = change * rod.mass_a, change * rod.mass_b
    return (ax + a * x, ay + a * y), (bx - b * x, by - b * y)


known(
    "divides-by-the-inverse-mass",
    "inv_mass is 1/m already: an end takes the impulse times it.",
    times_masses,
)
known(
    "offset-for-the-axis",
    "The force grows with the distance once more: its direction is axis, 1 long, and not offset.",
    lambda s: pulled(s, (s.stiffness * s.stretch + brake(s)) * math.hypot(*s.rod.offset)),
)
known(
    "pulls-when-squeezed",
    "It pulls however long it is: the stretch has a sign, below 0 for a squeezed spring.",
    lambda s: pulled(s, s.stiffness * abs(s.stretch) + brake(s)),
)


def whole_speed(spring: Spring) -> float:
    (ax, ay), (bx, by) = spring.rod.vel_a, spring.rod.vel_b
    return math.hypot(bx - ax, by - ay)


known(
    "damps-by-the-whole-speed",
    "The damping takes the whole speed of B as seen from A; it is for the part along the axis, "
    "which has a sign: a dot product.",
    lambda s: pulled(s, s.stiffness * s.stretch + s.damping * whole_speed(s)),
)
known(
    "moves-only-a",
    "Only A is pulled; B must get the opposite impulse.",
    lambda spring: (exact.spring_applied(spring)[0], spring.rod.vel_b),
)
known(
    "moves-only-b",
    "Only B is pulled; A must get the opposite impulse.",
    lambda spring: (spring.rod.vel_a, exact.spring_applied(spring)[1]),
)
