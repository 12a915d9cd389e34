"""Test that students' notebooks hold no answer, and that every test in them can fail."""

import ast
import hashlib
import json
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest
from handed_in import (
    NAMES,
    RELEASED,
    SOURCE,
    fill_answers,
    hand_in,
    kind,
    read,
    release_source,
    replace_in,
    source,
)
from samples import sample

from grader.judge.rubric import load_rubric
from grader.judge.task import KIT
from grader.release.notebooks import PRACTICE, add_practice, make_engine_notebook, tidy

RUNNER = Path(__file__).with_name("run_cells.py")
MISSING = {  # last output of Run All in a handed-out notebook
    "accuracy": ["spring_curves", "by_step", "by_passes", "spring_error", "worst_stretch"],
    "integrators": ["semi_implicit_euler", "velocity_verlet", "rk4"],
    "quiz": [f"answer_{number}" for number in range(1, 9)],
}
ALL = pytest.mark.parametrize("name", NAMES)
KINDS = {
    "code": {"", "locked", "solution", "grade+locked", "grade+solution"},
    "markdown": {"", "grade+solution", "locked+task"},
}


def cells(name, folder=SOURCE):
    return read(folder / f"{name}.ipynb")["cells"]


def details(cell):
    return cell["metadata"]["nbgrader"]


def test_these_are_the_notebooks():
    assert NAMES == ["accuracy", "engine", "integrators", "journal", "quiz"]
    assert sorted(path.stem for path in RELEASED.glob("*.ipynb")) == NAMES


# ---------------------------------------------------------------- nbgrader's rules


@ALL
@pytest.mark.parametrize("folder", [SOURCE, RELEASED], ids=["source", "release"])
def test_cells_say_what_they_are_by_schema_3(name, folder):
    seen = set()
    for cell in cells(name, folder):
        assert kind(cell) in KINDS[cell["cell_type"]], cell["id"]
        if "nbgrader" not in cell["metadata"]:
            continue
        found = details(cell)
        assert found["schema_version"] == 3
        assert found["grade_id"] == cell["id"] and re.fullmatch(r"[\w-]+", cell["id"])
        graded = found["grade"] or found["task"]
        assert (found.get("points", 0) > 0) == graded
        assert cell["id"] not in seen
        seen.add(cell["id"])


@ALL
def test_a_notebook_holds_no_traces_of_a_run(name):
    assert read(SOURCE / f"{name}.ipynb") == tidy(read(SOURCE / f"{name}.ipynb"))


def test_the_engine_notebook_has_the_rubrics_todos_and_points():
    assert read(SOURCE / "engine.ipynb") == make_engine_notebook(load_rubric())
    points = {c["id"]: details(c)["points"] for c in cells("engine") if "task" in kind(c)}
    assert points == {f"todo-{todo.id}": todo.max_points for todo in load_rubric().main_todos}
    assert sum(points.values()) == 100


@ALL
def test_no_graded_cell_ends_in_a_value(name):
    """nbgrader reads a number as points, and any other value as full points."""
    for cell in cells(name):
        if kind(cell) == "grade+locked":
            assert not isinstance(ast.parse(source(cell)).body[-1], ast.Expr), cell["id"]


def test_the_quiz_begins_with_the_pages_questions_for_practice():
    page = (KIT / "handouts" / "quiz.md").read_text(encoding="utf-8")
    notebook = read(SOURCE / "quiz.ipynb")
    assert add_practice(notebook, page) == notebook, "run: make notebooks"
    practice = [cell for cell in notebook["cells"] if cell["id"].startswith(PRACTICE)]
    assert len(practice) == len(re.findall(r"^\*\*\d", page, re.M)) >= 5
    assert all(kind(cell) == "" and source(cell).count("<details>") == 4 for cell in practice)


def test_the_quiz_has_at_least_five_questions_and_the_journal_three():
    assert sum("grade" in kind(cell) for cell in cells("quiz")) >= 5
    journal = [cell for cell in cells("journal") if "grade" in kind(cell)]
    assert len(journal) == 3 and all("solution" in kind(cell) for cell in journal)


