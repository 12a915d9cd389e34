"""TODO 7a to 7c: gravity, a ball's moment of inertia and the rod, in pymunk.

7d is TODO 6 again, in another program, with the checks in todo_6.
"""

import math
import random
from itertools import count
from typing import Any, NamedTuple

from grader.checks import exact
from grader.checks.digits import want_answer
from grader.checks.strategies import places_around, seeds
from grader.judge.drawing import given
from grader.judge.lab import STEP, Frame, Lab, Moment, Pair, Thing
from grader.protocol import Rng, SpaceBody, SpaceJoint, SpaceValue, Vec

GRAVITY = (0.0, 980.0)  # px/s²
PIVOT, BOB = (700.0, 90.0), (840.0, 90.0)  # px
LENGTH = 140.0  # px
AT_REST = 0.1  # px; a rod at rest has no error; a slide joint of fixed length has 0.07
STRETCH = 3.0  # px; pymunk's own rod stretches by 1.2 px here, or for one step by the push


# ---------------------------------------------------------------- 7a


def scene(lab: Lab) -> SpaceValue:
    """Return the space of the lab scene, with balls of some sizes."""
    made = lab.call("make_space", Rng(lab.whole(12, 12)))
    return lab.space(lab.items(made, "what make_space returns")[0])


def the_space_pulls_like_the_mini_engine(lab: Lab) -> None:
    """The space has the mini engine's gravity"""
    for again in range(5):
        words = f"make_space once more, as R does, {again} times" if again else "make_space"
        lab.ran(f"{words}, and looked at the space's gravity")
        gravity = lab.pair(scene(lab).gravity, "the gravity")
        lab.saw("gravity", (), gravity)
        lab.want(
            is_near(gravity, GRAVITY, 1e-9),
            "gravity (0, 980) px/s², as in the mini engine",
            f"gravity ({gravity[0]:g}, {gravity[1]:g})",
        )


SETTINGS = "idle_speed_threshold", "collision_slop", "collision_bias", "current_time_step"
PASSES = range(2, 21)  # of the solver: the lesson suggests trying 2 and 20, and sleeping


def the_space_keeps_its_damping_and_settings(lab: Lab) -> None:
    """The space has damping 0.95 and pymunk's settings, or those of an experiment"""
    lab.ran("make_space, and looked at the space's settings")
    space = scene(lab)
    lab.want(space.damping == 0.95, "damping 0.95", f"damping {space.damping:g}")
    still = space.bodies[0]
    lab.want(
        (*still.pos, still.angle) == (0.0, 0.0, 0.0),
        "the space's own static body at (0, 0)",
        f"at ({still.pos.x:g}, {still.pos.y:g}), turned by {still.angle:g} rad",
    )
    want_usual_settings(lab, lab.thing(space))
    bare = sum(not each.shapes for each in space.bodies if each.kind == "dynamic")
    lab.want(not bare, "a shape around each body that moves", f"{bare} without one")


def want_usual_settings(lab: Lab, space: Thing) -> None:
    usual = lab.make("pymunk:Space")
    for name in SETTINGS:
        right, answer = lab.get(usual, name), lab.get(space, name)
        lab.want(answer == right, f"{name} {right}, as pymunk has it", f"{name} {answer}")
    passes = lab.number(lab.get(space, "iterations"), "iterations")
    lab.want(passes in PASSES, "iterations 10, or from 2 to 20", f"iterations {passes:g}")
    if passes != 10:
        lab.notes.append(f"An experiment: space.iterations is {passes:g}, not 10.")
    sleep = lab.get(space, "sleep_time_threshold")
    if sleep != lab.get(usual, "sleep_time_threshold"):
        lab.notes.append("An experiment: sleep_time_threshold is set, so bodies at rest may sleep.")


