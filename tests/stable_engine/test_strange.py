"""Test unusual events: loads vanish, bodies move and wake, numbers change at any time."""

import random
from dataclasses import replace
from itertools import pairwise, product

import pytest
from samples import sample
from worlds_for_tests import build, whole_energy

from experiments.engines import Stable
from experiments.measures import energy, run, speed, top_speed, watch
from experiments.rows.hits import gas
from experiments.scenes import (
    BOUNCE,
    DT,
    Ball,
    Block,
    G,
    Scene,
    Spring,
    chain,
    floor,
    on_floor,
    slot,
    stack,
)
from stable_engine import Body, Bounce, Box, Bullets, Circle, Contacts, Rod, Rods, World

SLEEPY = (*BOUNCE, "Sleep")
LAUNCHED = 0.5  # px, as in steps that vary


def rises(world, bodies, places, seconds, dt=DT):
    """Return the largest rise of any body above its start."""
    pairs = list(zip(bodies, places, strict=True))
    return max(watch(world, seconds, lambda: max(y - body.y for body, y in pairs), dt))


# ---------------------------------------------------------------- loads that vanish


@pytest.mark.parametrize(
    "masses", [(1, 1, 100), (1, 1, 1, 1, 1, 100), (1, 1000), (1000, 1, 1, 100)]
)
@pytest.mark.parametrize("taken", ["all of it", "its place", "its mass"])
def test_a_load_that_vanishes_throws_no_ball_up(masses, taken):
    world = build(stack(*masses), *SLEEPY)
    tall = world.bodies[3:]
    run(world, 1.5)
    if taken == "all of it":
        world.remove(tall.pop())
    elif taken == "its place":
        tall.pop().pos = (900, -20)
    else:
        tall[-1].mass = 1
    places = [-20 * (2 * i + 1) for i in range(len(tall))]
    assert rises(world, tall, places, 2) < LAUNCHED
    assert max(map(speed, tall)) < 1


def test_a_push_that_ends_throws_no_ball_up():
    world = build(stack(1, 1, 1), "Contacts")
    tall = world.bodies[3:]
    places = [-20, -60, -100]
    for _ in range(90):
        tall[-1].apply_force((0, 50 * G))
        world.step(DT)
    assert [ball.y for ball in tall] == pytest.approx(places, abs=LAUNCHED)
    assert rises(world, tall, places, 2) < LAUNCHED


def test_a_tower_rises_as_one_when_gravity_turns_over():
    world = build(stack(1, 1, 1, 1, 1), "Contacts")
    tall = world.bodies[3:]
    run(world, 1)
    start = [ball.y for ball in tall]
    world.gravity = (0, -G)
    run(world, 0.5)
    risen = [y - ball.y for y, ball in zip(start, tall, strict=True)]
    # half a substep of gravity is 0.5 px by then, and the earlier overlap is pushed out
    assert risen == pytest.approx([G * 0.5**2 / 2] * 5, abs=1)


def test_a_tower_without_its_floor_falls_as_one():
    world = build(stack(1, 10, 100), "Contacts")
    tall = world.bodies[3:]
    run(world, 1)
    world.remove(world.bodies[0])
    run(world, 0.5)
    # the earlier overlap is pushed out on the way
    assert [ball.vy for ball in tall] == pytest.approx([G * 0.5] * 3, rel=0.01)


@pytest.mark.parametrize("long", [1 / 24, 1 / 60])
@pytest.mark.parametrize("scene", sample([stack(*[1] * 5), chain(), stack(*[1] * 10)], 2))
def test_sleepers_of_long_steps_wake_calmly_in_short_ones(long, scene):
    scene = replace(scene, bodies=[*scene.bodies, Ball((900, -1e6))])
    world = build(scene, *SLEEPY, "Rods")
    sleepers = [body for body in world.bodies[:-1] if not body.is_static]
    places = [ball.pos[1] for ball in scene.bodies[:-1] if getattr(ball, "mass", 0)]
    run(world, 6, long)
    assert sleepers[0].asleep
    run(world, 0.5, 1 / 1000)
    sleepers[-1].vel = (0, 0)
    assert rises(world, sleepers, places, 0.5, 1 / 1000) < LAUNCHED


