"""Test hits of balls that move by more than their size in a step.

Thresholds come from closed forms, conservation laws and an event-driven simulation.
"""

import itertools
import math
import random

import pytest

from stable_engine import Body, Bounce, Circle, Contacts, Rod, Rods, Spring, Springs, World

R = 10  # px
pytestmark = pytest.mark.filterwarnings("ignore:This scene calls for Bullets")

IDEAL = {"restitution": 1, "friction": 0}


def make_world(on_hit=None, on_part=None):
    return World((0, 0), 4, [Contacts(on_hit, on_part), Bounce(), Rods(), Springs()])


def add_ball(world, x, y, mass=1.0, vel=(0, 0)):
    ball = world.add(Body(Circle(R), (x, y), mass, **IDEAL))
    ball.vel = vel
    return ball


# ---------------------------------------------------------------- balls on joints


def peg(world, x, y):
    return world.add(Body(Circle(1), (x, y)))


def hang_on_rod(world, bob):
    world.add(Rod(peg(world, 0, -100), bob))


def hang_on_two_rods(world, bob):
    for x in (-600, 600):
        world.add(Rod(peg(world, x, -800), bob))


def hang_on_chain(world, bob):
    links = [peg(world, 0, -120), add_ball(world, 0, -80), add_ball(world, 0, -40), bob]
    for a, b in itertools.pairwise(links):
        world.add(Rod(a, b))


def hang_on_spring(stiffness):
    def hang(world, bob):
        world.add(Spring(peg(world, 0, -1000), bob, stiffness))

    return hang


def tie_to_ball(mass):
    def tie(world, bob):
        world.add(Rod(add_ball(world, 0, -1000, mass), bob))

    return tie


HANGINGS = {
    "rod": hang_on_rod,
    "two rods": hang_on_two_rods,
    "chain": hang_on_chain,
    "soft spring": hang_on_spring(100.0),
    "stiff spring": hang_on_spring(1e6),
    "dumbbell": tie_to_ball(1.0),
    "heavy dumbbell": tie_to_ball(100.0),
}
# 1/kg, of a bob of 1 kg: what an impulse along the normal (nx, ny) changes its speed there by
YIELDS = {
    "rod": lambda nx, ny: nx * nx,
    "soft spring": lambda nx, ny: nx * nx + ny * ny,
    "dumbbell": lambda nx, ny: nx * nx + ny * ny / 2,
    "heavy dumbbell": lambda nx, ny: nx * nx + ny * ny / 101,
}


def shoot(world, rng, hz):
    """Add a ball that flies at one at the origin.

    Return it, its velocity (px/s), the normal at the touch and the steps until then.
    """
    speed = math.exp(rng.uniform(math.log(1000), math.log(20000)))
    side, mass = rng.choice([-1, 1]), rng.choice([0.3, 1, 3])
    start, off = 30 + rng.random() * speed / hz, rng.uniform(-15, 15)
    ball = add_ball(world, -side * start, off, mass, (side * speed, 0))
    ahead = math.sqrt(4 * R * R - off * off)
    steps = math.ceil((start - ahead) / speed * hz)
    return ball, (side * speed, 0), (side * ahead / (2 * R), -off / (2 * R)), steps


@pytest.mark.parametrize("hz", [60, 120])
@pytest.mark.parametrize("name", HANGINGS)
def test_no_fast_ball_flies_through_one_on_joints(name, hz):
    """Its velocity changes in the step of the touch; where the bob yields freely, as it should."""
    rng = random.Random(hz)
    for _ in range(100):
        world = make_world()
        HANGINGS[name](world, add_ball(world, 0, 0))
        ball, (speed, _), (nx, ny), steps = shoot(world, rng, hz)
        for _ in range(steps):
            world.step(1 / hz)
        assert math.dist(ball.vel, (speed, 0)) > 0.1 * abs(speed)
        if name in YIELDS:
            impulse = 2 * speed * nx / (1 / ball.mass + YIELDS[name](nx, ny))
            wanted = speed - impulse * nx / ball.mass, -impulse * ny / ball.mass
            assert math.dist(ball.vel, wanted) < 1e-6 * abs(speed)


@pytest.mark.parametrize("hz", [60, 120])
def test_a_ball_that_passed_a_held_one_is_not_left_behind_it(hz):
    """Two rods hold the bob, so the ball flies straight away from it, and hits nothing else."""
    rng = random.Random(hz)
    for _ in range(100):
        world = make_world()
        hang_on_two_rods(world, add_ball(world, 0, 0))
        ball, (speed, _), _, steps = shoot(world, rng, hz)
        for _ in range(steps):
            world.step(1 / hz)
        left = tuple(ball.vel)
        for _ in range(3):
            world.step(1 / hz)
        assert math.hypot(*left) == pytest.approx(abs(speed), rel=1e-9)
        assert math.dist(ball.vel, left) < 1e-9 * abs(speed)


@pytest.mark.parametrize("speed", [3000, 8000, 20000])
def test_a_fast_dumbbell_hits_a_ball_on_its_way(speed):
    """It flies straight, so its own speed does not hide the hit: the ball gets 4/3 of it."""
    for phase in range(10):
        world = make_world()
        ends = [add_ball(world, -60 - speed / 600 * phase - x, 0, 1, (speed, 0)) for x in (0, 60)]
        world.add(Rod(*ends))
        ball = add_ball(world, 0, 0)
        while ends[0].x + speed / 60 < 200 + speed / 60 and ball.vel == (0, 0):
            world.step(1 / 60)
        assert tuple(ball.vel) == pytest.approx((speed * 4 / 3, 0), abs=1e-6 * speed)
