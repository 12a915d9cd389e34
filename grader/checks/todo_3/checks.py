"""TODO 3: DistanceJoint.solve, the rod between two bodies."""

import math
from itertools import product
from typing import NamedTuple

from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.digits import A_AND_B, say, want_answer
from grader.checks.exact import BETA, Rod
from grader.checks.strategies import any_spins, any_surface, directions, lengths, masses
from grader.judge.asking import Judge
from grader.judge.drawing import given
from grader.judge.lab import STEP, Lab, Moment, Pair, Thing
from grader.protocol import BodyValue, Value

ANGLES = (0.703125, -2.40625)  # rad, by which A and B are turned
Ends = tuple[BodyValue, BodyValue]  # A and B
Surface = dict[str, float]
SMOOTH = {"restitution": 0.96875, "friction": 0.015625}
ROUGH = {"restitution": 0.015625, "friction": 1.53125}
A_HAIR = 1 / 512  # px: with such a small error the ends part at 0.05 px/s
FAR_AWAY = (2304.0, -1088.0)  # px, where A is
MANY = 55  # rods on either side: enough to find a fault in one call of a hundred
STILL, SLOW, FAST = (0.0, 0.0), (20.0, -10.0), (100.0, 60.0)  # px/s


class Joined(NamedTuple):
    """A prepared joint and its bodies."""

    joint: Thing
    a: Thing
    b: Thing


def join(
    lab: Lab,
    rod: Rod,
    spins: Pair = STILL,
    at: Pair = STILL,
    surfaces: tuple[Surface, Surface] = (ROUGH, SMOOTH),
) -> Joined:
    (x, y), (dx, dy), (first, second) = at, rod.offset, surfaces
    a = lab.circle(at, 10.0, rod.mass_a, vel=rod.vel_a, omega=spins[0], angle=ANGLES[0], **first)
    at_first = (x + rod.length, y)
    b = lab.circle(
        at_first, 10.0, rod.mass_b, vel=rod.vel_b, omega=spins[1], angle=ANGLES[1], **second
    )
    joint = lab.make("DistanceJoint", a, b)
    lab.put(b, pos=(x + dx, y + dy))
    lab.let(joint, "prepare", rod.dt)
    return Joined(joint, a, b)


def solve(lab: Lab, joined: Joined, rod: Rod) -> Ends:
    """Return A and B after a pass over a newly prepared rod."""
    tell_solve(lab, joined, rod)
    return read_ends(lab, joined, rod)


def tell_solve(lab: Lab, joined: Joined, rod: Rod, then: Judge | None = None) -> None:
    """Call solve, which may change the velocities of ends that can move, and nothing else."""
    joint, *ends = joined
    may = {end: "vel" for end, mass in zip(ends, rod[:2], strict=True) if mass}
    lab.tell(joint, "solve", changes=may, sees=ends, noted=("rod", (rod,)), then=then)


def read_ends(lab: Lab, joined: Joined, rod: Rod) -> Ends:
    """Return A and B, which came with the answer."""
    ends = lab.state(joined.a), lab.state(joined.b)
    offset = ends[1].pos.x - ends[0].pos.x, ends[1].pos.y - ends[0].pos.y
    lab.saw("rod", (rod,), (*velocities(ends), offset))
    return ends


def in_px(pair: Pair) -> str:
    return f"({pair[0]:g}, {pair[1]:g}) px"


def weight(mass: float) -> str:
    return f"{mass:g} kg" if mass else "static"


def velocities(ends: Ends) -> tuple[Pair, Pair]:
    (ax, ay), (bx, by) = (end.vel for end in ends)
    return (ax, ay), (bx, by)


def want_exact(lab: Lab, rod: Rod, at: Pair = STILL) -> None:
    """Insist on the right velocities after a pass over a similar rod."""
    rod = make_similar(lab, rod)
    lab.ran(
        f"solve on a rod {rod.length:g} px long at 1/{1 / rod.dt:g} s: "
        f"A {weight(rod.mass_a)}, {rod.vel_a} px/s; B {weight(rod.mass_b)}, {rod.vel_b} px/s, "
        f"{in_px(rod.offset)} from A"
    )
    joined = join(lab, rod, at=at)

    def judge(_: Value) -> None:
        answer, right = velocities(read_ends(lab, joined, rod)), exact.solve_rod(rod)
        most = rounding(rod, math.hypot(*at))
        good = all(math.dist(*each) <= most for each in zip(answer, right, strict=True))
        want_answer(lab, good, A_AND_B, right, answer)

    tell_solve(lab, joined, rod, then=judge)


