"""The published test set: the stable engine against closed forms, worked out here once more."""

import math
from functools import cache

import pytest

from experiments import published
from experiments.battery import Bench, holds, run_case
from experiments.engines import Pymunk, Stable
from experiments.measures import run
from experiments.scenes import incline, tower
from experiments.trials import settle

G = 980.0  # px/s²
CASES = {case.title: case.at("quick") for case in published.CASES}


@cache
def answers(title, engine="stable"):
    case = CASES[title]
    return dict(zip([f.key for f in case.figures], run_case(case, engine), strict=True))


@pytest.mark.parametrize("title", CASES)
def test_the_stable_engine_passes(title):
    for figure in CASES[title].figures:
        cell = answers(title)[figure.key]
        assert holds(figure, cell), f"{figure.words}: {cell}, not {figure.rule} {figure.limit}"


@pytest.mark.parametrize(
    ("engine", "lag"), [("lesson", 1 / 240), ("stable", 1 / 960), ("pymunk", -1 / 240)]
)
def test_a_falling_ball_is_off_by_half_a_step_at_its_speed(engine, lag):
    # the sum of g h² (1 + 2 + ... + n) is g t²/2 + g t h/2; from 0 to n - 1 it is g t h/2 less
    error = answers("integrator: 2 s of free fall", engine)["error"]
    assert error == pytest.approx(G * 2 * lag, rel=1e-9)


@pytest.mark.parametrize("e", [0.2, 0.4, 0.6, 0.8, 1.0])
def test_a_ball_bounces_to_e_squared_of_its_height(e):
    assert answers(f"restitution {e}")["share"] == pytest.approx(e**2, rel=5e-4)


@pytest.mark.parametrize("friction", [0.1, 0.2, 0.4, 0.6, 0.8, 1.0])
def test_a_ball_slides_from_the_slope_at_which_tan_is_3_mu(friction):
    exact = math.degrees(math.atan(3 * friction))
    assert answers(f"friction {friction}")["degrees"] == pytest.approx(exact, abs=0.07)


@pytest.mark.parametrize("engine", [Stable, Pymunk])
@pytest.mark.parametrize("degrees", [5, 20, 40, 60, 62, 75])  # with mu = 0.6 it slides from 60.9
def test_a_ball_on_a_slope_gains_speed_as_it_must(engine, degrees):
    angle = math.radians(degrees)
    pull, grip = G * math.sin(angle), 0.6 * G * math.cos(angle)
    rolling, moving = 2 / 3 * pull, engine(incline(degrees, 0.6))
    run(moving, 1)
    wanted = rolling if math.tan(angle) < 1.8 else pull - grip
    assert moving.read(1).vx == pytest.approx(wanted, rel=1e-3)


@pytest.mark.parametrize("words", ["hanging", "swinging"])
@pytest.mark.parametrize("engine", ["lesson", "stable"])
def test_a_longer_chain_stretches_more(engine, words):
    errors = [
        *answers(f"constraints: {words} chain of 5", engine).values(),
        *answers(f"constraints: {words} chain of 20", engine).values(),
    ]
    assert errors[0] < errors[1]


def test_a_crash_is_seen_one_step_late_at_most():
    assert published.one_step(290) == pytest.approx(math.sqrt(2 * G * 290) / 120, rel=0.02)
    for engine in ("lesson", "stable", "pymunk"):
        assert answers("collision: fall from 290 px", engine)["deepest"] > 3


def test_the_tallest_stack_stands_and_one_ball_more_sinks():
    (title,) = [title for title in CASES if title.startswith("stacking")]
    bench, count = Bench(CASES[title], "stable"), answers(title)["count"]
    assert settle(bench, tower(count))["sink"] < 1
    assert settle(bench, tower(count + 1))["sink"] >= 1
