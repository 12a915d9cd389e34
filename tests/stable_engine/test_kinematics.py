"""Test kinematic bodies: they move as set, and carry and push other bodies."""

import math
from itertools import pairwise

import pygame
import pytest
from worlds_for_tests import make

from experiments.measures import run, watch
from experiments.scenes import DT, G
from stable_engine import Body, Box, Circle, Contacts, Kinematics, Rod, Rods, Segment, World

R = 10.0


def lift_world(*more, vel=(0.0, -60.0)):
    """Make a lift with a ball on it."""
    world = World(effects=make(["Contacts", "Friction", "Kinematics", *more]))
    lift = world.add(Body(Box((50, 5)), (0, 5), kinematic=True))
    ball = world.add(Body(Circle(R), (0, -R), mass=1))
    lift.vel = vel
    return world, lift, ball


def test_a_kinematic_body_moves_as_set_whatever_it_meets():
    world, lift, ball = lift_world()
    wheel = world.add(Body(Circle(5), (500, 0), kinematic=True))
    wheel.omega = 3
    ball.mass = 1000
    run(world, 1)
    assert lift.pos == (0, 5 - 60)
    assert lift.vel == (0, -60)
    assert wheel.angle == pytest.approx(3)


def test_a_lift_carries_a_ball_without_a_gap():
    world, lift, ball = lift_world()
    run(world, 0.5)
    gaps = watch(world, 1, lambda: lift.y - 5 - (ball.y + R))
    assert max(abs(gap) for gap in gaps) < 0.01
    assert ball.vy == pytest.approx(-60, rel=1e-3)


def test_a_lift_that_goes_sideways_takes_along_what_rolls_on_it():
    world, _, ball = lift_world(vel=(60.0, 0.0))
    run(world, 0.5)
    assert 0 < ball.vx < 60
    assert ball.vx - ball.w * R == pytest.approx(60, rel=1e-3)


def test_a_paddle_returns_a_ball_by_the_speed_between_them():
    world = World(gravity=(0, 0), effects=make(["Contacts", "Bounce", "Kinematics"]))
    paddle = world.add(Body(Segment((0, -50), (0, 50)), restitution=1, kinematic=True))
    ball = world.add(Body(Circle(R), (100, 0), mass=1, restitution=1))
    paddle.vel, ball.vel = (100, 0), (-200, 0)
    run(world, 0.5)
    assert ball.vel == (400, 0)
    assert ball.x == pytest.approx(100 - 200 * 0.3 + 400 * (0.5 - 0.3), abs=300 * DT)


def test_a_peg_that_moves_takes_its_rod_along():
    world = World(gravity=(0, 0), effects=make(["Rods", "Kinematics"]))
    peg = world.add(Body(Circle(5), (0, 0), kinematic=True))
    bob = world.add(Body(Circle(R), (80, 0), mass=1))
    world.add(Rod(peg, bob))
    peg.vel = (-100, 0)
    run(world, 1)
    assert bob.vel == (-100, 0)
    assert math.dist(peg.pos, bob.pos) == pytest.approx(80, rel=1e-6)


@pytest.mark.parametrize("spin", [0.2, 2.0, 6.5])
@pytest.mark.parametrize("substeps", [1, 4, 8])
def test_a_crank_turns_a_linkage_through_its_dead_points(substeps, spin):
    """All rods are in line there: their matrix is singular, and both ends are held."""
    arm, length = 40.0, 200.0
    world = World((0, 0), substeps, [Rods(), Kinematics()])
    crank = world.add(Body(Circle(5), (arm, 0), kinematic=True))
    hub = world.add(Body(Circle(5), (length, 0)))
    pin = world.add(Body(Circle(5), (length + arm, 0), mass=1))
    pin.vel = (0, spin * arm)
    rods = [world.add(Rod(crank, pin)), world.add(Rod(hub, pin))]
    for step in range(1, round(4 / spin / DT)):
        angle = spin * step * DT
        crank.vel = (pygame.Vector2(arm, 0).rotate_rad(angle) - crank.pos) / DT
        world.step(DT)
        assert all(abs(rod.a.pos.distance_to(rod.b.pos) - rod.length) < 1 for rod in rods)
        assert pin.vel.length() < 2 * spin * arm


