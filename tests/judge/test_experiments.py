"""The lesson's experiments cost nothing, and the report mentions them."""

import io
import shutil
from pathlib import Path

import pytest
from rich.console import Console

from grader.bank.verify import shared_worker
from grader.judge.grade import KIT, Options, grade, shipped_reference
from grader.report.sinks.markdown import write_markdown
from grader.report.terminal import Printer


@pytest.mark.parametrize(
    ("file", "old", "new", "todo", "words"),
    [
        pytest.param(
            "pymunk_scene.py",
            "    space.damping = 0.95",
            "    space.damping = 0.95\n    space.iterations = 20",
            "7a",
            "An experiment: space.iterations is 20, not 10.",
            marks=pytest.mark.soak,
        ),
        (
            "pymunk_scene.py",
            "    space.damping = 0.95",
            "    space.damping = 0.95\n    space.sleep_time_threshold = 0.5",
            "7a",
            "An experiment: sleep_time_threshold is set, so bodies at rest may sleep.",
        ),
        pytest.param(
            "mini_engine/constants.py",
            "ITERATIONS = 8",
            "ITERATIONS = 2",
            "whole",
            "An experiment: the solver runs 2 passes in a step, not 8.",
            marks=pytest.mark.soak,
        ),
    ],
)
def test_an_experiment_is_mentioned(
    tmp_path: Path, file: str, old: str, new: str, todo: str, words: str
):
    tree = tmp_path / "tree"
    shutil.copytree(KIT / "solution", tree)
    text = (tree / file).read_text("utf-8")
    assert text.count(old) == 1
    (tree / file).write_text(text.replace(old, new), "utf-8")
    options = Options(shipped_reference(), only=frozenset({todo}), trusted=True)
    result = grade(tree, options, shared_worker())
    assert result.points == result.max_points
    assert result.todos[0].notes == [words]
    console = Console(file=io.StringIO(), width=100)
    Printer(console).print(result)
    assert words in console.file.getvalue()  # type: ignore[attr-defined]
    assert words.partition(":")[0] in write_markdown(result)
