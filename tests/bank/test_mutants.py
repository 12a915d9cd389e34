"""Test that operators make their mutants, and that checks notice them."""

import ast
import importlib
import math
import random
import sys
import textwrap
from collections import Counter
from operator import attrgetter
from types import FunctionType

import pygame
import pytest

import integrators
import pymunk_scene
from grader.bank import mutants
from grader.bank.mutants import (
    Equivalent,
    Mutant,
    Outcome,
    list_mutants,
    code_of,
    foretells_answers,
    is_equivalent,
    load_equivalents,
    mutants_of,
    regions_of,
)
from grader.bank.slips import SCOPES, Scale, Scope, make_slips
from grader.checks.exact import Disc, Rect, Rod, solve_rod
from grader.judge.explain import misconceptions
from grader.judge.lab import Observation
from grader.judge.rubric import load_rubric
from grader.source.definitions import find_function, statements
from grader.source.operators import OPERATORS, make_changes
from grader.source.regions import replace_regions
from mini_engine import game_loop, scenes
from mini_engine.bonus import window
from mini_engine.bonus.world import with_bonus

SOAK = pytest.mark.soak
SNIPPETS = {
    "change_arithmetic": ("s = u + w * r ** n", {"s = u - w * r ** n", "s = u + w / r ** n"}),
    "change_comparison": ("s = u < w", {"s = u <= w", "s = u > w"}),
    "change_constant": ("s = 3", {"s = 4", "s = 1.5", "s = -3", "s = 0", "s = 1"}),
    "change_name": ("s = low.x + min(high.y, u)", {"s = high.x + min(high.y, u)"}),
    "unwrap": ("s = -abs(u)", {"s = abs(u)", "s = -u"}),
    "swap_arguments": ("f(u, w, z)", {"f(w, u, z)", "f(u, z, w)"}),
    "change_update": ("s += u", {"s -= u", "s = u"}),
    "change_condition": ("while u:\n    s()", {"while not u:\n    s()", "if u:\n    s()"}),
    "leave_out_statement": ("if u:\n    s()", {"pass", "if u:\n    pass"}),
    "leave_out_condition": ("if u:\n    s()", {"s()"}),
    "add_statement": ("if u:\n    s()", {"return\nif u:\n    s()"}),
    "cut_loop_short": (
        "for i in u:\n    f(i)",
        {"for i in u:\n    f(i)\n    break", "for i in list(u)[1:]:\n    f(i)"},
    ),
}


@pytest.mark.parametrize("operator", [each.__name__ for each in OPERATORS])
def test_an_operator_makes_its_changes(operator: str):
    code, expected = SNIPPETS[operator]
    assert expected <= {change for name, change in make_changes(code) if name == operator}


@pytest.mark.parametrize(
    ("code", "change"),
    [
        ("s = min(u, w)", "s = max(u, w)"),
        ("s = low.x", "s = low.y"),
        ("s = not u", "s = u"),
        ("s += u", "s += u\ns += u"),
        ("if u:\n    s()", "if u:\n    pass"),
    ],
)
def test_a_change_of_another_kind_is_made_as_well(code: str, change: str):
    assert change in {each for _, each in make_changes(code)}


def test_in_a_loop_over_bodies_it_is_one_of_them_that_is_harmed_or_passed_over():
    loop = "for body in w:\n    f(body)"
    made = {change for _, change in make_slips(loop, Scope(each="body"))}
    assert f"{loop}\n    body.vel *= 0" in made
    assert "for body in w:\n    if body.is_static:\n        continue\n    f(body)" in made


def test_what_is_done_last_is_done_before_every_return():
    code = "if u:\n    return\ns = u\nreturn (s, u)"
    made = {change for _, change in make_slips(code, Scope(deeds=["f()"]))}
    last = "answer_0, answer_1 = (s, u)\nf()\nreturn (answer_0, answer_1)"
    assert f"if u:\n    f()\n    return\ns = u\n{last}" in made


