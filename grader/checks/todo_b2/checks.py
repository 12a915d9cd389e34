"""TODO B2: SpringJoint.apply, a spring's force on the two bodies at its ends."""

import math
import random
from itertools import pairwise
from typing import NamedTuple

from grader.checks import exact
from grader.checks.digits import A_AND_B, want_answer
from grader.checks.exact import Rod, Spring
from grader.checks.todo_3.checks import FAST, SLOW, STILL, make_similar, velocities, weight
from grader.judge.lab import STEP, Lab, Moment, Pair, Thing
from grader.protocol import Value

Ends = tuple[Pair, Pair]  # velocities of A and B, px/s


class Setting(NamedTuple):
    """The other fields of the two ends, which no force depends on."""

    place: Pair = (64.53125, -32.28125)  # px, where A is
    spin: Pair = (2.015625, -3.015625)  # rad/s, of each
    angle: Pair = (-1.03125, 7.28125)  # rad
    friction: Pair = (0.59375, 0.0)
    restitution: Pair = (0.0, 0.28125)

    def of(self, number: int) -> dict[str, float]:
        """Return the fields of one end."""
        names = {"omega": "spin", "angle": "angle", "friction": "friction"}
        names["restitution"] = "restitution"
        return {field: getattr(self, name)[number] for field, name in names.items()}


USUAL = Setting()


def want_exact(lab: Lab, spring: Spring, *later: Rod, setting: Setting = USUAL) -> None:
    """Apply a spring, move its ends and apply it again; insist on the right velocities.

    Its ends spin and are turned, which a spring must not change.
    """
    rod = spring.rod
    a = lab.circle(setting.place, 10.0, rod.mass_a, **setting.of(0))
    b = lab.circle((0.0, 0.0), 5.0, rod.mass_b, **setting.of(1))
    joint = lab.make("SpringJoint", a, b, spring.stiffness, spring.damping, rod.length)
    for each in (rod, *later):
        now = Spring(each, spring.stiffness, spring.damping)
        apply_once(lab, joint, (a, b), now, setting.place)


def want_about(lab: Lab, spring: Spring) -> None:
    """Insist on the same for a spring on a similar rod."""
    stiffness, damping = lab.about(spring.stiffness), lab.about(spring.damping)
    want_exact(lab, Spring(make_similar(lab, spring.rod), stiffness, damping))


def apply_once(
    lab: Lab, joint: Thing, ends: tuple[Thing, Thing], spring: Spring, place: Pair
) -> None:
    (a, b), rod = ends, spring.rod
    lab.ran(
        f"apply for {rod.dt:.4g} s: stiffness {spring.stiffness:.6g} kg/s², damping "
        f"{spring.damping:.6g} kg/s, length {rod.length:.6g} px; A {weight(rod.mass_a)}, "
        f"{in_short(rod.vel_a)} px/s; B {weight(rod.mass_b)}, {in_short(rod.vel_b)} px/s, "
        f"{in_short(rod.offset)} px from A"
    )
    lab.put(a, vel=rod.vel_a)
    lab.put(b, pos=(place[0] + rod.offset[0], place[1] + rod.offset[1]), vel=rod.vel_b)
    # Other changes fail only the check of damped springs, not all checks.
    changes = {a: "vel", b: "vel"} if spring.damping else None

    def judge(_: Value) -> None:
        answer = velocities((lab.state(a), lab.state(b)))
        lab.saw("spring", (spring,), answer)
        right = exact.apply_spring(spring)
        good = are_close(spring, answer, right, math.hypot(*place))
        want_answer(lab, good, A_AND_B, right, answer)

    lab.tell(joint, "apply", rod.dt, changes=changes, sees=(a, b), then=judge)


def are_close(spring: Spring, answer: Ends, right: Ends, far: float) -> bool:
    """Return whether two answers are equal up to rounding, a share of 1e-16 of each term.

    For ends `far` px away, rounding also affects distance and direction.
    """
    rod = spring.rod
    distance = math.hypot(*rod.offset)
    most = (math.hypot(*rod.vel_a) + math.hypot(*rod.vel_b)) * (1.0 + far / distance)  # px/s
    stretch = (distance + rod.length) * (1.0 + far / distance)
    force = spring.stiffness * stretch + spring.damping * most
    sizes = (most + force * rod.dt * exact.inverse(mass) for mass in (rod.mass_a, rod.mass_b))
    return all(
        math.dist(*each) <= 1e-12 * (1.0 + size)
        for *each, size in zip(answer, right, sizes, strict=True)
    )