def rounding(rod: Rod, far: float = 0.0) -> float:
    """Return the tolerance of a speed, px/s, for a rod at most `far` px away.

    Far from the origin, rounding affects a short rod's direction and the speed along it.
    """
    distance = math.hypot(*rod.offset)
    measured = BETA / rod.dt * (rod.length + distance + far)
    speed = math.hypot(*rod.vel_a) + math.hypot(*rod.vel_b)
    return 1e-12 * (1000.0 + measured + speed * (1.0 + far / distance))


def make_similar(lab: Lab, rod: Rod) -> Rod:
    """Return a rod of similar length, masses and speeds; same relative error."""
    size, fast = lab.about(1.0), lab.about(1.0)
    (x, y), (ax, ay), (bx, by) = rod.offset, rod.vel_a, rod.vel_b
    return Rod(
        lab.about(rod.mass_a),
        lab.about(rod.mass_b),
        size * rod.length,
        (size * x, size * y),
        (fast * ax, fast * ay),
        (fast * bx, fast * by),
        rod.dt,
    )


def a_stretched_rod_pulls_its_ends_together(lab: Lab) -> None:
    """A stretched rod pulls its ends together"""
    want_exact(lab, Rod(3.0, 1.0, 50.0, (60.0, 0.0), STILL, STILL, STEP))
    want_exact(lab, Rod(1.0, 4.0, 80.0, (-60.0, 80.0), SLOW, FAST, STEP), at=FAR_AWAY)
    want_exact(lab, Rod(1.0, 4.0, 0.0, (-3.0, 4.0), SLOW, FAST, STEP))
    want_exact(lab, Rod(3.0, 1.0, 50.0, (0.0, A_HAIR + 50.0), SLOW, FAST, STEP))
    # A static end can still have a speed, as on a moving belt.
    want_exact(lab, Rod(0.0, 2.0, 50.0, (60.0, 0.0), SLOW, FAST, STEP))


def a_squeezed_rod_pushes_its_ends_apart(lab: Lab) -> None:
    """A squeezed rod pushes its ends apart"""
    want_exact(lab, Rod(3.0, 1.0, 50.0, (40.0, 0.0), STILL, STILL, STEP))
    want_exact(lab, Rod(1.0, 4.0, 120.0, (60.0, -80.0), SLOW, FAST, STEP))
    want_exact(lab, Rod(3.0, 1.0, 50.0, (0.0, A_HAIR - 50.0), SLOW, FAST, STEP))
    ends_in_one_place_part(lab)


def ends_in_one_place_part(lab: Lab) -> None:
    """Insist that the ends part, in any direction; `prepare` has set the axis."""
    rod = make_similar(lab, Rod(3.0, 1.0, 50.0, STILL, SLOW, SLOW, STEP))
    lab.ran(f"solve on a rod {rod.length:g} px long whose ends are in one place, both {SLOW} px/s")
    joint, a, b = join(lab, rod)
    lab.tell(joint, "solve", changes={a: "vel", b: "vel"}, sees=(a, b))
    vel_a, vel_b = velocities((lab.state(a), lab.state(b)))
    after, right = rod._replace(vel_a=vel_a, vel_b=vel_b), BETA / rod.dt * rod.length
    apart = abs(math.dist(vel_a, vel_b) - right) <= 1e-9 * right
    kept = math.dist(after.momentum, rod.momentum) <= 1e-9 * right
    lab.want(
        apart and kept,
        f"B leaves A at bias, {right:g} px/s, and the momentum is as before",
        say(A_AND_B, (vel_a, vel_b), 3),
    )


