"""Test the leaderboard: its rows, verdicts, counts and page."""

import json
import math
import os
import re
import subprocess
import sys
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from conftest import KIT

from experiments import leaderboard, scenes
from experiments.engines import Lesson, Stable
from experiments.engines.contestants import Contestant, list_contestants
from experiments.leaderboard import HELD, ask, ask_at_equal_time, count_held, holds, report
from experiments.measures import GaveUp
from experiments.reference import reference
from experiments.rows import list_rows, make_rows
from experiments.rows.frames import changed, times
from experiments.rows.reasons import REASONS, find_reason
from experiments.rows.row import Bound, Row
from experiments.rows.ties import double
from experiments.scenes import DT, G
from experiments.table import BEGIN, END

ROWS = list_rows()
PAGE = (KIT / "handouts/hard-cases.md").read_text(encoding="utf-8")
RESULTS = json.loads((KIT / "handouts/results.json").read_text(encoding="utf-8"))


def make(engine, scene, substeps):
    return engine(scene, substeps=substeps)


STABLE = Contestant("stable", "stable engine", partial(make, Stable))
LESSON = Contestant("lesson", "lesson's engine", partial(make, Lesson), ("Springs",))


def fall(trial, scene):
    """Return a ball's error after two seconds of free fall."""
    engine = trial.build(scene)
    for _ in range(240):
        engine.step(DT)
    return abs(engine.read(0).y - G * 2)


def free_fall():
    return scenes.Scene([scenes.Ball((0, 0))], effects=())


FALL = Row("a fall", "It falls by g t²/2.", free_fall, fall, Bound(3.0, "three pixels"))

# ---------------------------------------------------------------- the rows


def test_every_row_says_its_physics_and_why_its_bound_is_what_it_is():
    titles = [row.title for row in ROWS]
    assert len(titles) == len(set(titles)) > 300
    for row in ROWS:
        assert row.physics.endswith(".") and row.bound.why
        assert row.bound.limit > 0
        assert row.make().bodies


def test_the_quick_run_has_rows_of_every_subject_but_the_repeated_one():
    for subject, rows in make_rows().items():
        assert any(row.quick for row in rows) == (subject != "other units, turned")


@pytest.mark.parametrize("degrees", [30, 90])
def test_the_reference_swings_with_the_exact_period(degrees):
    scene = scenes.pendulum(140, degrees)
    places = np.array(list(reference(scene, 4.0)))[:, 1]
    xs = places[:, 0]
    down = [i for i in range(1, len(xs)) if xs[i - 1] > 0 >= xs[i]][:2]
    first, second = (i - 1 + xs[i - 1] / (xs[i - 1] - xs[i]) for i in down)
    assert (second - first) * DT == pytest.approx(scenes.pendulum_period(140, degrees), rel=1e-4)
    assert np.hypot(*places.T) == pytest.approx(140, rel=1e-6)


def test_the_reference_keeps_the_energy_of_a_double_pendulum_and_a_springs_cosine():
    lengths = np.array(list(reference(double(), 0.5)))
    assert np.hypot(*(lengths[:, 2] - lengths[:, 1]).T) == pytest.approx(100, rel=1e-6)
    places = np.array(list(reference(scenes.oscillator(), 1.0)))[:, 1, 0]
    times = DT * np.arange(1, len(places) + 1)
    assert places == pytest.approx(100 + 50 * np.cos(2 * math.pi * times), abs=1e-4)


@pytest.mark.parametrize("change", [0.01, 30.0, 1j])
def test_a_changed_scene_is_the_same_one_elsewhere(change):
    scene = replace(scenes.drop(), rods=[], springs=[])
    other = changed(scene, change)
    for a, b in zip(scene.bodies, other.bodies, strict=True):
        assert times(b.pos, 1 / change) == pytest.approx(a.pos)
    assert times(other.gravity, 1 / change) == pytest.approx(scene.gravity)


# ---------------------------------------------------------------- verdicts


@pytest.mark.parametrize(("error", "good"), [(3.0, True), (3.1, False), ("NaN", False)])
def test_a_row_holds_or_not(error, good):
    assert holds(FALL, error) == good


@pytest.mark.parametrize(
    ("problem", "word"),
    [(GaveUp("never"), "never"), (ValueError(), "stopped"), (ZeroDivisionError(), "stopped")],
)
def test_an_engine_that_gives_up_has_a_word(problem, word):
    def measure(trial, scene):
        raise problem

    assert ask(replace(FALL, measure=measure), STABLE, 4)[0] == word
    assert ask(replace(FALL, measure=lambda trial, scene: math.nan), STABLE, 4)[0] == "NaN"


def test_an_engine_that_takes_too_long_is_stopped(monkeypatch):
    monkeypatch.setattr(leaderboard, "PATIENCE", 0.0)
    assert ask(FALL, STABLE, 4)[0] == "too slow"