def test_arguments_whose_order_does_not_matter_stay_where_they_are():
    assert "max(w, u)" not in {change for _, change in make_changes("max(u, w)")}


# ---------------------------------------------------------------- making them


def test_every_mutant_is_other_code_and_none_is_the_solution():
    made = [each.code for each in mutants_of("4")]
    right = ast.unparse(ast.parse(code_of(regions_of("solution")["4"][1])))
    assert len(made) == len(set(made)) > 100 and right not in made


@SOAK
def test_every_todo_has_mutants_and_with_a_scope_slips_too():
    todos = {todo.id for todo in load_rubric().todos if todo.function}
    slips = Counter(each.todo for each in list_mutants() if each.operator not in SNIPPETS)
    assert {each.todo for each in list_mutants()} == todos >= set(SCOPES)
    assert min(slips[todo] for todo in SCOPES) > 10


def test_mutants_are_listed_by_todo():
    assert list_mutants({"5", "8a"}) == [*mutants_of("5"), *mutants_of("8a")]


@SOAK
@pytest.mark.parametrize("entry", load_equivalents(), ids=lambda each: each.why[:40])
def test_all_that_is_listed_as_equivalent_still_exists(entry: Equivalent):
    found = [each for each in list_mutants() if entry.has(each)]
    assert {each.todo for each in found} == set(entry.todos) and entry.why.endswith(".")
    assert {each.operator for each in found} >= set(entry.operators)
    assert {(each.was, each.now) for each in found} >= set(entry.changes)


@SOAK
def test_few_are_listed_as_equivalent():
    assert sum(map(is_equivalent, list_mutants())) < 0.08 * len(list_mutants())


# ---------------------------------------------------------------- messages


def test_what_a_mutant_loses_decides_what_is_said_of_it():
    listed = next(each for each in mutants_of("5") if is_equivalent(each))
    other = Mutant("3", "unwrap", "was", "now", "code")
    assert Outcome(other, {"3": 2}).verdict == "killed" and not Outcome(other, {"3": 2}).complaint
    assert Outcome(other, {}).complaint == "survived"
    assert Outcome(other, {"3": 2, "4": 1}).complaint == "TODO 4 must not lose anything"
    assert Outcome(other, {"4": 1}).complaint == "TODO 4 must not lose anything"
    assert Outcome(listed, {}).verdict == "equivalent" and not Outcome(listed, {}).complaint
    assert "listed as equivalent" in Outcome(listed, {listed.todo: 1}).complaint


def test_a_wrong_name_is_a_complaint():
    mutant = Mutant("1", "unwrap", "was", "now", "code")
    assert not Outcome(mutant, {"1": 16}, "inside-is-forgotten").complaint
    misnamed = Outcome(mutant, {"1": 16}, "inside-is-forgotten", is_misnamed=True)
    assert misnamed.complaint == "is not inside-is-forgotten"


def test_a_name_is_wrong_where_its_model_gives_another_number():
    asked, e = (1.0, 0.25, 1 / 120, 60), math.exp
    one_rate = Observation("damping", asked, (e(-0.5), e(-0.5)))
    another = Observation("damping", asked, (e(-0.5), e(-0.5) + 1e-4))
    assert foretells_answers("5", "one-rate-for-both", [one_rate])
    assert not foretells_answers("5", "one-rate-for-both", [one_rate, another])
    assert not foretells_answers("5", "rates-are-swapped", [one_rate])


def test_a_name_is_wrong_where_something_else_is_wrong_as_well():
    frames = (2, 17, 17, 1, 1)
    said, paced = Observation("said", (20,), 0), ([0, 2, 2, 0], [1 / 120])
    assert foretells_answers(
        "6", "steps-are-not-counted", [said, Observation("frames", (frames,), paced)]
    )
    late = Observation("frames", (frames,), ([0, 1, 1, 0], [1 / 120]))
    assert not foretells_answers("6", "steps-are-not-counted", [said, late])


