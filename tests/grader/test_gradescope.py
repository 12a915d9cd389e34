"""The zip for Gradescope, unpacked into a clean folder and run as Gradescope runs it."""

import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import ci_readers
import msgspec
import pytest

from grader.classroom.gradescope import NoWheels, write_autograder
from grader.classroom.gradescope.autograder import Settings
from grader.judge.grade import KIT
from grader.judge.result import CheckResult, Result, TodoResult
from grader.report.sinks.gradescope import gradescope

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Gradescope's machines run Linux")

FORGED = """
import os, signal
place = {place!r}
for target in (place, os.path.dirname(place) + "/stdout"):
    try:
        open(target, "w").write('{{"score": 100, "tests": []}}')
    except OSError:
        pass
print('{{"score": 100, "tests": []}}', flush=True)
os._exit(0)
"""


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("zip") / "autograder.zip"
    write_autograder(path, Settings())
    return path


@pytest.fixture
def top(archive: Path, tmp_path: Path) -> Path:
    """/autograder as Gradescope lays it out, with this Python in the place of the one set up."""
    lay_out(archive, tmp_path)
    python = tmp_path / "python" / "bin" / "python"
    python.parent.mkdir(parents=True)
    python.write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    python.chmod(0o755)
    return tmp_path


def lay_out(archive: Path, top: Path) -> None:
    with zipfile.ZipFile(archive) as opened:
        opened.extractall(top / "source")
        modes = {each.filename: each.external_attr >> 16 for each in opened.infolist()}
    for name in ("setup.sh", "run_autograder"):
        (top / "source" / name).chmod(modes[name])
    shutil.copy(top / "source" / "run_autograder", top / "run_autograder")
    (top / "results").mkdir()
    (top / "submission").mkdir()


def hand_in(top: Path, tree: str) -> Path:
    """What a student uploads often has a folder around it."""
    target = top / "submission" / "engine"
    shutil.copytree(KIT / tree, target, ignore=shutil.ignore_patterns("__pycache__", ".*"))
    return target


def run(top: Path, expected: int = 0) -> dict[str, Any]:
    environment = {"PATH": os.environ["PATH"]}
    done = subprocess.run(
        [top / "run_autograder", top], cwd=top, env=environment, capture_output=True, text=True
    )
    assert done.returncode == expected, done.stdout + done.stderr
    (top / "log").write_text(done.stdout)
    results = json.loads((top / "results" / "results.json").read_bytes())
    assert isinstance(results, dict) and results["stdout_visibility"] == "hidden"
    return results


# ---------------------------------------------------------------- the zip


def test_scripts_lie_at_the_root_ready_to_run(archive: Path):
    with zipfile.ZipFile(archive) as opened:
        for name in ("setup.sh", "run_autograder"):
            assert opened.getinfo(name).external_attr >> 16 == 0o100755
            content = opened.read(name)
            assert content.startswith(b"#!/bin/sh\n") and b"\r" not in content
        names = opened.namelist()
    assert "solution/mini_engine/world.py" in names and "grader/checks/rubric.toml" in names
    assert not [each for each in names if "__pycache__" in each or each.startswith(("/", "."))]


def test_the_same_kit_makes_the_same_zip(archive: Path, tmp_path: Path):
    write_autograder(tmp_path / "again.zip", Settings())
    assert (tmp_path / "again.zip").read_bytes() == archive.read_bytes()


def test_settings_are_in_it(tmp_path: Path):
    write_autograder(tmp_path / "own.zip", Settings("strict", 4711))
    with zipfile.ZipFile(tmp_path / "own.zip") as opened:
        found = msgspec.json.decode(opened.read("settings.json"), type=Settings)
    assert found == Settings("strict", 4711)


# ---------------------------------------------------------------- grading


