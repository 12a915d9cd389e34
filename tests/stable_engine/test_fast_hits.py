"""Test hits of balls that move by more than their size in a step.

Thresholds come from closed forms, conservation laws and an event-driven simulation.
"""

import itertools
import math
import random

import pytest
from worlds_for_tests import IDEAL, add_ideal_ball

from stable_engine import (
    Body,
    Bounce,
    Circle,
    Contacts,
    Rod,
    Rods,
    Segment,
    Spring,
    Springs,
    World,
)

R = 10  # px
pytestmark = pytest.mark.filterwarnings("ignore:This scene calls for Bullets")


def make_world(on_hit=None, on_part=None):
    return World((0, 0), 4, [Contacts(on_hit, on_part), Bounce(), Rods(), Springs()])


# ---------------------------------------------------------------- balls on joints


def peg(world, x, y):
    return world.add(Body(Circle(1), (x, y)))


def hang_on_rod(world, bob):
    world.add(Rod(peg(world, 0, -100), bob))


def hang_on_two_rods(world, bob):
    for x in (-600, 600):
        world.add(Rod(peg(world, x, -800), bob))


def hang_on_chain(world, bob):
    links = [
        peg(world, 0, -120),
        add_ideal_ball(world, (0, -80)),
        add_ideal_ball(world, (0, -40)),
        bob,
    ]
    for a, b in itertools.pairwise(links):
        world.add(Rod(a, b))


def hang_on_spring(stiffness):
    def hang(world, bob):
        world.add(Spring(peg(world, 0, -1000), bob, stiffness))

    return hang


def tie_to_ball(mass):
    def tie(world, bob):
        world.add(Rod(add_ideal_ball(world, (0, -1000), mass=mass), bob))

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
    ball = add_ideal_ball(world, (-side * start, off), (side * speed, 0), mass=mass)
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
        HANGINGS[name](world, add_ideal_ball(world, (0, 0)))
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
        hang_on_two_rods(world, add_ideal_ball(world, (0, 0)))
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
        ends = [
            add_ideal_ball(world, (-60 - speed / 600 * phase - x, 0), (speed, 0)) for x in (0, 60)
        ]
        world.add(Rod(*ends))
        ball = add_ideal_ball(world, (0, 0))
        while ends[0].x < 200 and ball.vel == (0, 0):
            world.step(1 / 60)
        assert tuple(ball.vel) == pytest.approx((speed * 4 / 3, 0), abs=1e-6 * speed)


# ---------------------------------------------------------------- what on_hit and on_part tell


def scatter(seed):
    """Return the position, velocity and mass of 3 to 8 balls that do not touch."""
    rng = random.Random(seed)
    count, size, balls = rng.randint(3, 8), rng.choice([60, 100, 150]), []
    while len(balls) < count:
        x, y = rng.uniform(-size, size), rng.uniform(-size, size)
        if all(math.dist((x, y), other) > 2.2 * R for other, *_ in balls):
            speed = math.exp(rng.uniform(math.log(1000), math.log(20000)))
            speed, turn = (speed if rng.random() < 0.4 else 0.0), rng.uniform(0, 2 * math.pi)
            vel = speed * math.cos(turn), speed * math.sin(turn)
            balls.append(((x, y), vel, rng.choice([0.5, 1, 1, 2])))
    return balls


def find_hits(balls, end):
    """Return the elastic hits in `end` seconds: the numbers of both balls, and their speed."""
    places, vels = [complex(*pos) for pos, *_ in balls], [complex(*vel) for _, vel, _ in balls]
    masses, hits = [mass for *_, mass in balls], []
    while True:
        soon = []
        for i, j in itertools.combinations(range(len(balls)), 2):
            way, vel = places[j] - places[i], vels[j] - vels[i]
            ahead, fast2 = (way * vel.conjugate()).real, abs(vel) ** 2
            root2 = ahead**2 - fast2 * (abs(way) ** 2 - 4 * R * R)
            if ahead < 0 <= root2:
                soon.append((max((-ahead - math.sqrt(root2)) / fast2, 0.0), i, j))
        if not soon or min(soon)[0] > end:
            return hits
        after, i, j = min(soon)
        end -= after
        places = [place + vel * after for place, vel in zip(places, vels, strict=True)]
        normal = (places[j] - places[i]) / abs(places[j] - places[i])
        speed = ((vels[i] - vels[j]) * normal.conjugate()).real
        impulse = 2 * speed / (1 / masses[i] + 1 / masses[j])
        vels[i] -= impulse / masses[i] * normal
        vels[j] += impulse / masses[j] * normal
        hits.append((i, j, speed))


@pytest.mark.parametrize("hz", [60, 120])
def test_hits_are_told_as_they_happen_and_no_others(hz):
    """The first hit of each pair in a step is that of an event-driven simulation, in its order."""
    for seed in range(200):
        told, scene = [], scatter(seed)
        world = make_world(lambda a, b, speed, told=told: told.append((a, b, speed)))
        balls = [add_ideal_ball(world, pos, vel, mass=mass) for pos, vel, mass in scene]
        world.step(1 / hz)
        wanted = {}
        for i, j, speed in find_hits(scene, 1 / hz):
            wanted.setdefault((i, j), speed)
        pairs = [sorted((balls.index(a), balls.index(b))) for a, b, _ in told]
        assert pairs == [list(pair) for pair in wanted]
        assert [speed for *_, speed in told] == pytest.approx(list(wanted.values()), rel=1e-6)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_each_pair_meets_and_parts_in_turn(restitution):
    for seed in range(20):
        rng, last = random.Random(seed), {}

        def note(a, b, speed=None, last=last):
            assert (speed is None) == last.get((a, b), False)
            last[a, b] = speed is not None

        world = make_world(note, note)
        walls = [((-220, -220), (-220, 220)), ((220, -220), (220, 220))]
        for start, end in walls + [((y, x), (b, a)) for (x, y), (a, b) in walls]:
            world.add(Body(Segment(start, end, 20), **{**IDEAL, "restitution": restitution}))
        balls = [add_ideal_ball(world, (60 * k - 150, rng.uniform(-180, 180))) for k in range(6)]
        for ball in balls:
            ball.vel = rng.uniform(-6000, 6000), rng.uniform(-6000, 6000)
            ball.restitution = restitution
        world.add(Rod(balls[0], balls[3]))
        for _ in range(120):
            world.step(1 / 60)
        assert last
