"""TODO 4: friction within its limit.

Two discs get their speeds by hand, and one pass of World.solve_contact at a time. No number depends
on TODO 2: either their inv_inertia is 0, so that no impulse turns them, or they slip so fast that
friction is at its limit however easily they turn.
"""

import math
from typing import NamedTuple

from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.exact import DEPTH, Discs, Rubbing
from grader.checks.strategies import (
    PLACE,
    any_frictions,
    any_impulses,
    any_radii,
    damped_steps,
    mass_pairs,
    rubbings,
    surfaces,
    touching,
    units,
    wide_velocities,
)
from grader.checks.telling import decimals_to_tell
from grader.judge.drawing import given
from grader.judge.lab import STEP, Frame, Lab, Pair, Thing
from grader.protocol import BodyValue

ASLANT, NEARLY_UPRIGHT = (0.6, 0.8), (200 / 10001, 9999 / 10001)
STILL = (0.0, 0.0)
ROUGH = (0.5, 0.5)
ON_A_FLOOR = Discs(ROUGH, (0.0, 2.0))  # A is static, B 2 kg
UNDER_A_CEILING = Discs(ROUGH, (2.0, 0.0))  # B is static
IN_THE_AIR = Discs(ROUGH, (3.0, 2.0), ASLANT, (12.0, 7.0), (40.0, -25.0), (1.5078125, -2.0234375))
ANGLES = (0.703125, -0.40625)  # rad
TARGET = 5.125  # px/s


class Setting(NamedTuple):
    """All else about two discs that touch, on which no friction hangs, and how they are asked.

    Only where it is `framed` a check asks what else is changed: that costs points, but not all.
    """

    place: Pair = (30.3125, -20.6875)  # px, of B
    restitution: Pair = (0.28125, 0.59375)  # which is in the target already
    depth: float = DEPTH  # px, as the contact tells it; so is this
    dt: float = STEP  # s
    framed: bool = False


USUAL, FRAMED = Setting(), Setting(framed=True)
settings = st.builds(  # a lambda, for hypothesis would draw the other fields as well
    lambda place, restitution, depth: Setting(place, restitution, depth),
    place=PLACE["pos"],
    restitution=st.tuples(surfaces, surfaces),
    depth=st.sampled_from([DEPTH, 3.140625]),
)


class Pressed(NamedTuple):
    """A contact of two discs, and what a pass over it may change."""

    world: Thing
    contact: Thing
    a: Thing
    b: Thing
    discs: Discs
    changes: Frame


def press(
    lab: Lab,
    discs: Discs,
    target: float = TARGET,
    b: Thing | None = None,
    setting: Setting = USUAL,
) -> Pressed:
    """Two discs in contact; a given B, at its place, gets one contact more."""
    (x, y), (ra, rb), (px, py) = discs.normal, discs.arms, setting.place
    a = disc(lab, discs, 0, (px - (ra + rb) * x, py - (ra + rb) * y), setting)
    b = b or disc(lab, discs, 1, setting.place, setting)
    point = (px - rb * x, py - rb * y)
    made = lab.call("Contact", a, b, discs.normal, setting.depth, point)
    contact = lab.thing(made, "a Contact")
    lab.put(contact, target=target)
    moving = {each: "vel omega" for each, m in zip((a, b), discs.mass, strict=True) if m}
    return Pressed(lab.world(), contact, a, b, discs, {contact: "jn jt", **moving})


def disc(lab: Lab, discs: Discs, number: int, pos: Pair, setting: Setting) -> Thing:
    fields = {"friction": discs.mu[number], "angle": ANGLES[number]}
    fields["restitution"] = setting.restitution[number]
    if not discs.turning:
        fields["inv_inertia"] = 0.0
    return lab.circle(pos, discs.radius[number], discs.mass[number], **fields)


# ---------------------------------------------------------------- how they move


