"""Test that the starter runs unchanged, and with any one TODO finished.

That each stub looks wrong is what its checks test: in the starter all but guards must fail.
"""

import re

import pytest
from mixed_trees import mix_trees
from programs import INTEGRATORS, MINI, PYMUNK, STARTER, TODOS, probe, run_in

SOAK = pytest.mark.soak
LOOPS = {"mini": "mini_engine", "pymunk": "pymunk_scene"}
FRAMES = 120
CLICKS = [[4 * i, "MOUSEBUTTONDOWN", {"pos": [30 * i + 15, 50], "button": 1}] for i in range(25)]

PRINTED = {
    "mini": (MINI, r"Fixed steps: 3\nPendulum length error: \d+\.\d\d px\n"),
    "pymunk": (PYMUNK, r"Fixed steps: 3\nBodies: 13\nBox stack stands: yes\n"),
}


@pytest.mark.parametrize(("program", "lines"), PRINTED.values(), ids=PRINTED)
def test_a_program_of_the_starter_runs_without_a_screen(program, lines):
    assert re.fullmatch(lines, run_in(STARTER, *program, LAB_FRAMES="3"))


@pytest.mark.parametrize("loop", LOOPS.values(), ids=LOOPS)
def test_the_starter_runs_with_many_balls(loop):
    played = probe(STARTER, "play", loop, [17] * FRAMES, CLICKS)
    assert len(played["frames"]) == FRAMES


@pytest.mark.parametrize(
    "todo",
    [todo if todo in ("4", "7b") else pytest.param(todo, marks=SOAK) for todo in TODOS],
)
def test_the_starter_runs_with_one_todo_finished(todo, tmp_path):
    tree = mix_trees(tmp_path / "tree", "starter", "solution", [todo])
    if todo.startswith("8"):
        assert run_in(tree, *INTEGRATORS).count("\n") == 5
    else:
        loop = LOOPS["pymunk" if todo.startswith("7") else "mini"]
        assert len(probe(tree, "play", loop, [17] * FRAMES, CLICKS)["frames"]) == FRAMES
