"""Test that code that Python refuses costs only points of its own TODO, or of the whole."""

import random
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from edited_trees import edit_file, grade_todos

from grader.judge.rubric import load_rubric
from grader.judge.submission import Submission, load_stubs, take_in
from grader.judge.task import KIT, shipped_reference
from grader.source.flaws import find_bad_bytes, find_flaw
from grader.source.regions import number_lines, read_source, regions_in
from grader.source.repair import MAX_REPAIR, HandedOut, Repairer

SOLVER, CONTACTS = "mini_engine/solver.py", "mini_engine/contacts.py"
SPRINGS, POISON = "mini_engine/bonus/springs.py", b"    # caf\xe9\n"
SIGNS = '()[]{}:"'
Edit = tuple[str, str, str]  # a file, the old text and the new text


def take(tree: Path, copy: Path) -> Submission:
    return take_in(tree, copy)


def list_refused(tree: Path, copy: Path) -> tuple[set[str], set[str]]:
    """Return the TODOs and programs with code that is not Python; check that the rest compiles."""
    taken = take(tree, copy)
    for path in copy.rglob("*.py"):
        compile(path.read_bytes(), path.name, "exec")
    return set(taken.flaws), set(taken.outside)


@pytest.fixture
def programs(tmp_path: Path) -> Callable[[], Path]:
    """Make copies of the solution's programs."""

    def make() -> Path:
        tree = tmp_path / "programs"
        shutil.rmtree(tree, ignore_errors=True)
        shutil.copytree(KIT / "solution" / "mini_engine", tree / "mini_engine")
        for name in ("pymunk_scene.py", "integrators.py", "lab_runtime.py"):
            shutil.copyfile(KIT / "solution" / name, tree / name)
        return tree

    return make


@pytest.mark.parametrize("sign", list("\f\v\x1c\x1d\x1e\x85\u2028\u2029"))
def test_only_python_line_ends_count(sign: str, tmp_path: Path):
    starter = (KIT / "starter" / "integrators.py").read_text(encoding="utf-8")
    right = (KIT / "solution" / "integrators.py").read_text(encoding="utf-8")
    notes = f"# one{sign} two{sign} three\nNOTES = 'four{sign} five'\n"
    broken = right.replace("0.5 * (a_start", "0.5 * ((a_start")
    for name, text, flaws in (("stub", starter, set()), ("broken", broken, {"8b"})):
        tree, plain = tmp_path / name, tmp_path / f"{name}-plain"
        for folder, added in ((tree, notes), (plain, "\n\n")):
            folder.mkdir()
            (folder / "integrators.py").write_text(added + text, encoding="utf-8")
        taken, usual = (take(each, tmp_path / f"{each.name}-copy") for each in (tree, plain))
        assert (taken.begun, taken.where) == (usual.begun, usual.where)
        assert set(taken.flaws) == flaws and not taken.outside


def test_a_page_break_ends_the_indent_before_it():
    text = "\f\ndef f():\n    x = 1\f\n \f    return x\n"
    assert number_lines(text) == "\ndef f():\n    x = 1 \n    return x\n"


def test_a_long_name_in_an_error_is_cut():
    flaw = find_bad_bytes(b"# coding: " + b"a" * 100_000 + b"\n")
    assert flaw is not None and "unknown encoding" in flaw.message and len(flaw.message) < 400


HEAD_2, END_2 = "    # TODO 2: add the spin terms\n", "    # END TODO 2\n"
IN_2, LATER = "total += cross(ra, axis) ** 2", "    return total\n"


FLAWS = [  # a few for the quick run, then the others
    ((SOLVER, IN_2, "total += cross(ra, axis ** 2"), {"2"}, False),
    ((SOLVER, HEAD_2, f"{HEAD_2}    type X = int\n"), {"2"}, False),
    ((SOLVER, "slip = relative_velocity(a, b, ra, rb)", "slip = (a"), set(), True),
    ((SOLVER, END_2, "    x = (1\n"), {"2"}, False),
    ((SOLVER, f"    {IN_2}", IN_2), {"2"}, False),
    ((SOLVER, HEAD_2, f"{HEAD_2}    '''half a text\n"), {"2"}, False),
    ((SOLVER, END_2, f"return total\n{END_2}"), {"2"}, False),
    ((SPRINGS, "        # END TODO B2", "        x = (1\n        # END TODO B2"), {"B2"}, False),
    ((SOLVER, LATER, "return total\n"), set(), True),
    ((SOLVER, "import math", "import math)"), set(), True),
    ((CONTACTS, "class Contact:", "class Contact(:"), set(), True),
]