def test_a_pile_comes_to_rest_in_steps_that_vary_twentyfold():
    rng = random.Random(0)
    balls = [Ball((rng.uniform(-90, 90), -20 * i - 10)) for i in range(20)]
    world = build(Scene([*slot(200, 900), *balls]), *SLEEPY)
    for _ in range(1500):
        world.step(rng.uniform(1 / 1000, 1 / 24))
    assert world.awake == []


def test_a_chain_gains_no_energy_in_steps_that_vary_fortyfold():
    """Walls that return no speed only take energy."""
    rng = random.Random(28)
    world = World((0, 980), 2, [Contacts(), Rods()])
    for x, y in ((0, 80), (0, -80), (80, 0), (-80, 0)):
        world.add(Body(Box((20, 80) if x else (80, 20)), (x, y)))
    links = []
    for k in range(5):
        pos, mass = (20 * k - 40, rng.uniform(-5, 5)), 10 ** rng.uniform(-1, 1)
        links.append(world.add(Body(Circle(6), pos, mass)))
        links[-1].vel = rng.uniform(-600, 600), rng.uniform(-600, 600)
    for a, b in pairwise(links):
        world.add(Rod(a, b))

    start = whole_energy(world)
    for _ in range(200):
        world.step(rng.choice([1 / 30, 1 / 60, 1 / 600, 1 / 1200]))
        assert whole_energy(world) <= start


def test_a_tower_falls_freely_when_its_floor_is_removed():
    world = build(Scene([Block((0, 20), (100, 20)), *[Ball((0, -10 - 20 * k)) for k in range(12)]]))
    run(world, 3)
    world.remove(world.statics[0])
    world.step(1 / 60)
    for ball in world.bodies:
        assert ball.vel.y == pytest.approx(world.gravity[1] / 60, rel=1e-3)


# ---------------------------------------------------------------- what wakes


def resting_on(thing):
    """Make a ball asleep on a static box or below a static peg."""
    if thing == "floor":
        world = build(Scene([Block((0, 10), (50, 10)), Ball((0, -10))]), *SLEEPY)
    else:
        world = build(chain(1, (0, 50)), "Rods", "Sleep")
    run(world, 2)
    assert world.awake == []
    return world


@pytest.mark.parametrize("thing", ["floor", "peg"])
def test_a_static_body_that_moves_wakes_bodies_on_it(thing):
    world = resting_on(thing)
    world.bodies[0].pos = (1000, 0)
    assert world.awake == world.bodies[1:]


def test_a_static_body_put_into_a_sleeper_wakes_it_and_they_part():
    world = build(Scene([floor(), Ball((0, -10)), Block((-100, -50), (10, 50))]), *SLEEPY)
    ball, wall = world.bodies[1:]
    run(world, 2)
    assert ball.asleep
    wall.pos = (-15, -50)
    run(world, 1)
    assert ball.x - 10 >= wall.x + 10 - 1e-6


def test_another_gravity_wakes_all_bodies():
    world = resting_on("floor")
    world.gravity = (0, G)
    assert world.awake == []
    world.gravity = (0, -G)
    assert world.awake == world.bodies[1:]
    assert world.gravity == (0, -G)
    run(world, 1)
    assert world.bodies[1].vy == pytest.approx(-G, rel=0.01)


@pytest.mark.parametrize(("name", "value"), [("length", 80), ("stiffness", 50), ("damping", 1)])
def test_setting_a_spring_wakes_its_ends(name, value):
    scene = Scene([Ball((0, 0)), Ball((50, 0))], springs=[Spring(0, 1, 100.0, 10.0, 50.0)])
    scene.gravity = (0, 0)
    world = build(scene, "Springs", "Sleep")
    (spring,) = world.effects["Springs"].joints
    run(world, 1)
    assert world.awake == []
    setattr(spring, name, value)
    assert world.awake == world.bodies
    assert getattr(spring, name) == value
    run(world, 4)
    assert world.bodies[1].x - world.bodies[0].x == pytest.approx(spring.length, abs=0.05)