class Motion(NamedTuple):
    """Velocity and spin of A and B, px/s and rad/s."""

    ax: float
    ay: float
    a_spin: float
    bx: float
    by: float
    b_spin: float


def at_first(discs: Discs, each: Rubbing, target: float) -> Motion:
    """The motion in which B slips along A and closes in on it as asked."""
    (x, y), (ra, rb) = discs.normal, discs.arms
    a_spin, b_spin = (w if m else 0.0 for w, m in zip(discs.spin, discs.mass, strict=True))
    along, across = target - each.closing, each.slip + a_spin * ra + b_spin * rb
    vx, vy = along * x - across * y, along * y + across * x
    dx, dy = discs.drift if all(discs.mass) else STILL
    if discs.mass[1]:
        return Motion(dx, dy, a_spin, dx + vx, dy + vy, b_spin)
    return Motion(-vx, -vy, a_spin, 0.0, 0.0, b_spin)


def after(discs: Discs, first: Motion, pressing: float, rubbing: float) -> Motion:
    """The motion after impulses on B, along the normal and along the slip; A gets the opposite."""
    (x, y), (ra, rb), (turn_a, turn_b) = discs.normal, discs.arms, discs.inverse_inertias
    push_x, push_y = pressing * x - rubbing * y, pressing * y + rubbing * x
    a, b = exact.inverse(discs.mass[0]), exact.inverse(discs.mass[1])
    return Motion(
        first.ax - a * push_x,
        first.ay - a * push_y,
        first.a_spin - turn_a * ra * rubbing,
        first.bx + b * push_x,
        first.by + b * push_y,
        first.b_spin - turn_b * rb * rubbing,
    )


def rubbed(discs: Discs, first: Motion, last: Motion) -> float:
    """The friction impulse on B between two motions, told by the lighter one of those that move."""
    (x, y), (mass_a, mass_b) = discs.normal, discs.mass
    if mass_b and not 0 < mass_a < mass_b:
        return mass_b * ((last.by - first.by) * x - (last.bx - first.bx) * y)
    return mass_a * ((first.ay - last.ay) * x - (first.ax - last.ax) * y)


def motion(a: BodyValue, b: BodyValue) -> Motion:
    return Motion(a.vel.x, a.vel.y, a.omega, b.vel.x, b.vel.y, b.omega)


# ---------------------------------------------------------------- passes


def one_pass(lab: Lab, pressed: Pressed, each: Rubbing, setting: Setting = USUAL) -> float:
    """The friction impulse on B that one pass adds, along its slip."""
    world, contact, a, b, discs, changes = pressed
    first = at_first(discs, each, TARGET)
    lab.put(contact, jn=each.jn)
    if discs.mass[0]:
        lab.put(a, vel=(first.ax, first.ay), omega=first.a_spin)
    if discs.mass[1]:
        lab.put(b, vel=(first.bx, first.by), omega=first.b_spin)
    looked_at = changes if setting.framed else None
    lab.tell(world, "solve_contact", contact, setting.dt, changes=looked_at, sees=(a, b))
    last = motion(lab.state(a), lab.state(b))
    if setting.framed:
        want_pressed(lab, contact, each.pressed(discs.k))
    rubbing = rubbed(discs, first, last)
    right = after(discs, first, each.pressed(discs.k) - each.jn, rubbing)
    # Rounding is relative to the speeds that are added up, at the rim as well.
    size = 1.0 + sum(map(abs, (*first, *last))) + sum(rim_speeds(discs))
    off = max(abs(x - y) for x, y in zip(last, right, strict=True))
    lab.want(
        off <= 1e-9 * size,
        f"opposite impulses on A and B, and nothing else: {say_motion(right, last)}",
        say_motion(last, right),
    )
    return rubbing


