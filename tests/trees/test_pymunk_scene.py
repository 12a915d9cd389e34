"""Test the solution's pymunk scene against the lesson, beyond its own checks."""

import math
import random

import pygame
import pymunk
import pytest
from programs import SOLUTION, probe

import mini_engine
from pymunk_scene import (
    BACKGROUND,
    GREY,
    MAX_BALLS,
    add_ball,
    add_box,
    draw_shape,
    empty_space,
    make_space,
    stack_stands,
)


@pytest.fixture
def scene():
    return make_space(random.Random(12))


def surface(shape):
    return shape.friction, shape.elasticity


# ---------------------------------------------------------------- numbers


def test_the_static_shapes_are_the_lessons(scene):
    space = scene[0]
    static = space.static_body.shapes
    boxes = {tuple(shape.cache_bb()) for shape in static if isinstance(shape, pymunk.Poly)}
    floor, ledge = (0, 560, 900, 600), (50, 250, 350, 270)  # left, top, right, bottom
    assert boxes == {floor, ledge, (-40, 0, 0, 600), (900, 0, 940, 600)}
    circles = {(*s.offset, s.radius) for s in static if isinstance(s, pymunk.Circle)}
    assert circles == {*((x, 400, 8) for x in (375, 435, 495, 555, 615)), (700, 90, 6)}
    assert {surface(shape) for shape in static} == {(0.6, 0.3)}
    assert {shape.color for shape in static} == {GREY}
    assert len(static) == 10


def test_both_scenes_have_the_same_balls(scene):
    _, *balls = mini_engine.make_world(random.Random(12)).moving_bodies()
    bodies = list(scene[0].bodies)[1:9]
    shapes = [shape for body in bodies for shape in body.shapes]
    assert [(s.radius, s.color) for s in shapes] == [(b.shape.radius, b.color) for b in balls]
    assert [tuple(body.position) for body in bodies] == [tuple(b.pos) for b in balls]
    for body, shape in zip(bodies, shapes, strict=True):
        assert body.mass == pytest.approx(shape.radius**2 / 100)
        assert body.moment == pytest.approx(0.5 * body.mass * shape.radius**2)
        assert surface(shape) == (0.6, 0.4)


def test_the_stack_is_four_boxes_on_the_floor(scene):
    space, stack = scene
    assert [tuple(box.position) for box in stack] == [(760, y) for y in (542, 506, 470, 434)]
    assert list(space.bodies)[9:] == stack
    for box in stack:
        (shape,) = box.shapes
        assert {(abs(x), abs(y)) for x, y in shape.get_vertices()} == {(25, 18)}
        assert box.mass == 1.8
        assert box.moment == pytest.approx(1.8 * (50**2 + 36**2) / 12)
        assert surface(shape) == (0.7, 0.1)


def test_a_box_of_another_size_weighs_by_its_area():
    box = add_box(empty_space(), (100, 100), (20, 30))
    assert (tuple(box.position), box.mass) == ((100, 100), 0.6)
    assert box.moment == pytest.approx(0.6 * (20**2 + 30**2) / 12)


# ---------------------------------------------------------------- motion


@pytest.mark.parametrize(("angle", "stands"), [(0.19, True), (0.2, False), (-0.3, False)])
def test_a_stack_with_one_tilted_box_has_fallen(scene, angle, stands):
    scene[1][2].angle = angle
    assert stack_stands(scene[1]) is stands


# ---------------------------------------------------------------- the program


def test_the_program_counts_its_steps_and_ends_when_its_window_is_closed():
    played = probe(SOLUTION, "play", "pymunk_scene", [17] * 60, [[29, "QUIT", {}]])
    assert len(played["frames"]) == 30
    assert played["printed"] == ["Fixed steps: 61", "Bodies: 13", "Box stack stands: yes"]
    assert "moving bodies: 13" in played["frames"][-1]["text"]


def test_the_window_fills_up_to_max_balls():
    keys = [[0, "KEYDOWN", {"key": pygame.K_b}]] * MAX_BALLS
    clicks = [[1, "MOUSEBUTTONDOWN", {"pos": [300, 200], "button": 1}]]
    frames = probe(SOLUTION, "play", "pymunk_scene", [0, 0], keys + clicks)["frames"]
    assert [len(frame["moving"]) for frame in frames] == [MAX_BALLS] * 2


def test_the_spoke_turns_with_the_ball():
    space = empty_space()
    body = add_ball(space, random.Random(12), (30, 30))
    (shape,) = body.shapes
    right, below = [], []
    for body.angle in (0, math.pi / 2):
        screen = pygame.Surface((60, 60))
        draw_shape(screen, shape)
        right.append(screen.get_at((35, 30))[:3])
        below.append(screen.get_at((30, 35))[:3])
    assert right == [BACKGROUND, shape.color]
    assert below == [shape.color, BACKGROUND]
