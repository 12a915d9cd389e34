"""TODO 8a to 8c: three integrators, one step under any force and ten seconds on the spring."""

import math
from collections.abc import Callable, Sequence
from itertools import islice, pairwise
from typing import Any, NamedTuple

from grader.checks import exact
from grader.checks.digits import want_answer
from grader.checks.exact import Accel, State
from grader.checks.strategies import forces, near_and_far, starts
from grader.judge.drawing import given
from grader.judge.lab import Lab

OMEGA = 2 * math.pi  # rad/s: the lesson's spring swings once per second
SPRING = (0.0, -(OMEGA**2))
X0 = 100.0  # px
NEARLY_USUAL = [((100.03125, 0.5), 1 / 29.8), ((260.0, 2345.25), 1 / 2000)]  # px, px/s; s
TELLING = 4  # first steps on the spring, by which mistakes can be told apart
FAR = 1e6  # px or px/s: beyond this, a cubic force overflows

# Long steps distinguish integrators; short ones are not round numbers.
TIME_STEPS = (0.5, 2.0, 1.0, 1 / 4, 1 / 8, 1 / 16, 1 / 30, 1 / 120, 1 / 480)  # s

Polynomial = tuple[float, ...]  # lowest power first
Starts = tuple[State, State]  # a moving body and one at rest
GRAVITY: Polynomial = (980.25, 0.0, 0.0, 0.0)  # px/s², nearly


class Method(NamedTuple):
    """An integrator, and its figures after 10 s in the lesson's table."""

    name: str
    order: int
    error: float  # px, distance from its start after 10 s
    energy_change: float  # %


SEMI_IMPLICIT_EULER = Method("semi_implicit_euler", 1, 1.878, -2.38)
VELOCITY_VERLET = Method("velocity_verlet", 2, 0.665, -0.01)
RK4 = Method("rk4", 4, 0.018, -0.03)


def oracle_of(method: Method) -> Callable[[float, float, float, Accel], State]:
    """Look up the oracle of a method at each call: a release wraps it to note its answers."""
    oracle: Callable[[float, float, float, Accel], State] = getattr(exact, method.name)
    return oracle


def want_every_step(
    lab: Lab,
    method: Method,
    starts: Starts,
    force: Polynomial,
    other: Polynomial,
    elsewhere: float,
) -> None:
    """Insist on steps of every length, from motion and from rest, also under gravity alone.

    Each question changes one or two values of the previous one. This exposes answers stored for
    an earlier position, speed or step. In the third question no force acts at the start. The last
    two are close to the first step of the lesson's table, and a fast short step.
    """
    for n, dt in enumerate(TIME_STEPS):
        start, first = starts[n % 2], GRAVITY if n % 3 == 2 else force
        want_step(lab, method, start, dt, first, twice=True)
        want_step(lab, method, start, dt, other)
        centred = (first[0] - exact.polynomial(first)(elsewhere), *first[1:])
        end = want_step(lab, method, (elsewhere, start[1]), dt, centred)
        if max(map(abs, end)) <= FAR:
            want_step(lab, method, end, dt, other)
        for usual, short in NEARLY_USUAL:
            want_step(lab, method, usual, short, first)


def want_step(
    lab: Lab, method: Method, state: State, dt: float, force: Polynomial, twice: bool = False
) -> State:
    """Insist that one step gives the right state up to rounding; return the right one."""
    x, v = state
    lab.ran(
        f"{method.name}: one step of {dt:g} s from x = {x:g} px, v = {v:g} px/s "
        f"with accel(x) = {formula(force)}"
    )
    right = oracle_of(method)(x, v, dt, exact.polynomial(force))
    # Terms may be added in any order, so rounding is a share of their absolute values.
    sizes = oracle_of(method)(abs(x), abs(v), dt, exact.polynomial([abs(c) for c in force]))

    def judge(states: list[State]) -> None:
        (answer,) = states
        lab.saw(method.name, (x, v, dt, force), answer)
        off = zip(answer, right, sizes, strict=True)
        good = all(abs(a - b) <= 1e-12 * size for a, b, size in off)
        want_answer(lab, good, "x = {:.{n}g} px, v = {:.{n}g} px/s", right, answer, digits=6)

    lab.integrate(method.name, state, dt, force, twice=twice, then=judge)
    return right


def formula(force: Sequence[float]) -> str:
    powers = zip(force, ("", "·x", "·x²", "·x³"), strict=False)
    return " ".join(f"{c:+g}{power}" for c, power in powers if c) or "0"


def swing(lab: Lab, method: Method, steps: int, seconds: float, x0: float) -> list[State]:
    """Return the spring's state after each of `steps` steps from rest at x0."""
    start, dt = (x0, 0.0), seconds / steps
    states = lab.integrate(method.name, start, dt, SPRING, steps)
    for before, answer in islice(pairwise([start, *states]), TELLING):
        lab.saw(method.name, (*before, dt, SPRING), answer)
    return states


