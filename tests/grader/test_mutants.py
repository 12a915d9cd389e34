"""Mutants: the operators make what they should, and the checks notice what they make."""

import ast
import math
from collections import Counter

import pytest

from grader.checks.exact import Disc, Rect, Rod, rod_solved
from grader.judge import misconceptions
from grader.judge.lab import Observation
from grader.judge.rubric import load_rubric
from grader.maintain import mutants
from grader.maintain.mutants import (
    Campaign,
    Mutant,
    Outcome,
    all_mutants,
    equivalents,
    foretold,
    is_equivalent,
    sample,
)
from grader.maintain.operators import OPERATORS, changes

SNIPPETS = {
    "other_arithmetic": ("s = u + w * r ** n", {"s = u - w * r ** n", "s = u + w / r ** n"}),
    "other_comparison": ("s = u < w", {"s = u <= w", "s = u > w"}),
    "other_constant": ("s = 3", {"s = 4", "s = 1.5", "s = -3", "s = 0", "s = 1"}),
    "other_name": ("s = low.x + high.y", {"s = high.x + high.y", "s = low.y + high.y"}),
    "max_for_min": ("s = min(u, w)", {"s = max(u, w)"}),
    "no_minus": ("s = -u", {"s = u"}),
    "no_call": ("s = abs(u)", {"s = u"}),
    "arguments_swapped": ("f(u, w, z)", {"f(w, u, z)", "f(u, z, w)"}),
    "other_update": ("s += u", {"s -= u", "s = u"}),
    "other_condition": ("while u:\n    s()", {"while not u:\n    s()", "if u:\n    s()"}),
    "no_statement": ("if u:\n    s()", {"pass", "if u:\n    pass", "s()"}),
    "early_return": ("s()", {"return\ns()"}),
}


@pytest.mark.parametrize("operator", [each.__name__ for each in OPERATORS])
def test_an_operator_makes_its_changes(operator: str):
    code, expected = SNIPPETS[operator]
    made = {change for name, change in changes(code) if name == operator}
    assert expected <= made


def test_every_change_is_another_piece_of_python():
    code = "a, b = max(a.x, -b.y), 0\nif a > b:\n    return a ** 2\nb += abs(a)"
    made = [change for _, change in changes(code)]
    assert len(made) == len(set(made)) > 30 and ast.unparse(ast.parse(code)) not in made
    assert all(ast.parse(change) for change in made)


def test_arguments_whose_order_does_not_matter_stay_where_they_are():
    assert "max(w, u)" not in {change for _, change in changes("max(u, w)")}


# ---------------------------------------------------------------- which there are


def test_every_todo_has_mutants_and_none_of_them_is_the_solution():
    assert {each.todo for each in all_mutants()} == {
        t.id for t in load_rubric().todos if t.function
    }
    assert all(each.was != each.now for each in all_mutants())


def test_a_sample_draws_from_every_todo_and_is_the_same_again():
    todos = [todo.id for todo in load_rubric().todos if todo.function]
    count = 4 * len(todos)
    drawn = sample(all_mutants(), count, seed=3)
    assert drawn == sample(all_mutants(), count, seed=3) != sample(all_mutants(), count, seed=4)
    assert Counter(each.todo for each in drawn) == dict.fromkeys(todos, 4)


def test_the_listed_equivalents_still_exist_and_are_few():
    existing = {(each.todo, each.was, each.now) for each in all_mutants()}
    assert set(equivalents()) <= existing
    assert all(why.endswith(".") for why in equivalents().values())
    assert len(equivalents()) < 0.04 * len(existing)


# ---------------------------------------------------------------- what is said of them


def test_what_a_mutant_loses_decides_what_is_said_of_it():
    listed = next(each for each in all_mutants() if is_equivalent(each))
    other = next(each for each in all_mutants() if each.todo == "3")
    assert Outcome(other, {"3": 2}).verdict == "killed" and not Outcome(other, {"3": 2}).complaint
    assert Outcome(other, {}).complaint == "survived"
    assert Outcome(other, {"3": 2, "4": 1}).complaint == "TODO 4 must not lose anything"
    assert Outcome(other, {"4": 1}).complaint == "TODO 4 must not lose anything"
    assert Outcome(listed, {}).verdict == "equivalent" and not Outcome(listed, {}).complaint
    assert "listed as equivalent" in Outcome(listed, {listed.todo: 1}).complaint


