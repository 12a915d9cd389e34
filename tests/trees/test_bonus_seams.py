"""Test that the engine does not depend on bonus tasks, which change nothing by default."""

import ast
import random
import re

import pygame
import pytest
from programs import SOLUTION, STARTER
from pygame import Vector2

from mini_engine import (
    STEP,
    Body,
    BonusWindow,
    BonusWorld,
    Box,
    Circle,
    DistanceJoint,
    SpringJoint,
    Window,
    World,
    make_world,
)
from mini_engine.bonus.sleeping import fall_asleep
from mini_engine.bonus.world import with_bonus

CORE = sorted((SOLUTION / "mini_engine").glob("*.py"))
PASSES_ON = {"__init__.py", "__main__.py"}  # the package's entry points import both


# ---------------------------------------------------------------- imports


@pytest.mark.parametrize("path", CORE, ids=[path.name for path in CORE])
def test_no_file_of_the_engine_knows_the_bonus_tasks(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    sources = [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    knows = any("bonus" in source for source in sources)
    assert knows == (path.name == "__init__.py")
    if path.name not in PASSES_ON:
        words = "bonus|sleep|spring|grid|heav"
        assert not re.search(words, path.read_text(encoding="utf-8"))


def test_the_engine_can_be_read_in_an_hour():
    lines = {path.name: len(path.read_text(encoding="utf-8").splitlines()) for path in CORE}
    assert sum(lines.values()) <= 600
    assert len(list((STARTER / "mini_engine").rglob("*.py"))) <= 20


# ---------------------------------------------------------------- defaults


def bits(world):
    """Return every number of every body, to the last bit."""
    return [
        number.hex()
        for body in world.bodies
        for number in (*body.pos, *body.vel, body.angle, body.omega)
    ]


@pytest.mark.parametrize("grid", [False, True])
def test_a_world_without_bonus_tasks_or_with_a_grid_is_the_plain_one_to_the_last_bit(grid):
    plain, more = (make_world(random.Random(12)) for _ in range(2))
    more = with_bonus(more)
    more.grid = grid
    for _ in range(360):
        plain.step(STEP)
        more.step(STEP)
    assert bits(plain) == bits(more)
    assert sorted(c.jn for c in plain.contacts) == sorted(c.jn for c in more.contacts) != []


# ---------------------------------------------------------------- sleepers


def room(*bodies):
    """Make a world of these bodies without gravity and damping."""
    world = BonusWorld((0, 0), 0, 0)
    for body in bodies:
        world.add(body)
    return world


def ball(x, y=0.0, vel=(0, 0), mass=1.0):
    body = Body(Circle(10), (x, y), mass, friction=0.5, restitution=0.4)
    body.vel = Vector2(vel)
    return body


def test_a_sleeper_keeps_its_mass_and_does_not_move():
    sleeper = ball(0)
    world = room(sleeper)
    world.gravity = Vector2(0, 980)
    fall_asleep(sleeper, [])
    world.step(STEP)
    assert (sleeper.inv_mass, sleeper.inv_inertia, sleeper.is_static) == (1, 1 / 50, False)
    assert (*sleeper.pos, *sleeper.vel) == (0, 0, 0, 0)
    assert world.moving_bodies() == []


def test_a_sleeper_is_met_as_a_static_body_is_and_named_in_the_contact():
    """The slow ball wakes no body."""
    sleeper, comer = ball(0), ball(-19.5, 2.0, (40, 0))
    static, twin = ball(0, mass=0.0), ball(-19.5, 2.0, (40, 0))
    worlds = room(sleeper, comer), room(static, twin)
    fall_asleep(sleeper, [])
    for world in worlds:
        world.step(STEP)
    assert bits(worlds[0]) == bits(worlds[1])
    (contact,) = worlds[0].contacts
    assert {contact.a, contact.b} == {sleeper, comer} and contact.jn > 0


@pytest.mark.parametrize("kind", ["rod", "spring"])
def test_rods_and_springs_do_not_move_a_sleeper(kind):
    sleeper, other = ball(0), ball(100)
    world = room(sleeper, other)
    if kind == "rod":
        world.joints.append(DistanceJoint(sleeper, other))
    else:
        world.springs.append(SpringJoint(sleeper, other, 50, 1, length=60))
    fall_asleep(sleeper, [])
    other.vel = Vector2(30, 30)
    for _ in range(10):
        world.step(STEP)
    assert (*sleeper.pos, *sleeper.vel) == (0, 0, 0, 0)
    assert other.vel.x < 30


def test_between_sleepers_and_static_bodies_no_contact_is_looked_for():
    sleepers, floor = [ball(0), ball(19)], Body(Box((50, 10)), (0, 19))
    world = room(*sleepers, floor)
    assert len(world.find_contacts()) == 3
    for sleeper in sleepers:
        fall_asleep(sleeper, [])
    assert world.find_contacts() == []
    world.add(ball(-19))
    assert len(world.find_contacts()) == 2


# ---------------------------------------------------------------- the window


def test_the_window_does_what_its_keys_say():
    window = BonusWindow()
    world, bodies = window.world, len(window.world.bodies)
    for key in (pygame.K_s, pygame.K_g, pygame.K_k):
        window.press(key)
    assert (world.sleeping, world.grid, len(world.springs)) == (True, True, 1)
    assert len(world.bodies) == bodies + 2
    sleeper = world.moving_bodies()[-1]
    fall_asleep(sleeper, [])
    assert ((310, 10), "asleep: 1") in window.texts()
    window.draw()
    beside_the_spoke = sleeper.pos + Vector2(-5, 9)
    assert window.screen.get_at(tuple(map(int, beside_the_spoke)))[:3] == (120, 120, 120)
    window.press(pygame.K_s)
    assert (world.sleeping, sleeper.asleep) == (False, False)
    window.press(pygame.K_r)
    assert len(window.world.bodies) == bodies
    assert (window.world.sleeping, window.world.grid, window.world.springs) == (False, False, [])


def test_a_body_is_drawn_between_its_last_two_places():
    window = BonusWindow()
    (bob, *_) = window.world.moving_bodies()
    window.world.step(STEP)
    before = Vector2(bob.before[0])
    window.accumulator = 0.25 * STEP
    assert window.place(bob)[0] == before + (bob.pos - before) * 0.25
    assert Window.place(window, bob) == (bob.pos, bob.angle)


def test_a_plain_world_and_its_bodies_carry_nothing_for_bonus_tasks():
    world, more = make_world(random.Random(12)), BonusWorld()
    extra = set(vars(more)) - set(vars(World()))
    assert extra == {"springs", "sleeping", "grid"}
    assert not {"before", "asleep", "still_for", "support"} & set(vars(world.bodies[-1]))