@pytest.mark.parametrize(
    ("edit", "todos", "outside"),
    [*FLAWS[:4], *(pytest.param(*each, marks=pytest.mark.soak) for each in FLAWS[4:])],
)
def test_a_syntax_error_is_found_where_it_is(programs, tmp_path, edit, todos, outside):
    tree = edit_file(programs(), *edit)
    assert list_refused(tree, tmp_path / "copy") == (todos, {"mini_engine"} if outside else set())


def test_two_broken_todos_and_a_broken_line_are_found(programs, tmp_path: Path):
    tree = edit_file(programs(), SOLVER, IN_2, "total += cross(ra, axis ** 2")
    edit_file(tree, SOLVER, "limit = friction_limit(c)", "limit = friction_limit(c")
    edit_file(tree, SOLVER, "c.jn = total", "c.jn = (total")
    taken = take(tree, tmp_path / "copy")
    lines = (tree / SOLVER).read_text(encoding="utf-8").splitlines()
    assert taken.flaws.keys() == {"2", "4"} and taken.outside.keys() == {"mini_engine"}
    assert "cross(ra, axis **" in lines[taken.flaws["2"].line - 1]
    assert "friction_limit(c" in lines[taken.flaws["4"].line - 1]


@pytest.mark.parametrize(("inside", "todos"), [(True, {"1"}), (False, set())])
def test_bytes_that_are_no_text_are_found_where_they_are(programs, tmp_path, inside, todos):
    path = programs() / CONTACTS
    data = path.read_bytes()
    at = data.index(b"\n", data.index(b"# TODO 1:")) + 1 if inside else 0
    path.write_bytes(data[:at] + POISON + data[at:])
    taken = take(path.parents[1], tmp_path / "copy")
    assert taken.flaws.keys() == todos and bool(taken.outside) != inside
    flaw = next(iter({**taken.flaws, **taken.outside}.values()))
    assert flaw.line == data[:at].count(b"\n") + 1 and "UTF-8" in flaw.advice


def test_an_encoding_that_is_declared_is_no_flaw(programs, tmp_path: Path):
    path = programs() / CONTACTS
    path.write_bytes(b"# coding: latin-1\n" + POISON.strip() + b"\n" + path.read_bytes())
    taken = take(path.parents[1], tmp_path / "copy")
    assert not taken.flaws and not taken.outside


@pytest.mark.soak
@pytest.mark.parametrize("single", [False, True], ids=["package", "single file"])
def test_a_missing_sign_is_found_where_it_is_missing(programs, tmp_path: Path, single: bool):
    """The signs are drawn at random from all files, since there are too many."""
    tree = programs()
    if single:
        shutil.rmtree(tree / "mini_engine")
        source = KIT / "tests" / "bank" / "single_file" / "mini_engine.py"
        shutil.copyfile(source, tree / "mini_engine.py")
    places = [
        (path, at)
        for path in sorted(tree.rglob("*.py"))
        for at, sign in enumerate(read_source(path))
        if sign in SIGNS and path.name != "lab_runtime.py"
    ]
    tried = 0
    for number, (path, at) in enumerate(random.Random(3).sample(places, 8)):
        text = read_source(path)
        broken = text[:at] + text[at + 1 :]
        if find_flaw(broken) is None:
            continue
        line = text[:at].count("\n")
        own = {region.id for region in regions_in(text) if region.start < line < region.stop}
        path.write_text(broken, encoding="utf-8")
        todos, outside = list_refused(tree, tmp_path / f"copy-{number}")
        path.write_text(text, encoding="utf-8")
        where = f"{path.name}:{line + 1}"
        assert todos == own if own else outside, where
        tried += 1
    assert tried >= 5


