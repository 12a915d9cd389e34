"""Test the use of a running world: set, push, remove, query, callbacks."""

import copy
import math
import random
from itertools import product

import numpy as np
import pytest
from pygame import Vector2
from worlds_for_tests import balls, build, build_playground, make, state

from experiments.measures import run, watch
from experiments.scenes import (
    BOUNCE,
    DT,
    EFFECTS,
    TOUCH,
    Ball,
    Block,
    G,
    Scene,
    chain,
    floor,
    on_floor,
)
from stable_engine import (
    Body,
    Bounce,
    Box,
    Bullets,
    Circle,
    Contacts,
    Damping,
    Effect,
    Friction,
    Kinematics,
    Rod,
    Rods,
    Segment,
    Sleep,
    Spring,
    Springs,
    World,
)

SLEEPY = (*BOUNCE, "Sleep")


# ---------------------------------------------------------------- setting a body's properties


def test_friction_set_while_bodies_touch_counts_from_the_next_step():
    world = build(on_floor(vel=(300.0, 0.0), friction=0.0))
    ground, ball = world.bodies
    run(world, 0.5)
    assert (ball.vx, ball.w) == (300, 0)
    ground.friction = ball.friction = 0.5
    world.step(DT)
    assert ball.vx == pytest.approx(300 - 0.5 * G * DT, rel=1e-3)
    ball.friction = 0
    slower = ball.vx
    run(world, 0.5)
    assert ball.vx == slower


def test_a_mass_set_counts_for_inertia_rods_and_springs():
    world = build(chain(2), "Rods", "Springs")
    _, a, b = world.bodies
    (_, rod), spring = world.effects["Rods"].joints, world.add(Spring(a, b, 1.0))
    b.mass = 4
    assert (rod.m, spring.m) == pytest.approx((0.8, 0.8))
    assert b.inv_inertia == pytest.approx(2 / (4 * b.radius**2))


@pytest.mark.parametrize(("field", "value"), [("mass", 5), ("friction", 0), ("restitution", 1)])
def test_setting_mass_or_surface_wakes_a_body_and_its_neighbours(field, value):
    world = build(Scene([floor(), Ball((0, -10)), Ball((0, -30))]), *SLEEPY)
    run(world, 2)
    assert world.awake == []
    setattr(world.bodies[1], field, value)
    assert world.awake == balls(world)
    if field != "mass":
        run(world, 3)
        setattr(world.bodies[0], field, value)
        assert world.bodies[1] in world.awake


@pytest.mark.parametrize("rate", [1.0, 20.0])
def test_damping_takes_no_weight_off_what_is_held(rate):
    """At rest nothing moves, so drag is 0 and a floor, a rod and a spring bear m g."""
    names = ("Contacts", "Rods", "Springs")
    world = World(effects=[*make(names), Damping(rate, rate)])
    world.add(Body(Box((100, 10)), (0, 10)))
    lying, peg = world.add(Body(Circle(10), (0, -10), mass=2)), Body(Circle(1), (300, 0))
    world.add(peg)
    rod = world.add(Rod(peg, world.add(Body(Circle(5), (300, 50), mass=2))))
    spring = world.add(Spring(peg, world.add(Body(Circle(5), (300, -50), mass=2)), 500.0, 50.0))
    run(world, 10)
    (contact,) = world.effects["Contacts"].of_body(lying)
    borne = [abs(held.impulse) * world.substeps / DT for held in (contact, rod, spring)]
    assert borne == pytest.approx([2 * G] * 3, rel=1e-6)


@pytest.mark.parametrize("substeps", [1, 4])
@pytest.mark.parametrize("rate", [0.5, 2.0, 20.0])
def test_drag_balances_a_force_at_its_terminal_speed(rate, substeps):
    """v = a / rate (1 - exp(-rate t)) under gravity, a push and a torque, whatever the step."""
    world = World((0, G), substeps, [Damping(rate, rate)])
    ball = world.add(Body(Circle(10), (0, 0), mass=2))
    for _ in range(round(1 / DT)):
        ball.apply_force((3000, 0))
        ball.apply_torque(2 * 10**2 / 2)
        world.step(DT)
    share = -math.expm1(-rate) / rate
    assert (*ball.vel, ball.omega) == pytest.approx((1500 * share, G * share, share), rel=1e-9)
    way = G / rate * (1 - share)
    assert ball.y == pytest.approx(way, abs=G * share * DT / substeps)


