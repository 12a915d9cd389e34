"""Test impacts by closed forms and conservation laws.

No threshold comes from the engine itself. Angles are in degrees, speeds in px/s.
"""

import math
import random
from dataclasses import replace
from types import SimpleNamespace

import pytest
from samples import sample
from worlds_for_tests import IDEAL, balls, build, whole_energy

from experiments.engines import Stable
from experiments.measures import run, states, watch
from experiments.rows.hits import energy_off, gas, kinetic, moments
from experiments.rows.row import SEEN, fall_speed, law
from experiments.scenes import BOUNCE, DT, Ball, Block, G, Scene, floor
from stable_engine import (
    Body,
    Bounce,
    Box,
    Bullets,
    Circle,
    Contacts,
    Friction,
    Kinematics,
    Rod,
    Rods,
    Segment,
    Spring,
    Springs,
    World,
)

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
def test_a_flat_face_keeps_its_normal_for_a_ball_put_into_it(shape):
    """Back along its velocity, which it did not fly with, it meets the left end of the wall."""
    world = World((0, 0), effects=[Contacts(), Bounce()])
    middle = None if isinstance(shape, Segment) else (0, 0)
    world.add(Body(shape, middle, **IDEAL))
    ball = world.add(Body(Circle(10), (-95, -25), 1.0, **IDEAL))
    world.step(1 / 120)
    ball.pos, ball.vel = (-95, -15), (3000, 300)
    world.step(1 / 120)
    assert tuple(ball.vel) == pytest.approx((3000, -300), rel=1e-9)


@pytest.mark.parametrize("count", [2, 4, 8])
@pytest.mark.parametrize("fast", sample([200.0, 300.0, 450.0, 700.0, 1000.0, 1500.0], 3))
def test_a_row_bounces_off_a_wall_as_if_its_balls_passed_through_each_other(fast, count):
    """Elastic balls of equal mass swap their velocities, so they keep their order all the time.

    A ball that an impact moves by less than an eighth of its radius meets others a step later.
    """
    for phase in range(6):
        starts = [-110 - 0.6 * phase - 21 * k for k in range(count)]
        row = [Ball((x, 0), 10, vel=(fast, 0), **IDEAL) for x in starts]
        engine = Stable(Scene([Block((40, 0), (40, 200), **IDEAL), *row], BOUNCE, gravity=(0, 0)))
        for step in range(1, int(400 / fast / DT)):
            engine.step(DT)
            ways = [x + 20 * k + fast * step * DT for k, x in enumerate(starts)]  # of their rims
            ends = sorted([min(way, -20 - way) for way in ways], reverse=True)
            places = [ball.x + 20 * k for k, ball in enumerate(balls(engine.world))]
            assert places == pytest.approx(ends, abs=10 / 8), f"from {starts[0]}, step {step}"
        assert places == pytest.approx(ends, abs=1e-8)


def test_no_step_ends_with_a_ball_deep_in_a_wall_or_in_another_ball():
    """What is drawn is after the bounce."""
    row = [Ball((-190 + 40 * k, 0), vel=(300 * (-1) ** k, 0), **IDEAL) for k in range(10)]
    walls = [Block((x, 0), (40, 200), **IDEAL) for x in (-240, 240)]
    engine = Stable(Scene([*walls, *row], BOUNCE, gravity=(0, 0)))
    for _ in range(600):
        engine.step(DT)
        edges = [-200.0, *[x for b in balls(engine.world) for x in (b.x - b.r, b.x + b.r)], 200.0]
        gaps = [right - left for left, right in zip(edges[::2], edges[1::2], strict=True)]
        assert min(gaps) > -10 / 8


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
        most, *before = read_sums(engine)
        for now, *momentum in watch(engine, 1, lambda: read_sums(engine)):  # noqa: B023
            assert now < most * (1 + 1e-6)
            assert momentum == pytest.approx(before, abs=1e-6 * 800)


# ---------------------------------------------------------------- angular momentum