# Single steps that a failed check also asks to find the mistake; no number is round.
STEPS: tuple[tuple[State, float, Polynomial], ...] = (
    ((3.0, -2.0), 0.25, (1.0, -2.0, 0.5, 0.0)),
    ((-1.5, 4.0), 0.5, (0.0, -1.5, 0.0, 0.25)),
    ((2.0, 1.25), 0.125, (-3.0, 0.75, -0.5, 0.0)),
    ((0.5, 6.0), 0.3, (2.0, -4.0, 0.0, 0.0)),
)
SAMPLES = 4  # of RK4


def look_closely(lab: Lab, method: Method) -> None:
    """Ask for single steps, which cost no points, to find out what is wrong."""
    if not lab.surveys:
        return
    if method is RK4:
        for (x, v), dt, force in STEPS:
            places = tuple(dict.fromkeys(lab.places(method.name, (x, v), dt, force)))
            if len(places) <= SAMPLES:  # further right answers explain nothing
                lab.saw("samples of accel", (x, v, dt, force), places)
    for (x, v), dt, force in STEPS:
        (answer,) = lab.integrate(method.name, (x, v), dt, force)
        lab.saw(method.name, (x, v, dt, force), answer)


def want_a_swing(lab: Lab, method: Method) -> None:
    """Insist on an error and a change of energy of 0.5 to 1.5 times those in the lesson's table.

    A single step from another start follows: its answer must not come from stored values.
    """
    look_closely(lab, method)
    x0 = lab.about(X0)
    lab.ran(f"{method.name} on the spring for 10 s, dt = 1/30 s, from x = {x0:g} px at rest")
    states = swing(lab, method, 300, 10.0, x0)
    (x, v), farthest = states[-1], min(x for x, _ in states)
    lab.want(
        farthest < -0.9 * x0,
        f"it swings to about x = {-x0:g} px, on the other side",
        f"it comes to x = {farthest:.1f} px at the farthest",
    )
    error = x0 / X0 * method.error
    change = 100 * ((v**2 + OMEGA**2 * x**2) / (OMEGA**2 * x0**2) - 1)
    lab.want(
        abs(x - (x0 - error)) <= 0.5 * error
        and abs(change - method.energy_change) <= 0.5 * abs(method.energy_change),
        f"about x = {x0 - error:.3f} px in the end, energy changed by {method.energy_change:+.2f}%",
        f"x = {x:.3f} px in the end, energy changed by {change:+.2f}%",
    )
    lab.ran(f"{method.name}, after that: one step of 1/30 s from x = {-x0:g} px at rest")
    ((_, speed),) = swing(lab, method, 1, 1 / 30, -x0)
    right = OMEGA**2 * x0 / 30
    lab.want(
        abs(speed - right) <= 0.1 * right,
        f"about v = {right:.0f} px/s, as its acceleration is {OMEGA**2 * x0:.0f} px/s²",
        f"v = {speed:.1f} px/s",
    )


def asked_everywhere(check: Callable[..., None]) -> Callable[..., None]:
    """Make a check a property that draws the arguments of an integrator's step."""
    drawn = given(examples=2, starts=starts, force=forces, other=forces, elsewhere=near_and_far)
    return drawn(check)


@asked_everywhere
def semi_implicit_euler_moves_with_the_new_velocity(lab: Lab, **drawn: Any) -> None:
    """A step changes the velocity first, then moves with the new one"""
    want_every_step(lab, SEMI_IMPLICIT_EULER, **drawn)


def semi_implicit_euler_keeps_the_spring_swinging(lab: Lab) -> None:
    """The spring still swings after ten seconds, about as in the lesson's table"""
    want_a_swing(lab, SEMI_IMPLICIT_EULER)


@asked_everywhere
def velocity_verlet_uses_the_accelerations_at_both_ends(lab: Lab, **drawn: Any) -> None:
    """A step uses the accelerations at both of its ends"""
    want_every_step(lab, VELOCITY_VERLET, **drawn)


def velocity_verlet_keeps_the_spring_swinging(lab: Lab) -> None:
    """The spring still swings after ten seconds, about as in the lesson's table"""
    want_a_swing(lab, VELOCITY_VERLET)


@asked_everywhere
def rk4_weighs_four_samples(lab: Lab, **drawn: Any) -> None:
    """A step weighs four samples of velocity and acceleration"""
    want_every_step(lab, RK4, **drawn)


def rk4_keeps_the_spring_swinging(lab: Lab) -> None:
    """The spring still swings after ten seconds, about as in the lesson's table"""
    want_a_swing(lab, RK4)
