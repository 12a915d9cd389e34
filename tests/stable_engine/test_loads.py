"""Test heavy bodies on light ones: without Bounce nothing springs back, and light balls carry."""

import math
import random
from itertools import pairwise, product

import pytest
from worlds_for_tests import bearing_balls, make

from experiments.scenes import DT, G
from stable_engine import Body, Box, Circle, Rod, Segment, Spring, World

RADIUS = 10.0  # px


def world_with_floor(names=("Contacts",)):
    world = World((0, G), effects=make(names))
    world.add(Body(Box((400, 20)), (0, 20)))
    return world


def add_ball(world, x, y, mass, radius=RADIUS):
    return world.add(Body(Circle(radius), (x, y), mass))


def steps(world, seconds):
    """Step the world, and yield after each step."""
    for _ in range(round(seconds / DT)):
        world.step(DT)
        yield


def highest(world, body, seconds):
    """Return how far (px) a body rises above where it is now."""
    start = body.pos.y
    return max(start - body.pos.y for _ in steps(world, seconds))


@pytest.mark.parametrize("count", [1, 3, 8])
@pytest.mark.parametrize("mass", [3.0, 10.0, 100.0, 1000.0])
def test_a_heavy_ball_that_falls_on_light_ones_stays_there(count, mass):
    """With e = 0 nothing springs back or sinks: half a pixel each way. Ten times the mass of a
    ball squeezes a stack no more than ten balls do.
    """
    world, height = world_with_floor(), 80.0
    for i in range(count):
        add_ball(world, 0, -RADIUS * (2 * i + 1), 1)
    touch = -RADIUS * (2 * count + 1)
    heavy = add_ball(world, 0, touch - height, mass)
    for _ in steps(world, math.sqrt(2 * height / G) + 2 * DT):
        pass
    for _ in steps(world, 1.5):
        assert touch - 0.5 < heavy.pos.y
        now = heavy.pos.y
    assert now == pytest.approx(touch, abs=0.75)
    assert abs(heavy.vel.y) < 0.1


@pytest.mark.parametrize("count", [0, 1, 2, 5])
@pytest.mark.parametrize("speed", [20, 150, 500, 1000])
@pytest.mark.parametrize("substeps", [1, 4, 8])
def test_without_bounce_nothing_springs_back_from_balls_at_a_wall(count, speed, substeps):
    """Each ball hands on the hit and the wall takes it: at most 2 % of the speed is left.

    Passes may leave another 0.5 px/s at each contact.
    """
    world = World((0, 0), substeps, make(["Contacts"]))
    world.add(Body(Box((20, 200)), (20, 0)))
    row = [add_ball(world, -RADIUS * (2 * i + 1), 0, 1) for i in range(count)]
    ball = add_ball(world, -2 * RADIUS * count - 100, 0, 1)
    ball.vel, most = (speed, 0), 0.0
    for _ in steps(world, 100 / speed + 0.5):
        most = max(most, *[-b.vel.x for b in (*row, ball)])
    assert most < 0.02 * speed + 0.5 * count


@pytest.mark.parametrize("height", [50, 200, 400])
def test_without_bounce_a_ball_that_falls_on_an_equal_one_stays_there(height):
    world, most = world_with_floor(), 0.0
    add_ball(world, 0, -RADIUS, 1)
    ball = add_ball(world, 0, -3 * RADIUS - height, 1)
    for _ in steps(world, 1.5):
        most = max(most, -ball.vel.y)
    assert most < 0.01 * math.sqrt(2 * G * height)


@pytest.mark.parametrize("mass", [10.0, 100.0])
def test_a_stick_of_a_light_and_a_heavy_ball_stands(mass):
    """It starts touching and at rest: energy is not created."""
    world = world_with_floor(("Contacts", "Rods"))
    foot, head = add_ball(world, 0, -10, 1), add_ball(world, 0, -110, mass)
    world.add(Rod(foot, head))
    assert highest(world, head, 3) < 0.5
    assert head.pos.y == pytest.approx(-110, abs=0.5)


