"""Test the price list of effects: it counts executed code, and undeclared effects are free."""

import json
import platform
import subprocess
import sys
from dataclasses import replace
from itertools import combinations
from operator import itemgetter
from pathlib import Path
from unittest import mock

import pytest

from experiments import effects, effects_report, figures
from experiments.effects import (
    COUNTED,
    EFFECTS,
    LESSON_WORK,
    ROWS,
    STABLE_WORK,
    RepeatedStep,
    count,
)
from experiments.engines import Lesson, Stable
from experiments.measures import deepest_overlap, top_speed
from experiments.opcodes import count_calls, count_opcodes, files_run
from experiments.scenes import DT, Ball
from mini_engine import SLOP

KIT = Path(__file__).parents[2]
SUBSTEPS = 4
SOLVES = (
    2 * SUBSTEPS
)  # a contact, its friction, or a rod is solved and relaxed once in each substep
SMALL, LARGE = 10, 40
FEW = 3  # counts of a step, in piles whose steps cost nearly the same but for a sweep now and then
HEAP = 40
SOAK = pytest.mark.soak
HANDOUT = KIT / "handouts" / "effects.md"
RECORDED = json.loads((HANDOUT.parent / "results.json").read_text("utf-8"))["effects.md"]
SHOWN = 0.005  # share of a number of opcodes, which the handout gives in three digits


@pytest.fixture(scope="module")
def results():
    """Measure two piles: the small one by all steps, of which some cost more, the other by few."""

    def count_few(repeated, work, steps=1):
        if steps == 1 or len(repeated.engine.scene.bodies) < LARGE:
            return count(repeated, work, steps)
        return sorted([count(repeated, work) for _ in range(FEW)], key=itemgetter("opcodes"))[1]

    with mock.patch.object(effects, "count", count_few):
        return effects.measure((SMALL, LARGE), heaps=(HEAP,))


@pytest.fixture(scope="module")
def heap():
    return effects.settled(SMALL)


def prices_of(results):
    """Return the price list of each size, its lines by their titles."""
    return [{line["title"]: line for line in lines} for lines in results["prices"].values()]


# ---------------------------------------------------------------- the counter


def three_opcodes():
    return 1


def busy(times):
    for _ in range(times):
        three_opcodes()


def test_opcodes_are_counted_by_file_and_grow_with_the_work():
    here = Path(__file__).name
    few, more, most = (count_opcodes(lambda n=n: busy(n))[here] for n in (1, 2, 3))
    assert most - more == more - few > 3


def test_the_count_is_the_same_from_run_to_run(heap):
    counts = [
        count(RepeatedStep(Stable(replace(heap, effects=EFFECTS))), STABLE_WORK) for _ in range(2)
    ]
    assert counts[0] == counts[1]


def test_calls_are_counted_by_what_they_go_over():
    watched = [("calls", busy, lambda _: 1), ("rounds", busy, lambda times: times)]
    counts = count_calls(lambda: [busy(5), busy(7)], watched)
    assert counts == {"calls": 2, "rounds": 12}


def test_counting_leaves_no_trace_behind():
    for counter in (count_opcodes, files_run):
        before = sys.gettrace(), sys.getprofile()
        counter(lambda: busy(1))
        with pytest.raises(ZeroDivisionError):
            counter(lambda: 1 / 0)
        assert (sys.gettrace(), sys.getprofile()) == before


# ---------------------------------------------------------------- the pile


def test_the_pile_is_at_rest(heap):
    engine = Stable(heap)
    assert deepest_overlap(engine) < 0.1
    for _ in range(120):
        engine.step(DT)
    assert top_speed(engine) < 3.0


# ---------------------------------------------------------------- the price list


def test_every_effect_is_on_the_list():
    assert {name for row in ROWS for name in row.effects} == set(EFFECTS)


def test_what_was_done_is_what_the_scene_holds(results):
    for title, line in [each for lines in prices_of(results) for each in lines.items()]:
        done = line["done"]
        if title == "all asleep":
            assert not any(done.values())
            continue
        touching = done["contacts"] if "Contacts" in line["effects"] else 0
        assert done["contact solves"] == SOLVES * touching
        assert done["friction solves"] == (
            SOLVES * touching if "Friction" in line["effects"] else 0
        )
        assert done["rod solves"] == (SOLVES * 10 if "Rods" in line["effects"] else 0)
        assert done["spring forces"] == (SUBSTEPS * 10 if "Springs" in line["effects"] else 0)
        assert done["sweeps"] == (10 if title == "10 bullets, fast" else 0)
        looks = "Contacts" in line["effects"] and title != "contacts, nobody moves"
        assert (done["pairs"] >= done["contacts"] > 0) if looks else done["pairs"] == 0


def test_prices_are_differences_and_add_up(results):
    """The parts add up to the whole, within 1 %: no effect makes another more expensive."""
    for lines in prices_of(results):
        parts = sum(lines[title]["price"] for title in results["stacked"])
        assert parts == pytest.approx(lines["all of them together"]["price"], rel=0.01)
        bounce, friction = lines["bounce"], lines["friction"]
        assert bounce["price"] == bounce["opcodes"] - friction["opcodes"] > 0


def test_ten_rods_cost_the_same_among_many_balls(results):
    few, many = prices_of(results)
    for title in ("10 rods", "10 springs"):  # among few balls, more of them share a ball
        assert few[title]["price"] / 1.4 < many[title]["price"] < 1.05 * few[title]["price"]
    assert many["contacts"]["price"] > 2 * few["contacts"]["price"]


