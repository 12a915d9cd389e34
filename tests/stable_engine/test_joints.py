"""Test rods and springs by energy and equilibrium."""

import math
import random
from functools import partial
from itertools import combinations, pairwise, product

import pytest
from samples import sample
from worlds_for_tests import balls, build, whole_energy

from experiments.engines import Stable
from experiments.measures import energy, run, watch, worst_stretch
from experiments.rows.row import fall_speed, late
from experiments.scenes import DT, TOUCH, Ball, Block, G, Scene, Spring, chain, oscillator
from experiments.steps import at_random, lasting
from stable_engine import Body, Circle, Rod, Rods, World

# ---------------------------------------------------------------- rods keep energy


def swinging(links, length, masses=1.0):
    """Make a chain of rods, released from the horizontal."""
    peg = Ball((0, 0), 4, mass=0)
    row = [Ball((length * (i + 1), 0), 4, masses) for i in range(links)]
    return Scene([peg, *row], ("Rods",), [(i, i + 1) for i in range(links)])


def energy_error(scene, seconds):
    """Return the largest energy error, as a share of the energy lost from the horizontal to
    rest."""
    engine = Stable(scene)
    depth = 0.0
    for a, b in scene.rods:
        depth += math.dist(scene.bodies[a].pos, scene.bodies[b].pos) * sum(
            scene.bodies[i].mass for i in range(b, len(scene.bodies))
        )
    start = energy(engine, DT)
    seen = watch(engine, seconds, lambda: energy(engine, DT))
    return max(abs(now - start) for now in seen) / (depth * G)


@pytest.mark.parametrize("bob", sample([1.0, 10.0, 100.0], 2))
@pytest.mark.parametrize("angles", [(170, 10), (120, -60), (90, 90)])
def test_a_double_pendulum_with_a_heavier_bob_keeps_its_energy(bob, angles):
    """Nothing takes or gives energy: 1 % of the greatest fall in 20 s. Angles are from plumb."""
    balls, x, y = [Ball((0, 0), 4, mass=0)], 0.0, 0.0
    for angle, mass in zip(angles, (1.0, bob), strict=True):
        x += 100 * math.sin(math.radians(angle))
        y += 100 * math.cos(math.radians(angle))
        balls.append(Ball((x, y), 3, mass))
    engine = Stable(Scene(balls, ("Rods",), [(0, 1), (1, 2)]))
    start, fall = energy(engine, DT), 2 * 100 * G * (1 + 2 * bob)
    assert all(
        abs(now - start) < 0.01 * fall for now in watch(engine, 20, lambda: energy(engine, DT))
    )


def test_a_light_ball_between_two_rods_takes_no_energy():
    scene = swinging(2, 100.0)
    scene.bodies[1].mass = 0.01
    assert energy_error(scene, 20) < 0.01
    scene.bodies[1].mass = 0.001
    engine = Stable(scene)
    assert max(watch(engine, 5, lambda: worst_stretch(engine))) < 0.5


def test_a_chain_keeps_its_energy_with_a_heavy_ball_at_its_end():
    engine = Stable(chain(10, (20.0, 0.0), bob=100.0))
    start = energy(engine, DT)
    seen = watch(engine, 5, lambda: (abs(energy(engine, DT) - start), worst_stretch(engine)))
    assert max(error for error, _ in seen) < 0.01 * 100 * G * 200
    assert max(stretch for _, stretch in seen) < 20
    assert seen[-1][1] < 0.5


@pytest.mark.parametrize("degrees", sample([10, 16, 22, 28], 4))
def test_a_wrecking_ball_tears_no_chain(degrees):
    """It hits a tower beside its way and swings on; light links snap tight behind 1000 kg."""
    way = -math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    links = [Ball((50 * i * way[0], 50 * i * way[1]), 5, float(i > 0)) for i in range(11)]
    wrecker = Ball((550 * way[0], 550 * way[1]), 40, 1000.0)
    column = [Ball((100, 580 - 40 * i), 20) for i in range(6)]
    bodies = [*links, wrecker, Block((0, 610), (800, 10)), *column]
    rods = [(i, i + 1) for i in range(11)]
    engine = Stable(Scene(bodies, (*TOUCH, "Rods"), rods))
    assert max(watch(engine, 6, lambda: worst_stretch(engine))) < late(fall_speed(550)).limit