def test_rods_of_a_roof_carry_its_load():
    """100 kg on two rafters of 60 degrees, on ice. The tie pulls with half the weight / tan 60,
    and a rafter pushes with half the weight / sin 60.
    """
    world = world_with_floor(("Contacts", "Rods"))
    feet = [add_ball(world, x, -10, 1) for x in (-50, 50)]
    top = add_ball(world, 0, -10 - 100 * math.sin(math.pi / 3), 100)
    tie, rafter, _ = [world.add(Rod(*ends)) for ends in (feet, (feet[0], top), (feet[1], top))]
    for _ in steps(world, 3):
        pass
    per_force, half = world.substeps / DT, 100 * G / 2
    assert -tie.impulse * per_force == pytest.approx(half / math.tan(math.pi / 3), rel=0.01)
    assert rafter.impulse * per_force == pytest.approx(half / math.sin(math.pi / 3), rel=0.01)


@pytest.mark.parametrize("mass", [50.0, 100.0, 300.0])
def test_a_heavy_ball_in_the_gap_of_two_light_ones_lies_still(mass):
    """Two balls 30 px apart between walls carry it. It starts touching and at rest."""
    world = world_with_floor()
    for side in (-1, 1):
        world.add(Body(Box((10, 100)), (35 * side, -100)))
        add_ball(world, 15 * side, -10, 1)
    heavy = add_ball(world, 0, -10 - math.sqrt(30**2 - 15**2), mass, 20)
    assert highest(world, heavy, 3) < 0.5
    assert heavy.vel.length() < 0.1


@pytest.mark.parametrize("braces", [0, 1, 2])
def test_a_square_of_rods_lands_without_a_bounce(braces):
    """With e = 0 its energy never rises; a second diagonal is more than it needs."""
    world = world_with_floor(("Contacts", "Rods"))
    balls = [
        add_ball(world, x, y, 1, 8) for x, y in ((-20, -88), (20, -88), (20, -128), (-20, -128))
    ]
    ends = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)][: 4 + braces]
    for a, b in ends:
        world.add(Rod(balls[a], balls[b]))
    fall = 4 * G * 80  # kg px²/s²

    def energy():
        return sum(ball.mass * (ball.vel.length_squared() / 2 - G * ball.pos.y) for ball in balls)

    start = energy()
    assert max(energy() - start for _ in steps(world, 3)) < 0.01 * fall


@pytest.mark.parametrize("gap", [0.0, 3.0])
@pytest.mark.parametrize(
    "effects", [("Contacts", "Kinematics"), ("Contacts", "Bounce", "Kinematics")]
)
def test_balls_before_a_piston_go_no_faster_than_it(effects, gap):
    """With e = 0 a piston of 80 px/s pushes a row along at 80 px/s."""
    world = World((0, 0), effects=make(effects))
    piston = world.add(Body(Box((10, 40)), (-10, 0), kinematic=True))
    piston.vel = 80, 0
    row = [
        world.add(Body(Circle(10), (10 + gap + (20 + gap) * i, 0), 1, restitution=0))
        for i in range(6)
    ]
    for _ in steps(world, 2):
        pass
    assert [ball.vel.x for ball in row] == pytest.approx([80] * 6, rel=0.01)


@pytest.mark.parametrize("bead", [0.001, 0.1])
def test_a_light_bead_on_the_way_to_a_heavy_bob_stretches_no_rod(bead):
    """The rods keep their lengths, and the bob its energy (1 % of m g L) in 10 s."""
    world = World((0, G), effects=make(["Rods"]))
    balls = [add_ball(world, *place) for place in ((0, 0, 0), (70, 0, bead), (150, 0, 100))]
    rods = [world.add(Rod(*ends)) for ends in pairwise(balls)]

    def energy(ball):
        return ball.mass * (ball.vel.length_squared() / 2 - G * ball.pos.y)

    start = sum(map(energy, balls))
    for _ in steps(world, 10):
        for rod in rods:
            assert rod.a.pos.distance_to(rod.b.pos) == pytest.approx(rod.length, abs=0.1)
        assert sum(map(energy, balls)) == pytest.approx(start, abs=0.01 * 100 * G * 150)