def a_free_ball_falls_in_the_scene(lab: Lab) -> None:
    """A ball far from everything falls"""
    lab.ran("the lab scene without damping, a ball added far above it, about half a second")
    space = lab.thing(scene(lab))
    lab.put(space, damping=1.0)
    ball = lab.make("pymunk:Body", 1.0, 100.0)
    x, y, steps = lab.about(450.0), lab.about(-5000.0), lab.whole(60, 9)
    lab.put(ball, position=(x, y))
    lab.let(space, "add", ball)
    last = lab.simulate(space, [ball], steps, every=steps).body(0)[-1]
    fallen, speed = exact.pymunk_fall(GRAVITY[1], STEP, steps)
    lab.want(  # a deviation of a tenth is not visible
        math.isclose(last.y - y, fallen, rel_tol=0.1)
        and math.isclose(last.vy, speed, rel_tol=0.1)
        and abs(last.x - x) < 1.0,
        f"about {fallen:.0f} px further down, at (0, {speed:.0f}) px/s",
        f"{last.y - y:.1f} px further down, at ({last.vx:.1f}, {last.vy:.1f}) px/s",
    )


def is_near(first: Pair | None, second: Pair, distance: float) -> bool:
    return first is not None and math.dist(first, second) <= distance


# ---------------------------------------------------------------- 7b


FRICTION, ELASTICITY = 0.6, 0.4  # of a ball
OFFSET = (
    "That is the moment of a circle far from where it turns: the offset is measured from the "
    "centre of its own body, so leave it out."
)


class Ball(NamedTuple):
    """A body and its circle, as add_ball put them into a space."""

    body: Thing
    radius: float  # px
    mass: float
    moment: float
    surface: Pair  # friction and elasticity
    pos: Pair  # position of the drop


def drop(lab: Lab, space: Thing, rng: Rng | Thing, pos: Pair, changes: Frame | None = None) -> Ball:
    """Add a ball to a space; the return value of add_ball does not matter."""
    before = {body.ref for body in bodies_in(lab, space)}
    lab.call("add_ball", space, rng, pos, changes=changes)
    new = [body for body in bodies_in(lab, space) if body.ref not in before]
    lab.want(len(new) == 1, "one more body in the space", f"{len(new)} more")
    lab.want(bool(new[0].shapes), "a body with a circle around it", "a body without a shape")
    moment = math.inf if new[0].moment is None else new[0].moment
    shape = max(new[0].shapes, key=lambda shape: shape.radius)
    surface = shape.friction, shape.elasticity
    ball = Ball(lab.thing(new[0], "a ball"), shape.radius, new[0].mass, moment, surface, pos)
    lab.saw("moment", (ball.radius, ball.mass), moment)
    lab.want(
        is_near(pair(new[0].pos), pos, 1e-9) and not any((*new[0].vel, new[0].omega)),
        f"a ball at rest at ({pos[0]:g}, {pos[1]:g})",
        f"one at ({new[0].pos.x:g}, {new[0].pos.y:g}), {tuple(new[0].vel)} px/s",
    )
    return ball


def bodies_in(lab: Lab, space: Thing) -> list[SpaceBody]:
    return lab.space(lab.get(space, "")).bodies


def want_full_disc(lab: Lab, ball: Ball) -> None:
    right = exact.disc_moment(ball.mass, ball.radius)
    want_answer(
        lab,
        math.isclose(ball.moment, right, rel_tol=1e-9),
        "{:.{n}f}",
        right,
        ball.moment,
        digits=2,
        expected=f"a moment of {{}} for radius {ball.radius:g} px and mass {ball.mass:g}",
        meaning=OFFSET * math.isclose(ball.moment, right + ball.mass * math.hypot(*ball.pos) ** 2),
    )


RADII = range(10, 23)  # px


def seed_of(radius: int, first: int) -> int:
    """Return the next seed that draws a ball of this size; the drawing of colours may differ."""
    return next(n for n in count(first) if random.Random(n).randint(RADII[0], RADII[-1]) == radius)