def thrown_at_a_cluster(fast, friction):
    """Throw a spinning ball into the side of 16 balls that touch."""
    surface = {"restitution": 0.5, "friction": friction}
    places = [(20.0 * i + 10 * (j % 2), 17.3206 * j) for i in range(4) for j in range(4)]
    cue = Ball((-70, 43), 10, 3.0, vel=(fast, 0.2 * fast), omega=3.0, **surface)
    return [Ball(place, 10, **surface) for place in places] + [cue], []


def tumbling_frame(fast, friction):
    """Let a ring of six balls on rods turn and fold, so that its balls hit each other."""
    surface = {"restitution": 0.5, "friction": friction}
    rng = random.Random(1)
    corners = [(math.cos(at * math.pi / 3), math.sin(at * math.pi / 3)) for at in range(6)]
    speeds = [(rng.uniform(-0.3, 0.3) * fast, rng.uniform(-1, 1) * fast) for _ in corners]
    ring = [
        Ball((80 * x, 80 * y), 15, 1 + at, vel=speed, **surface)
        for at, ((x, y), speed) in enumerate(zip(corners, speeds, strict=True))
    ]
    return ring, [(at, (at + 1) % 6) for at in range(6)]


@pytest.mark.parametrize("effects", [("Contacts",), ("Contacts", "Friction"), BOUNCE])
@pytest.mark.parametrize("throw", [thrown_at_a_cluster, tumbling_frame])
@pytest.mark.parametrize("fast", [100.0, 400.0])
def test_what_meets_nothing_static_keeps_its_angular_momentum(effects, throw, fast):
    """Every impulse acts along one line on both, or at one point."""
    bodies, rods = throw(fast, 0.5 if "Friction" in effects else 0.0)
    engine = Stable(Scene(bodies, (*effects, "Rods"), rods, gravity=(0, 0)))
    _, *before = read_sums(engine)
    for _, *momentum in watch(engine, 2, lambda: read_sums(engine)):
        assert momentum == pytest.approx(before, abs=1e-6 * 80 * fast)