def want_pressed(lab: Lab, contact: Thing, right: float) -> None:
    """The normal impulse is the given code's: friction reads it, and leaves it as it is."""
    jn = lab.number(lab.get(contact, "jn"), "jn")
    same = math.isclose(jn, right, rel_tol=1e-9, abs_tol=1e-6)
    lab.want(same, f"jn {right:.6g} kg px/s after the pass", f"jn {jn:.6g} kg px/s")


def rim_speeds(discs: Discs) -> list[float]:
    """How fast their spin moves the rims, px/s."""
    return [abs(w) * r for w, r in zip(discs.spin, discs.radius, strict=True)]


def say_motion(says: Motion, other: Motion) -> str:
    n = decimals_to_tell(says, other, 3)
    ax, ay, a_spin, bx, by, b_spin = (f"{each + 0.0:.{n}f}" for each in says)
    return f"A ({ax}, {ay}) px/s, spin {a_spin} rad/s; B ({bx}, {by}) px/s, spin {b_spin} rad/s"


def rub(
    lab: Lab, discs: Discs, passes: list[Rubbing], setting: Setting = USUAL
) -> tuple[float, ...]:
    """The friction impulse on B in total after each pass, along its slip."""
    say_what_runs(lab, discs, passes)
    pressed, totals = press(lab, discs, setting=setting), [0.0]
    for each in passes:
        totals.append(totals[-1] + one_pass(lab, pressed, each, setting))
    # A mistake's answer hangs on TODO 2 where they turn, and on rounding where momenta are huge.
    if not discs.turning and momenta(discs, passes) < 1e7:
        lab.saw("friction", (discs.mu, discs.k, tuple(passes)), tuple(totals[1:]))
    return tuple(totals[1:])


def say_what_runs(lab: Lab, discs: Discs, passes: list[Rubbing]) -> None:
    lab.ran(
        f"friction {discs.mu[0]:g} and {discs.mu[1]:g}, {weight(discs.mass[1])} on "
        f"{weight(discs.mass[0])}, pass by pass: " + "; ".join(map(say_pass, passes))
    )


def weight(mass: float) -> str:
    return f"{mass:g} kg" if mass else "a static body"


def say_pass(each: Rubbing) -> str:
    words = f"jn {each.jn:g} kg px/s, slip {each.slip:g} px/s"
    return f"{words}, closing {each.closing:g} px/s" if each.closing else words


def say(totals: tuple[float, ...], other: tuple[float, ...]) -> str:
    n = decimals_to_tell(totals, other, 2)
    return ", then ".join(f"{round(total, n) + 0.0:.12g}" for total in totals) + " kg px/s"


def want_exact(lab: Lab, discs: Discs, passes: list[Rubbing], setting: Setting = USUAL) -> None:
    want_totals(lab, discs, passes, rub(lab, discs, passes, setting))


def want_about(lab: Lab, discs: Discs, passes: list[Rubbing], setting: Setting = USUAL) -> None:
    """The same for discs as heavy, as fast and pressed as hard."""
    heavy, fast = lab.about(1.0), lab.about(1.0)
    hard_passes = [hard(each, heavy, fast) for each in passes]
    want_exact(lab, like(discs, heavy, fast), hard_passes, setting)


def like(discs: Discs, heavy: float, fast: float) -> Discs:
    """Discs so many times as heavy and as fast."""
    return discs._replace(
        mass=times(heavy, discs.mass), drift=times(fast, discs.drift), spin=times(fast, discs.spin)
    )


def hard(each: Rubbing, heavy: float, fast: float) -> Rubbing:
    """A contact of such discs, pressed as hard for them."""
    return Rubbing(heavy * fast * each.jn, fast * each.slip, fast * each.closing)


def times(factor: float, pair: Pair) -> Pair:
    return factor * pair[0], factor * pair[1]


def want_totals(lab: Lab, discs: Discs, passes: list[Rubbing], answer: tuple[float, ...]) -> None:
    right = exact.friction_totals(discs.mu, discs.k, passes)
    size = momenta(discs, passes)  # rounding is relative to what goes into the totals
    lab.want(
        all(abs(a - b) <= 1e-9 * size for a, b in zip(answer, right, strict=True)),
        f"a friction impulse of {say(right, answer)} in total",
        say(answer, right),
    )


