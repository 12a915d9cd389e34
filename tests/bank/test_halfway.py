"""Test the words of the first failure of a half-way state."""

from hashlib import sha256
from pathlib import Path

import pytest

from grader.bank.halfway import list_states
from grader.bank.verify import grade_member
from grader.checks.exact import Disc, Lever, Rect, Touch, circle_box
from grader.judge.explain.diagnosis import Diagnosis
from grader.judge.lab import Observation
from grader.judge.explain.misconceptions import load_known
from grader.judge.explain.names import Names, load_signatures
from grader.judge.submission import Submission
from grader.judge.task import KIT
from grader.judge.explain.narrowing import find_relation, read_questions

STATES = [*list_states()]
BOX = Rect(0, 0, 40, 20)
OUTSIDE = [Disc(-10, -25, 10), Disc(-46, 5, 10), Disc(10, 28, 10), Disc(44, -5, 10)]
INSIDE = [Disc(5, -15, 8), Disc(-33, 4, 8), Disc(3, 12, 8), Disc(35, 1, 8)]


def draw_states() -> list[str]:
    """Return one state of every fifth TODO, by the hash of its name; `make verify` asks for all."""
    found: dict[str, str] = {}
    for name in sorted((s.name for s in STATES), key=lambda n: sha256(n.encode()).hexdigest()):
        found.setdefault(name.partition("-")[0], name)
    return sorted(found.values())[2::5]


@pytest.mark.parametrize("name", draw_states())
def test_the_first_failure_of_a_state_says_what_it_must(name: str):
    (state,) = [each for each in STATES if each.name == name]
    assert grade_member(state).complaint == ""


def test_there_are_states_of_every_todo_and_each_can_be_built(tmp_path: Path):
    assert len(STATES) >= 150 and len({each.name for each in STATES}) == len(STATES)
    assert {todo for each in STATES for todo in each.todos} >= set("123456") | {"7a", "7b", "7c", "7d", "8a", "8c"}
    for state in STATES[:: len(STATES) // 10]:
        state.build(tmp_path / state.name)


# ---------------------------------------------------------------- messages


def make_answer(disc: Disc, **changes: float) -> Observation:
    """Return the right contact with some of its numbers changed."""
    (touch,) = circle_box(disc, BOX)
    assert isinstance(touch, Touch)
    return Observation("circle_box", (disc, BOX), touch._replace(**changes))


def turn_normal(disc: Disc) -> Observation:
    answer = make_answer(disc).answer
    return make_answer(disc, nx=-answer.nx, ny=-answer.ny)


def describe_answers(todo: str, observations: list[Observation]) -> str:
    return Diagnosis(todo, observations).describe(observations)


def test_a_mistake_is_told_by_the_branch_that_it_shows_in():
    words = describe_answers("1", [*map(turn_normal, OUTSIDE), *map(make_answer, INSIDE)])
    assert words.startswith("The normal points from the box")
    assert words.endswith(" It shows where the centre is outside the box.")


def test_a_mistake_in_each_branch_is_told_with_the_other_one():
    without_gap = [make_answer(disc, depth=disc.r) for disc in INSIDE]
    words = describe_answers("1", [*map(turn_normal, OUTSIDE), *without_gap])
    assert "from the box to the circle" in words and "the gap to the face" in words


def test_what_no_mistake_explains_is_narrowed_down():
    off = [make_answer(disc, depth=make_answer(disc).answer.depth * 3) for disc in INSIDE]
    words = describe_answers("1", [*map(make_answer, OUTSIDE), *off])
    assert words == (
        "The depth is 3 times what it must be where the centre is inside the box, and right where "
        "the centre is outside the box. The normal and the point are right."
    )


def test_a_tie_names_nothing():
    """A's arm is along the axis and B is static: no spin term and only B's give the same result."""
    a, b, axis = Lever(2.0, 10.0, 10.0, 0.0), Lever(0.0, 100.0, 30.0, -100.0), (0.0, 1.0)
    asked = [(a._replace(rx=rx), b, axis) for rx in (5.0, 10.0, 15.0)]
    words = describe_answers("2", [Observation("effective_mass", each, 0.5) for each in asked])
    assert "forgotten" not in words and "Only" not in words


def test_right_answers_and_too_few_of_them_tell_nothing():
    load_known("1")
    assert describe_answers("1", [*map(make_answer, OUTSIDE), *map(make_answer, INSIDE)]) == ""
    assert describe_answers("1", [turn_normal(OUTSIDE[0])]).count("Where") == 0


def test_a_part_that_is_wrong_in_another_way_each_time_has_no_relation():
    load_known("1")
    wrong = [make_answer(disc, depth=depth) for disc, depth in zip(INSIDE, (1, 90, 2, 80), strict=True)]
    assert find_relation("the depth", list(read_questions(wrong))) == ""


def test_a_step_is_shown_where_its_samples_are_wrong():
    step = (3.0, -2.0, 0.25, (1.0, -2.0, 0.5, 0.0))
    places = (3.0, 2.0, 2.7421875, 2.4)
    words = describe_answers("8c", [Observation("samples of accel", step, places)])
    assert "k2" in words and "(3, 2, 2.742, 2.4) instead of (3, 2.75, 2.742," in words


# ---------------------------------------------------------------- names and arguments


def names_of(folder: Path, text: str) -> dict[str, str]:
    package = folder / "mini_engine"
    package.mkdir()
    (package / "world.py").write_text(text, encoding="utf-8")
    return dict(Names(Submission("theirs", folder)).changed("mini_engine"))


def test_a_renamed_method_is_told_with_both_names(tmp_path: Path):
    text = "class World:\n    def apply_damp(self, dt):\n        pass\n"
    words = names_of(tmp_path, text)["World.apply_damping"]
    assert words == "World has no apply_damping; it has apply_damp: renamed?"


def test_what_was_handed_out_is_nobodys_new_name(tmp_path: Path):
    """circle_circle is similar to circle_box, but was handed out."""
    text = "def circle_circle(a, b):\n    pass\n"
    assert "circle_box" not in names_of(tmp_path, text)


def test_given_functions_of_a_single_file_are_nobodys_new_name(tmp_path: Path):
    text = "def add_box(space, rng, pos):\n    pass\n"
    (tmp_path / "pymunk_scene.py").write_text(text, encoding="utf-8")
    words = Names(Submission("theirs", tmp_path)).changed("pymunk_scene")
    assert not any("renamed" in each for each in words.values())


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("def circle_box(b, a): pass", "It is circle_box(b, a) here"),
        ("def circle_box(a): pass", "It is circle_box(a) here"),
        ("def circle_box(circle, box): pass", ""),
        ("def circle_box(a, b, slack=0): pass", ""),
        ("def circle_box(*both): pass", ""),
    ],
)
def test_arguments_count_where_they_would_go_wrong(tmp_path: Path, text: str, expected: str):
    assert names_of(tmp_path, text).get("circle_box", "").startswith(expected)


def test_functions_of_every_program_are_known():
    assert {"circle_box", "World.solve_contact"} <= set(load_signatures("mini_engine"))
    assert "rk4" in load_signatures("integrators") and "add_ball" in load_signatures("pymunk_scene")
