"""Test by tracing that a scene pays only for the effects it declares."""

import os
import random
import subprocess
import sys
from dataclasses import replace
from itertools import product
from pathlib import Path

import pytest
from samples import sample
from worlds_for_tests import (
    all_but,
    balls,
    build,
    build_playground,
    flying,
    lying,
    make,
    state,
)

import stable_engine
from experiments.measures import run, watch
from experiments.opcodes import count_calls, count_opcodes, files_run
from experiments.scenes import BOUNCE, DT, EFFECTS, NEED_CONTACTS, Ball, Scene, Spring, pile
from stable_engine import Body, Circle, Contacts, Rod, World, piles

HERE = Path(__file__).parent
FILES = {name: {f"{name.lower()}.py"} for name in EFFECTS}
FILES["Contacts"] |= {"contact.py", "broad_phase.py", "sweep.py"}
FILES["Bounce"] |= {"impacts.py"}


# ---------------------------------------------------------------- undeclared


@pytest.mark.parametrize("effect", EFFECTS)
def test_the_playground_uses_every_effect_it_declares(effect):
    world = build_playground(EFFECTS)
    assert files_run(lambda: run(world, 0.5)) >= FILES[effect]


@pytest.mark.parametrize("effect", EFFECTS)
def test_no_function_of_an_undeclared_effect_runs(effect):
    files = files_run(lambda: run(build_playground(all_but(effect)), 0.5))
    assert "world.py" in files
    assert not files & FILES[effect]


@pytest.mark.parametrize("effect", sample(EFFECTS, 4))
def test_an_undeclared_effect_may_be_missing_and_costs_no_opcode(effect):
    available, unavailable = opcodes_without(effect), opcodes_without(effect, "unavailable")
    assert available == unavailable > 10_000


def opcodes_without(*arguments):
    """Return the output of without_effect_for_tests.py in its own process."""
    path = os.pathsep.join([str(HERE), str(Path(stable_engine.__file__).parents[1])])
    program = [sys.executable, str(HERE / "without_effect_for_tests.py"), *arguments]
    env = os.environ | {"PYTHONPATH": path}
    return int(subprocess.run(program, env=env, check=True, capture_output=True).stdout)


# ---------------------------------------------------------------- declared


@pytest.mark.parametrize("effect", ["Springs", "Rods", "Friction", "Bounce", "Bullets"])
def test_a_declared_effect_without_users_costs_a_constant(effect):
    """Without gravity nothing else changes a velocity."""
    for scene, base in product((flying, floating), ("Contacts", "Damping")):
        if base == "Contacts" or effect in ("Springs", "Rods"):
            few, many = (price_of(effect, scene(count), base) for count in (10, 100))
            assert few == many < 600


def floating(count):
    return replace(flying(count), gravity=(0, 0))


def price_of(effect, scene, base):
    """Return the additional opcodes of a step when the effect is declared beside another."""
    with_it = build(scene, base, effect)
    without = build(scene, base)
    return opcodes_of_a_step(with_it) - opcodes_of_a_step(without)


def opcodes_of_a_step(world, files=None):
    """Return the cost of the second of two steps in these files, or in all."""
    world.step(DT)
    counts = count_opcodes(lambda: world.step(DT))
    return sum(counts[name] for name in files or counts)


def rods(count, others):
    scene = flying(2 * count + others)
    scene.rods = [(2 * i, 2 * i + 1) for i in range(count)]
    return scene


def springs(count, others):
    scene = flying(2 * count + others)
    scene.springs = [Spring(2 * i, 2 * i + 1, 10.0, length=100) for i in range(count)]
    return scene


def bullets(count, others):
    return flying(count + others, bullets=count)


