"""accuracy.py: exact answers, measured orders, costs, verdicts, and the program as a whole."""

import json
import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy
import pytest
from scipy.integrate import solve_ivp

import accuracy
import integrators
from experiments import answers, budgets, costs, smooth
from experiments.dials import BOX2D, LESSON, PYMUNK, QUESTIONS, STABLE, dials, hit, questions
from experiments.engines import ENGINES, State
from experiments.measures import swing_energy
from experiments.scenes import G, chain, drop, pendulum
from experiments.table import BEGIN, END, Table, number, times, write_markdown

ROOT = Path(__file__).parents[2]
HANDOUT = ROOT / "handouts" / "accuracy.md"
TINY = ["--quick", "--scale", "0.02"]
SYSTEMS = pytest.mark.parametrize("make", smooth.SYSTEMS)

# ---------------------------------------------------------------- integrators


@SYSTEMS
def test_the_exact_end_agrees_with_a_reference_solution(make):
    system = make()

    def rates(_, state):
        x, v = state
        return [v, system.accel(x)]

    start = numpy.array(system.start, dtype=complex)
    if isinstance(system.start[0], float):  # math.sin takes no complex number
        start = start.real
    span = (0, system.seconds)
    found = solve_ivp(rates, span, start, method="DOP853", rtol=1e-13, atol=1e-13)
    x, v = found.y[:, -1]
    assert smooth.distance(system, x, v) < 1e-8 * system.size


@SYSTEMS
def test_every_method_has_its_order(make):
    study = smooth.study(make())
    for row in study["methods"]:
        if (study["title"], row["method"]) == ("orbit", "explicit_euler"):
            assert row["order"] is None  # still far off at 1/4096 s
        else:
            assert row["order"] == pytest.approx(row["expected"], abs=0.2), row["method"]


def verlet_with_one_force(x, v, dt, accel):
    a = accel(x)
    return x + v * dt + 0.5 * a * dt**2, v + a * dt


def rk4_with_equal_weights(x, v, dt, accel):
    v1, a1 = v, accel(x)
    v2, a2 = v + 0.5 * dt * a1, accel(x + 0.5 * dt * v1)
    v3, a3 = v + 0.5 * dt * a2, accel(x + 0.5 * dt * v2)
    v4, a4 = v + dt * a3, accel(x + dt * v3)
    return x + dt / 4 * (v1 + v2 + v3 + v4), v + dt / 4 * (a1 + a2 + a3 + a4)


@pytest.mark.parametrize(
    ("place", "wrong"), [(2, verlet_with_one_force), (3, rk4_with_equal_weights)]
)
def test_a_wrong_method_misses_its_order(place, wrong):
    methods = list(smooth.METHODS)
    methods[place] = wrong
    row = smooth.study(smooth.spring(), methods)["methods"][place]
    assert row["order"] is None or abs(row["order"] - row["expected"]) > 0.2


def test_calls_of_the_force_are_counted():
    calls = [smooth.measure(smooth.kepler(), m, 1000)["calls"] for m in smooth.METHODS]
    assert calls == [1000, 1000, 1001, 4000]  # Verlet's last evaluation is the next step's first


def test_a_method_that_raises_or_blows_up_is_named_and_does_not_end_the_study():
    def raises(x, v, dt, accel):
        raise TypeError

    assert smooth.measure(smooth.spring(), raises, 10)["error"] == "TypeError"
    grows = smooth.measure(smooth.spring(), lambda x, v, dt, accel: (x * 1e9, v), 100)
    assert grows["error"] == "blown up"
    assert smooth.energy_peaks(raises)[-1] == "TypeError"
    study = smooth.energy_study([raises] * 4)
    assert {row["passes Verlet"] for row in study} == {None}