def in_short(pair: Pair) -> str:
    return f"({pair[0]:.6g}, {pair[1]:.6g})"


def springs(seed: int) -> list[tuple[Spring, Rod, Setting]]:
    """Return a fixed list of springs of every kind, each with a second position of its ends.

    Stiffness, length, masses and steps vary, and one end may be static.
    """
    draw = random.Random(seed)
    found = []
    for number in range(24):
        masses = [10.0 ** draw.uniform(-3, 6) for _ in range(2)]
        if number % 3 < 2:
            masses[number % 3] = draw.choice([0.0, 2.0])
        rest = draw.choice([0.0, 6.515625, 30.0, 79.515625, 100.0, 4000.0])  # px
        dt = draw.choice([1 / 480, 1 / 240, STEP, 1 / 100, 1 / 60, 1 / 30, 0.25])
        now, later = (some_rod(draw, masses, rest, dt) for _ in range(2))
        spring = Spring(now, 10.0 ** draw.uniform(0, 6), 10.0 ** draw.uniform(-2, 3))
        found.append((spring, later, some_setting(draw)))
    return found


def some_setting(draw: random.Random) -> Setting:
    places = [USUAL.place, (-64.53125, 700.25), (3200.40625, 50.0)]
    spins = [*USUAL.spin, 40.0, -25.0, 0.0]
    surfaces = [0.0, 0.28125, 0.59375, 1.0]
    some = [(draw.choice(each), draw.choice(each)) for each in (spins, surfaces, surfaces)]
    return Setting(draw.choice(places), some[0], USUAL.angle, *some[1:])


def some_rod(draw: random.Random, masses: list[float], rest: float, dt: float) -> Rod:
    """Return moving ends of a squeezed or stretched spring of this length, at any position."""
    turn = draw.uniform(0, 2 * math.pi)
    distance = max(rest, 1.0) * draw.choice([0.25, 0.999, 1.0625, 2.0, 8.0])
    offset = distance * math.cos(turn), distance * math.sin(turn)
    most = draw.choice([1 / 2, 500.0, 500.0, 9000.0])  # px/s
    vel_a, vel_b = (
        (draw.uniform(-most, most), draw.uniform(-most, most)) if mass else STILL for mass in masses
    )
    return Rod(masses[0], masses[1], rest, offset, vel_a, vel_b, dt)


def a_stretched_spring_pulls_and_a_squeezed_one_pushes(lab: Lab) -> None:
    """A stretched spring pulls, a squeezed one pushes, each end by its mass"""
    for length in (50.0, 140.0):
        want_about(lab, Spring(Rod(3.0, 1.0, length, (60.0, 80.0), STILL, STILL, STEP), 120.0, 0.0))
    want_about(lab, Spring(Rod(0.0, 2.0, 80.0, (-60.0, 0.0), STILL, FAST, 2 * STEP), 90.0, 0.0))
    want_about(lab, Spring(Rod(2.0, 0.0, 30.0, (0.0, -50.0), SLOW, STILL, STEP), 90.0, 0.0))
    want_about(lab, Spring(Rod(2.0, 3.0, 50.0, (62.2, 0.0), SLOW, SLOW, 1 / 100), 82.0, 0.0))
    for spring, later, setting in springs(1 + 2 * abs(lab.whole(0, 500))):
        want_exact(lab, spring._replace(damping=0.0), later, setting=setting)
    ends_in_one_place_are_pushed_apart(lab)


