"""Test accuracy.py: exact answers, measured orders, costs, verdicts, and the whole program."""

import json
import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import accuracy
import integrators
from experiments import figures
from experiments.accuracy import costs, runs, smooth, tables
from experiments.accuracy.charts import make_charts
from experiments.accuracy.questions import LESSON, QUESTIONS, STABLE, dials, families
from experiments.accuracy.runs import Effort
from experiments.engines import State
from experiments.scenes import G, drop, find_pendulum_angle, pendulum, pendulum_period
from experiments.table import BEGIN, END, Table, number, write_markdown

ROOT = Path(__file__).parents[2]
HANDOUT = ROOT / "handouts" / "accuracy.md"
RECORDED = json.loads((HANDOUT.parent / "results.json").read_text("utf-8"))["accuracy.md"]
TINY = ["--quick", "--scale", "0.02"]

# ---------------------------------------------------------------- integrators


@pytest.fixture(scope="module")
def study():
    return {"spring": smooth.study_spring(), "energy": smooth.study_energy()}


def test_every_method_has_its_order(study):
    for row in study["spring"]:
        assert row["order"] == pytest.approx(row["expected"], abs=0.1), row["method"]


def test_the_handout_has_what_the_integrators_do(study):
    for name, value in tables.list_smooth(study).items():
        assert value == pytest.approx(RECORDED[name], rel=1e-6), name


@pytest.mark.parametrize(
    ("order", "said"),
    [(2.0, ["2.00", "3.2x"]), (None, ["not reached", "-"]), (0.0, ["0.00", "-"])],
)
def test_an_order_is_said_with_what_a_digit_costs(order, said):
    assert tables.say_order(order) == said


def test_after_whole_swings_the_errors_of_semi_implicit_euler_cancel():
    """As the handout says: there it is as accurate as Verlet, but not during its last swing."""
    says = "After exactly ten swings, semi-implicit Euler is as close as Verlet"
    assert says in " ".join(HANDOUT.read_text("utf-8").split())
    last, worst = {}, {}
    for method in smooth.METHODS[1:3]:
        x, v = integrators.X0, 0.0
        for _ in range(1280):
            x, v = method(x, v, smooth.SWINGS / 1280, integrators.spring)
        last[method] = smooth.measure_distance(x, v, smooth.SWINGS)
        worst[method] = smooth.measure_run(method, 1280)["error"]
    euler, verlet = smooth.METHODS[1:3]
    assert last[euler] == pytest.approx(last[verlet], rel=0.01)
    assert worst[euler] > 4 * worst[verlet]


def verlet_with_one_force(x, v, dt, accel):
    a = accel(x)
    return x + v * dt + 0.5 * a * dt**2, v + a * dt


def rk4_with_equal_weights(x, v, dt, accel):
    v1, a1 = v, accel(x)
    v2, a2 = v + 0.5 * dt * a1, accel(x + 0.5 * dt * v1)
    v3, a3 = v + 0.5 * dt * a2, accel(x + 0.5 * dt * v2)
    v4, a4 = v + dt * a3, accel(x + dt * v3)
    return x + dt / 4 * (v1 + v2 + v3 + v4), v + dt / 4 * (a1 + a2 + a3 + a4)


@pytest.mark.soak
def test_a_wrong_method_misses_its_order():
    methods = [*smooth.METHODS[:2], verlet_with_one_force, rk4_with_equal_weights]
    for row in smooth.study_spring(methods)[2:]:
        assert row["order"] is None or abs(row["order"] - row["expected"]) > 0.2


def test_calls_of_the_force_are_counted():
    calls = [smooth.measure_run(method, 1000)["calls"] for method in smooth.METHODS]
    # Where v is 0, explicit Euler stays, and so does the first sample of RK4. Verlet has two ends.
    assert calls == [999, 1000, 1001, 3999]


