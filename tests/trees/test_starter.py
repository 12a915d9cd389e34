"""Test that the starter runs unchanged, and that each unfinished TODO looks wrong in its own way.

If other unfinished TODOs hide the effect, the solution without that TODO is used. The same
experiment on the finished solution shows the difference.
"""

import re

import probes
import pytest
from mixed_trees import mix_trees
from programs import INTEGRATORS, MINI, PYMUNK, SOLUTION, STARTER, TODOS, probe, run_in
from test_integrators import TABLE

FLOOR, LEDGE = 0, 3  # places in the list of bodies
SOAK = pytest.mark.soak
LOOPS = {"mini": "mini_engine", "pymunk": "pymunk_scene"}
FRAMES = 120
CLICKS = [[4 * i, "MOUSEBUTTONDOWN", {"pos": [30 * i + 15, 50], "button": 1}] for i in range(25)]


@pytest.fixture
def without(tmp_path):
    """Make the solution with one TODO undone."""
    return lambda todo: mix_trees(tmp_path / "tree", "solution", "starter", [todo])


# ---------------------------------------------------------------- it runs


def test_the_engine_runs_without_a_screen():
    printed = run_in(STARTER, *MINI, LAB_FRAMES="3")
    assert re.fullmatch(r"Fixed steps: 3\nPendulum length error: \d+\.\d\d px\n", printed)


def test_the_pymunk_scene_runs_without_a_screen():
    printed = run_in(STARTER, *PYMUNK, LAB_FRAMES="3")
    assert printed == "Fixed steps: 3\nBodies: 13\nBox stack stands: yes\n"


@pytest.mark.parametrize("loop", LOOPS.values(), ids=LOOPS)
def test_the_starter_runs_with_many_balls(loop):
    played = probe(STARTER, "play", loop, [17] * FRAMES, CLICKS)
    assert len(played["frames"]) == FRAMES


@pytest.mark.parametrize(
    "todo",
    [todo if todo in ("4", "7b") else pytest.param(todo, marks=SOAK) for todo in TODOS],
)
def test_the_starter_runs_with_one_todo_finished(todo, tmp_path):
    tree = mix_trees(tmp_path / "tree", "starter", "solution", [todo])
    if todo.startswith("8"):
        assert run_in(tree, *INTEGRATORS).count("\n") == 5
    else:
        loop = LOOPS["pymunk" if todo.startswith("7") else "mini"]
        assert len(probe(tree, "play", loop, [17] * FRAMES, CLICKS)["frames"]) == FRAMES


# ---------------------------------------------------------------- it looks wrong


def test_before_todo_1_balls_fall_through_floor_and_ledge():
    moving, touched = probe(STARTER, "lab_scene", 5)
    assert touched == []
    for start, (x, y) in zip((120, 190, 260, 330), moving[1:5], strict=True):
        assert x == start and y > 600
    moving, touched = probes.lab_scene(5)
    assert {FLOOR, LEDGE} <= set(touched)
    assert all(y < 560 for _, y in moving)


@pytest.mark.parametrize("radius", [10, *(pytest.param(r, marks=SOAK) for r in (16, 22))])
def test_before_todo_2_balls_slip_where_they_should_roll(radius, without):
    slip = probes.slip(probe(without("2"), "slide", radius), radius)
    assert slip > 5 * probes.slip(probes.slide(radius), radius)


def test_before_todo_3_the_bob_falls_and_the_rod_does_nothing():
    (bob, other, *_), _ = probe(STARTER, "lab_scene", 0.5)
    assert bob[0] == 840
    assert bob[1] - 90 == pytest.approx(other[1] - 60)
    assert probes.lab_scene(0.5)[0][0][0] < 830


def test_before_todo_4_friction_is_unlimited(without):
    """On a slippery floor a ball rolls at once instead of sliding on."""
    speed, _ = probe(without("4"), "slide", 16, 0.05, 0.1)[-1]
    assert speed == pytest.approx(200, rel=0.005)
    assert probes.slide(16, 0.05, 0.1)[-1][0] > 290


@pytest.mark.parametrize(
    ("rate", "left"),
    [(60, 0.55), pytest.param(120, 0.30, marks=SOAK), pytest.param(600, 0.002, marks=SOAK)],
)
def test_before_todo_5_damping_depends_on_the_step(rate, left):
    assert probe(STARTER, "coast", 0.05, 1 / rate) == pytest.approx([left, left], rel=0.25)
    assert probes.coast(0.05, 1 / rate)[0] == pytest.approx(0.951, abs=0.001)


@pytest.mark.parametrize("loop", LOOPS.values(), ids=["todo 6", "todo 7d"])
@pytest.mark.parametrize(("frames", "ms"), [(30, 33), pytest.param(144, 7, marks=SOAK)])
def test_before_todo_6_and_7d_speed_depends_on_the_frame_rate(loop, frames, ms):
    """About a second, at 30 or 144 frames."""
    assert probe(STARTER, "play", loop, [ms] * frames)["printed"][0] == f"Fixed steps: {frames}"
    right = probe(SOLUTION, "play", loop, [ms] * frames)["printed"][0]
    assert right == f"Fixed steps: {int(frames * ms * 0.12)}"


def test_before_todo_7a_nothing_falls():
    assert probe(STARTER, "pymunk_lab_scene", 2) == probe(STARTER, "pymunk_lab_scene", 0)
    assert probes.pymunk_lab_scene(2) != probes.pymunk_lab_scene(0)


def test_before_todo_7b_balls_never_turn(without):
    balls = probe(without("7b"), "pymunk_lab_scene", 5)[1:9]
    assert {angle for _, _, angle in balls} == {0}
    assert {angle for _, _, angle in probes.pymunk_lab_scene(5)[1:9]} != {0}


def test_before_todo_7c_the_bob_has_no_rod(without):
    bob, other, *_ = probe(without("7c"), "pymunk_lab_scene", 0.5)
    assert bob[0] == 840
    assert bob[1] - 90 == pytest.approx(other[1] - 60)
    assert probes.pymunk_lab_scene(0.5)[0][0] < 830


def test_before_todo_8_all_rows_are_those_of_explicit_euler():
    header, *rows = run_in(STARTER, *INTEGRATORS).splitlines()
    right_header, right, *_ = TABLE.splitlines()
    assert header == right_header
    assert [row[20:] for row in rows] == [right[20:]] * 4
