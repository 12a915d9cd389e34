"""Check the lesson's rules of contacts and of the step, with one small experiment each.

Expected values are computed by hand from the lesson's numbers: BETA 0.2, SLOP 0.5 px, no bounce
below 30 px/s. Each experiment is one step of a World.
"""

import math
from typing import NamedTuple

from grader.judge.decode import Pair, Thing
from grader.judge.lab import STEP, Lab, Moment
from grader.protocol import BodyValue

EXACT = 1e-6  # px and px/s: tolerance for a few steps of rounding
KEPT = 0.6065306597126334  # share of the speed after 0.1 s at 5 per second
TOUCHING = 1e-6  # px of overlap
NEARLY = 1e-5  # px/s, with an overlap
STOPPED = 1e-3  # px/s
PASSES = range(2, 21)  # the lesson has 8, and suggests trying others
LEAN = 0.9  # cosine of the angle from a rod to the normal of a contact


# ---------------------------------------------------------------- contacts


class Impact(NamedTuple):
    """A disc meets a static one, and leaves it at the larger speed of bounce and push-out."""

    restitution: Pair
    closing: float  # px/s
    depth: float  # px
    leaves: float  # px/s


IMPACTS = [  # the push-out is 24/s of the depth beyond half a pixel
    Impact((0.9, 0.3), 200, 0.4, 60),
    Impact((0.1, 0.3), 200, 0.4, 20),
    Impact((0.5, 0.8), 20, 0.4, 0),  # slower than RESTING_SPEED
    Impact((0.3, 0.3), 0, 0.4, 0),  # within SLOP
    Impact((0.3, 0.3), 0, 5.0, 108),
    Impact((0.3, 0.3), 200, 2.0, 60),  # the bounce is larger
    Impact((0.3, 0.3), 40, 3.0, 60),  # the push-out is larger
]


ANOTHER_RULE = "The larger of bounce (the smaller restitution, above 30 px/s) and push-out counts."


def other_rules(impact: Impact) -> set[float]:
    """Return the speeds that other rules of bounce and push-out would give, px/s."""
    first, second = impact.restitution
    shares = 0.0, first, second, first * second, math.sqrt(first * second), (first + second) / 2
    pushes = 0.0, 24 * impact.depth, 24 * max(impact.depth - 0.5, 0.0)
    both = [(share * impact.closing, push) for share in shares for push in pushes]
    return {max(each) for each in both} | {sum(each) for each in both}


def want_impact(lab: Lab, impact: Impact) -> None:
    """Insist on the right speed after one step with one contact from straight above."""
    first, second = impact.restitution
    lab.ran(
        f"a disc {impact.depth:g} px deep in a static one, closing at {impact.closing:g} px/s, "
        f"restitution {first:g} on {second:g}, one step"
    )
    anchor, mass = lab.circle((0, 0), 50, 0, restitution=second), lab.about(2.0)
    disc = lab.circle((0, impact.depth - 60), 10, mass, restitution=first, vel=(0, impact.closing))
    done = lab.simulate(lab.world(anchor, disc), [disc], 1, contacts=True)
    after, touching = done.body(0)[0], done.contacts[0]
    lab.want(
        abs(after.vy + impact.leaves) < EXACT,
        f"it leaves at {impact.leaves:g} px/s",
        f"it leaves at {-after.vy:.9g} px/s",
        ANOTHER_RULE if any(abs(after.vy + each) < EXACT for each in other_rules(impact)) else "",
    )
    pushed = mass * (impact.closing + impact.leaves)
    lab.want(
        len(touching) == 1 and abs(touching[0].jn - pushed) < EXACT,
        f"one contact, with jn {pushed:g} kg px/s in the end",
        f"jn {touching[0].jn:.9g}" if len(touching) == 1 else f"{len(touching)} contacts",
    )


def want_pressed_and_rubbed(lab: Lab) -> None:
    """Insist on the right normal and friction impulses; both turn both bodies."""
    lab.ran(
        f"two discs of {lab.factor:g} kg, friction 0.9 on 0.4, sliding at 300 px/s and closing at "
        "20 px/s, one step"
    )
    a = lab.circle((0, 0), 10, lab.factor, friction=0.9)
    b = lab.circle((0, TOUCHING - 20), 10, lab.factor, friction=0.4, vel=(300, 20))
    lab.simulate(lab.world(a, b), [a, b], 1)
    one, other = lab.state(a), lab.state(b)
    # jn = 20 / (1/1 + 1/1) = 10, and the friction is sqrt(0.9 * 0.4) of it: 6. Inertia 50, and the
    # arms are 10 px but for the overlap.
    expected = (6, 10, 1.2, 294, 10, 1.2)
    lab.want(
        math.dist(expected, (*one.vel, one.omega, *other.vel, other.omega)) < NEARLY,
        "A at (6, 10) px/s with spin 1.2, B at (294, 10) px/s with spin 1.2",
        f"A at {say(one)}, B at {say(other)}",
    )


