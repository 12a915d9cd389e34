"""TODO 5: damping by a rate per second."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import astuple

from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.strategies import any_speeds, damped_steps, pulls, rates, wide_velocities
from grader.checks.telling import decimals_to_tell
from grader.judge.drawing import given
from grader.judge.lab import Lab, Moment, Pair, Thing
from grader.protocol import BodyValue

SPEED, SPIN = 300.0, 12.0  # px/s, rad/s
SINGLE = 2.0**-23  # of a speed and a step: who computes what is kept in single precision is right
Shares = tuple[float, float]  # of speed and spin


def damp(
    lab: Lab,
    linear: float,
    angular: float,
    dt: float,
    steps: int,
    motion: tuple[float, float] = (SPEED, SPIN),
    walls: int = 0,
) -> Shares:
    """The shares of speed and spin that one ball has left after some steps, far from `walls`."""
    speed, spin = motion
    ball = lab.circle((0.0, 0.0), vel=(speed, 0.0), omega=spin)
    boxes = [lab.box((1e4, 100.0 * number), (20.0, 20.0)) for number in range(walls)]
    world = lab.world(ball, *boxes, linear_damping=linear, angular_damping=angular)
    last = lab.simulate(world, [ball], steps, dt, every=steps).body(0)[-1]
    shares = last.vx / speed, last.omega / spin
    lab.saw("damping", (linear, angular, dt, steps), shares)
    return shares


def say(share: float, decimals: int = 2) -> str:
    return f"{100 * share:.{decimals}f}%"


def decimals(right: Sequence[float], answer: Sequence[float]) -> int:
    """So many decimals that percentages look different."""
    return decimals_to_tell((100 * s for s in right), (100 * s for s in answer), 2)


def alike(answer: Iterable[float], right: Iterable[float], within: float) -> bool:
    return all(math.isclose(a, b, rel_tol=within) for a, b in zip(answer, right, strict=True))


def one_second_keeps_the_same_share_at_every_step_size(lab: Lab) -> None:
    """Damping per second, whatever the step"""
    rate, motion = lab.about(0.5), (lab.about(SPEED), lab.about(SPIN))
    lab.ran(f"one ball, no gravity, linear_damping = {rate:g}, for one second")
    rates_per_second = (60, 120, 240)
    kept = {n: damp(lab, rate, rate, 1 / n, n, motion)[0] for n in rates_per_second}
    right = exact.damped(rate, 1.0)
    # A straight line instead of exp is near enough here, and not in the properties below.
    lab.want(
        alike(kept.values(), [right] * 3, within=0.01),
        f"{say(right)} of its speed left at every step size (e^-{rate:g})",
        ", ".join(f"{say(share)} at 1/{n} s" for n, share in kept.items()),
    )


def speed_and_spin_have_a_rate_of_their_own(lab: Lab) -> None:
    """Speed and spin are damped by a rate of their own"""
    for usual, walls in (((1.0, 0.25), 0), ((0.0, 2.0), 0), ((2.0, 0.0), 24), ((0.25, 1.0), 0)):
        linear, angular = (lab.about(rate, min(rate / 4, 1 / 16)) for rate in usual)
        lab.ran(f"linear_damping = {linear:g}, angular_damping = {angular:g}, half a second")
        motion = lab.about(SPEED), lab.about(SPIN)
        speed, spin = damp(lab, linear, angular, 1 / 120, 60, motion, walls)
        right = exact.damped(linear, 0.5), exact.damped(angular, 0.5)
        lab.want(
            alike((speed, spin), right, within=0.01),
            f"{say(right[0])} of the speed and {say(right[1])} of the spin left",
            f"{say(speed)} and {say(spin)}",
        )


@given(linear=rates, angular=rates, dt=damped_steps, parts=st.integers(2, 8))
def one_long_step_or_many_short_ones_damp_alike(
    lab: Lab, linear: float, angular: float, dt: float, parts: int
) -> None:
    """One long step and many short ones damp alike"""
    lab.ran(
        f"linear_damping = {linear:g}, angular_damping = {angular:g}: "
        f"one step of {say_step(dt)}, and the same time in {parts} steps"
    )
    once, often = damp(lab, linear, angular, dt, 1), damp(lab, linear, angular, dt / parts, parts)
    right = exact.damped(linear, dt), exact.damped(angular, dt)
    n = decimals((*right, *right), (*once, *often))
    lab.want(
        alike(once, right, SINGLE) and alike(often, right, parts * SINGLE),
        f"{say(right[0], n)} of the speed, {say(right[1], n)} of the spin, both times",
        f"{say(once[0], n)} and {say(once[1], n)} in one step, "
        f"{say(often[0], n)} and {say(often[1], n)} in many",
    )


def say_step(dt: float) -> str:
    return f"1/{round(1 / dt)} s"


@given(
    first=wide_velocities,
    second=wide_velocities,
    spins=st.tuples(any_speeds, any_speeds),
    linear=rates,
    angular=rates,
    steps=st.tuples(damped_steps, damped_steps),
    pull=pulls,
)
def damping_keeps_the_direction_and_leaves_statics_alone(
    lab: Lab,
    first: Pair,
    second: Pair,
    spins: Pair,
    linear: float,
    angular: float,
    steps: Pair,
    pull: Pair,
) -> None:
    """Damping keeps the direction, after gravity, and static bodies are left alone"""
    lab.ran(
        f"balls at {first} and {second} px/s with spins of {spins} rad/s, gravity {pull} px/s², "
        f"linear_damping = {linear:g}, angular_damping = {angular:g}, "
        f"a step of {say_step(steps[0])} and one of {say_step(steps[1])}"
    )
    meant = [  # far from each other: at 20000 px/s a ball comes 10000 px far
        Moment(-1e5, 40.0, *first, 0.3, spins[0]),
        Moment(1e5, -70.0, *second, -2.0, spins[1]),
    ]
    balls = [
        lab.circle((m.x, m.y), mass=2.0, vel=(m.vx, m.vy), angle=m.angle, omega=m.omega)
        for m in meant
    ]
    fleet, rods = a_fleet(lab)
    still = lab.box((0.0, 5e5), (20.0, 20.0))
    belt = lab.circle((0.0, -5e5), mass=0.0, vel=(50.0, -20.0), omega=2.0)
    world = lab.world(
        *(*balls, *fleet, still, belt),
        gravity=pull,
        linear_damping=linear,
        angular_damping=angular,
        joints=rods,
    )
    changes = {world: "contacts", belt: "pos angle"} | {  # a belt may move or stay
        ball: "pos vel angle omega" for ball in (*balls, *fleet)
    }
    changes |= {rod: "axis bias k stiffness damping" for rod in rods}
    for dt in (*steps, 1 / 118, 1 / 118.05):  # the last ones nearly as usual, and as each other
        left = lab.thing(
            lab.call("Contact", fleet[0], fleet[2], (0.0, 1.0), 0.25, (0.0, 9e5 + 20.0))
        )
        lab.tell(world, "contacts.append", left)  # as if the step before had found one
        lab.tell(world, "step", dt, changes=changes, sees=[*changes, still])
        keep = exact.damped(linear, dt), exact.damped(angular, dt)
        meant = [stepped(each, pull, keep, dt) for each in meant]
        for ball, right in zip(balls, meant, strict=True):
            want_moment(lab, moment(lab.state(ball)), right, dt)
        meant = [moment(lab.state(ball)) for ball in balls]
    for each, vel, omega in ((still, (0.0, 0.0), 0.0), (belt, (50.0, -20.0), 2.0)):
        body = lab.state(each)
        lab.want(
            (*body.vel, body.omega) == (*vel, omega),
            f"a static body with the velocity that it was given, {vel} px/s, spin {omega:g} rad/s",
            f"({body.vel.x!r}, {body.vel.y!r}) px/s, spin {body.omega!r} rad/s",
        )
    box = lab.state(still)
    lab.want(tuple(box.pos) == (0.0, 5e5), "the static box exactly where it was", "it moved")


def a_fleet(lab: Lab) -> tuple[list[Thing], list[Thing]]:
    """Four balls on two rods, far from all else, and the rods.

    All have one velocity, so that no rod has anything to do.
    """
    places = (0.0, 0.0), (40.0, 0.0), (0.0, 40.0), (40.0, 40.0)  # px, the radii 10
    balls = [lab.circle((x, 9e5 + y), vel=(30.0, -20.0)) for x, y in places]
    ends = balls[:2], balls[2:]
    return balls, [lab.thing(lab.call("DistanceJoint", *each), "a rod") for each in ends]


def stepped(each: Moment, pull: Pair, keep: Shares, dt: float) -> Moment:
    """A body a step later that touches nothing: gravity, then damping, then it moves."""
    vx, vy = keep[0] * (each.vx + pull[0] * dt), keep[0] * (each.vy + pull[1] * dt)
    omega = keep[1] * each.omega
    return Moment(each.x + vx * dt, each.y + vy * dt, vx, vy, each.angle + omega * dt, omega)


def moment(body: BodyValue) -> Moment:
    return Moment(body.pos.x, body.pos.y, body.vel.x, body.vel.y, body.angle, body.omega)


def want_moment(lab: Lab, answer: Moment, right: Moment, dt: float) -> None:
    """After a step of dt: its speeds up to what SINGLE allows them, and where these lead."""
    got, meant = astuple(answer), astuple(right)
    n = decimals_to_tell(meant, got, 4)
    vx, vy, omega = (SINGLE * abs(speed) for speed in (right.vx, right.vy, right.omega))
    most = vx * dt, vy * dt, vx, vy, omega * dt, omega
    lab.want(
        all(
            math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9 + off)
            for a, b, off in zip(got, meant, most, strict=True)
        ),
        say_moment(right, n),
        say_moment(answer, n),
    )


def say_moment(each: Moment, n: int) -> str:
    return (
        f"speed ({each.vx:.{n}f}, {each.vy:.{n}f}) px/s, spin {each.omega:.{n}f} rad/s, "
        f"at ({each.x:.{n}f}, {each.y:.{n}f}) px, angle {each.angle:.{n}f} rad"
    )


def no_damping_loses_nothing(lab: Lab) -> None:
    """A rate of 0 loses nothing"""
    motion, rate = (lab.about(SPEED), lab.about(SPIN)), lab.about(0.5)
    lab.ran("one ball, both dampings 0, for one second")
    speed, spin = damp(lab, 0.0, 0.0, 1 / 120, 120, motion)
    n = decimals((1.0, 1.0), (speed, spin))
    left = f"{say(speed, n)} and {say(spin, n)}"
    lab.want(speed == 1.0 and spin == 1.0, "all of its speed and spin", left)
    # A world may leave damping out where both rates are 0: one at a time is asked of the student.
    lab.ran(f"one ball, angular_damping = {rate:g} and the other 0, for one second")
    speed, _ = damp(lab, 0.0, rate, 1 / 120, 120, motion)
    lab.want(speed == 1.0, "all of its speed", say(speed, decimals([1.0], [speed])))
    lab.ran(f"one ball, linear_damping = {rate:g} and the other 0, for one second")
    _, spin = damp(lab, rate, 0.0, 1 / 120, 120, motion)
    lab.want(spin == 1.0, "all of its spin", say(spin, decimals([1.0], [spin])))