@ALL
def test_a_rubric_adds_up_to_the_points_of_the_cell_below_it(name):
    for above, cell in zip(cells(name), cells(name)[1:], strict=False):
        if kind(cell) == "grade+solution":
            rows = re.findall(r"^\| (\d+) \|", source(above), re.MULTILINE)
            assert sum(map(int, rows)) == details(cell)["points"], cell["id"]


# ---------------------------------------------------------------- students' notebooks


@ALL
def test_the_release_is_the_source_without_answers_and_hidden_tests(name):
    ours, theirs = cells(name), cells(name, RELEASED)
    assert [cell["id"] for cell in ours] == [cell["id"] for cell in theirs]
    for cell, given in zip(ours, theirs, strict=True):
        assert source(given).rstrip("\n") == release_source(cell), cell["id"]
        assert kind(given) == kind(cell)
    text = (RELEASED / f"{name}.ipynb").read_text(encoding="utf-8")
    assert "HIDDEN" not in text and "SOLUTION" not in text


@ALL
def test_checksums_tell_nothing_about_what_was_hidden(name):
    """A checksum of the hidden words would let students test guesses."""
    for cell in cells(name, RELEASED):
        if "nbgrader" in cell["metadata"]:
            found = details(cell)
            locked = not found["solution"] and (found["grade"] or found["locked"])
            words = [source(cell), cell["cell_type"]]
            words += [str(found["grade"]), str(found["solution"]), str(locked), cell["id"]]
            words += [str(float(found["points"]))] if found["grade"] else []
            expected = hashlib.md5("".join(words).encode(), usedforsecurity=False).hexdigest()
            assert found["checksum"] == expected, cell["id"]


# ---------------------------------------------------------------- run from top to bottom


