"""Find changed given code, name it in reasons, and restore it by its name."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from command_line import run_grader
from counting import count_calls
from edited_trees import edit_file, grade_todos, set_regions

from grader.cli.restore import find_changes
from grader.judge.explain.blame import MOST_RUNS, CauseSearch
from grader.judge.failures import NotYet
from grader.judge.result import CheckResult
from grader.judge.submission import load_given
from grader.judge.task import KIT, shipped_reference
from grader.judge.wording import list_reasons
from grader.source.definitions import statements
from grader.source.given import (
    GivenChange,
    compare_files,
    first_difference,
    pieces,
    undo_changes,
    with_markers,
)
from grader.source.regions import regions_in

SOLVER, CONSTANTS = "mini_engine/solver.py", "mini_engine/constants.py"
DOUBLED = (SOLVER, "    c.jn = total\n", "    c.jn += total\n")


def restore(tree: Path, *names: str) -> str:
    words = [f"--restore={name}" for name in names]
    return " ".join(run_grader("check", tree, *words).output.split())


def only(file: str, old: str, new: str) -> GivenChange:
    """Return the one change that is found after a replacement in a handed-out file."""
    text = load_given()[file]
    assert text.count(old) == 1
    (found,) = compare_files({file: text.replace(old, new)}, load_given())
    assert undo_changes(text.replace(old, new), [found]).split() == text.split() or not found.theirs
    return found


# ---------------------------------------------------------------- changes


@pytest.mark.parametrize(
    ("file", "old", "new", "name", "theirs", "given"),
    [
        (*DOUBLED, "solve_normal", "c.jn += total", "c.jn = total"),
        (CONSTANTS, "ITERATIONS = 8 ", "ITERATIONS = 80 ", "ITERATIONS", "ITERATIONS = 80", None),
        (CONSTANTS, "WIDTH, HEIGHT = 900", "WIDTH, HEIGHT = 90", "WIDTH, HEIGHT", None, None),
        (SOLVER, "import math\n", "", "import math", "", "import math"),
        (SOLVER, "\ndef arms(", "\ndef arm(", "arms", "", "def arms(c):"),
        (SOLVER, "-c.normal.y, c", "c.normal.y, c", "solve_friction", None, None),
        (
            "mini_engine/world.py",
            "* dt\n        if",
            "\n        if",
            "World.apply_forces",
            None,
            None,
        ),
        ("mini_engine/world.py", "    def pairs", "    def pair", "World.pairs", "", None),
        (
            "mini_engine/world.py",
            "        self.solve(dt)\n        # 4 move\n        self.move(dt)\n",
            "        self.move(dt)\n        self.solve(dt)\n",
            "World.step",
            "self.solve(dt)",
            "self.solve(dt)",
        ),
        (SOLVER, "\ndef arms(", "\nSLOP = 5\n\ndef arms(", "SLOP", "SLOP = 5", ""),
        (SOLVER, "def arms(c):", "def arms(c:", SOLVER, "def arms(c:", "def arms(c):"),
        ("integrators.py", "x + v * dt, v + a", "x + v, v + a", "explicit_euler", None, None),
    ],
)
def test_a_change_has_the_name_of_its_piece_and_its_line(file, old, new, name, theirs, given):
    found = only(file, old, new)
    assert (found.file, found.name) == (file, name)
    assert theirs in (None, found.theirs) and given in (None, found.given)
    assert (
        not found.theirs
        or found.theirs in (load_given()[file].replace(old, new)).splitlines()[found.line - 1]
    )


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("    # END TODO 2\n", "    total *= 2\n    # END TODO 2\n"),
        ("import math\n", "import math\nimport random\n"),
        ("    ra, rb = arms(c)\n    speed", "    ra, rb = arms(c)  # both\n\n    speed"),
        ("The arms of contact c, (ra, rb).", "Two arms."),
        ("\ndef arms(", "\ndef mine():\n    return 5\n\n\ndef arms("),
    ],
)
def test_regions_comments_and_additions_are_no_change(old, new):
    text = load_given()[SOLVER]
    assert text.count(old) == 1
    assert not compare_files({SOLVER: text.replace(old, new)}, load_given())


def test_moved_code_and_unused_imports_are_not_missing():
    """Students may move given code, and leave out an import that nothing reads any more."""
    given = load_given()
    text = given[SOLVER]
    start, stop = text.index("def friction_limit"), text.index("def solve_friction")
    moved = "from .limits import friction_limit\n" + text[:start] + text[stop:]
    assert not compare_files({SOLVER: moved.replace("import math\n", "")}, given)
    name = "mini_engine/__init__.py"  # which re-exports all of them
    lacking = given[name].replace("from .body import Body\n", "")
    (found,) = compare_files({name: lacking}, given)
    assert found.given == "from .body import Body"


def test_the_solution_changes_nothing_that_was_given():
    assert not find_changes(KIT / "solution") and not find_changes(KIT / "starter")


def test_another_change_in_a_file_says_nothing_of_its_todos():
    """Also if the last marker of a region is below the last statement of its function."""
    given, added = load_given(), "\n\nclass Circle:\n    pass\n"
    mine = {name: (KIT / "solution" / name).read_text(encoding="utf-8") for name in given}
    found = compare_files({name: text + added for name, text in mine.items()}, given)
    assert found and {each.name for each in found} == {"Circle"}


# ---------------------------------------------------------------- effects on checks


def list_words(tree: Path, todo: str) -> list[dict[str, str]]:
    """Return the named lines of each failed check of a TODO."""
    (result,) = grade_todos(tree, todo).todos
    return [dict(list_reasons(check, ", TODO")) for check in result.failed]


def test_a_todo_keeps_its_points_where_given_code_is_to_blame(hand_in):
    tree = hand_in("solution")
    edit_file(tree, *DOUBLED)
    edit_file(tree, CONSTANTS, "MAX_BALLS = 40", "MAX_BALLS = 50")  # this does nothing here
    (result,) = grade_todos(tree, "4").todos
    assert result.state == "passed" and result.points == result.max_points
    mended = [check for check in result.checks if check.meaning]
    assert len(mended) >= 4
    for each in mended:
        assert "`c.jn += total`, was `c.jn = total`" in each.meaning
        assert "check --restore solve_normal" in each.meaning and "50" not in each.meaning
        assert (each.where.file, each.where.line) == (SOLVER, 69)


def test_a_todo_that_is_done_in_given_code_earns_nothing_by_what_is_put_back(hand_in):
    """The region does nothing, and the damping of the step is in the code around it."""
    tree = hand_in("solution")
    world = "mini_engine/world.py"
    empty = "        keep_vel = 1.0 + 0.0\n        keep_omega = 1.0 - 0.0"
    set_regions(tree, world, {"5": empty})
    edit_file(tree, world, "        self.move(dt)\n", "        self.move(dt * 1.01)\n")
    (todo,) = grade_todos(tree, "5", reference=shipped_reference()).todos
    assert todo.points == 0


EULER = "return x + v * dt, v + accel(x) * dt"
CALLS = "    x, v = explicit_euler(x, v, dt, accel)\n    return x, v"  # known: not semi-implicit


def integrators(tree: Path, region: str, given: str) -> None:
    """Write TODO 8a so that it calls changed given code."""
    edit_file(tree, "integrators.py", EULER, given)
    set_regions(tree, "integrators.py", {"8a": region})


def test_a_mistake_beside_changed_given_code_is_named_as_well(hand_in):
    """The code to restore comes first, then the known mistake that remains."""
    tree = hand_in("solution")
    integrators(tree, CALLS, "return x + v, v + accel(x) * dt")
    failed = list_words(tree, "8a")
    first = "puts it back: do that first. x moves with the old"
    assert any(first in each["Meaning"] for each in failed)
    assert all("x moves with the old velocity" in each["Meaning"] for each in failed)


def test_given_code_that_has_nothing_to_do_with_it_is_not_named(hand_in):
    tree = hand_in("starter")
    edit_file(tree, CONSTANTS, "MAX_BALLS = 40", "MAX_BALLS = 50")
    integrators(tree, "    return x, v", EULER)
    failed = list_words(tree, "8a")
    assert failed and not any("Given code" in each.get("Meaning", "") for each in failed)
    assert all(each["Look at"].endswith(", TODO") for each in failed)


def test_the_number_of_runs_that_look_for_a_cause_is_limited():
    """Each run costs as much as the check; changes that cannot be separated are named together."""

    class Failing:
        failure, ended, observations = NotYet("ran", "1", "2"), False, ()
        connection = SimpleNamespace(pieces=[])

    def again(key, undone):
        lab = Failing()
        lab.failure = None if len(undone) == 5 else Failing.failure
        return lab

    five = [GivenChange(f"f{n}", "a.py", n, "x", "y", n, n) for n in range(5)]
    failed = {
        ("1", f"c{n}"): CheckResult(f"c{n}", "C", "unit", "not yet", 0, 1, "ran", "1", "2")
        for n in range(40)
    }
    blame = CauseSearch(five, lambda undone: undone, again)
    blame.look_into(failed)
    assert blame.runs == MOST_RUNS and blame.causes.keys() == failed.keys()
    assert blame.answers.keys() == failed.keys()
    assert all(each.mended and each.changes == tuple(five) for each in blame.causes.values())


# ---------------------------------------------------------------- restoring it


def test_a_function_is_restored_and_a_copy_of_the_file_stays(hand_in):
    tree = hand_in("solution")
    edit_file(tree, *DOUBLED)
    changed = (tree / SOLVER).read_bytes()
    out = restore(tree, "solve_normal")
    assert f"{SOLVER}: solve_normal is as it was handed out" in out
    assert "kept as mini_engine/solver_old.py" in out
    assert (tree / "mini_engine" / "solver_old.py").read_bytes() == changed
    right = (KIT / "solution" / SOLVER).read_text(encoding="utf-8")
    assert (tree / SOLVER).read_text(encoding="utf-8") == right
    assert "nothing to restore" in restore(tree, "solve_normal")
    assert sorted(path.name for path in tree.rglob("*_old.py")) == ["solver_old.py"]


def test_a_file_is_put_back_around_the_regions(hand_in):
    tree = hand_in("solution")
    (tree / SOLVER).write_text(
        "# mine\n"
        + (tree / SOLVER).read_text(encoding="utf-8").replace("def arms(c)", "def arms(c"),
        encoding="utf-8",
    )
    assert "its given code is as it was handed out" in restore(tree, SOLVER)
    right = (KIT / "solution" / SOLVER).read_text(encoding="utf-8")
    assert (tree / SOLVER).read_text(encoding="utf-8") == right
    (tree / CONSTANTS).unlink()
    assert "is there again" in restore(tree, CONSTANTS) and (tree / CONSTANTS).is_file()


def test_a_function_that_is_gone_comes_back_and_regions_stay(hand_in):
    tree = hand_in("solution")
    text = (tree / SOLVER).read_text(encoding="utf-8")
    start, stop = text.index("def friction_limit"), text.index("def solve_friction")
    (tree / SOLVER).write_text(text[:start] + text[stop:], encoding="utf-8")
    restore(tree, "friction_limit")
    again = (tree / SOLVER).read_text(encoding="utf-8")
    assert "def friction_limit(c):" in again and not find_changes(tree)
    assert [r.lines for r in regions_in(again)] == [r.lines for r in regions_in(text)]


def test_an_unknown_name_is_refused_and_nothing_is_written(hand_in):
    tree = hand_in("solution")
    edit_file(tree, *DOUBLED)
    before = {path: path.read_bytes() for path in tree.rglob("*.py")}
    out = restore(tree, "nothing_of_the_kind")
    done = run_grader("check", tree, "--restore=nothing_of_the_kind")
    assert done.exit_code == 2 and "nothing to restore" not in out
    assert {path: path.read_bytes() for path in tree.rglob("*.py")} == before


def test_many_regions_and_pieces_take_no_more_than_their_sum():
    """A slow version compared each piece with each region and read all lines between them."""

    def read(count: int) -> int:
        constants = "".join(f"a{number} = 1\n" for number in range(count))
        marks = "".join(f"# TODO {n}: x\nz = 1\n# END TODO {n}\n" for n in range(count))
        text = constants + marks
        found = pieces(statements(text))
        return count_calls(lambda: with_markers(found, text))

    assert read(400) < 3 * read(200)


def test_only_the_first_lines_of_a_long_function_are_compared():
    def read(count: int) -> int:
        mine = [f"y = {number}" for number in range(count)]
        return count_calls(lambda: first_difference(mine, ["pass", "x = 2"] * 60))

    assert read(20_000) == read(2_000)


def test_a_marker_behind_the_last_statement_belongs_to_the_function():
    text = (
        "def f():\n    pass\n    # TODO 1: x\n    # END TODO 1\n"
        "    # TODO 2: y\n    # END TODO 2\n\ny = 1\n    # TODO 3: z\n    # END TODO 3\n"
    )
    found = with_markers(pieces(statements(text)), text)
    assert (found["f"].start, found["f"].stop) == (0, 6)
    assert (found["y"].start, found["y"].stop) == (7, 10)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("    # END TODO 4\n", "    # END TODO 4\n    total = 0\n", "stands outside the region of"),
        ("    # TODO 4:", "    limit = 1\n    # TODO 4:", ""),  # a helper above it
        ("    ra, rb = arms(c)\n    tangent", "    ra, rb = 1, 2\n    tangent", "outside"),
    ],
)
def test_a_line_of_a_todos_function_outside_its_region_is_named(old: str, new: str, says: str):
    given = load_given()[SOLVER]
    (change,) = compare_files({SOLVER: given.replace(old, new, 1)}, {SOLVER: given})
    assert change.todo == "4" and says in change.outside and bool(says) == bool(change.outside)