def a_rod_of_the_right_length_stops_only_the_speed_along_it(lab: Lab) -> None:
    """A rod of the right length stops the speed along it and no other"""
    for vel_a, vel_b in ((SLOW, FAST), (FAST, SLOW), (STILL, (0.5, 0.25))):
        for both in ((3.0, 1.0), (2.0, 2.0)):
            want_exact(lab, Rod(*both, 50.0, (30.0, 40.0), vel_a, vel_b, STEP))
    rod = make_similar(lab, Rod(3.0, 1.0, 50.0, (30.0, 40.0), FAST, FAST, STEP))
    joint, *ends = joined = join(lab, rod)
    solve(lab, joined, rod)
    lab.ran("solve on a rod whose ends move alike, then a second under gravity (0, 60)")
    world = lab.world(*ends, joints=[joint], gravity=(0.0, 60.0))
    last = lab.simulate(world, ends, 120, every=120)
    left = [(each.vx, each.vy) for each in (last.body(0)[-1], last.body(1)[-1])]
    falling = rod.vel_a[0], rod.vel_a[1] + 60.0
    alike = all(math.dist(each, falling) <= 1e-6 for each in left)
    meaning = "Each end needs a velocity of its own."
    want_answer(lab, alike, A_AND_B, (falling, falling), left, meaning=meaning)


STRAINS = 0.0, 0.25, -0.25, 1 / 1024, -1 / 1024  # of the length
SPEEDS = ((0.0, 0.0), (60.0, -20.0)), ((-35.0, 50.0), (0.0, 0.0)), ((0.25, 8.0), (0.5, -9.0))
OFF = math.sin(1 / 64), math.cos(1 / 64)  # nearly vertical axes
DIRECTIONS = (
    (0.6, 0.8),
    (-0.8, 0.6),
    OFF,
    (-0.28, -0.96),
    (0.96, -0.28),
    (OFF[1], -OFF[0]),
    (0.0, 1.0),
)
BOTH, ONLY_A, ONLY_B = (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)  # of the masses that were drawn
WEIGHTS = 1.0, 4096.0, 1 / 1024  # times the mass
STEPS = STEP, 1 / 30, 1 / 60, 1 / 480, 1 / 1000, 1.0  # s


@given(
    examples=2,
    masses=st.tuples(masses, masses),
    length=lengths,
    nearly=directions(),
    faster=st.integers(1, 64).map(lambda n: n / 8),
    spins=st.tuples(any_spins, any_spins),
    surfaces=st.tuples(any_surface, any_surface),
)
def any_rod_reaches_its_speed_and_keeps_the_momentum(
    lab: Lab,
    masses: Pair,
    length: float,
    nearly: Pair,
    faster: float,
    spins: Pair,
    surfaces: tuple[Surface, Surface],
) -> None:
    """Any rod gets the right speed and keeps the momentum; a static end stays"""
    for n, (strain, kind) in enumerate(product(STRAINS, (BOTH, ONLY_A, ONLY_B, BOTH))):
        (x, y), weight = (nearly if n == 7 else DIRECTIONS[n % 7]), WEIGHTS[n % 3]
        vel_a, vel_b = (
            (faster * u, faster * v) if there else STILL
            for (u, v), there in zip(SPEEDS[n % 3], kind, strict=True)
        )
        size = length * (256.0 if n % 5 == 4 else 1.0)
        far, dt = size * (1 + strain), STEPS[n % 6]
        mass_a, mass_b = (weight * m * each for m, each in zip(masses, kind, strict=True))
        rod = Rod(mass_a, mass_b, size, (far * x, far * y), vel_a, vel_b, dt)
        want_passes(lab, rod, spins, surfaces)
    shared = Rod(*masses, length, (0.8 * length, 0.4 * length), (20.0, 3.0), (-9.0, 40.0), STEP)
    for end, turned in ((masses[0], False), (0.0, True)):
        other = Rod(masses[1], end, 40.0, (-31.5, 27.0), (-9.0, 40.0), STILL, STEP)
        want_both_rods(lab, shared, other, turned)


def want_passes(lab: Lab, rod: Rod, spins: Pair, surfaces: tuple[Surface, Surface]) -> None:
    """Insist on the speed, the momentum and a static end at rest after each of two passes."""
    lab.ran(f"2 x solve at 1/{1 / rod.dt:g} s on a rod, {describe(rod)}")
    still = (spins[0] * (rod.mass_a > 0), spins[1] * (rod.mass_b > 0))
    joined = join(lab, rod, still, surfaces=surfaces)
    for _ in range(2):
        ends = solve(lab, joined, rod)
        vel_a, vel_b = velocities(ends)
        want_solved(lab, rod, vel_a, vel_b, 0.0)
        rod = rod._replace(vel_a=vel_a, vel_b=vel_b)
    for end, mass, place in zip(ends, (rod.mass_a, rod.mass_b), (STILL, rod.offset), strict=True):
        lab.want(
            mass > 0 or (*end.pos, *end.vel, end.omega) == (*place, 0.0, 0.0, 0.0),
            f"the static end exactly at {in_px(place)}, at rest",
            f"at ({end.pos.x!r}, {end.pos.y!r}), speed ({end.vel.x!r}, {end.vel.y!r}) px/s",
        )


