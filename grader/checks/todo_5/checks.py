"""TODO 5: damping by a rate per second."""

import math
from collections.abc import Iterable
from itertools import product
from typing import NamedTuple

from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.digits import want_answer
from grader.checks.strategies import any_speeds, crawls, damped_steps, rates, wide_velocities
from grader.judge.drawing import given
from grader.judge.lab import Lab, Pair, Thing

SPEED, SPIN = 300.0, 12.0  # px/s, rad/s
SINGLE = 2.0**-23  # share of a speed per step: single precision is accepted
Shares = tuple[float, float]  # of speed and spin
Motion = tuple[Pair, Pair, Pair]  # position and velocity; angle and spin
BOTH = "{:.{n}%} of the speed and {:.{n}%} of the spin"
IN_FULL = (
    "at ({:.{n}f}, {:.{n}f}) px, speed ({:.{n}f}, {:.{n}f}) px/s, "
    "angle {:.{n}f} rad, spin {:.{n}f} rad/s"
)
PULLS = (0.0, 0.0), (0.0, 980.0), (-120.375, 35.5), (0.125, -980.25)  # px/s²


class Damped(NamedTuple):
    """A ball alone in a world, whose rates may be changed."""

    lab: Lab
    world: Thing
    ball: Thing

    def shares(
        self,
        linear: float,
        angular: float,
        dt: float,
        steps: int,
        motion: Pair = (SPEED, SPIN),
    ) -> Shares:
        """Return the shares of speed and spin that remain after some steps at these rates."""
        lab, (speed, spin) = self.lab, motion
        lab.put(self.world, linear_damping=linear, angular_damping=angular)
        lab.put(self.ball, pos=(0.0, 0.0), vel=(speed, 0.0), omega=spin)
        last = lab.simulate(self.world, [self.ball], steps, dt, every=steps).body(0)[-1]
        shares = last.vx / speed, last.omega / spin
        lab.saw("damping", (linear, angular, dt, steps), shares)
        return shares


def damped_ball(lab: Lab, linear: float, angular: float, walls: int = 0) -> Damped:
    """Return a ball far from all walls, in a world with these rates."""
    ball = lab.circle((0.0, 0.0))
    boxes = [lab.box((1e4, 100.0 * number), (20.0, 20.0)) for number in range(walls)]
    world = lab.world(ball, *boxes, linear_damping=linear, angular_damping=angular)
    return Damped(lab, world, ball)


def damp(
    lab: Lab, linear: float, angular: float, dt: float, steps: int, motion: Pair, walls: int = 0
) -> Shares:
    return damped_ball(lab, linear, angular, walls).shares(linear, angular, dt, steps, motion)


def are_close(answer: Iterable[float], right: Iterable[float], within: float) -> bool:
    return all(math.isclose(a, b, rel_tol=within) for a, b in zip(answer, right, strict=True))


def one_second_keeps_the_same_share_at_every_step_size(lab: Lab) -> None:
    """Damping per second, for any step"""
    rate, motion = lab.about(0.5), (lab.about(SPEED), lab.about(SPIN))
    lab.ran(f"one ball, no gravity, linear_damping = {rate:g}, for one second")
    rates_per_second = (60, 120, 240)
    kept = {n: damp(lab, rate, rate, 1 / n, n, motion)[0] for n in rates_per_second}
    right = exact.compute_share(rate, 1.0)
    # A straight line instead of exp is near enough here, and not in the properties below.
    lab.want(
        are_close(kept.values(), [right] * 3, within=0.01),
        f"{right:.2%} of its speed left at every step size (e^-{rate:g})",
        ", ".join(f"{share:.2%} at 1/{n} s" for n, share in kept.items()),
    )


def speed_and_spin_have_a_rate_of_their_own(lab: Lab) -> None:
    """Speed and spin are damped by a rate of their own, and a rate of 0 loses nothing"""
    for usual, walls in (((1.0, 0.25), 0), ((0.0, 2.0), 0), ((2.0, 0.0), 24), ((0.25, 1.0), 0)):
        linear, angular = (lab.about(rate, min(rate / 4, 1 / 16)) for rate in usual)
        lab.ran(f"linear_damping = {linear:g}, angular_damping = {angular:g}, half a second")
        motion = lab.about(SPEED), lab.about(SPIN)
        got = damp(lab, linear, angular, 1 / 120, 60, motion, walls)
        want_shares(lab, got, (linear, angular), 0.5)
        for rate, share in zip((linear, angular), got, strict=True):
            lab.want(rate > 0 or share == 1.0, "all of it left at a rate of 0", f"{share:.6%}")
    motion = lab.about(SPEED), lab.about(SPIN)
    lab.ran("one ball, both dampings 0, for one second")
    left = damp(lab, 0.0, 0.0, 1 / 120, 120, motion)
    want_answer(lab, left == (1.0, 1.0), BOTH, (1.0, 1.0), left, digits=2)


