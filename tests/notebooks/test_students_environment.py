"""Set up nbgrader's release by its README, in a new folder with a new Python."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from handed_in import NAMES

from grader.classroom.nbgrader.submissions import ASSIGNMENT
from grader.judge.task import KIT
from grader.release import build as releases

pytestmark = [
    pytest.mark.soak,
    pytest.mark.skipif(os.name == "nt", reason="the lines of the README for a Unix shell"),
]
HERE = Path(sys.executable).parent


def run_lines(lines: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run lines in a new shell, without this environment."""
    kept = ("HOME", "LANG", "http_proxy", "https_proxy", "no_proxy", "PIP_INDEX_URL")
    environment = {name: os.environ[name] for name in kept if name in os.environ}
    system = [str(Path(sys.base_prefix, "bin")), "/usr/bin", "/bin"]
    return subprocess.run(
        ["/bin/bash", "-e", "-c", lines],
        cwd=folder,
        env=environment | {"PATH": os.pathsep.join(system)},
        capture_output=True,
        text=True,
    )


def first_lines(readme: str) -> str:
    """Return the first block of commands in the README."""
    block = re.search(r"^```\w*\n(.*?)^```", readme, re.M | re.S)
    assert block is not None and "pip install" in block[1]
    return block[1]


@pytest.fixture(scope="module")
def handed_out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Release an assignment by nbgrader's own command; return a copy of its folder."""
    pytest.importorskip("nbgrader.api", reason="needs the extra notebooks")
    top = tmp_path_factory.mktemp("nbgrader")
    (archive,) = releases.build(top / "work", []).glob("*.zip")
    course = top / "course"
    exchange = top / "exchange"
    exchange.mkdir()
    exchange.chmod(0o777)  # as nbgrader requires, with any umask
    for place, command in (
        (KIT, ["python", "-m", "grader", "nbgrader", "course", course, "--release", archive]),
        (course, ["nbgrader", "generate_assignment", ASSIGNMENT]),
        (course, ["nbgrader", "release_assignment", ASSIGNMENT, f"--Exchange.root={exchange}"]),
    ):
        done = subprocess.run(
            [str(HERE / str(command[0])), *map(str, command[1:])],
            cwd=place,
            env=os.environ | {"PATH": os.pathsep.join([str(HERE), os.environ["PATH"]])},
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stdout + done.stderr[-2000:]
    (outbound,) = exchange.glob(f"*/outbound/{ASSIGNMENT}")
    return Path(shutil.copytree(outbound, tmp_path_factory.mktemp("student") / ASSIGNMENT))


def test_a_student_checks_by_the_readme_alone(handed_out: Path):
    readme = (handed_out / "README.md").read_text(encoding="utf-8")
    assert {f"{name}.ipynb" for name in NAMES} <= {path.name for path in handed_out.iterdir()}
    installed = run_lines(first_lines(readme), handed_out)
    if "No matching distribution" in installed.stderr:
        pytest.skip("pip reaches no package index from here")
    assert installed.returncode == 0, installed.stderr
    checked = run_lines("source .venv/bin/activate\nmake check", handed_out)
    assert "NOT STARTED" in checked.stdout.upper(), checked.stdout + checked.stderr
    done = KIT / "solution" / "integrators.py"
    shutil.copyfile(done, handed_out / "integrators.py")
    again = run_lines("source .venv/bin/activate\nmake check TODO=8a", handed_out)
    assert again.returncode == 0 and "PASSED" in again.stdout.upper(), again.stdout
    same = run_lines("sha256sum --check --quiet MANIFEST.txt", handed_out)
    assert same.stdout == "integrators.py: FAILED\n"
