"""TODO 4: friction within its limit.

Two touching discs approach and slip in one step of a world. Nothing bounces, so the limit follows
from the speeds. No number depends on TODO 2, since no impulse turns them.
"""

import math
from collections.abc import Iterator
from itertools import product
from operator import add

from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.digits import A_AND_B, want_answer
from grader.checks.exact import Discs
from grader.checks.strategies import (
    damped_steps,
    directions,
    low_speeds,
    masses,
    radii,
    some_frictions,
    velocities,
)
from grader.judge.drawing import between, given
from grader.judge.lab import STEP, Lab, Pair, Run, Thing

ASLANT, STILL = (0.6, 0.8), (0.0, 0.0)
ROUGH = (0.5, 0.5)
ON_A_FLOOR = Discs(ROUGH, (2.0, 0.0), (0.0, 1.0))  # as a ball that collides with a box: it is A
ON_A_PEG = Discs(ROUGH, (0.0, 2.0), (0.0, -1.0))  # A is static
IN_THE_AIR = Discs(ROUGH, (3.0, 2.0), ASLANT, (12.0, 7.0), (40.0, -25.0))
DEPTH = 0.265625  # px, too little for a push out of the overlap
FAST, SLOW = 300.0, 1.5  # px/s
CLOSING = 12.5  # px/s
FAR, FREE = (8192.0, -4096.0), 64.0  # px and px/s, of a disc that touches nothing
RATES = (0.0, 1.0)  # damping rates; a wrong TODO 5 may stop all bodies at the first
LEAST_KEPT = 1e-3  # share of a speed that a step must keep so that friction can be seen
ALL = "pos vel angle omega"  # of a disc that moves
Motion = tuple[float, ...]  # velocities of A and B, px/s


# ---------------------------------------------------------------- one step of two discs


def rub(
    lab: Lab, discs: Discs, closing: float, slip: float, dt: float = STEP, spin: float = 0.0
) -> tuple[float, float]:
    """Return the friction impulse on B along its slip, and the share of speed a free disc keeps.

    With a `spin`, also check everything else. Engines may place the contact anywhere in the
    overlap, so spins come with more slip than friction can end. The free disc measures damping,
    which belongs to TODO 5.
    """
    lab.ran(
        f"a step of two discs, friction {discs.mu[0]:g} and {discs.mu[1]:g}: "
        f"{weight(discs.mass[1])} closes in on {weight(discs.mass[0])} at {closing:g} px/s and "
        f"slips at {slip:g} px/s"
    )
    rims = sum(radius for radius, mass in zip(discs.radius, discs.mass, strict=True) if mass)
    first = make_velocities(discs, closing, slip + spin * rims)
    for rate in RATES:
        a, b = place_discs(lab, discs, first, spin)
        free = lab.circle(FAR, vel=(FREE, 0.0), omega=spin)
        world = lab.world(a, b, free, linear_damping=rate, angular_damping=rate)
        moving = [free, *(each for each, mass in zip((a, b), discs.mass, strict=True) if mass)]
        changes = {world: "contacts", **dict.fromkeys(moving, ALL)} if spin else None
        lab.tell(world, "step", dt, changes=changes, sees=(a, b, free))
        kept = lab.state(free).vel.x / FREE
        if kept > LEAST_KEPT:
            break
    kept = kept if LEAST_KEPT < kept < 2.0 else 1.0
    first = tuple(kept * each for each in first)
    closing, slip = kept * closing, kept * slip
    last = (*lab.state(a).vel, *lab.state(b).vel)
    rubbing = measure_friction(discs, first, last)
    want_opposite(lab, discs, first, last, max(closing / discs.k, 0.0), rubbing)
    if not spin:
        lab.saw("friction", (discs.mu, discs.k, closing, slip), rubbing)
    else:
        spins = [lab.state(each).omega for each in moving]
        want_contact(lab, world, discs, max(closing / discs.k, 0.0), rubbing)
        words = f"a spin of {spins[0]:g} rad/s, as of a disc that touches nothing"
        lab.want(len(set(spins)) == 1, words, " and ".join(f"{each:g}" for each in spins[1:]))
    return rubbing, kept


