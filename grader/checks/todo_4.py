"""TODO 4: friction within its limit.

Two discs get their speeds by hand, and one pass of World.solve_contact at a time. Their inv_inertia
is set to 0: without spin, no number depends on TODO 2.
"""

import math
from typing import NamedTuple

from hypothesis import given

from grader.checks import exact
from grader.checks.exact import DEPTH, Rubbing
from grader.checks.strategies import (
    frictions,
    impulses,
    masses,
    masses_or_static,
    rubbings,
    units,
    velocities,
)
from grader.judge.lab import STEP, Lab, Pair, Thing
from grader.protocol import BodyValue

DOWN = (0.0, 1.0)
ON_A_FLOOR = (0.0, 2.0)  # kg: A is static
STILL = (0.0, 0.0)
ROUGH = (0.5, 0.5)
RADIUS = 10.0  # px


class Pressed(NamedTuple):
    world: Thing
    contact: Thing
    a: Thing
    b: Thing


def press(lab: Lab, mu: Pair, mass: Pair, normal: Pair) -> Pressed:
    """Discs with these frictions and masses; the normal leads from A to B."""
    x, y = normal
    apart = 2 * RADIUS - DEPTH
    b_pos, point = (apart * x, apart * y), (RADIUS * x, RADIUS * y)
    a = lab.circle(STILL, RADIUS, mass[0], friction=mu[0], inv_inertia=0.0)
    b = lab.circle(b_pos, RADIUS, mass[1], friction=mu[1], inv_inertia=0.0)
    contact = lab.thing(lab.call("Contact", a, b, normal, DEPTH, point), "a Contact")
    lab.put(contact, target=0.0)
    return Pressed(lab.world(), contact, a, b)


def rub(
    lab: Lab, mu: Pair, mass: Pair, passes: list[Rubbing], normal: Pair = DOWN
) -> tuple[float, ...]:
    """The friction impulse on B in total after each pass, along its slip."""
    lab.ran(
        f"friction {mu[0]:g} and {mu[1]:g}, {mass[1]:g} kg on {weight(mass[0])}, pass by pass: "
        + "; ".join(map(say_pass, passes))
    )
    (x, y), total, totals = normal, 0.0, []
    world, contact, a, b = press(lab, mu, mass, normal)
    for jn, slip, closing in passes:
        lab.put(contact, jn=jn)
        lab.put(a, vel=STILL)
        lab.put(b, vel=(-slip * y - closing * x, slip * x - closing * y))
        lab.tell(world, "solve_contact", contact, STEP)
        vel = lab.state(b).vel
        total += mass[1] * (vel.y * x - vel.x * y - slip)
        totals.append(total)
    k = exact.inverse(mass[0]) + exact.inverse(mass[1])
    lab.saw("friction", (mu, k, tuple(passes)), tuple(totals))
    return tuple(totals)


def weight(mass: float) -> str:
    return f"{mass:g} kg" if mass else "a static body"


def say_pass(each: Rubbing) -> str:
    words = f"jn {each.jn:g} kg px/s, slip {each.slip:g} px/s"
    return f"{words}, closing {each.closing:g} px/s" if each.closing else words


def say(totals: tuple[float, ...]) -> str:
    return ", then ".join(f"{total + 0.0:.6g}" for total in totals) + " kg px/s"


def want_exact(lab: Lab, mu: Pair, mass: Pair, passes: list[Rubbing], normal: Pair = DOWN) -> None:
    answer = rub(lab, mu, mass, passes, normal)
    k = exact.inverse(mass[0]) + exact.inverse(mass[1])
    right = exact.friction_totals(mu, k, passes)
    # Rounding is relative to the momenta that go into the totals.
    size = 1.0 + sum(p.jn + mass[1] * (abs(p.slip) + abs(p.closing)) for p in passes)
    lab.want(
        all(abs(a - b) <= 1e-9 * size for a, b in zip(answer, right, strict=True)),
        f"a friction impulse of {say(right)} in total",
        say(answer),
    )


def friction_stops_at_its_limit_both_ways(lab: Lab) -> None:
    """Friction stops at its limit, whichever way a body slips"""
    for slip in (300.0, -300.0):  # a mistake in one way alone is told by both, so ask both first
        rub(lab, ROUGH, ON_A_FLOOR, [Rubbing(20.0, slip)])
    for slip in (300.0, -300.0):
        want_exact(lab, ROUGH, ON_A_FLOOR, [Rubbing(20.0, slip)])
        want_exact(lab, ROUGH, (3.0, 2.0), [Rubbing(50.0, slip)], (0.6, 0.8))


def the_limit_takes_the_friction_of_both_bodies(lab: Lab) -> None:
    """The limit is the geometric mean of both frictions, times jn"""
    for mu in ((0.9, 0.4), (0.4, 0.9), (0.2, 0.8)):
        want_exact(lab, mu, ON_A_FLOOR, [Rubbing(20.0, 300.0)])
    want_exact(lab, (0.9, 0.4), ON_A_FLOOR, [Rubbing(0.0, 300.0, closing=100.0)])


def the_total_of_all_passes_is_limited(lab: Lab) -> None:
    """The total of all passes is limited, not the change in one"""
    again = Rubbing(20.0, 300.0)
    want_exact(lab, ROUGH, ON_A_FLOOR, [again, again, again])
    want_exact(lab, ROUGH, ON_A_FLOOR, [again, Rubbing(20.0, -300.0), Rubbing(5.0, 0.0)])


def within_the_limit_friction_ends_the_slip(lab: Lab) -> None:
    """Friction that stays within its limit ends the slip"""
    for slip in (30.0, -30.0):
        want_exact(lab, ROUGH, ON_A_FLOOR, [Rubbing(500.0, slip), Rubbing(500.0, 0.0)])


