"""TODO 2: the spin terms in effective_mass."""

import math
from typing import Any

from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.exact import Lever, cross
from grader.checks.strategies import directions, levers, static_levers, wherever
from grader.checks.telling import want_told
from grader.judge.drawing import given
from grader.judge.lab import NOTHING, Lab, Pair, Thing
from grader.protocol import BodyValue

FLOOR = Lever(0.0, 100.0, 30.0, -100.0)
DOWN = (0.0, 1.0)
ALONG_THE_FLOOR = (1.0, 0.0)
DIAGONAL = (0.6, 0.8)
PLACES = (-30.3125, 70.6875), (12.4375, -5.8125)  # px; the arms say where they are touched
# Arms of 20 px, px: so many, each asked twice, that one call in a hundred shows.
ALL_ROUND = [(20 * math.cos(0.11 * n), 20 * math.sin(0.11 * n)) for n in range(52)]
USUAL = Lever(1.0, 10.0625, 10.0625, 3.0)  # nearly the ball that students have in mind
Fields = dict[str, Any]  # what a body has besides mass and radius, on which nothing here hangs


def discs(lab: Lab, a: Lever, b: Lever, *fields: Fields) -> tuple[Thing, Thing]:
    """Both discs; `fields` are what else A and B have, or nothing where they rest."""
    first, second = (
        lab.circle(radius=lever.radius, mass=lever.mass, **{"pos": place, **how})
        for place, lever, how in zip(PLACES, (a, b), fields or ({}, {}), strict=True)
    )
    return first, second


def say(lever: Lever) -> str:
    weight = f"{lever.mass:g} kg" if lever.mass else "static"
    return f"{weight}, r {lever.radius:g}, arm ({lever.rx:g}, {lever.ry:g})"


def effective_mass(
    lab: Lab,
    a: Lever,
    b: Lever,
    axis: Pair,
    things: tuple[Thing, Thing] | None = None,
    framed: bool = True,
) -> float:
    """What the submission's effective_mass says of two discs.

    Where it is not `framed`, a right number is worth its points, whatever else happens.
    """
    lab.ran(f"effective_mass along ({axis[0]:g}, {axis[1]:g}): A {say(a)}; B {say(b)}")
    arms = (a.rx, a.ry), (b.rx, b.ry)
    both = things or discs(lab, a, b)
    changes = NOTHING if framed else None
    value = lab.call("effective_mass", *both, *arms, axis, changes=changes, twice=framed)
    answer = lab.number(value, "what effective_mass returns")
    lab.saw("effective_mass", (a, b, axis), answer)
    return answer


def per_kg(value: float, digits: int) -> str:
    return f"{value:.{digits}g} per kg"


def want_exact(
    lab: Lab,
    a: Lever,
    b: Lever,
    axis: Pair,
    things: tuple[Thing, Thing] | None = None,
    framed: bool = True,
) -> None:
    answer = effective_mass(lab, a, b, axis, things, framed)
    right = exact.effective_mass(a, b, axis)
    good = math.isclose(answer, right, rel_tol=1e-9)
    want_told(lab, good, per_kg, right, answer, digits=6)


def want_about(lab: Lab, a: Lever, b: Lever, axis: Pair) -> None:
    want_exact(lab, like(lab, a), like(lab, b), axis, framed=False)


def like(lab: Lab, lever: Lever) -> Lever:
    """As heavy and as large, the arm in the same direction."""
    size = lab.about(1.0)
    return Lever(lab.about(lever.mass), *(size * each for each in lever[1:]))


def the_first_body_adds_its_spin_term(lab: Lab) -> None:
    """The first body adds (ra x axis)²/I_a, a static second body nothing"""
    want_about(lab, Lever(2.0, 10.0, 10.0, 0.0), FLOOR, DOWN)
    for rx in (-9.75, 9.75):
        want_about(lab, Lever(0.5, 20.0, rx, 17.0), FLOOR, DOWN)
    want_about(lab, USUAL, FLOOR, DOWN)
    want_about(lab, Lever(4.0, 15.0, 8.0, 12.0), FLOOR, DIAGONAL)


def the_second_body_adds_its_spin_term(lab: Lab) -> None:
    """The second body adds (rb x axis)²/I_b, a static first body nothing"""
    want_about(lab, FLOOR, Lever(2.0, 10.0, 10.0, 0.0), DOWN)
    for rx in (-9.75, 9.75):
        want_about(lab, FLOOR, Lever(0.5, 20.0, rx, 17.0), DOWN)
    want_about(lab, FLOOR, USUAL, DOWN)
    want_about(lab, FLOOR, Lever(4.0, 15.0, 8.0, 12.0), DIAGONAL)


def only_the_part_of_an_arm_across_the_axis_counts(lab: Lab) -> None:
    """An arm along the axis adds nothing, and one across it the most"""
    a, b = like(lab, Lever(2.0, 20.0, 0.0, 0.0)), like(lab, Lever(3.0, 25.0, 15.0, 20.0))
    both, size = discs(lab, a, b), a.radius / 20.0
    for x, y in ((12.0, 16.0), (16.0, -12.0), *ALL_ROUND):  # along, across, in between
        want_exact(lab, a._replace(rx=size * x, ry=size * y), b, DIAGONAL, both)


