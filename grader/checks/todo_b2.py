"""TODO B2: SpringJoint.apply, a spring's force on the two bodies at its ends."""

import math
from itertools import pairwise

from grader.checks import exact
from grader.checks.exact import Rod, Spring
from grader.checks.todo_3 import FAST, SLOW, STILL, say, velocities, weight
from grader.judge.lab import STEP, Lab, Moment


def want_exact(lab: Lab, spring: Spring) -> None:
    """Apply a spring once; both ends must have the right velocities."""
    rod = spring.rod
    lab.ran(
        f"apply for 1/{round(1 / rod.dt)} s: stiffness {spring.stiffness:g} kg/s², damping "
        f"{spring.damping:g} kg/s, length {rod.length:g} px; A {weight(rod.mass_a)}, {rod.vel_a} "
        f"px/s; B {weight(rod.mass_b)}, {rod.vel_b} px/s, {rod.offset} px from A"
    )
    a = lab.circle(STILL, 10.0, rod.mass_a, vel=rod.vel_a)
    b = lab.circle(rod.offset, 10.0, rod.mass_b, vel=rod.vel_b)
    made = lab.call("SpringJoint", a, b, spring.stiffness, spring.damping, rod.length)
    lab.tell(lab.thing(made, "a SpringJoint"), "apply", rod.dt)
    answer = velocities((lab.state(a), lab.state(b)))
    lab.saw("spring", (spring,), answer)
    right = exact.spring_applied(spring)
    # Sums of a few numbers below 1000 px/s, each rounded by a share of 1e-16.
    lab.want(
        all(math.dist(*each) <= 1e-9 for each in zip(answer, right, strict=True)),
        say(*right),
        say(*answer),
    )


def a_stretched_spring_pulls_and_a_squeezed_one_pushes(lab: Lab) -> None:
    """A stretched spring pulls, a squeezed one pushes, each end by its mass"""
    for length in (50.0, 140.0):
        want_exact(lab, Spring(Rod(3.0, 1.0, length, (60.0, 80.0), STILL, STILL, STEP), 120.0, 0.0))
    want_exact(lab, Spring(Rod(0.0, 2.0, 80.0, (-60.0, 0.0), STILL, FAST, 2 * STEP), 90.0, 0.0))
    want_exact(lab, Spring(Rod(2.0, 0.0, 30.0, (0.0, -50.0), SLOW, STILL, STEP), 90.0, 0.0))


def damping_brakes_the_speed_along_the_spring(lab: Lab) -> None:
    """Damping brakes the speed along the spring, and no other"""
    for vel_a, vel_b in ((SLOW, FAST), (FAST, SLOW), (SLOW, SLOW)):
        want_exact(lab, Spring(Rod(3.0, 1.0, 50.0, (30.0, 40.0), vel_a, vel_b, STEP), 0.0, 12.0))
    want_exact(lab, Spring(Rod(1.0, 4.0, 80.0, (60.0, -80.0), FAST, SLOW, STEP), 120.0, 12.0))


def a_mass_on_a_spring_swings_and_fades_as_it_must(lab: Lab) -> None:
    """A mass on a spring swings and fades by the closed form"""
    stiffness, damping, mass, seconds = 800.0, 4.0, 2.0, 1.5
    rate, fading = math.sqrt(stiffness / mass), damping / (2 * mass)  # 1/s
    lab.ran(f"{mass:g} kg on a spring of {stiffness:g} kg/s² and {damping:g} kg/s, for {seconds} s")
    hook, bob = lab.circle(STILL, 5.0, 0.0), lab.circle((130.0, 0.0), 10.0, mass)
    made = lab.call("SpringJoint", hook, bob, stiffness, damping, 100.0)
    world = lab.world(hook, bob, bonus=True)
    lab.tell(world, "springs.append", lab.thing(made, "a SpringJoint"))
    swing = lab.simulate(world, [bob], round(seconds / STEP)).body(0)
    crossings = [time + when for time, when in zero_crossings([each.x - 100.0 for each in swing])]
    period = 2 * math.pi / math.sqrt(rate**2 - fading**2)  # s
    swings = (len(crossings) - 1) / 2
    found = (crossings[-1] - crossings[0]) * STEP / swings if swings > 0 else math.inf
    # At 20 swings of 1/s and steps of 1/120 s the period is off by (rate * STEP)² / 24, or 0.1 %.
    lab.want(
        abs(found / period - 1) < 0.01,
        f"a period of {period:.4f} s, as 2 pi / sqrt(stiffness / mass - (damping / 2 mass)²)",
        f"{found:.4f} s" if swings > 0 else "no swing",
    )
    left = amplitude(swing[-round(period / STEP) :]) / amplitude(swing[: round(period / STEP)])
    right = math.exp(-fading * (seconds - period))
    lab.want(
        abs(left / right - 1) < 0.05,
        f"{right:.1%} of its swing left, as exp(-damping / 2 mass · t)",
        f"{left:.1%}",
    )


def zero_crossings(values: list[float]) -> list[tuple[int, float]]:
    """Where the values change sign: a step, and the share of the way to the next."""
    return [
        (step, a / (a - b)) for step, (a, b) in enumerate(pairwise(values)) if (a < 0) != (b < 0)
    ]


def amplitude(swing: list[Moment]) -> float:
    return max(abs(each.x - 100.0) for each in swing)
