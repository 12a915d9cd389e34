"""Test that what is alike on the left and on the right stays alike, whatever is in the scene.

A mirrored law gives mirrored motion; all that may differ is what numbers are rounded to.
"""

import math
import random
from dataclasses import replace

import pytest
from samples import sample
from worlds_for_tests import balls

from experiments.engines import Stable
from experiments.measures import states
from experiments.rows.hits import kinetic, moments
from experiments.scenes import BOUNCE, DT, Ball, Block, G, Scene, Spring, floor
from stable_engine import Body, Circle, Contacts, Friction, Segment, World

ROUNDING = 1e-9  # share of the highest speed so far by which two mirrored speeds may differ
RESTITUTIONS = [0.0, 0.01, 0.1, 0.3, 0.5, 0.9, 1.0]


def both(x, y, *rest, vel=(0.0, 0.0), **surface):
    """Make a ball, and unless it is in the middle, its mirror image."""
    made = [Ball((side * x, y), *rest, vel=(side * vel[0], vel[1]), **surface) for side in (1, -1)]
    return made if x else made[:1]


def triangle(rows, y, up=1, **surface):
    """Make rows of balls that touch, with the first ball at y, and the last row on top or below."""
    way = math.sqrt(3) * 10
    return [
        Ball((20 * (i - row / 2), y - up * way * row), **surface)
        for row in range(rows)
        for i in range(row + 1)
    ]


def break_rack(**surface):
    return Scene([*triangle(5, 0, -1, **surface), Ball((0, -150), vel=(0, 1500.0), **surface)])


def break_loose_rack(**surface):
    """The balls are apart by less than a step."""
    rack = [
        replace(ball, pos=(ball.pos[0] * 1.0005, ball.pos[1] * 1.0005))
        for ball in triangle(5, 0, -1, **surface)
    ]
    return Scene([*rack, Ball((0, -150), vel=(0, 1500.0), **surface)])


def fall_into_a_v(**surface):
    return Scene([*both(20, 35, 20, 0.0, **surface), Ball((0, -100), vel=(0, 600.0), **surface)])


def hit_two(**surface):
    return Scene([*both(10, 0, **surface), Ball((0, -100), vel=(0, 600.0), **surface)])


def two_hit_one(**surface):
    return Scene([*both(0, 0, **surface), *both(60, -60, vel=(-600.0, 600.0), **surface)])


def hit_a_dumbbell(**surface):
    ends = both(30, 0, **surface)
    return Scene([*ends, Ball((0, -100), 25, vel=(0, 600.0), **surface)], rods=[(0, 1)])


def hit_two_dumbbells(**surface):
    ends = [*both(10, 0, **surface), *both(40, 20, **surface)]
    cue = Ball((0, -100), vel=(0, 600.0), **surface)
    return Scene([*ends, cue], rods=[(0, 2), (1, 3)])


FLYING = [
    *(break_rack, break_loose_rack, fall_into_a_v, hit_two, two_hit_one),
    *(hit_a_dumbbell, hit_two_dumbbells),
]


def drop_a_triangle(**surface):
    return Scene([floor(**surface), *triangle(4, -200, **surface)])


def drop_two_piles(**surface):
    """The piles lean towards each other, and meet."""
    spots = [(11 + 21 * i + 3 * row, -60 - 23 * row - 2 * i) for row in range(4) for i in range(3)]
    return Scene([floor(**surface), *(ball for spot in spots for ball in both(*spot, **surface))])


def drop_on_pegs(**surface):
    pegs = [both(x, y, 10, 0.0, **surface) for x, y in ((25, 0), (60, 20), (90, 40))]
    falling = [both(12 + 24 * i, -100 - 30 * i, **surface) for i in range(4)]
    return Scene([Block((0, 1200), (5000, 500)), *(ball for two in pegs + falling for ball in two)])


FALLING = [drop_a_triangle, drop_two_piles, drop_on_pegs]


def drop_at_random(seed, restitution, kind):
    """Make unequal balls fall in a bin, some in the middle, some tied to others."""
    rng, surface = random.Random(seed), {"restitution": restitution, "friction": 0.6}
    walls = [Block((side * 130, -400), (10, 600), **surface) for side in (-1, 1)]
    bodies, spots, pairs = [Block((0, 60), (400, 50), **surface), *walls], [], []
    while len(spots) < 14:
        radius, mass = rng.uniform(6, 14), 10 ** rng.uniform(-0.5, 0.5)
        x = rng.choice([0.0, *[rng.uniform(radius + 0.3, 118 - radius)] * 3])
        y, vel = rng.uniform(-300, -10), (rng.uniform(-100, 100) * (x > 0), rng.uniform(-200, 400))
        if all(math.hypot(abs(x) - at, y - up) > radius + r + 0.5 for at, up, r in spots):
            spots.append((x, y, radius))
            new = both(x, y, radius, mass, vel=vel, **surface)
            bodies += new
            if len(new) == 2:
                pairs.append(len(bodies) - 2)
    ties = [(a + k, b + k) for a, b in zip(pairs[::3], pairs[1::3], strict=False) for k in (0, 1)]
    rods = ties if kind == "Rods" else []
    springs = [Spring(a, b, 300.0, 2.0, 60.0) for a, b in ties] if kind == "Springs" else []
    return Scene(bodies, rods=rods, springs=springs)