def test_a_closed_frame_of_rods_turns_with_its_energy():
    """A square with both diagonals has one rod too many: it must still turn as one."""
    corners = [(-50, -50), (50, -50), (50, 50), (-50, 50)]
    frame = [Ball(at, 5, vel=(-4 * at[1], 4 * at[0])) for at in corners]
    rods = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)]
    engine = Stable(Scene(frame, ("Rods",), rods, gravity=(0, 0)))
    start = energy(engine)
    run(engine, 10)
    assert energy(engine) == pytest.approx(start, rel=0.01)
    assert worst_stretch(engine) < 0.1


@pytest.mark.parametrize("shorter", [0.003, 0.05, 0.3])
def test_rods_that_cannot_all_have_their_lengths_share_the_error(shorter):
    """A square with both diagonals has one rod too many: its matrix is singular."""
    world = World((0, 0), 4, [Rods()])
    corners = [(-50, -50), (50, -50), (50, 50), (-50, 50)]
    balls = [world.add(Body(Circle(5), corner, mass=1)) for corner in corners]
    rods = [world.add(Rod(a, b)) for a, b in combinations(balls, 2)]
    off = shorter * rods[1].length
    rods[1].length -= off
    for _ in range(120):
        world.step(DT)
        assert max(abs(r.a.pos.distance_to(r.b.pos) - r.length) for r in rods) < off
        assert max(ball.vel.length() for ball in balls) < 1


@pytest.mark.parametrize("count", [2, 5])
def test_a_zigzag_chain_too_short_for_its_pegs_stays_slow(count):
    """Rods do no work, so balls that start at rest do not speed up as these pull them straight."""
    world = World((0, 0), 4, [Rods()])
    places = [(200 * i / (count + 1), 5 * (i % 2 == 0)) for i in range(1, count + 1)]
    pegs = [world.add(Body(Circle(5), (x, 0))) for x in (0, 200)]
    row = [world.add(Body(Circle(3), place, mass=1)) for place in places]
    rods = [world.add(Rod(a, b)) for a, b in pairwise([pegs[0], *row, pegs[1]])]
    for rod in rods:
        rod.length *= 0.95
    for _ in range(120):
        world.step(DT)
        assert max(ball.vel.length() for ball in row) < 1
    assert max(rod.a.pos.distance_to(rod.b.pos) / rod.length for rod in rods) < 1.1


# ---------------------------------------------------------------- springs hang at their stretch


CORNERS = [(1e2, 1e6, 4, 0.5), (1e9, 0.0, 4, 0.5)]
STARS = [
    pytest.param(*each, 5, marks=pytest.mark.soak)
    for each in product([1e2, 1e4, 1e6, 1e9], [0.0, 1.0, 1e3, 1e6], [1, 4])
]


@pytest.mark.parametrize(("stiffness", "damping", "substeps", "seconds"), [*CORNERS, *STARS])
def test_a_star_of_springs_never_gains_energy(stiffness, damping, substeps, seconds):
    """Thirty springs on one ball must behave like one spring of their sum.

    A solver that takes them one by one throws the ball out in its first step.
    """
    ring = [
        Ball((100 * math.cos(i * math.tau / 30), 100 * math.sin(i * math.tau / 30)), mass=0)
        for i in range(30)
    ]
    springs = [Spring(i, 30, stiffness, damping, 90.0) for i in range(30)]
    scene = Scene([*ring, Ball((5, 3))], ("Springs",), springs=springs, gravity=(0, 0))
    engine = Stable(scene, substeps)
    (ball,) = balls(engine.world)
    most = max(watch(engine, seconds, lambda: math.hypot(ball.x, ball.y)))
    assert most < 1.5 * math.hypot(5, 3)


