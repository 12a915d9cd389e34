"""Test when islands fall asleep, and the events that wake them."""

import math
from itertools import pairwise

import pytest
from worlds_for_tests import balls, build

from experiments.engines import Stable
from experiments.measures import deepest_overlap, run, speed, watch
from experiments.rows.rest import neat, pyramid
from experiments.scenes import (
    BOUNCE,
    DT,
    TOUCH,
    Ball,
    Scene,
    chain,
    floor,
    oscillator,
    pile,
    tower,
)
from stable_engine import (
    Body,
    Bounce,
    Box,
    Circle,
    Contacts,
    Damping,
    Friction,
    Rod,
    Rods,
    Sleep,
    Spring,
    Springs,
    World,
)

SLEEPY = (*BOUNCE, "Sleep")


def asleep(world, most=10):
    """Step until all are asleep, for at most `seconds`."""
    for _ in range(round(most / DT)):
        if not world.awake:
            break
        world.step(DT)
    assert all(ball.asleep for ball in balls(world))
    return world


PILES = [(neat(5, 40), TOUCH), (pyramid(8), TOUCH), (pile(40, 200), BOUNCE)]
LARGE = [(neat(15, 40), TOUCH), (pyramid(40), TOUCH), (pile(200, 600), BOUNCE)]
SOAK = [pytest.param(*each, marks=pytest.mark.soak) for each in LARGE]


@pytest.mark.parametrize(("scene", "effects"), PILES + SOAK)
def test_a_pile_falls_asleep(scene, effects):
    for body in scene.bodies:
        body.restitution = 0.3
    asleep(build(scene, *effects, "Sleep"))


@pytest.mark.parametrize("count", [1, 2, 4])
def test_a_jam_that_cannot_part_falls_asleep(count):
    """Each ball lacks a quarter of its width. Once a wall is gone, they part and get no speed."""
    world = World((0, 980), effects=[Contacts(), Friction(), Sleep()])
    world.add(Body(Box((500, 20)), (0, 20)))
    walls = [world.add(Body(Box((20, 50)), (x, -50))) for x in (-20, 15 * count + 20)]
    row = [world.add(Body(Circle(10), (7.5 + 15 * i, -10), mass=1)) for i in range(count)]
    asleep(world, most=2)
    world.remove(walls[1])
    fast = watch(world, 2, lambda: max(ball.vel.length() for ball in row))
    assert max(fast) < 0.5
    assert row[0].x > 10 - 0.01
    assert all(b.x - a.x > 20 - 0.01 for a, b in pairwise(row))


def test_balls_that_still_part_stay_awake():
    world = World((0, 980), effects=[Contacts(), Friction(), Sleep()])
    world.add(Body(Box((500, 20)), (0, 20)))
    row = [world.add(Body(Circle(10), (1e-3 * i, -10), mass=1)) for i in range(8)]
    asleep(world)
    assert all(b.x - a.x > 20 - 0.01 for a, b in pairwise(sorted(row, key=lambda b: b.x)))


def test_a_tower_wakes_as_calm_as_it_fell_asleep():
    scene = tower(20)
    scene.bodies.append(Ball((0, -1e6)))
    world = build(scene, *SLEEPY)
    tall, flying = balls(world)[:-1], balls(world)[-1]
    run(world, 3)
    assert world.awake == [flying]
    before = [ball.y for ball in tall]
    run(world, 1)
    assert [ball.y for ball in tall] == before
    tall[7].wake()
    assert world.awake == [*tall, flying]
    assert max(watch(world, 1, lambda: max(map(speed, tall)))) < 0.5
    assert [ball.y for ball in tall] == pytest.approx(before, abs=0.01)


def test_a_touch_wakes_a_tower_calmly():
    world = asleep(build(tower(5), *SLEEPY))
    tall = balls(world)
    world.add(Body(Circle(5), (0, tall[-1].y - 15.5), 0.01))
    assert max(watch(world, 0.2, lambda: max(map(speed, tall)))) < 1
    assert not tall[0].asleep


def test_a_falling_ball_wakes_the_pile_it_hits():
    scene = pile(60, 150)
    scene.bodies.append(Ball((0, -1e6)))
    scene.effects = SLEEPY
    engine = Stable(scene)
    world, ball = engine.world, engine.bodies[-1]
    others = balls(world)[:-1]
    run(engine, 10)
    assert world.awake == [ball]
    ball.pos, ball.vel = (0, -600), (0, 0)
    highest = min(other.y - other.radius for other in others)
    while ball.y + ball.radius < highest:
        assert world.awake == [ball]
        world.step(DT)
    run(engine, 0.5)
    assert len(world.awake) > 1
    asleep(world)
    assert deepest_overlap(engine) < 0.5