def watch_symmetry(scene, seconds, look=lambda engine: None):
    """Run a scene, and fail once a ball moves in another way than its mirror image."""
    ties = ("Rods",) * bool(scene.rods) + ("Springs",) * bool(scene.springs)
    engine = Stable(replace(scene, effects=(*BOUNCE, *ties)))
    moving = balls(engine.world)
    images = [find_image(ball, moving) for ball in moving]
    fastest = 0.0
    for step in range(round(seconds / DT)):
        engine.step(DT)
        fastest = max([fastest, *(math.hypot(ball.vx, ball.vy) for ball in moving)])
        for ball, image in zip(moving, images, strict=True):
            off = abs(ball.vx + image.vx), abs(ball.vy - image.vy), ball.r * abs(ball.w + image.w)
            assert max(off) <= ROUNDING * fastest, f"in step {step}"
        look(engine)


def find_image(ball, moving):
    return min(moving, key=lambda other: math.hypot(other.x + ball.x, other.y - ball.y))


@pytest.mark.parametrize("friction", [0.0, 0.05, 0.6])
@pytest.mark.parametrize("restitution", RESTITUTIONS)
@pytest.mark.parametrize("make", FLYING)
def test_a_mirrored_hit_stays_mirrored_and_creates_no_energy(make, restitution, friction):
    scene = replace(make(restitution=restitution, friction=friction), gravity=(0, 0))
    engine = Stable(scene)
    most, before = kinetic(scene, states(engine)), moments(scene, states(engine))

    def look(engine):
        now = states(engine)
        assert kinetic(scene, now) <= most * (1 + 1e-6)
        if make is not fall_into_a_v:
            off = [abs(a - b) for a, b in zip(moments(scene, now), before, strict=True)]
            assert max(*off[:2], off[2] / 100) <= 1e-6 * 600

    watch_symmetry(scene, 0.5, look)


@pytest.mark.parametrize("friction", [0.0, 0.6])
@pytest.mark.parametrize("restitution", RESTITUTIONS)
@pytest.mark.parametrize("make", FALLING)
def test_mirrored_piles_stay_mirrored_when_they_fall(make, restitution, friction):
    watch_symmetry(make(restitution=restitution, friction=friction), 0.8)


@pytest.mark.parametrize("seed", sample(range(12), 3))
@pytest.mark.parametrize("restitution", [0.0, 0.1, 0.3, 0.9])
@pytest.mark.parametrize("kind", ["", "Rods", "Springs"])
def test_a_mirrored_heap_of_unequal_balls_stays_mirrored(seed, restitution, kind):
    watch_symmetry(drop_at_random(seed, restitution, kind), 0.5)


@pytest.mark.parametrize("degrees", [55, 70])
def test_a_ball_shot_deep_into_a_symmetric_v_stays_in_its_middle(degrees):
    """Neither wall puts its core out first."""
    x, y = math.sin(math.radians(degrees)), -math.cos(math.radians(degrees))
    world = World((0, G), effects=[Contacts()])
    for side in (-1, 1):
        world.add(Body(Segment((0, 0), (side * 2000 * x, 2000 * y))))
    ball = world.add(Body(Circle(10), (0, -600), 1))
    ball.vel = (0, 3000)
    for _ in range(60):
        world.step(DT)
        assert abs(ball.vel.x) < 1e-9 * 3000


def test_a_pile_that_falls_into_a_v_without_bounce_stays_mirrored():
    """Each strike counts all that is ahead of it, from whichever side it comes."""
    world = World((0, 980), 4, [Contacts(), Friction()])
    for side in (-1, 1):
        world.add(Body(Segment((side * 400, -200), (0, 0), 3), friction=0.5))
    pairs = []
    for i in range(5):
        x, y = 30 + 24 * i, -150 - 7 * i
        pairs.append([world.add(Body(Circle(10), (s * x, y), 1.0, friction=0.5)) for s in (-1, 1)])
    for _ in range(180):
        world.step(1 / 120)
        assert max(abs(a.x + b.x) + abs(a.y - b.y) for a, b in pairs) < 1e-6