@pytest.mark.parametrize("seed", [0, 24, 26])
def test_springs_between_free_balls_keep_momentum(seed):
    """The centre of mass goes straight on, even where some springs are stiff and some soft."""
    rng = random.Random(seed)
    stiffness, count = 10 ** rng.uniform(1, 5), rng.randint(3, 6)
    row = [
        Ball((30 * i, 0), 6, 10 ** rng.uniform(-1, 1), vel=(rng.gauss(0, 700), rng.gauss(0, 700)))
        for i in range(count)
    ]
    springs = [Spring(i, i + 1, stiffness, length=30) for i in range(count - 1)]
    engine = Stable(Scene(row, ("Springs",), springs=springs, gravity=(0, 0)))
    mass = sum(ball.mass for ball in row)
    x = sum(ball.mass * ball.pos[0] for ball in row) / mass
    vx, vy = (sum(ball.mass * ball.vel[k] for ball in row) / mass for k in (0, 1))
    moving = balls(engine.world)
    for step in range(1, 240):
        engine.step(DT)
        assert sum(b.m * b.x for b in moving) / mass == pytest.approx(x + vx * step * DT, abs=1e-6)
        assert sum(b.m * b.y for b in moving) / mass == pytest.approx(vy * step * DT, abs=1e-6)


@pytest.mark.parametrize("damping", [0.0, 3.0])
def test_a_hit_on_balls_on_springs_keeps_momentum(damping):
    """What springs take from one ball while it flies back to a touch, they give to another."""
    row = [Ball((50 * i, 0), restitution=1.0) for i in range(3)]
    cue = Ball((-60, 3), mass=2.0, vel=(200, 0), restitution=1.0)
    springs = [Spring(0, 1, 500.0, damping, 49.0), Spring(1, 2, 500.0, damping, 50.0)]
    effects = ("Contacts", "Bounce", "Springs")
    engine = Stable(Scene([*row, cue], effects, springs=springs, gravity=(0, 0)))
    for _ in range(120):
        engine.step(1 / 60)
        moving = balls(engine.world)
        momentum = sum(b.m * b.vx for b in moving), sum(b.m * b.vy for b in moving)
        assert momentum == pytest.approx((400, 0), abs=1e-9 * 400)


LIGHT_AND_HEAVY = [
    ((0.01, 0.2, 98), 3.8e6, 0, 4),
    ((0.01, 1, 50), 1e6, 0, 4),
    ((0.01, 0.1, 100), 1e6, 1, 1),
    ((0.02, 13, 59, 0.33, 0.59), 7.8e6, 1e3, 4),
]


@pytest.mark.parametrize(("masses", "stiffness", "damping", "substeps"), LIGHT_AND_HEAVY)
def test_light_balls_between_tight_springs_never_gain_energy(masses, stiffness, damping, substeps):
    """A chain hangs at rest, where its energy is least. So it keeps at most what it is given."""
    rng, y = random.Random(3), 0.0
    row = [Ball((0, 0), 2, 0)]
    for i, mass in enumerate(masses):
        y += 30 + sum(masses[i:]) * G / stiffness
        vel = rng.uniform(-30, 30), rng.uniform(-30, 30)
        row.append(Ball((0, y), 4, mass, vel=vel))
    springs = [Spring(i, i + 1, stiffness, damping, 30) for i in range(len(masses))]
    engine = Stable(Scene(row, ("Springs",), springs=springs), substeps)
    given = sum(ball.mass * math.hypot(*ball.vel) ** 2 / 2 for ball in row)

    def kinetic():
        return sum(ball.m * ball.vel.length_squared() / 2 for ball in balls(engine.world))

    assert max(watch(engine, 5, kinetic, 1 / 60)) <= 1.02 * given


def path_of_a_pull(stiffness, damping):
    """Return where a ball is from the rest of its spring (px) for two seconds after 50 px."""
    peg, ball = Ball((0, 0), 4, mass=0), Ball((0, 150), 4)
    spring = Spring(0, 1, stiffness, damping, 100.0)
    engine = Stable(Scene([peg, ball], ("Springs",), springs=[spring], gravity=(0, 0)))
    (ball,) = balls(engine.world)
    return watch(engine, 2, lambda: ball.y - 100)