def place_discs(lab: Lab, discs: Discs, first: Motion, spin: float) -> tuple[Thing, Thing]:
    """Return two discs that overlap by DEPTH, with these velocities; movable ones spin."""
    (x, y), reach = discs.normal, sum(discs.radius) - DEPTH
    places = STILL, (reach * x, reach * y)
    same = {"restitution": 0.0, "inv_inertia": 0.0}
    columns = places, discs.radius, discs.mass, discs.mu, (first[:2], first[2:])
    a, b = (
        lab.circle(place, radius, mass, friction=mu, vel=vel, omega=spin * (mass > 0), **same)
        for place, radius, mass, mu, vel in zip(*columns, strict=True)
    )
    return a, b


def make_velocities(discs: Discs, closing: float, slip: float) -> Motion:
    """Return velocities with which B approaches A and slips along it; static discs rest."""
    (x, y), (dx, dy) = discs.normal, discs.drift if all(discs.mass) else STILL
    vx, vy = -closing * x - slip * y, -closing * y + slip * x
    return (dx, dy, dx + vx, dy + vy) if discs.mass[1] else (-vx, -vy, 0.0, 0.0)


def measure_friction(discs: Discs, first: Motion, last: Motion) -> float:
    """Return the friction impulse on B between two motions, from the lighter movable disc."""
    (x, y), (mass_a, mass_b) = discs.normal, discs.mass
    if mass_b and not 0 < mass_a < mass_b:
        return mass_b * ((last[3] - first[3]) * x - (last[2] - first[2]) * y)
    return mass_a * ((first[1] - last[1]) * x - (first[0] - last[0]) * y)


def want_opposite(
    lab: Lab, discs: Discs, first: Motion, last: Motion, pressing: float, rubbing: float
) -> None:
    """Insist that the discs no longer approach, and that A got the opposite impulse of B."""
    x, y = discs.normal
    push = pressing * x - rubbing * y, pressing * y + rubbing * x
    a, b = (exact.inverse(mass) for mass in discs.mass)
    changes = -a * push[0], -a * push[1], b * push[0], b * push[1]
    right = tuple(map(add, first, changes))
    size = 1.0 + sum(map(abs, (*first, *last)))  # of what is rounded
    off = max(abs(one - other) for one, other in zip(last, right, strict=True))
    words = "opposite impulses on A and B, and nothing else: {}"
    want_answer(lab, off <= 1e-7 * size, A_AND_B, right, last, expected=words)


def want_contact(lab: Lab, world: Thing, discs: Discs, pressing: float, rubbing: float) -> None:
    """Insist on one unchanged contact with the applied impulses."""
    found = map(lab.contact_or_none, lab.items(lab.get(world, "contacts"), "contacts"))
    contacts = [each for each in found if each is not None]
    lab.want(len(contacts) == 1, "one contact of the two", f"{len(contacts)}")
    c = contacts[0]
    x, y = discs.normal
    lab.want(
        abs(abs(c.normal.x * x + c.normal.y * y) - 1) <= 1e-9 and abs(c.depth - DEPTH) <= 1e-6,
        f"the contact's normal along ({x:g}, {y:g}) and its depth {DEPTH:g} px, as found",
        f"normal ({c.normal.x:g}, {c.normal.y:g}), depth {c.depth:g} px",
    )
    size = 1.0 + pressing + abs(rubbing)
    lab.want(
        abs(c.jn - pressing) <= 1e-6 * size and abs(abs(c.jt) - abs(rubbing)) <= 1e-6 * size,
        f"jn {pressing:.6g} and jt {abs(rubbing):.6g} kg px/s either way, as was applied",
        f"jn {c.jn:.6g}, jt {c.jt:.6g} kg px/s",
    )


def weight(mass: float) -> str:
    return f"{mass:g} kg" if mass else "a static body"


def want_exact(
    lab: Lab, discs: Discs, closing: float, slip: float, dt: float = STEP, spin: float = 0.0
) -> None:
    answer, kept = rub(lab, discs, closing, slip, dt, spin)
    right = exact.friction(discs.mu, discs.k, kept * closing, kept * slip)
    lighter = min(mass for mass in discs.mass if mass)
    size = 1.0 + lighter * (abs(closing) + abs(slip) + sum(map(abs, discs.drift)))
    good = abs(answer - right) <= 1e-7 * size
    words = "a friction impulse of {} on B, along its slip"
    want_answer(lab, good, "{:.{n}f} kg px/s", right, answer, digits=2, expected=words)


def want_about(lab: Lab, discs: Discs, closing: float, slip: float) -> None:
    """Insist on the same result for similar discs."""
    heavy, fast = lab.about(1.0), lab.about(1.0)
    (a, b), (x, y) = discs.mass, discs.drift
    like = discs._replace(mass=(heavy * a, heavy * b), drift=(fast * x, fast * y))
    want_exact(lab, like, fast * closing, fast * slip)


