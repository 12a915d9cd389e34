"""TODO 3: DistanceJoint.solve, the rod between two bodies."""

import math

from hypothesis import given
from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.exact import Rod
from grader.checks.strategies import rods
from grader.judge.lab import STEP, Broke, Lab, Pair, Thing
from grader.protocol import BodyValue

STILL, SLOW, FAST = (0.0, 0.0), (20.0, -10.0), (100.0, 60.0)  # px/s


def joined(lab: Lab, rod: Rod) -> tuple[Thing, Thing, Thing]:
    """The joint, its A and its B, ready to be solved."""
    a = lab.circle(STILL, 10.0, rod.mass_a, vel=rod.vel_a)
    b = lab.circle((rod.length, 0.0), 10.0, rod.mass_b)
    joint = lab.thing(lab.call("DistanceJoint", a, b), "a DistanceJoint")
    lab.put(b, pos=rod.offset, vel=rod.vel_b)
    lab.tell(joint, "prepare", rod.dt)
    return joint, a, b


def solve(lab: Lab, rod: Rod, passes: int = 1) -> tuple[BodyValue, BodyValue]:
    """A and B after some passes over the rod."""
    lab.ran(
        f"{passes} x solve on a rod {rod.length:g} px long at 1/{round(1 / rod.dt)} s: "
        f"A {weight(rod.mass_a)}, {rod.vel_a} px/s; B {weight(rod.mass_b)}, {rod.vel_b} px/s, "
        f"{rod.offset} px from A"
    )
    joint, a, b = joined(lab, rod)
    tell_solve(lab, joint, rod, passes)
    ends = lab.state(a), lab.state(b)
    offset = ends[1].pos.x - ends[0].pos.x, ends[1].pos.y - ends[0].pos.y
    if passes == 1:
        lab.saw("rod", (rod,), (*velocities(ends), offset))
    return ends


def tell_solve(lab: Lab, joint: Thing, rod: Rod, passes: int = 1) -> None:
    """Solve some passes; an exception is an answer, too."""
    for _ in range(passes):
        try:
            lab.tell(joint, "solve")
        except Broke as failure:
            if failure.raised is not None:
                lab.saw("rod", (rod,), failure.raised.error)
            raise


def weight(mass: float) -> str:
    return f"{mass:g} kg" if mass else "static"


def velocities(ends: tuple[BodyValue, BodyValue]) -> tuple[Pair, Pair]:
    (ax, ay), (bx, by) = (end.vel for end in ends)
    return (ax, ay), (bx, by)


def say(vel_a: Pair, vel_b: Pair) -> str:
    return f"A ({vel_a[0]:.3f}, {vel_a[1]:.3f}), B ({vel_b[0]:.3f}, {vel_b[1]:.3f}) px/s"


def want_exact(lab: Lab, rod: Rod) -> tuple[BodyValue, BodyValue]:
    ends = solve(lab, rod)
    answer, right = velocities(ends), exact.rod_solved(rod)
    lab.want(
        all(math.dist(*each) <= rounding(rod) for each in zip(answer, right, strict=True)),
        say(*right),
        say(*answer),
    )
    return ends


def rounding(rod: Rod) -> float:
    """How far off a speed may be, px/s."""
    return 1e-9 * (1.0 + abs(rod.bias) + math.hypot(*rod.vel_a) + math.hypot(*rod.vel_b))


def a_stretched_rod_pulls_its_ends_together(lab: Lab) -> None:
    """A stretched rod pulls its ends together"""
    want_exact(lab, Rod(3.0, 1.0, 50.0, (60.0, 0.0), STILL, STILL, STEP))
    want_exact(lab, Rod(1.0, 4.0, 80.0, (-60.0, 80.0), SLOW, FAST, STEP))


def a_squeezed_rod_pushes_its_ends_apart(lab: Lab) -> None:
    """A squeezed rod pushes its ends apart"""
    want_exact(lab, Rod(3.0, 1.0, 50.0, (40.0, 0.0), STILL, STILL, STEP))
    want_exact(lab, Rod(1.0, 4.0, 120.0, (60.0, -80.0), SLOW, FAST, STEP))


def a_rod_of_the_right_length_stops_only_the_speed_along_it(lab: Lab) -> None:
    """A rod of the right length stops the speed along it and no other"""
    for vel_a, vel_b in ((SLOW, FAST), (FAST, SLOW)):
        want_exact(lab, Rod(3.0, 1.0, 50.0, (30.0, 40.0), vel_a, vel_b, STEP))


@given(rod=rods, passes=st.integers(1, 3))
def any_rod_reaches_its_speed_and_keeps_the_momentum(lab: Lab, rod: Rod, passes: int) -> None:
    """Any rod reaches its speed in one pass, and keeps the momentum"""
    vel_a, vel_b = velocities(solve(lab, rod, passes))
    after = rod._replace(vel_a=vel_a, vel_b=vel_b)
    lab.want(
        math.dist(after.momentum, rod.momentum) <= rounding(rod) * (rod.mass_a + rod.mass_b),
        "a momentum of ({:.3f}, {:.3f}) kg px/s, as before".format(*rod.momentum),
        "({:.3f}, {:.3f}) kg px/s".format(*after.momentum),
    )
    lab.want(
        abs(after.speed - rod.bias) <= rounding(rod),
        f"B leaves A at bias, {rod.bias:.3f} px/s along the rod, after any number of passes",
        f"{after.speed:.3f} px/s",
    )