def test_a_method_that_raises_or_blows_up_is_named_and_does_not_end_the_study():
    def raises(x, v, dt, accel):
        raise TypeError

    assert smooth.measure_run(raises, 10)["error"] == "TypeError"
    grows = smooth.measure_run(lambda x, v, dt, accel: (x * 1e9, v), 100)
    assert grows["error"] == "blown up"
    assert smooth.find_energy_peaks(raises)[-1] == "TypeError"
    assert not any(row["bounded"] for row in smooth.study_energy([raises] * 4))


@pytest.fixture(scope="module")
def energies(study):
    return {row["method"]: row for row in study["energy"]}


def test_rk4_drifts_above_verlets_bounded_error_at_equal_evaluations(energies):
    rk4, verlet = energies["rk4"], energies["velocity_verlet"]
    assert rk4["peaks"][0] < verlet["peaks"][0] / 10
    assert rk4["peaks"][59] == pytest.approx(1.8e-3, rel=0.15)  # as measured by another program
    assert verlet["peaks"][59] == pytest.approx(6.7e-4, rel=0.05)
    crossing = next(i for i in range(300) if rk4["peaks"][i] > verlet["peaks"][i])
    assert 10 < crossing < 60


def test_only_symplectic_methods_keep_the_energy_of_an_orbit_bounded(energies):
    assert {method: row["bounded"] for method, row in energies.items()} == {
        "explicit_euler": False,
        "semi_implicit_euler": True,
        "velocity_verlet": True,
        "rk4": False,
    }


# ---------------------------------------------------------------- questions


class Exact:
    """An engine that knows the answer: at(t) gives the states."""

    def __init__(self, scene, at):
        self.scene, self.at, self.time = scene, at, 0.0

    def step(self, dt):
        self.time += dt

    def read(self, i):
        return self.at(self.time)[i]

    def lag(self, dt):
        return 0.0


def resting_state(x=0.0, y=0.0):
    return State(x, y, 0.0, 0.0, 0.0, 0.0)


def test_an_exact_bounce_has_no_error():
    def at(t):
        speed, start = math.sqrt(2 * G * 290), -math.sqrt(2 * 290 / G)
        while t >= start + 2 * speed / G:
            start, speed = start + 2 * speed / G, speed / 2
        t -= start
        return resting_state(), State(
            0.0, -10 - speed * t + G * t**2 / 2, 0.0, G * t - speed, 0.0, 0.0
        )

    assert QUESTIONS["bounce"].ask(Exact(drop(restitution=0.5), at), 2.2, 1 / 120) < 1e-9


def test_an_exact_pendulum_has_no_error():
    """Compare the closed form with rk4, which starts at 90 degrees as well."""
    seconds, steps = QUESTIONS["pendulum"].seconds, 2000
    assert seconds == pendulum_period(140, 90)
    motion = [(math.pi / 2, 0.0)]
    for _ in range(steps):
        motion.append(
            integrators.rk4(*motion[-1], seconds / steps, lambda x: -G / 140 * math.sin(x))
        )

    def at(t):
        angle, turn = motion[round(t / seconds * steps)]
        x, y = 140 * math.sin(angle), 140 * math.cos(angle)
        return resting_state(), State(x, y, y * turn, -x * turn, 0.0, 0.0)

    assert QUESTIONS["pendulum"].ask(Exact(pendulum(), at), seconds, seconds / steps) < 1e-8
    assert find_pendulum_angle(0.0, 140) == pytest.approx(math.pi / 2)


def test_a_quick_run_judges_each_dial_by_the_same_runs_as_a_full_one():
    quick, full = dials(quick=True), dials(quick=False)
    assert list(quick) == list(full)
    for few, many in zip(quick.values(), full.values(), strict=True):
        assert set(few) <= set(many)
        few, many = list(few.values()), list(many.values())
        assert (few[0], few[-1]) == (many[0], many[-1])


@pytest.mark.parametrize("quick", [True, False])
def test_every_dial_goes_through_the_engine_as_it_is(quick):
    for dial, row in dials(quick).items():
        settings = list(row.values())
        assert LESSON in settings, dial
        assert len(set(map(str, settings))) == len(settings) >= 3