# ---------------------------------------------------------------- one contact


def friction_stops_at_its_limit_both_ways(lab: Lab) -> None:
    """Friction stops at its limit, in both directions and at any speed"""
    for slip in (FAST, -FAST):  # ask both ways first: a mistake in one way shows in the comparison
        rub(lab, ON_A_FLOOR, CLOSING, slip)
    for slip in (FAST, -FAST, 10 * FAST, -10 * FAST):
        want_about(lab, ON_A_FLOOR, CLOSING, slip)
        want_about(lab, ON_A_FLOOR, 2 * CLOSING, slip)
        want_about(lab, IN_THE_AIR, CLOSING, slip)
        want_about(lab, ON_A_FLOOR, -CLOSING, slip)  # separating bodies do not rub
        for normal in ((1.0, 0.0), (-1.0, 0.0), (0.0, -1.0)):  # at walls and from below
            want_about(lab, ON_A_FLOOR._replace(normal=normal), CLOSING, slip)


def the_limit_takes_the_friction_of_both_bodies(lab: Lab) -> None:
    """The limit is the geometric mean of both frictions, times jn"""
    for mu in ((0.9, 0.4), (0.4, 0.9), (0.2, 0.8), (1.5, 0.75), (0.05, 0.05), (0.0, 0.8)):
        for discs, slip in product((ON_A_FLOOR, IN_THE_AIR), (FAST, -FAST)):
            want_about(lab, discs._replace(mu=mu), CLOSING, slip)


def friction_does_not_ask_which_body_is_static(lab: Lab) -> None:
    """A static body rubs as A and as B"""
    for slip in (FAST, -FAST, SLOW, -SLOW):
        for discs in (ON_A_PEG, ON_A_PEG._replace(normal=ASLANT), ON_A_FLOOR):
            want_about(lab, discs, CLOSING, slip)


def within_the_limit_friction_ends_the_slip(lab: Lab) -> None:
    """Friction that stays within its limit ends the slip"""
    slow = IN_THE_AIR._replace(drift=(0.5, -0.25), normal=(200 / 10001, 9999 / 10001))
    for slip in (30.0, -30.0, 5.0625, -5.0625, SLOW, -0.01):
        for discs in (ON_A_FLOOR, IN_THE_AIR, slow):
            want_about(lab, discs, 100.0, slip)


# ---------------------------------------------------------------- every region

KINDS = (1.0, 1.0), (0.0, 1.0), (1.0, 0.0)  # of the masses that were drawn
WEIGHTS = 1.0, 1024.0, 1 / 1024  # times the mass
OFF = math.sin(1 / 64), math.cos(1 / 64)  # nearly vertical normals
NORMALS = (ASLANT, OFF, (-1.0, 0.0), (-0.8, 0.6), (0.0, -1.0), (OFF[1], -OFF[0]), (-0.28, -0.96))
SPINS = 0.0625, -0.0625, 2.0, -2.0  # rad/s
SHARES = 4.0, -4.0, 0.25, -0.25, 63 / 64, -63 / 64, 65 / 64, -65 / 64, 100.0, -100.0


def slips(discs: Discs, closing: float) -> Iterator[float]:
    """Yield slips both ways, px/s: below, at and above the most that friction can end."""
    most = math.sqrt(discs.mu[0] * discs.mu[1]) * closing
    yield from (share * most for share in SHARES)


@given(
    examples=2,
    mu=st.tuples(some_frictions, some_frictions),
    mass=st.tuples(masses, masses),
    radius=st.tuples(radii, radii),
    drift=velocities,
    slow=low_speeds,
    closing=between(8, 240).map(lambda n: n / 8),
    nearly=directions(),
    dt=damped_steps,
)
def any_two_bodies_rub_within_their_limit(
    lab: Lab,
    mu: Pair,
    mass: Pair,
    radius: Pair,
    drift: Pair,
    slow: float,
    closing: float,
    nearly: Pair,
    dt: float,
) -> None:
    """Any two bodies rub within their limit, and nothing else changes"""
    for n, (kind, weight) in enumerate(product(KINDS, WEIGHTS)):
        normal = nearly if n == 4 else NORMALS[n % 7]
        mass_a, mass_b = (weight * m * each for m, each in zip(mass, kind, strict=True))
        rough = (mu, (mu[1], mu[0]), (1.5, 3.0))[n % 3]
        discs = Discs(rough, (mass_a, mass_b), normal, radius, drift)
        if n % 2:
            discs = discs._replace(drift=(slow, -slow))
        for number, slip in enumerate(slips(discs, closing)):
            spin = SPINS[(n + number) % 4]
            ends = math.sqrt(discs.mu[0] * discs.mu[1]) * closing + 2 * DEPTH * abs(spin)
            spin = spin if abs(slip) > ends else 0.0
            want_exact(lab, discs, closing, slip, dt, spin)