@pytest.mark.parametrize(("tree", "points"), [("solution", 100), ("starter", 0)])
def test_a_submission_gets_its_points(top: Path, tree: str, points: int):
    hand_in(top, tree)
    results = run(top)
    tests = ci_readers.gradescope_tests(results)
    assert results["score"] == points
    counted = [test["max_score"] for test in tests if "max_score" in test]
    assert sum(counted) == 100
    assert f"{points} / 100" in (top / "log").read_text()


def test_a_hostile_submission_cannot_reach_the_marks(top: Path):
    """It loses the 6 points of the file that it gave up for the attack, and wins none."""
    engine = hand_in(top, "solution")
    place = str(top / "results" / "results.json")
    (engine / "integrators.py").write_text(FORGED.format(place=place))
    results = run(top)
    assert results["score"] == 94
    failed = [test for test in ci_readers.gradescope_tests(results) if test["status"] == "failed"]
    assert {test["number"].partition(".")[0] for test in failed} == {"8a", "8b", "8c"}


def test_what_cannot_be_graded_gets_the_reason(top: Path):
    (top / "submission" / "work.zip").write_bytes(b"no zip")
    results = run(top)
    assert results["score"] == 0
    assert results["output"].startswith("This could not be graded: ")


def test_a_fault_of_the_grader_is_no_mark_that_looks_like_one(top: Path):
    hand_in(top, "starter")
    (top / "source" / "settings.json").write_text("{")
    results = run(top, expected=1)
    assert results["score"] == 0 and "tell your instructor" in results["output"]
    assert "Traceback" in (top / "log").read_text() and "Traceback" not in str(results)


def test_without_a_grader_there_are_results_all_the_same(top: Path):
    (top / "results" / "results.json").write_text('{"score": 100}')  # of another run
    shutil.rmtree(top / "python")
    results = run(top, expected=127)
    assert results["score"] == 0 and "tell your instructor" in results["output"]


def test_bonus_is_said_and_not_summed():
    check = CheckResult("a", "Sleeps", "unit", "passed", 3, 3)
    bonus = TodoResult("B1", "Sleep", "passed", 3, 3, None, [check])
    engine = TodoResult("1", "Touch", "passed", 3, 3, None, [check])
    made = json.loads(gradescope(Result(1, "ann", 3, 3, 3, ["processes"], [engine, bonus])))
    _, extra = ci_readers.gradescope_tests(made)
    assert made["score"] == 3 and made["output"] == "3 of 3 points, and 3 bonus"
    assert extra["name"].endswith("(bonus: 3 of 3)") and "score" not in extra


# ---------------------------------------------------------------- setting up


def test_a_machine_without_a_fitting_python_is_refused(top: Path, tmp_path: Path):
    tools = tmp_path / "tools"
    tools.mkdir()
    (tools / "cat").symlink_to(str(shutil.which("cat")))
    done = subprocess.run(
        ["/bin/sh", top / "source" / "setup.sh", top],
        env={"PATH": str(tools)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1
    assert "needs one of Python 3.13 3.12 3.11: choose a newer base image" in done.stderr


@pytest.mark.soak
def test_it_is_set_up_from_its_own_packages_and_grades(tmp_path: Path):
    """With the packages in the zip nothing is fetched: the index that pip is told of is empty."""
    version = "{}.{}".format(*sys.version_info)
    try:
        write_autograder(tmp_path / "autograder.zip", Settings(), version)
    except NoWheels:
        pytest.skip("needs a package index")
    top = tmp_path / "autograder"
    lay_out(tmp_path / "autograder.zip", top)
    here = Path(sys.base_prefix, "bin")
    environment = {"PATH": f"{here}:/usr/bin:/bin", "PIP_INDEX_URL": (tmp_path / "none").as_uri()}
    subprocess.run(["/bin/sh", top / "source" / "setup.sh", top], env=environment, check=True)
    assert (top / "source").stat().st_mode & 0o777 == 0o700
    hand_in(top, "solution")
    assert run(top)["score"] == 100