def ends_in_one_place_are_pushed_apart(lab: Lab) -> None:
    """Insist that each end gets its share, in any direction."""
    stiffness, rest = lab.about(90.0), lab.about(30.0)
    lab.ran(f"apply for 1/120 s: both ends in one place, {stiffness:g} kg/s², length {rest:g} px")
    a, b = lab.circle((5.0, 7.0), 10.0, 2.0), lab.circle((5.0, 7.0), 10.0, 3.0)
    joint = lab.make("SpringJoint", a, b, stiffness, 0.0, rest)
    lab.tell(joint, "apply", STEP, sees=(a, b))
    speeds = [math.hypot(*each) for each in velocities((lab.state(a), lab.state(b)))]
    right = [stiffness * rest * STEP / mass for mass in (2.0, 3.0)]
    lab.want(
        all(math.isclose(*each, rel_tol=1e-9) for each in zip(speeds, right, strict=True)),
        f"A at {right[0]:.6g} px/s and B at {right[1]:.6g} px/s",
        f"A at {speeds[0]:.6g} px/s and B at {speeds[1]:.6g} px/s",
    )


def damping_brakes_the_speed_along_the_spring(lab: Lab) -> None:
    """Damping brakes the speed along the spring, and no other"""
    for vel_a, vel_b in ((SLOW, FAST), (FAST, SLOW), (SLOW, SLOW)):
        want_about(lab, Spring(Rod(3.0, 1.0, 50.0, (30.0, 40.0), vel_a, vel_b, STEP), 0.0, 12.0))
    want_about(lab, Spring(Rod(1.0, 4.0, 80.0, (60.0, -80.0), FAST, SLOW, STEP), 120.0, 12.0))
    want_about(lab, Spring(Rod(3.0, 1.0, 50.0, (30.0, 40.0), SLOW, FAST, STEP), 0.0, 0.421875))
    for spring, later, setting in springs(2 + 2 * abs(lab.whole(0, 500))):
        want_exact(lab, spring, later, setting=setting)


def a_mass_on_a_spring_swings_and_fades_as_it_must(lab: Lab) -> None:
    """A mass on a spring swings and fades by the closed form"""
    mass, seconds = lab.about(2.0), 1.5
    stiffness, damping = 400.0 * mass, 2.0 * mass
    rate, fading = math.sqrt(stiffness / mass), damping / (2 * mass)  # 1/s
    lab.ran(f"{mass:g} kg on a spring of {stiffness:g} kg/s² and {damping:g} kg/s, for {seconds} s")
    begin = 100.0 + lab.about(30.0)
    hook, bob = lab.circle(STILL, 5.0, 0.0), lab.circle((begin, 0.0), 10.0, mass)
    spring = lab.make("SpringJoint", hook, bob, stiffness, damping, 100.0)
    world = lab.world(hook, bob, bonus=True)
    lab.let(world, "springs.append", spring)
    swing = lab.simulate(world, [bob], round(seconds / STEP)).body(0)
    crossings = [time + when for time, when in zero_crossings([each.x - 100.0 for each in swing])]
    period = 2 * math.pi / math.sqrt(rate**2 - fading**2)  # s
    swings = (len(crossings) - 1) / 2
    found = (crossings[-1] - crossings[0]) * STEP / swings if swings > 0 else math.inf
    # At 20 rad/s and steps of 1/120 s the period is off by (rate * STEP)² / 24, or 0.1 %.
    lab.want(
        abs(found / period - 1) < 0.01,
        f"a period of {period:.4f} s, as 2 pi / sqrt(stiffness / mass - (damping / 2 mass)²)",
        f"{found:.4f} s" if swings > 0 else "no swing",
    )
    left = amplitude(swing[-round(period / STEP) :]) / amplitude(swing[: round(period / STEP)])
    right = math.exp(-fading * (seconds - period))
    lab.want(
        abs(left / right - 1) < 0.05,
        f"{right:.1%} of its swing left, as exp(-damping / 2 mass · t)",
        f"{left:.1%}",
    )


def zero_crossings(values: list[float]) -> list[tuple[int, float]]:
    """Return the sign changes: a step plus the share of the way to the next."""
    return [
        (step, a / (a - b)) for step, (a, b) in enumerate(pairwise(values)) if (a < 0) != (b < 0)
    ]


def amplitude(swing: list[Moment]) -> float:
    return max(abs(each.x - 100.0) for each in swing)