@pytest.mark.parametrize(("engine", "off"), [(LESSON, 1 / 960), (STABLE, 0)])
def test_a_fall_is_off_by_the_lag_of_velocities(engine, off):
    error, ms = ask(FALL, engine, 4)
    assert error == pytest.approx(G * 2 * off, rel=1e-9, abs=1e-9)
    assert ms > 0


def test_renewing_one_engine_keeps_what_the_others_came_to():
    recorded = {
        "hard-cases.md": {"box2d: name": "Box2D 2.3", "stable: name": "stable engine", "rows": 1},
        "rows": {FALL.title: {"physics": "old", "stable": "99", "box2d": "NaN / 1.5 / 64"}},
    }
    found, engines = leaderboard.renew([FALL], [STABLE], recorded)
    assert found[FALL.title] == {
        "stable": {"substeps": ask(FALL, STABLE, 4)[0]},  # without "time", as recorded
        "box2d": {"substeps": "NaN", "time": 1.5, "fitting": 64.0},
    }
    assert {one.name: one.words for one in engines} == {
        "stable": "stable engine",
        "box2d": "Box2D 2.3",
    }


@pytest.mark.parametrize(
    ("each", "fitting"), [(0.25, 4), (0.01, 64), (0.1, 10), (2.0, 1), (0.19, 5)]
)
def test_as_many_substeps_as_fit_are_found(monkeypatch, each, fitting):
    asked = []

    def pretend(row, contestant, substeps):
        asked.append(substeps)
        return float(substeps), each * substeps

    monkeypatch.setattr(leaderboard, "ask", pretend)
    first = pretend(FALL, STABLE, 4)
    assert ask_at_equal_time(FALL, STABLE, 4, first) == (float(fitting), fitting)
    assert len(asked) <= 3


# ---------------------------------------------------------------- results


def found_for(*errors):
    """Return the findings of a run of FALL, with these errors of the two engines."""
    return {
        "a fall": {
            name: {"substeps": error, "time": error, "fitting": 4}
            for name, error in zip(("stable", "lesson"), errors, strict=True)
        }
    }


def test_rows_are_counted_of_those_that_an_engine_has():
    found = found_for(1.0, "NaN")
    assert count_held([FALL], found, "stable", "substeps") == (1, 1)
    assert count_held([FALL], found, "lesson", "time") == (0, 1)
    assert count_held([FALL], found, "box2d", "time") == (0, 0)


@pytest.mark.parametrize(("error", "status"), [(1.0, 0), (5.0, 1)])
def test_a_row_that_is_lost_for_no_known_reason_ends_the_program_with_1(error, status, capsys):
    found = found_for(error, 2.0)
    assert report({"falls": [FALL]}, found, [STABLE, LESSON], ["Rapier: npm"]) == status
    out = capsys.readouterr().out
    assert "Not installed: Rapier: npm." in out
    assert ("Not known yet." in out) == bool(status)


def test_the_tables_go_between_the_marks_of_a_file(tmp_path, capsys):
    path = tmp_path / "hard-cases.md"
    path.write_text(f"before\n{BEGIN}\nearlier\n{END}\nafter\n", encoding="utf-8")
    report({"falls": [FALL]}, found_for(5.0, 9.0), [STABLE, LESSON], ["Rapier: npm"], path)
    text = path.read_text(encoding="utf-8")
    assert text.startswith("before\n") and text.endswith("after\n") and "earlier" not in text
    assert "| a fall | 5 | 3 | lesson 9 |" in text
    assert "Not installed: Rapier: npm." in text
    results = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))
    assert results["hard-cases.md"]["lesson: rows held at equal substeps"] == 0
    assert results["rows"]["a fall"]["lesson"] == "9 / 9 / 4"
    assert results[HELD] == {}


@pytest.mark.parametrize(("late", "count"), [(9.0, 1), (3.0, 0)])
def test_a_row_counts_if_an_engine_loses_it_at_equal_substeps_or_at_equal_time(
    late, count, tmp_path
):
    found = found_for(1.0, 2.0)
    found["a fall"]["lesson"]["time"] = late
    report({"falls": [FALL]}, found, [STABLE, LESSON], [], tmp_path / "hard-cases.md")
    results = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))
    assert (len(results["rows"]), len(results[HELD])) == (count, 1 - count)
    lines = results["hard-cases.md"]
    assert (lines["rows"], lines["lesson: rows at equal substeps"], lines[HELD]) == (
        *(count, count),
        1 - count,
    )


def test_the_program_asks_the_rows_that_are_named(capsys):
    assert leaderboard.main(["--only", "hit: head on, 1:10, e = 0.5"]) == 0
    assert "Every engine holds 1 more" in capsys.readouterr().out