@pytest.mark.parametrize(
    ("scene", "effects", "files"),
    [
        (rods, ["Rods"], {"rods.py", "joint.py", "row.py"}),
        (springs, ["Springs"], {"springs.py", "joint.py", "row.py"}),
        (bullets, ["Contacts", "Bullets"], {"bullets.py"}),
        (lying, ["Contacts", "Friction"], {"friction.py"}),
        (lying, ["Contacts", "Bounce"], {"bounce.py", "impacts.py"}),
    ],
    ids=["Rods", "Springs", "Bullets", "Friction", "Bounce"],
)
def test_an_effect_costs_in_proportion_to_its_users_alone(scene, effects, files):
    def price(users, others):
        return opcodes_of_a_step(build(scene(users, others), *effects), files)

    assert price(5, 0) == price(5, 50), "bodies that do not use it cost something"
    assert price(15, 0) - price(10, 0) == price(10, 0) - price(5, 0) > 0


@pytest.mark.parametrize("effects", [["Contacts", "Friction", "Sleep"], ["Damping", "Sleep"]])
def test_the_sleeping_cost_nothing(effects):
    prices = []
    for count in (5, 50):
        scene = lying(count, still=0)
        scene.gravity = scene.gravity if "Contacts" in effects else (0, 0)
        world = build(scene, *effects)
        run(world, 2)
        assert all(body.asleep for body in world.bodies[1:])
        prices.append(opcodes_of_a_step(world))
    assert prices[0] == prices[1] < 100