@pytest.mark.parametrize(("speed", "gain"), [(60, 60), (400, 400), (1000, 1000), (400, 15)])
@pytest.mark.parametrize("count", [1, 2, 3])
def test_a_press_that_goes_up_pulls_no_ball_along(count, speed, gain):
    """It squeezes balls on the floor for a second, and then gains speed by so much a step.

    Nothing pulls the balls: they rise no higher than to where they just touch each other.
    """
    world = World(effects=make(["Contacts", "Friction", "Bounce", "Kinematics"]))
    world.add(Body(Box((300, 50)), (0, 50)))
    tops = [-R * (2 * i + 1) for i in range(count)]
    balls = [world.add(Body(Circle(R), (0, y), mass=1)) for y in tops]
    press = world.add(Body(Box((60, 10)), (0, -2 * R * count - 10), kinematic=True))
    press.vel = (0, 60)
    run(world, 1 / 30)  # 2 px
    press.vel = (0, 0)
    run(world, 1)
    for step in range(60):
        press.vel = (0, -min(gain * (step + 1), speed))
        world.step(DT)
        assert all(ball.y > y - 0.01 * R for ball, y in zip(balls, tops, strict=True))


# ---------------------------------------------------------------- sleep


def test_a_ball_on_a_slow_lift_stays_awake():
    world, _, ball = lift_world("Sleep", vel=(0.0, -1.0))
    asleep = watch(world, 3, lambda: ball.asleep)
    assert not any(asleep)
    assert ball.y == pytest.approx(-R - 3, abs=0.01)


def test_a_kinematic_body_moves_on_and_wakes_sleepers():
    world = World(effects=make(["Contacts", "Friction", "Kinematics", "Sleep"]))
    world.add(Body(Box((500, 50)), (0, 50)))
    ball = world.add(Body(Circle(R), (0, -R), mass=1))
    plough = world.add(Body(Box((5, 20)), (-300, -20), kinematic=True))
    run(world, 2)
    assert ball.asleep
    plough.vel = (100, 0)
    run(world, 2)
    assert ball.asleep
    assert plough.x == pytest.approx(-100)
    run(world, 2)
    assert not ball.asleep
    assert ball.x > plough.x + 14.9


# ---------------------------------------------------------------- what it is


def test_a_kinematic_body_needs_its_effect_and_has_no_mass():
    with pytest.raises(ValueError, match=r"needs Kinematics\(\)"):
        World(effects=[Contacts()]).add(Body(Circle(1), (0, 0), kinematic=True))
    with pytest.raises(ValueError, match=r"Body\.mass is 2"):
        Body(Circle(1), (0, 0), mass=2, kinematic=True)


def test_a_removed_kinematic_body_stays_where_it_is():
    world, lift, ball = lift_world()
    assert lift.kinematic
    assert lift.is_static
    assert not ball.kinematic
    run(world, 0.5)
    world.remove(lift)
    y = lift.y
    run(world, 0.5)
    assert lift.y == y
    assert ball.vy == pytest.approx(-60 + G * 0.5, rel=1e-3)
    assert world.effects["Kinematics"].bodies == []


def test_check_says_so_where_none_is_there_and_asks_no_friction_of_one():
    world = World(effects=[Contacts(), Kinematics()])
    assert any("Kinematics" in sentence for sentence in world.check())
    world.add(Body(Box((9, 9)), (0, 0), kinematic=True)).vel = (5, 0)
    world.add(Body(Circle(1), (0, -50), mass=1))
    assert world.check() == []


@pytest.mark.parametrize("rows", [10, pytest.param(40, marks=pytest.mark.soak)])
def test_a_chain_that_a_moving_handle_has_cracked_keeps_its_energy(rows):
    """The handle goes round for a second, with links of 1 to 0.01 kg, and then stands still."""
    world = World(effects=[Kinematics(), Rods()])
    handle = world.add(Body(Circle(2), (0, 0), kinematic=True))
    chain = [handle] + [
        world.add(Body(Circle(2), (400 * (i + 1) / rows, 0), 0.01 ** (i / (rows - 1))))
        for i in range(rows)
    ]
    rods = [world.add(Rod(a, b)) for a, b in pairwise(chain)]

    def energy():
        return sum(b.mass * (b.vel.length_squared() / 2 - G * b.pos.y) for b in chain[1:])

    for i in range(60):
        turn = 4 * math.pi * i / 60
        handle.vel = (-300 * math.sin(turn), 300 * math.cos(turn))
        world.step(1 / 60)
    handle.vel = (0, 0)
    world.step(1 / 60)  # the stop takes some of it
    start, scale = energy(), sum(b.mass for b in chain) * G * 200
    for _ in range(120):
        world.step(1 / 60)
        assert energy() == pytest.approx(start, abs=0.01 * scale)
        assert all(abs(rod.a.pos.distance_to(rod.b.pos) - rod.length) < 0.1 for rod in rods)