@pytest.mark.parametrize("count", [6, 12])
@pytest.mark.parametrize("mass", [5.0, 50.0])
def test_a_heavy_ball_on_a_bridge_of_light_ones_gets_no_energy(count, mass):
    world = World((0, G), effects=make(("Contacts", "Friction", "Rods")))
    spots = [(40 * i, 60 * math.sin(math.pi * i / count)) for i in range(count + 1)]
    row = [add_ball(world, *at, 0 if at in (spots[0], spots[-1]) else 1.0, 15.0) for at in spots]
    lengths = [math.dist(a.pos, b.pos) for a, b in pairwise(row)]
    for a, b in pairwise(row):
        world.add(Rod(a, b))
    moving = [*row[1:-1], add_ball(world, 20 * count, -40, mass, 30.0)]

    def energy():
        kinetic = sum(b.m * b.vel.length_squared() + b.omega**2 / b.inv_inertia for b in moving)
        return kinetic / 2 - G * sum(b.m * b.y for b in moving)

    start, most, off = energy(), -math.inf, 0.0
    for _ in steps(world, 2):
        most = max(most, energy())
        now = [math.dist(a.pos, b.pos) for a, b in pairwise(row)]
        off = max(off, *[abs(a - b) for a, b in zip(now, lengths, strict=True)])
    assert most - start < 0.01 * mass * G * 100
    assert off < 0.5


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.parametrize("drop", [10, 30, 100, 200])
@pytest.mark.parametrize("stiffness", [0, 1e3, 1e4])
def test_a_ball_that_falls_on_planks_pulled_straight_gets_no_energy(count, drop, stiffness):
    """Nothing can move the planks: their rods may pull with any force, and do no work.

    Nor do springs from a tower to each plank, which never stretch. No rod stretches by a plank, of
    25 px.
    """
    for mass, dt in product((0.5, 3.0), (1 / 60, 1 / 120)):
        world = World((0, G), effects=make(("Contacts", "Bounce", "Rods", "Springs")))
        row = [add_ball(world, 0, 0, 0, 5.0)]
        row += [add_ball(world, 25 * i, 0, 0.5, 12.0) for i in range(1, count + 1)]
        row.append(add_ball(world, 25 * count + 25, 0, 0, 5.0))
        rods = [world.add(Rod(a, b)) for a, b in pairwise(row)]
        tower = add_ball(world, 12.5 * count + 15, -300, 0, 5.0)
        for plank in row[1:-1] if stiffness else []:
            world.add(Spring(plank, tower, stiffness))
        moving = [*row[1:-1], add_ball(world, 12.5 * (count + 1), -28 - drop, mass, 15.0)]

        def energy(balls=moving, springs=world.effects["Springs"]):
            kinetic = sum(b.m * (b.vel.length_squared() / 2 - G * b.y) for b in balls)
            return kinetic + springs.energy_in(springs.joints)

        start = energy()
        for _ in range(round(1 / dt)):
            world.step(dt)
            assert energy() - start < 0.02 * mass * G * drop
            assert all(rod.a.pos.distance_to(rod.b.pos) < 50 for rod in rods)


@pytest.mark.parametrize("count", [10, 20, 40])
def test_a_tower_does_not_sink(count):
    world = world_with_floor()
    tower = [add_ball(world, 0, -RADIUS - 2 * RADIUS * i, 1.0) for i in range(count)]
    for _ in steps(world, 3):
        pass
    assert -2 * RADIUS * count + RADIUS == pytest.approx(tower[-1].y, abs=0.5)


def v_of_segments(degrees, names, **surface):
    """Make a V, its sides so many degrees from level, and a ball above. Mirrored about x = 0."""
    world = World((0, G), effects=make(names))
    across, down = (800 * f(math.radians(degrees)) for f in (math.cos, math.sin))
    for side in (-1, 1):
        world.add(Body(Segment((side * across, -down), (0, 0)), **surface))
    height = 100 + 20 / math.cos(math.radians(degrees))
    return world, world.add(Body(Circle(20), (0, -height), 1.0, **surface))


@pytest.mark.parametrize("degrees", [2, 10, 45, 80, 88])
@pytest.mark.parametrize(("restitution", "friction"), [(0, 0), (0.5, 0), (0.5, 0.5)])
def test_a_ball_comes_to_rest_in_the_middle_of_any_v(degrees, restitution, friction):
    """Its weight presses the faces of a narrow V hard; nothing pushes it to one side.

    Friction is solved by passes, which leave a ball in a flat V some spin.
    """
    names = ("Contacts", "Bounce", "Friction")
    world, ball = v_of_segments(degrees, names, restitution=restitution, friction=friction)
    dropped = G * -ball.y
    for _ in steps(world, 5):
        energy = (ball.vel.length_squared() + 200 * ball.omega**2) / 2 - G * ball.y
        assert energy <= dropped * (1 + 1e-9)
        assert friction or abs(ball.vel.x) <= 1e-9 * math.sqrt(2 * G * 100)
    assert ball.vel.length() < 0.1