def test_a_campaign_with_a_survivor_or_many_wrong_names_is_not_sound():
    fine = Outcome(all_mutants()[0], {"1": 16}, "inside-is-forgotten", "right")
    misled = Outcome(all_mutants()[0], {"1": 16}, "inside-is-forgotten", "wrong")
    assert Campaign([fine] * 98 + [misled] * 2).sound
    assert not Campaign([fine] * 97 + [misled] * 3).sound
    assert not Campaign([*[fine] * 99, Outcome(all_mutants()[0], {})]).sound


def test_a_name_is_wrong_where_its_model_gives_another_number():
    asked, e = (1.0, 0.25, 1 / 120, 60), math.exp
    one_rate = Observation("damping", asked, (e(-0.5), e(-0.5)))
    another = Observation("damping", asked, (e(-0.5), e(-0.5) + 1e-4))
    assert foretold("5", "one-rate-for-both", [one_rate])
    assert not foretold("5", "one-rate-for-both", [one_rate, another])
    assert not foretold("5", "rates-are-swapped", [one_rate])


def test_a_name_is_wrong_where_something_else_is_wrong_as_well():
    frames = (2, 17, 17, 1, 1)
    said, paced = Observation("said", (20,), 0), ([0, 2, 2, 0], [1 / 120])
    assert foretold("6", "steps-are-not-counted", [said, Observation("frames", (frames,), paced)])
    late = Observation("frames", (frames,), ([0, 1, 1, 0], [1 / 120]))
    assert not foretold("6", "steps-are-not-counted", [said, late])


def test_an_exception_is_an_answer_that_a_mistake_can_be_told_by():
    box, inside, apart = Rect(0, 0, 40, 20), Disc(5, -15, 8), Disc(0, -60, 10)
    failed = Observation("circle_box", (inside, box), "ZeroDivisionError")
    found = misconceptions.named("1", [failed, Observation("circle_box", (apart, box), None)])
    assert found is not None and found.id == "inside-normalises-zero"
    everywhere = Observation("circle_box", (apart, box), "ZeroDivisionError")
    assert misconceptions.named("1", [failed, everywhere]) is None


def test_a_division_by_a_k_of_0_is_told_from_one_that_always_fails():
    rod = Rod(3.0, 1.0, 50.0, (60.0, 0.0), (5.0, 0.0), (0.0, 7.0), 1 / 120)
    still = rod._replace(mass_a=0.0, mass_b=0.0)
    solved = Observation("rod", (rod,), (*rod_solved(rod), rod.offset))
    failed = Observation("rod", (still,), "ZeroDivisionError")
    found = misconceptions.named("3", [solved, failed])
    assert found is not None and found.id == "divides-by-a-k-of-0"
    assert misconceptions.named("3", [Observation("rod", (rod,), failed.answer), failed]) is None


# ---------------------------------------------------------------- what comes of them


SOAK = pytest.mark.soak


def the_one(todo: str, now: str) -> Mutant:
    """The mutant of a TODO with this line in it."""
    (found,) = [each for each in all_mutants() if each.todo == todo and now in each.now.split("; ")]
    return found


@pytest.mark.parametrize(
    ("todo", "now", "mistake"),
    [
        pytest.param("1", "if distance > radius:", "touching-counts-as-overlap", marks=SOAK),
        pytest.param("1", "if distance >= 0:", "inside-normalises-zero", marks=SOAK),
        ("3", "if self.k == 1:", "divides-by-a-k-of-0"),
        pytest.param(
            "4", "total = max(limit, min(limit, total))", "clamp-is-turned-round", marks=SOAK
        ),
        ("7a", "space.gravity = (980, 0)", "gravity-points-sideways"),
        pytest.param("7b", "moment = pymunk.moment_for_circle(mass, 0, mass)", None, marks=SOAK),
        ("7d", "steps -= 1", "steps-are-counted-down"),
        ("8a", "return (v, x + v * dt)", "velocity-returned-first"),
        ("8b", "x = x + v * dt + 0 * a_start * dt ** 2", "straight-line-in-x"),
    ],
)
def test_a_mutant_is_killed_and_its_mistake_named(todo: str, now: str, mistake: str | None):
    outcome = mutants.grade_mutant(the_one(todo, now))
    assert set(outcome.lost) == {todo} and outcome.complaint == ""
    assert (outcome.mistake, outcome.naming) == (mistake, "right" if mistake else "none")


@pytest.mark.soak
def test_mutants_listed_as_equivalent_lose_nothing():
    listed = [each for each in all_mutants() if is_equivalent(each)]
    lost = {each.name: mutants.grade_mutant(each).lost for each in listed}
    assert lost and not {name for name in lost if lost[name]}