@pytest.mark.parametrize("effects", [[], [Contacts], [Contacts, Bounce]])
def test_a_ball_that_a_force_stops_in_space_falls_asleep(effects):
    """While nothing changed its velocity, nobody looked."""
    dt = 1 / 128  # s, without rounding: the ball must stop wholly
    world = World((0, 0), 4, [Sleep(), *[effect() for effect in effects]])
    ball = world.add(Body(Circle(10), (0, 0), 2.0))
    ball.vel = 64, 0
    for _ in range(200):
        world.step(dt)
    ball.apply_force((-64 * 2.0 / dt, 0))
    for _ in range(200):
        world.step(dt)
    assert ball.asleep


def test_a_ball_far_away_sleeps_on():
    world = asleep(build(Scene([floor(), Ball((0, -10)), Ball((200, -10))]), *SLEEPY))
    near, far = balls(world)
    world.add(Body(Circle(10), (0, -60), 1.0))
    run(world, 0.5)
    assert not near.asleep
    assert far.asleep


@pytest.mark.parametrize(
    ("field", "value"), [("pos", (0.0, -10.5)), ("vel", (1.0, 0.0)), ("omega", 5.0)]
)
def test_setting_a_ball_wakes_its_island(field, value):
    world = asleep(build(Scene([floor(), Ball((0, -10)), Ball((0, -30))]), *SLEEPY))
    lower, upper = balls(world)
    setattr(lower, field, value)
    assert not lower.asleep
    assert not upper.asleep


def test_joints_sleep_with_their_bodies_and_wake_them():
    for scene, name in ((chain(5, (0, 20)), "Rods"), (oscillator(10.0, 0.0), "Springs")):
        world = asleep(build(scene, name, "Sleep"))
        effect = world.effects[name]
        assert effect.awake == []
        balls(world)[-1].vel = (50, 0)
        assert world.awake == balls(world)
        assert effect.awake == effect.joints


def test_a_new_rod_wakes_its_bodies():
    scene = Scene([floor(), Ball((0, -10)), Ball((100, -10))])
    world = asleep(build(scene, *SLEEPY, "Rods"))
    world.add(Rod(*balls(world)))
    assert len(world.awake) == 2


def test_a_swinging_pendulum_does_not_fall_asleep():
    scene = chain(1, (100, 0))
    world = build(scene, "Rods", "Sleep")
    assert all(watch(world, 10, lambda: bool(world.awake)))


@pytest.mark.parametrize(("long", "wide"), [(100, 0.02), (200, 0.05), (400, 0.1), (400, 0.2)])
def test_a_pendulum_falls_asleep_where_nothing_draws_it_on(long, wide):
    """That is within 0.06 px/s² / omega² of its lowest point; at its fastest it keeps its speed."""
    world = World((0, 980), effects=[Rods(), Sleep()])
    peg = world.add(Body(Circle(3), (0, 0)))
    bob = world.add(Body(Circle(5), (wide, long), mass=1))
    world.add(Rod(peg, bob))
    run(world, 8, 1 / 60)
    assert abs(bob.x) < 0.06 * long / 980 or not bob.asleep


# ---------------------------------------------------------------- slow is not at rest


def lone_ball(vel=0.0, degrees=0.0, *effects, spin=True):
    """Make a ball on a floor that is tilted by so many degrees, down to the right."""
    way = math.radians(degrees)
    rough = [Friction()] if spin else []
    world = World((980 * math.sin(way), 980 * math.cos(way)), 4, [Contacts(), *rough, *effects])
    world.add(Body(Box((900, 20)), (0, 20)))
    ball = world.add(Body(Circle(10), (0, -10), 1.0))
    ball.vel, ball.omega = (vel, 0.0), vel / 10 * spin
    return world, ball


@pytest.mark.parametrize("spin", [True, False])
def test_nothing_slows_what_rolls_or_slides_on_a_level_floor(spin):
    """x = v t, also at 0.6 px/s: only what is slower than 0.5 px/s is taken for at rest."""
    world, ball = lone_ball(0.6, 0.0, Sleep(), spin=spin)
    run(world, 20)
    assert ball.x == pytest.approx(0.6 * 20)
    ball.vel = (0.4, 0.0)
    assert asleep(world, 1)


@pytest.mark.parametrize("seed", [3, 5, 6, 11])
def test_what_rolls_in_a_rained_pile_comes_to_rest(seed):
    """In each of these, a ball would roll to and fro under others for more than ten seconds."""
    world = build(pile(40, 200, seed), *BOUNCE)
    run(world, 10)
    assert max(speed(ball) for ball in balls(world)) < 0.1


