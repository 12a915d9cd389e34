"""Test fast balls by conservation laws: they lose nothing to walls and pass through no ball.

Smooth elastic impacts keep energy, so what is lost is rounding. Speeds are in px/s. Rods keep
their lengths, except for the square of what they turn by in a substep: 16 rad/s, as 400 px/s give,
in 1/240 s.
"""

import itertools
import math
import random

import pytest
from worlds_for_tests import IDEAL, add_ideal_ball, balls, whole_energy

from experiments.scenes import DT
from stable_engine import Body, Bounce, Box, Bullets, Circle, Contacts, Rod, Rods, Segment, World

ROUNDING = 1e-9  # relative
LENGTH = (16 / 240) ** 2  # relative


def make_world():
    return World((0, 0), effects=[Contacts(), Bounce(), Bullets()])


def add_room(world, size):
    """Add a closed square room from (0, 0)."""
    for x, y, half in (
        (size / 2, -100, (size, 100)),
        (size / 2, size + 100, (size, 100)),
        (-100, size / 2, (100, size)),
        (size + 100, size / 2, (100, size)),
    ):
        world.add(Body(Box(half), (x, y), **IDEAL))


def test_a_bullet_that_meets_a_wall_and_a_ball_in_one_step_keeps_its_energy():
    """The other bullet turns it back towards the wall, which it does not reach again."""
    world = make_world()
    world.add(Body(Box((100, 500)), (-100, 0), **IDEAL))
    add_ideal_ball(world, (29.8, 26.9), (-25, 499), 9, bullet=True)
    add_ideal_ball(world, (10.4, 36.4), (-500, -3), 9, bullet=True)
    before = whole_energy(world)
    for _ in range(6):
        world.step(1 / 60)
        assert whole_energy(world) == pytest.approx(before, rel=ROUNDING)


@pytest.mark.parametrize("speed", [3000, 20_000, 200_000])
@pytest.mark.parametrize("substeps", [1, 4])
def test_a_bullet_stops_where_it_first_touches_a_wall(speed, substeps):
    world = World((0, 0), substeps, [Contacts(), Bullets()])
    world.add(Body(Box((0.5, 500)), (1000.5, 0)))
    bullet = world.add(Body(Circle(10), (0, 0), mass=1, bullet=True))
    bullet.vel = (speed, 0)
    for _ in range(60):
        world.step(1 / 60)
        assert bullet.x < 990 + 1e-4
    assert bullet.x == pytest.approx(990, abs=1e-4)


@pytest.mark.parametrize("bullet", [False, True])
@pytest.mark.parametrize("steps", [1, 2, 64])
def test_a_ball_squeezed_between_a_corner_and_another_keeps_the_energy(steps, bullet):
    """It flies round the corner of a box: the straight line from its start goes through that."""
    world = make_world()
    world.add(Body(Segment((400, 300), (0, 300)), **IDEAL))
    world.add(Body(Box((30, 20)), (300, 200), **IDEAL))
    for radius, pos, vel, mass in (
        (10.537, (341.302, 231.441), (-1984.2, -630.05), 1.148),
        (11.961, (340.610, 281.915), (416.41, 4660.32), 1.676),
    ):
        ball = world.add(Body(Circle(radius), pos, mass, bullet=bullet, **IDEAL))
        ball.vel = vel
    before = whole_energy(world)
    for _ in range(steps):
        world.step(1 / 60 / steps)
    assert whole_energy(world) == pytest.approx(before, rel=ROUNDING)