@pytest.mark.parametrize("gravity", [0, 980])
@pytest.mark.parametrize("speed", [0, 30, 600])
def test_contacts_cost_little_between_distant_bodies(speed, gravity):
    """The balls fly away from each other, and none has to be looked at with another."""
    places = [(i % 10 - 4.5, i // 10 - 4.5) for i in range(100)]
    balls = [Ball((900 * x, 900 * y), vel=(speed * x / 5, speed * y / 5)) for x, y in places]

    def price(*effects):
        world = build(Scene(balls, effects, gravity=(0, gravity)))
        run(world, 3 * DT)
        return sum(count_opcodes(lambda: run(world, 300 * DT)).values())

    contacts = price("Contacts")
    assert contacts < 1.2 * price()
    if speed:
        assert price("Contacts", "Sleep") < 1.02 * contacts, "nothing sleeps"


@pytest.mark.parametrize("speed", [50, 400])
def test_contacts_cost_little_between_balls_that_do_not_meet(speed):
    """They fly at random, and no two come near each other in half a second."""
    rng = random.Random(5)
    balls = [
        Ball((1000 * i, 1000 * j), vel=(rng.uniform(-speed, speed), rng.uniform(-speed, speed)))
        for i, j in product(range(10), repeat=2)
    ]

    def price(*effects):
        world = build(Scene(balls, effects, gravity=(0, 0)))
        run(world, 3 * DT)
        return sum(count_opcodes(lambda: run(world, 60 * DT)).values())

    assert price("Contacts") < 1.2 * price()


@pytest.mark.parametrize("gravity", [0, 980])
@pytest.mark.parametrize("tie", [Rod, stable_engine.Spring, None])
def test_contacts_cost_little_beside_one_tied_or_steered_ball(tie, gravity):
    rng = random.Random(5)
    ties = [] if tie is None else [tie]

    def price(*effects):
        world = build(Scene([], (*effects, "Rods", "Springs"), gravity=(0, gravity)))
        for i, j in product(range(10), repeat=2):
            ball = world.add(Body(Circle(10), (100 * i, 100 * j), 1.0))
            ball.vel = rng.uniform(-30, 30), rng.uniform(-30, 30)
        ends = [world.add(Body(Circle(10), (x, -500), 1.0)) for x in (0, 100)]
        for one in ties:
            world.add(one(*ends) if one is Rod else one(*ends, 100))
        world.check()
        run(world, 3 * DT)
        total = 0
        for _ in range(60):
            ends[1].vel += (0, 1)
            total += sum(count_opcodes(lambda: world.step(DT)).values())
        return total

    assert price("Contacts") < 1.2 * price()


@pytest.mark.parametrize("count", [10, 40])
@pytest.mark.parametrize("effects", [[], ["Contacts"], ["Damping"], BOUNCE])
def test_sleep_costs_little_where_nothing_sleeps(count, effects):
    scene = flying(count)

    def price(*effects):
        world = build(scene, *effects)
        run(world, 64 * DT)
        assert not world.anybody_sleeps()
        return sum(count_opcodes(lambda: run(world, 64 * DT)).values())

    assert price(*effects, "Sleep") < 1.02 * price(*effects)


def test_a_fall_has_no_substeps():
    def price(substeps):
        world = World((0, 980), substeps, [Contacts()])
        for i in range(10):
            world.add(Body(Circle(10), (100 * i, 0), 1.0))
        run(world, 3 * DT)
        return opcodes_of_a_step(world)

    assert price(1) == price(8)


def test_a_tall_silo_costs_no_more_than_a_wide_bin():
    def price(across, down):
        """Return the broad phase's opcodes in the first step of 60 balls, one diameter apart."""
        balls = [Ball((40 * i * across, 40 * i * down)) for i in range(60)]
        world = build(Scene(balls, gravity=(0, 0)), "Contacts")
        return count_opcodes(lambda: world.step(DT))["broad_phase.py"]

    assert price(0, 1) == pytest.approx(price(1, 0), rel=0.2)
    assert price(0.02, 1) < 2 * price(1, 0)


def test_rods_under_a_pile_cost_no_search_for_what_works_against_them():
    """The balls on them overlap as far as their load explains."""
    world = build(pile(80, 104.0), "Contacts", "Friction", "Rods", substeps=1)
    run(world, 4, 1 / 60)
    low = sorted(balls(world), key=lambda ball: -ball.y)[:20]
    for a, b in zip(low, low[10:], strict=False):
        world.add(Rod(a, b))
    run(world, 1, 1 / 60)
    tied = [c for ball in low for c in world.effects["Contacts"].of_body(ball)]
    assert max(-c.gap for c in tied) > 0.1 * low[0].r
    done = count_calls(lambda: run(world, 0.1, 1 / 60), [("searches", piles.collect_piles, 1)])
    assert done["searches"] == 0


# ---------------------------------------------------------------- dependencies


def test_a_rod_or_spring_without_its_effect_is_an_error():
    for effect, joint in (("Rods", Rod), ("Springs", lambda a, b: stable_engine.Spring(a, b, 1.0))):
        world = World()
        a, b = (world.add(Body(Circle(1), (x, 0), 1.0)) for x in (0, 9))
        with pytest.raises(ValueError, match=rf"needs {effect}\(\).*World\(effects="):
            world.add(joint(a, b))


def test_a_bullet_without_its_effect_is_an_error():
    world = World(effects=[Contacts()])
    with pytest.raises(ValueError, match=r"needs Bullets\(\).*World\(effects="):
        world.add(Body(Circle(1), (0, 0), 1.0, bullet=True))
    assert world.bodies == []


@pytest.mark.parametrize("effect", NEED_CONTACTS)
def test_an_effect_on_contacts_without_contacts_is_an_error(effect):
    with pytest.raises(ValueError, match=rf"{effect} needs Contacts\(\)"):
        World(effects=make([effect]))


def test_effects_may_be_declared_in_any_order():
    there, back = build_playground(EFFECTS), build_playground(EFFECTS[::-1])
    run(there, 1)
    run(back, 1)
    assert state(there) == state(back)


def test_a_scene_without_effects_falls_freely():
    world = build(Scene(flying(1).bodies, effects=()))
    ball = world.bodies[0]
    steps = watch(world, 1, lambda: ball.y)
    seconds = len(steps) * DT
    assert ball.y == pytest.approx(980 * seconds**2 / 2, rel=1e-12)
    assert ball.vy == pytest.approx(980 * seconds, rel=1e-12)