def a_ball_resists_turning_as_a_full_disc(lab: Lab) -> None:
    """A ball has the moment of inertia of a full disc"""
    for radius in (RADII[0], 17, RADII[-1]):
        seed = seed_of(radius, abs(lab.whole(1, 90)))
        lab.ran(f"add_ball with random.Random({seed}) in an empty space")
        space = lab.make("pymunk:Space")
        want_full_disc(lab, drop(lab, space, Rng(seed), (450.0, 300.0)))
    seed = lab.whole(12, 12)
    lab.ran(f"add_ball eight times with one random.Random({seed})")
    rng = lab.make("random:Random", seed)
    balls = [drop(lab, space, rng, (100.0 * number, 300.0)) for number in range(8)]
    radii = {ball.radius for ball in balls}  # of 13 sizes; chance seldom gives so few
    lab.want(len(radii) > 2, "balls of several sizes", f"eight of {sorted(radii)} px")


@given(examples=2, seed=seeds, x=places_around, y=places_around)
def every_ball_has_the_moment_of_its_own_size(lab: Lab, seed: int, x: float, y: float) -> None:
    """Balls of all thirteen sizes have their own moments; nothing else changes"""
    space = lab.make("pymunk:Space")
    lab.put(space, gravity=(3.5, 700.25), damping=0.8125, iterations=7)
    for number, radius in enumerate(RADII):
        chosen = seed_of(radius, seed)
        lab.ran(f"add_ball with random.Random({chosen}) at ({x + 50.0 * number:g}, {y:g})")
        rng = lab.make("random:Random", chosen)
        ball = drop(lab, space, rng, (x + 50.0 * number, y), changes={space: "bodies shapes"})
        want_full_disc(lab, ball)
        lab.want(
            (ball.radius, ball.surface) == (radius, (FRICTION, ELASTICITY))
            and math.isclose(ball.mass, radius**2 / 100, rel_tol=1e-9),
            f"radius {radius} px and mass {radius**2 / 100:g}, "
            f"friction {FRICTION:g}, elasticity {ELASTICITY:g}",
            f"radius {ball.radius:g} px, mass {ball.mass:g}, "
            f"friction {ball.surface[0]:g}, elasticity {ball.surface[1]:g}",
        )


def floor_in(lab: Lab, space: Thing) -> None:
    """Add a level floor at y = 560, in the way the submission makes floors."""
    body = lab.space(lab.get(space, "")).bodies[0]
    segment = lab.call("pymunk:Segment", lab.thing(body), (-900.0, 580.0), (1800.0, 580.0), 20.0)
    floor = lab.thing(segment, "a floor")
    lab.put(floor, friction=0.6, elasticity=0.3)
    lab.let(space, "add", floor)


def a_sliding_pymunk_ball_comes_to_roll(lab: Lab) -> None:
    """A ball that slides comes to roll, at two thirds of its speed

    Every disc reaches 2/3 of its speed, for any size, mass and friction. A deviation of a tenth is
    not visible.
    """
    speed = lab.about(300.0)
    lab.ran(f"a ball of add_ball set on a floor, sliding at {speed:g} px/s, no damping, one second")
    space = lab.make("pymunk:Space")
    lab.put(space, gravity=GRAVITY)
    floor_in(lab, space)
    ball = drop(lab, space, Rng(12), (200.0, 300.0))  # of one size under any seed
    lab.put(ball.body, position=(200.0, 560.0 - ball.radius), velocity=(speed, 0.0))
    last = lab.simulate(space, [ball.body], 120, every=120).body(0)[-1]
    rim = last.omega * ball.radius
    lab.want(
        math.isclose(last.vx, speed * 2 / 3, rel_tol=0.1)
        and math.isclose(rim, last.vx, rel_tol=0.03),
        f"about {speed * 2 / 3:.0f} px/s, and as much as spin x radius: it rolls",
        f"{last.vx:.1f} px/s, spin x radius {rim:.1f} px/s",
    )