def test_drag_alone_leaves_exactly_its_share():
    world = World((0, 0), 4, [Damping(0.5, 2.0)])
    ball = world.add(Body(Circle(10), (0, 0), mass=2))
    ball.vel, ball.omega = (300, -40), 5.0
    run(world, 1)
    kept = math.exp(-0.5)
    assert (*ball.vel, ball.omega) == pytest.approx((300 * kept, -40 * kept, 5 * math.exp(-2)))


def test_a_lift_carries_a_ball_through_drag():
    """Drag slows a ball, but not the lift that it stands on."""
    effects = [*make(["Contacts", "Kinematics"]), Damping(2.0, 2.0)]
    world = World(effects=effects)
    lift = world.add(Body(Box((100, 10)), (0, 10), kinematic=True))
    lift.vel, ball = (0, -100), world.add(Body(Circle(10), (0, -10), mass=2))
    run(world, 3)
    assert ball.y - lift.y == pytest.approx(-20, abs=0.1)


# ---------------------------------------------------------------- all that can be set

# Each attribute, and whether setting it has an effect. Other attributes cannot be set.
SETTABLE = {
    "Body.angle": (1.0, lambda body: body.angle > 0.9),
    "Body.bullet": (True, lambda body: body.world.effects["Bullets"].bodies == [body]),
    "Body.friction": (0.1, lambda body: contact_of(body).mu == pytest.approx(math.sqrt(0.06))),
    "Body.mass": (3.0, lambda body: contact_of(body).mn == pytest.approx(3)),
    "Body.omega": (5.0, lambda body: body.angle > 0.03),
    "Body.pos": ((5.0, -10.0), lambda body: body.x == pytest.approx(5, abs=0.1)),
    "Body.restitution": (0.9, lambda body: contact_of(body).e == 0.9),
    "Body.vel": ((9.0, 0.0), lambda body: body.x > 0.05),
    "Rod.length": (60.0, lambda rod: rod.a.pos.distance_to(rod.b.pos) > 50.1),
    "Spring.damping": (50.0, lambda spring: spring.b.vy < 14),
    "Spring.length": (90.0, lambda spring: spring.b.vy > 50),
    "Spring.stiffness": (0.0, lambda spring: spring.b.vy == pytest.approx(G * DT)),
    "World.gravity": ((500.0, 0.0), lambda world: world.bodies[1].vx > 1),
    "World.substeps": (8, lambda world: world.substeps == 8),
}
FIXED = [
    *("Body.shape", "Body.radius", "Body.asleep", "Body.is_static", "Body.kinematic"),
    *("Rod.a", "Rod.b", "Rod.impulse", "Spring.a", "Spring.b", "Spring.impulse"),
    *("World.bodies", "World.unit", "World.effects", "Circle.radius", "Box.half"),
    *("Segment.start", "Segment.end", "Segment.radius"),
]
SHAPES = ["Circle", "Box", "Segment"]


def contact_of(body):
    return next(c for c in body.world.effects["Contacts"].touching if body in (c.a, c.b))


def things():
    """Return one object of each kind, in a world of balls on a floor, a rod and a spring."""
    world = World(effects=[Contacts(), Friction(), Bounce(), Rods(), Springs(), Bullets(), Sleep()])
    ground = world.add(Body(Box((500, 50)), (0, 50), restitution=1, friction=0.6))
    ball = world.add(Body(Circle(10), (0, -10), mass=1, restitution=1))
    peg = world.add(Body(Circle(5), (200, -200)))
    rod = world.add(Rod(peg, world.add(Body(Circle(5), (200, -150), mass=1))))
    spring = world.add(Spring(peg, world.add(Body(Circle(5), (200, -300), mass=1)), 1000.0))
    spring.b.pos = (200, -301)
    return {
        **{"World": world, "Body": ball, "Rod": rod, "Spring": spring},
        **{"Circle": ball.shape, "Box": ground.shape, "Segment": Segment((0, 0), (1, 1))},
    }