# ---------------------------------------------------------------- costs and verdicts


@pytest.mark.parametrize("setting", [LESSON, STABLE])
def test_opcodes_are_the_same_from_run_to_run(setting):
    def count_steps(setting):
        engine = setting.build(QUESTIONS["stack"].scene())
        for _ in range(30):
            engine.step(setting.dt)
        return costs.opcodes_per_second(engine, setting.dt)

    assert count_steps(setting) == count_steps(setting) > 0
    twice = replace(setting, passes=16) if setting is LESSON else replace(setting, substeps=8)
    assert count_steps(twice) > count_steps(setting)


def runs_of(*pairs):
    return [{"error": error, "work": work} for error, work in pairs]


@pytest.mark.parametrize(
    ("judged", "says", "digit"),
    [
        (runs_of((1.0, 1), (0.1, 3)), "helps", 3),
        (runs_of((1.0, 1), (0.5, 2), (0.01, 9)), "helps", 3),
        (runs_of((1.0, 1), (0.96, 8)), "cannot help", None),
        (runs_of((0.1, 1), (1.0, 2)), "no steady gain", None),
        (runs_of((1e-12, 1), (0.0, 2)), "exact already", None),
        (runs_of(("launched", 1), (1.0, 2)), "gives up", None),
        (runs_of(("launched", 1), (1.0, 2), (0.1, 4)), "helps", 2),
    ],
)
def test_a_verdict_tells_what_one_digit_costs(judged, says, digit):
    found = runs.judge(judged)
    assert found["says"] == says
    assert found["digit"] == (None if digit is None else pytest.approx(digit))


@pytest.mark.parametrize(
    ("problem", "word"), [(ValueError("NaN"), "NaN"), (TypeError("student"), "TypeError")]
)
def test_an_engine_that_meets_nan_or_raises_gives_up(problem, word):
    def ask(engine, seconds, dt):
        raise problem

    question = replace(QUESTIONS["stack"], ask=ask)
    assert runs.run_setting(question, LESSON, Effort(quick=True))["error"] == word


# ---------------------------------------------------------------- budgets


def ladder(engine, *rungs):
    """Make runs with substeps 1, 2, 4 ..., from their errors and times (ms) in each repeat."""
    return [
        {"engine": engine, "setting": f"{2**i} substeps", "error": error, "ms": ms}
        for i, (error, ms) in enumerate(rungs)
    ]


def test_within_a_budget_the_best_setting_counts_that_fits_and_repeats_make_a_range():
    ran = ladder("lesson", (8.0, [0.5, 0.6, 0.7]), (2.0, [0.9, 0.8, 1.2]), (0.5, [3.0, 3.0, 3.0]))

    def find(budget):
        return [pick["error"] for pick in runs.find_least(ran, "lesson", budget)]

    assert find(1.0) == [2.0, 2.0, 8.0]
    assert find(4.0) == [0.5, 0.5, 0.5]
    assert find(0.1) == ["too slow"] * 3
    lost = ladder("lesson", ("falls through", [0.5, 0.5, 0.5]))
    assert runs.find_least(lost, "lesson", 1.0)[1]["error"] == "falls through"


# ---------------------------------------------------------------- the program


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    """Run the whole program once in this process, with a tiny budget."""
    out = tmp_path_factory.mktemp("accuracy")
    (out / "handout").mkdir()
    handout = str(out / "handout" / "t.md")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(runs, "QUICK_BUDGETS", (0.02,))
        accuracy.main([*TINY, "--out", str(out), "--no-figures", "--markdown", handout])
    return out


@pytest.fixture(scope="module")
def results(tiny):
    return json.loads((tiny / "results.json").read_text(encoding="utf-8"))