@pytest.mark.parametrize("mass", [1.0, 8.124])
def test_a_ball_squeezed_by_a_press_stays_where_it_is(mass):
    """Its two contacts ask for opposite speeds, so no impulses satisfy both."""
    world = world_with_floor(("Contacts", "Bounce", "Friction", "Kinematics"))
    ball = add_ball(world, 0, -RADIUS, mass)
    press = world.add(Body(Box((40, 8)), (0, -50), kinematic=True))
    press.vel = (0, 50)
    for _ in steps(world, 3):
        if press.y > -24:
            press.vel = (0, 0)
    assert ball.x == pytest.approx(0, abs=1e-6)
    assert -RADIUS <= ball.y < RADIUS
    assert ball.vel.length() < 0.1


def test_a_squeezed_ball_lies_as_deep_in_the_floor_as_in_the_press():
    world = world_with_floor(("Contacts", "Friction", "Kinematics"))
    ball = add_ball(world, 0, -RADIUS, 1.0)
    press = world.add(Body(Box((40, 8)), (0, -2 * RADIUS - 8), kinematic=True))
    press.vel = (0, 60)
    for step, _ in enumerate(steps(world, 2)):
        if step == 3:
            press.vel = (0, 0)
    squeezed = press.y + 8 + 2 * RADIUS
    assert ball.y == pytest.approx(-RADIUS + squeezed / 2, abs=0.05)


@pytest.mark.parametrize("seed", [17, 88, 130])
def test_a_press_throws_no_ball_away(seed):
    """What it squeezes leaves at about its speed by the tangent of an angle: 1e4 px/s is much."""
    rng = random.Random(seed)
    count, dt, speed = rng.choice([2, 3, 4, 6]), 1 / rng.choice([60, 120]), rng.uniform(10, 80)
    world = world_with_floor(("Contacts", "Bounce", "Friction", "Kinematics"))
    press = world.add(Body(Box((40, 8)), (0, -90), kinematic=True))
    press.vel = (0, speed)
    pressed = []
    while len(pressed) < count:
        radius, x = rng.uniform(5, 15), rng.uniform(-60, 60)
        y = -radius - rng.uniform(0, 40)
        if all(math.dist(b.pos, (x, y)) > b.radius + radius for b in pressed):
            pressed.append(add_ball(world, x, y, 10 ** rng.uniform(-1, 1), radius))
    for _ in range(int(90 / speed / dt)):
        world.step(dt)
        assert max(ball.vel.length() for ball in pressed) < 1e4