@pytest.mark.parametrize(("omega", "ratio"), [(5, 0.01), (10, 0.3), (30, 0.05), (60, 0.05)])
def test_a_damped_spring_follows_the_exact_solution(omega, ratio):
    """The error that is left is that of the velocity half a substep before the start."""
    begun = (ratio + omega * DT / 4) * (omega * DT / 4) ** 2
    rate, turn = omega * ratio, omega * math.sqrt(1 - ratio * ratio)
    for step, x in enumerate(path_of_a_pull(omega**2, 2 * rate), 1):
        t = step * DT
        wave = math.cos(turn * t) + rate / turn * math.sin(turn * t)
        assert x == pytest.approx(50 * math.exp(-rate * t) * wave, abs=50 * begun)


@pytest.mark.parametrize("stiffness", [1e2, 1e4, 1e6, 1e8])
def test_a_critically_damped_spring_passes_its_rest_by_no_hair(stiffness):
    assert min(path_of_a_pull(stiffness, 2 * math.sqrt(stiffness))) > -50 * 1e-4


@pytest.mark.parametrize("turn", [0.45, 0.5, 0.55])
@pytest.mark.parametrize("change", [0.05, 0.2])
def test_a_spring_that_steps_make_soft_and_stiff_in_turns_gains_no_energy(turn, change):
    """With q = omega h / 2, a leapfrog's energy reads up to 1 / (1 - q²) of what it is, and by
    velocities half a substep old up to 1 + sin(q) of that."""
    omega, dt = turn * 240, 1 / 60
    world, q = build(oscillator(omega**2)), omega * dt * (1 + change) / 8
    most = whole_energy(world) * (1 + math.sin(q)) / (1 - q * q)
    for step in lasting(5, at_random(dt * (1 - change), dt * (1 + change))):
        world.step(step)
        assert whole_energy(world) < most


@pytest.mark.parametrize("turn", [0.2, 0.41, 0.49])
@pytest.mark.parametrize("substeps", [1, 4])
@pytest.mark.parametrize("effects", [(), TOUCH])
def test_a_spring_that_is_not_stiff_keeps_its_swing(effects, substeps, turn):
    """Two free balls swing by 10 px; `turn` (rad) is how far in a substep."""
    omega = turn * substeps / DT
    balls_apart = [Ball((0, 0), vel=(-5 * omega, 0)), Ball((100, 0), vel=(5 * omega, 0))]
    spring = Spring(0, 1, omega * omega / 2, 0.0, 100.0)
    scene = Scene(balls_apart, ("Springs", *effects), springs=[spring], gravity=(0, 0))
    engine = Stable(scene, substeps)
    a, b = balls(engine.world)
    swings = watch(engine, 5, lambda: math.hypot(b.x - a.x - 100, (b.vx - a.vx) / omega))
    assert all(swing == pytest.approx(10, rel=0.01) for swing in swings)


@pytest.mark.parametrize("stiffness", [1e3, 1e4, 1e5, 1e6])
def test_molecules_of_rods_and_stiff_springs_gain_no_energy(stiffness):
    """Nothing acts on them. Velocities on stiff springs are read half a substep late, by
    (omega h / 2)² of the energy: at most 10 %, as faster swings die away."""
    for seed in range(12):
        rng = random.Random(seed)
        row = [
            Ball(
                (40 * i + rng.uniform(-5, 5), rng.uniform(-15, 15)),
                mass=10 ** rng.uniform(-1, 1),
                vel=(rng.uniform(-90, 90), rng.uniform(-90, 90)),
            )
            for i in range(rng.choice((3, 4, 6)))
        ]
        pairs = [(i, i + 1) for i in range(len(row) - 1)]
        rods = [pair for pair in pairs if (pair[0] + seed) % 2]
        springs = [
            Spring(a, b, stiffness, 0.0, math.dist(row[a].pos, row[b].pos))
            for a, b in pairs
            if (a, b) not in rods
        ]
        engine = Stable(Scene(row, ("Rods", "Springs"), rods, springs, gravity=(0, 0)))
        engine.world.step(1e-9)
        start = whole_energy(engine.world)
        assert max(watch(engine, 2, partial(whole_energy, engine.world))) < 1.1 * start