def test_a_bullet_passes_the_end_of_a_line_that_it_has_met():
    """A heavy one turns it back. It then passes the end 5.7 px away, on the line's other side."""
    world, dt = make_world(), 1 / 60
    world.add(Body(Segment((100, 100), (180, 140)), **IDEAL))
    bullet = world.add(Body(Circle(3.07), (103.01, 113.68), mass=1, bullet=True, **IDEAL))
    heavy = world.add(Body(Circle(10.07), (18.2, 152.04), mass=9, bullet=True, **IDEAL))
    bullet.vel, heavy.vel = (-1369, -5619), (1421, -1593)
    before = whole_energy(world)
    world.step(dt)
    x, y, vx, vy = *bullet.pos, *bullet.vel
    world.step(dt)
    assert tuple(bullet.pos) == pytest.approx((x + vx * dt, y + vy * dt))
    assert whole_energy(world) == pytest.approx(before, rel=ROUNDING)


@pytest.mark.parametrize("speed", [300, 1000, 3000, 8000])
def test_a_gas_of_bullets_keeps_its_energy_and_its_room(speed):
    world, size = make_world(), 500
    add_room(world, size)
    for i in range(60):
        pos, vel = (40 + 60 * (i % 8), 40 + 60 * (i // 8)), (math.cos(i), math.sin(i))
        add_ideal_ball(world, pos, [speed * v for v in vel], 9, 1 + i % 3, bullet=True)
    before = whole_energy(world)
    for _ in range(120):
        world.step(DT)
        assert whole_energy(world) == pytest.approx(before, rel=ROUNDING)
        assert all(0 < place < size for body in balls(world) for place in body.pos)


@pytest.mark.parametrize("count", [2, 5])
@pytest.mark.parametrize("speed", [6000, 50_000])
@pytest.mark.parametrize("phase", range(8))
def test_a_fast_ball_sets_only_the_last_of_a_row_in_motion(count, speed, phase):
    """Equal balls swap velocities, however many of their impacts fall in one step."""
    world = make_world()
    cue = add_ideal_ball(world, (-1000 - speed * DT * phase / 8, 0), (speed, 0))
    row = [add_ideal_ball(world, (30 * i, 0), (0, 0)) for i in range(count)]
    for _ in range(math.ceil(1200 / speed / DT) + 2):
        world.step(DT)
    speeds = [body.vx for body in [cue, *row]]
    assert speeds == pytest.approx([0] * count + [speed], abs=ROUNDING * speed)


@pytest.mark.parametrize("bullet", [False, True])
@pytest.mark.parametrize("speed", [3000, 12_000, 50_000])
@pytest.mark.parametrize("phase", range(8))
def test_a_ball_does_not_pass_another_on_its_way_to_a_wall(bullet, speed, phase):
    """On a line, balls keep their order, however many impacts fall in one step."""
    world = make_world()
    world.add(Body(Box((100, 500)), (160, 0), **IDEAL))
    start = -300 - speed * DT * phase / 8
    cue = add_ideal_ball(world, (start, 0), (speed, 0), 5, bullet=bullet)
    other = add_ideal_ball(world, (0, 0), (0, 0), 5, bullet=bullet)
    before = whole_energy(world)
    for _ in range(math.ceil(1200 / speed / DT)):
        world.step(DT)
        assert cue.x < other.x < 60
        assert whole_energy(world) == pytest.approx(before, rel=ROUNDING)


def add_dumbbell(world, pos, angle, length, vel, restitution=0.8):
    """Add two balls on a rod of this length, which begins at this position."""
    x, y = pos
    far = x + length * math.cos(angle), y - length * math.sin(angle)
    ends = [
        world.add(Body(Circle(10), at, 1.0, restitution=restitution, friction=0.0))
        for at in (pos, far)
    ]
    for body in ends:
        body.vel = vel
    return world.add(Rod(*ends))


@pytest.mark.parametrize("dt", [1 / 60, 1 / 120])
@pytest.mark.parametrize("fast", [300, 1000, 3000])
@pytest.mark.parametrize("phase", range(12))
def test_a_fast_dumbbell_keeps_its_length_on_a_floor(fast, phase, dt):
    """Also where its second end comes down on an arc. Energy is not made."""
    world = World((0, 0), effects=[Contacts(), Bounce(), Rods()])
    world.add(Body(Box((5000, 50)), (0, 50), restitution=0.8, friction=0.0))
    rod = add_dumbbell(world, (0, -60 - 1.7 * phase), 0.1 + 0.1 * phase, 77, (0, fast))
    before = whole_energy(world)
    for _ in range(15):
        world.step(dt)
        assert math.dist(rod.a.pos, rod.b.pos) == pytest.approx(77, rel=LENGTH)
        assert whole_energy(world) <= before * (1 + ROUNDING)


# numbers of balls, their distance from the centre (px), and how many are bullets
FRAMES = {"dumbbell": (2, 30, 2), "half a dumbbell": (2, 30, 1), "triangle": (3, 35, 3)}


def add_frame(world, pos, turn, vel, name):
    """Add balls on rods in a ring about this position. Return the rods."""
    count, far, bullets = FRAMES[name]
    ends = []
    for k in range(count):
        angle = turn + 2 * math.pi * k / count
        at = pos[0] + far * math.cos(angle), pos[1] + far * math.sin(angle)
        ends.append(add_ideal_ball(world, at, vel, bullet=k < bullets))
    pairs = itertools.combinations(ends, 2)
    return ends, [world.add(Rod(a, b)) for a, b in pairs]


@pytest.mark.parametrize("hz", [60, 120])
@pytest.mark.parametrize("name", FRAMES)
def test_bullets_on_rods_keep_lengths_and_energy(name, hz):
    """In a room, where one step takes them by less than a rod. No bullet gets into a wall."""
    rng = random.Random(hz)
    for _ in range(30):
        world, size = World((0, 0), 4, [Contacts(), Bounce(), Rods(), Bullets()]), 600
        add_room(world, size)
        speed = math.exp(rng.uniform(math.log(300), math.log(2000)))
        way, turn = rng.uniform(0, 2 * math.pi), rng.uniform(0, 2 * math.pi)
        vel = speed * math.cos(way), speed * math.sin(way)
        ends, rods = add_frame(world, (size / 2, size / 2), turn, vel, name)
        before = whole_energy(world)
        for _ in range(hz):
            world.step(1 / hz)
            for rod in rods:
                assert math.dist(rod.a.pos, rod.b.pos) == pytest.approx(rod.length, abs=0.5)
            assert whole_energy(world) == pytest.approx(before, rel=1e-6)
            for ball in [ball for ball in ends if ball.bullet]:
                assert all(9.5 < place < size - 9.5 for place in ball.pos)


def test_dumbbells_in_a_crowd_keep_their_lengths():
    """Others press them into walls, and hit them there."""
    world, rng = World(effects=[Contacts(), Bounce(), Rods()]), random.Random(7)
    add_room(world, 400)
    rods = []
    for place in range(9):
        pos = 60 + 130 * (place % 3), 60 + 130 * (place // 3)
        vel = rng.uniform(-400, 400), rng.uniform(-400, 400)
        rods.append(add_dumbbell(world, pos, rng.uniform(0, 1.5), 50, vel))
    for _ in range(300):
        world.step(1 / 60)
        lengths = [math.dist(rod.a.pos, rod.b.pos) for rod in rods]
        assert lengths == pytest.approx([50] * len(rods), rel=LENGTH)


@pytest.mark.parametrize("bullet", [False, True])
@pytest.mark.parametrize("after", [0.011, 0.012, 0.013, 0.014, 0.015, 0.016])
def test_a_ball_misses_one_that_a_wall_has_turned_back_before(bullet, after):
    """The other crosses the way to the wall so late (s) that the ball has left it."""
    world = make_world()
    world.add(Body(Box((100, 500)), (100, 0), **IDEAL))
    turned = add_ideal_ball(world, (-50, 0), (9000, 0), bullet=bullet)
    other = add_ideal_ball(world, (-30, -12_000 * after), (0, 12_000), bullet=bullet)
    for _ in range(2):
        world.step(1 / 60)
    assert (*turned.vel, *other.vel) == pytest.approx((-9000, 0, 0, 12_000), abs=1e-6)