@given(rod=rods, first=st.booleans())
def a_static_end_never_moves(lab: Lab, rod: Rod, first: bool) -> None:
    """A static end never moves; the other end does it all"""
    on_a, on_b = rod._replace(mass_a=0.0, vel_a=STILL), rod._replace(mass_b=0.0, vel_b=STILL)
    a, b = want_exact(lab, on_a if first else on_b)
    end, place = (a, STILL) if first else (b, rod.offset)
    lab.want(
        (*end.pos, *end.vel, end.angle, end.omega) == (*place, 0.0, 0.0, 0.0, 0.0),
        f"the static end exactly at {place}, at rest",
        f"at ({end.pos.x!r}, {end.pos.y!r}), speed ({end.vel.x!r}, {end.vel.y!r}) px/s",
    )


def nothing_happens_where_no_end_can_move(lab: Lab) -> None:
    """Where neither end can move, k is 0 and nothing happens"""
    lab.ran("solve on a stretched rod after inv_mass and inv_inertia of both ends were set to 0")
    rod = Rod(3.0, 1.0, 50.0, (60.0, 0.0), (5.0, 0.0), (0.0, 7.0), STEP)
    joint, a, b = joined(lab, rod)
    for end in (a, b):
        lab.put(end, inv_mass=0.0, inv_inertia=0.0)
    lab.tell(joint, "prepare", STEP)
    tell_solve(lab, joint, rod._replace(mass_a=0.0, mass_b=0.0))
    left = velocities((lab.state(a), lab.state(b)))
    lab.want(left == ((5.0, 0.0), (0.0, 7.0)), say((5.0, 0.0), (0.0, 7.0)), say(*left))


def step(lab: Lab, joint: Thing, bodies: list[Thing], gravity: float = 0.0) -> list[Pair]:
    """One step of bodies on a rod, all but the rod by hand; returns where they are then."""
    lab.tell(joint, "prepare", STEP)
    lab.tell(joint, "solve")
    places = []
    for body in bodies:
        state = lab.state(body)
        (x, y), (vx, vy) = state.pos, state.vel
        places.append((x + STEP * vx, y + STEP * vy))
        lab.put(body, pos=places[-1], vel=(vx, vy + STEP * gravity))
    return places


def want_length(lab: Lab, lengths: list[float], right: float) -> None:
    """Within 1 px in every step.

    A step at speed v along the circle stretches a rod by v² dt² / 2L, and the bias takes back a
    share of 0.2: it settles at v² dt² / 0.4L, here below 0.62 px for the fastest bob.
    """
    lab.want(
        max(abs(length - right) for length in lengths) < 1.0,
        f"its length within 1 px of {right:g} px in every step",
        f"from {min(lengths):.2f} to {max(lengths):.2f} px",
    )


def a_pendulum_that_starts_above_keeps_its_length(lab: Lab) -> None:
    """A pendulum let go above its anchor keeps its length"""
    lab.ran("a bob let go 112 px above and 84 px beside its anchor, for one second")
    anchor = lab.circle(STILL, 6.0, 0.0)
    bob = lab.circle((84.0, -112.0), 24.0, 6.0)
    joint = lab.thing(lab.call("DistanceJoint", anchor, bob), "a DistanceJoint")
    places = [step(lab, joint, [bob], gravity=980.0)[0] for _ in range(120)]
    want_length(lab, [math.hypot(*place) for place in places], 140.0)


def a_thrown_dumbbell_turns_about_its_centre_of_mass(lab: Lab) -> None:
    """Two balls on a rod turn about their centre of mass"""
    lab.ran("balls of 3 and 1 kg on a rod of 100 px, thrown to spin in place, for half a second")
    heavy = lab.circle((0.0, 0.0), 10.0, 3.0, vel=(0.0, -100.0))
    light = lab.circle((100.0, 0.0), 10.0, 1.0, vel=(0.0, 300.0))
    joint = lab.thing(lab.call("DistanceJoint", heavy, light), "a DistanceJoint")
    places = [step(lab, joint, [heavy, light]) for _ in range(60)]
    want_length(lab, [math.dist(a, b) for a, b in places], 100.0)
    (ax, ay), (bx, by) = places[-1]
    centre = (3 * ax + bx) / 4, (3 * ay + by) / 4
    # The momentum is 0 and stays so; a step adds rounding only.
    lab.want(
        math.dist(centre, (25.0, 0.0)) <= 1e-6,
        "the centre of mass still at (25, 0)",
        f"it is at ({centre[0]:.3f}, {centre[1]:.3f})",
    )
