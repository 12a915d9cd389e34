"""The pymunk scene of the solution against the lesson: its numbers, its stack, its program."""

import math
import random
import re

import pygame
import pymunk
import pytest
from probes import pymunk_lab_scene
from programs import PYMUNK, SOLUTION, probe, run_in

import mini_engine
import pymunk_scene
from pymunk_scene import (
    BACKGROUND,
    GREY,
    HEIGHT,
    MAX_BALLS,
    MAX_STEPS,
    STEP,
    WIDTH,
    add_ball,
    add_box,
    add_static_box,
    advance,
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


def test_the_constants_are_the_engines():
    assert (WIDTH, HEIGHT, STEP, MAX_STEPS, MAX_BALLS) == (900, 600, 1 / 120, 8, 40)


def test_space_has_the_lessons_gravity_and_damping(scene):
    for space in (scene[0], empty_space()):
        assert (tuple(space.gravity), space.damping) == ((0, 980), 0.95)


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


def test_a_static_box_is_given_by_its_centre_and_full_size():
    space = empty_space()
    add_static_box(space, (100, 50), (40, 20))
    (shape,) = space.static_body.shapes
    assert tuple(shape.cache_bb()) == (80, 40, 120, 60)


def test_the_bob_hangs_on_a_rod_of_140_px(scene):
    space = scene[0]
    bob, *_ = space.bodies
    (rod,) = space.constraints
    assert isinstance(rod, pymunk.PinJoint)
    assert (rod.a, rod.b) == (space.static_body, bob)
    assert (tuple(rod.anchor_a), tuple(rod.anchor_b), rod.distance) == ((700, 90), (0, 0), 140)
    (shape,) = bob.shapes
    assert (tuple(bob.position), bob.mass, shape.radius) == ((840, 90), 6, 24)
    assert bob.moment == pytest.approx(0.5 * 6 * 24**2)
    assert surface(shape) == (0.6, 0.2)


def test_eight_balls_are_discs_of_the_lessons_size_and_surface(scene):
    balls = list(scene[0].bodies)[1:9]
    places = [(120, 60), (190, 100), (260, 140), (330, 60)]
    places += [(400, 100), (470, 140), (540, 60), (610, 100)]
    assert [tuple(body.position) for body in balls] == places
    for body in balls:
        (shape,) = body.shapes
        assert 10 <= shape.radius <= 22
        assert body.mass == pytest.approx(shape.radius**2 / 100)
        assert body.moment == pytest.approx(0.5 * body.mass * shape.radius**2)
        assert surface(shape) == (0.6, 0.4)


def test_both_scenes_draw_the_same_balls(scene):
    _, *balls = mini_engine.make_world(random.Random(12)).moving_bodies()
    shapes = [shape for body in list(scene[0].bodies)[1:9] for shape in body.shapes]
    assert [(s.radius, s.color) for s in shapes] == [(b.shape.radius, b.color) for b in balls]


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


def test_the_stack_stands_after_ten_seconds(scene):
    space, stack = scene
    for _ in range(10 * 120):
        space.step(STEP)
    assert stack_stands(stack)
    for level, box in enumerate(stack):
        assert tuple(box.position) == pytest.approx((760, 542 - 36 * level), abs=1)


@pytest.mark.parametrize(("angle", "stands"), [(0.19, True), (0.2, False), (-0.3, False)])
def test_a_stack_with_one_tilted_box_has_fallen(scene, angle, stands):
    scene[1][2].angle = angle
    assert stack_stands(scene[1]) is stands


def test_the_rod_holds_the_bob(scene):
    space = scene[0]
    bob, *_ = space.bodies
    for _ in range(5 * 120):
        space.step(STEP)
        assert math.dist(bob.position, (700, 90)) == pytest.approx(140, rel=0.02)


def test_balls_rest_and_have_rolled():
    after = pymunk_lab_scene(5)[1:9]
    assert all(y < 560 for _, y, _ in after)
    assert any(abs(angle) > 1 for _, _, angle in after)


def test_the_same_run_twice_gives_the_same_bits():
    assert repr(pymunk_lab_scene(2)) == repr(pymunk_lab_scene(2))


# ---------------------------------------------------------------- the frame


@pytest.mark.parametrize("rate", [20, 30, 144, 240])
def test_things_fall_equally_fast_whatever_the_frame_rate(rate):
    space = empty_space()
    body = add_ball(space, random.Random(12), (0, 0))
    accumulator, total = 0.0, 0
    for _ in range(rate):
        accumulator, steps = advance(space, accumulator, 1 / rate)
        total += steps
        assert 0 <= accumulator < STEP
    assert 119 <= total <= 120  # the last one may be due by a rounding error
    other = empty_space()
    twin = add_ball(other, random.Random(12), (0, 0))
    for _ in range(total):
        other.step(STEP)
    assert tuple(body.velocity) == tuple(twin.velocity)
    assert tuple(body.position) == tuple(twin.position)
    assert body.velocity.y == pytest.approx(980, rel=0.05)  # less what damping takes


@pytest.mark.parametrize("seconds", [MAX_STEPS * STEP, 0.1, 5])
def test_a_slow_frame_adds_eight_steps_at_most(seconds):
    accumulator, steps = advance(empty_space(), 0.0, seconds)
    assert (accumulator, steps) == (pytest.approx(0, abs=1e-12), MAX_STEPS)


# ---------------------------------------------------------------- the program


def test_the_program_runs_without_a_screen_and_prints_its_closing_lines():
    printed = run_in(SOLUTION, *PYMUNK, LAB_FRAMES="3")
    assert re.fullmatch(r"Fixed steps: \d+\nBodies: 13\nBox stack stands: yes\n", printed)


def test_the_program_counts_its_steps():
    played = probe(SOLUTION, "play", "pymunk_scene", [17] * 60)
    assert played["printed"] == ["Fixed steps: 122", "Bodies: 13", "Box stack stands: yes"]
    assert "moving bodies: 13" in played["frames"][-1]["text"]


def test_balls_dropped_into_the_stack_fell_it_and_the_program_says_so():
    events = [[0, "MOUSEBUTTONDOWN", {"pos": [740, 452 + i], "button": 1}] for i in range(20)]
    printed = probe(SOLUTION, "play", "pymunk_scene", [50] * 60, events)["printed"]
    assert printed[1:] == ["Bodies: 33", "Box stack stands: no"]


def test_a_click_drops_a_ball_there_and_b_a_box_near_the_top():
    events = [
        [1, "MOUSEBUTTONDOWN", {"pos": [300, 200], "button": 1}],
        [2, "MOUSEBUTTONDOWN", {"pos": [50, 60], "button": 3}],
        *([3, "KEYDOWN", {"key": pygame.K_b}] for _ in range(20)),
    ]
    frames = probe(SOLUTION, "play", "pymunk_scene", [0] * 4, events)["frames"]
    assert [len(frame["moving"]) for frame in frames] == [13, 14, 14, 34]
    assert frames[1]["moving"][-1] == [300, 200]
    dropped = [x for x, _ in frames[3]["moving"][14:]]
    assert all(420 <= x <= 700 for x in dropped)
    assert len(set(dropped)) > 10


@pytest.mark.parametrize(
    ("kind", "fields"),
    [
        ("MOUSEBUTTONDOWN", {"pos": [300, 200], "button": 1}),
        ("KEYDOWN", {"key": pygame.K_b}),
    ],
)
def test_the_window_fills_up_to_max_balls(kind, fields):
    events = [[0, kind, fields]] * MAX_BALLS
    frames = probe(SOLUTION, "play", "pymunk_scene", [0], events)["frames"]
    assert len(frames[0]["moving"]) == MAX_BALLS


def test_r_resets_the_scene_down_to_the_size_of_its_balls():
    box = {"key": pygame.K_b}
    events = [[1, "KEYDOWN", box], [21, "KEYDOWN", {"key": pygame.K_r}], [22, "KEYDOWN", box]]
    times = [0] + [50] * 20
    frames = probe(SOLUTION, "play", "pymunk_scene", times * 2, events)["frames"]
    assert len(frames[20]["moving"]) == 14
    assert frames[20]["moving"][:13] != frames[0]["moving"]
    assert frames[21:] == frames[:21]


def test_closing_the_window_ends_the_program():
    played = probe(SOLUTION, "play", "pymunk_scene", [50] * 9, [[2, "QUIT", {}]])
    assert len(played["frames"]) == 3
    assert len(played["printed"]) == 3


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


def test_the_module_names_what_the_lesson_names():
    names = ["add_static_box", "add_ball", "add_box", "make_space", "draw", "main"]
    assert all(callable(getattr(pymunk_scene, name)) for name in names)