def want_both_rods(lab: Lab, rod: Rod, other: Rod, turned: bool) -> None:
    """Insist on the right speeds in three passes over two rods that share a ball."""
    lab.ran(f"3 x solve on two rods that share a ball: {describe(rod)}; {describe(other)}")
    joined = join(lab, rod)
    (x, y), (_, a, b) = rod.offset, joined
    c = lab.circle((x + other.length, y), 10.0, other.mass_b, vel=other.vel_b)
    ends, meant = ((c, b), other.with_swapped_ends) if turned else ((b, c), other)
    second = Joined(lab.make("DistanceJoint", *ends), *ends)
    lab.put(c, pos=(x + other.offset[0], y + other.offset[1]))
    lab.let(second.joint, "prepare", rod.dt)
    vel = {a: rod.vel_a, b: rod.vel_b, c: other.vel_b}
    far = math.hypot(x, y) + math.hypot(*other.offset)
    for _ in range(3):
        for each, usual, away in ((joined, rod, 0.0), (second, meant, far)):
            now = usual._replace(vel_a=vel[each.a], vel_b=vel[each.b])
            vel[each.a], vel[each.b] = velocities(solve(lab, each, now))
            want_solved(lab, now, vel[each.a], vel[each.b], away)


def describe(rod: Rod) -> str:
    return (
        f"one {rod.length:g} px long from {weight(rod.mass_a)}, {rod.vel_a} px/s, to "
        f"{weight(rod.mass_b)}, {rod.vel_b} px/s, {in_px(rod.offset)} away"
    )


def want_solved(lab: Lab, rod: Rod, vel_a: Pair, vel_b: Pair, far: float) -> None:
    """Insist that the ends part at bias and keep their momentum in a pass."""
    after = rod._replace(vel_a=vel_a, vel_b=vel_b)
    if rod.mass_a and rod.mass_b:
        off = math.dist(after.momentum, rod.momentum)
        kept = off <= rounding(rod, far) * (rod.mass_a + rod.mass_b)
        words, unit = "a momentum of {}, as before", "({:.{n}f}, {:.{n}f}) kg px/s"
        want_answer(lab, kept, unit, rod.momentum, after.momentum, expected=words)
    reached = abs(after.speed - rod.bias) <= rounding(rod, far)
    words = "B leaves A at bias, {} along the rod, after any number of passes"
    want_answer(lab, reached, "{:.{n}f} px/s", rod.bias, after.speed, expected=words)


def nothing_happens_where_no_end_can_move(lab: Lab) -> None:
    """solve does nothing if neither end can move, and works if one can"""
    lab.ran("solve on a stretched rod after inv_mass and inv_inertia of both ends were set to 0")
    rod = make_similar(lab, Rod(3.0, 1.0, 50.0, (60.0, 0.0), (5.0, 0.0), (0.0, 7.0), STEP))
    joint, *ends = joined = join(lab, rod, (2.0, -3.0))
    for end in ends:
        lab.put(end, inv_mass=0.0, inv_inertia=0.0)
    lab.let(joint, "prepare", STEP)
    left = velocities(solve(lab, joined, rod._replace(mass_a=0.0, mass_b=0.0)))
    before = rod.vel_a, rod.vel_b
    want_answer(lab, left == before, A_AND_B, before, left)
    for n in range(-MANY, MANY):  # it does work if they can; k near 0.5, the usual value
        heavy = 4.0 + (n + 0.5) / 128
        want_exact(lab, Rod(4.0, heavy, 50.0, (n / 8, 40.0), SLOW, FAST, STEP))


# ---------------------------------------------------------------- what a player sees


def swing(
    lab: Lab, start: Pair, mass: float, gravity: float, seconds: float
) -> tuple[list[Moment], float]:
    """Return the bob of a pendulum after each step, and its length; its hook is at (0, 0)."""
    hook, bob = lab.circle(STILL, 6.0, 0.0), lab.circle(start, 24.0, mass)
    joint = lab.make("DistanceJoint", hook, bob)
    world = lab.world(hook, bob, gravity=(0.0, gravity), joints=[joint])
    return lab.simulate(world, [bob], round(seconds / STEP)).body(0), math.hypot(*start)


