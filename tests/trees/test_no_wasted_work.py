"""Test by counting calls that a step does no work for features that a scene lacks."""

import random
import sys
from collections import Counter
from itertools import pairwise

import pytest
from probes import still_world

from mini_engine import ITERATIONS, STEP, Body, Box, Circle, DistanceJoint, make_world


def calls_in_step(world):
    """Count the calls of each function of the engine in one step, as "module.function"."""
    calls = Counter()

    def record(frame, event, _argument):
        package, _, module = frame.f_globals["__name__"].partition(".")
        if event == "call" and package == "mini_engine":
            calls[f"{module}.{frame.f_code.co_qualname}"] += 1

    before = sys.getprofile()
    sys.setprofile(record)
    try:
        world.step(STEP)
    finally:
        sys.setprofile(before)
    return calls


def modules(calls):
    return {name.partition(".")[0] for name in calls}


def falling_balls(count, **options):
    """Make a world of balls in the air, far from each other."""
    world = still_world(gravity=(0, 980), **options)
    for i in range(count):
        world.add(Body(Circle(10), (100 * i, 0), mass=1))
    return world


def with_rods(world, count):
    for a, b in list(pairwise(world.moving_bodies()))[:count]:
        world.joints.append(DistanceJoint(a, b))
    return world


def with_floor(world, ball_friction=0.6, floor_friction=0.6):
    """Add a floor that every ball of falling_balls is pressed into."""
    world.add(Body(Box((1e4, 10)), (0, 19), friction=floor_friction))
    for body in world.moving_bodies():
        body.friction = ball_friction
    return world


def test_the_lab_scene_needs_everything():
    world = make_world(random.Random(12))
    for _ in range(120):
        world.step(STEP)
    calls = calls_in_step(world)
    assert {"contacts", "joints", "solver", "world"} <= modules(calls)
    assert calls["solver.solve_friction"] == calls["solver.solve_normal"]
    assert calls["solver.solve_normal"] == ITERATIONS * len(world.contacts) > 0
    assert calls["world.World.apply_damping"] == 1


def test_without_joints_nothing_of_the_joints_runs():
    world = with_floor(falling_balls(3))
    assert "joints" not in modules(calls_in_step(world))
    assert "joints" in modules(calls_in_step(with_rods(world, 1)))


def test_without_contacts_nothing_of_the_solver_runs():
    world = with_rods(falling_balls(3), 1)
    assert "solver" not in modules(calls_in_step(world))
    assert "solver" in modules(calls_in_step(with_floor(world)))


@pytest.mark.parametrize(
    ("ball", "floor", "passes"), [(0.6, 0.6, ITERATIONS), (0, 0.6, 0), (0.6, 0, 0), (0, 0, 0)]
)
def test_without_friction_on_either_side_no_friction_is_solved(ball, floor, passes):
    calls = calls_in_step(with_floor(falling_balls(1), ball, floor))
    assert calls["solver.solve_normal"] == ITERATIONS
    assert calls["solver.solve_friction"] == calls["solver.friction_limit"] == passes


@pytest.mark.parametrize(("linear", "angular", "times"), [(0, 0, 0), (1, 0, 1), (0, 1, 1)])
def test_without_damping_nothing_is_damped(linear, angular, times):
    world = falling_balls(3, linear_damping=linear, angular_damping=angular)
    assert calls_in_step(world)["world.World.apply_damping"] == times


def test_static_bodies_are_never_tested_against_each_other():
    world = still_world()
    for i in range(5):
        world.add(Body(Circle(10), (i, 0)))
    assert calls_in_step(world)["contacts.collide"] == 0
    world.add(Body(Circle(10), (0, 0), mass=1))
    assert calls_in_step(world)["contacts.collide"] == 5


@pytest.mark.parametrize("rods", [1, 3])
@pytest.mark.parametrize("balls", [5, 50])
def test_rods_cost_by_their_own_number_and_not_by_that_of_the_bodies(rods, balls):
    calls = calls_in_step(with_rods(falling_balls(balls), rods))
    assert calls["joints.DistanceJoint.prepare"] == rods
    assert calls["joints.DistanceJoint.solve"] == rods * ITERATIONS
    assert (
        calls["validate.require"] == 1
    )  # checks of dt; a valid body needs no check of each number