def nothing_rubs_on_ice_or_without_pressure(lab: Lab) -> None:
    """Ice hardly rubs, and bodies that part do not rub at all"""
    for slip in (300.0, -300.0):
        for mu in ((0.05, 0.05), (0.0, 0.0), (0.0, 0.8)):
            want_exact(lab, mu, ON_A_FLOOR, [Rubbing(20.0, slip)])
        want_exact(lab, ROUGH, ON_A_FLOOR, [Rubbing(20.0, slip, closing=-100.0)])


@given(mu_a=frictions, mu_b=frictions, mass=masses, passes=rubbings, normal=units)
def any_passes_add_up_to_a_friction_within_the_limit(
    lab: Lab, mu_a: float, mu_b: float, mass: float, passes: list[Rubbing], normal: Pair
) -> None:
    """Any passes add up to a friction within the limit"""
    want_exact(lab, (mu_a, mu_b), (0.0, mass), passes, normal)


@given(mass_a=masses_or_static, mass_b=masses, vel_a=velocities, vel_b=velocities, jn=impulses)
def no_contact_pulls_or_creates_energy(
    lab: Lab, mass_a: float, mass_b: float, vel_a: Pair, vel_b: Pair, jn: float
) -> None:
    """No contact pulls, creates energy or momentum, or moves a static body"""
    mass, vel_a = (mass_a, mass_b), vel_a if mass_a else STILL
    lab.ran(
        f"one pass, jn {jn:g} kg px/s: A {weight(mass_a)}, {vel_a} px/s; "
        f"B {weight(mass_b)}, {vel_b} px/s"
    )
    world, contact, a, b = press(lab, ROUGH, mass, (0.6, 0.8))
    lab.put(contact, jn=jn)
    lab.put(a, vel=vel_a)
    lab.put(b, vel=vel_b)
    before = lab.state(a), lab.state(b)
    lab.tell(world, "solve_contact", contact, STEP)
    after = lab.state(a), lab.state(b)
    pressed, rubbed = (lab.number(lab.get(contact, name), name) for name in ("jn", "jt"))
    lab.want(
        pressed >= 0 and abs(rubbed) <= 0.5 * pressed * (1 + 1e-9),
        "jn not negative, and jt at most 0.5 jn either way",
        f"jn {pressed:.4f}, jt {rubbed:.4f} kg px/s",
    )
    had, has = energy(mass, before), energy(mass, after)
    lab.want(has <= had * (1 + 1e-9), f"no more energy than before: {had:.6g}", f"{has:.6g}")
    if not mass_a:
        lab.want(after[0] == before[0], "a static body exactly where it was, at rest", "it moved")
    else:
        shift = math.dist(momentum(mass, before), momentum(mass, after))
        size = mass_a * math.hypot(*vel_a) + mass_b * math.hypot(*vel_b)
        lab.want(shift <= 1e-9 * size, "the momentum kept", f"{shift:.4g} kg px/s more or less")


def energy(mass: Pair, bodies: tuple[BodyValue, BodyValue]) -> float:
    """Kinetic energy of bodies that do not turn, kg px²/s²."""
    return sum(0.5 * m * math.hypot(*body.vel) ** 2 for m, body in zip(mass, bodies, strict=True))


def momentum(mass: Pair, bodies: tuple[BodyValue, BodyValue]) -> Pair:
    a, b = (body.vel for body in bodies)
    return mass[0] * a.x + mass[1] * b.x, mass[0] * a.y + mass[1] * b.y


def every_contact_of_a_pile_keeps_within_its_friction(lab: Lab) -> None:
    """In a pile every contact keeps within its friction, and none pulls"""
    lab.ran("a ball with a spin of 40 rad/s on two others on a large static ball, for one second")
    ground = lab.circle((0.0, 1000.0), 1000.0, 0.0, friction=0.2)
    left = lab.circle((-10.0, -9.5), RADIUS, friction=0.3)
    right = lab.circle((10.0, -9.5), RADIUS, 3.0, friction=0.1)
    top = lab.circle((0.0, -26.5), RADIUS, 2.0, friction=0.5, omega=40.0)
    world = lab.world(ground, left, right, top, gravity=(0.0, 980.0))
    steps = lab.simulate(world, [top], 120, contacts=True).contacts
    for row in [row for contacts in steps for row in contacts]:
        lab.want(
            row.jn >= 0 and abs(row.jt) <= row.limit * (1 + 1e-9),
            "jn not negative, and jt at most sqrt(mu_a mu_b) jn either way, at every contact",
            f"jn {row.jn:.4f}, jt {row.jt:.4f}, its limit {row.limit:.4f} kg px/s",
        )


def a_sliding_block_stops_when_friction_has_eaten_its_speed(lab: Lab) -> None:
    """A sliding block slows down evenly, stops, and stays where it is"""
    lab.ran("2 kg sliding at 150 px/s on a floor, friction 0.5 on both, gravity 980 px/s²")
    world, contact, _, block = press(lab, ROUGH, ON_A_FLOOR, DOWN)
    speed = 150.0
    for number in range(1, 46):
        lab.put(contact, jn=0.0, jt=0.0)
        lab.put(block, vel=(speed, -980.0 * STEP))
        lab.tell(world, "solve_contact", contact, STEP)
        speed, right = lab.state(block).vel.x, max(150.0 - 0.5 * 980.0 * STEP * number, 0.0)
        lab.want(
            math.isclose(speed, right, rel_tol=1e-9, abs_tol=1e-9),
            f"{right:.3f} px/s after {number / 120:.3f} s: 490 px/s less in each second, then 0",
            f"{speed:.3f} px/s",
        )