# ---------------------------------------------------------------- what a player sees


def every_contact_of_a_pile_keeps_within_its_friction(lab: Lab) -> None:
    """In a pile every contact keeps within its friction, and none pulls"""
    spin, mass = lab.about(40.0), lab.about(2.0)
    lab.ran(
        f"a ball of {mass:g} kg, its spin {spin:g} rad/s, on two others on a large static ball, "
        "for one second"
    )
    ground = lab.circle((0.0, 1000.0), 1000.0, 0.0, friction=0.2)
    left = lab.circle((-10.0, -9.5), 10.0, friction=0.3)
    right = lab.circle((10.0, -9.5), 10.0, 3.0, friction=0.1)
    top = lab.circle((0.0, -26.5), 10.0, mass, friction=0.5, omega=spin)
    world = lab.world(ground, left, right, top, gravity=(0.0, 980.0))
    steps = lab.simulate(world, [top], 120, contacts=True).contacts
    for row in [row for contacts in steps for row in contacts]:
        lab.want(
            row.jn >= 0 and abs(row.jt) <= row.limit * (1 + 1e-9),
            "jn not negative, and jt at most sqrt(mu_a mu_b) jn either way, at every contact",
            f"jn {row.jn:.4f}, jt {row.jt:.4f}, its limit {row.limit:.4f} kg px/s",
        )


def sliding_blocks(lab: Lab, speeds: tuple[float, ...], frictions: tuple[float, ...]) -> Run:
    """Slide blocks of 2 kg and friction 0.5, each on a floor of its own, for half a second."""
    floors = [
        lab.box((0.0, 1000.0 * n), (1000.0, 20.0), friction=mu) for n, mu in enumerate(frictions)
    ]
    still = {"friction": 0.5, "restitution": 0.0, "inv_inertia": 0.0}
    blocks = [
        lab.circle((0.0, 1000.0 * n - 29.75), 10.0, 2.0, vel=(speed, 0.0), **still)
        for n, speed in enumerate(speeds)
    ]
    world = lab.world(*floors, *blocks, gravity=(0.0, 980.0))
    return lab.simulate(world, blocks, 60)


def a_block_slides_and_comes_to_rest(lab: Lab) -> None:
    """A block slides a little and comes to rest, and on ice it slides on"""
    speed = lab.about(200.0, 25.0)
    lab.ran(f"blocks slid at {speed:g} px/s either way on a floor, and on ice, half a second")
    run = sliding_blocks(lab, (speed, -speed, speed), (0.5, 0.5, 0.0))
    for number, way in ((0, 1), (1, -1)):
        last = run.body(number)[-1]
        lab.want(
            way * last.x > 3.0 and abs(last.vx) < speed / 2,
            "a block that has slid some way and slows down",
            f"one that slid {way * last.x:.1f} px, at {last.vx:.0f} px/s",
        )
    ice = run.body(2)[-1].vx
    lab.want(abs(ice - speed) < 1.0, f"{speed:g} px/s on ice", f"{ice:.0f} px/s")


def friction_takes_the_same_speed_in_every_step(lab: Lab) -> None:
    """A sliding block slows down evenly, as friction 0.5 allows, and stops

    Under any seed, the speed before its last step is 3/4 of what friction removes in a step.
    """
    begin = (lab.whole(36, 7) + 0.75) * 0.5 * 980.0 * STEP
    lab.ran(f"2 kg sliding at {begin:.1f} px/s either way on a floor, friction 0.5, half a second")
    run = sliding_blocks(lab, (begin, -begin), (0.5, 0.5))
    for number in range(60):
        right = max(begin - 0.5 * 980.0 * STEP * (number + 1), 0.0)
        speeds = [run.body(n)[number].vx for n in range(2)]
        lab.want(
            abs(speeds[0] - right) <= 2.0 and abs(speeds[1] + right) <= 2.0,
            f"{right:.0f} px/s and {-right:.0f} px/s after {(number + 1) / 120:.3f} s: 490 px/s "
            "less in each second, then 0",
            ", ".join(f"{speed:.0f} px/s" for speed in speeds),
        )