def momenta(discs: Discs, passes: list[Rubbing]) -> float:
    """How large the momenta are from which the totals are told, and at least 1 kg px/s."""
    lighter = min(mass for mass in discs.mass if mass)
    speed = sum(map(abs, discs.drift)) + sum(rim_speeds(discs))
    return 1.0 + sum(p.jn + lighter * (abs(p.slip) + abs(p.closing) + speed) for p in passes)


def sliding(discs: Discs, passes: list[Rubbing]) -> list[Rubbing]:
    """The same passes with so much slip that friction is at its limit.

    Spin terms make k three times as large at most, so it is there with or without them.
    """
    most = math.sqrt(discs.mu[0] * discs.mu[1]) * max(each.pressed(discs.k) for each in passes)
    least = 1.0 + 3 * discs.k * 2 * most
    return [
        each._replace(slip=math.copysign(max(abs(each.slip), least), each.slip)) for each in passes
    ]


# ---------------------------------------------------------------- one contact


def sliding_friction_does_not_ask_how_fast(lab: Lab) -> None:
    """Sliding friction acts against the slip: the same at any speed, more with more jn"""
    slow, fast, jn = lab.about(300.0), lab.about(3000.0), lab.about(20.0)
    for discs in (ON_A_FLOOR, UNDER_A_CEILING, IN_THE_AIR):
        passes = [Rubbing(jn, s) for s in (slow, fast, -slow)] + [Rubbing(2 * jn, fast)]
        answer = [rub(lab, discs, [each])[0] for each in passes]
        one = -answer[0]
        right = [-one, -one, one, -2 * one]
        lab.want(
            one > 1e-6 and all(abs(a - b) <= 1e-6 for a, b in zip(answer, right, strict=True)),
            f"as much friction at a slip of {slow:g} px/s as at {fast:g}, as much the other way at "
            f"{-slow:g}, and twice as much where jn is twice as much",
            f"{answer[0]:.6g}, {answer[1]:.6g}, {answer[2]:.6g} and {answer[3]:.6g} kg px/s",
        )


def friction_stops_at_its_limit_both_ways(lab: Lab) -> None:
    """Friction stops at its limit, whichever way a body slips"""
    for slip in (300.0, -300.0):  # a mistake in one way alone is told by both, so ask both first
        rub(lab, ON_A_FLOOR, [Rubbing(20.0, slip)])
    for slip in (300.0, -300.0):
        want_about(lab, ON_A_FLOOR, [Rubbing(20.0, slip)])
        want_about(lab, IN_THE_AIR, [Rubbing(50.0, slip)])
        want_about(lab, UNDER_A_CEILING, [Rubbing(20.0, slip)])
        for normal in ((1.0, 0.0), (-1.0, 0.0), (0.0, -1.0)):  # at walls and from below
            want_about(lab, ON_A_FLOOR._replace(normal=normal), [Rubbing(20.0, slip)])
    for slip in (9000.0, -9000.0):
        want_about(lab, ON_A_FLOOR, [Rubbing(3000.0, slip)])
        for discs in (ON_A_FLOOR, IN_THE_AIR):
            want_about(lab, discs._replace(turning=True), [Rubbing(20.0, slip)])


def the_limit_takes_the_friction_of_both_bodies(lab: Lab) -> None:
    """The limit is the geometric mean of both frictions, times jn"""
    for mu in ((0.9, 0.4), (0.4, 0.9), (0.2, 0.8), (1.5, 0.75)):
        for discs in (ON_A_FLOOR, IN_THE_AIR):
            want_about(lab, discs._replace(mu=mu), [Rubbing(20.0, 300.0)])
    discs = ON_A_FLOOR._replace(mu=(0.9, 0.4))
    want_about(lab, discs, [Rubbing(0.0, 300.0, closing=100.0)])