# ---------------------------------------------------------------- velocities at the positions


@pytest.mark.parametrize("substeps", [1, 4])
def test_velocities_belong_to_the_time_of_the_positions(substeps):
    """On a spring, on a rod, and in flight, kinetic and other energy add up in each step."""
    bodies = [Ball((0, 0), 4, mass=0), Ball((100, 0)), Ball((400, 0), vel=(50, -300))]
    bodies += [Ball((800, 0), 4, mass=0), Ball((900, 0))]
    spring = Spring(0, 1, 60.0, 0.0, 80.0)
    engine = Stable(Scene(bodies, ("Rods", "Springs"), [(3, 4)], [spring]), substeps)
    start, scale = energy(engine), 100 * G
    for now in watch(engine, 3, lambda: energy(engine)):
        assert now == pytest.approx(start, abs=4e-4 * scale)


@pytest.mark.parametrize("rods", [[], [(1, 2)]])
@pytest.mark.parametrize("stiffness", [1e2, 1e4, 1e6])
def test_balls_on_springs_and_rods_fall_like_any_other(stiffness, rods):
    """All bodies fall alike, and read the same speed meanwhile."""
    bodies = [Ball((0, 0)), Ball((0, 50), mass=3.0), Ball((0, 100)), Ball((50, 30))]
    spring = Spring(0, 1, stiffness, 0.0, 50.0)
    engine = Stable(Scene(bodies, ("Rods", "Springs"), rods, [spring]))
    run(engine, 1)
    *molecule, alone = (engine.read(i) for i in range(4))
    for ball, start in zip(molecule, (0, 50, 100), strict=True):
        assert ball.y - start == pytest.approx(alone.y - 30, abs=1e-6)
        assert ball.vy == pytest.approx(alone.vy, abs=1e-6)


@pytest.mark.parametrize("effects", [("Contacts",), ("Contacts", "Bounce"), TOUCH])
def test_a_ball_that_a_spring_presses_on_the_floor_reads_as_at_rest(effects):
    bodies = [Block((0, 20), (100, 20)), Ball((0, -10)), Ball((0, -110), 4, mass=0)]
    scene = Scene(bodies, (*effects, "Springs"), springs=[Spring(1, 2, 200.0, 5.0, 130.0)])
    engine = Stable(scene)
    run(engine, 1)
    (ball,) = balls(engine.world)
    assert max(watch(engine, 1, lambda: ball.vel.length())) < 0.1


def test_what_hangs_still_reads_as_still():
    bodies = [Ball((0, 0), 4, mass=0), Ball((0, 100 + G / 100)), Ball((0, 300))]
    scene = Scene(bodies, ("Rods", "Springs"), springs=[Spring(0, 1, 100.0, 0.0, 100.0)])
    scene.bodies.append(Ball((0, 200), 4, mass=0))
    scene.rods.append((3, 2))
    engine = Stable(scene)
    assert max(watch(engine, 2, lambda: max(b.vel.length() for b in balls(engine.world)))) < 1e-6


@pytest.mark.parametrize("near", [1.0, 8.0, 19.0])
@pytest.mark.parametrize("effects", [("Contacts",), TOUCH])
@pytest.mark.parametrize("mass", [1.0, 0.0])
def test_dumbbells_put_into_each_other_part_as_a_whole(near, effects, mass):
    """Their rods keep their lengths. With `mass` 0, one of them hangs on a static body."""
    bodies = [Ball((0, 0)), Ball((0, 60), mass=mass), Ball((near, 0)), Ball((near + 70, -5))]
    engine = Stable(Scene(bodies, (*effects, "Rods"), [(0, 1), (2, 3)], gravity=(0, 0)))
    assert max(watch(engine, 2, lambda: worst_stretch(engine))) < 1e-6 * 60
    one, _, other, _ = (engine.read(i) for i in range(4))
    assert math.dist((one.x, one.y), (other.x, other.y)) > 20 - 0.01
