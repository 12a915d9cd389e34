"""Test that bad input raises ValueError with the value and the field."""

import math

import pytest

from experiments.scenes import DT
from stable_engine import (
    Body,
    Box,
    Circle,
    Contacts,
    Damping,
    Rod,
    Rods,
    Segment,
    Spring,
    Springs,
    World,
)

NAN, INF = math.nan, math.inf


def world_with_ball():
    world = World(effects=[Contacts(), Rods(), Springs()])
    world.add(Body(Circle(10), (0, 0), 1.0))
    return world


def ball(**options):
    return Body(Circle(1), (3, 4), **{"mass": 1.0, **options})


def spring(**options):
    return Spring(BODY, OTHER, **{"stiffness": 1.0, "damping": 0.0, "length": 5.0, **options})


def refuse(field, value, call):
    """Call something that must fail, with field and value in its message."""
    with pytest.raises(ValueError) as raised:
        call()
    message = str(raised.value)
    assert field in message
    assert str(value) in message
    assert message.endswith(".")


BODY, OTHER, STATIC = ball(), Body(Circle(1), (9, 0), 1.0), ball(mass=0.0)
NOT_FINITE = (NAN, INF, -INF)
NO_PAIRS = ((NAN, 0), (0, INF), (1, 2, 3), (1,))
VALUES = [  # a field, what sets it, and what it refuses
    ("dt", lambda dt: world_with_ball().step(dt), (0, 0.0, -DT, "long", *NOT_FINITE)),
    ("dt", lambda dt: World().step(dt), (0, 0.0, -DT, *NOT_FINITE)),
    ("World.gravity", lambda g: World(gravity=g), (980, (0, NAN), (INF, 0), (1, 2, 3))),
    ("World.substeps", lambda n: World(substeps=n), (0, -1, 2.5, NAN, "4")),
    ("World.substeps", lambda n: setattr(World(), "substeps", n), (0, -1, 2.5, NAN)),
    ("World.unit", lambda unit: World(unit=unit), (0, -1, NAN, INF)),
    ("World.effects", lambda effects: World(effects=effects), (Contacts,)),
    ("World.effects", lambda name: World(effects=[name]), ("Contacts", Contacts)),
    ("World.add", lambda thing: World().add(thing), (Circle,)),
    ("World.remove", lambda thing: World().remove(thing), ("it", BODY)),
    ("World.bodies_at", lambda point: World().bodies_at(point), (0,)),
    ("Damping.linear", lambda rate: Damping(linear=rate), (-0.1, NAN, INF, "thick")),
    ("Damping.angular", lambda rate: Damping(angular=rate), (-0.1, NAN, INF)),
    ("Circle.radius", Circle, (0, -1, NAN, INF, "big")),
    ("Box.half", Box, ((0.0, 1.0), (1.0, 0.0), (-1.0, 1.0), (1, NAN), (INF, 1), (1,), 5)),
    ("Segment.start", lambda start: Segment(start, (1, 1)), NO_PAIRS),
    ("Segment.end", lambda end: Segment((0, 0), end), (*NO_PAIRS, (0.0, 0.0))),
    ("Segment.radius", lambda radius: Segment((0, 0), (1, 1), radius), (-1, NAN)),
    ("Body.shape", lambda shape: Body(shape, (0, 0)), ("ball",)),
    ("Body.pos", lambda pos: Body(Circle(1), pos), (7, None, *NO_PAIRS)),
    ("Body.pos", lambda pos: Body(Box((1, 1)), pos), (None,)),
    ("Body.pos", lambda y: setattr(ball(), "pos", (0, y)), NOT_FINITE),
    ("Body.vel", lambda y: setattr(ball(), "vel", (0, y)), NOT_FINITE),
    ("Body.vel", lambda vel: setattr(ball(), "vel", vel), (None,)),
    ("Body.omega", lambda omega: setattr(ball(), "omega", omega), ("fast", *NOT_FINITE)),
    ("Body.omega", lambda omega: setattr(Body(Box((1, 1)), (0, 0)), "omega", omega), (2,)),
    ("Body.mass", lambda mass: ball(mass=mass), (-1, -1e-9, NAN, INF, "heavy")),
    ("Body.mass", lambda mass: Body(Box((1, 1)), (0, 0), mass), (2.0,)),
    ("Body.mass", lambda mass: Body(Segment((0, 0), (1, 1)), mass=mass), (2.0,)),
    ("Body.mass", lambda mass: ball(mass=mass, bullet=True), (0.0,)),
    ("Body.mass", lambda mass: setattr(STATIC, "mass", mass), (2,)),
    ("Body.mass", lambda mass: setattr(ball(), "mass", mass), (0,)),
    ("Body.mass is 0", lambda x: STATIC.apply_impulse((x, 0)), (0,)),
    ("Body.friction", lambda mu: ball(friction=mu), (-0.1, NAN, INF, "rough")),
    ("Body.restitution", lambda e: ball(restitution=e), (-0.1, 1.1, NAN, INF, [1])),
    ("impulse", lambda impulse: BODY.apply_impulse(impulse), (3,)),
    ("Rod", lambda other: Rod(BODY, other), ("peg",)),
    ("Spring.stiffness", lambda k: spring(stiffness=k), (-1, NAN, INF, "hard")),
    ("Spring.damping", lambda c: spring(damping=c), (-1, NAN, INF)),
    ("Spring.length", lambda length: spring(length=length), (-1, NAN, INF)),
]