def say(body: BodyValue) -> str:
    return f"({body.vel.x:.9g}, {body.vel.y:.9g}) px/s with spin {body.omega:.9g}"


def want_a_total_that_is_clamped(lab: Lab) -> None:
    """Insist that a pass can reduce the impulse of an earlier one.

    A disc falls into a shallow groove between two large ones. Solving one side pushes it a little
    off the other. If totals are clamped, the next pass draws it back, and after two passes at most
    a sixteenth of its speed is left; if changes are clamped, a quarter is left.
    """
    speed = lab.about(20.0, 4.0)
    lab.ran(f"a disc that falls at {speed:g} px/s into a groove between two large ones, one step")
    x, y = 110 * math.sin(math.pi / 6), 110 * math.cos(math.pi / 6)
    sides = [lab.circle((side * x, y - TOUCHING), 100, 0, friction=0.0) for side in (-1, 1)]
    disc = lab.circle((0, 0), 10, lab.factor, restitution=0.0, friction=0.0, vel=(0, speed))
    after = lab.simulate(lab.world(*sides, disc), [disc], 1).body(0)[0]
    lab.want(
        after.speed < 0.1 * speed,
        "a disc that comes to rest: the total is clamped, not the change of each pass",
        f"it leaves at ({after.vx:.3g}, {after.vy:.3g}) px/s",
    )


def want_friction_after_pressure(lab: Lab) -> None:
    """Insist that friction of the last pass is limited by the last pass's pressure."""
    lab.ran("a disc pushed under a slanting rod along a rough static one at 100 px/s, one step")
    world, disc, _ = leaning_disc(lab, lab.about(100.0), 0.001)
    done = lab.simulate(world, [disc], 1, contacts=True)
    after, touching = done.body(0)[0], done.contacts[0]
    lab.want(len(touching) == 1, "one contact", f"{len(touching)}")
    row, slip = touching[0], abs(after.vx - 10 * after.omega)
    lab.want(
        abs(abs(row.jt) - row.limit) <= EXACT * row.jn or slip < STOPPED,
        f"jt {row.limit:.6g} kg px/s, the root of both frictions times jn, as it slides",
        f"jt {abs(row.jt):.6g} with jn {row.jn:.6g}",
    )


def want_a_way_out_for_coincident_discs(lab: Lab) -> None:
    """Insist on the lesson's normal when both centres coincide."""
    lab.ran("circle_circle of two discs with one centre")
    centre = lab.about(3.0), lab.about(4.0)
    discs = lab.circle(centre, 10), lab.circle(centre, 6)
    contact = lab.contact_or_none(lab.call("circle_circle", *discs))
    lab.want(contact is not None, "a contact", "None")
    if contact is not None:
        normal = lab.pair(contact.normal, "the normal")
        lab.want(
            math.dist(normal, (0, 1)) < EXACT and abs(contact.depth - 16) < EXACT,
            "the normal (0, 1) and a depth of 16 px",
            f"({normal[0]:.9g}, {normal[1]:.9g}) and {contact.depth:.9g} px",
        )


# ---------------------------------------------------------------- the step


def want_gravity_then_damping(lab: Lab) -> None:
    """Insist on gravity, then damping, then a move with the new velocity."""
    lab.ran("a disc that falls from rest, damped at 5 per second, one step of 0.1 s")
    disc = lab.circle((0, 0), mass=lab.factor)
    world = lab.world(disc, gravity=(0, 980), linear_damping=5.0)
    want_state(lab, lab.simulate(world, [disc], 1, 0.1).body(0)[0], (0, 9.8 * KEPT, 0, 98 * KEPT))


def want_a_free_flight(lab: Lab) -> None:
    """Insist that an undamped free body keeps any velocity."""
    vx, vy = lab.about(3000.0), lab.about(-4000.0)
    lab.ran(f"a disc at ({vx:g}, {vy:g}) px/s that meets nothing, one step")
    disc = lab.circle((0, 0), vel=(vx, vy))
    after = lab.simulate(lab.world(disc), [disc], 1).body(0)[0]
    want_state(lab, after, (vx * STEP, vy * STEP, vx, vy))


