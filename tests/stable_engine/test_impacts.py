"""Test impacts by symmetry, closed forms and conservation laws.

No threshold comes from the engine itself. Angles are in degrees, speeds in px/s.
"""

import math
import random
from dataclasses import replace

import pytest
from samples import sample
from worlds_for_tests import balls, build

from experiments.measures import run, watch
from experiments.rows.hits import gas
from experiments.rows.row import fall_speed, law, seen
from experiments.scenes import BOUNCE, DT, Ball, Block, G, Scene, floor
from stable_engine import Body, Bounce, Box, Circle, Contacts, Segment, World

IDEAL = {"restitution": 1.0, "friction": 0.0}
SMOOTH = ("Contacts", "Bounce")
ROUNDING = 1e-9  # share of a speed by which two mirrored speeds may differ


def mirrored(places, mass, **surface):
    """Make static or moving balls at these positions and at their mirror images."""
    return [Ball((side * x, y), 10, mass, **surface) for x, y in places for side in (-1, 1)]


def kinetic(world):
    """Return the kinetic energy of all balls, in kg px²/s²."""
    return sum(
        (b.vx**2 + b.vy**2) * b.mass / 2 + b.omega**2 * b.mass * b.radius**2 / 4
        for b in balls(world)
    )


def angular_momentum(world):
    """Return the angular momentum about the origin, in kg px²/s."""
    return sum(
        b.mass * (b.x * b.vy - b.y * b.vx) + b.omega * b.mass * b.radius**2 / 2
        for b in balls(world)
    )


# ---------------------------------------------------------------- symmetry


@pytest.mark.parametrize("friction", [0.0, 0.05, 0.6])
@pytest.mark.parametrize(("restitution", "gap"), [(1.0, 0), (0.95, 0), (0.9, 0.01), (0.5, 0)])
def test_a_mirrored_break_stays_mirrored(restitution, gap, friction):
    surface = {"restitution": restitution, "friction": friction}
    width = 20 + gap
    way = math.sqrt(3) * width / 2
    rack = [
        Ball((width * (i - row / 2), way * row), **surface)
        for row in range(5)
        for i in range(row + 1)
    ]
    cue = Ball((0, -150), vel=(0, 1500.0), **surface)
    world = build(Scene([*rack, cue], gravity=(0, 0)), *BOUNCE)
    run(world, 0.5)
    moved = balls(world)[:-1]
    for row in range(5):
        first = row * (row + 1) // 2
        for i in range(row + 1):
            one, other = moved[first + i], moved[first + row - i]
            assert (one.vx, one.vy) == pytest.approx((-other.vx, other.vy), abs=1500 * ROUNDING)


def test_a_mirrored_drop_stays_mirrored():
    surface = {"restitution": 0.5, "friction": 0.3}
    pegs = mirrored([(25, 0), (60, 20), (90, 40)], 0.0, **surface)
    falling = mirrored([(12, -100), (36, -130), (60, -160), (84, -190)], 1.0, **surface)
    world = build(Scene([floor(), *pegs, *falling]), *BOUNCE)
    world.bodies[0].pos = (0, 700)
    run(world, 0.6)
    moved = balls(world)
    for left, right in zip(moved[::2], moved[1::2], strict=True):
        assert (left.x, left.y) == pytest.approx((-right.x, right.y), abs=1e-6)


# ---------------------------------------------------------------- oblique hits


def oblique(degrees, fast, start, friction=0.0, mass=1.0, restitution=1.0):
    """Make a ball that flies along x at another one at rest, with the normal at this angle."""
    off = 20 * math.sin(math.radians(degrees))
    surface = {"restitution": restitution, "friction": friction}
    bodies = [Ball((0, 0), 10, mass, **surface), Ball((-start, -off), vel=(fast, 0), **surface)]
    return Scene(bodies, gravity=(0, 0))


@pytest.mark.parametrize("degrees", [15, 45, 70])
@pytest.mark.parametrize("fast", [100.0, 500.0, 1500.0])
def test_a_ball_leaves_a_peg_as_light_leaves_a_mirror(degrees, fast):
    for phase in range(8):
        world = build(oblique(degrees, fast, 60 + phase * fast * DT / 8, mass=0.0), *SMOOTH)
        run(world, 120 / fast)
        (ball,) = balls(world)
        turned = math.degrees(math.atan2(-ball.vy, -ball.vx))
        assert turned == pytest.approx(2 * degrees, abs=0.01)
        assert math.hypot(ball.vx, ball.vy) == pytest.approx(fast, rel=1e-9)


