"""TODO 2: the spin terms in effective_mass."""

import math
from itertools import product
from typing import Any

from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.digits import want_answer
from grader.checks.exact import Lever
from grader.checks.strategies import directions, masses, radii, wherever
from grader.judge.drawing import given
from grader.judge.lab import NOTHING, STEP, Lab, Pair, Thing
from grader.protocol import Value

FLOOR = Lever(0.0, 100.0, 30.0, -100.0)
DOWN = (0.0, 1.0)
DIAGONAL = (0.6, 0.8)
PLACES = (-30.3125, 70.6875), (12.4375, -5.8125)  # px; the arms say where they are touched
# Arms of 20 px: enough pairs of calls to find a fault in one call of a hundred.
ALL_ROUND = [(20 * math.cos(0.11 * n), 20 * math.sin(0.11 * n)) for n in range(52)]
USUAL = Lever(1.0, 10.0625, 10.0625, 3.0)  # nearly the ball that students have in mind
Fields = dict[str, Any]  # fields of a body besides mass and radius, which must not matter here


def discs(lab: Lab, a: Lever, b: Lever, *fields: Fields) -> tuple[Thing, Thing]:
    """Return both discs; `fields` are the other fields of A and B, or None if they rest."""
    first, second = (
        lab.circle(radius=lever.radius, mass=lever.mass, **{"pos": place, **how})
        for place, lever, how in zip(PLACES, (a, b), fields or ({}, {}), strict=True)
    )
    return first, second


def say(lever: Lever) -> str:
    weight = f"{lever.mass:g} kg" if lever.mass else "static"
    return f"{weight}, r {lever.radius:g}, arm ({lever.rx:g}, {lever.ry:g})"


def want_exact(
    lab: Lab,
    a: Lever,
    b: Lever,
    axis: Pair,
    things: tuple[Thing, Thing] | None = None,
    framed: bool = True,
) -> None:
    """Insist on the right effective_mass of two discs.

    Unless `framed`, do not check whether the bodies change.
    """
    lab.ran(f"effective_mass along ({axis[0]:g}, {axis[1]:g}): A {say(a)}; B {say(b)}")
    arms = (a.rx, a.ry), (b.rx, b.ry)
    both = things or discs(lab, a, b)
    changes = NOTHING if framed else None

    def judge(value: Value) -> None:
        answer = lab.number(value, "what effective_mass returns")
        lab.saw("effective_mass", (a, b, axis), answer)
        right = exact.effective_mass(a, b, axis)
        good = math.isclose(answer, right, rel_tol=1e-9)
        want_answer(lab, good, "{:.{n}g} per kg", right, answer, digits=6)

    lab.call("effective_mass", *both, *arms, axis, changes=changes, twice=framed, then=judge)


def want_about(lab: Lab, a: Lever, b: Lever, axis: Pair) -> None:
    want_exact(lab, make_similar(lab, a), make_similar(lab, b), axis, framed=False)


def make_similar(lab: Lab, lever: Lever) -> Lever:
    """Return a lever of similar mass and size, its arm in the same direction."""
    size = lab.about(1.0)
    return Lever(lab.about(lever.mass), *(size * each for each in lever[1:]))


def the_first_body_adds_its_spin_term(lab: Lab) -> None:
    """The first body adds (ra x axis)²/I_a, a static second body nothing"""
    want_about(lab, Lever(2.0, 10.0, 10.0, 0.0), FLOOR, DOWN)
    for rx in (-9.75, 9.75):
        want_about(lab, Lever(0.5, 20.0, rx, 17.0), FLOOR, DOWN)
    want_about(lab, USUAL, FLOOR, DOWN)
    want_about(lab, Lever(3.0, 15.0, 8.0, 12.0), FLOOR, DIAGONAL)


def the_second_body_adds_its_spin_term(lab: Lab) -> None:
    """The second body adds (rb x axis)²/I_b, a static first body nothing"""
    want_about(lab, FLOOR, Lever(2.0, 10.0, 10.0, 0.0), DOWN)
    for rx in (-9.75, 9.75):
        want_about(lab, FLOOR, Lever(0.5, 20.0, rx, 17.0), DOWN)
    want_about(lab, FLOOR, USUAL, DOWN)
    want_about(lab, FLOOR, Lever(3.0, 15.0, 8.0, 12.0), DIAGONAL)


def only_the_part_of_an_arm_across_the_axis_counts(lab: Lab) -> None:
    """An arm along the axis adds nothing, and one across it the most"""
    a, b = (
        make_similar(lab, Lever(2.0, 20.0, 0.0, 0.0)),
        make_similar(lab, Lever(3.0, 25.0, 15.0, 20.0)),
    )
    both, size = discs(lab, a, b), a.radius / 20.0
    for x, y in ((12.0, 16.0), (16.0, -12.0), *ALL_ROUND):  # along, across, in between
        want_exact(lab, a._replace(rx=size * x, ry=size * y), b, DIAGONAL, both)


