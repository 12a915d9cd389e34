"""Add a TODO 9 to a copy of the kit by the steps in CONTRIBUTING, and use it everywhere."""

import json
import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from conftest import KIT

from grader.source.regions import regions_in

pytestmark = pytest.mark.soak

FUNCTION = '''

def amplitude(x, v):
    """Return how far (px) the spring swings out: x in px, v in px/s.

    All of the energy is then in the stretch.
    """
    # TODO 9: the farthest stretch
{line}
    # END TODO 9
'''
SOLVED, STUB = "    return math.hypot(x, v / OMEGA)", "    return 0.0"
RUBRIC = """
[[todos]]
id = "9"
title = "How far a spring swings"
module = "integrators"
function = "integrators:amplitude"
folder = "todo_9"
hints = [
  "Where is the body when it stops?",
  "All of its energy is in the stretch.",
  "Add the squares of `x` and of `v / OMEGA`, and take the root.",
]
checks = [
  { id = "a_spring_at_rest_swings_as_far_as_it_is_stretched", points = 1, kind = "unit" },
  { id = "a_spring_in_motion_swings_farther", points = 1, kind = "unit" },
]
"""
CHECKS = '''"""TODO 9: how far a spring swings."""

import math

from grader.judge.lab import Lab

OMEGA = 2 * math.pi  # rad/s


def a_spring_at_rest_swings_as_far_as_it_is_stretched(lab: Lab) -> None:
    """A spring at rest swings as far as it is stretched"""
    want_amplitude(lab, lab.about(3.0), 0.0)


def a_spring_in_motion_swings_farther(lab: Lab) -> None:
    """A spring in motion swings farther than it is stretched"""
    want_amplitude(lab, lab.about(3.0), lab.about(30.0))


def want_amplitude(lab: Lab, x: float, v: float) -> None:
    """Compare the amplitude with the closed form (px)."""
    lab.ran(f"amplitude({x:g}, {v:g})")
    got = lab.number(lab.call("amplitude", x, v), "the amplitude")
    right = math.sqrt(x**2 + (v / OMEGA) ** 2)
    lab.want(math.isclose(got, right), f"{right:.3f} px", f"{got:.3f} px")
'''
WRONG = """# Mistakes in TODO 9.

[forgets-the-motion]
why = "Returns the present stretch."
code = "return abs(x)"
"""
SHEET_ROW = (
    "| [9](#todo-9-how-far-a-spring-swings) | 3 | 2 | `integrators.py` | `amplitude` | 100 px |\n"
)
SECTION = """## TODO 9: how far a spring swings

3 minutes · `integrators.py` · `amplitude`

**What.** When the body stops, all of its energy is in the stretch.

- [ ] `make check TODO=9` says `PASSED`.

Stuck? `make hint TODO=9`, or [the hints](hints.md#todo-9-how-far-a-spring-swings).

"""


def add_todo_9(kit: Path) -> None:
    """Edit the files of steps 1 to 4."""
    for tree, line in (("solution", SOLVED), ("starter", STUB)):  # 1
        put_before(kit / tree / "integrators.py", "\n\ndef main():", FUNCTION.format(line=line))
    rubric = kit / "grader" / "checks" / "rubric.toml"  # 2
    first = '{ id = "overlap_from_outside_points_into_the_box", points = '
    edit(rubric, f"{first}3", f"{first}1")
    put_before(rubric, '\n[[todos]]\nid = "whole"', RUBRIC)
    checks = kit / "grader" / "checks" / "todo_9" / "checks.py"
    checks.parent.mkdir()
    checks.write_text(CHECKS, encoding="utf-8", newline="\n")
    sheet = kit / "handouts" / "lab-sheet.md"  # 3
    edit(
        sheet,
        "(#todo-1-circle-against-box) | 10 | 16 |",
        "(#todo-1-circle-against-box) | 10 | 14 |",
    )
    put_before(sheet, "\n<!--% if every %-->\nTen more points", SHEET_ROW)
    put_before(sheet, "## Done when", SECTION)
    wrong = kit / "tests" / "bank" / "wrong" / "9.toml"  # 4
    wrong.write_text(WRONG, encoding="utf-8", newline="\n")


def put_before(path: Path, place: str, text: str) -> None:
    edit(path, place, text + place)


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{path}: {old!r}"
    path.write_text(text.replace(old, new), encoding="utf-8", newline="\n")