@pytest.mark.parametrize("name", SETTABLE)
def test_an_attribute_that_can_be_set_takes_effect(name):
    kind, _, field = name.partition(".")
    value, has_effect = SETTABLE[name]
    there = things()
    thing, world = there[kind], there["World"]
    run(world, 0.5 if kind == "Body" and field != "mass" else 0.1)
    if kind == "Spring":
        thing.b.pos, thing.b.vel = (200, -301), (0, 0)
    setattr(thing, field, value)
    world.step(DT)
    assert has_effect(thing)


@pytest.mark.parametrize("name", FIXED)
def test_other_attributes_cannot_be_set(name):
    kind, _, field = name.partition(".")
    thing = things()[kind]
    with pytest.raises(AttributeError):
        setattr(thing, field, getattr(thing, field))


def test_lists_of_a_world_cannot_be_changed_behind_its_back():
    world = things()["World"]
    before = world.bodies
    world.bodies.clear()
    assert world.bodies == before
    with pytest.raises(TypeError):
        world.effects["Damping"] = Damping()


@pytest.mark.parametrize("name", ["on_hit", "on_part"])
def test_what_a_world_tells_can_be_set_later(name):
    told, world = [], World(effects=[Contacts()])
    ball = world.add(Body(Circle(10), (0, -10.5), mass=1))
    world.add(Body(Box((50, 50)), (0, 50)))
    run(world, 0.1)
    setattr(world.effects["Contacts"], name, lambda *pair: told.append(pair[:2]))
    for height in (-100, -10.1):
        ball.pos = (0, height)
        run(world, 0.1)
    assert told == [(ball, world.bodies[1])]
    with pytest.raises(ValueError, match=f"Contacts.{name} is 5, but it must be a function"):
        setattr(world.effects["Contacts"], name, 5)


@pytest.mark.parametrize("name", ["damping", "iterations", "gravty"])
def test_a_name_that_a_world_does_not_have_cannot_be_set(name):
    with pytest.raises(AttributeError, match=name):
        setattr(World(), name, 5)


@pytest.mark.parametrize("name", [*EFFECTS, "Kinematics"])
def test_a_name_that_an_effect_does_not_have_cannot_be_set(name):
    (effect,) = make([name])
    with pytest.raises(AttributeError, match="on_begin"):
        effect.on_begin = print


@pytest.mark.parametrize("kind", ["World", "Body", "Rod", "Spring", *SHAPES])
def test_no_property_is_left_out(kind):
    properties = {
        f"{kind}.{name}"
        for one in type(things()[kind]).__mro__
        for name, value in vars(one).items()
        if isinstance(value, property)
    }
    assert properties <= {*SETTABLE, *FIXED}


def test_a_ball_made_a_bullet_later_is_stopped_and_one_made_none_is_swept_no_more():
    world = World(gravity=(0, 0), effects=[Contacts(), Bullets()])
    world.add(Body(Box((150, 1)), (0, 0)))
    ball = world.add(Body(Circle(3), (0, -100), mass=1))
    world.step(DT)
    ball.bullet = True
    ball.vel = (0, 200_000)
    run(world, 0.1)
    assert ball.y < 0
    ball.bullet = False
    assert world.effects["Bullets"].bodies == []
    ball.bullet = True
    world.remove(ball)
    assert world.effects["Bullets"].bodies == []


def test_a_bullet_in_a_world_without_bullets_is_refused_later_too():
    world = World(effects=[Contacts()])
    ground, ball = world.add(Body(Box((9, 9)), (0, 9))), world.add(Body(Circle(3), (0, -9), mass=1))
    with pytest.raises(ValueError, match=r"needs Bullets\(\)"):
        ball.bullet = True
    assert not ball.bullet
    with pytest.raises(ValueError, match=r"Body\.mass"):
        ground.bullet = True