def want_state(lab: Lab, got: Moment, expected: tuple[float, float, float, float]) -> None:
    """Insist on a position (px) and a velocity (px/s)."""
    lab.want(
        math.dist(expected, (got.x, got.y, got.vx, got.vy)) < EXACT * max(map(abs, expected)),
        "({:.9g}, {:.9g}) px, at ({:.9g}, {:.9g}) px/s".format(*expected),
        f"({got.x:.9g}, {got.y:.9g}) px, at ({got.vx:.9g}, {got.vy:.9g}) px/s",
    )


def want_fresh_contacts(lab: Lab) -> None:
    """Insist that contacts use the bodies' new positions."""
    lab.ran("a disc on a static one for a step; then it is put far away, and another step")
    anchor, disc = lab.circle((0, 0), 50, 0), lab.circle((0, -59))
    world = lab.world(anchor, disc)
    counts = []
    for place in ((0, -59), (0, -500)):
        lab.put(disc, pos=place, vel=(0, 0))
        counts.append(len(lab.simulate(world, [disc], 1, contacts=True).contacts[0]))
    lab.want(counts == [1, 0], "1 contact, then none", f"{counts[0]}, then {counts[1]}")


def want_some_passes(lab: Lab) -> None:
    """Check how many solver passes a step makes.

    A disc touches a surface and hangs on a rod; each solve shrinks its speed by the same cosine, so
    the speed left gives the count. Either order is accepted.
    """
    push = lab.about(100.0)
    lab.ran(f"a disc on a static one and on a slanting rod, pushed at {push:g} px/s, one step")
    world, disc, along = leaning_disc(lab, push, 0.0)
    after = lab.simulate(world, [disc], 1).body(0)[0]
    slip = after.vx * along[0] + after.vy * along[1]
    joints_last = {passes: push * LEAN ** (2 * passes - 1) for passes in PASSES}
    contacts_last = {passes: push * LEAN ** (2 * passes) for passes in PASSES}
    possible = joints_last if abs(slip) < EXACT else contacts_last if abs(after.vy) < EXACT else {}
    found = [passes for passes, left in possible.items() if abs(after.speed - left) < EXACT]
    lab.want(
        bool(found),
        f"{joints_last[8]:.7f} px/s after 8 passes over contacts and joints, or what from 2 to 20 "
        "passes leave",
        f"{after.speed:.7f} px/s, {abs(slip):.7f} px/s of it along the rod",
    )
    if found and 8 not in found:
        lab.notes.append(f"An experiment: the solver runs {found[0]} passes in a step, not 8.")


def leaning_disc(lab: Lab, push: float, friction: float) -> tuple[Thing, Thing, Pair]:
    """Put a disc on a static one and on a rod; return the world, the disc and the rod's axis."""
    along = math.sqrt(1 - LEAN**2), -LEAN  # from its hook
    anchor, place = lab.circle((0, 0), 50, 0, friction=friction), (0.0, 1e-9 - 60)
    disc = lab.circle(place, restitution=0.0, friction=friction, vel=(push, 0))
    hook = lab.circle((-100 * along[0], place[1] - 100 * along[1]), 6, 0, friction=0.0)
    rod = lab.thing(lab.call("DistanceJoint", hook, disc), "a DistanceJoint")
    return lab.world(anchor, hook, disc, joints=[rod]), disc, along


def want_the_same_pile(lab: Lab) -> None:
    """Insist on the same run twice, bit for bit, on one machine and build."""
    lab.ran("a pile of 9 discs between three large ones for a quarter of a second, twice")
    runs = []
    for _ in range(2):
        ground = [lab.circle(pos, 400, 0) for pos in ((0, 400), (-430, 100), (430, 100))]
        pile = [
            lab.circle((19.5 * (number % 3) - 20, -12 - 19.5 * (number // 3)), 10, 1 + number / 9)
            for number in range(9)
        ]
        world = lab.world(*ground, *pile, gravity=(0, 980))
        runs.append(lab.simulate(world, pile, 30).frames)
    lab.want(runs[0] == runs[1], "the same numbers, bit for bit", "other numbers")


def want_a_rod_put_right(lab: Lab) -> None:
    """Insist that a step of any length corrects a fifth of a rod's error."""
    off = lab.about(10.0)  # px
    lab.ran(f"a disc on a rod {off:g} px too long, at rest, one step of 1/60 s")
    hook, disc = lab.circle((0, 0), mass=0), lab.circle((0, 100))
    rod = lab.thing(lab.call("DistanceJoint", hook, disc), "a DistanceJoint")
    lab.put(disc, pos=(0, 100 + off))
    world = lab.world(hook, disc, joints=[rod])
    want_state(
        lab, lab.simulate(world, [disc], 1, 1 / 60).body(0)[0], (0, 100 + 0.8 * off, 0, -12 * off)
    )
