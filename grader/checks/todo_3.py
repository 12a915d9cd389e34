"""TODO 3: DistanceJoint.solve, the rod between two bodies."""

import math

from hypothesis import given
from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.exact import Rod
from grader.checks.strategies import pairs, rods
from grader.judge.lab import STEP, Lab, Pair, Run, Thing

STILL = (0.0, 0.0)
Ends = tuple[Pair, Pair]


def joined(lab: Lab, rod: Rod) -> tuple[Thing, Thing, Thing]:
    """The joint, its A and its B, ready to be solved."""
    a = lab.circle(STILL, 10.0, rod.mass_a, vel=rod.vel_a)
    b = lab.circle((rod.length, 0.0), 10.0, rod.mass_b)
    joint = lab.thing(lab.call("DistanceJoint", a, b), "a DistanceJoint")
    lab.put(b, pos=rod.offset, vel=rod.vel_b)
    lab.tell(joint, "prepare", rod.dt)
    return joint, a, b


def solve(lab: Lab, rod: Rod, passes: int = 1) -> Ends:
    """The velocities of A and B after some passes over the rod."""
    lab.ran(
        f"{passes} solve of a rod {rod.length:g} px long, B ({rod.offset[0]:g}, {rod.offset[1]:g}) "
        f"px from A, masses {rod.mass_a:g} and {rod.mass_b:g} kg, velocities {rod.vel_a} and "
        f"{rod.vel_b}, dt 1/{round(1 / rod.dt)} s"
    )
    joint, a, b = joined(lab, rod)
    for _ in range(passes):
        lab.tell(joint, "solve")
    ends = lab.pair(lab.get(a, "vel"), "vel"), lab.pair(lab.get(b, "vel"), "vel")
    if passes == 1:
        lab.saw("rod", rod, ends)
    return ends


def say(ends: Ends) -> str:
    return " and ".join(f"({x:.4f}, {y:.4f})" for x, y in ends) + " px/s"


def want_exact(lab: Lab, rod: Rod, passes: int = 1) -> None:
    """One pass settles a single rod: another one has nothing left to do."""
    ends, right = solve(lab, rod, passes), exact.rod_solved(rod)
    size = max(map(abs, (1.0, rod.bias, *rod.vel_a, *rod.vel_b)))
    lab.want(
        all(math.dist(*each) <= 1e-9 * size for each in zip(ends, right, strict=True)),
        f"A and B at {say(right)}",
        say(ends),
    )


def a_stretched_rod_pulls_its_ends_together(lab: Lab) -> None:
    """A stretched rod pulls its ends together"""
    want_exact(lab, Rod(3.0, 1.0, 50.0, (60.0, 0.0), STILL, STILL, STEP))
    want_exact(lab, Rod(1.0, 4.0, 80.0, (-60.0, 80.0), STILL, STILL, STEP))


def a_squeezed_rod_pushes_its_ends_apart(lab: Lab) -> None:
    """A squeezed rod pushes its ends apart"""
    want_exact(lab, Rod(3.0, 1.0, 50.0, (40.0, 0.0), STILL, STILL, STEP))
    want_exact(lab, Rod(1.0, 4.0, 120.0, (60.0, -80.0), STILL, STILL, STEP))


def a_rod_of_the_right_length_stops_only_the_speed_along_it(lab: Lab) -> None:
    """A rod of the right length stops the speed along it and no other"""
    parting = Rod(3.0, 1.0, 50.0, (30.0, 40.0), (20.0, -10.0), (100.0, 60.0), STEP)
    for rod in (parting, parting._replace(vel_a=(100.0, 60.0), vel_b=(20.0, -10.0))):
        want_exact(lab, rod)


@given(rod=rods, passes=st.sampled_from([1, 4]))
def any_rod_reaches_its_speed_and_keeps_the_momentum(lab: Lab, rod: Rod, passes: int) -> None:
    """Any rod: equal and opposite impulses, and later passes change nothing"""
    a, b = solve(lab, rod, passes)
    for axis, name in ((0, "x"), (1, "y")):
        had, has = (
            rod.mass_a * vel_a[axis] + rod.mass_b * vel_b[axis]
            for vel_a, vel_b in ((rod.vel_a, rod.vel_b), (a, b))
        )
        size = (rod.mass_a + rod.mass_b) * max(1.0, abs(rod.bias), math.dist(rod.vel_a, rod.vel_b))
        lab.want(
            abs(has - had) <= 1e-9 * max(size, abs(had)),
            f"the momentum kept: {had:.4f} kg px/s along {name}",
            f"{has:.4f} kg px/s",
        )
    want_exact(lab, rod, passes)