# ---------------------------------------------------------------- pushing


@pytest.mark.parametrize(("at", "arm"), [(None, 0), ((5, -5), 10)], ids=["centre", "top"])
def test_an_impulse_changes_velocity_and_at_the_rim_spin(at, arm):
    ball = Body(Circle(10), (5, 5), mass=4)
    ball.apply_impulse((8, -4), at)
    assert ball.vel == (2, -1)
    assert ball.omega == pytest.approx(8 * arm / (4 * 10**2 / 2))  # clockwise


def test_a_force_acts_for_one_step_and_adds_up():
    world = World(gravity=(0, 0), effects=[Contacts()])
    ball = world.add(Body(Circle(10), (5, 5), mass=4))
    ball.apply_force((300, -100))
    ball.apply_force((100, -100))
    assert ball.vel == (0, 0)
    world.step(DT)
    assert tuple(ball.vel) == pytest.approx((100 * DT, -50 * DT), rel=1e-12)
    once = ball.vel
    run(world, 0.5)
    assert ball.vel == once
    for _ in range(120):
        ball.apply_force((400, 0))
        world.step(DT)
    assert ball.vx == pytest.approx(100 * 121 * DT, rel=1e-12)


def test_a_force_that_begins_in_a_fall_acts_for_one_step_as_well():
    world = World(gravity=(0, G))
    ball = world.add(Body(Circle(10), (5, 5), mass=4))
    world.step(DT)
    ball.apply_force((400, 0))
    world.step(DT)
    assert ball.vx == pytest.approx(100 * DT, rel=1e-12)
    run(world, 0.1)
    assert ball.vx == pytest.approx(100 * DT, rel=1e-12)


class Unloads(Effect):
    """Count how often bodies press less."""

    __slots__ = ("count",)
    rank = 9

    def __init__(self):
        self.count = 0

    def unload(self, lost, direction):
        self.count += 1


@pytest.mark.parametrize("gravity", [(0, 0), (0, G)])
def test_a_force_ends_once(gravity):
    unloads = Unloads()
    world = World(gravity, effects=[Contacts(), unloads])
    ball = world.add(Body(Circle(10), (5, 5), mass=4))
    ball.apply_force((300, -100))
    run(world, 5 * DT)
    assert unloads.count == 1


@pytest.mark.parametrize("substeps", [2, 4])
def test_forces_that_change_give_their_impulse(substeps: int):
    """m v is the sum of F dt: forces that cancel leave nothing, however they change."""
    world = World((0, G), substeps)
    ball = world.add(Body(Circle(10), (0, 0), mass=2))
    forces = [(120, 0), (-120, 40), (0, -40), *((each, 0) for each in range(120))]
    for each in forces:
        ball.apply_force(each)
        world.step(DT)
    time, impulse = len(forces) * DT, sum(x for x, _ in forces) * DT
    assert tuple(ball.vel) == pytest.approx((impulse / 2, G * time))
    assert ball.pos.y == pytest.approx(G * time**2 / 2 + (1.5 * 40 - 0.5 * 40) / 2 * DT**2)


def test_a_pull_that_follows_the_position_keeps_an_orbit_in_single_short_substeps():
    """As the page of effects says: within 1 px of a circle of 200 px, for ten rounds."""
    world = World((0, 0), substeps=1)
    moon = world.add(Body(Circle(5), (200, 0), mass=2))
    moon.vel = (0, 400)
    for _ in range(round(10 * math.pi * 240)):
        moon.apply_force(-moon.pos * (2 * 400**2 * 200 / moon.pos.length() ** 3))
        world.step(1 / 240)
        assert moon.pos.length() == pytest.approx(200, abs=1)


def test_a_force_at_the_rim_and_a_torque_turn_clockwise():
    world = World(gravity=(0, 0))
    ball, other = (world.add(Body(Circle(10), (x, 5), mass=4)) for x in (5, 500))
    ball.apply_force((800, 0), at=(5, -5))  # at the top, to the right: clockwise
    other.apply_torque(8000)
    world.step(DT)
    assert tuple(ball.vel) == pytest.approx((200 * DT, 0))
    assert other.vel == (0, 0)
    assert ball.omega == other.omega == pytest.approx(8000 * DT / (4 * 10**2 / 2))


