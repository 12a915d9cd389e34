"""Test the solution's engine against the lesson, beyond its own checks."""

import math
import random
import re
from types import ModuleType

import pygame
import pytest
from probes import still_world
from programs import MINI, SOLUTION, probe, run_in
from pygame import Vector2

import mini_engine
from mini_engine import (
    ITERATIONS,
    STEP,
    Body,
    Box,
    Circle,
    DistanceJoint,
    World,
    circle_circle,
    collide,
    cross,
    make_world,
    spin_velocity,
)
from mini_engine.game_loop import BACKGROUND, Window

LOOP = "mini_engine"


def disc(x=0.0, y=0.0, radius=10.0, mass=2.0, vel=(0, 0), omega=0.0, **surface):
    body = Body(Circle(radius), (x, y), mass=mass, **surface)
    body.vel, body.omega = Vector2(vel), omega
    return body


def as_numbers(contact):
    """Return normal, depth and point in one flat tuple."""
    return (*contact.normal, contact.depth, *contact.point)


# ---------------------------------------------------------------- names and numbers


def test_every_public_name_of_the_lesson_can_be_imported():
    names = """cross spin_velocity Circle Box Body Contact circle_circle circle_box collide
        apply_impulse effective_mass DistanceJoint World ball make_world main advance Window"""
    bonus = "update_sleep wake SpringJoint near_pairs between heaviness BonusWorld BonusWindow"
    public = {
        name
        for name, value in vars(mini_engine).items()
        if not (name.startswith("_") or name.isupper() or isinstance(value, ModuleType))
    }
    assert public == {*names.split(), *bonus.split()}


# ---------------------------------------------------------------- vectors and bodies


def test_cross_is_positive_clockwise_on_the_screen():
    right, down = Vector2(2, 0), Vector2(0, 3)
    assert (cross(right, down), cross(down, right), cross(right, right)) == (6, -6, 0)


def test_a_positive_spin_carries_the_right_side_down():
    assert tuple(spin_velocity(2, Vector2(3, 0))) == (0, 6)
    assert tuple(spin_velocity(2, Vector2(3, 4))) == (-8, 6)


def test_a_disc_has_half_the_inertia_of_its_mass_at_the_rim():
    body = Body(Circle(10), (3, 4), mass=4)
    assert (body.inv_mass, body.inv_inertia, body.is_static) == (1 / 4, 1 / 200, False)
    assert (*body.pos, *body.vel, body.angle, body.omega) == (3, 4, 0, 0, 0, 0)
    assert (body.restitution, body.friction) == (0.3, 0.6)


@pytest.mark.parametrize("shape", [Circle(10), Box((10, 20))])
def test_a_body_without_mass_is_static_in_both_ways(shape):
    body = Body(shape, (0, 0))
    assert (body.inv_mass, body.inv_inertia, body.is_static) == (0, 0, True)


def test_a_body_keeps_its_own_copy_of_its_position():
    position = Vector2(3, 4)
    body = Body(Circle(10), position, mass=1)
    body.pos.x = 5
    assert position.x == 3


# ---------------------------------------------------------------- contacts


@pytest.mark.parametrize(
    ("b", "expected"),
    [
        ((25, 0), (1, 0, 5, 10, 0)),
        ((-25, 0), (-1, 0, 5, -10, 0)),
        ((0, 25), (0, 1, 5, 0, 10)),
        ((15, -20), (0.6, -0.8, 5, 6, -8)),
        ((0, 0), (0, 1, 30, 0, 10)),
    ],
)
def test_two_circles_touch_along_the_line_of_their_centres(b, expected):
    one, other = disc(radius=10), disc(*b, radius=20)
    contact = circle_circle(one, other)
    assert as_numbers(contact) == pytest.approx(expected)
    assert (contact.a, contact.b) == (one, other)


@pytest.mark.parametrize("distance", [30, 31])
def test_circles_that_only_touch_or_are_apart_have_no_contact(distance):
    assert circle_circle(disc(radius=10), disc(distance, radius=20)) is None


def test_collide_keeps_the_circle_as_a():
    circle, box = disc(0, -8), Body(Box((30, 20)), (0, 20))
    for contact in (collide(circle, box), collide(box, circle)):
        assert (contact.a, contact.b) == (circle, box)
        assert as_numbers(contact) == (0, 1, 2, 0, 0)


def test_collide_knows_every_pair():
    box = Body(Box((30, 20)), (0, 0))
    contact = collide(disc(), disc(15))
    assert collide(box, Body(Box((30, 20)), (5, 5))) is None
    assert (*as_numbers(contact), contact.jn, contact.jt) == (1, 0, 5, 10, 0, 0, 0)


# ---------------------------------------------------------------- the world and its step


def test_a_world_has_the_lessons_gravity_and_dampings():
    world, body = World(), disc()
    assert (*world.gravity, world.linear_damping, world.angular_damping) == (0, 980, 0.05, 0.3)
    assert (world.bodies, world.joints, world.contacts) == ([], [], [])
    assert world.add(body) is body and world.bodies == [body]


def test_the_solver_passes_over_contacts_then_joints_so_many_times(monkeypatch):
    world, calls = still_world(), []
    one, other = world.add(disc(0, 0)), world.add(disc(15, 0))
    joint = DistanceJoint(one, other)
    world.joints.append(joint)
    monkeypatch.setattr(world, "solve_contact", lambda contact, dt: calls.append("contact"))
    monkeypatch.setattr(joint, "prepare", lambda dt: calls.append("prepare"))
    monkeypatch.setattr(joint, "solve", lambda: calls.append("joint"))
    world.step(STEP)
    assert calls == ["prepare", *(["contact", "joint"] * ITERATIONS)]


# ---------------------------------------------------------------- the program


def test_the_program_runs_without_a_screen_and_prints_its_two_lines():
    printed = run_in(SOLUTION, *MINI, LAB_FRAMES="3")
    assert re.fullmatch(r"Fixed steps: \d+\nPendulum length error: \d\.\d\d px\n", printed)


def test_the_program_counts_its_steps_bodies_and_contacts_and_measures_its_rod():
    played = probe(SOLUTION, "play", LOOP, [50] * 40)
    world = make_world(random.Random(12))
    for _ in range(240):
        world.step(STEP)
    steps, error = played["printed"]
    assert steps == "Fixed steps: 240"
    assert 0 <= float(re.fullmatch(r"Pendulum length error: (\d\.\d\d) px", error)[1]) < 1
    assert played["frames"][-1]["moving"] == [list(body.pos) for body in world.moving_bodies()]
    numbers = re.findall(r"\d+", played["frames"][-1]["text"][0])
    assert list(map(int, numbers)) == [9, len(world.contacts)] and world.contacts


def draw_body(body):
    """Draw a body on an empty surface."""
    window = Window()
    window.screen = pygame.Surface((60, 60))
    window.draw_body(body, body.color)
    return window.screen


def test_the_spoke_turns_with_the_ball():
    one = disc(30, 30, radius=20)
    right, below = [], []
    for one.angle in (0, math.pi / 2):
        screen = draw_body(one)
        right.append(screen.get_at((40, 30))[:3])
        below.append(screen.get_at((30, 40))[:3])
    assert right == [BACKGROUND, one.color]
    assert below == [one.color, BACKGROUND]


def test_static_circles_have_no_spoke():
    peg = Body(Circle(20), (30, 30))
    assert draw_body(peg).get_at((40, 30))[:3] == peg.color
