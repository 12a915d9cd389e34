"""Test that starter and solution differ only inside the TODO regions."""

import ast
import shutil
from pathlib import Path

import pytest
from conftest import KIT
from programs import BONUS, SOLUTION, STARTER, TODOS, copy_of, edit, regions

from grader.bank import sync as sync_module
from grader.bank.sync import (
    OutOfStep,
    is_laid_in,
    list_given_files,
    list_students_files,
    sync,
)
from grader.source.regions import RegionError, python_files, regions_in, replace_regions

IN_BOTH = [name for name in list_given_files(SOLUTION) if not is_laid_in(name)]
TREES = pytest.mark.parametrize("tree", [SOLUTION, STARTER], ids=["solution", "starter"])


def empty_regions(path: Path) -> bytes:
    """Return a file without the lines of its regions."""
    content = path.read_bytes()
    if path.suffix != ".py":
        return content
    text = content.decode()
    return replace_regions(text, {region.id: () for region in regions_in(text)}).encode()


# ---------------------------------------------------------------- as they are


def test_sync_finds_nothing_to_do():
    assert sync(SOLUTION, STARTER, write=False) == []


def test_the_starter_has_the_solutions_files_but_those_that_are_laid_in():
    assert list_given_files(STARTER) == IN_BOTH
    assert "mini_engine/world.py" in IN_BOTH


def test_students_get_all_the_files_of_the_solution_and_no_region_of_it():
    files = list_students_files(KIT)
    assert sorted(files) == list_given_files(SOLUTION)
    for name, path in files.items():
        assert path == (SOLUTION if is_laid_in(name) else STARTER) / name
        assert not is_laid_in(name) or path.read_bytes() == empty_regions(path), (
            "a TODO to be handed out"
        )


@TREES
def test_a_tree_has_each_todo_once(tree):
    texts = [path.read_text(encoding="utf-8") for path in python_files(tree)]
    assert sorted(r.id for text in texts for r in regions_in(text)) == sorted(TODOS + BONUS)


@pytest.mark.parametrize("todo", TODOS + BONUS)
def test_a_todo_has_the_same_task_in_both_trees_and_is_done_in_one(todo):
    (name, stub), (right_name, right) = regions(STARTER)[todo], regions(SOLUTION)[todo]
    assert (name, stub.task) == (right_name, right.task)
    assert stub.shape != right.shape


@TREES
def test_regions_hold_whole_statements(tree):
    for path in python_files(tree):
        text = path.read_text(encoding="utf-8")
        statements = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.stmt)]
        for region in regions_in(text):
            inside = range(region.start + 2, region.stop + 1)  # line numbers count from 1
            for node in statements:
                if node.lineno in inside or not hasattr(node, "body"):
                    assert (node.lineno in inside) == (node.end_lineno in inside), region.task


# ---------------------------------------------------------------- when they drift


@pytest.fixture
def copies(tmp_path, monkeypatch):
    """Copy solution and starter in step, with the stubs that the checks know."""
    monkeypatch.setattr(sync_module, "CHECKS", tmp_path)
    trees = copy_of(SOLUTION, tmp_path), copy_of(STARTER, tmp_path)
    sync(*trees, write=True)
    return trees


def contents(tree: Path) -> dict[str, bytes]:
    return {name: (tree / name).read_bytes() for name in list_given_files(tree)}


def rename_dt(tree: Path) -> None:
    edit(tree / "mini_engine/world.py", "def step(self, dt):", "def step(self, seconds):")


CARRIED = ("{} differs from the solution outside its TODO regions", "carried {} over")
REMOVED = ("{} does not belong in the starter", "removed {} from the starter")


@pytest.mark.parametrize(
    ("name", "drift", "said"),
    [
        ("mini_engine/world.py", lambda path: rename_dt(path.parents[1]), CARRIED),
        (
            "mini_engine/joints.py",
            lambda path: edit(path, "# TODO 3: hold", "# TODO 3: x"),
            CARRIED,
        ),
        ("README.md", lambda path: path.write_text("Nothing to do."), CARRIED),
        ("mini_engine/shapes.py", lambda path: path.unlink(), CARRIED),
        ("mini_engine/notes.txt", lambda path: path.touch(), REMOVED),
        ("accuracy.py", lambda path: shutil.copyfile(SOLUTION / "accuracy.py", path), REMOVED),
    ],
    ids=["given line", "task", "without regions", "missing", "left behind", "laid in"],
)
def test_drift_is_noticed_and_repaired(name, drift, said, copies):
    solution, starter = copies
    before = contents(starter)
    drift(starter / name)
    differs, done = (words.format(name) for words in said)
    assert sync(solution, starter, write=False) == [differs]
    assert sync(solution, starter, write=True) == [done]
    assert contents(starter) == before
    assert sync(solution, starter, write=False) == []


def test_a_change_to_given_code_is_carried_over_and_the_stubs_stay(copies):
    solution, starter = copies
    rename_dt(solution)
    stubs = {todo: region.lines for todo, (_, region) in regions(starter).items()}
    sync(solution, starter, write=True)
    assert "def step(self, seconds):" in (starter / "mini_engine/world.py").read_text("utf-8")
    assert {todo: region.lines for todo, (_, region) in regions(starter).items()} == stubs


def test_a_change_to_a_solution_inside_a_region_is_no_drift(copies):
    edit(copies[0] / "mini_engine/world.py", "keep_vel = math.exp(", "keep_vel = 1 * math.exp(")
    assert sync(*copies, write=False) == []


def test_sync_carries_a_changed_stub_to_the_checks(copies):
    edit(copies[1] / "mini_engine/world.py", "keep_vel = 0.99", "keep_vel = 0.98")
    kept = ("stubs.json", "given.json")
    differs = "{}, by which the checks know the starter, is not up to date"
    assert sync(*copies, write=False) == [differs.format(name) for name in kept]
    assert sync(*copies, write=True) == [f"renewed {name} for the checks" for name in kept]
    assert sync(*copies, write=False) == []


def test_a_todo_without_a_stub_stops_sync(copies):
    world = copies[0] / "mini_engine/world.py"
    edit(world, "# TODO 5: ", "# TODO 99: ")
    edit(world, "# END TODO 5", "# END TODO 99")
    with pytest.raises(OutOfStep, match="no stub for TODO 99"):
        sync(*copies, write=True)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("        # END TODO 5\n", "", "never ended"),
        ("        # TODO 5: damp by a rate per second\n", "", "nothing was opened"),
        ("        # END TODO 5\n", "        # TODO 6: nested\n", "inside another one"),
    ],
    ids=["never ended", "never begun", "nested"],
)
@pytest.mark.parametrize("side", [0, 1], ids=["solution", "starter"])
def test_markers_that_do_not_pair_up_stop_sync(side, old, new, said, copies):
    edit(copies[side] / "mini_engine/world.py", old, new)
    before = contents(copies[1])
    with pytest.raises(RegionError, match=said):
        sync(*copies, write=True)
    assert contents(copies[1]) == before
