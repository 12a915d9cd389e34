"""TODO 5: damping by a rate per second."""

import math

from hypothesis import given
from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.strategies import rates, speeds, spins, step_sizes
from grader.judge.lab import Lab, Moment

SPEED, SPIN = 300.0, 12.0  # px/s, rad/s


def damp(lab: Lab, linear: float, angular: float, dt: float, steps: int) -> tuple[float, float]:
    """The shares of speed and spin that one ball has left after some steps."""
    ball = lab.circle((0.0, 0.0), vel=(SPEED, 0.0), omega=SPIN)
    world = lab.world(ball, linear_damping=linear, angular_damping=angular)
    last = lab.simulate(world, [ball], steps, dt, every=steps).body(0)[-1]
    shares = last.vx / SPEED, last.omega / SPIN
    lab.saw("damping", (linear, angular, dt, steps), shares)
    return shares


def say(share: float) -> str:
    return f"{100 * share:.2f}%"


def one_second_keeps_the_same_share_at_every_step_size(lab: Lab) -> None:
    """Damping per second, whatever the step"""
    lab.ran("one ball, no gravity, linear_damping = 0.5, for one second")
    rates_per_second = (60, 120, 240)
    kept = {n: damp(lab, 0.5, 0.5, 1 / n, n)[0] for n in rates_per_second}
    right = exact.damped(0.5, 1.0)
    lab.want(
        all(math.isclose(share, right, rel_tol=1e-9) for share in kept.values()),
        f"{say(right)} of its speed left at every step size (e^-0.5)",
        ", ".join(f"{say(share)} at 1/{n} s" for n, share in kept.items()),
    )


def speed_and_spin_have_a_rate_of_their_own(lab: Lab) -> None:
    """Speed and spin are damped by a rate of their own"""
    for linear, angular in ((1.0, 0.25), (0.0, 2.0), (2.0, 0.0)):
        lab.ran(f"linear_damping = {linear:g}, angular_damping = {angular:g}, half a second")
        speed, spin = damp(lab, linear, angular, 1 / 120, 60)
        right = exact.damped(linear, 0.5), exact.damped(angular, 0.5)
        lab.want(
            math.isclose(speed, right[0], rel_tol=1e-9)
            and math.isclose(spin, right[1], rel_tol=1e-9),
            f"{say(right[0])} of the speed and {say(right[1])} of the spin left",
            f"{say(speed)} and {say(spin)}",
        )


@given(linear=rates, angular=rates, dt=step_sizes, parts=st.integers(2, 8))
def one_long_step_or_many_short_ones_damp_alike(
    lab: Lab, linear: float, angular: float, dt: float, parts: int
) -> None:
    """One long step and many short ones damp alike"""
    lab.ran(
        f"linear_damping = {linear:g}, angular_damping = {angular:g}: "
        f"one step of 1/{round(1 / dt)} s, and the same time in {parts} steps"
    )
    once, often = damp(lab, linear, angular, dt, 1), damp(lab, linear, angular, dt / parts, parts)
    right = exact.damped(linear, dt), exact.damped(angular, dt)
    lab.want(
        all(
            math.isclose(share, wanted, rel_tol=1e-9)
            for shares in (once, often)
            for share, wanted in zip(shares, right, strict=True)
        ),
        f"{say(right[0])} of the speed, {say(right[1])} of the spin, both times",
        f"{say(once[0])} and {say(once[1])} in one step, "
        f"{say(often[0])} and {say(often[1])} in many",
    )


@given(vx=speeds, vy=speeds, omega=spins, rate=rates, dt=step_sizes)
def damping_keeps_the_direction_and_leaves_statics_alone(
    lab: Lab, vx: float, vy: float, omega: float, rate: float, dt: float
) -> None:
    """Damping keeps the direction, and static bodies never move"""
    lab.ran(f"a ball at ({vx:g}, {vy:g}) px/s beside a static box, rate {rate:g}, one step")
    ball = lab.circle((0.0, 0.0), vel=(vx, vy), omega=omega)
    box = lab.box((500.0, 500.0), (20.0, 20.0))
    world = lab.world(ball, box, linear_damping=rate, angular_damping=rate)
    run = lab.simulate(world, [ball, box], 1, dt)
    moved, still = run.body(0)[-1], run.body(1)[-1]
    keep = exact.damped(rate, dt)
    lab.want(
        math.isclose(moved.vx, keep * vx, rel_tol=1e-9, abs_tol=1e-9)
        and math.isclose(moved.vy, keep * vy, rel_tol=1e-9, abs_tol=1e-9)
        and math.isclose(moved.omega, keep * omega, rel_tol=1e-9, abs_tol=1e-9),
        f"speed ({keep * vx:.4f}, {keep * vy:.4f}) px/s and spin {keep * omega:.4f} rad/s",
        f"speed ({moved.vx:.4f}, {moved.vy:.4f}) px/s and spin {moved.omega:.4f} rad/s",
    )
    lab.want(
        still == Moment(500.0, 500.0, 0.0, 0.0, 0.0, 0.0),
        "the static box exactly where it was, at rest",
        f"the box at ({still.x!r}, {still.y!r}), speed ({still.vx!r}, {still.vy!r})",
    )


def no_damping_loses_nothing(lab: Lab) -> None:
    """A rate of 0 loses nothing"""
    lab.ran("one ball, both dampings 0, for one second")
    speed, spin = damp(lab, 0.0, 0.0, 1 / 120, 120)
    left = f"{say(speed)} and {say(spin)}"
    lab.want(speed == 1.0 and spin == 1.0, "all of its speed and spin", left)
    # A world may leave damping out where both rates are 0: one at a time is asked of the student.
    lab.ran("one ball, angular_damping = 0.5 and the other 0, for one second")
    speed, _ = damp(lab, 0.0, 0.5, 1 / 120, 120)
    lab.want(speed == 1.0, "all of its speed", say(speed))
    lab.ran("one ball, linear_damping = 0.5 and the other 0, for one second")
    _, spin = damp(lab, 0.5, 0.0, 1 / 120, 120)
    lab.want(spin == 1.0, "all of its spin", say(spin))
