"""The hard cases: what must hold for the stable engine.

The rows of experiments.hard_cases come first: they hold the thresholds. The tests below go further
than a row does. h = 1/480 s unless a test says else.
"""

import math
from itertools import product

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from worlds_for_tests import build, dumbbell

from experiments import trials
from experiments.battery import Bench, Case, holds, run_case
from experiments.engines import Stable
from experiments.hard_cases import BULLET_SPEEDS, CASES
from experiments.measures import deepest_overlap, energy, run, speed, top_speed, watch
from experiments.scenes import (
    BULLETS,
    DT,
    Ball,
    Block,
    G,
    Scene,
    Spring,
    chain,
    closed_box,
    coincident,
    cradle,
    drop,
    inside_ledge,
    near_miss,
    on_floor,
    oscillator,
    overlapping,
    rammer,
    resting,
    seams,
    shot,
    slide,
    stack,
    tower,
)
from experiments.steps import PATTERNS, hiccups, in_turns, lasting
from stable_engine.soft import Pace

H = DT / 4  # s

# ---------------------------------------------------------------- the table's rows


def must_hold(case):
    cells = run_case(case, "stable")
    for figure, cell in zip(case.figures, cells, strict=True):
        assert holds(figure, cell), f"{figure.words}: {cell}, not {figure.rule} {figure.limit}"


LONG = ("wild boxes", "closed boxes", "pile of 200", "tower of 20")  # in the titles
QUICK = [
    pytest.param(case, marks=() if case.quick and not is_long else pytest.mark.soak)
    for case in (case.at("quick") for case in CASES)
    for is_long in [any(map(case.title.__contains__, LONG))]
]


@pytest.mark.parametrize("case", QUICK, ids=lambda case: case.title)
def test_a_hard_case_holds(case):
    must_hold(case)


LONGER = [case.at("soak") for case in CASES if case.longer]


@pytest.mark.soak
@pytest.mark.parametrize("case", LONGER, ids=lambda case: case.title)
def test_a_hard_case_holds_for_long(case):
    must_hold(case)


# ---------------------------------------------------------------- stacks and bad starts


@pytest.mark.parametrize("masses", [(1, 10, 100, 1000), (1, 3, 9, 27, 81, 243), (100, 1, 100)])
def test_a_stack_that_grows_heavier_upwards_is_never_launched(masses):
    engine = Stable(stack(*masses))
    top = engine.bodies[-1]
    start = top.y
    assert max(watch(engine, 10, lambda: start - top.y)) <= 0
    assert top_speed(engine) < 1


@pytest.mark.parametrize("mass", [1, 100])
@pytest.mark.parametrize("by", [8, 30])
def test_overlapping_balls_part(by, mass):
    engine = Stable(overlapping(by, mass))
    assert max(watch(engine, 2, lambda: top_speed(engine))) < 1
    assert deepest_overlap(engine) < 0.001


@pytest.mark.parametrize("count", [2, 3, 30])
def test_any_number_of_balls_with_one_centre_part(count):
    engine = Stable(coincident(count))
    run(engine, 2)
    assert deepest_overlap(engine) < 0.001


def test_a_ball_inside_a_box_leaves_through_the_nearest_face():
    for pos, way in (((149, -5), (1, 0)), ((0, 9), (0, 1)), ((0, -9), (0, -1))):
        engine = Stable(inside_ledge(pos))
        run(engine, 2)
        ball = engine.bodies[1]
        assert (ball.x - pos[0]) * way[0] + (ball.y - pos[1]) * way[1] > 0
        assert abs((ball.x - pos[0]) * way[1] + (ball.y - pos[1]) * way[0]) < 1e-9


def test_a_normal_that_turned_takes_no_impulse_along():
    world = build(Scene([Block((0, 50), (50, 50)), Ball((0, -10))]))
    run(world, 1)
    (contact,) = world.effects["Contacts"].touching
    assert contact.jn > 0
    world.bodies[1].pos = (59.99, 50)
    world.effects["Contacts"].detect(H)
    assert contact.normal.x == pytest.approx(-1)
    assert (contact.jn, contact.jt) == (0, 0)


# ---------------------------------------------------------------- steps that vary


@pytest.mark.parametrize("scene", [tower(20), stack(1, 100), stack(1, 10, 100)])
@pytest.mark.parametrize("steps", [*PATTERNS.values(), lambda: in_turns(1 / 30, 1 / 1000, 60)])
def test_nothing_is_launched_by_a_change_of_step(scene, steps):
    engine = Stable(scene)
    moving = engine.bodies[3:]
    starts = [ball.y for ball in moving]
    for dt in lasting(2, steps()):
        engine.step(dt)
        assert max(y - ball.y for ball, y in zip(moving, starts, strict=True)) < 0.5


@pytest.mark.parametrize("scene", [chain(10, bob=100.0), chain(20)])
@pytest.mark.parametrize("steps", [lambda: hiccups(1 / 240, 300, 0.05), in_turns])
def test_a_chain_gains_no_energy_by_a_change_of_step(scene, steps):
    engine = Stable(scene)
    start = energy(engine, DT)
    for dt in lasting(4, steps()):
        engine.step(dt)
        assert energy(engine, dt) < start + 1e-6 * abs(start)


