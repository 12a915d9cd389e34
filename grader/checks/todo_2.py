"""TODO 2: the spin terms in effective_mass."""

import math

from hypothesis import given
from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.exact import Lever, cross
from grader.checks.strategies import levers, spins, static_levers, units, velocities
from grader.judge.lab import Lab, Pair, Thing
from grader.protocol import BodyValue

FLOOR = Lever(0.0, 100.0, 30.0, -100.0)
DOWN = (0.0, 1.0)
ALONG_THE_FLOOR = (1.0, 0.0)
DIAGONAL = (0.6, 0.8)


def disc(lab: Lab, lever: Lever) -> Thing:
    return lab.circle((0.0, 0.0), lever.radius, lever.mass)


def say(lever: Lever) -> str:
    weight = f"{lever.mass:g} kg" if lever.mass else "static"
    return f"{weight}, r {lever.radius:g}, arm ({lever.rx:g}, {lever.ry:g})"


def effective_mass(lab: Lab, a: Lever, b: Lever, axis: Pair) -> float:
    """What the submission's effective_mass says of two discs."""
    lab.ran(f"effective_mass along {axis}: A {say(a)}; B {say(b)}")
    value = lab.call("effective_mass", disc(lab, a), disc(lab, b), (a.rx, a.ry), (b.rx, b.ry), axis)
    answer = lab.number(value, "what effective_mass returns")
    lab.saw("effective_mass", (a, b, axis), answer)
    return answer


def want_exact(lab: Lab, a: Lever, b: Lever, axis: Pair) -> None:
    answer, right = effective_mass(lab, a, b, axis), exact.effective_mass(a, b, axis)
    lab.want(math.isclose(answer, right, rel_tol=1e-9), f"{right:.6g} per kg", f"{answer:.6g}")


def the_first_body_adds_its_spin_term(lab: Lab) -> None:
    """The first body adds (ra x axis)²/I_a, a static second body nothing"""
    want_exact(lab, Lever(2.0, 10.0, 10.0, 0.0), FLOOR, DOWN)
    want_exact(lab, Lever(0.5, 20.0, -6.0, 17.0), FLOOR, DOWN)
    want_exact(lab, Lever(4.0, 15.0, 8.0, 12.0), FLOOR, DIAGONAL)


def the_second_body_adds_its_spin_term(lab: Lab) -> None:
    """The second body adds (rb x axis)²/I_b, a static first body nothing"""
    want_exact(lab, FLOOR, Lever(2.0, 10.0, 10.0, 0.0), DOWN)
    want_exact(lab, FLOOR, Lever(0.5, 20.0, -6.0, 17.0), DOWN)
    want_exact(lab, FLOOR, Lever(4.0, 15.0, 8.0, 12.0), DIAGONAL)


def only_the_part_of_an_arm_across_the_axis_counts(lab: Lab) -> None:
    """An arm along the axis adds nothing, and one across it the most"""
    other = Lever(3.0, 25.0, 15.0, 20.0)
    for arm in ((12.0, 16.0), (16.0, -12.0), (0.0, 20.0)):  # along, across, in between
        want_exact(lab, Lever(2.0, 20.0, *arm), other, DIAGONAL)


@given(a=levers, b=levers | static_levers, axis=units, swap=st.booleans())
def any_two_bodies_agree_with_the_formula(
    lab: Lab, a: Lever, b: Lever, axis: Pair, swap: bool
) -> None:
    """Any two bodies: the four terms add up, whichever body is A"""
    want_exact(lab, *((b, a) if swap else (a, b)), axis)


def point_speed(body: BodyValue, lever: Lever, axis: Pair) -> float:
    """The speed along the axis of the point at the end of the arm, px/s."""
    turning = body.omega * cross((lever.rx, lever.ry), axis)
    return body.vel.x * axis[0] + body.vel.y * axis[1] + turning


def energy(body: BodyValue, lever: Lever) -> float:
    """Kinetic energy, kg px²/s²."""
    return 0.5 * (lever.mass * math.hypot(*body.vel) ** 2 + lever.inertia * body.omega**2)


@given(a=levers, b=levers | static_levers, axis=units, vel=velocities, omega=spins)
def the_impulse_that_ends_a_speed_is_speed_over_k(
    lab: Lab, a: Lever, b: Lever, axis: Pair, vel: Pair, omega: float
) -> None:
    """An impulse of -speed / k ends the speed and creates no energy"""
    k = effective_mass(lab, a, b, axis)
    lab.want(k > 0, "more than 0 per kg", f"{k:.6g}")
    lab.ran(f"an impulse of -speed / k along {axis}: A {say(a)}, {vel} px/s, {omega:g} rad/s")
    first, second = disc(lab, a), disc(lab, b)
    lab.put(first, vel=vel, omega=omega)
    moving = lab.state(first)
    speed = -point_speed(moving, a, axis)  # of B away from A, which moves alone
    impulse = -speed / k * axis[0], -speed / k * axis[1]
    lab.call("apply_impulse", first, second, impulse, (a.rx, a.ry), (b.rx, b.ry))
    after_a, after_b = lab.state(first), lab.state(second)
    left = point_speed(after_b, b, axis) - point_speed(after_a, a, axis)
    lab.want(
        abs(left) <= 1e-9 * max(1.0, abs(speed)),
        f"none of the {speed:.4g} px/s left with which the points part or close",
        f"{left:.4g} px/s left",
    )
    had, has = energy(moving, a), energy(after_a, a) + energy(after_b, b)
    lab.want(has <= had * (1 + 1e-9), f"no more energy than before: {had:.6g}", f"{has:.6g}")


def a_sliding_ball_comes_to_roll(lab: Lab) -> None:
    """A ball set sliding comes to roll without slipping"""
    for radius in (5.0, 15.0, 40.0):
        ball = Lever(2.0, radius, 0.0, radius)
        k = effective_mass(lab, FLOOR, ball, ALONG_THE_FLOOR)
        lab.want(k > 0, "more than 0 per kg", f"{k:.6g}")
        lab.ran(
            f"a ball r {radius:g} slid at 300 px/s: pushes of -slip / k, at most 7 kg px/s each"
        )
        last, slips = slide(lab, ball, k)
        # A push of 7 takes 3.5 px/s off its speed and brings its lowest point 10.5 px/s nearer to
        # rest, so that 29 pushes do. A third of the speed is spent on the spin.
        worst = max(map(abs, slips[30:]))
        lab.want(
            worst <= 1e-6 and math.isclose(last, 200.0, rel_tol=1e-9),
            "after 30 pushes it rolls at 200 px/s and does not slip",
            f"{last:.2f} px/s at the end, slipping at up to {worst:.4g} px/s",
        )


def slide(lab: Lab, ball: Lever, k: float) -> tuple[float, list[float]]:
    """The ball's speed after 40 pushes by the floor, and the slip after each."""
    floor, moving = disc(lab, FLOOR), disc(lab, ball)
    lab.put(moving, vel=(300.0, 0.0))
    speed, slips = 300.0, [300.0]
    for _ in range(40):
        needed = -slips[-1] / k
        push = math.copysign(min(abs(needed), 7.0), needed), 0.0
        lab.call("apply_impulse", floor, moving, push, (FLOOR.rx, FLOOR.ry), (ball.rx, ball.ry))
        state = lab.state(moving)
        speed = state.vel.x
        slips.append(speed - state.omega * ball.radius)
    return speed, slips