def want_shares(lab: Lab, got: Shares, rates: Pair, seconds: float) -> None:
    """Insist on the shares by exp within 1 %; a straight line meets that in short steps."""
    right = exact.compute_share(rates[0], seconds), exact.compute_share(rates[1], seconds)
    good = are_close(got, right, within=0.01)
    want_answer(lab, good, BOTH, right, got, digits=2, expected="{} left")


def one_world_follows_its_rates_and_its_step(lab: Lab) -> None:
    """A world whose rates or whose step are changed follows them at once"""
    first, second = damped_ball(lab, 0.5, 2.0), damped_ball(lab, 2.0, 0.5)
    motion = lab.about(SPEED), lab.about(SPIN)
    slow, fast = lab.about(0.5), lab.about(2.0)
    for each, (linear, angular), steps in (
        (first, (slow, fast), 120),
        (second, (fast, slow), 120),  # another world, the same step
        (first, (fast, slow), 120),  # other rates
        (first, (fast, slow), 240),  # another step
        (first, (0.0, slow), 240),
        (second, (slow, fast), 60),
        (first, (slow, fast), 120),  # as at first
    ):
        lab.ran(
            f"worlds that are changed: linear_damping = {linear:g}, angular_damping = "
            f"{angular:g}, {steps // 2} steps of {say_step(1 / steps)}"
        )
        got = each.shares(linear, angular, 1 / steps, steps // 2, motion)
        want_shares(lab, got, (linear, angular), 0.5)


MANY_RATES = (0.05, 0.001, 0.625, 3.0, 20.0, 0.0)  # 1/s; at 0.603 and 60 Hz 0.99 a step is right
MANY_STEPS = (1 / 60, 1 / 120, 1 / 30, 0.25, 1 / 1000)  # s


@given(examples=2, other=rates, dt=damped_steps, parts=st.integers(2, 8))
def one_long_step_or_many_short_ones_damp_alike(
    lab: Lab, other: float, dt: float, parts: int
) -> None:
    """One long step and many short ones damp alike, at any rate"""
    damped = damped_ball(lab, other, other)
    cases = list(product(MANY_RATES, MANY_STEPS))
    for n, (linear, step) in enumerate([*cases, (other, dt)]):
        angular = (*MANY_RATES, other)[(n + n // len(MANY_STEPS)) % 7]
        want_both(lab, damped, (linear, angular), step, parts)


def want_both(lab: Lab, damped: Damped, rates: Pair, dt: float, parts: int) -> None:
    """Insist that one long step and several short ones leave the same speed."""
    linear, angular = rates
    lab.ran(
        f"linear_damping = {linear:g}, angular_damping = {angular:g}: "
        f"one step of {say_step(dt)}, and the same time in {parts} steps"
    )
    once = damped.shares(linear, angular, dt, 1)
    often = damped.shares(linear, angular, dt / parts, parts)
    right = exact.compute_share(linear, dt), exact.compute_share(angular, dt)
    within = SINGLE * (1 + max(rates) * dt)  # the exponent is rounded as well
    good = are_close(once, right, within) and are_close(often, right, parts * within)
    words = f"{BOTH} in one step, {BOTH} in many"
    want_answer(lab, good, words, (right, right), (once, often), digits=2)


def say_step(dt: float) -> str:
    return f"1/{round(1 / dt)} s"


@given(
    examples=2,
    first=wide_velocities,
    slow=st.tuples(crawls, crawls),
    spins=st.tuples(any_speeds, crawls),
    rates=st.tuples(rates, rates),
    dt=damped_steps,
)
def damping_keeps_the_direction_and_leaves_statics_alone(
    lab: Lab, first: Pair, slow: Pair, spins: Pair, rates: Pair, dt: float
) -> None:
    """Damping keeps the direction, after gravity, and does not change static bodies"""
    meant: list[Motion] = [  # far from each other: at 20000 px/s a ball moves 10000 px
        ((-1e5, 40.0), first, (0.3, spins[0])),
        ((1e5, -70.0), slow, (-2.0, spins[1])),
    ]
    balls = [
        lab.circle(pos, mass=2.0, vel=vel, angle=angle, omega=omega)
        for pos, vel, (angle, omega) in meant
    ]
    fleet, rods = a_fleet(lab)
    still = lab.box((0.0, 5e5), (20.0, 20.0))
    belt = lab.circle((0.0, -5e5), mass=0.0, vel=(50.0, -20.0), omega=2.0)
    bodies = *balls, *fleet, still, belt
    changes = {belt: "pos angle"} | {  # a belt may move or stay
        ball: "pos vel angle omega" for ball in (*balls, *fleet)
    }
    changes |= {rod: "axis bias k stiffness damping" for rod in rods}
    for n, pull in enumerate(PULLS):
        linear, angular = ((0.5, 0.125), rates, (0.0, 0.25), (2.0, 0.0))[n]
        world = lab.world(
            *bodies, gravity=pull, linear_damping=linear, angular_damping=angular, joints=rods
        )
        for step in ((1 / 118, 1 / 118.05), (dt, 1 / 24), (1 / 120, 0.25), (dt, dt))[n]:
            lab.ran(
                f"balls at {first} and {slow} px/s with spins of {spins} rad/s, gravity {pull} "
                f"px/s², linear_damping = {linear:g}, angular_damping = {angular:g}, then a step "
                f"of {say_step(step)}"
            )
            left = lab.make("Contact", fleet[0], fleet[2], (0.0, 1.0), 0.25, (0.0, 9e5 + 20.0))
            lab.let(world, "contacts.append", left)  # as if the step before had found one
            may = {world: "contacts", **changes}
            lab.tell(world, "step", step, changes=may, sees=[*may, still])
            keep = exact.compute_share(linear, step), exact.compute_share(angular, step)
            times = 1 + max(linear, angular) * step  # the exponent is rounded as well
            meant = [
                want_motion(lab, ball, step_on(each, pull, keep, step), step, times)
                for ball, each in zip(balls, meant, strict=True)
            ]
    want_unmoved(lab, still, belt)


def want_unmoved(lab: Lab, still: Thing, belt: Thing) -> None:
    """Insist that the static box has not moved and that the belt has its old speed."""
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
    """Return four balls on two rods, far from other bodies, and the rods.

    All have the same velocity, so that no rod applies an impulse.
    """
    places = (0.0, 0.0), (40.0, 0.0), (0.0, 40.0), (40.0, 40.0)  # px, the radii 10
    balls = [lab.circle((x, 9e5 + y), vel=(30.0, -20.0)) for x, y in places]
    ends = balls[:2], balls[2:]
    return balls, [lab.make("DistanceJoint", *each) for each in ends]


def step_on(motion: Motion, pull: Pair, keep: Shares, dt: float) -> Motion:
    """Return the motion of a free body after a step: gravity, damping, then move."""
    (x, y), (vx, vy), (angle, omega) = motion
    vx, vy, omega = keep[0] * (vx + pull[0] * dt), keep[0] * (vy + pull[1] * dt), keep[1] * omega
    return (x + vx * dt, y + vy * dt), (vx, vy), (angle + omega * dt, omega)


def want_motion(lab: Lab, ball: Thing, right: Motion, dt: float, times: float) -> Motion:
    """Insist on the right motion after a step, within `times` SINGLE of its speeds.

    Return the ball's motion.
    """
    body, (pos, vel, (angle, omega)) = lab.state(ball), right
    turned = angle + math.remainder(body.angle - angle, math.tau)
    numbers = (*body.pos, *body.vel, turned, body.omega)
    most = [times * SINGLE * abs(speed) for speed in (*vel, omega)]
    off = most[0] * dt, most[1] * dt, *most[:2], most[2] * dt, most[2]
    good = all(
        math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9 + each)
        for a, b, each in zip(numbers, (*pos, *vel, angle, omega), off, strict=True)
    )
    found = (body.pos.x, body.pos.y), (body.vel.x, body.vel.y), (body.angle, body.omega)
    want_answer(lab, good, IN_FULL, right, found, digits=4)
    return found