def test_a_force_that_holds_a_ball_up_keeps_it_awake_and_ends_with_it():
    world = build(Scene([floor(), Ball((0, -10)), Ball((300, -10))]), *SLEEPY)
    run(world, 2)
    ball, other = world.bodies[1:]
    for _ in range(120):
        ball.apply_force((0, -G / 2))
        world.step(DT)
        assert not ball.asleep
    assert other.asleep
    ball.apply_force((1e6, 0))
    world.remove(ball)
    world.add(ball)
    world.step(DT)
    assert ball.vx == 0


def test_pushing_a_static_or_foreign_body_is_an_error():
    world = World()
    wall, ball = world.add(Body(Box((9, 9)), (0, 9))), Body(Circle(3), (0, -9), mass=1)
    with pytest.raises(ValueError, match=r"Body\.mass"):
        wall.apply_force((1, 0))
    with pytest.raises(ValueError, match=r"Body\.world"):
        ball.apply_torque(1)
    with pytest.raises(ValueError, match=r"apply_torque's torque"):
        ball.apply_torque(math.nan)


# ---------------------------------------------------------------- reading


def test_impulses_of_contacts_rods_and_springs_are_the_forces_they_bear():
    world = build(Scene([floor(), Ball((0, -10), mass=3)]), *TOUCH, "Rods", "Springs")
    ground, ball = world.bodies
    peg = world.add(Body(Circle(5), (300, -300)))
    bob, weight = (world.add(Body(Circle(5), (x, -200), mass=2)) for x in (300, 400))
    rod = world.add(Rod(peg, bob))
    nail = world.add(Body(Circle(5), (400, -300)))
    spring = world.add(Spring(nail, weight, 1000.0, 50.0))
    run(world, 5)
    h = DT / world.substeps
    (c,) = world.effects["Contacts"].of_body(ball)
    assert (c.a, c.b, c.friction_impulse) == (ball, ground, 0)
    assert c.point == (0, ball.y + 10)
    assert c.impulse / h == pytest.approx(3 * G, rel=1e-3)
    assert rod.impulse / h == pytest.approx(-2 * G, rel=1e-3)
    assert spring.impulse / h == pytest.approx(-2 * G, rel=1e-3)


def test_one_axis_of_a_vector_cannot_be_set():
    ball = Body(Circle(10), (5, 5), mass=1)

    def by_index():
        ball.vel[0] = 5

    changes = [
        lambda: setattr(ball.vel, "x", 5),
        lambda: setattr(ball.pos, "y", 5),
        lambda: setattr(ball.pos, "xy", (5, 6)),
        by_index,
        lambda: ball.vel.update(5, 5),
        lambda: ball.pos.scale_to_length(3),
        lambda: ball.pos.rotate_ip(90),
    ]
    for change in changes:
        with pytest.raises(AttributeError, match=r"Body\.(vel|pos) cannot .* body\.(vel|pos) \+= "):
            change()
    assert (ball.pos, ball.vel) == ((5, 5), (0, 0))


def test_vectors_are_set_whole_and_their_sums_are_ordinary():
    ball = Body(Circle(10), (5, 5), mass=1)
    ball.vel += (5, 0)
    ball.pos = ball.pos + Vector2(1, 1)
    assert (ball.pos, ball.vel) == ((6, 6), (5, 0))
    for vector in (ball.pos + Vector2(1, 1), ball.pos * 2, ball.pos.copy(), Vector2(ball.pos)):
        vector.x += 1
        vector.scale_to_length(10)
        assert vector.length() == pytest.approx(10)
    assert isinstance(ball.pos, Vector2)