def test_equal_steps_are_as_stiff_as_they_can_be():
    pace = Pace(0.1)
    assert [pace.follow(H) for _ in range(3)] == [H, H, H]
    assert [pace.follow(h) for h in (2 * H, H, H)] == pytest.approx([2 * H, 1.9 * H, 1.8 * H])


# ---------------------------------------------------------------- closed boxes

BOXES = st.builds(
    closed_box,
    seed=st.integers(0, 2**32),
    half=st.floats(80, 150),
    radii=st.tuples(st.floats(5, 8), st.floats(12, 24)),
    fast=st.floats(0, 600),
    pairs=st.integers(0, 8),
)
QUIETLY = {
    "deadline": None,
    "database": None,
    "derandomize": True,
    "suppress_health_check": list(HealthCheck),
}


def leaks(scene, seconds):
    """Whether a ball gets out after any step. Never NaN: the step raises at that."""
    case = Case("a closed box", [lambda: scene], trials.escape, [], seconds)
    return trials.escape(Bench(case, "stable"), scene)["escapes"] > 0


@settings(max_examples=3, **QUIETLY)
@given(scene=BOXES)
def test_nobody_escapes_from_a_closed_box(scene):
    assert not leaks(scene, 2)


@pytest.mark.soak
@settings(max_examples=400, **QUIETLY)
@given(scene=BOXES)
def test_none_of_400_made_up_closed_boxes_leaks(scene):
    assert not leaks(scene, 4)


@pytest.mark.parametrize("steps", PATTERNS.values())
@pytest.mark.parametrize("mass", [100, 1000])
def test_a_rammer_does_not_get_through_a_wall_in_steps_that_vary(mass, steps):
    for fast, degrees, start in product((300, 600, 900), (0, 6, 34), (50, 55)):
        engine = Stable(rammer(mass, fast, degrees, start))
        for dt in lasting(0.5, steps()):
            engine.step(dt)
        assert max(engine.bodies[1].x, engine.bodies[2].x) < 0


@pytest.mark.parametrize("restitution", [0.0, 0.3, 1.0])
def test_a_rod_does_not_press_a_ball_that_bounces_into_the_wall(restitution):
    engine = Stable(rammer(100, 600, restitution=restitution))
    light = engine.bodies[1]
    assert max(watch(engine, 1, lambda: light.x)) < 0


def test_a_ball_pressed_beyond_the_middle_of_a_box_leaves_the_way_it_came():
    world = build(Scene([Block((0, 2), (100, 2)), Ball((0, -10))], gravity=(0, 0)))
    ball = world.bodies[1]
    world.step(DT)
    ball.pos = (0, 3)
    run(world, 1)
    assert ball.y == pytest.approx(-10, abs=0.01)


@pytest.mark.parametrize("substeps", [1, 2, 4])
@pytest.mark.parametrize("thick", [1, 4, 20, 100])
def test_a_ball_that_is_pressed_into_a_static_body_never_goes_through_it(thick, substeps):
    """No flight of its core begins outside of the body, so no sweep finds that it got in."""
    ledge, disc = Block((0, thick / 2), (1000, thick / 2)), Ball((0, thick / 2), thick / 2, mass=0)
    depths, speeds, steps = (0.25, 0.5, 0.9), (0, 3000, 100_000), (1 / 1000, 1 / 60, 1 / 20)
    for wall, depth, fast, dt in product((ledge, disc), depths, speeds, steps):
        ball = Ball((0, -10 + 10 * depth), 10, vel=(0, fast))
        scene = Scene([wall, ball], springs=[Spring(1, 0, 1e6, length=0)], gravity=(0, 0))
        world = build(scene, "Contacts", "Springs", substeps=substeps)
        for _ in range(10):
            world.step(dt)
            assert world.bodies[1].y < 0


# ---------------------------------------------------------------- fast bodies