def test_rk4_drifts_above_verlets_bounded_error_at_equal_evaluations():
    rows = {row["method"]: row for row in smooth.energy_study()}
    rk4, verlet = rows["rk4"], rows["velocity_verlet"]
    assert rk4["peaks"][0] < verlet["peaks"][0] / 10
    assert rk4["peaks"][59] == pytest.approx(1.8e-3, rel=0.15)  # as measured by another program
    assert verlet["peaks"][59] == pytest.approx(6.7e-4, rel=0.05)
    crossing = rk4["passes Verlet"]
    assert 10 < crossing < 60
    assert rk4["peaks"][crossing - 2] <= verlet["peaks"][crossing - 2]
    assert verlet["passes Verlet"] is None


@pytest.mark.parametrize(
    ("peaks", "others", "first"),
    [([1, 2, 3], [2, 2, 2], 3), ([3, 3], [2, 2], 1), ([3, 1], [2, 2], None), (["NaN"], [1], None)],
)
def test_the_round_from_which_an_error_is_larger(peaks, others, first):
    assert smooth.first_above(peaks, others) == first


def test_only_symplectic_methods_keep_the_energy_of_an_orbit_bounded():
    bounded = {row["method"]: row["bounded"] for row in smooth.energy_study()}
    assert bounded == {
        "explicit_euler": False,
        "semi_implicit_euler": True,
        "velocity_verlet": True,
        "rk4": False,
    }


def test_every_engine_falls_as_its_integrator_does():
    rows = smooth.fall_study()
    assert [row["name"] for row in rows[4:]] == list(ENGINES)
    for row in rows:
        digits = 1e-3 if row["name"] == "box2d" else 1e-9  # Box2D has floats of 32 bits
        assert abs(row["off the sum"]) < digits, row["name"]
    errors = {row["name"]: row["error"] for row in rows}
    assert errors["explicit_euler"] == pytest.approx(-G / 240)  # first order: g t dt / 2
    assert errors["semi_implicit_euler"] == pytest.approx(G / 240)
    assert errors["stable"] == pytest.approx(G / 960)


def test_a_wrong_method_does_not_fall_as_it_should():
    methods = [integrators.explicit_euler] * 4
    off = [abs(row["off the sum"]) < 1e-9 for row in smooth.fall_study(methods)[:4]]
    assert off == [True, False, False, False]


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


def rest(x=0.0, y=0.0):
    return State(x, y, 0.0, 0.0, 0.0, 0.0)


def test_an_exact_bounce_has_no_error():
    def at(t):
        speed, start = math.sqrt(2 * G * 290), -math.sqrt(2 * 290 / G)
        while t >= start + 2 * speed / G:
            start, speed = start + 2 * speed / G, speed / 2
        t -= start
        return rest(), State(0.0, -10 - speed * t + G * t**2 / 2, 0.0, G * t - speed, 0.0, 0.0)

    errors = QUESTIONS["rebounds"].ask(Exact(drop(restitution=0.5), at), 2.2, 1 / 120)
    assert max(errors.values()) < 1e-9


def test_an_exact_pendulum_has_no_error():
    system = smooth.pendulum()
    motion = [system.start]
    for _ in range(4 * 480):
        motion.append(integrators.rk4(*motion[-1], 1 / 480, system.accel))

    def at(t):
        angle, turn = motion[round(480 * t)]
        x, y = 140 * math.sin(angle), 140 * math.cos(angle)
        return rest(), State(x, y, y * turn, -x * turn, 0.0, 0.0)

    errors = QUESTIONS["pendulum"].ask(Exact(pendulum(), at), 4, 1 / 480)
    assert errors["stretch"] < 1e-9
    assert errors["energy"] < 1e-6
    assert errors["period"] < 1e-5  # the crossing lies on a chord between two steps


def test_a_sliding_ball_that_never_grips_is_far_off():
    scene = QUESTIONS["slide"].scene()
    engine = Exact(scene, lambda t: (rest(), State(300 * t, -10, 300, 0, 0, 0)))
    errors = QUESTIONS["slide"].ask(engine, 1, 1 / 120)
    assert errors["speed"] == pytest.approx(0.5)
    assert errors["time"] == math.inf


def test_what_falls_through_the_floor_is_no_answer():
    engine = Exact(drop(), lambda t: (rest(), rest(y=50.0)))
    assert QUESTIONS["bounce"].ask(engine, 1, 1 / 120) == {"apex": "falls through"}


