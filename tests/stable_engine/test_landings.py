"""Test frames and chains of rods that land: they stay rigid, out of walls, and gain no energy."""

import math
from itertools import combinations, pairwise

import pytest
from worlds_for_tests import make

from stable_engine import Body, Bounce, Box, Circle, Contacts, Rod, Rods, Spring, Springs, World

G = 980.0  # px/s²
DT = 1 / 60  # s
SUBSTEPS = 4
RADIUS = 8.0  # px
BOUNCE = ("Contacts", "Bounce", "Rods")
PLAIN = ("Contacts", "Rods")
ROUGH = ("Contacts", "Friction", "Bounce", "Rods")


def world_with_floor(effects):
    """Return a world whose floor, at y = 0, lets nothing bounce."""
    world = World((0, G), SUBSTEPS, make(effects))
    surface = {"restitution": 0} if "Bounce" in effects else {}
    world.add(Body(Box((900, 20)), (0, 20), **surface))
    return world


def add_balls(world, places, mass=1.0, radius=RADIUS):
    surface = {"restitution": 0} if "Bounce" in world.effects else {}
    return [world.add(Body(Circle(radius), at, mass, **surface)) for at in places]


def slanted(count, length, radius=RADIUS, angle=0.3):
    """Return places on a slanted line, the lowest first."""
    along = math.cos(angle) * length, -math.sin(angle) * length
    return [(i * along[0], i * along[1] - radius) for i in range(count)]


def on_a_circle(count, length):
    """Return the corners of a polygon with sides of this length (px)."""
    radius = length / 2 / math.sin(math.pi / count)
    turns = [0.2 + 2 * math.pi * i / count for i in range(count)]
    return [(radius * math.cos(turn), radius * math.sin(turn) - radius - RADIUS) for turn in turns]


SHAPES = {
    "dumbbell": (slanted(2, 60, angle=0.7), pairwise),
    "chain": (slanted(10, 25), pairwise),
    "triangle": (on_a_circle(3, 60), lambda balls: combinations(balls, 2)),
    "square": (on_a_circle(4, 40), lambda balls: combinations(balls, 2)),
    "ring": (on_a_circle(12, 40), lambda balls: pairwise([*balls, balls[0]])),
}


def energy_of(balls):
    spins = sum(ball.omega**2 / ball.inv_inertia for ball in balls)
    return spins / 2 + sum(b.mass * (b.vel.length_squared() / 2 - G * b.pos.y) for b in balls)


def off_by(rods):
    """Return how far (px) any rod is from its length."""
    return max(abs(rod.a.pos.distance_to(rod.b.pos) - rod.length) for rod in rods)


@pytest.mark.parametrize("height", [20.0, 80.0, 320.0, 640.0])
@pytest.mark.parametrize("effects", [PLAIN, BOUNCE, ROUGH])
@pytest.mark.parametrize("shape", SHAPES)
def test_what_falls_on_a_floor_stays_rigid_on_it_and_gains_no_energy(shape, effects, height):
    """With e = 0 no ball is deeper in than by its motion in a substep."""
    places, pairs = SHAPES[shape]
    world = world_with_floor(effects)
    balls = add_balls(world, [(x, y - height) for x, y in places])
    rods = [world.add(Rod(a, b)) for a, b in pairs(balls)]
    fastest = math.sqrt(2 * G * height)
    least, fallen = energy_of(balls), len(balls) * G * height
    for _ in range(round((fastest / G + 1.5) / DT)):
        world.step(DT)
        assert off_by(rods) < 0.2
        assert max(ball.pos.y + RADIUS for ball in balls) < fastest * DT / SUBSTEPS
        now = energy_of(balls)
        assert now < least + 0.01 * fallen
        least = min(least, now)


def test_a_chain_winds_round_a_peg():
    world = World((0, G), SUBSTEPS, make(PLAIN))
    pivot, peg = add_balls(world, [(0, 0), (25, 70)], 0.0)
    balls = add_balls(world, [(-15 * i, 0) for i in range(1, 11)], radius=5.0)
    rods = [world.add(Rod(a, b)) for a, b in pairwise([pivot, *balls])]
    start = energy_of(balls)
    for _ in range(round(4 / DT)):
        world.step(DT)
        assert off_by(rods) < 0.5
        assert min(ball.pos.distance_to(peg.pos) for ball in balls) > 0.9 * (RADIUS + 5.0)
        assert energy_of(balls) < start + 0.01 * 10 * G * 80


def test_friction_does_not_stretch_rods():
    """A dumbbell lands at a slant at high speed: friction stops its lower end at once."""
    world = world_with_floor(ROUGH)
    balls = add_balls(world, slanted(2, 30, angle=0.4))
    rod = world.add(Rod(*balls))
    for ball in balls:
        ball.pos = ball.pos.x, ball.pos.y - 50
        ball.vel = 300, 700
    for _ in range(60):
        world.step(DT)
        assert off_by([rod]) < 0.1


# ---------------------------------------------------------------- calls