@pytest.mark.parametrize("effects", [BULLETS, ("Contacts", "Bullets")])
@pytest.mark.parametrize("restitution", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("fast", BULLET_SPEEDS)
def test_a_bullet_never_gets_into_a_thin_ledge(fast, restitution, effects):
    for radius, thick in ((10, 20), (3, 2)):
        for start in range(100, 160, 7):
            world = build(shot(fast, start, restitution, radius, thick), *effects)
            bullet = world.bodies[1]
            assert max(watch(world, 0.3, lambda body=bullet: body.y)) < 0


@pytest.mark.parametrize("restitution", [0.0, 1.0])
@pytest.mark.parametrize("fast", BULLET_SPEEDS[:-1])
def test_the_core_of_any_ball_stays_out_of_a_thin_ledge(fast, restitution):
    for radius, thick in ((10, 20), (3, 2)):
        for start in range(100, 160, 7):
            engine = Stable(shot(fast, start, restitution, radius, thick, bullet=False))
            ball = engine.bodies[1]
            assert max(watch(engine, 0.3, lambda body=ball: body.y)) < 0


@pytest.mark.parametrize("bullet", [True, False])
@pytest.mark.parametrize("height", [1000, 20_000])
def test_a_fast_ball_that_is_stopped_at_the_floor_keeps_its_energy(height, bullet):
    scene = drop(height)
    scene.bodies[1].bullet, scene.effects = bullet, BULLETS
    engine = Stable(scene)
    start = energy(engine)
    run(engine, 30)
    assert energy(engine) == pytest.approx(start, rel=1e-9)


@pytest.mark.parametrize("effects", [("Contacts", "Rods"), ("Contacts", "Rods", "Bullets")])
def test_a_ball_on_a_rod_that_overlaps_its_peg_is_not_stopped_by_it(effects):
    bob = Ball((15.5, 0), vel=(0, 1500), bullet=True)
    world = build(Scene([Ball((0, 0), mass=0), bob], effects, [(0, 1)], gravity=(0, 0)))
    run(world, 1)
    assert speed(world.bodies[1]) == pytest.approx(1500, rel=0.05)


@pytest.mark.parametrize("fast", BULLET_SPEEDS)
def test_a_bullet_bounces_as_any_ball_does(fast):
    world = build(shot(fast, 100, restitution=0.5))
    run(world, 0.3)
    assert world.bodies[1].vy == pytest.approx(-0.5 * fast, rel=1e-9)


@pytest.mark.parametrize("effects", [BULLETS, ("Contacts", "Bullets")])
@pytest.mark.parametrize("fast", [100, 300, *BULLET_SPEEDS])
def test_a_near_miss_ends_up_on_its_straight_line(fast, effects):
    for start in range(100, 140, 3):
        world = build(near_miss(fast, start), *effects)
        bullet = world.bodies[1]
        x, y, vx, vy = bullet.x, bullet.y, bullet.vx, bullet.vy
        seconds = math.ceil(300 / fast / DT) * DT
        run(world, seconds)
        assert (bullet.vx, bullet.vy) == (vx, vy)
        assert tuple(bullet.pos) == pytest.approx((x + vx * seconds, y + vy * seconds))


@pytest.mark.parametrize("count", [2, 10])
@pytest.mark.parametrize("gap", [0, 0.05, 0.5, 5])
def test_the_last_ball_of_any_cradle_leaves_with_all_the_speed(gap, count):
    world = build(cradle(gap, count, speed=300))
    run(world, 1)
    exact = [0] * (count - 1) + [300]
    assert [ball.vx for ball in world.bodies] == pytest.approx(exact, abs=1e-9)


# ---------------------------------------------------------------- rolling and sliding


@pytest.mark.parametrize("radius", [2, 50])
def test_a_ball_of_any_size_ends_up_rolling_at_two_thirds_of_its_speed(radius):
    world = build(slide(300, radius))
    ball = world.bodies[1]
    run(world, 1)
    slips = watch(world, 1, lambda: abs(ball.vx - ball.w * radius))
    assert ball.vx == pytest.approx(200, rel=1e-9)
    assert max(slips) < 1e-9 * 200


def test_a_ball_that_spins_backwards_gains_mu_g_t_backwards():
    world = build(on_floor(friction=0.6, omega=-1e4))
    run(world, 1)
    assert world.bodies[1].vx == pytest.approx(-0.6 * G, rel=1e-6)


@pytest.mark.parametrize("fast", [9, 30, 100, 300, 1000, 3000])
def test_a_rolling_ball_does_not_hop_at_a_seam_in_long_steps(fast):
    world = build(seams(fast), substeps=8)
    ball = world.bodies[-1]
    assert max(watch(world, min(3, 3000 / fast), lambda: -10 - ball.y, 2 * DT)) < 0.01


@pytest.mark.parametrize("scene", [resting(far=1e9), resting(0.01), resting(1e5)])
def test_a_ball_far_away_tiny_or_huge_comes_to_rest(scene):
    engine = Stable(scene)
    run(engine, 5)
    assert speed(engine.read(1)) < 1e-3


# ---------------------------------------------------------------- rods and springs


@pytest.mark.parametrize("length", [2, 10, 50])
@pytest.mark.parametrize("fast", [100, 1000, 10_000])
def test_a_dumbbell_gains_no_energy_however_short_and_fast(length, fast):
    engine = Stable(dumbbell(length, fast))
    assert max(watch(engine, 3, lambda: energy(engine))) < 1.1 * fast**2


def test_the_energy_of_a_spring_of_1_hz_swings_around_its_start():
    engine = Stable(oscillator())
    start = energy(engine)
    energies = watch(engine, 60, lambda: energy(engine))
    # semi-implicit Euler: the energy swings by omega h/2 around a constant
    assert energies == pytest.approx([start] * len(energies), rel=2 * math.pi * H / 2 * 1.1)
    assert sum(energies) / len(energies) == pytest.approx(start, rel=1e-3)
