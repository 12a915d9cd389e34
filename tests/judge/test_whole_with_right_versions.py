"""Run the whole program with right versions of failed TODOs, so that a mistake costs once."""

from pathlib import Path

import pytest
from edited_trees import grade_todos, set_regions

from grader.judge.result import Result, TodoResult
from grader.judge.task import shipped_reference
from grader.source.regions import read_source

WORLD, SOLVER = "mini_engine/world.py", "mini_engine/solver.py"
NO_DAMPING = {"5": "        keep_vel = 1.0 - 0.9\n        keep_omega = 1.0 - 0.9"}


def find_whole(result: Result) -> TodoResult:
    return next(todo for todo in result.todos if todo.id == "whole")


def test_wrong_todos_earn_nothing_in_the_whole_and_are_named(hand_in):
    """Otherwise a line in each TODO would earn the points of the whole."""
    tree = set_regions(hand_in("starter"), WORLD, NO_DAMPING)
    set_regions(tree, "mini_engine/joints.py", {"3": "        self.k = 1.0 * self.k"})
    result = grade_todos(tree, "3", "5", "whole", reference=shipped_reference())
    assert result.points == 0
    (check,) = [each for each in find_whole(result).failed if "stages in their order" in each.title]
    assert "TODO 3 and 5 are not right yet" in check.got


@pytest.mark.soak
def test_without_the_reference_the_whole_names_the_todo(hand_in):
    tree = set_regions(hand_in("solution"), WORLD, NO_DAMPING)
    failed = find_whole(grade_todos(tree, "5", "whole")).failed
    needs_it = [check for check in failed if "TODO 5 is not right yet" in check.got]
    assert needs_it and all("finish it first" in check.meaning for check in needs_it)
    assert all(check.meaning and check.where for check in failed)


@pytest.mark.soak
def test_a_mistake_outside_of_all_todos_is_placed_there(hand_in):
    """It is a student's own program, without given code to restore."""
    source = Path(__file__).parents[1] / "bank" / "single_file" / "mini_engine.py"
    text = read_source(source)
    assert text.count("pygame.K_r") == 1
    tree = hand_in(mini_engine_py=text.replace("pygame.K_r", "pygame.K_q"))
    failed = find_whole(grade_todos(tree, "2", "whole", reference=shipped_reference())).failed
    wrong = next(check for check in failed if check.id == "clicks_drop_balls_and_r_resets")
    assert wrong.where.file == "mini_engine.py" and "code around them" in wrong.meaning
    missing = next(check for check in failed if check.id == "clicks_b_and_r_work_in_pymunk")
    assert "check --restore pymunk_scene.py puts the handed-out one back" in missing.meaning