@pytest.mark.parametrize("friction", [0.3, 0.5, 0.6])
@pytest.mark.parametrize("pairs", [1, 2, 3])
def test_balls_that_a_circle_is_wedged_between_are_not_shot_away(pairs, friction):
    """A program sets its position, 100 px/s down to the floor.

    No ball leaves faster than the circle comes, times the slope at which it first meets two balls.
    """
    half, peg = 11.0, 18.0
    fast = 100 * math.sqrt((peg + RADIUS) ** 2 - half**2) / half
    for fps, substeps in product((60, 120, 240), (1, 4, 8)):
        world = World((0, G), substeps, make(("Contacts", "Friction")))
        world.add(Body(Box((900, 20)), (0, 20), friction=friction))
        circle = world.add(Body(Circle(peg), (0, -100), friction=friction))
        places = [side * (half + 21 * i) for i in range(pairs) for side in (-1, 1)]
        balls = [add_ball(world, x, -RADIUS, 1.0) for x in places]
        for ball in balls:
            ball.friction = friction
        for _ in range(3 * fps // 2):
            if circle.y < -peg - 1:
                circle.pos += (0, 100 / fps)
            world.step(1 / fps)
            assert max(ball.vel.length() for ball in balls) < fast


@pytest.mark.parametrize("seed", [1, 23, 132])
def test_a_pile_on_a_ball_jammed_between_two_circles_comes_to_rest(seed):
    """What the jam holds pushes nothing, or the pile would roll on and on."""
    rng, half = random.Random(seed), 27.2
    world = World((0, G), 4, make(("Contacts", "Friction", "Bounce")))
    for x in (-half, half):
        world.add(Body(Circle(18), (x, 0), friction=0.6))
        world.add(Body(Box((10, 200)), (math.copysign(half + 10, x), -200), friction=0.6))
    balls = []
    for i in range(6):
        at = rng.uniform(-1, 1) * (half - 12 if i else 1), -60 - 30 * i
        balls.append(world.add(Body(Circle(10), at, 1.0, friction=0.6, restitution=0.3)))
    balls[0].vel = (0, 600)
    for _ in range(5 * 120):
        world.step(1 / 120)
    assert max(ball.vel.length() for ball in balls) < 0.1


def make_bin(half, names):
    """Make a world with a rough floor and walls `half` px to both sides."""
    world = World((0, G), effects=make(names))
    world.add(Body(Box((half + 40, 20)), (0, 20), friction=0.6))
    for side in (-1, 1):
        world.add(Body(Box((20, 1500)), (side * (half + 20), -1480), friction=0.6))
    return world


@pytest.mark.parametrize("seed", [10, 29])
def test_a_press_in_a_bin_throws_no_ball_away(seed):
    """The speed of what it squeezes has the bound of test_a_press_throws_no_ball_away."""
    rng = random.Random(seed)
    world = make_bin(70, ("Contacts", "Bounce", "Friction", "Kinematics"))
    press = world.add(Body(Box((40, 8)), (0, -90), kinematic=True))
    press.vel = (0, 70)
    pressed = []
    while len(pressed) < 6:
        radius, x = rng.uniform(5, 15), rng.uniform(-60, 60)
        y = -radius - rng.uniform(0, 40)
        if all(math.dist(b.pos, (x, y)) > b.radius + radius for b in pressed):
            pressed.append(add_ball(world, x, y, 10 ** rng.uniform(-1, 1), radius))
    for _ in range(150):
        world.step(1 / 120)
        assert max(ball.vel.length() for ball in pressed) < 1e4


def fastest_of_pile(world):
    """Return the highest speed of balls that bear others."""
    return max(ball.vel.length() for ball in bearing_balls(world))


@pytest.mark.parametrize(("mass", "seed"), [(200.0, 0)])
def test_rough_light_balls_come_to_rest_under_a_heavy_one(mass, seed):
    """Nothing drives them: friction and impacts with e = 0 take all energy in a few swings."""
    world, rng = make_bin(60, ("Contacts", "Friction")), random.Random(seed)
    for k in range(20):
        x, y = -48 + 24 * (k % 5) + rng.random(), -RADIUS * (1 + 2 * (k // 5))
        world.add(Body(Circle(RADIUS), (x, y), 1, friction=0.6))
    world.add(Body(Circle(25), (rng.uniform(-8, 8), -180), mass, friction=0.6))
    for _ in steps(world, 5):
        pass
    assert max(fastest_of_pile(world) for _ in steps(world, 0.5)) < 0.1


@pytest.mark.soak
@pytest.mark.parametrize("seed", [5, 20])
def test_a_rained_pile_of_rough_light_and_heavy_balls_comes_to_rest(seed):
    """Each ball falls on those before it, so none is dropped into another."""
    world, rng = make_bin(100, ("Contacts", "Friction")), random.Random(seed)
    for k in range(30):
        radius = rng.uniform(9, 15)
        place = rng.uniform(radius - 100, 100 - radius), -RADIUS * (2 + 3 * k)
        world.add(Body(Circle(radius), place, 10 ** rng.uniform(0, 2), friction=0.6))
    for _ in steps(world, 11):
        pass
    assert max(fastest_of_pile(world) for _ in steps(world, 0.5)) < 0.1


def test_a_heap_that_rolls_as_gears_keeps_its_speed():
    """Rolling takes no energy: only balls that slip or are hit come to rest."""
    world = World((0, G), effects=make(("Contacts", "Friction")))
    world.add(Body(Box((400, 20)), (0, 20), friction=1))
    places = (-11, -RADIUS), (11, -RADIUS), (0, -RADIUS - math.sqrt(400 - 121))
    heap = [world.add(Body(Circle(RADIUS), place, 1, friction=1)) for place in places]
    for _ in steps(world, 1):
        pass
    for ball, turn in zip(heap, (1, 1, -1), strict=True):
        ball.vel, ball.omega = (5.0, 0.0), turn * 5.0 / RADIUS
    for _ in steps(world, 5):
        pass
    assert [ball.vel.x for ball in heap] == pytest.approx([5.0] * 3, rel=1e-3)