def test_a_rod_whose_length_is_set_lets_its_ends_overlap_or_touch():
    world = build(Scene([Ball((0, 0)), Ball((60, 0))], ("Contacts", "Rods"), [(0, 1)]))
    world.gravity = (0, 0)
    (rod,) = world.effects["Rods"].joints
    a, b = world.bodies
    for length in (15, 40):
        rod.length = length
        run(world, 1)
        assert b.x - a.x == pytest.approx(length, abs=0.01)
    assert world.effects["Contacts"].ignored == set()


# ---------------------------------------------------------------- static bodies that move


@pytest.mark.parametrize(("fast", "sleep"), [*product((10, 60, 200, 600), (False, True))])
def test_a_lift_with_its_speed_carries_a_ball(fast, sleep):
    scene = Scene([Block((0, 10), (50, 10)), Ball((0, -10))])
    world = build(scene, *(SLEEPY if sleep else BOUNCE))
    lift, ball = world.bodies
    run(world, 1)
    for _ in range(240):
        lift.pos += (0, -fast * DT)
        lift.vel = (0, -fast)
        world.step(DT)
        assert abs(lift.y - 10 - (ball.y + 10)) < fast * DT + 0.01  # the way of a step


@pytest.mark.parametrize(("fast", "restitution"), [*product((60, 300, 1200), (0.0, 1.0))])
def test_a_paddle_with_its_speed_strikes_a_ball(fast, restitution):
    ball = Ball((0, 0), restitution=restitution)
    scene = Scene([Block((-100, 0), (10, 100), restitution), ball], BOUNCE, gravity=(0, 0))
    world = build(scene)
    paddle, ball = world.bodies
    paddle.vel = (fast, 0)
    for _ in range(round(100 / fast / DT)):
        paddle.pos += (fast * DT, 0)
        world.step(DT)
        assert ball.x > paddle.x
    assert ball.vx == pytest.approx((1 + restitution) * fast, rel=1e-6)


def test_on_a_conveyor_belt_a_ball_ends_up_rolling_at_a_third_of_its_speed():
    world = build(on_floor())
    belt, ball = world.bodies
    belt.vel = (90, 0)
    run(world, 2)
    assert (ball.vx, ball.w * ball.radius) == pytest.approx((30, -60), rel=1e-9)
    assert belt.x == 0


# ---------------------------------------------------------------- bounces without end


@pytest.mark.parametrize(
    ("seconds", "least"), [(20, 0.99), pytest.param(300, 0.96, marks=pytest.mark.soak)]
)
@pytest.mark.parametrize("gravity", [pytest.param((0, 0), marks=pytest.mark.soak), (0, G)])
def test_balls_that_keep_all_their_speed_gain_no_energy(gravity, seconds, least):
    engine = Stable(replace(gas(20, seed=5), gravity=gravity))
    on_floor = -20 * gravity[1] * 140
    start = energy(engine) - on_floor
    shares = watch(engine, seconds, lambda: (energy(engine) - on_floor) / start)
    assert least < min(shares)
    assert max(shares) < 1.002  # an overlap is pushed out, which lifts a ball by as much


@pytest.mark.parametrize("fast", [100, 300, 1000])
def test_a_ceiling_gives_back_no_more_than_the_ball_had(fast):
    scene = Scene([Block((0, -200), (100, 20), 1.0), Ball((0, -100), restitution=1.0)], BOUNCE)
    scene.bodies[1].vel = (0.0, -600.0 - fast)
    world = build(scene)
    ball = world.bodies[1]
    start = ball.vy**2 / 2 - G * ball.y
    run(world, 0.25)
    assert ball.vy > 0
    assert ball.vy**2 / 2 - G * ball.y == pytest.approx(start, rel=1e-9)


