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
    Spring,
    Springs,
    World,
)

NAN, INF = math.nan, math.inf


def world_with_ball():
    world = World(effects=[Contacts(), Rods(), Springs()])
    world.add(Body(Circle(10), (0, 0), 1.0))
    return world


def refuse(field, value, call):
    """Return the error's message, which must name field and value."""
    with pytest.raises(ValueError) as raised:
        call()
    message = str(raised.value)
    assert field in message
    assert str(value) in message
    assert message.endswith(".")


@pytest.mark.parametrize("dt", [0, 0.0, -DT, NAN, INF, -INF])
def test_dt(dt):
    refuse("dt", dt, lambda: world_with_ball().step(dt))
    refuse("dt", dt, lambda: World().step(dt))


@pytest.mark.parametrize("number", [NAN, INF, -INF])
@pytest.mark.parametrize("field", ["pos", "vel", "omega"])
def test_setting_nan_or_infinity(field, number):
    body = Body(Circle(10), (0, 0), 1.0)
    value = number if field == "omega" else (0, number)
    refuse(f"Body.{field}", number, lambda: setattr(body, field, value))


@pytest.mark.parametrize("number", [NAN, INF, -INF])
@pytest.mark.parametrize(
    ("slot", "field"),
    [("x", "pos"), ("y", "pos"), ("vx", "vel"), ("vy", "vel"), ("angle", "angle"), ("w", "omega")],
)
def test_nan_or_infinity_in_a_body_that_steps(slot, field, number):
    world = world_with_ball()
    setattr(world.bodies[0], slot, number)
    refuse(f"Body.{field}", number, lambda: world.step(DT))


@pytest.mark.parametrize("pos", [(NAN, 0), (0, INF), (1, 2, 3), (1,)], ids=str)
def test_pos(pos):
    refuse("Body.pos", pos, lambda: Body(Circle(1), pos))


@pytest.mark.parametrize("mass", [-1, -1e-9, NAN, INF])
def test_mass(mass):
    refuse("Body.mass", mass, lambda: Body(Circle(1), (0, 0), mass))


def test_mass_of_a_box():
    refuse("Body.mass", 2.0, lambda: Body(Box((1, 1)), (0, 0), 2.0))


def test_a_static_bullet():
    refuse("Body.mass", 0.0, lambda: Body(Circle(1), (0, 0), bullet=True))


@pytest.mark.parametrize("radius", [0, -1, NAN, INF])
def test_radius(radius):
    refuse("Circle.radius", radius, lambda: Circle(radius))


@pytest.mark.parametrize("half", [(0, 1), (1, 0), (-1, 1), (1, NAN), (INF, 1), (1,)], ids=str)
def test_half_extents(half):
    refuse("Box.half", half[-1], lambda: Box(half))


@pytest.mark.parametrize("friction", [-0.1, NAN, INF])
def test_friction(friction):
    refuse("Body.friction", friction, lambda: Body(Circle(1), (0, 0), 1.0, friction=friction))


@pytest.mark.parametrize("e", [-0.1, 1.1, NAN, INF])
def test_restitution(e):
    refuse("Body.restitution", e, lambda: Body(Circle(1), (0, 0), 1.0, restitution=e))


JOINTS = {"Rod": Rod, "Spring": lambda a, b: Spring(a, b, 1.0)}


@pytest.mark.parametrize("name", JOINTS)
def test_a_joint_between_static_bodies(name):
    a, b = Body(Circle(1), (0, 0)), Body(Box((1, 1)), (9, 7))
    refuse(f"{name}.b", b.pos, lambda: JOINTS[name](a, b))


@pytest.mark.parametrize("name", JOINTS)
def test_a_joint_between_a_body_and_itself(name):
    a = Body(Circle(1), (3, 4), 1.0)
    refuse(f"{name}.b", a.pos, lambda: JOINTS[name](a, a))


@pytest.mark.parametrize("name", JOINTS)
def test_a_joint_to_a_body_that_is_not_in_the_world(name):
    world = world_with_ball()
    stranger = Body(Circle(1), (3, 4), 1.0)
    joint = JOINTS[name](world.bodies[0], stranger)
    refuse(name, stranger.pos, lambda: world.add(joint))


def test_a_rod_of_no_length():
    a, b = Body(Circle(1), (3, 4), 1.0), Body(Circle(1), (3, 4), 1.0)
    refuse("Rod.length", 0.0, lambda: Rod(a, b))


@pytest.mark.parametrize("number", [-1, NAN, INF])
@pytest.mark.parametrize("field", ["stiffness", "damping", "length"])
def test_spring(field, number):
    a, b = Body(Circle(1), (0, 0), 1.0), Body(Circle(1), (9, 0), 1.0)
    good = {"stiffness": 1.0, "damping": 0.0, "length": 5.0}
    refuse(f"Spring.{field}", number, lambda: Spring(a, b, **good | {field: number}))