QUADRANTS = (1, 1), (-1, 1), (1, -1), (-1, -1)
BOTH, ONLY_A, ONLY_B = (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)  # of the masses that were drawn
KINDS = ONLY_A, ONLY_B, BOTH, BOTH
OFF = math.sin(1 / 4096), math.cos(1 / 4096)  # nearly vertical axes
AXES = (0.0, 1.0), DIAGONAL, (1.0, 0.0), (-0.8, 0.6), OFF, (0.28, -0.96), (OFF[1], -OFF[0])
SCALES = 1.0, 1 / 8, 256.0  # of lengths
WEIGHTS = 1.0, 512.0, 1 / 1024  # times the mass


@given(
    examples=2,
    radii=st.tuples(radii, radii),
    arms=st.tuples(*[st.integers(4, 96).map(lambda n: n / 64)] * 4),
    masses=st.tuples(masses, masses),
    nearly=directions(),
    fields=st.tuples(wherever, wherever),
)
def any_two_bodies_agree_with_the_formula(
    lab: Lab,
    radii: Pair,
    arms: tuple[float, ...],
    masses: Pair,
    nearly: Pair,
    fields: tuple[Fields, Fields],
) -> None:
    """Two bodies of any mass and size, pushed anywhere, and then changed"""
    slow = [{**each, "omega": 1 / 64, "vel": (1 / 64, 0.0)} for each in fields]
    for n, (quadrant, (here, there)) in enumerate(product(QUADRANTS, KINDS)):
        scale, weight = SCALES[n % 3], WEIGHTS[n // 3 % 3]
        axis = nearly if n == 7 else AXES[n % 7]
        a = make_lever(weight * here * masses[0], scale * radii[0], arms[:2], quadrant)
        other = QUADRANTS[n // 2 % 4]
        b = make_lever(weight * there * masses[1], scale * radii[1], arms[2:], other)
        both = discs(lab, a, b, *(slow if n % 2 else fields))
        want_exact(lab, a, b, axis, both)
        want_exact(lab, a._replace(rx=a.ry, ry=-a.rx), b, axis, both)
        if n % 4 == 0:  # A and B become static in turn
            lab.put(both[0], inv_mass=0.0, inv_inertia=0.0)
            want_exact(lab, a._replace(mass=0.0), b._replace(rx=b.ry, ry=b.rx), axis, both)


def make_lever(mass: float, radius: float, arm: tuple[float, ...], signs: Pair) -> Lever:
    """Return a disc with an arm, which is given in radii."""
    return Lever(mass, radius, radius * arm[0] * signs[0], radius * arm[1] * signs[1])


# ---------------------------------------------------------------- what a player sees


def a_sliding_ball_comes_to_roll_on_a_floor(lab: Lab) -> None:
    """A ball of any size set sliding on a floor comes to roll"""
    floor = lab.box((600.0, 420.0), (1200.0, 20.0), friction=0.6)
    for radius, mass in ((10.0, 1.0), (20.0, 4.0), (40.0, 16.0)):
        want_to_roll(lab, floor, (0.0, 400.0 - radius), radius, mass, "floor")


def a_sliding_ball_comes_to_roll_on_a_large_one(lab: Lab) -> None:
    """A ball set sliding on a large static ball comes to roll"""
    ground = lab.circle((0.0, 60_400.0), 60_000.0, 0.0, friction=0.6)
    for radius, mass in ((12.0, 1.5), (30.0, 9.0)):
        want_to_roll(lab, ground, (0.0, 400.0 - radius), radius, mass, "static ball, r 60000")


def want_to_roll(lab: Lab, ground: Thing, pos: Pair, radius: float, mass: float, name: str) -> None:
    """Insist that the ball rolls: after 1.5 s its lowest point no longer slips.

    Friction of 0.6 removes 588 px/s in a second; rolling takes a third of 300 px/s.
    """
    mass, speed = lab.about(mass), lab.about(300.0)
    lab.ran(f"a ball of {mass:g} kg, r {radius:g}, slid at {speed:g} px/s on a {name}, 2 seconds")
    ball = lab.circle(pos, radius, mass, vel=(speed, 0.0), restitution=0.0, friction=0.6)
    world = lab.world(ground, ball, gravity=(0.0, 980.0))
    last = lab.simulate(world, [ball], round(2 / STEP)).body(0)[-60:]
    slip = max(abs(each.vx - radius * each.omega) for each in last)
    right = exact.rolling_speed(speed)
    lab.want(
        slip < 0.015 * right and abs(last[-1].vx - right) < 0.05 * right,
        f"it rolls at {right:.0f} px/s, and its spin x radius is the same",
        f"{last[-1].vx:.1f} px/s, spin x radius {radius * last[-1].omega:.1f} px/s, slipping at "
        f"up to {slip:.1f} px/s",
    )