def test_a_repr_shows_the_values_of_an_object():
    world = World(effects=[Contacts(), Bounce()])
    world.add(Body(Box((450, 20)), (450, 580)))
    ball = world.add(Body(Circle(10), (1.5, 2), mass=3))
    ball.vel = (4, 5)
    assert repr(world) == "World(1 moving, 1 static, effects=[Contacts(), Bounce()])"
    assert repr(world.bodies[0]) == "Body(Box((450, 20)), (450, 580))"
    assert repr(ball) == "Body(Circle(10), (1.5, 2), mass=3, vel=(4, 5))"
    rod = Rod(Body(Circle(1), (0, 0)), Body(Circle(1), (3, 4), mass=1))
    assert repr(rod).startswith("Rod(Body(")
    assert repr(rod).endswith("length 5)")
    ball.pos = (1.5, 551)
    world.step(DT)
    (contact,) = world.effects["Contacts"].all_contacts()
    assert repr(contact) == f"Contact({ball!r}, {world.bodies[0]!r})"


def test_the_bodies_at_a_point_are_found():
    world = build(Scene([Block((0, 0), (20, 10)), Ball((25, 0)), Ball((25, 10), 1)]))
    block, large, small = world.bodies
    assert world.bodies_at((0, 0)) == [block]
    assert world.bodies_at((20, 0)) == [block, large]
    assert world.bodies_at(Vector2(25, 9.5)) == [large, small]
    assert world.bodies_at((21, 10)) == []


# ---------------------------------------------------------------- removing


def test_a_body_taken_out_is_gone_and_what_lay_on_it_falls():
    world = build(Scene([floor(), Ball((0, -10)), Ball((0, -30))]), *SLEEPY)
    run(world, 2)
    ground, lower, upper = world.bodies
    world.remove(lower)
    assert world.bodies == [ground, upper]
    assert world.awake == [upper]
    run(world, 2)
    assert upper.y == pytest.approx(-10, abs=0.01)
    world.remove(ground)
    run(world, 1)
    assert upper.y > 100
    world.remove(upper)
    world.step(DT)
    assert world.bodies == world.awake == world.statics == []


def test_a_body_takes_its_joints_along_and_can_be_added_again():
    world = build(chain(3), "Rods", "Contacts")
    bodies, rods = list(world.bodies), list(world.effects["Rods"].joints)
    world.remove(bodies[2])
    assert world.effects["Rods"].joints == rods[:1]
    run(world, 1)
    assert bodies[3].y > 200
    again = world.add(bodies[2])
    world.add(Rod(bodies[1], again))
    assert len({body.id for body in world.bodies}) == 4
    run(world, 1)


def test_a_rod_taken_out_lets_go_and_its_bodies_touch_again():
    world = build(Scene([Ball((0, 0)), Ball((15, 0))], ("Contacts", "Rods"), [(0, 1)]))
    (rod,) = world.effects["Rods"].joints
    run(world, 0.2)
    assert world.bodies[1].x - world.bodies[0].x == pytest.approx(15, abs=0.01)
    world.remove(rod)
    run(world, 1)
    assert world.bodies[1].x - world.bodies[0].x == pytest.approx(20, abs=0.01)
    world.add(rod)


def test_a_world_goes_on_as_if_what_was_taken_out_had_never_been():
    scene = Scene([floor(), Ball((0, -50)), Ball((3, -90)), Ball((500, -300))], BOUNCE)
    full, less = build(scene), build(Scene(scene.bodies[:-1], BOUNCE))
    run(full, 0.2)
    run(less, 0.2)
    full.remove(full.bodies[-1])
    run(full, 2)
    run(less, 2)
    assert [(b.x, b.y, b.w) for b in full.bodies] == [(b.x, b.y, b.w) for b in less.bodies]


def test_a_loop_over_the_bodies_may_remove_them():
    world = build(Scene([floor(), *(Ball((30 * i, -10)) for i in range(5))]))
    for body in world.bodies:
        if not body.is_static:
            world.remove(body)
    assert len(world.bodies) == 1
    assert world.awake == []


# ---------------------------------------------------------------- numbers and copies


