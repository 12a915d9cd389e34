"""Known mistakes in TODO B2, as models of what one step of a spring does to its ends."""

import math

from grader.checks import exact
from grader.checks.exact import Pair, Spring
from grader.checks.mistakes import Models, register
from grader.judge.explain.misconceptions import Kind, Undecided, kinds

Ends = tuple[Pair, Pair]  # velocities of A and B, px/s

kinds["spring"] = Kind(exact.apply_spring)


def pull_ends(spring: Spring, force: float) -> Ends:
    """Return the velocities after a step of a force that draws the ends together, kg px/s²."""
    return exact.push_ends(spring.rod, -force * spring.rod.dt)


def hold(spring: Spring) -> float:
    return spring.stiffness * spring.stretch


def brake(spring: Spring) -> float:
    return spring.damping * spring.rod.speed


def whole_speed(spring: Spring) -> float:
    (ax, ay), (bx, by) = spring.rod.vel_a, spring.rod.vel_b
    return math.hypot(bx - ax, by - ay)


def draw_together(spring: Spring, a: float, b: float) -> Ends:
    """Return the velocities after these changes along the spring, px/s."""
    (ax, ay), (bx, by), (x, y) = spring.rod.vel_a, spring.rod.vel_b, spring.rod.axis
    return (ax + a * x, ay + a * y), (bx - b * x, by - b * y)


def damp_sideways_as_well(spring: Spring) -> Ends:
    """Brake B's whole velocity relative to A, not only its part along the spring."""
    rod = spring.rod
    (ax, ay), (bx, by), (x, y) = rod.vel_a, rod.vel_b, rod.axis
    fx = rod.dt * (hold(spring) * x + spring.damping * (bx - ax))
    fy = rod.dt * (hold(spring) * y + spring.damping * (by - ay))
    a, b = exact.inverse(rod.mass_a), exact.inverse(rod.mass_b)
    return (ax + a * fx, ay + a * fy), (bx - b * fx, by - b * fy)


def forget_masses(spring: Spring) -> Ends:
    change = (hold(spring) + brake(spring)) * spring.rod.dt
    return draw_together(spring, change, change)


def divide_by_inverse(spring: Spring) -> Ends:
    rod = spring.rod
    if not (rod.mass_a and rod.mass_b):
        raise Undecided  # a division by 0
    change = (hold(spring) + brake(spring)) * rod.dt
    return draw_together(spring, change * rod.mass_a, change * rod.mass_b)


MODELS: Models = (
    ("pushes-when-stretched", lambda s: pull_ends(s, -hold(s) - brake(s))),
    ("damping-drives", lambda s: pull_ends(s, hold(s) - brake(s))),
    ("damping-is-forgotten", lambda s: pull_ends(s, hold(s))),
    (
        "takes-the-distance-for-the-stretch",
        lambda s: pull_ends(s, s.stiffness * (s.stretch + s.rod.length) + brake(s)),
    ),
    ("stretch-the-other-way", lambda s: pull_ends(s, -hold(s) + brake(s))),
    ("only-pulls", lambda s: pull_ends(s, max(0.0, hold(s) + brake(s)))),
    ("a-hundred-and-twentieth", lambda s: exact.push_ends(s.rod, -(hold(s) + brake(s)) / 120)),
    ("damps-sideways-as-well", damp_sideways_as_well),
    ("forgets-the-step", lambda s: exact.push_ends(s.rod, -hold(s) - brake(s))),
    ("forgets-the-masses", forget_masses),
    ("divides-by-the-inverse-mass", divide_by_inverse),
    (
        "offset-for-the-axis",
        lambda s: pull_ends(s, (hold(s) + brake(s)) * math.hypot(*s.rod.offset)),
    ),
    ("pulls-when-squeezed", lambda s: pull_ends(s, s.stiffness * abs(s.stretch) + brake(s))),
    ("damps-by-the-whole-speed", lambda s: pull_ends(s, hold(s) + s.damping * whole_speed(s))),
    ("moves-only-a", lambda s: (exact.apply_spring(s)[0], s.rod.vel_b)),
    ("moves-only-b", lambda s: (s.rod.vel_a, exact.apply_spring(s)[1])),
)
register("B2", "spring", MODELS)