# ---------------------------------------------------------------- 7c


class Rod(NamedTuple):
    """A joint between the bob and another body, with its ends in px if it has any."""

    kind: str
    far_end: Pair | None
    bob_end: Pair | None
    moves: bool  # the body at the far end moves


def pendulum(lab: Lab) -> tuple[Thing, Thing, list[Rod]]:
    """Return the space of the lab scene, its bob, and the bob's joints."""
    space = scene(lab)
    moving = [body for body in space.bodies if body.kind == "dynamic"]
    found = [body for body in moving if is_near(pair(body.pos), BOB, 1.0)]
    lab.want(len(found) == 1, "the bob at (840, 90)", f"{len(found)} bodies there")
    rods = rods_of(space, found[0].ref, {body.ref for body in moving})
    lab.saw("rods", (), rods)
    for joint in space.joints:
        if joint.distance is not None and found[0].ref in (joint.a, joint.b):
            lab.saw("length", (rods,), compare_length(joint.distance))
    return lab.thing(space), lab.thing(found[0]), rods


def compare_length(length: float) -> int:
    """Return whether a rod is too short (-1), too long (1), or neither (0)."""
    return 0 if math.isclose(length, LENGTH, abs_tol=AT_REST) else 1 if length > LENGTH else -1


def rods_of(space: SpaceValue, bob: int, moving: set[int]) -> list[Rod]:
    rods = []
    for joint in space.joints:
        ends = [(joint.a, pair(joint.anchor_a)), (joint.b, pair(joint.anchor_b))]
        if joint.a == bob:
            ends.reverse()
        (other, far_end), (held, bob_end) = ends
        if held == bob:
            rods.append(Rod(kind_of(joint), far_end, bob_end, other in moving))
    return rods


def kind_of(joint: SpaceJoint) -> str:
    """Return the kind of a joint, and whether it has slack, as a slide joint may."""
    slack = joint.reach is not None and 1.0 < joint.reach[0] < joint.reach[1]
    return joint.kind + " with slack" * slack


def pair(place: Vec | None) -> Pair | None:
    return None if place is None else (place.x, place.y)


def watch_bob(lab: Lab, gravity: float, seconds: float, **start: Any) -> list[Moment]:
    """Return the bob after every step of the lab scene without damping."""
    space, bob, _ = pendulum(lab)
    lab.put(space, gravity=(0.0, gravity), damping=1.0)
    lab.put(bob, **start)
    return lab.simulate(space, [bob], round(seconds / STEP)).body(0)


def want_the_length(lab: Lab, moments: list[Moment], within: float = STRETCH) -> None:
    lengths = [math.dist((each.x, each.y), PIVOT) for each in moments]
    lab.want(
        all(abs(length - LENGTH) <= within for length in lengths),
        f"the bob {LENGTH:.0f} px from (700, 90) all the time, give or take {within:g} px",
        f"it is between {min(lengths):.2f} and {max(lengths):.2f} px away",
    )


def a_joint_holds_the_bob_by_its_centre(lab: Lab) -> None:
    """A joint from (700, 90) holds the bob by its centre"""
    lab.ran("make_space, and looked at the joints of the bob")
    rods = pendulum(lab)[2]
    lab.want(
        any(
            is_near(rod.far_end, PIVOT, 1e-6) and is_near(rod.bob_end, BOB, 1e-6) and not rod.moves
            for rod in rods
        ),
        "a joint from (700, 90), on a body that stays put, to the bob's centre at (840, 90)",
        ", ".join(map(say_rod, rods)) or "no joint on the bob",
    )