def test_numbers_of_numpy_leave_plain_floats_behind():
    world = World(np.array([0, 980]), substeps=np.int64(2))
    ball = world.add(Body(Circle(np.float32(10)), np.array([1e9, 0]), mass=np.float32(2)))
    ball.vel = np.array([1, 2], np.float32)
    world.step(np.float32(DT))
    assert {type(number) for number in (ball.x, ball.vx, ball.m, ball.radius)} == {float}
    assert type(world.substeps) is int


def test_a_deep_copy_of_a_world_goes_on_as_the_world_does():
    names = ["Contacts", "Friction", "Bounce", "Rods", "Springs", "Bullets", "Sleep"]
    world = build_playground(names)
    run(world, 0.5)
    saved, before = copy.deepcopy(world), state(world)
    run(world, 2)
    assert state(saved) == before
    run(saved, 2)
    assert state(saved) == state(world)


# ---------------------------------------------------------------- callbacks


def test_a_hit_calls_back_once_with_its_speed():
    hits = []
    world = World(effects=[Contacts(lambda *hit: hits.append(hit)), Friction()])
    ground = world.add(Body(Box((100, 50)), (0, 50)))
    ball = world.add(Body(Circle(10), (0, -110), mass=1))
    run(world, 2)
    ((a, b, fast),) = hits
    assert (a, b) == (ball, ground)
    assert fast == pytest.approx(math.sqrt(2 * G * 100), rel=0.02)


@pytest.mark.parametrize("offset", [-0.9, -0.5, 0.0, 0.3, 0.75, 0.95])
def test_a_fast_oblique_hit_tells_the_speed_along_the_normal_at_the_touch(offset):
    """Two balls of 5 px meet at 1500 px/s, `offset` of both radii aside: they pass in a step."""
    hits = []
    world = World((0, 0), effects=[Contacts(lambda a, b, fast: hits.append(fast)), Bounce()])
    direct = math.sqrt(1 - offset**2)
    start = (-10 * direct - 1500 * 0.21, -10 * offset)
    for pos in (start, (0, 0)):
        world.add(Body(Circle(5), pos, mass=1, restitution=1))
    world.bodies[0].vel = 1500, 0
    run(world, 0.4)
    assert hits == [pytest.approx(1500 * direct, rel=1e-6)]


def test_every_bounce_is_a_hit():
    hits = []
    world = World(effects=[Contacts(lambda a, b, fast: hits.append(fast)), Bounce()])
    world.add(Body(Box((100, 50)), (0, 50), restitution=0.5))
    world.add(Body(Circle(10), (0, -510), mass=1, restitution=0.5))
    run(world, 3)
    assert hits[1] == pytest.approx(hits[0] / 2, rel=0.02)
    assert hits[2] == pytest.approx(hits[0] / 4, rel=0.04)


def test_a_callback_of_a_hit_may_remove_and_add_bodies():
    def swap(a, b, _):
        for body in (a, b):
            world.remove(body)
        world.add(Body(Circle(5), (0, -300), mass=1))

    scene = Scene([Ball((0, 0)), Ball((50, 0), vel=(-500, 0)), Ball((0, 50), vel=(0, -500))])
    world = build(scene, *TOUCH, "Bullets", "Sleep")
    world.effects["Contacts"].on_hit = swap
    counts = watch(world, 0.3, lambda: len(world.bodies))
    assert counts[0] == 3
    assert counts[-1] == 2


def test_a_parting_calls_back_once():
    told = []
    contacts = Contacts(lambda a, b, _: told.append("hit"), lambda a, b: told.append((a, b)))
    world = World(effects=[contacts, Friction(), Sleep()])
    ground = world.add(Body(Box((100, 50)), (0, 50)))
    ball = world.add(Body(Circle(10), (0, -30), mass=1))
    run(world, 3)
    assert ball.asleep
    assert told == ["hit"]
    ball.vel = (0, -300)
    run(world, 0.1)
    assert told == ["hit", (ball, ground)]
    run(world, 3)
    assert told == ["hit", (ball, ground), "hit"]
    world.remove(ball)
    world.add(Body(Circle(10), (0, -300), mass=1))
    run(world, 0.1)
    assert told == ["hit", (ball, ground), "hit"]