def test_the_two_ball_hit_keeps_momentum_and_restitution():
    first, second = hit(speed=300, e=0.8).exact["speeds"]
    assert first + 3 * second == pytest.approx(300)
    assert second - first == pytest.approx(0.8 * 300)


def test_a_quick_run_judges_each_dial_by_the_same_runs_as_a_full_one():
    for few, many in zip(dials(quick=True), dials(quick=False), strict=True):
        assert few[:2] == many[:2]
        assert (few[2][0], few[2][-1]) == (many[2][0], many[2][-1])
        assert set(few[2]) <= set(many[2])
    quick, full = answers.Effort(quick=True), answers.Effort()
    for name in questions(quick=True):
        assert quick.seconds(QUESTIONS[name]) == full.seconds(QUESTIONS[name])
    assert set(QUESTIONS) - set(questions(quick=True)) == {"pile"}
    assert set(questions()) == set(QUESTIONS)


def test_no_digit_costs_less_than_no_work():
    runs = [{"errors": {"x": 1.0}, "opcodes": 0, "ratio": [1.0, 1.0, 1.1]},
            {"errors": {"x": 0.1}, "opcodes": 0, "ratio": [0.9, 0.9, 1.2]}]  # fmt: skip
    assert answers.verdict("x", runs) == {"says": "helps", "digit": [1.0, 1.2]}


def test_a_change_that_chance_alone_may_bring_gives_no_advice():
    runs = [{"errors": {"x": 0.7}, "opcodes": 100}, {"errors": {"x": 0.6}, "opcodes": 120}]
    assert answers.verdict("x", runs)["says"] == "helps"
    assert answers.verdict("x", runs, QUESTIONS["pile"].chance)["says"] == "cannot help"


@pytest.mark.parametrize("quick", [True, False])
def test_every_dial_goes_through_its_engine_as_it_is(quick):
    defaults = {"lesson": LESSON, "stable": STABLE, "pymunk": PYMUNK, "box2d": BOX2D}
    for engine, dial, row in dials(quick):
        settings = [setting for _, setting in row]
        assert defaults[engine] in settings, (engine, dial)
        assert len(set(settings)) == len(settings) >= (2 if dial == "edits" else 3)


# ---------------------------------------------------------------- costs and verdicts


def test_wall_times_are_the_least_of_interleaved_rounds(monkeypatch):
    order, clock = [], SimpleNamespace(now=0.0)
    monkeypatch.setattr(costs, "now", lambda: clock.now)

    class Slow:
        def __init__(self, name, taken):
            self.name, self.taken = name, iter(taken)

        def step(self, dt):
            order.append(self.name)
            clock.now += next(self.taken)

    class Broken:
        def step(self, dt):
            raise ValueError

    runs = [(Slow("a", [3, 1, 2]), 1.0), (Slow("b", [5, 7, 6]), 1.0), (Broken(), 1.0)]
    assert costs.wall_times(runs, 3, 1.0) == [1, 5, None]
    assert "".join(order) == "ababab"


@pytest.mark.parametrize("setting", [LESSON, STABLE])
def test_opcodes_are_the_same_from_run_to_run(setting):
    def counted(setting):
        engine = setting.build(QUESTIONS["stack"].scene())
        for _ in range(30):
            engine.step(setting.dt)
        return costs.opcodes_per_second(engine, setting.dt)

    assert counted(setting) == counted(setting) > 0
    twice = replace(setting, passes=16) if setting is LESSON else replace(setting, substeps=8)
    assert counted(twice) > counted(setting)


def test_solves_follow_the_dials():
    engine = LESSON.build(pendulum())  # one rod, no contacts
    assert LESSON.solves(engine) == 120 * 8
    assert replace(LESSON, passes=16, rate=60).solves(engine) == 60 * 16
    assert STABLE.solves(STABLE.build(pendulum())) == 120 * 4 * 2


def runs_of(*pairs):
    return [
        {"errors": {"e": error}, "ratio": [ratio] * 3, "opcodes": None} for error, ratio in pairs
    ]