def the_bob_hangs_in_the_space_as_it_was_given(lab: Lab) -> None:
    """The bob is as given: a disc of 24 px and 6 kg, at rest"""
    lab.ran("make_space, and looked at the bob")
    space = scene(lab)
    found = [each for each in space.bodies if each.kind == "dynamic" and of_bob(each)]
    lab.want(len(found) == 1, "one disc of 24 px at rest at (840, 90)", f"{len(found)} of them")
    bob = found[0]
    surfaces = [(each.friction, each.elasticity) for each in bob.shapes]
    lab.want(surfaces == [(0.6, 0.2)], "friction 0.6, elasticity 0.2", f"{surfaces}")
    solid = all(each.solid for each in bob.shapes)
    lab.want(solid, "a bob that knocks against all there is", "a sensor, or a filter on its shape")
    right = exact.disc_moment(6.0, 24.0)
    moment = math.inf if bob.moment is None else bob.moment
    lab.want(
        math.isclose(bob.mass, 6.0) and math.isclose(moment, right),
        f"mass 6, and the moment of a full disc: {right:g}",
        f"mass {bob.mass:g}, moment {moment:g}",
    )


def of_bob(body: SpaceBody) -> bool:
    """Return whether a body is a disc of 24 px at rest at the bob's position."""
    at_rest = is_near(pair(body.pos), BOB, 1e-6) and not any((*body.vel, body.omega, body.angle))
    return at_rest and [each.radius for each in body.shapes] == [24.0]


def say_rod(rod: Rod) -> str:
    ends = [f"({end[0]:g}, {end[1]:g})" for end in (rod.far_end, rod.bob_end) if end]
    joint = f"a {rod.kind} with ends at {' and '.join(ends) or 'no point'}"
    return joint + ", on a body that moves" * rod.moves


def the_rod_pushes_and_pulls(lab: Lab) -> None:
    """The rod pushes and pulls: a pushed bob keeps its distance"""
    speed = lab.about(200.0)
    for push in ((-speed, 0.0), (speed, 0.0), (0.0, -speed), (0.0, speed)):
        lab.ran(f"the bob pushed at ({push[0]:g}, {push[1]:g}) px/s, no gravity, half a second")
        want_the_length(lab, watch_bob(lab, 0.0, 0.5, velocity=push))
    for words, y in (("hangs", PIVOT[1] + LENGTH), ("stands", PIVOT[1] - LENGTH)):
        lab.ran(f"the bob {words} at rest on its rod under gravity (0, 980), half a second")
        moments = watch_bob(lab, GRAVITY[1], 0.5, position=(PIVOT[0], y))
        want_the_length(lab, moments, AT_REST)


def the_bob_swings_through_to_the_other_side(lab: Lab) -> None:
    """The bob swings through to the other side at the rod's length"""
    lab.ran("the bob let go at (840, 90) under gravity (0, 980), 2 seconds")
    moments = watch_bob(lab, GRAVITY[1], 2.0)
    want_the_length(lab, moments)
    lowest, leftmost = max(each.y for each in moments), min(each.x for each in moments)
    lab.want(
        lowest > 220.0 and leftmost < 580.0,
        "the bob passes (700, 230) and turns back near (560, 90)",
        f"its lowest point is y = {lowest:.0f} px, its leftmost x = {leftmost:.0f} px",
    )


def the_bob_turns_freely_while_it_swings(lab: Lab) -> None:
    """The bob turns freely while it swings"""
    begin = lab.about(10.0)
    lab.ran(f"the bob let go at (840, 90) with a spin of {begin:g} rad/s, no damping, 2 seconds")
    moments = watch_bob(lab, GRAVITY[1], 2.0, angular_velocity=begin)
    want_the_length(lab, moments)
    spins = [each.omega for each in moments]
    lab.want(
        all(math.isclose(spin, begin, rel_tol=1e-6) for spin in spins),
        f"a spin of {begin:g} rad/s all the time: the rod holds the centre and turns nothing",
        f"the spin is between {min(spins):.2f} and {max(spins):.2f} rad/s",
    )
