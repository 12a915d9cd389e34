"""A TODO 9, added to a copy of the kit by the steps in CONTRIBUTING, and nothing besides."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import KIT

from grader.source.regions import regions_in

pytestmark = pytest.mark.soak

AROUND = '''

def energy(x, v):
    """The energy of the spring in J/kg: of its motion, and of its stretch by x px."""
    # TODO 9: add both kinds of energy
{lines}
    # END TODO 9
    return total
'''
SOLVED, STUB = "    total = 0.5 * v**2 + 0.5 * (OMEGA * x) ** 2", "    total = 0.0"
RUBRIC = """
[[todos]]
id = "9"
title = "The energy of the spring"
module = "integrators"
function = "integrators:energy"
file = "todo_9"
checks = [
  { id = "a_spring_at_rest_has_the_energy_of_its_stretch", points = 1, kind = "unit" },
  { id = "a_spring_in_motion_has_both", points = 1, kind = "unit" },
]
"""
CHECKS = '''"""TODO 9: the energy of the spring."""

import math

from grader.judge.lab import Lab

OMEGA = 2 * math.pi  # rad/s


def a_spring_at_rest_has_the_energy_of_its_stretch(lab: Lab) -> None:
    """A spring at rest has the energy of its stretch"""
    want_energy(lab, 3.0, 0.0)


def a_spring_in_motion_has_both(lab: Lab) -> None:
    """A spring in motion has both kinds"""
    want_energy(lab, 3.0, 10.0)


def want_energy(lab: Lab, x: float, v: float) -> None:
    lab.ran(f"energy({x:g}, {v:g})")
    got = lab.number(lab.call("energy", x, v), "the energy")
    right = 0.5 * (v**2 + OMEGA**2 * x**2)
    lab.want(math.isclose(got, right), f"{right:.3f} J/kg", f"{got:.3f} J/kg")
'''
HINTS = (
    '\n9 = [\n  "Which two things store energy?",\n  "Add them.",\n  "Half of v², and so on.",\n]\n'
)
WRONG = """
[forgets-the-motion]
why = "Forgets the energy of the motion."
code = "total = 0.5 * (OMEGA * x) ** 2"
"""
ROW = "| [9](#todo-9-the-energy-of-the-spring) | 3 | 2 | `integrators.py` | `energy` |\n"
SECTION = """## TODO 9: the energy of the spring

3 minutes · `integrators.py` · `energy`

**What.** Add both kinds.

"""


def add_todo_9(kit: Path) -> None:
    """Steps 1 to 5."""
    for tree, lines in (("solution", SOLVED), ("starter", STUB)):
        edit(
            kit / tree / "integrators.py",
            "\n\ndef main():",
            AROUND.format(lines=lines) + "\n\ndef main():",
        )
    rubric = kit / "grader" / "checks" / "rubric.toml"
    first = '{ id = "overlap_from_outside_points_into_the_box", points = '
    edit(rubric, f"{first}3", f"{first}1")
    edit(rubric, '\n[[todos]]\nid = "whole"', f'{RUBRIC}\n[[todos]]\nid = "whole"')
    (kit / "grader" / "checks" / "todo_9.py").write_text(CHECKS, encoding="utf-8")
    with open(kit / "grader" / "checks" / "hints.toml", "a", encoding="utf-8") as file:
        file.write(HINTS)
    edit(kit / "course.toml", '"8a", "8b", "8c",', '"8a", "8b", "8c", "9",')
    sheet = kit / "handouts" / "lab-sheet.md"
    row = next(
        line for line in sheet.read_text("utf-8").splitlines(True) if line.startswith("| [8c]")
    )
    edit(sheet, row, row + ROW)
    edit(sheet, "## Done when", f"{SECTION}## Done when")
    wrong = kit / "tests" / "bank" / "wrong" / "9.toml"
    wrong.write_text(WRONG, encoding="utf-8")


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{path}: {old!r}"
    path.write_text(text.replace(old, new), encoding="utf-8", newline="\n")


@pytest.fixture(scope="module")
def kit(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("kit")
    none = shutil.ignore_patterns("__pycache__", "build", ".*")
    for name in ("grader", "solution", "starter", "handouts", "tests/bank"):
        shutil.copytree(KIT / name, folder / name, ignore=none)
    for name in ("starter/.gitignore", "starter/.gitlab-ci.yml", "starter/.github"):
        for tree in ("starter", "solution"):
            source = KIT / tree / Path(name).name
            if source.is_dir():
                shutil.copytree(source, folder / tree / source.name)
            elif source.exists():
                shutil.copyfile(source, folder / tree / source.name)
    for name in ("course.toml", "pyproject.toml", "requirements.txt", "LICENSE"):
        shutil.copyfile(KIT / name, folder / name)
    add_todo_9(folder)
    return folder


def run(kit: Path, *words: str, status: int = 0) -> str:
    command = [sys.executable, "-m", "grader", *words]
    settings = {**os.environ, "PYTHONPATH": str(kit), "COLUMNS": "200"}
    done = subprocess.run(command, cwd=kit, env=settings, capture_output=True, text=True)
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout


def test_a_todo_added_by_the_steps_is_asked_everywhere(kit: Path):
    assert "the checks know the starter" in run(kit, "sync", "--check", status=1)
    said = run(kit, "sync")
    assert "renewed stubs.json for the checks" in said and "TODO 9 is new" in said
    assert run(kit, "sync").startswith("nothing to do")

    for tree, points, status in (("solution", 100, 0), ("starter", 0, 1)):
        run(kit, "grade", tree, "--json", f"{tree}.json", status=status)
        result = json.loads((kit / f"{tree}.json").read_text(encoding="utf-8"))
        assert (result["points"], result["max_points"]) == (points, 100)
        (todo,) = (todo for todo in result["todos"] if todo["id"] == "9")
        assert (todo["points"], todo["max_points"]) == (2 if points else 0, 2)

    table = run(kit, "verify", "--only", "9-", "--jobs", "1")
    assert "wrong: 1, of which 0 with a complaint" in table
    assert "Which two things store energy?" in run(kit, "hint", "--todo", "9")

    run(kit, "nbgrader", "course", "build/course")
    source = kit / "build" / "course" / "source" / "physics-engine"
    cells = json.loads((source / "engine.ipynb").read_text(encoding="utf-8"))["cells"]
    assert "todo-9" in [cell["id"] for cell in cells]
    text = (source / "integrators.py").read_text(encoding="utf-8")
    assert {region.id: region.lines for region in regions_in(text)}["9"] == (STUB,)

    code = (
        "from pathlib import Path\nfrom grader.release.build import build\n"
        "import sys; build(Path(sys.argv[1]), [])"
    )
    settings = {**os.environ, "PYTHONPATH": str(kit)}
    command = [sys.executable, "-c", code, str(kit / "build" / "release")]
    subprocess.run(command, cwd=kit, env=settings, check=True)
    tree = kit / "build" / "release" / "physics-engine"
    assert "TODO 9: the energy" in (tree / "handouts" / "lab-sheet.html").read_text("utf-8")
    notebook = (tree / "notebooks" / "engine.ipynb").read_text(encoding="utf-8")
    assert '"todo-9"' in notebook


def test_a_course_that_forgets_it_is_told(kit: Path):
    edit(kit / "course.toml", ' "9",', "")
    assert "course.toml does not name TODO 9" in run(kit, "sync")
    edit(kit / "course.toml", '"8a", "8b", "8c",', '"8a", "8b", "8c", "9",')