# ---------------------------------------------------------------- the page

CELLS = RESULTS["rows"] | RESULTS[HELD]


def errors_of(name):
    """Return an engine's errors in results.json at equal substeps, by row."""
    first = {title: row[name].split(" / ")[0] for title, row in CELLS.items() if name in row}
    return {title: float(e) if re.match(r"[\d.]", e) else e for title, e in first.items()}


def test_the_handout_has_every_row_and_a_reason_for_each_that_is_lost():
    assert set(CELLS) == {row.title for row in ROWS}
    stable = errors_of("stable")
    lost = [row.title for row in ROWS if not holds(row, stable[row.title])]
    assert lost and all(f"| {title} |" in PAGE for title in lost)
    assert [title for title in lost if not find_reason(title)] == []
    assert all(any(title.startswith(start) for title in lost) for start in REASONS)


def test_the_page_is_what_the_results_give(tmp_path, capsys):
    """All its counts follow from the errors in results.json."""
    for name, text in (("hard-cases.md", PAGE), ("results.json", json.dumps(RESULTS))):
        (tmp_path / name).write_text(text, encoding="utf-8")
    leaderboard.main(["--renew", "--markdown", str(tmp_path / "hard-cases.md")])
    assert (tmp_path / "hard-cases.md").read_text(encoding="utf-8") == PAGE
    assert json.loads((tmp_path / "results.json").read_text(encoding="utf-8")) == RESULTS


def test_only_rows_that_some_engine_loses_count():
    bounds = {row.title: row.bound.limit for row in ROWS}
    for held, rows in ((False, RESULTS["rows"]), (True, RESULTS[HELD])):
        for title, row in rows.items():
            errors = [
                error
                for name, cell in row.items()
                if name not in ("physics", "may be off by")
                for error in cell.split(" / ")[:2]
            ]
            good = [re.match(r"[\d.]", e) and float(e) <= bounds[title] for e in errors]
            assert all(good) == held, title


def test_the_page_is_short():
    assert len(PAGE.split()) <= 1200


QUICK = [row for row in ROWS if row.quick][::4]
EACH = [
    pytest.param(row, marks=() if row in QUICK else pytest.mark.soak, id=row.title) for row in ROWS
]


@pytest.mark.parametrize("row", EACH)
def test_the_handout_says_what_the_engine_does_now(row):
    error, _ = ask(row, STABLE, 4)
    known = errors_of("stable")[row.title]
    assert error == pytest.approx(known, rel=0.01, abs=0.001 * row.bound.limit)


# ---------------------------------------------------------------- engines

INSTALLED = {one.name: one for one in list_contestants()[0]}
NEEDS = {
    "box2d": "Box2D 2.3, of the extra `box2d`",
    "box2d3": "Box2D 3.1, the package pyb2d3 of the extra `box2d`",
    "rapier": "Node.js and npm's package @dimforge/rapier2d-compat",
    "planck": "Node.js and npm's package planck",
}


@pytest.mark.parametrize("name", ["pymunk", "pymunk4", "box2d", "box2d3", "rapier", "planck"])
def test_an_engine_falls_rolls_and_swings_as_the_others_do(name):
    if name not in INSTALLED:
        pytest.skip(f"needs {NEEDS[name]}")
    one = INSTALLED[name]
    state = one.make(
        scenes.Scene([scenes.Ball((30, -50), 10, 2.0, (70, -90), 3.0)]), substeps=4
    ).read(0)
    assert tuple(state) == pytest.approx((30, -50, 70, -90, 0, 3), rel=1e-6)
    for scene, i, exact in (
        (free_fall(), 0, (0, G / 2)),
        (scenes.on_floor(vel=(300.0, 0.0)), 1, (208.4, -10)),
        (scenes.pendulum(), 1, (-118.9, 73.9)),
    ):
        engine = one.make(scene, substeps=4)
        for _ in range(120):
            engine.step(DT)
        assert engine.read(i)[:2] == pytest.approx(exact, abs=5)


UNFINISHED = """
from functools import partial
from experiments import leaderboard
from experiments.engines.contestants import list_contestants
from experiments.rows import list_rows
lesson = list_contestants()[0][0]
leaderboard.PATIENCE = 0.5
for row in list_rows():
    if row.quick and "Springs" not in row.make().effects:
        leaderboard.ask(row, lesson, 1)
print("done")
"""


@pytest.mark.soak
def test_an_unfinished_lessons_engine_runs_in_every_row(handed_out):
    program = [sys.executable, "-c", UNFINISHED]
    env = os.environ | {"PYTHONPATH": ""}
    done = subprocess.run(program, cwd=handed_out, env=env, capture_output=True, text=True)
    assert done.stdout.endswith("done\n"), done.stderr