def test_hits_and_partings_alternate_where_balls_bounce():
    told = []
    contacts = Contacts(lambda *_: told.append("hit"), lambda *_: told.append("part"))
    world = World(effects=[contacts, Bounce()])
    world.add(Body(Box((100, 50)), (0, 50), restitution=1))
    world.add(Body(Circle(10), (0, -110), mass=1, restitution=1))
    run(world, 10)
    assert len(told) > 20
    assert told == (["hit", "part"] * len(told))[: len(told)]


@pytest.mark.parametrize("way", [50.3, 61.3, 66.7])
def test_each_hit_of_a_fast_ball_between_two_walls_is_told(way):
    """A ball flies `way` px a step in a gap of 40 px: it meets a wall again a step later."""
    hits, touching = [], set()
    contacts = Contacts(
        lambda a, b, _: (hits.append(b), touching.add(b)), lambda a, b: touching.remove(b)
    )
    world = World((0, 0), 4, [contacts, Bounce()])
    for x in (-50, 110):
        world.add(Body(Box((50, 100)), (x, 0), restitution=1))
    ball = world.add(Body(Circle(10), (30, 0), mass=1, restitution=1))
    ball.vel = (way / DT, 0)
    for step in range(1, 61):
        world.step(DT)
        assert len(hits) == (way * step + 20) // 40
        assert not touching


def test_a_callback_must_be_callable():
    with pytest.raises(ValueError, match=r"Contacts\.on_part"):
        Contacts(on_part=3)


def test_balls_that_a_short_rod_ties_are_told_to_part():
    parted = []
    contacts = Contacts(on_part=lambda a, b: parted.append({a, b}))
    world = World((0, 0), effects=[contacts, Rods()])
    a, b = [world.add(Body(Circle(10), (x, 0), 1.0)) for x in (0, 20)]
    world.step(DT)
    world.add(Rod(a, b))
    world.step(DT)
    assert parted == [{a, b}]


def test_a_pair_is_told_in_turns_while_a_program_pushes():
    """What it sets before a step makes contacts look again, but nobody meets or parts by that."""
    touching = {}

    def meet(a, b, speed):
        assert speed >= 0 and frozenset((a, b)) not in touching
        touching[frozenset((a, b))] = speed

    def part(a, b):
        del touching[frozenset((a, b))]

    world = World(effects=[Contacts(meet, part), Bounce(), Kinematics()])
    for x in range(-75, 76, 50):
        world.add(Body(Box((25, 20)), (x, 20)))
    hand = world.add(Body(Circle(20), (-90, -30), kinematic=True))
    for i in range(10):
        world.add(Body(Circle(9), (14 * i - 60, -60 - 19 * i), 1.0, restitution=0.6))
    for step in range(240):
        hand.vel = (150 * math.cos(step / 15), 0)
        world.step(1 / 60)


@pytest.mark.parametrize("seed", range(3))
def test_a_pair_is_told_to_meet_and_part_in_turns(seed):
    """A program that keeps a set of the pairs in touch is right. None parts twice in a step."""
    rng, touching, parted = random.Random(seed), set(), set()

    def meet(a, b, _):
        assert frozenset((a, b)) not in touching
        touching.add(frozenset((a, b)))

    def part(a, b):
        touching.remove(frozenset((a, b)))
        assert frozenset((a, b)) not in parted
        parted.add(frozenset((a, b)))

    world = World((0, 0), 4, [Contacts(meet, part), Bounce()])
    for way in (-1, 1):
        world.add(Body(Box((50, 160)), (110 * way, 0), restitution=1.0))
        world.add(Body(Box((160, 50)), (0, 110 * way), restitution=1.0))
    for i, j in product((-36, 0, 36), repeat=2):
        ball = world.add(Body(Circle(12), (i, j), 1.0, restitution=1.0))
        ball.vel = rng.uniform(-900, 900), rng.uniform(-900, 900)
    for _ in range(120):
        parted.clear()
        world.step(1 / 60)