def hits_of(height, speed, seconds=0.8):
    """Let a dumbbell fly over a floor. Return its hits and partings, with the times (s)."""
    calls = []
    world = World((0, G), SUBSTEPS, [Contacts(), Rods()])
    world.effects["Contacts"].on_hit = lambda a, b, v: calls.append(("hit", now, v))
    world.effects["Contacts"].on_part = lambda a, b: calls.append(("part", now, 0))
    world.add(Body(Box((900, 20)), (0, 20)))
    balls = add_balls(world, [(0, -height - RADIUS), (40, -height - RADIUS)])
    world.add(Rod(*balls))
    for ball in balls:
        ball.vel = speed
    for step in range(round(seconds / DT)):
        now = (step + 1) * DT
        world.step(DT)
    return calls


@pytest.mark.parametrize("height", [30.0, 80.0, 133.0])
def test_a_hit_is_told_in_its_step_with_its_speed(height):
    calls = hits_of(height, (0, 0))
    touch = math.sqrt(2 * height / G)
    assert [name for name, *_ in calls] == ["hit", "hit"]
    for _, at, speed in calls:
        assert touch <= at + 1e-9 and at < touch + 2 * DT
        assert speed == pytest.approx(G * touch, abs=G * DT)


def test_a_landing_that_does_not_come_off_is_not_told():
    """A pendulum's bob flies at a floor, which its rod does not let it reach."""
    world, calls = World((0, G), SUBSTEPS, [Contacts(), Rods()]), []
    world.effects["Contacts"].on_hit = lambda *call: calls.append(call)
    world.effects["Contacts"].on_part = lambda *call: calls.append(call)
    world.add(Body(Box((900, 20)), (0, 20)))
    [pivot] = add_balls(world, [(0, -150 - RADIUS - 0.1)], 0.0)
    [bob] = add_balls(world, [(-150, -150 - RADIUS - 0.1)])
    world.add(Rod(pivot, bob))
    for _ in range(round(3 / DT)):
        world.step(DT)
    assert not calls


# ---------------------------------------------------------------- along rods, at any moment


def thrown(count, length, effects, share):
    """Return balls on rods in a row along x that fly to x = 0, and the world, without gravity.

    In their last step they fly on for this share of it.
    """
    world = World((0, 0), SUBSTEPS, make(effects))
    start = -RADIUS - 200 * (20 + share) * DT
    balls = add_balls(world, [(start - length * i, 0) for i in range(count)])
    for a, b in pairwise(balls):
        world.add(Rod(a, b))
    for ball in balls:
        ball.vel = 200, 0
    return world, balls


@pytest.mark.parametrize("effects", [BOUNCE, ROUGH])
@pytest.mark.parametrize("count", [1, 2, 3, 5])
@pytest.mark.parametrize("share", [0.0, 0.05, 0.3, 0.5, 0.75, 0.95, 0.999])
def test_what_hits_the_end_of_rods_without_restitution_stays_there(effects, count, share):
    """With e = 0 all go on at v m / M. Of the speed 1 % may be off: 0.01 % of the energy."""
    world, thrown_balls = thrown(count, 40, effects, share)
    hit = add_balls(world, [(RADIUS + 40 * i, 0) for i in range(3)])
    for a, b in pairwise(hit):
        world.add(Rod(a, b))
    for _ in range(60):
        world.step(DT)
    for ball in (*thrown_balls, *hit):
        assert ball.vel.x == pytest.approx(200 * count / (count + 3), abs=0.01 * 200)


@pytest.mark.parametrize("effects", [BOUNCE, ROUGH])
@pytest.mark.parametrize("count", [2, 3, 5])
@pytest.mark.parametrize("share", [0.0, 0.05, 0.3, 0.5, 0.75, 0.95, 0.999])
def test_rods_that_hit_a_wall_without_restitution_stop(effects, count, share):
    """With e = 0 nothing springs back, but for 1 % of the speed: 0.01 % of the energy."""
    world, balls = thrown(count, 40, effects, share)
    world.add(Body(Box((20, 200)), (20, 0), restitution=0))
    for _ in range(60):
        world.step(DT)
    for ball in balls:
        assert ball.vel.x == pytest.approx(0, abs=0.01 * 200)


def test_a_ball_on_a_spring_tells_its_hit_and_no_part_without_one():
    told = []
    contacts = Contacts(lambda a, b, _: told.append((a, b)), lambda a, b: told.remove((a, b)))
    world = World((0, 0), SUBSTEPS, [contacts, Bounce(), Springs()])
    world.add(Body(Box((200, 20)), (0, 20), restitution=0))
    places = (0, -12.5), (-12, -60), (-60, -60)
    balls = [world.add(Body(Circle(12), at, 10 + i, restitution=0)) for i, at in enumerate(places)]
    balls[1].vel = (-150, 400)
    world.add(Spring(balls[1], balls[2], 5000, length=64))
    for _ in range(8):
        world.step(1 / 120)
    assert (balls[1], balls[0]) in told


def test_a_pair_on_a_spring_parts_only_after_a_hit():
    told = []
    contacts = Contacts(lambda a, b, _: told.append((a, b)), lambda a, b: told.remove((a, b)))
    world = World((0, 0), SUBSTEPS, [contacts, Bounce(), Springs()])
    balls = [
        world.add(Body(Circle(12), at, 1, restitution=0)) for at in ((115.9, 65), (50.1, 108.2))
    ]
    for ball, vel in zip(balls, ((142.7, 29.4), (-211.4, 268.3)), strict=True):
        ball.vel = vel
    world.add(Spring(*balls, 20))
    for _ in range(120):
        world.step(1 / 30)
    assert told == []