# ---------------------------------------------------------------- more of it than usual


@pytest.mark.parametrize("masses", [(1, 1e6), (1e6, 1), (1, 1e6, 1), (1e-6, 1), (1, 1, 1e6)])
def test_a_million_to_one_is_swallowed_but_never_launched_nor_pressed_into_the_floor(masses):
    engine = Stable(stack(*masses))
    tall = engine.bodies[3:]
    places = [-20 * (2 * i + 1) for i in range(len(masses))]
    assert rises(engine, tall, places, 5) < LAUNCHED
    assert max(ball.y for ball in tall) < 0


@pytest.mark.parametrize("steps", [1 / 30, 1 / 60, 1 / 120])
@pytest.mark.parametrize("stiffness", [1e4, 1e5, 1e6, 1e8])
def test_a_stiff_spring_beside_a_rod_that_was_torn_stays_bounded(stiffness, steps):
    balls = [Ball((0, 0), 5, 0.07), Ball((80, 0), 5, 2.5), Ball((20, 100), 5, 1.0)]
    springs = [Spring(0, 2, stiffness, length=32.0)]
    scene = Scene(balls, ("Rods", "Springs"), [(0, 1)], springs, gravity=(0, 0))
    engine = Stable(scene)
    engine.bodies[0].pos = (-100, 0)
    # no faster than by the whole stretch in a substep
    assert max(watch(engine, 5, lambda: top_speed(engine), steps)) < 200 / (steps / 4)


@pytest.mark.parametrize("length", [1e-12, 1e-6, 1e-3, 0.1])
@pytest.mark.parametrize("fast", [0, 10, 1000])
def test_a_rod_of_nearly_no_length_gains_no_energy(length, fast):
    scene = Scene([Ball((0, 0)), Ball((length, 0), vel=(0, fast))], ("Rods",), [(0, 1)])
    scene.gravity = (0, 0)
    world = build(scene)
    assert max(watch(world, 2, lambda: sum(speed(b) ** 2 for b in world.bodies))) <= (
        fast**2 * (1 + 1e-9)
    )


def test_numbers_beyond_all_floats_are_an_error_in_a_sentence():
    for mass, radius in ((1, 1e-170), (1, 1e200), (1e-320, 10), (1e308, 10)):
        with pytest.raises(ValueError, match=r"^Body.mass is .* but it must be neither so tiny"):
            Body(Circle(radius), (0, 0), mass)
    bounces = [floor(restitution=0.5), Ball((0, -100), vel=(0.0, 1e200), restitution=0.5)]
    world = build(Scene(bounces, BOUNCE))
    with pytest.raises(ValueError, match=r"^Body\.\w+ is \((nan|inf|-inf|0)"):
        run(world, 1)


# ---------------------------------------------------------------- set in a callback


def test_a_bullet_put_elsewhere_when_it_hits_is_there_and_nowhere_on_the_way():
    def respawn(a, b, fast):
        bullet.pos, bullet.vel = (0, 300), (0, 0)  # on the other side of the ledge

    world = World(gravity=(0, 0), effects=[Contacts(respawn), Bounce(), Bullets()])
    world.add(Body(Box((200, 10)), (0, 0)))
    bullet = world.add(Body(Circle(10), (0, -19.9), mass=1, bullet=True))
    bullet.vel = (3000, 5)
    world.step(DT)
    assert (bullet.x, bullet.y) == (0, 300)


def test_an_error_in_a_callback_leaves_a_world_that_goes_on():
    def fails(a, b, fast):
        raise RuntimeError("mine")

    world = build(on_floor(), *SLEEPY, "Bullets")
    world.effects["Contacts"].on_hit = fails
    with pytest.raises(RuntimeError, match="mine"):
        world.step(DT)
    run(world, 2)
    assert world.awake == []