@pytest.mark.parametrize("shape", [Box((100, 10)), Segment((-100, 0), (100, 0), 10)])
def test_a_flat_face_keeps_its_normal_when_a_ball_changes_its_velocity(shape):
    """Back along its new velocity, which it did not fly with, it meets the left end of the wall."""
    world = World((0, 0), effects=[Contacts(), Bounce()])
    middle = None if isinstance(shape, Segment) else (0, 0)
    world.add(Body(shape, middle, **IDEAL))
    ball = world.add(Body(Circle(10), (-95, -25), 1.0, **IDEAL))
    ball.vel = 0, 1200
    world.step(1 / 120)
    assert ball.y == pytest.approx(-15), "the ball overlaps the wall, and its impact is due"
    ball.vel = 3000, 300
    world.step(1 / 120)
    assert tuple(ball.vel) == pytest.approx((3000, -300), rel=1e-9)


@pytest.mark.parametrize("degrees", [0, 20, 45, 70])
@pytest.mark.parametrize("fast", sample([500.0, 100.0, 1500.0], 3))
@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_a_rough_hit_keeps_angular_momentum_and_creates_no_energy(degrees, fast, restitution):
    for mass in (0.1, 1.0, 10.0):
        for phase in range(4):
            start = 60 + phase * fast * DT / 4
            world = build(oblique(degrees, fast, start, 0.8, mass, restitution), *BOUNCE)
            for body in balls(world):
                body.omega = 7.0
            before, most = angular_momentum(world), kinetic(world)
            whole = abs(before) + 20 * fast
            for _ in range(round(120 / fast / DT)):
                world.step(DT)
                assert angular_momentum(world) == pytest.approx(before, abs=1e-6 * whole)
                assert kinetic(world) < most * (1 + 1e-9)


@pytest.mark.parametrize("fast", [300.0, 1500.0])
@pytest.mark.parametrize("degrees", [0, 30, 60])
@pytest.mark.parametrize("turn", sample([0, 30, 100], 2))
@pytest.mark.parametrize("mass", [1.0, 1000.0])
def test_a_ball_that_hits_the_end_of_a_rod_finds_the_other_end_behind_it(fast, degrees, turn, mass):
    """Along the rod the end weighs as much as both, across it as much as itself."""
    scene = oblique(degrees, fast, 60)
    a = math.radians(turn)
    scene.bodies.append(Ball((60 * math.cos(a), 60 * math.sin(a)), 10, mass, **IDEAL))
    world = build(replace(scene, rods=[(0, 2)]), *SMOOTH, "Rods")
    run(world, 100 / fast)
    nx, ny = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    along = nx * math.cos(a) + ny * math.sin(a)
    impulse = 2 * fast * nx / (1 + along**2 / (1 + mass) + 1 - along**2)
    ball = balls(world)[1]
    exact = fast - impulse * nx, -impulse * ny
    assert (ball.vx, ball.vy) == pytest.approx(exact, abs=1e-6 * fast)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("masses", [(1.0, 1.0), (1.0, 100.0)])
def test_a_rough_hit_of_two_dumbbells_keeps_momentum_and_creates_no_energy(masses, restitution):
    surface = {"restitution": restitution, "friction": 0.6}
    for at in range(-15, 16, 5):
        ends = [
            Ball((side * 25, 0), 10, m, **surface) for side, m in zip((-1, 1), masses, strict=True)
        ]
        flying = [Ball((30 + at, y), 10, vel=(-40.0, 400.0), **surface) for y in (-60, -110)]
        world = build(
            Scene([*ends, *flying], gravity=(0, 0), rods=[(0, 1), (2, 3)]), *BOUNCE, "Rods"
        )
        most = kinetic(world)
        for _ in range(120):
            world.step(DT)
            assert kinetic(world) < most * (1 + 1e-6)
        moved = [
            sum(b.mass * v for b, v in zip(balls(world), way, strict=True))
            for way in ([b.vx for b in balls(world)], [b.vy for b in balls(world)])
        ]
        assert moved == pytest.approx([-80, 800], abs=1e-6 * 800)


@pytest.mark.parametrize("mu", [0.1, 0.6])
@pytest.mark.parametrize("restitution", [0.3, 0.9])
def test_friction_takes_mu_times_the_impulse_of_an_impact_and_no_more(mu, restitution):
    """This holds at any depth of the impact, up to the last substep's gravity."""
    surface = {"restitution": restitution, "friction": mu}
    for height in range(290, 298):
        ball = Ball((0, -10 - height), 10, vel=(3000.0, 0.0), **surface)
        world = build(Scene([floor(**surface), ball]), *BOUNCE)
        run(world, 0.9)
        taken = 3000 - balls(world)[0].vx
        exact = mu * (1 + restitution) * math.sqrt(2 * G * height)
        assert taken == pytest.approx(exact, abs=mu * (1 + restitution) * G * DT / 4)