def test_an_exception_is_an_answer_that_a_mistake_can_be_told_by():
    box, inside, apart = Rect(0, 0, 40, 20), Disc(5, -15, 8), Disc(0, -60, 10)
    failed = Observation("circle_box", (inside, box), "ZeroDivisionError")
    found = misconceptions.name_mistake(
        "1", [failed, Observation("circle_box", (apart, box), None)]
    )
    assert found is not None and found.id == "inside-normalises-zero"
    everywhere = Observation("circle_box", (apart, box), "ZeroDivisionError")
    assert misconceptions.name_mistake("1", [failed, everywhere]) is None


def test_a_division_by_a_k_of_0_is_told_from_one_that_always_fails():
    rod = Rod(3.0, 1.0, 50.0, (60.0, 0.0), (5.0, 0.0), (0.0, 7.0), 1 / 120)
    still = rod._replace(mass_a=0.0, mass_b=0.0)
    solved = Observation("rod", (rod,), (*solve_rod(rod), rod.offset))
    failed = Observation("rod", (still,), "ZeroDivisionError")
    found = misconceptions.name_mistake("3", [solved, failed])
    assert found is not None and found.id == "divides-by-a-k-of-0"
    assert (
        misconceptions.name_mistake("3", [Observation("rod", (rod,), failed.answer), failed])
        is None
    )


# ---------------------------------------------------------------- grading


def find_mutant(todo: str, now: str) -> Mutant:
    """Return the mutant of a TODO with this line in it."""
    (found,) = [each for each in mutants_of(todo) if now in each.now.split("; ")]
    return found


@pytest.mark.parametrize(
    ("todo", "now", "mistake"),
    [
        pytest.param("1", "if distance > radius:", "touching-counts-as-overlap", marks=SOAK),
        pytest.param("1", "if distance >= 0:", "inside-normalises-zero", marks=SOAK),
        pytest.param("3", "if self.k == 1:", None, marks=SOAK),
        pytest.param(
            "4", "total = max(limit, min(limit, total))", "clamp-is-turned-round", marks=SOAK
        ),
        pytest.param("7a", "space.gravity = (980, 0)", "gravity-points-sideways", marks=SOAK),
        pytest.param("7b", "moment = pymunk.moment_for_circle(mass, 0, mass)", None, marks=SOAK),
        pytest.param("7d", "steps -= 1", None, marks=SOAK),
        pytest.param("8a", "return (v, x + v * dt)", "velocity-returned-first", marks=SOAK),
        pytest.param(
            "8b", "x = x + v * dt + 0 * a_start * dt ** 2", "straight-line-in-x", marks=SOAK
        ),
    ],
)
def test_a_mutant_is_killed_and_its_mistake_named(todo: str, now: str, mistake: str | None):
    outcome = mutants.grade_mutant(find_mutant(todo, now))
    assert set(outcome.lost) == {todo} and outcome.complaint == ""
    assert outcome.mistake == mistake


def test_alone_a_mutant_is_graded_up_to_the_first_check_that_fails():
    mutant = find_mutant("8a", "return (v, x + v * dt)")
    outcome = mutants.grade_mutant(mutant, alone=True)
    assert outcome.verdict == "killed" and outcome.lost["8a"] == first_of("8a").points
    assert outcome.mistake is None


def first_of(todo: str):
    """Return its first check in the rubric."""
    return next(each for each in load_rubric().todos if each.id == todo).checks[0]


@pytest.mark.soak
def test_mutants_listed_as_equivalent_lose_nothing():
    """Grade each mutant listed by its lines, and one for each other entry and TODO."""
    chosen = {
        (entry.why, each.todo, each.now if (each.was, each.now) in entry.changes else ""): each
        for entry in load_equivalents()
        for each in list_mutants()
        if entry.has(each)
    }
    outcomes = map(mutants.grade_mutant, chosen.values())
    assert not [str(each.mutant) for each in outcomes if each.lost]