def the_total_of_all_passes_is_limited(lab: Lab) -> None:
    """The total of all passes is limited, not the change in one"""
    again, back = Rubbing(20.0, 300.0), Rubbing(20.0, -300.0)
    want_about(lab, ON_A_FLOOR, [again, again, again])
    want_about(lab, ON_A_FLOOR, [again, back, Rubbing(5.0, 0.0)])
    want_about(lab, IN_THE_AIR, [back, again, Rubbing(20.0, 1.5), Rubbing(5.0, 0.0)])
    a_ball_in_a_corner_has_two_totals(lab, [again, Rubbing(20.0, -3.0)], [back, Rubbing(8.0, 2.0)])


def a_ball_in_a_corner_has_two_totals(
    lab: Lab, on_the_floor: list[Rubbing], at_the_wall: list[Rubbing]
) -> None:
    """Passes over two contacts of one ball in turn: each has a total of its own."""
    heavy, fast = lab.about(1.0), lab.about(1.0)
    on_a_floor = like(ON_A_FLOOR, heavy, fast)
    at_a_wall = on_a_floor._replace(normal=(1.0, 0.0), mu=(0.9, 0.5))
    on_the_floor = [hard(each, heavy, fast) for each in on_the_floor]
    at_the_wall = [hard(each, heavy, fast) for each in at_the_wall]
    floor = press(lab, on_a_floor)
    wall = press(lab, at_a_wall, b=floor.b)
    both = [(0.0, 0.0)]
    say_what_runs(lab, on_a_floor, on_the_floor)
    lab.ran(f"{lab.running}; between them, at a wall: {'; '.join(map(say_pass, at_the_wall))}")
    for first, second in zip(on_the_floor, at_the_wall, strict=True):
        one, other = one_pass(lab, floor, first), one_pass(lab, wall, second)
        both.append((both[-1][0] + one, both[-1][1] + other))
    below, beside = zip(*both[1:], strict=True)
    want_totals(lab, on_a_floor, on_the_floor, below)
    want_totals(lab, at_a_wall, at_the_wall, beside)


def within_the_limit_friction_ends_the_slip(lab: Lab) -> None:
    """Friction that stays within its limit ends the slip"""
    slow = IN_THE_AIR._replace(
        drift=(0.5, -0.25), spin=(0.0546875, -0.1015625), normal=NEARLY_UPRIGHT
    )
    for slip in (30.0, -30.0, 5.0625, -5.0625, 1.5, -0.01):
        for discs in (ON_A_FLOOR, IN_THE_AIR, slow):
            passes = [Rubbing(500.0, slip), Rubbing(500.0, 0.0)]
            want_about(lab, discs, passes, FRAMED)


def nothing_rubs_on_ice_or_without_pressure(lab: Lab) -> None:
    """Ice hardly rubs, and bodies that part do not rub at all"""
    for slip in (300.0, -300.0):
        for mu in ((0.05, 0.05), (0.0, 0.0), (0.0, 0.8)):
            want_about(lab, ON_A_FLOOR._replace(mu=mu), [Rubbing(20.0, slip)])
        want_about(lab, ON_A_FLOOR, [Rubbing(20.0, slip, closing=-100.0)])


@given(discs=touching, passes=rubbings, dt=damped_steps, setting=settings)
def any_passes_add_up_to_a_friction_within_the_limit(
    lab: Lab, discs: Discs, passes: list[Rubbing], dt: float, setting: Setting
) -> None:
    """Any passes add up to a friction within the limit"""
    passes = sliding(discs, passes) if discs.turning else passes
    want_exact(lab, discs, passes, setting._replace(dt=dt, framed=True))