def want_length(lab: Lab, lengths: list[float], right: float, within: float = 1.0) -> None:
    """Insist on this length, within a pixel, in every step.

    A step at speed v along the circle stretches a rod by v² dt² / 2L; the bias takes back 0.2 of
    it. The stretch settles at v² dt² / 0.4L, below 0.8 px for the fastest bob.
    """
    lab.want(
        max(abs(length - right) for length in lengths) < within,
        f"its length within {within:g} px of {right:g} px in every step",
        f"from {min(lengths):.2f} to {max(lengths):.2f} px",
    )


def a_pendulum_swings_to_the_other_side(lab: Lab) -> None:
    """A bob let go beside its hook swings below it to the other side"""
    mass, length = lab.about(6.0), lab.about(140.0)
    lab.ran(f"a bob of {mass:g} kg let go {length:g} px beside its hook, gravity 980, 2 seconds")
    bob, right = swing(lab, (length, 0.0), mass, 980.0, 2.0)
    want_length(lab, [math.hypot(each.x, each.y) for each in bob], right, within=2.0)
    lowest, leftmost = max(each.y for each in bob), min(each.x for each in bob)
    lab.want(
        lowest > 0.95 * length and leftmost < -0.9 * length,
        f"it passes ({0:g}, {length:g}) and turns back near ({-length:g}, 0)",
        f"its lowest point is {lowest:.0f} px below, its leftmost {-leftmost:.0f} px to the left",
    )


def a_pendulum_that_starts_above_keeps_its_length(lab: Lab) -> None:
    """A pendulum let go above its hook keeps its length"""
    mass, size = lab.about(2.0), lab.about(1.0)
    gravity = size * 980.0
    lab.ran(
        f"a bob of {mass:g} kg let go {size * 112:g} px above and {size * 84:g} px beside its "
        f"hook, gravity {gravity:g} px/s², for one second"
    )
    bob, length = swing(lab, (size * 84, size * -112), mass, gravity, 1.0)
    want_length(lab, [math.hypot(each.x, each.y) for each in bob], length)
    # A quarter of its period is K(sin 71.6°) sqrt(length / gravity), or 0.97 s.
    lowest = max(each.y for each in bob)
    lab.want(
        lowest > 0.93 * length,
        f"it swings through the lowest point of its circle, {length:g} px below the hook",
        f"it comes to {lowest:.1f} px below the hook at most",
    )


def a_thrown_dumbbell_turns_about_its_centre_of_mass(lab: Lab) -> None:
    """Two balls on a rod turn about their centre of mass"""
    masses, length = (lab.about(3.0), lab.about(1.0)), lab.about(100.0)
    lab.ran(
        f"balls of {masses[0]:g} and {masses[1]:g} kg on a rod of {length:g} px, thrown to spin in "
        "place, for half a second"
    )
    balance = length * masses[1] / sum(masses)  # of the two, px from the first one
    # Each as fast as 4 rad/s need: the momentum is 0.
    first = lab.circle((0.0, 0.0), 10.0, masses[0], vel=(0.0, -4.0 * balance))
    second = lab.circle((length, 0.0), 10.0, masses[1], vel=(0.0, 4.0 * (length - balance)))
    joint = lab.make("DistanceJoint", first, second)
    run = lab.simulate(lab.world(first, second, joints=[joint]), [first, second], 60)
    places = [[(each.x, each.y) for each in run.body(number)] for number in (0, 1)]
    want_length(lab, [math.dist(a, b) for a, b in zip(*places, strict=True)], length)
    ends = places[0][-1], places[1][-1]
    (ax, ay), (bx, by) = ends
    angle = math.atan2(by - ay, bx - ax)
    lab.want(
        abs(angle - 2.0) < 0.1,
        "the rod turned by 2 rad in half a second",
        f"it is at {angle:.2f} rad",
    )
    centre = tuple(
        (masses[0] * a + masses[1] * b) / sum(masses) for a, b in zip(*ends, strict=True)
    )
    # The momentum stays 0; a step adds rounding only.
    lab.want(
        math.dist(centre, (balance, 0.0)) <= 1e-6,
        f"the centre of mass still at ({balance:g}, 0)",
        f"it is at ({centre[0]:.3f}, {centre[1]:.3f})",
    )