@given(
    a=levers(),
    b=levers() | static_levers,
    axis=directions(),
    swap=st.booleans(),
    others=st.tuples(wherever, wherever),
)
def any_two_bodies_agree_with_the_formula(
    lab: Lab, a: Lever, b: Lever, axis: Pair, swap: bool, others: tuple[Fields, Fields]
) -> None:
    """Any two bodies: the four terms add up, whichever body is A"""
    a, b = (b, a) if swap else (a, b)
    both = discs(lab, a, b, *others)
    want_exact(lab, a, b, axis, both)
    lab.put(both[0], inv_mass=0.0, inv_inertia=0.0)
    want_exact(lab, a._replace(mass=0.0), b._replace(rx=b.ry, ry=b.rx), axis, both)


def point_speed(body: BodyValue, lever: Lever, axis: Pair) -> float:
    """The speed along the axis of the point at the end of the arm, px/s."""
    turning = body.omega * cross((lever.rx, lever.ry), axis)
    return body.vel.x * axis[0] + body.vel.y * axis[1] + turning


def size(body: BodyValue, lever: Lever) -> float:
    """The fastest that any point at this distance from the centre can be, px/s."""
    return math.hypot(*body.vel) + abs(body.omega) * math.hypot(lever.rx, lever.ry)


def energy(body: BodyValue, lever: Lever) -> float:
    """Kinetic energy, kg px²/s²."""
    return 0.5 * (lever.mass * math.hypot(*body.vel) ** 2 + lever.inertia * body.omega**2)


@given(
    a=levers(),
    b=levers() | static_levers,
    axis=directions(),
    others=st.tuples(wherever, wherever),
)
def the_impulse_that_ends_a_speed_is_speed_over_k(
    lab: Lab, a: Lever, b: Lever, axis: Pair, others: tuple[Fields, Fields]
) -> None:
    """An impulse of -speed / k ends the speed and creates no energy"""
    first, second = discs(lab, a, b, others[0], others[1] if b.mass else {})
    k = effective_mass(lab, a, b, axis, (first, second), framed=False)
    lab.want(k > 0, "more than 0 per kg", f"{k:.6g}")
    before = lab.state(first), lab.state(second)
    speed = point_speed(before[1], b, axis) - point_speed(before[0], a, axis)  # of B away from A
    lab.ran(
        f"an impulse of -speed / k along ({axis[0]:g}, {axis[1]:g}): A {say(a)}, B {say(b)}, "
        f"parting at {speed:g} px/s"
    )
    impulse = -speed / k * axis[0], -speed / k * axis[1]
    arms = (a.rx, a.ry), (b.rx, b.ry)
    lab.call("apply_impulse", first, second, impulse, *arms, sees=(first, second))
    after = lab.state(first), lab.state(second)
    left = point_speed(after[1], b, axis) - point_speed(after[0], a, axis)
    most = max(
        size(body, lever) for body, lever in zip((*before, *after), (a, b, a, b), strict=True)
    )
    lab.want(
        abs(left) <= 1e-9 * max(1.0, most),
        f"none of the {speed:.4g} px/s left with which the points part or close",
        f"{left:.4g} px/s left",
    )
    had, has = (energy(each[0], a) + energy(each[1], b) for each in (before, after))
    no_more = has <= had * (1 + 1e-9)
    words = "no more energy than before: {}"
    want_told(lab, no_more, in_digits, had, has, digits=6, expected=words)


def in_digits(value: float, digits: int) -> str:
    return f"{value:.{digits}g}"


def a_sliding_ball_comes_to_roll(lab: Lab) -> None:
    """A ball set sliding comes to roll without slipping"""
    for radius, mass in ((5.0, 0.25), (15.0, 2.0), (40.0, 9.0)):
        ball = like(lab, Lever(mass, radius, 0.0, radius))
        speed = lab.about(300.0)
        most = 3.5 * ball.mass * speed / 300.0
        k = effective_mass(lab, FLOOR, ball, ALONG_THE_FLOOR)
        lab.want(k > 0, "more than 0 per kg", f"{k:.6g}")
        lab.ran(
            f"a ball of {ball.mass:g} kg, r {ball.radius:g}, slid at {speed:g} px/s: pushes of "
            f"-slip / k, each at most {most:g} kg px/s"
        )
        last, slips = slide(lab, ball, k, speed, most)
        # The largest push takes 3.5 of 300 parts off its speed and brings its lowest point 10.5
        # nearer to rest, so that 29 pushes do. A third of the speed is spent on the spin.
        worst, right = max(map(abs, slips[30:])), exact.rolling_speed(speed)
        lab.want(
            worst <= 1e-6 and math.isclose(last, right, rel_tol=1e-9),
            f"after 30 pushes it rolls at {right:g} px/s and does not slip",
            f"{last:.2f} px/s at the end, slipping at up to {worst:.4g} px/s",
        )


def slide(lab: Lab, ball: Lever, k: float, speed: float, most: float) -> tuple[float, list[float]]:
    """The ball's speed after 40 pushes by the floor, and the slip after each."""
    floor, moving = discs(lab, FLOOR, ball, {}, {"vel": (speed, 0.0)})
    slips = [speed]
    for _ in range(40):
        needed = -slips[-1] / k
        push = math.copysign(min(abs(needed), most), needed), 0.0
        arms = (FLOOR.rx, FLOOR.ry), (ball.rx, ball.ry)
        lab.call("apply_impulse", floor, moving, push, *arms, sees=(moving,))
        state = lab.state(moving)
        speed = state.vel.x
        slips.append(speed - state.omega * ball.radius)
    return speed, slips