@given(
    mu=any_frictions,
    mass=mass_pairs,
    radius=any_radii,
    normal=units,
    vel_a=wide_velocities,
    vel_b=wide_velocities,
    jn=any_impulses,
)
def no_contact_pulls_or_creates_energy(
    lab: Lab,
    mu: float,
    mass: Pair,
    radius: float,
    normal: Pair,
    vel_a: Pair,
    vel_b: Pair,
    jn: float,
) -> None:
    """No contact pulls, creates energy or momentum, or moves a static body"""
    vel_a, vel_b = (vel if m else STILL for vel, m in zip((vel_a, vel_b), mass, strict=True))
    lab.ran(
        f"one pass, friction {mu:g}, jn {jn:g} kg px/s: A {weight(mass[0])}, {vel_a} px/s; "
        f"B {weight(mass[1])}, {vel_b} px/s; normal {normal}"
    )
    discs = Discs((mu, mu), mass, normal, (radius, 10.0))
    world, contact, a, b, _, changes = press(lab, discs, target=0.0)
    lab.put(contact, jn=jn)
    lab.put(a, vel=vel_a)
    lab.put(b, vel=vel_b)
    before = lab.state(a), lab.state(b)
    lab.tell(world, "solve_contact", contact, STEP, changes=changes, sees=(a, b))
    after = lab.state(a), lab.state(b)
    pressed, rubbed = (lab.number(lab.get(contact, name), name) for name in ("jn", "jt"))
    lab.want(
        pressed >= 0 and abs(rubbed) <= mu * pressed * (1 + 1e-9),
        f"jn not negative, and jt at most {mu:g} jn either way",
        f"jn {pressed:.6g}, jt {rubbed:.6g} kg px/s",
    )
    had, has = energy(mass, before), energy(mass, after)
    lab.want(has <= had * (1 + 1e-9), f"no more energy than before: {had:.6g}", f"{has:.9g}")
    for each, first, last in zip(mass, before, after, strict=True):
        lab.want(each > 0 or first == last, "a static body exactly where it was, at rest", "moved")
    if all(mass):
        shift = math.dist(momentum(mass, before), momentum(mass, after))
        size = mass[0] * math.hypot(*vel_a) + mass[1] * math.hypot(*vel_b)
        lab.want(shift <= 1e-9 * size, "the momentum kept", f"{shift:.4g} kg px/s more or less")


def energy(mass: Pair, bodies: tuple[BodyValue, BodyValue]) -> float:
    """Kinetic energy of bodies that do not turn, kg px²/s²."""
    return sum(0.5 * m * math.hypot(*body.vel) ** 2 for m, body in zip(mass, bodies, strict=True))


def momentum(mass: Pair, bodies: tuple[BodyValue, BodyValue]) -> Pair:
    a, b = (body.vel for body in bodies)
    return mass[0] * a.x + mass[1] * b.x, mass[0] * a.y + mass[1] * b.y


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


def a_sliding_block_stops_when_friction_has_eaten_its_speed(lab: Lab) -> None:
    """A sliding block slows down evenly, stops, and stays where it is"""
    speed = begin = lab.about(150.0, 30.0)
    lab.ran(f"2 kg sliding at {begin:g} px/s on a floor, friction 0.5 on both, gravity 980 px/s²")
    world, contact, _, block, *_ = press(lab, ON_A_FLOOR, target=0.0)
    for number in range(1, 46):
        lab.put(contact, jn=0.0, jt=0.0)
        lab.put(block, vel=(speed, -980.0 * STEP))
        lab.tell(world, "solve_contact", contact, STEP, sees=(block,))
        speed, right = lab.state(block).vel.x, max(begin - 0.5 * 980.0 * STEP * number, 0.0)
        lab.want(
            math.isclose(speed, right, rel_tol=1e-9, abs_tol=1e-9),
            f"{right:.3f} px/s after {number / 120:.3f} s: 490 px/s less in each second, then 0",
            f"{speed:.3f} px/s",
        )