@pytest.mark.parametrize("restitution", [1.0, 0.5])
@pytest.mark.parametrize("fast", [600.0, 2000.0])
def test_a_cloud_of_fast_balls_keeps_its_angular_momentum(fast, restitution):
    """Also where one step took a ball deep into another one, and they met again in the next."""
    for seed in range(40):
        rng = random.Random(seed)
        cloud = []
        for at in range(16):
            x, y = (at % 4 - 1.5) * 32, (at // 4 - 1.5) * 32
            inwards = -rng.uniform(0, fast) / math.hypot(x, y)
            vel = inwards * x + rng.uniform(-100, 100), inwards * y + rng.uniform(-100, 100)
            surface = {"restitution": restitution, "friction": 0.0}
            cloud.append(Ball((x, y), rng.uniform(4, 14), rng.uniform(0.2, 5), vel=vel, **surface))
        engine = Stable(Scene(cloud, SMOOTH, gravity=(0, 0)))
        _, *before = read_sums(engine)
        scale = sum(b.mass * math.hypot(*b.pos) * math.hypot(*b.vel) for b in cloud)
        for _, *momentum in watch(engine, 1 / 3, lambda: read_sums(engine)):  # noqa: B023
            assert momentum == pytest.approx(before, abs=1e-9 * scale)


@pytest.mark.parametrize("friction", [0.0, 0.5, 3.0])
@pytest.mark.parametrize("restitution", [0.0, 0.3, 1.0])
def test_a_dense_cloud_of_rough_balls_keeps_momenta_and_gains_no_energy(restitution, friction):
    """Also where one step takes balls deep into others, and pushes part them."""
    for seed in range(6):
        rng = random.Random(seed)
        cloud = []
        for at in range(25):
            x, y = (at % 5 - 2) * 29, (at // 5 - 2) * 29
            inwards = -rng.uniform(0, 1500) / max(math.hypot(x, y), 29)
            vel = inwards * x + rng.uniform(-200, 200), inwards * y + rng.uniform(-200, 200)
            radius, mass, omega = rng.uniform(4, 14), rng.uniform(0.2, 5), rng.uniform(-40, 40)
            cloud.append(Ball((x, y), radius, mass, vel, omega, restitution, friction))
        engine = Stable(Scene(cloud, BOUNCE, gravity=(0, 0)))
        first, *before = read_sums(engine)
        scale = sum(b.mass * 58 * math.hypot(*b.vel) for b in cloud)
        last = first
        for now, *momentum in watch(engine, 0.5, lambda: read_sums(engine), (1 + seed % 4) / 120):  # noqa: B023
            assert momentum == pytest.approx(before, abs=1e-9 * scale)
            assert now < last + 1e-6 * first
            last = now


# ---------------------------------------------------------------- rows of balls


@pytest.mark.parametrize("seed", [3, 8, 12, 68])  # each has lost energy
def test_a_gas_of_unequal_masses_keeps_its_energy(seed):
    """Also for slow impacts: without gravity, nothing rests."""
    assert energy_off(TRIAL, gas(20, (1.0, 100.0), seed), 10) < 1e-9


def total(engine):
    """Return the energy of all balls."""
    gx, gy = engine.world.gravity
    return sum(
        b.mass * ((b.vx**2 + b.vy**2) / 2 - gx * b.x - gy * b.y) for b in balls(engine.world)
    )


@pytest.mark.parametrize("masses", [(1, 1), (1, 1, 1, 1, 1), (3, 1, 2), (1, 5)])
@pytest.mark.parametrize("apart", [20, 60])
def test_a_column_that_falls_on_the_floor_keeps_its_energy(masses, apart):
    """Nothing is left in the floor or in another ball: a push out would lift it for nothing."""
    column = [Ball((0, -110 - apart * i), 10, m, **IDEAL) for i, m in enumerate(masses)]
    engine = Stable(Scene([floor(**IDEAL), *column], SMOOTH))
    engine.step(DT)  # balls that touch at the start are taken for resting until they fall
    start = total(engine)
    assert watch(engine, 10, lambda: total(engine)) == pytest.approx([start] * 1200, rel=1e-9)


@pytest.mark.parametrize(
    ("fast", "bullet"),
    [
        (100.0, False),
        (300.0, False),
        (550.0, False),
        (1730.0, False),
        (900.0, True),
        (5000.0, True),
    ],
)
@pytest.mark.parametrize("degrees", [0, 37])
def test_a_ball_between_two_walls_is_where_exact_bounces_take_it(fast, bullet, degrees):
    """At any phase of the steps: a wall mirrors the way that goes on behind it."""
    turn = math.radians(degrees)
    ux, uy = math.cos(turn), math.sin(turn)
    world = World((0, 0), effects=[Contacts(), Bounce(), Bullets()])
    for at in (-111, 111):
        ends = [(at * ux - side * 50 * uy, at * uy + side * 50 * ux) for side in (-1, 1)]
        world.add(Body(Segment(*ends, 1), **IDEAL))
    ball = world.add(Body(Circle(10), (0, 0), 1.0, bullet=bullet, **IDEAL))
    ball.vel = fast * ux, fast * uy
    for step in range(1, 600):
        world.step(DT)
        way = (fast * step * DT + 100) % 400
        place = way - 100 if way < 200 else 300 - way
        if -100 + fast * DT < place < 100 - fast * DT:  # else the impact may still be due
            assert ball.x * ux + ball.y * uy == pytest.approx(place, abs=1e-6)


@pytest.mark.parametrize("off", [0, 5, 12])
@pytest.mark.parametrize("fast", [300, 1000, 3000])
def test_the_ends_of_a_short_rod_never_hit_each_other(off, fast):
    """Its balls overlap, so they are never in contact, however hard another ball hits them."""
    hits = []
    effects = [Contacts(on_hit=lambda a, b, speed: hits.append({a, b})), Bounce(), Rods()]
    world = World((0, 0), 4, effects)
    ends = [world.add(Body(Circle(10), (0, y), 1, restitution=1)) for y in (0, 8)]
    world.add(Rod(*ends))
    world.add(Body(Circle(10), (-60, off), 5, restitution=1)).vel = fast, 0
    for _ in range(60):
        world.step(1 / 60)
    assert hits and set(ends) not in hits


@pytest.mark.parametrize("restitution", [0.0, 0.8, 1.0])
def test_a_hit_at_the_end_of_a_dumbbell_keeps_angular_momentum(restitution):
    surface = {"restitution": restitution, "friction": 0.0}
    ends = [Ball((0, 0), 10, 1.0, **surface), Ball((100, 0), 10, 2.0, **surface)]
    cue = Ball((5, 150), 10, 1.0, vel=(0.0, -700.0), **surface)
    engine = Stable(Scene([*ends, cue], (*SMOOTH, "Rods"), [(0, 1)], gravity=(0, 0)))
    most, *before = read_sums(engine)
    for now, *momentum in watch(engine, 1, lambda: read_sums(engine)):
        assert now < most * (1 + 1e-6)
        assert momentum == pytest.approx(before, abs=1e-6 * 700 * 100)


@pytest.mark.parametrize("push", [-490.0, 490.0, 2000.0])
def test_a_ball_that_a_force_pushes_bounces_as_high_as_under_such_gravity(push):
    world = World((0, 980), effects=[Contacts(), Bounce()])
    world.add(Body(Box((100, 20)), (0, 20), **IDEAL))
    ball = world.add(Body(Circle(10), (0, -60), 2.0, **IDEAL))
    highest = 0.0
    for step in range(1200):
        ball.apply_force((0, 2.0 * push))
        world.step(DT)
        if step > 1000:
            highest = min(highest, ball.y)
    assert highest == pytest.approx(-60, abs=(980 + push) * DT * DT)


def energy_on_spring(spring):
    """Return the energy of two bodies and their spring."""
    a, b = spring.a, spring.b
    flight = sum(body.mass * body.vel.length_squared() / 2 for body in (a, b))
    return flight + spring.stiffness * (b.x - a.x - spring.length) ** 2 / 2


def test_two_balls_on_a_spring_that_hit_each_other_keep_their_energy():
    """The spring pulls by another length while they overlap, so they are moved back."""
    world = World((0, 0), effects=[Contacts(), Bounce(), Springs()])
    a, b = [world.add(Body(Circle(10), (x, 0), m, **IDEAL)) for x, m in ((-60, 1.0), (60, 2.0))]
    spring = world.add(Spring(a, b, 60.0, 0.0, 60.0))
    start = energy_on_spring(spring)
    for _ in range(2400):
        world.step(DT)
        assert energy_on_spring(spring) == pytest.approx(start, rel=1e-3)


@pytest.mark.parametrize(("stiffness", "length"), [(60.0, 190.0), (60.0, 110.0), (400.0, 190.0)])
def test_a_ball_that_a_spring_pulls_onto_a_wall_keeps_its_energy(stiffness, length):
    """It is so fast that the wall stops its core, and the spring still pulls at the wall."""
    world = World((0, 0), effects=[Contacts(), Bounce(), Springs()])
    world.add(Body(Box((20, 50)), (-20, 0), **IDEAL))
    peg = world.add(Body(Circle(5), (-200, 0)))
    ball = world.add(Body(Circle(10), (90, 0), 1.0, **IDEAL))
    spring = world.add(Spring(peg, ball, stiffness, 0.0, length))
    start, hits = energy_on_spring(spring), 0
    for _ in range(1200):
        before = ball.vx
        world.step(DT)
        hits += before < 0 < ball.vx
        assert energy_on_spring(spring) == pytest.approx(start, rel=3e-3)
    assert hits > 10


@pytest.mark.parametrize("substeps", [1, 4])
def test_a_ball_that_a_soft_spring_draws_far_into_a_wall_gains_no_energy(substeps):
    """On its way back to the wall, it loses the speed that the spring gave it."""
    world = World((0, 0), substeps, [Contacts(), Bounce(), Springs()])
    world.add(Body(Box((20, 200)), (-20, 0), **IDEAL))
    peg = world.add(Body(Circle(4), (-80, 0)))
    ball = world.add(Body(Circle(10), (200, 0), 1.0, **IDEAL))
    spring = world.add(Spring(peg, ball, 60.0, 0.0, 20.0))
    start = energy_on_spring(spring)
    for _ in range(600):
        world.step(1 / 60)
        assert energy_on_spring(spring) < 1.001 * start


def meet_on_joints(vx, vy):
    """Return where rough balls on a rod and a spring get, seen from a point with this velocity."""
    world = World((0, 0), effects=[Contacts(), Friction(), Bounce(), Rods(), Springs()])
    for at, radius, mass, fast, spin in (
        ((-200, 0), 15, 1.0, (200, 10), 3.0),
        ((-100, 0), 10, 2.0, (0, 0), 0.0),
        ((-60, 40), 12, 1.0, (-20, -40), -5.0),
        ((100, 8), 20, 4.0, (-130, 0), 0.0),
        ((40, -60), 9, 0.5, (0, 60), 0.0),
    ):
        ball = world.add(Body(Circle(radius), at, mass, restitution=0.6, friction=0.5))
        ball.vel, ball.omega = (fast[0] + vx, fast[1] + vy), spin
    _, *ends = world.bodies
    world.add(Rod(*ends[:2]))
    world.add(Spring(*ends[2:], 200.0, 2.0))
    for _ in range(120):
        world.step(DT)
    return [x for b in world.bodies for x in (b.x - 120 * DT * vx, b.y - 120 * DT * vy, b.angle)]


def test_impacts_on_rods_and_springs_are_the_same_in_a_moving_frame():
    assert meet_on_joints(700, -300) == pytest.approx(meet_on_joints(0, 0), abs=1e-9)


def test_a_ball_on_a_spring_that_hits_others_keeps_momentum():
    """Springs pass on the impulses of flights back and on."""
    world = World((0, 0), effects=[Contacts(), Bounce(), Springs()])
    for at, mass, fast in (
        ((0, 0), 1.0, (300, 0)),
        ((0, 80), 2.0, (0, 0)),
        ((150, 5), 1.0, (0, 0)),
    ):
        world.add(Body(Circle(10), at, mass, **IDEAL)).vel = fast
    world.add(Spring(*world.bodies[:2], 200.0))
    for _ in range(240):
        world.step(DT)
    assert sum(b.mass * b.vx for b in world.bodies) == pytest.approx(300, abs=1e-6 * 300)
    assert sum(b.mass * b.vy for b in world.bodies) == pytest.approx(0, abs=1e-6 * 300)


@pytest.mark.parametrize("degrees", [20, 40, 80])
def test_a_pendulum_that_bounces_off_a_wall_at_plumb_rises_as_high_as_before(degrees):
    turn, length = math.radians(degrees), 150.0
    bob = Ball((-length * math.sin(turn), length * math.cos(turn)), **IDEAL)
    wall = Block((30, length), (20, 40), **IDEAL)
    engine = Stable(Scene([Block((0, 0), (1, 1)), wall, bob], (*SMOOTH, "Rods"), [(0, 2)]))
    heights = watch(engine, 30, lambda: states(engine)[2].y)
    top = min(heights[-120:])
    assert top == pytest.approx(length * math.cos(turn), abs=5e-4 * length)


def test_a_dense_rain_of_elastic_balls_gains_no_energy():
    """A ball that an impact throws at another one meets it in the same step."""
    rng = random.Random(3)
    walls = [Block((side * 150, -400), (20, 600), 1.0, 0.0) for side in (-1, 1)]
    spots = [(-112.5 + 25 * (i % 10) + rng.uniform(-1, 1), -20 - 25 * (i // 10)) for i in range(60)]
    engine = Stable(Scene([floor(**IDEAL), *walls, *(Ball(at, **IDEAL) for at in spots)], SMOOTH))
    resting = 60 * G * 10
    start = total(engine) - resting
    shares = watch(engine, 3, lambda: (total(engine) - resting) / start)
    assert max(abs(share - 1) for share in shares) < 0.01


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
    assert off == pytest.approx([0] * 5, abs=SEEN.limit)
    fastest = max(abs(body.vx) for body in swing[: 5 - thrown])
    assert fastest < law(fall_speed(100 - drop)).limit


# ---------------------------------------------------------------- at several walls


def drop_on_resting_ball(degrees, restitution, drop):
    """Let a ball rest on two faces that rise by this angle, then let another one fall on it."""
    surface = {"restitution": restitution, "friction": 0.0}
    world = World((0, G), effects=[Contacts(), Bounce()])
    turn = math.radians(degrees)
    for side in (-1, 1):
        end = side * 400 * math.cos(turn), -400 * math.sin(turn)
        world.add(Body(Segment(end, (0, 0)), **surface))
    rests = world.add(Body(Circle(20), (0, -20 / math.cos(turn)), 3.0, **surface))
    run(world, 1.0)
    falls = world.add(Body(Circle(12), (0, rests.pos.y - 32 - drop), 1.0, **surface))
    return world, rests, falls


@pytest.mark.parametrize("drop", [2, 30, 100])  # 2 px: too slow to bounce off the faces
@pytest.mark.parametrize("restitution", [0.5, 1.0])
@pytest.mark.parametrize("degrees", [0, 10, 30, 60])
def test_a_hit_on_a_ball_that_rests_in_a_v_stays_on_the_axis(degrees, restitution, drop):
    """A mirrored law throws neither ball sideways; gravity does no work on a ball at rest."""
    world, rests, falls = drop_on_resting_ball(degrees, restitution, drop)
    start, sideways, energies = whole_energy(world), 0.0, []
    for _ in range(60):
        world.step(DT)
        sideways = max(sideways, abs(rests.vel.x), abs(falls.vel.x))
        energies.append(whole_energy(world))
    assert sideways <= 1e-9 * fall_speed(drop)
    assert max(energies) <= start + 1e-6 * G * drop
    if restitution == 1 and drop > 2:
        assert min(energies) == pytest.approx(start, abs=1e-6 * G * drop)


def test_a_ball_that_meets_floor_and_ramp_in_one_step_bounces_off_the_floor():
    """Off the floor it flies past the end of the ramp, which it would have met later."""
    world = World((0, 0), effects=[Contacts(), Bounce()])
    world.add(Body(Box((400, 50)), (0, 50), restitution=0.6))
    world.add(Body(Segment((50, 0), (300, -150)), restitution=0.6))
    ball = world.add(Body(Circle(12), (46, -12.549), 1.0, restitution=0.6))
    ball.vel = (-130, 278)
    world.step(1 / 60)
    risen = 0.6 * 278 * (1 / 60 - 0.549 / 278)
    assert (*ball.pos, *ball.vel) == pytest.approx((46 - 130 / 60, -12 - risen, -130, -0.6 * 278))


@pytest.mark.parametrize("degrees", [10, 30, 60])
def test_no_shot_into_the_angle_of_floor_and_ramp_sinks_into_either(degrees):
    """Impacts leave no overlap. A slow contact, at at most v, is solved once per substep."""
    rng = random.Random(degrees)
    slope_x, slope_y = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    for _ in range(sample([200, 60], 1)[0]):
        world = World((0, 0), effects=[Contacts(), Bounce()])
        world.add(Body(Box((5000, 50)), (0, 50), restitution=0.6))
        world.add(Body(Segment((0, 0), (-300 * slope_x, -300 * slope_y)), restitution=0.6))
        fast, turn = rng.uniform(100, 800), rng.uniform(math.pi / 2, math.pi)
        at = rng.uniform(20, 120), rng.uniform(-60, -14)
        ball = world.add(Body(Circle(12), at, 1.0, restitution=0.6))
        ball.vel = fast * math.cos(turn), fast * math.sin(turn)
        for _ in range(12):
            world.step(1 / 60)
            x, y = ball.pos
            along = min(max(-x * slope_x - y * slope_y, 0.0), 300.0)
            to_ramp = math.hypot(x + along * slope_x, y + along * slope_y)
            assert min(-y, to_ramp) >= 12 - fast / 240


@pytest.mark.parametrize("shape", [Box((40, 40)), Segment((0, 0), (40, 0), 0), Circle(5)])
@pytest.mark.parametrize("frame", [(0, 0), (64, -32), (300, 500)])
@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_a_ball_loses_no_time_at_a_corner(shape, frame, share):
    """It flies straight to the touch, and by the law of reflection from there, in any frame."""
    moving = {"kinematic": True} if any(frame) else {}
    world = World((0, 0), effects=[Contacts(), Bounce(), *([Kinematics()] if moving else [])])
    tip = {"Box": (40, 40), "Segment": (20, 0), "Circle": (0, 0)}[type(shape).__name__]
    wall = world.add(Body(shape, tip, **IDEAL, **moving))
    wall.vel = frame
    reach = 15 if isinstance(shape, Circle) else 10
    nx, ny = -math.cos(1.0), -math.sin(1.0)  # from the corner at (0, 0) to the ball
    vx, vy = 300.0, 200.0
    t = share / 60
    ball = world.add(Body(Circle(10), (nx * reach - vx * t, ny * reach - vy * t), 1.0, **IDEAL))
    ball.vel = vx + frame[0], vy + frame[1]
    closing = -vx * nx - vy * ny
    out_x, out_y, rest = vx + 2 * closing * nx, vy + 2 * closing * ny, 1 / 60 - t
    world.step(1 / 60)
    x, y = ball.x - frame[0] / 60, ball.y - frame[1] / 60
    assert (x, y) == pytest.approx((nx * reach + out_x * rest, ny * reach + out_y * rest))
    assert (ball.vx - frame[0], ball.vy - frame[1]) == pytest.approx((out_x, out_y))


@pytest.mark.parametrize("shape", [Box((40, 40)), Segment((0, 0), (40, 0), 0), Circle(5)])
@pytest.mark.parametrize("frame", [(0, 0), (300, -500)])
@pytest.mark.parametrize("fast", [400, 1000, 1500])
@pytest.mark.parametrize("degrees", [0, 30, 45])
@pytest.mark.parametrize("depth", [0.1, 0.5, 2.0])
def test_a_fast_ball_bounces_off_a_corner_even_if_it_passes_that_in_a_step(
    shape, frame, fast, degrees, depth
):
    """It would get so deep into the corner, and leave it, or get over a face of the body.

    By the law of reflection, v' = v - 2 (v n) n, with the normal n at the touch.
    """
    tip = {"Box": (40, 40), "Segment": (20, 0), "Circle": (0, 0)}[type(shape).__name__]
    moving = {"kinematic": True} if any(frame) else {}
    reach = 15 if isinstance(shape, Circle) else 10
    ahead_x, ahead_y = math.cos(math.radians(degrees)), -math.sin(math.radians(degrees))
    beside = reach - depth  # of the corner at (0, 0)
    back = math.sqrt(reach * reach - beside * beside)
    touch_x, touch_y = beside * ahead_y - back * ahead_x, -beside * ahead_x - back * ahead_y
    nx, ny = -touch_x / reach, -touch_y / reach
    vx, vy = fast * ahead_x, fast * ahead_y
    closing = vx * nx + vy * ny
    out_x, out_y = vx - 2 * closing * nx, vy - 2 * closing * ny
    for share in (0.1, 0.3, 0.5, 0.7, 0.9):
        world = World((0, 0), effects=[Contacts(), Bounce(), *([Kinematics()] if moving else [])])
        wall = world.add(Body(shape, tip, **IDEAL, **moving))
        wall.vel = frame
        before, after = (1 + share) / 120, (2 - share) / 120
        at = touch_x - vx * before, touch_y - vy * before
        ball = world.add(Body(Circle(10), at, 1.0, **IDEAL))
        ball.vel = vx + frame[0], vy + frame[1]
        for _ in range(3):
            world.step(1 / 120)
        x, y = ball.x - frame[0] / 40, ball.y - frame[1] / 40
        assert (x, y) == pytest.approx((touch_x + out_x * after, touch_y + out_y * after))
        assert (ball.vx - frame[0], ball.vy - frame[1]) == pytest.approx((out_x, out_y))
