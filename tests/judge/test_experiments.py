"""The lesson's experiments cost nothing, and the report mentions them."""

import io

import pytest
from edited_trees import edit_file, grade_todos
from rich.console import Console

from grader.judge.task import shipped_reference
from grader.report.sinks.markdown import write_markdown
from grader.report.terminal import Printer

DAMPING = "    space.damping = 0.95"
SOAK = pytest.mark.soak
EXPERIMENTS = [
    ("pymunk_scene.py", DAMPING, f"{DAMPING}\n    space.iterations = 20", "7a"),
    ("mini_engine/constants.py", "ITERATIONS = 8", "ITERATIONS = 2", "whole"),
]
WORDS = [
    "An experiment: space.iterations is 20, not 10.",
    "An experiment: the solver runs 2 passes in a step, not 8.",
]
SLEEP = ("pymunk_scene.py", DAMPING, f"{DAMPING}\n    space.sleep_time_threshold = 0.5", "7a")
SLEEPS = "An experiment: sleep_time_threshold is set, so bodies at rest may sleep."


@pytest.mark.parametrize(
    ("experiment", "words"),
    [
        (SLEEP, SLEEPS),
        *(pytest.param(*each, marks=SOAK) for each in zip(EXPERIMENTS, WORDS, strict=True)),
    ],
)
def test_an_experiment_is_mentioned(hand_in, experiment: tuple[str, str, str, str], words: str):
    file, old, new, todo = experiment
    tree = edit_file(hand_in("solution"), file, old, new)
    result = grade_todos(tree, todo, reference=shipped_reference())
    assert result.points == result.max_points
    assert result.todos[0].notes == [words]
    screen = io.StringIO()
    Printer(Console(file=screen, width=100)).print(result)
    assert words in screen.getvalue()
    assert words.partition(":")[0] in write_markdown(result)