@pytest.mark.parametrize("start", [3.1, 30.0])
def test_balls_that_roll_in_a_row_keep_their_speed(start):
    """Rolling resistance ends only what is too slow to be seen."""
    world = build(Scene([floor(), Ball((0, -10)), Ball((20, -10))]), *TOUCH)
    for ball in balls(world):
        ball.vel, ball.omega = (start, 0), start / 10
    run(world, 5)
    assert [ball.x for ball in balls(world)] == pytest.approx([5 * start, 20 + 5 * start])


def test_a_ball_that_rolls_up_a_slope_turns_back():
    """A disc on a slope accelerates by 2/3 g sin, also where its speed is 0."""
    world, ball = lone_ball(-4.0, 0.1, Sleep())
    run(world, 8)
    assert ball.x == pytest.approx(-4 * 8 + 980 * math.sin(math.radians(0.1)) / 3 * 64, abs=0.1)


def test_a_ball_creeps_down_a_slope_against_drag():
    """On ice the speed becomes g sin / c, 0.34 px/s, and drag is no reason to stop."""
    world, ball = lone_ball(0.0, 0.1, Damping(5.0, 5.0), Sleep(), spin=False)
    run(world, 20)
    assert ball.x == pytest.approx(980 * math.sin(math.radians(0.1)) / 5 * (20 - 0.2), rel=0.01)


def on_spring(stretch, stiffness, damping=0.0):
    """Make a ball of 1 kg on a spring that is stretched by so many px, without gravity."""
    world = World((0, 0), 4, [Springs(), Sleep()])
    peg, ball = world.add(Body(Circle(5), (-100, 0))), world.add(Body(Circle(5), (stretch, 0), 1.0))
    world.add(Spring(peg, ball, stiffness, damping, 100.0))
    return world, ball


@pytest.mark.parametrize(("stretch", "seconds"), [(5.0, 40), (1.0, 8 * DT)])
def test_a_swing_does_not_stop_where_it_turns(stretch, seconds):
    """It swings for ever, slowly, or in step with every eighth look at it."""
    omega = 0.3 if stretch == 5 else math.tau / seconds
    world, ball = on_spring(stretch, omega**2)
    run(world, 40)
    assert max(watch(world, math.tau / omega, lambda: ball.x)) == pytest.approx(stretch, rel=0.1)


def test_a_ball_on_a_spring_creeps_to_its_rest_length_against_drag():
    """x = 20 exp(-k t / c): it stops where the spring pulls by 0.06 px/s² at most."""
    world, ball = on_spring(20.0, 1.0, 20.0)
    run(world, 60)
    assert ball.x == pytest.approx(20 * math.exp(-60 / 20), abs=0.01)
    run(world, 140)
    assert abs(ball.x) < 0.06 and ball.asleep


@pytest.mark.parametrize("bounces", [False, True])
@pytest.mark.parametrize("height", [1, 10, 60, 200, 500, 1500])
def test_a_ball_that_has_landed_stays_awake_for_half_a_second(height, bounces):
    world = World((0, 980), 4, [Contacts(), Sleep(), *([Bounce()] if bounces else [])])
    world.add(Body(Box((200, 20)), (0, 20)))
    ball = world.add(Body(Circle(10), (0, -10 - height), 3.0))
    slow = 0.0  # s
    for _ in range(600):
        world.step(1 / 60)
        if ball.asleep:
            break
        slow = slow + 1 / 60 if ball.vel.length() < 0.5 else 0.0
    assert ball.asleep
    assert slow > 0.4  # a check may be some steps late
    assert ball.y == pytest.approx(-10, abs=0.1)


@pytest.mark.parametrize("gap", [0.5, 2])
@pytest.mark.parametrize("start", [-200, -203.7, -211.1])
@pytest.mark.parametrize(("fast", "rate"), [(300, 120), (3000, 60)])
def test_an_impact_passes_through_a_sleeping_row(gap, start, fast, rate):
    """Fast balls have passed the first of the row when they are found, or are in its middle."""
    world = World(effects=[Contacts(), Bounce(), Sleep()])
    world.add(Body(Box((2000, 50)), (0, 50)))
    places = [(40 + gap) * i for i in range(5)]
    row = [world.add(Body(Circle(20), (x, -20), mass=1, restitution=1)) for x in places]
    run(world, 2)
    assert all(ball.asleep for ball in row)
    thrown = world.add(Body(Circle(20), (start, -20), mass=1, restitution=1))
    thrown.vel = (fast, 0)
    run(world, 0.6, 1 / rate)
    assert row[-1].vel.x == pytest.approx(fast, rel=1e-6)
    assert all(not ball.asleep or speed(ball) == 0 for ball in row)
