"""Known mistakes in TODO B2, as models of what one step of a spring does to its ends."""

import math

from grader.checks import exact
from grader.checks.exact import Pair, Spring
from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import Undecided, truth

Ends = tuple[Pair, Pair]  # velocities of A and B, px/s

truth("spring", exact.spring_applied)

known = known_in("B2", "spring")


def pull_ends(spring: Spring, force: float) -> Ends:
    """Return the velocities after a step of a force that draws the ends together, kg px/s²."""
    return exact.push_ends(spring.rod, -force * spring.rod.dt)


def brake(spring: Spring) -> float:
    return spring.damping * spring.rod.speed


known("pushes-when-stretched", lambda s: pull_ends(s, -s.stiffness * s.stretch - brake(s)))
known("damping-drives", lambda s: pull_ends(s, s.stiffness * s.stretch - brake(s)))
known("damping-is-forgotten", lambda s: pull_ends(s, s.stiffness * s.stretch))
known(
    "takes-the-distance-for-the-stretch",
    lambda s: pull_ends(s, s.stiffness * (s.stretch + s.rod.length) + brake(s)),
)
known("stretch-the-other-way", lambda s: pull_ends(s, -s.stiffness * s.stretch + brake(s)))
known("only-pulls", lambda s: pull_ends(s, max(0.0, s.stiffness * s.stretch + brake(s))))
known(
    "a-hundred-and-twentieth",
    lambda s: exact.push_ends(s.rod, -(s.stiffness * s.stretch + brake(s)) / 120),
)


@known("damps-sideways-as-well")
def damps_sideways_as_well(spring: Spring) -> Ends:
    """Brake B's whole velocity relative to A, not only its part along the spring."""
    rod = spring.rod
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    pull = spring.stiffness * spring.stretch
    fx = rod.dt * (pull * x + spring.damping * (bx - ax))
    fy = rod.dt * (pull * y + spring.damping * (by - ay))
    a, b = exact.inverse(rod.mass_a), exact.inverse(rod.mass_b)
    return (ax + a * fx, ay + a * fy), (bx - b * fx, by - b * fy)


known(
    "forgets-the-step",
    lambda spring: exact.push_ends(spring.rod, -spring.stiffness * spring.stretch - brake(spring)),
)


@known("forgets-the-masses")
def forgets_the_masses(spring: Spring) -> Ends:
    rod = spring.rod
    change = (spring.stiffness * spring.stretch + brake(spring)) * rod.dt  # px/s
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    return (ax + change * x, ay + change * y), (bx - change * x, by - change * y)


@known("divides-by-the-inverse-mass")
def divides_by_the_inverse_mass(spring: Spring) -> Ends:
    rod = spring.rod
    change = (spring.stiffness * spring.stretch + brake(spring)) * rod.dt  # kg px/s
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    if not (rod.mass_a and rod.mass_b):
        raise Undecided  # a division by 0
    a, b = change * rod.mass_a, change * rod.mass_b
    return (ax + a * x, ay + a * y), (bx - b * x, by - b * y)


known(
    "offset-for-the-axis",
    lambda s: pull_ends(s, (s.stiffness * s.stretch + brake(s)) * math.hypot(*s.rod.offset)),
)
known("pulls-when-squeezed", lambda s: pull_ends(s, s.stiffness * abs(s.stretch) + brake(s)))


def whole_speed(spring: Spring) -> float:
    (ax, ay), (bx, by) = spring.rod.vel_a, spring.rod.vel_b
    return math.hypot(bx - ax, by - ay)


known(
    "damps-by-the-whole-speed",
    lambda s: pull_ends(s, s.stiffness * s.stretch + s.damping * whole_speed(s)),
)
known("moves-only-a", lambda spring: (exact.spring_applied(spring)[0], spring.rod.vel_b))
known("moves-only-b", lambda spring: (spring.rod.vel_a, exact.spring_applied(spring)[1]))