@pytest.mark.parametrize(
    ("runs", "says", "digit"),
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
def test_a_verdict_tells_what_one_digit_costs(runs, says, digit):
    found = answers.verdict("e", runs)
    assert found["says"] == says
    assert found["digit"] == (None if digit is None else pytest.approx([digit, digit]))


def test_work_is_counted_in_opcodes_where_there_are_any():
    assert answers.work({"opcodes": 5e6, "ratio": [1.0] * 3}) == [5e6, 5e6]
    assert answers.work({"opcodes": None, "ratio": [1.0, 2.0, 4.0]}) == [1.0, 4.0]


def test_passes_cannot_help_a_pendulum_and_smaller_steps_do():
    question, effort = QUESTIONS["pendulum"], answers.Effort(quick=True)

    def asked(**dial):
        run = answers.answer(question, replace(LESSON, **dial), effort)
        return {**run, "ratio": [1.0] * 3, "opcodes": None}

    passes = [asked(passes=n) for n in (4, 8, 64)]
    steps = [asked(rate=rate) for rate in (60, 120, 240)]
    for error in question.units:
        assert answers.verdict(error, passes)["says"] == "cannot help"
        assert answers.verdict(error, steps)["says"] == "helps"


@pytest.mark.parametrize(
    ("problem", "word"), [(ValueError("NaN"), "NaN"), (TypeError("student"), "TypeError")]
)
def test_an_engine_that_meets_nan_or_raises_gives_up(problem, word):
    def ask(engine, seconds, dt):
        raise problem

    question = replace(QUESTIONS["slide"], ask=ask)
    run = answers.answer(question, LESSON, answers.Effort(quick=True))
    assert set(run["errors"].values()) == {word}


def test_shares_are_taken_repeat_by_repeat():
    slow = [2.0, 20.0, 2.2]  # the machine was busy in the second repeat
    assert costs.shares(slow, [1.0, 10.0, 1.0]) == [2.0, 2.0, 2.2]
    assert costs.shares(None, [1.0]) is None
    assert costs.middle_half([9, 1, 2, 3, 4, 5, 6, 0]) == [2, 3.5, 5]


# ---------------------------------------------------------------- budgets


def ladder(engine, *rungs):
    """Runs with substeps 1, 2, 4 ..., from their errors and times (ms) in each repeat."""
    return [
        {"engine": engine, "substeps": 2**i, "passes": 8, "slop": None, "error": error, "ms": ms}
        for i, (error, ms) in enumerate(rungs)
    ]


def test_within_a_budget_the_best_setting_counts_that_fits_and_repeats_make_a_range():
    runs = ladder("lesson", (8.0, [0.5, 0.6, 0.7]), (2.0, [0.9, 0.8, 1.2]), (0.5, [3.0, 3.0, 3.0]))
    assert budgets.within(runs, "lesson", 1.0) == {"error": 2.0, "range": [2.0, 8.0]}
    assert budgets.within(runs, "lesson", 4.0) == {"error": 0.5, "range": [0.5, 0.5]}
    assert budgets.within(runs, "lesson", 0.1)["error"] == "too slow"
    lost = ladder("lesson", ("falls through", [0.5, 0.5, 0.5]))
    assert budgets.within(lost, "lesson", 1.0)["error"] == "falls through"


def test_an_equal_error_takes_the_cheapest_setting_that_gets_there():
    stable = ladder("stable", (9.0, [1.0, 1.0]), (5.0, [2.0, 2.0]), (2.0, [4.0, 8.0]))
    others = ladder("pymunk", (3.0, [1.0, 1.0]), (1.9, [2.0, 2.0]), (0.1, [6.0, 6.0]))
    found = budgets.equal(stable + others + ladder("box2d", (2.1, [1.0, 1.0])), budgets.ALL)
    rows = {row["engine"]: row for row in found["rows"]}
    assert found["goal"] == 2.0
    assert (rows["pymunk"]["error"], rows["pymunk"]["ratio"]) == (1.9, [0.25, 0.375, 0.5])
    assert (rows["box2d"]["reached"], rows["box2d"]["error"]) == (False, 2.1)
    assert rows["stable"]["ratio"] == [1.0, 1.0, 1.0]


def test_who_is_best_counts_only_where_repeats_tell():
    def scene(**ranges):
        return {"within": {name: [{"range": ends}] for name, ends in ranges.items()}}

    assert budgets.winners(scene(a=[1.0, 2.0], b=[1.5, 3.0], c=[2.5, 4.0])) == ["a", "b"]
    assert budgets.winners(scene(a=[1e-12, 1e-12], b=[1e-10, 1e-10])) == ["a", "b"]
    assert budgets.winners(scene(a=["NaN", "NaN"], b=[7.0, 7.0])) == ["b"]


@pytest.mark.parametrize("setting", [STABLE, PYMUNK])
def test_a_train_speeds_up_as_newtons_laws_say(setting):
    """Two engines that know nothing of the formula come to it as their substeps shrink."""
    question = budgets.SCENES["friction"]

    def error(substeps):
        engine = replace(setting, substeps=substeps).build(question.scene())
        return question.ask(engine, question.seconds, setting.dt)["speed"]

    assert error(16) < min(1e-6, error(1) / 4)


def test_half_a_swing_is_measured_far_finer_than_any_engine_swings():
    """Of a body on the exact path: x = sin t passes 0 every pi seconds."""
    step, period = 1 / 120, 2 * math.pi
    clock = SimpleNamespace(now=1.0)

    class Exact:
        scene = SimpleNamespace(exact={"period": period})

        def step(self, dt):
            clock.now += dt

        def read(self, i):
            return State(math.sin(clock.now), 0, 0, 0, 0, 0)

    assert budgets.half_swing(Exact(), 6.0, step)["half a swing"] < 1e-9


def test_the_energy_of_a_chain_that_hangs_at_rest_is_none():
    engine = STABLE.build(chain(5))
    assert abs(swing_energy(engine, 0.0)) < 1e-9


# ---------------------------------------------------------------- the program


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    """One run of the whole program in this process, with a tiny budget."""
    out = tmp_path_factory.mktemp("accuracy")
    (out / "handout").mkdir()
    handout = str(out / "handout" / "t.md")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(budgets, "QUICK_BUDGETS", (0.02,))
        accuracy.main([*TINY, "--out", str(out), "--no-figures", "--markdown", handout])
    return out


def shortened(results, *names):
    """Results with these questions alone, and no systems: each figure takes its time."""
    few = {name: results["dials"][name] for name in names}
    return {**results, "dials": few, "smooth": {**results["smooth"], "systems": []}}


def test_the_results_are_complete(tiny):
    results = json.loads((tiny / "results.json").read_text(encoding="utf-8"))
    parts = {"about", "budgets", "chain", "smooth", "dials", "piles", "same step", "statements"}
    assert set(results) == parts
    assert list(results["budgets"]) == list(budgets.SCENES)
    for scene in results["budgets"].values():
        assert set(scene["within"]) == set(budgets.families())
        assert all(len(run["ms"]) == 3 for run in scene["runs"])
    assert set(results["dials"]) == set(questions(quick=True))
    for name, found in results["dials"].items():
        assert len(found["dials"]) == len(dials(quick=True))
        assert sum(run["default"] for run in found["runs"]) == 1
        for run in found["runs"]:
            assert set(run["errors"]) == set(QUESTIONS[name].units)
            assert min(run["ms"]) > 0
            assert (run["opcodes"] is None) == (run["engine"] in ("pymunk", "box2d"))
        for row in found["dials"]:
            assert set(row["verdicts"]) == set(QUESTIONS[name].units)
    assert [len(row["methods"]) for row in results["smooth"]["systems"]] == [4, 4, 4]
    assert results["piles"][0]["asleep"]["asleep"] == 8
    assert results["piles"][0]["stable"]["overlap"] < results["piles"][0]["lesson"]["overlap"]
    (race,) = results["same step"]
    same = {(row["engine"], row["substeps"]): row for row in race["rows"]}
    depths = [same[who]["overlap"] for who in (("stable", 4), ("stable", 1), ("lesson", 1))]
    assert same["pymunk", 1]["ratio"] == [1, 1, 1] and depths == sorted(depths)


def test_the_handout_gets_its_tables(tiny):
    text = (tiny / "handout" / "t.md").read_text(encoding="utf-8")
    assert text.startswith(BEGIN) and text.endswith(f"{END}\n")
    assert "| tower of 20 balls |" in text
    lines = json.loads((tiny / "handout" / "results.json").read_text(encoding="utf-8"))["t.md"]
    assert lines["tower of 20 balls: sink, lesson as it is"] > 0


def test_figures_of_every_result_are_drawn(tiny):
    from experiments import figures

    results = json.loads((tiny / "results.json").read_text(encoding="utf-8"))
    results = shortened(results, "tower")
    names = figures.draw_all(results, tiny)
    assert names[0] == "budgets"
    assert {"engines-tower", "smooth-energy", "dials-tower-sink"} <= set(names)
    for name in names:
        assert (tiny / f"{name}.png").read_bytes().startswith(b"\x89PNG")
        assert "<svg" in (tiny / f"{name}.svg").read_text(encoding="utf-8")


def test_a_slim_picture_says_the_same_in_fewer_bytes():
    from experiments import figures

    mark = '<path d="M 0.123456 2.5" style="stroke: red"/>'
    line = '<g id="text_1"><text style="fill: blue">0.0001</text></g>'
    svg = f'<svg><style>* {{}}</style><path id="m1"/>{3 * mark}{line}</svg>'
    slim = figures.slim(svg)
    assert '<text style="fill: blue">0.0001</text>' in slim  # what is read stays as it is
    assert slim.count('<path d="M 0.12 2.5" class="s0"/>') == 3
    assert "* {}.s0{stroke: red}</style>" in slim and 'id="m1"' in slim and "text_1" not in slim


def test_piles_of_several_sizes_are_drawn_with_the_engines_that_ran(tiny, tmp_path):
    from experiments import figures

    results = json.loads((tiny / "results.json").read_text(encoding="utf-8"))
    row = results["piles"][0]
    compiled = {**row, "balls": 40, "compiled": row["stable"]}
    for piles in ([row, {**row, "balls": 40}], [{**compiled, "balls": 8}, compiled]):
        results = {**shortened(results), "budgets": {}, "piles": piles}
        assert "piles" in figures.draw_all(results, tmp_path)


def test_without_matplotlib_one_sentence_says_how_to_get_figures(tiny, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    results = json.loads((tiny / "results.json").read_text(encoding="utf-8"))
    accuracy.draw(results, tiny, SimpleNamespace(step=print, end=print))
    assert "install matplotlib" in capsys.readouterr().out


@pytest.mark.soak
def test_it_runs_in_a_students_folder_with_nothing_done(handed_out, tmp_path):
    command = [sys.executable, "accuracy.py", *TINY, "--no-figures", "--out", str(tmp_path)]
    done = subprocess.run(
        command, cwd=handed_out, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    results = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))
    methods = results["smooth"]["systems"][0]["methods"]
    assert len({json.dumps(row["points"][-1]["error"]) for row in methods[1:]}) == 1
    assert results["piles"][0]["lesson"]["overlap"] == "falls through"


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
    assert times(2.5) == "2.5x"


def test_the_figures_of_the_handout_exist():
    shown = accuracy.figures_shown(HANDOUT)
    assert len(shown) >= 4
    for name in shown:
        assert (HANDOUT.parent / "figures" / f"accuracy-{name}").exists(), name


@pytest.mark.parametrize("name", ["stack", "pendulum"])
def test_the_handout_says_what_a_run_gives(name):
    question = QUESTIONS[name]
    error, unit = next(iter(question.units.items()))
    text = HANDOUT.read_text(encoding="utf-8")
    table = text.split(f"**{question.title}: {error} ({unit})**")[1].split("**")[0]
    for setting in (LESSON, STABLE, PYMUNK):
        run = answers.answer(question, setting, answers.Effort())
        assert number(run["errors"][error]) in table