def test_sleepers_cost_next_to_nothing_however_many(results):
    asleep = {lines["all asleep"]["opcodes"] for lines in prices_of(results)}
    assert len(asleep) == 1 and max(asleep) < 100


# ---------------------------------------------------------------- the lesson's engine


def test_the_lessons_engine_leaves_out_what_a_scene_has_no_use_for(results):
    lines = {line["title"]: line["done"] for line in results["lesson"]}
    balls = int(results["middle"])
    apart = dict(lines["balls far apart"])
    assert apart.pop("pairs") == balls * (balls - 1) / 2
    assert not any(apart.values())
    smooth, rough = lines["a pile without friction"], lines["with friction"]
    assert smooth["friction solves"] == smooth["damping runs"] == smooth["rod solves"] == 0
    assert rough["friction solves"] == rough["contact solves"] == 8 * rough["contacts"] > 0
    assert lines["with friction and 10 rods"]["rod solves"] == 8 * 10
    assert lines["with friction and damping"]["damping runs"] == 1


def test_the_lessons_engine_looks_at_every_pair_that_can_move(heap):
    pairs = list(combinations(heap.bodies, 2))
    static = [a for a, b in pairs if not (isinstance(a, Ball) or isinstance(b, Ball))]
    done = count(RepeatedStep(Lesson(heap)), LESSON_WORK)["done"]
    assert done["pairs"] == len(pairs) - len(static)


# ---------------------------------------------------------------- bonus tasks


def test_a_packed_pile_touches_no_deeper_than_a_solver_leaves_alone():
    assert 0 < deepest_overlap(Stable(effects.packed(HEAP))) < SLOP


def test_a_grid_looks_at_fewer_pairs_and_finds_the_same_contacts(results):
    before, grid = (line["done"] for line in results["bonus"][str(HEAP)][:2])
    assert 0 < grid["contacts"] <= grid["pairs"] < before["pairs"]
    assert {**grid, "pairs": 0} == {**before, "pairs": 0}


def test_no_pair_of_sleepers_is_looked_at_or_solved(results):
    *awake, asleep = results["bonus"][str(HEAP)]
    assert [line["asleep"] for line in awake] == [0, 0, 0]
    assert asleep["asleep"] == HEAP
    assert not any(asleep["done"].values())


# ---------------------------------------------------------------- output


def test_everything_is_written(results, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(effects, "measure", lambda *_: results)
    page = tmp_path / "page.md"
    page.write_text("Before.\n<!-- tables: begin -->\nold\n<!-- tables: end -->\nAfter.\n")
    effects.main(["--quick", "--out", str(tmp_path), "--markdown", str(page)])
    printed = capsys.readouterr().out
    kept = json.loads((tmp_path / "results.json").read_text())
    assert [line["title"] for line in kept["prices"]["10"]] == [row.title for row in ROWS]
    text = page.read_text()
    assert text.startswith("Before.\n")
    assert text.endswith("After.\n")
    assert "old" not in text
    for row in ROWS:
        assert f"| {row.title} |" in text
        assert row.title in printed


@SOAK
def test_bars_show_every_effect(results, tmp_path):
    bars = [("effects-stacked", effects_report.make_bars(results))]
    assert "effects-stacked" in figures.draw_figures(bars, tmp_path)
    drawn = (tmp_path / "effects-stacked.svg").read_text()
    assert all(title in drawn for title in results["stacked"])
    assert (tmp_path / "effects-stacked.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.soak
def test_it_runs_in_a_students_folder_with_nothing_done(handed_out, tmp_path):
    program = [sys.executable, "-m", "experiments.effects", "--quick"]
    program += ["--out", str(tmp_path)]
    subprocess.run(program, cwd=handed_out, check=True, capture_output=True, timeout=600)
    assert (tmp_path / "results.json").exists()


# ---------------------------------------------------------------- the handout


MEASURED_WITH = pytest.mark.skipif(
    not platform.python_version().startswith(RECORDED["python"] + "."),
    reason=f"needs Python {RECORDED['python']}, whose opcodes the handout has",
)


def find_stale(lines):
    """Return the counts that differ from the handout."""
    assert set(lines) <= set(RECORDED)
    lines.pop("python", None)
    return {
        name: (count, RECORDED[name])
        for name, count in lines.items()
        if count != pytest.approx(RECORDED[name], rel=SHOWN)
    }


@MEASURED_WITH
def test_the_handout_has_what_a_run_counts(results):
    small = results | {"prices": {str(SMALL): results["prices"][str(SMALL)]}}
    stale = find_stale(effects_report.make_lines(small))
    assert not stale, "run experiments.effects --markdown"


@MEASURED_WITH
def test_the_handout_has_what_all_effects_cost_in_a_large_pile():
    """With all effects, each line of the engine that a pile needs is counted."""
    engine = Stable(replace(effects.settled(LARGE), effects=EFFECTS))
    line = count(RepeatedStep(engine), STABLE_WORK, COUNTED)
    stale = find_stale(effects_report.list_step(f"{LARGE} balls, {effects.TOGETHER}", line))
    assert not stale, "run experiments.effects --markdown"


@SOAK
@MEASURED_WITH
def test_the_handout_has_what_the_largest_piles_count():
    lines = effects_report.make_lines(effects.measure())
    assert set(RECORDED) == set(lines)
    assert not find_stale(lines)


def test_the_handout_has_a_line_for_every_row():
    text = HANDOUT.read_text("utf-8")
    for row in ROWS:
        assert f"| {row.title} |" in text, f"{row.title}: run experiments.effects --markdown anew"