@pytest.fixture(scope="module")
def kit(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("kit") / "kit"
    none = shutil.ignore_patterns("__pycache__", "build", ".git", ".venv", ".*_cache")
    shutil.copytree(KIT, folder, ignore=none)
    add_todo_9(folder)
    make_the_rest(folder)
    return folder


def make_the_rest(kit: Path) -> None:
    """Run the commands of step 5, as make does."""
    said = run_grader(kit, "sync")
    assert "renewed stubs.json for the checks" in said and "TODO 9 is new" in said
    assert (
        "made grader/checks/todo_9/__init__.py" in said and "course.toml names what is new" in said
    )
    run(kit, "handouts/make_hints.py")
    run(kit, "handouts/make_films.py")
    # Without nbgrader, the solution's notebooks are renewed, and the starter's are not.
    run_grader(kit, "nbgrader", "release", status=0 if find_spec("nbgrader") else 2)


def run(kit: Path, *words: str, status: int = 0) -> str:
    """Run Python in the copy, and return its output."""
    course = str(kit / "course.toml")
    settings = {**os.environ, "PYTHONPATH": str(kit), "COLUMNS": "200", "COURSE_FILE": course}
    command = [sys.executable, *words]
    done = subprocess.run(command, cwd=kit, env=settings, capture_output=True, text=True)
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout


def run_grader(kit: Path, *words: str, status: int = 0) -> str:
    return run(kit, "-m", "grader", *words, status=status)


HOLDING_IDS = (  # tests that hold ids, points or names of TODOs
    "tests/trees/test_parity.py",
    "tests/trees/test_starter.py",
    "tests/judge/test_grade.py",
    "tests/judge/test_course.py",
    "tests/handouts/test_handouts.py",
    "tests/handouts/test_films.py",
    "tests/bank/test_mutants.py",
    "tests/cli/test_cli.py::test_there_are_three_hints_for_every_todo",
    "tests/bank/test_bank.py::test_trees_and_rubric_have_nothing_to_complain_of",
)


def test_a_todo_added_by_the_steps_is_asked_everywhere(kit: Path):
    assert run_grader(kit, "sync").startswith("nothing to do")
    for tree, points, status in (("solution", 100, 0), ("starter", 0, 1)):
        run_grader(kit, "grade", tree, "--json", f"{tree}.json", status=status)
        result = json.loads((kit / f"{tree}.json").read_text(encoding="utf-8"))
        assert (result["points"], result["max_points"]) == (points, 100)
        (todo,) = (todo for todo in result["todos"] if todo["id"] == "9")
        assert (todo["points"], todo["max_points"]) == (2 if points else 0, 2)
        (kit / f"{tree}.json").unlink()

    table = run_grader(kit, "verify", "--only", "9-", "--jobs", "1")
    assert "wrong: 1, of which 0 with a complaint" in table
    assert "Where is the body when it stops?" in run_grader(kit, "hint", "--todo", "9")

    run_grader(kit, "nbgrader", "course", "build/course", "--without-checks")
    source = kit / "build" / "course" / "source" / "physics-engine"
    cells = json.loads((source / "engine.ipynb").read_text(encoding="utf-8"))["cells"]
    assert "todo-9" in [cell["id"] for cell in cells]
    text = (source / "integrators.py").read_text(encoding="utf-8")
    assert {region.id: region.lines for region in regions_in(text)}["9"] == (STUB,)

    code = (
        "from pathlib import Path\nfrom grader.release.build import build\n"
        "import sys; build(Path(sys.argv[1]), [])"
    )
    run(kit, "-c", code, str(kit / "build" / "release"))
    tree = kit / "build" / "release" / "physics-engine"
    assert "TODO 9: how far" in (tree / "handouts" / "lab-sheet.html").read_text("utf-8")


@pytest.mark.parametrize("file", HOLDING_IDS)
def test_the_kits_own_tests_pass_with_it(kit: Path, file: str):
    run(kit, "-m", "pytest", "-q", "-x", file)


def test_a_course_that_forgets_it_is_told(kit: Path):
    edit(kit / "course.toml", '  "9",\n', "")
    assert "course.toml does not name TODO 9" in run_grader(kit, "sync")
    edit(kit / "course.toml", '"8a", "8b", "8c",', '"8a", "8b", "8c", "9",')