def test_a_todo_without_markers_is_found_by_its_function(programs, tmp_path: Path):
    tree = programs()
    for path in tree.rglob("*.py"):
        lines = read_source(path).splitlines(keepends=True)
        kept = [line for line in lines if not line.strip().startswith(("# TODO", "# END TODO"))]
        path.write_text("".join(kept), encoding="utf-8")
    edit_file(tree, "mini_engine/joints.py", "self.length = (", "self.(length = (")
    edit_file(tree, SOLVER, IN_2, "total += cross(ra, axis ** 2")
    todos, outside = list_refused(tree, tmp_path / "copy")
    assert todos == {"2"} and outside == {"mini_engine"}


@pytest.mark.parametrize(
    ("line", "version"),
    [
        ("type X = int", "3.12"),
        ("def f[T](x): pass", "3.12"),
        ("print(f'{a['x']}')", "3.12"),
        ("try: pass\nexcept A, B: pass", "3.14"),
        ("t'{x}'", "3.14"),
    ],
)
def test_syntax_of_a_newer_python_is_named(line: str, version: str):
    flaw = find_flaw(line)
    if flaw is None:
        pytest.skip("the Python that runs the tests has it")
    assert f"needs Python {version}" in flaw.advice and "Python 3." in flaw.advice.split("marks")[0]
    assert "needs Python" not in find_flaw("x = ('t' 'f'").advice


def test_repair_of_a_file_is_limited():
    text = "".join(f"def f{n}(:\n    x\n" for n in range(6000))
    repairer = Repairer(HandedOut({}, {}, {}))
    assert repairer.repair(find_flaw(text).in_file("mini_engine.py"), text) is None
    assert repairer.read < MAX_REPAIR + len(text)


# ---------------------------------------------------------------- the marks


@pytest.mark.parametrize(
    "reference",
    [shipped_reference(), pytest.param(None, marks=pytest.mark.soak)],
    ids=["grade", "check"],
)
def test_a_broken_todo_costs_its_own_points(hand_in, reference: Path | None):
    tree = edit_file(hand_in("solution"), SOLVER, IN_2, "total += cross(ra, axis ** 2")
    result = grade_todos(tree, *"25", reference=reference)
    assert {todo.id: todo.state for todo in result.todos} == {"2": "error", "5": "passed"}
    broken = result.todos[0].checks
    assert {check.points for check in broken} == {0} and len({check.got for check in broken}) == 1
    assert "'(' was never closed" in broken[0].got and "Add the bracket" in broken[0].meaning
    assert (broken[0].where.file, broken[0].where.line) == (SOLVER, 30)
    assert "friction" not in broken[0].meaning and "inv_inertia\n" not in broken[0].got


@pytest.mark.soak
def test_code_outside_of_all_todos_costs_the_whole_alone(hand_in):
    tree = edit_file(
        hand_in("solution"), SOLVER, "slip = relative_velocity(a, b, ra, rb)", "slip = ("
    )
    result = grade_todos(tree, "4", "8a", "whole", reference=shipped_reference())
    assert {todo.id for todo in result.todos if todo.state == "passed"} == {"4", "8a"}
    whole = next(todo for todo in result.todos if todo.id == "whole")
    assert 0 < whole.points < whole.max_points
    assert all(check.where and check.meaning for check in whole.failed)


def test_every_todo_has_a_stub():
    """Two programs may each have a function of the same name, such as advance."""
    todos = {todo.id for todo in load_rubric().todos if todo.function}
    assert {f"def {todo}" for todo in todos} <= load_stubs().keys()


def test_a_todo_without_markers_is_mended_where_two_functions_share_a_name(hand_in):
    tree, loop = hand_in("starter"), "mini_engine/game_loop.py"
    for marker in ("    # TODO 6: run whole steps from the accumulator\n", "    # END TODO 6\n"):
        edit_file(tree, loop, marker, "")
    edit_file(tree, loop, "    world.step(STEP)\n", "    world.step(STEP\n")
    assert take(tree, tree.parent / "copy").flaws.keys() == {"6"}