# ---------------------------------------------------------------- of the wrong type

BODY = Body(Circle(1), (0, 0), 1.0)
WRONG_TYPES = {
    "Circle.radius": ("big", lambda: Circle("big")),
    "Box.half": (5, lambda: Box(5)),
    "Body.shape": ("ball", lambda: Body("ball", (0, 0))),
    "Body.pos": (7, lambda: Body(Circle(1), 7)),
    "Body.mass": ("heavy", lambda: Body(Circle(1), (0, 0), "heavy")),
    "Body.friction": ("rough", lambda: Body(Circle(1), (0, 0), friction="rough")),
    "Body.restitution": ([1], lambda: Body(Circle(1), (0, 0), restitution=[1])),
    "Body.vel": (None, lambda: setattr(BODY, "vel", None)),
    "Body.omega": ("fast", lambda: setattr(BODY, "omega", "fast")),
    "impulse": (3, lambda: BODY.apply_impulse(3)),
    "World.gravity": (980, lambda: World(gravity=980)),
    "World.substeps": ("4", lambda: World(substeps="4")),
    "World.effects": (Contacts, lambda: World(effects=Contacts)),
    "World.effects ": ("Contacts", lambda: World(effects=["Contacts"])),
    "World.add": (Circle, lambda: World().add(Circle)),
    "World.remove": ("it", lambda: World().remove("it")),
    "World.bodies_at": (0, lambda: World().bodies_at(0)),
    "World.step": ("long", lambda: world_with_ball().step("long")),
    "Damping.linear": ("thick", lambda: Damping("thick")),
    "Spring.stiffness": ("hard", lambda: Spring(BODY, Body(Circle(1), (9, 0)), "hard")),
    "Rod": ("peg", lambda: Rod(BODY, "peg")),
}


@pytest.mark.parametrize("field", WRONG_TYPES)
def test_a_wrong_type_is_an_error_in_a_sentence(field):
    value, call = WRONG_TYPES[field]
    refuse(field.strip(), value, call)


# ---------------------------------------------------------------- set later, taken out


@pytest.mark.parametrize("number", [-0.1, NAN, INF])
@pytest.mark.parametrize("field", ["friction", "restitution", "mass"])
def test_setting_what_a_body_is_like(field, number):
    body = Body(Circle(1), (0, 0), 1.0, 0.5, 0.5)
    refuse(f"Body.{field}", number, lambda: setattr(body, field, number))
    assert (body.friction, body.restitution, body.mass) == (0.5, 0.5, 1)


def test_a_body_stays_static_or_not():
    static, moving = Body(Circle(1), (0, 0)), Body(Circle(1), (0, 0), 1.0)
    refuse("Body.mass", 2, lambda: setattr(static, "mass", 2))
    refuse("Body.mass", 0, lambda: setattr(moving, "mass", 0))
    refuse("Body.mass", 0, lambda: static.apply_impulse((1, 0)))


def test_taking_out_what_is_not_there():
    world, other = world_with_ball(), world_with_ball()
    stranger = other.bodies[0]
    refuse("World.remove", stranger, lambda: world.remove(stranger))
    for make in JOINTS.values():
        joint = make(world.bodies[0], Body(Circle(1), (9, 9), 1.0))
        refuse(type(joint).__name__, joint, lambda joint=joint: world.remove(joint))


def test_something_added_twice():
    world = world_with_ball()
    ball = world.bodies[0]
    refuse("body", ball.pos, lambda: world.add(ball))
    refuse("body", ball.pos, lambda: World().add(ball))
    for make in JOINTS.values():
        joint = world.add(make(ball, world.add(Body(Circle(1), (9, 9), 1.0))))
        refuse(type(joint).__name__, "already", lambda joint=joint: world.add(joint))


@pytest.mark.parametrize("gravity", [(0, NAN), (INF, 0), (1, 2, 3)], ids=str)
def test_gravity(gravity):
    refuse("World.gravity", gravity, lambda: World(gravity=gravity))


@pytest.mark.parametrize("substeps", [0, -1, 2.5, NAN])
def test_substeps(substeps):
    refuse("World.substeps", substeps, lambda: World(substeps=substeps))
    refuse("World.substeps", substeps, lambda: setattr(World(), "substeps", substeps))


@pytest.mark.parametrize("rate", [-0.1, NAN, INF])
@pytest.mark.parametrize("field", ["linear", "angular"])
def test_damping(field, rate):
    refuse(f"Damping.{field}", rate, lambda: Damping(**{field: rate}))


def test_effects():
    refuse("World.effects", "Contacts() twice", lambda: World(effects=[Contacts(), Contacts()]))
    refuse("World.effects", Contacts, lambda: World(effects=[Contacts]))
    shared = Contacts()
    World(effects=[shared])
    refuse("Contacts.world", "another", lambda: World(effects=[shared]))
