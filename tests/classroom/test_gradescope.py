"""Test the zip for Gradescope, unpacked into a clean folder and run as Gradescope does."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bare_container
import ci_readers
import msgspec
import pytest
from samples import sample

from grader.classroom.gradescope import write_autograder
from grader.classroom.gradescope.autograder import Settings
from grader.errors import Stop
from grader.judge.result import CheckResult, Result, TodoResult
from grader.judge.task import KIT
from grader.report.sinks.gradescope import write_gradescope

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

# Ends a right program that can do forbidden things.
BURGLAR = """
import os
import re
top = {top!r}
broken = []
def attempt(action, *arguments):
    try:
        broken.append(action(*arguments))
    except OSError:
        pass
for name in ("results/results.json", "results/new", "run_autograder", "source/settings.json"):
    attempt(open, os.path.join(top, name), "a")
attempt(open, os.path.join(top, "source/solution/integrators.py"))
attempt(os.listdir, os.path.join(top, "source"))
attempt(os.kill, os.getppid(), 0)
assert not broken, broken
"""


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("zip") / "autograder.zip"
    write_autograder(path, Settings())
    return path


@pytest.fixture
def top(archive: Path, tmp_path: Path) -> Path:
    """Make /autograder as Gradescope lays it out, with this Python instead of the one set up."""
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
    """Uploads of students often have a folder around them."""
    target = top / "submission" / "engine"
    shutil.copytree(KIT / tree, target, ignore=shutil.ignore_patterns("__pycache__", ".*"))
    return target


def run(top: Path, expected: int = 0, inside: tuple[str, ...] = ()) -> dict[str, Any]:
    """Run it, `inside` another command if there is one, and read the results."""
    command = [*inside, top / "run_autograder", top]
    environment = {"PATH": os.environ["PATH"]}
    done = subprocess.run(command, cwd=top, env=environment, capture_output=True, text=True)
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


def test_the_same_kit_makes_the_same_zip_with_its_settings(archive: Path, tmp_path: Path):
    write_autograder(tmp_path / "again.zip", Settings())
    assert (tmp_path / "again.zip").read_bytes() == archive.read_bytes()
    write_autograder(tmp_path / "own.zip", Settings("strict", 4711))
    with zipfile.ZipFile(tmp_path / "own.zip") as opened:
        found = msgspec.json.decode(opened.read("settings.json"), type=Settings)
    assert found == Settings("strict", 4711)


# ---------------------------------------------------------------- grading


@pytest.mark.soak
@pytest.mark.parametrize(
    ("tree", "done", "points"),
    [
        ("starter", "integrators.py", 6),
        ("starter", None, 0),
        ("solution", None, 100),
    ],
)
def test_a_submission_gets_its_points(top: Path, tree: str, done: str | None, points: int):
    engine = hand_in(top, tree)
    if done:
        shutil.copyfile(KIT / "solution" / done, engine / done)
    results = run(top)
    tests = ci_readers.gradescope_tests(results)
    assert results["score"] == points
    counted = [test["max_score"] for test in tests if "max_score" in test]
    assert sum(counted) == 100
    assert f"{points} / 100" in (top / "log").read_text()


def test_a_hostile_submission_cannot_reach_the_marks(top: Path):
    place = str(top / "results" / "results.json")
    (top / "submission" / "integrators.py").write_text(FORGED.format(place=place))
    results = run(top)
    assert results["score"] == 0
    failed = [test for test in ci_readers.gradescope_tests(results) if test["status"] == "failed"]
    assert {"8a", "8b", "8c"} <= {test["number"].partition(".")[0] for test in failed}


# ---------------------------------------------------------------- without confinement


@pytest.fixture
def open_top(archive: Path) -> Iterator[Path]:
    """Make /autograder readable by every account, with a Python that every account may run."""
    python = next(filter(for_everybody, pythons()), None)
    packages = [Path(each) for each in sys.path if "site-" in each]
    if not sys.platform.startswith("linux") or os.geteuid() != 0 or python is None:
        pytest.skip("only root can become another user, and that one needs a Python it can read")
    if not all(map(for_everybody, packages)):
        pytest.skip(f"another user cannot read {packages[0]}")
    with tempfile.TemporaryDirectory(prefix="autograder-") as temporary:
        top = Path(temporary)
        top.chmod(0o755)
        lay_out(archive, top)
        subprocess.run([python, "-m", "venv", "--without-pip", top / "python"], check=True)
        place = next((top / "python").glob("lib/python*/site-packages"))
        (place / "kit.pth").write_text("\n".join(map(str, packages)))
        yield top


def pythons() -> list[Path]:
    """Return this Python, and the system's of the same version."""
    this = Path(sys.executable).resolve()
    return [this, Path("/usr/bin/python{}.{}".format(*sys.version_info))]