def run(folder, name, *options):
    """Run a notebook of a submission; return its failed cells and some of its data."""
    command = [sys.executable, str(RUNNER), str(folder / "notebooks" / f"{name}.ipynb")]
    done = subprocess.run([*command, *options], capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def graded_by_code(name):
    return {cell["id"] for cell in cells(name) if kind(cell) == "grade+locked"}


@pytest.fixture(scope="module")
def complete(tmp_path_factory):
    """Make a submission with every notebook of the source, hidden tests included."""
    folder = tmp_path_factory.mktemp("complete") / "tree"
    return hand_in(folder, "solution", {name: read(SOURCE / f"{name}.ipynb") for name in NAMES})


@pytest.fixture(scope="module")
def run_of(complete):
    """Return a function that runs a notebook of that folder once, with figures."""
    return cache(lambda name: run(complete, name, "--draw"))


@ALL
def test_the_solutions_notebooks_run_without_a_failure(name, run_of):
    found = run_of(name)
    assert found["failed"] == {} and " yet: " not in found["said"]


@ALL
def test_the_starters_fail_only_where_there_is_work_to_do(name, tmp_path):
    notebook = read(RELEASED / f"{name}.ipynb")
    found = run(hand_in(tmp_path / "tree", "starter", {name: notebook}), name)
    hidden_only = {cell["id"] for cell in cells(name) if cell["id"].startswith("swing-")}
    assert set(found["failed"]) == graded_by_code(name) - hidden_only
    missing = re.findall(r"\w+", found["said"].partition(" yet: ")[2])
    assert missing == MISSING.get(name, [])


@pytest.mark.parametrize("name", MISSING)
def test_run_all_goes_past_every_cell_that_may_fail(name):
    """Jupyter stops at a cell that raises, unless its tags allow it."""
    for cell in cells(name, RELEASED):
        if kind(cell) in ("solution", "grade+locked", "grade+solution"):
            may_fail = "raises-exception" in cell["metadata"].get("tags", [])
            assert may_fail == (cell["cell_type"] == "code"), cell["id"]


@pytest.mark.soak
@pytest.mark.parametrize("name", MISSING)
def test_run_all_in_jupyters_own_way_goes_to_the_end(name, tmp_path):
    nbclient = pytest.importorskip("nbclient", reason="comes with the extra notebooks")
    nbformat = pytest.importorskip("nbformat")
    folder = hand_in(tmp_path / "tree", "starter", {name: read(RELEASED / f"{name}.ipynb")})
    notebook = nbformat.read(folder / "notebooks" / f"{name}.ipynb", as_version=4)
    place = {"metadata": {"path": str(folder / "notebooks")}}
    nbclient.NotebookClient(notebook, timeout=600, resources=place).execute()
    (last,) = [cell for cell in notebook.cells if cell.id == "given-standing"]
    assert " yet: " in last.outputs[0].text


def test_the_measured_curves_are_the_lessons(run_of):
    kept = run_of("accuracy")["kept"]
    stretch = {steps // 2: worst for steps, worst in kept["by_step"]}
    for rate, known in ((30, 4.7), (60, 1.3), (120, 0.34), (240, 0.085)):
        assert stretch[rate] == pytest.approx(known, rel=0.08)
    worst = [value for _, value in kept["by_passes"]]
    assert max(worst) == pytest.approx(min(worst), rel=1e-6), "passes do not help a rod"
    for name, order in (("semi_implicit_euler", 1), ("velocity_verlet", 2), ("rk4", 4)):
        (calls, error), (more, less) = kept["spring_curves"][name][-2:]
        assert more == 2 * calls
        assert error / less == pytest.approx(2**order, rel=0.1)


# ---------------------------------------------------------------- wrong answers


WRONG = [
    ("integrators", "answer-8a", "v = v + accel(x) * dt", "x = x + v * dt", "8a"),
    ("integrators", "answer-8b", "a_end = accel(x)", "a_end = a_start", "8b"),
    ("integrators", "answer-8c", "accel(x + dt * v3)", "accel(x + dt * v1)", "8c"),
    ("accuracy", "answer-spring-error", "calls += 1", "calls = steps", "test-spring-error"),
    ("accuracy", "answer-rod-curves", "(30, 60, 120, 240, 480)", "(30, 60, 120)", "rod-curves"),
    ("accuracy", "answer-spring-error", "(v - EXACT[1]) / OMEGA", "0", "test-spring-error"),
    (
        "accuracy",
        "answer-stretch",
        "abs(length - joint.length)",
        "length - joint.length",
        "stretch",
    ),
    ("accuracy", "answer-spring-curves", "range(6)", "range(3)", "spring-curves"),
    ("quiz", "answer-4", '"b"', '"a"', "quiz-4"),
]


@pytest.mark.parametrize(
    ("name", "cell_id", "right", "wrong", "test"),
    sample(WRONG, 4),
)
def test_a_wrong_answer_fails_its_own_test_alone(name, cell_id, right, wrong, test, tmp_path):
    notebook = read(SOURCE / f"{name}.ipynb")
    text = next(source(cell) for cell in notebook["cells"] if cell["id"] == cell_id)
    assert text.count(right) == 1
    replace_in(notebook, cell_id, text.replace(right, wrong))
    failed = run(hand_in(tmp_path / "tree", "solution", {name: notebook}), name)["failed"]
    assert failed and all(test in each for each in failed), failed


def test_another_right_way_of_measuring_is_accepted(tmp_path):
    notebook = fill_answers("accuracy")
    hidden = {cell["id"]: source(cell) for cell in cells("accuracy")}
    for cell in graded_by_code("accuracy"):
        replace_in(notebook, cell, hidden[cell])
    text = '''
def worst_stretch(world, dt, seconds):
    """With a list and a warning."""
    import warnings
    from math import dist

    warnings.warn("measuring", stacklevel=2)
    rod, seen = world.joints[0], []
    while len(seen) < seconds / dt - 0.5:
        world.step(dt)
        seen.append(abs(dist(rod.a.pos, rod.b.pos) - rod.length))
    return len(seen), max(seen)
'''
    replace_in(notebook, "answer-stretch", text)
    folder = hand_in(tmp_path / "tree", "solution", {"accuracy": notebook})
    assert run(folder, "accuracy")["failed"] == {}
