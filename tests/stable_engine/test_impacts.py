"""Test impacts by closed forms and conservation laws.

No threshold comes from the engine itself. Angles are in degrees, speeds in px/s.
"""

import math
from dataclasses import replace
from types import SimpleNamespace

import pytest
from samples import sample
from worlds_for_tests import balls, build

from experiments.engines import Stable
from experiments.measures import energy, run, states, watch
from experiments.rows.hits import energy_off, gas, kinetic, moments
from experiments.rows.row import fall_speed, law, seen
from experiments.scenes import BOUNCE, DT, Ball, G, Scene, floor
from stable_engine import Body, Bounce, Box, Circle, Contacts, Segment, World

IDEAL = {"restitution": 1.0, "friction": 0.0}
SMOOTH = ("Contacts", "Bounce")
TRIAL = SimpleNamespace(build=Stable)  # as rows of the leaderboard expect it


def read_sums(engine):
    """Return the energy of motion (kg px²/s²), both parts of momentum, and angular momentum."""
    now = states(engine)
    return kinetic(engine.scene, now), *moments(engine.scene, now)


# ---------------------------------------------------------------- oblique hits


def oblique(degrees, fast, start, friction=0.0, mass=1.0, restitution=1.0):
    """Make a ball that flies along x at another one at rest, with the normal at this angle."""
    off = 20 * math.sin(math.radians(degrees))
    surface = {"restitution": restitution, "friction": friction}
    bodies = [Ball((0, 0), 10, mass, **surface), Ball((-start, -off), vel=(fast, 0), **surface)]
    return Scene(bodies, BOUNCE, gravity=(0, 0))


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
            engine = Stable(oblique(degrees, fast, start, 0.8, mass, restitution))
            for body in engine.bodies:
                body.omega = 7.0
            most, *_, before = read_sums(engine)
            whole = abs(before) + 20 * fast
            for now, *_, spin in watch(engine, 120 / fast, lambda: read_sums(engine)):  # noqa: B023
                assert spin == pytest.approx(before, abs=1e-6 * whole)
                assert now < most * (1 + 1e-9)


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
        rods = [(0, 1), (2, 3)]
        engine = Stable(Scene([*ends, *flying], (*BOUNCE, "Rods"), rods, gravity=(0, 0)))
        most, *before, _ = read_sums(engine)
        for now, *momentum, _ in watch(engine, 1, lambda: read_sums(engine)):  # noqa: B023
            assert now < most * (1 + 1e-6)
            assert momentum == pytest.approx(before, abs=1e-6 * 800)


# ---------------------------------------------------------------- rows of balls


@pytest.mark.parametrize("seed", [3, 8, 12, 68])  # each has lost energy
def test_a_gas_of_unequal_masses_keeps_its_energy(seed):
    """Also for slow impacts: without gravity, nothing rests."""
    assert energy_off(TRIAL, gas(20, (1.0, 100.0), seed), 10) < 1e-9


@pytest.mark.parametrize("count", [2, 5])
def test_a_column_that_falls_on_the_floor_keeps_its_energy(count):
    column = [Ball((0, -110 - 20 * i), **IDEAL) for i in range(count)]
    engine = Stable(Scene([floor(**IDEAL), *column], SMOOTH))
    start = energy(engine)
    assert watch(engine, 3, lambda: energy(engine)) == pytest.approx([start] * 360, rel=1e-3)


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