def for_everybody(path: Path) -> bool:
    return path.exists() and all(each.stat().st_mode & 0o001 for each in [path, *path.parents])


@pytest.mark.soak
def test_root_without_namespaces_and_landlock_keeps_marks_and_reference(open_top: Path):
    program = (KIT / "solution" / "integrators.py").read_text(encoding="utf-8")
    burglar = open_top / "submission" / "integrators.py"
    burglar.write_text(program + BURGLAR.format(top=str(open_top)), encoding="utf-8")
    results = run(open_top, inside=(sys.executable, bare_container.__file__, "namespaces,landlock"))
    log = (open_top / "log").read_text()
    assert results["score"] == 6, log
    assert "own-user" in log and "not confined here: files." in log


# ---------------------------------------------------------------- errors


def told_without_a_score(top: Path, results: dict[str, Any]) -> str:
    """Return the student's message; check that there is no score anywhere, so none counts as 0."""
    (told,) = results["tests"]
    assert "score" not in results and not {"score", "max_score"} & set(told)
    assert told["output"] == results["output"] and "no mark, and not 0 points" in told["output"]
    return str(told["output"])


@pytest.mark.parametrize(
    ("name", "content"),
    sample([("work.zip", b"no zip"), ("essay.txt", b"words"), (".keep", b"")], 3),
)
def test_what_cannot_be_graded_has_the_reason_and_no_score(top: Path, name: str, content: bytes):
    (top / "submission" / name).write_bytes(content)
    reason = told_without_a_score(top, run(top))
    assert reason.startswith("This could not be graded: ") and "hand in again" in reason
    log = (top / "log").read_text()
    assert "cannot grade: " in log and "enter its points there by hand" in log


def test_a_fault_of_the_grader_is_no_mark_that_looks_like_one(top: Path):
    hand_in(top, "starter")
    (top / "source" / "settings.json").write_text("{")
    results = run(top, expected=1)
    assert "tell your instructor" in told_without_a_score(top, results)
    assert "Traceback" in (top / "log").read_text() and "Traceback" not in str(results)


def test_without_a_grader_there_are_results_all_the_same(top: Path):
    (top / "results" / "results.json").write_text('{"score": 100}')  # of another run
    shutil.rmtree(top / "python")
    results = run(top, expected=127)
    assert "tell your instructor" in told_without_a_score(top, results)


def test_bonus_is_said_and_not_summed():
    check = CheckResult("a", "Sleeps", "unit", "passed", 3, 3)
    bonus = TodoResult("B1", "Sleep", "passed", 3, 3, None, [check])
    engine = TodoResult("1", "Touch", "passed", 3, 3, None, [check])
    made = json.loads(write_gradescope(Result(1, "ann", 3, 3, 3, ["processes"], [engine, bonus])))
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
    assert "needs one of Python 3.14 3.13 3.12 3.11: choose a newer base image" in done.stderr


@pytest.mark.soak
def test_it_is_set_up_from_its_own_packages_and_grades(tmp_path: Path):
    """The packages are in the zip, so pip works with an empty index."""
    version = "{}.{}".format(*sys.version_info)
    try:
        write_autograder(tmp_path / "autograder.zip", Settings(), version)
    except Stop:
        pytest.skip("pip reaches no package index from here, and packages are what is set up")
    top = tmp_path / "autograder"
    lay_out(tmp_path / "autograder.zip", top)
    here = Path(sys.base_prefix, "bin")
    environment = {"PATH": f"{here}:/usr/bin:/bin", "PIP_INDEX_URL": (tmp_path / "none").as_uri()}
    subprocess.run(["/bin/sh", top / "source" / "setup.sh", top], env=environment, check=True)
    hand_in(top, "solution")
    assert run(top)["score"] == 100
    assert [(top / each).stat().st_mode & 0o777 for each in ("source", "results")] == [0o700] * 2


def test_a_release_candidate_of_python_meets_every_marker():
    """Ubuntu 22.04 has 3.11.0rc1, which its pip does not count as a full version below 3.12."""
    for path in KIT.glob("requirements*.txt"):
        core = path.name == "requirements.txt"
        markers = re.findall(r"python_full_version\s*\S+\s*'(\d+(?:\.\d+)*)'", path.read_text())
        assert not [version for version in markers if core or version.count(".") < 2], path
