"""Test that results.json has the errors of the current engines."""

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from experiments.accuracy.crowds import CROWDS, choose_settings
from experiments.accuracy.questions import (
    LESSON,
    QUESTIONS,
    STABLE,
    Question,
    Setting,
    dials,
    families,
    measure_stretch,
)
from experiments.accuracy.runs import EXACT, Effort, run_setting
from experiments.engines import Lesson
from experiments.measures import run
from experiments.scenes import DT, on_floor, pendulum

HANDOUTS = Path(__file__).parents[2] / "handouts"
LINES: dict[str, Any] = json.loads((HANDOUTS / "results.json").read_text("utf-8"))["accuracy.md"]
DOUBLINGS = 16  # substeps: more do not fit into a frame
QUICK = 170_000  # solves of a body: the stable engine takes about a second
AGAIN = "run accuracy.py --markdown"


def name_lines() -> Iterator[tuple[str, Question, Setting]]:
    """Yield every question and setting of accuracy.py with the name of its line.

    Machine code is left out: it has the same bits as the plain source.
    """
    ladders = [setting for family in families().values() for setting in family]
    tried = [replace(one, substeps=2**n) for one in ladders for n in range(DOUBLINGS)]
    tried += [setting for row in dials().values() for setting in row.values()]
    for question in QUESTIONS.values():
        for setting in dict.fromkeys(tried):
            yield name_line(question, setting), question, setting


def name_line(question: Question, setting: Setting) -> str:
    """Return the name of the error in one setting, as in claims.toml."""
    return f"{question.title}, {setting}: {question.error}"


def is_quick(question: Question, setting: Setting) -> bool:
    """Return true for unchanged engines, and if a frame of the stable one is short."""
    steps = question.seconds * setting.rate * setting.substeps
    short = 2 * steps * len(question.scene().bodies) < QUICK
    return setting == LESSON or (setting.engine == STABLE.engine and short)


RUNS = [
    pytest.param(*line, id=line[0], marks=() if is_quick(*line[1:]) else pytest.mark.soak)
    for line in name_lines()
    if line[0] in LINES
]


@pytest.mark.parametrize(("name", "question", "setting"), RUNS)
def test_an_error_is_what_its_engine_gives(name: str, question: Question, setting: Setting) -> None:
    error = run_setting(question, setting, Effort())["error"]
    assert error == pytest.approx(LINES[name], rel=1e-6, abs=EXACT), AGAIN


@pytest.mark.soak
@pytest.mark.parametrize("question", CROWDS, ids=lambda question: question.title)
def test_an_error_of_a_crowd_is_what_its_engine_leaves(question: Question) -> None:
    for setting in choose_settings():
        error = run_setting(question, setting, Effort())["error"]
        assert error == pytest.approx(LINES[name_line(question, setting)], rel=1e-6), AGAIN


CELL = re.compile(r"(.*), (lesson|stable|compiled|pymunk): (.*) within \d+ ms, (least|most)")


def test_every_cell_of_the_table_is_the_error_of_a_line() -> None:
    """Box2D is excluded: it may be missing."""
    cells = [(CELL.fullmatch(name), error) for name, error in LINES.items()]
    known = [(found, error) for found, error in cells if found]
    assert len(known) == 2 * 3 * 4 * len(QUESTIONS)
    for found, error in known:
        title, engine, what, _ = found.groups()
        runs = [
            other
            for name, other in LINES.items()
            if name.startswith(f"{title}, {engine}") and name.endswith(f": {what}")
        ]
        assert error in runs, found[0]


# ---------------------------------------------------------------- the lesson's engine in hard cases


def is_on_page(says: str) -> bool:
    return says in " ".join((HANDOUTS / "hard-cases.md").read_text("utf-8").split())


def test_half_the_step_makes_the_stretch_of_a_rod_four_times_smaller() -> None:
    def stretch(**dials: int) -> float:
        return measure_stretch(Lesson(pendulum(140, 90), **dials), 2, DT)

    assert is_on_page("Half the step makes that four times smaller; more passes do nothing.")
    assert stretch() == pytest.approx(4 * stretch(substeps=2), rel=0.02)
    assert stretch() == stretch(passes=64)


def test_rolling_is_half_a_per_cent_slow() -> None:
    engine = Lesson(on_floor(vel=(300.0, 0.0)))
    run(engine, 3)
    assert is_on_page("**Rolling is half a per cent slow.**")
    assert 1 - engine.read(1).vx / 200 == pytest.approx(0.005, abs=0.0005)