@pytest.mark.parametrize(
    ("field", "call", "value"), [(field, call, v) for field, call, values in VALUES for v in values]
)
def test_a_value_is_refused(field, call, value):
    refuse(field, value, lambda: call(value))


def test_a_velocity_is_not_taken_for_a_flag():
    with pytest.raises(TypeError, match="positional arguments"):
        Body(Circle(1), (3, 4), 1.0, 0.3, 0.6, (0, 100))


@pytest.mark.parametrize("number", NOT_FINITE)
@pytest.mark.parametrize(
    ("slot", "field"),
    [("x", "pos"), ("y", "pos"), ("vx", "vel"), ("vy", "vel"), ("turn", "angle"), ("w", "omega")],
)
def test_nan_or_infinity_in_a_body_that_steps(slot, field, number):
    world = world_with_ball()
    setattr(world.bodies[0], slot, number)
    refuse(f"Body.{field}", number, lambda: world.step(DT))


@pytest.mark.parametrize("number", [-0.1, NAN, INF])
@pytest.mark.parametrize("field", ["friction", "restitution", "mass"])
def test_a_refused_surface_or_mass_leaves_a_body_as_it_was(field, number):
    body = Body(Circle(1), (0, 0), 1.0, 0.5, 0.5)
    refuse(f"Body.{field}", number, lambda: setattr(body, field, number))
    assert (body.friction, body.restitution, body.mass) == (0.5, 0.5, 1)


@pytest.mark.parametrize("make", [Rod, lambda a, b: Spring(a, b, 1.0)], ids=["Rod", "Spring"])
def test_a_joint_needs_two_bodies_of_the_world_that_can_move(make):
    world, other = world_with_ball(), ball()
    joint = make(world.bodies[0], other)
    name = type(joint).__name__
    block = Body(Box((1, 1)), (9, 7))
    refuse(f"{name}.b", block.pos, lambda: make(STATIC, block))
    refuse(f"{name}.b", other.pos, lambda: make(other, other))
    refuse(name, other.pos, lambda: world.add(joint))
    refuse(name, joint, lambda: world.remove(joint))
    world.add(other)
    world.add(joint)
    refuse(name, "already", lambda: world.add(joint))


def test_a_rod_has_a_length():
    refuse("Rod.length", 0.0, lambda: Rod(ball(), ball()))


def test_a_body_is_added_once():
    world = world_with_ball()
    (ball,) = world.bodies
    refuse("body", ball.pos, lambda: world.add(ball))
    refuse("body", ball.pos, lambda: World().add(ball))


def test_an_effect_belongs_to_one_world():
    refuse("World.effects", "Contacts() twice", lambda: World(effects=[Contacts(), Contacts()]))
    shared = Contacts()
    World(effects=[shared])
    refuse("Contacts()", "in another world", lambda: World(effects=[shared]))