# ---------------------------------------------------------------- rows of balls


@pytest.mark.parametrize("seed", [3, 8, 12, 68])  # each has lost energy
def test_a_gas_of_unequal_masses_keeps_its_energy(seed):
    """Also for slow impacts: without gravity, nothing rests."""
    run_gas = build(gas(20, (1.0, 100.0), seed))
    before = kinetic(run_gas)
    run(run_gas, 10)
    assert kinetic(run_gas) == pytest.approx(before, rel=1e-9)


@pytest.mark.parametrize("count", [2, 5])
def test_a_column_that_falls_on_the_floor_keeps_its_energy(count):
    column = [Ball((0, -110 - 20 * i), **IDEAL) for i in range(count)]
    world = build(Scene([floor(**IDEAL), *column]), *SMOOTH)
    h = DT / world.substeps

    def energy():
        return sum((b.vy + 980 * h / 2) ** 2 / 2 - 980 * b.y for b in balls(world))

    start = energy()
    for now in watch(world, 3, energy):
        assert now == pytest.approx(start, rel=1e-3)


# ---------------------------------------------------------------- bullets


@pytest.mark.parametrize("fast", [500.0, 5000.0, 50_000.0])
@pytest.mark.parametrize("mass", [1.0, 10.0])
@pytest.mark.parametrize("both", [True, False])
def test_a_bullet_hits_another_ball_as_a_slow_ball_does(fast, mass, both):
    """By the law of a smooth elastic impact, along the normal at touch; none passes the other."""
    nx, ny = math.sqrt(1 - 0.3**2), 0.3
    closing = 2 * fast * nx
    impulse = 2 * closing / (1 + 1 / mass)
    for phase in range(8):
        far = fast * (0.05 + phase * DT / 8)
        ball = Ball((-far, 0), 10, vel=(fast, 0), bullet=True, **IDEAL)
        other = Ball((fast * 0.05, 6), 10, mass, vel=(-fast, 0), bullet=both, **IDEAL)
        world = build(Scene([ball, other], gravity=(0, 0)), *SMOOTH, "Bullets")
        run(world, 0.2)
        one, two = balls(world)
        after = fast - impulse * nx, -impulse * ny, impulse * nx / mass - fast, impulse * ny / mass
        assert (*one.vel, *two.vel) == pytest.approx(after, abs=1e-6 * fast)


@pytest.mark.parametrize("seed", sample(range(20), 5))
def test_bullets_that_hit_each_other_stay_in_their_box(seed):
    rng = random.Random(seed)
    walls = [Block((0, side * 301), (320, 1), **IDEAL) for side in (-1, 1)]
    walls += [Block((side * 301, 0), (1, 320), **IDEAL) for side in (-1, 1)]
    flying = []
    for i in range(10):
        fast, way = 10 ** rng.uniform(2, 4.7), rng.uniform(0, 2 * math.pi)
        at, vel = (40 * i - 200, rng.uniform(-250, 250)), (math.cos(way), math.sin(way))
        vel = (fast * vel[0], fast * vel[1])
        flying.append(Ball(at, 8, 10 ** rng.uniform(-0.5, 0.5), vel=vel, bullet=True, **IDEAL))
    world = build(Scene([*walls, *flying], gravity=(0, 0)), *SMOOTH, "Bullets")
    run(world, 1)
    assert all(max(abs(ball.x), abs(ball.y)) < 300 for ball in balls(world))


@pytest.mark.parametrize("thrown", [1, 2, 3])
def test_as_many_balls_swing_out_of_a_cradle_on_rods_as_swung_in(thrown):
    """Momentum and energy are kept, so the others hang at rest."""
    pegs = [Ball((20 * i, 0), 1, mass=0.0) for i in range(5)]
    bobs = [Ball((20 * i, 100), mass=1.0, restitution=1.0) for i in range(5)]
    rods = [(i, i + 5) for i in range(5)]
    world = build(Scene(pegs + bobs, ("Contacts", "Bounce", "Rods"), rods))
    swing, (hang, drop) = world.bodies[5:], (100 * math.sin(0.5), 100 * math.cos(0.5))
    for i in range(thrown):
        swing[i].pos = (20 * i - hang, drop)
    run(world, math.pi * math.sqrt(100 / G) * (1 + 0.5**2 / 16))
    off = [body.x - 20 * i - (hang if i >= 5 - thrown else 0) for i, body in enumerate(swing)]
    assert off == pytest.approx([0] * 5, abs=seen().limit)
    fastest = max(abs(body.vx) for body in swing[: 5 - thrown])
    assert fastest < law(fall_speed(100 - drop)).limit