@pytest.mark.soak
def test_the_results_are_complete(results):
    assert set(results) == {"about", "budgets", "smooth", "dials", "crowds", "lines"}
    assert list(results["budgets"]) == list(results["dials"]) == list(QUESTIONS)
    for scene in results["budgets"].values():
        assert set(scene["within"]) == set(families())
        assert all(len(run["ms"]) == 3 for run in scene["runs"])
    for scene in results["dials"].values():
        assert [dial["dial"] for dial in scene["dials"]] == list(dials(quick=True))
        assert all(run["work"] > 0 for dial in scene["dials"] for run in dial["runs"])
    assert [len(rows) for rows in results["smooth"].values()] == [4, 4]
    (pile,) = results["crowds"]
    same = {(run["engine"], run["substeps"]): run for run in pile["runs"]}
    depths = [same[who]["error"] for who in (("stable", 4), ("stable", 1), ("lesson", 1))]
    assert same["pymunk", 1]["ratio"] == [1, 1, 1] and depths == sorted(depths)


@pytest.mark.soak
def test_the_handout_gets_its_tables(tiny):
    text = (tiny / "handout" / "t.md").read_text(encoding="utf-8")
    assert text.startswith(BEGIN) and text.endswith(f"{END}\n")
    assert "**Every dial of the lesson's engine**" in text
    lines = json.loads((tiny / "handout" / "results.json").read_text(encoding="utf-8"))["t.md"]
    assert lines["tower of 20, lesson, 8 passes: sink"] > 0


@pytest.mark.soak
def test_figures_of_every_result_are_drawn(results, tmp_path):
    results = {**results, "budgets": {"tower": results["budgets"]["tower"]}}
    results["dials"] = {"tower": results["dials"]["tower"]}
    names = ["engines-tower", "smooth-spring", "smooth-energy", "dials-tower"]
    assert ", ".join(names) in figures.draw_figures(make_charts(results), tmp_path)
    for name in names:
        assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")
        assert "<svg" in (tmp_path / f"{name}.svg").read_text(encoding="utf-8")


@pytest.mark.soak
def test_it_runs_in_a_students_folder_with_nothing_done(handed_out, tmp_path):
    command = [sys.executable, "accuracy.py", *TINY, "--no-figures", "--out", str(tmp_path)]
    done = subprocess.run(
        command, cwd=handed_out, capture_output=True, text=True, timeout=600, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    results = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))
    methods = results["smooth"]["spring"]
    assert len({json.dumps(row["points"][-1]["error"]) for row in methods[1:]}) == 1
    assert results["crowds"][0]["runs"][1]["error"] == "falls through"


@pytest.mark.parametrize("scale", ["0", "2", "-1", "nan"])
def test_a_bad_scale_gets_a_sentence(scale, capsys):
    with pytest.raises(SystemExit):
        accuracy.read(["--scale", scale])
    assert "must be above 0 and at most 1" in capsys.readouterr().err


# ---------------------------------------------------------------- tables and the handout


def test_tables_go_between_the_markers_and_nowhere_else(tmp_path):
    path, table = tmp_path / "a.md", Table("One", ["a"], [[1]])
    path.write_text(f"before\n{BEGIN}\nold\n{END}\nafter\n", encoding="utf-8")
    write_markdown(path, [table], {"old": 1})
    write_markdown(path, [table], {"line": 2})
    lines = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))
    assert lines == {"a.md": {"line": 2}}
    assert path.read_text(encoding="utf-8") == (
        f"before\n{BEGIN}\n**One**\n\n| a |\n| --- |\n| 1 |\n{END}\nafter\n"
    )
    path.write_text("no markers\n", encoding="utf-8")
    with pytest.raises(ValueError, match="put them where the tables go"):
        write_markdown(path, [table], {})


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (1234.5, "1234"), (0.05, "0.05"), (3.14159, "3.14"), (9.87e-4, "9.9e-4"),
     (2e9, "2.0e9"), (None, "-"), ("launched", "launched")],
)  # fmt: skip
def test_numbers_have_three_digits(value, text):
    assert number(value) == text


def test_the_figures_of_the_handout_exist():
    shown = accuracy.find_figures(HANDOUT)
    assert len(shown) >= 4
    for name in shown:
        assert (HANDOUT.parent / "figures" / f"accuracy-{name}").exists(), name
