"""Grade a submission on different machines: the JSON is the same (most in `make soak`)."""

import multiprocessing
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import pytest
from whole_bank import bank

from grader.judge.grade import grade
from grader.judge.task import KIT, Options, shipped_reference
from grader.report.files import as_json

pytestmark = pytest.mark.soak


@contextmanager
def busy_machine() -> Iterator[None]:
    """Keep every core busy with something else."""
    context = multiprocessing.get_context("spawn")
    hogs = [context.Process(target=count_for_ever) for _ in range(multiprocessing.cpu_count())]
    for hog in hogs:
        hog.start()
    try:
        yield
    finally:
        for hog in hogs:
            hog.kill()
            hog.join()


def count_for_ever() -> None:
    while True:
        pass


@pytest.mark.parametrize("tree", ["solution", "starter"])
def test_twenty_grades_are_one(tree: str):
    options = Options(shipped_reference())
    idle = {as_json(grade(KIT / tree, options)) for _ in range(10)}
    with busy_machine():
        busy = {as_json(grade(KIT / tree, options)) for _ in range(10)}
    assert len(idle | busy) == 1


@pytest.fixture(scope="module")
def submission(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a submission that earns some of the points and gets messages about the others."""
    folder = tmp_path_factory.mktemp("bank") / "submission"
    next(each for each in bank() if each.name == "4-clamps-the-increment").build(folder)
    return folder


def grade_in(
    submission: Path, python: Sequence[str] = (sys.executable,), **environment: str
) -> bytes:
    """Return the JSON that the command writes in another environment."""
    target = submission.parent / "result.json"
    command = [*python, "-m", "grader", "grade", str(submission), "--json", str(target)]
    environment = {**os.environ, "PYTHONPATH": str(KIT), **environment}
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 1, done.stdout + done.stderr
    return target.read_bytes()


@pytest.mark.parametrize(
    "environment",
    [
        {"COLUMNS": "400", "NO_COLOR": "1", "TERM": "dumb"},
        {"TZ": "Pacific/Kiritimati"},
        {"LC_ALL": "tr_TR.UTF-8", "LANG": "tr_TR.UTF-8"},
        {"PYTHONUTF8": "0", "LC_ALL": "C"},
        {"PYTHONHASHSEED": "4711"},
        {"SDL_VIDEODRIVER": "x11", "HYPOTHESIS_PROFILE": "ci"},
    ],
    ids=lambda names: ",".join(names),
)
def test_the_environment_changes_nothing(submission: Path, environment: dict[str, str]):
    assert grade_in(submission, **environment) == grade_in(submission)


def test_the_order_of_files_changes_nothing(submission: Path, tmp_path: Path):
    backwards = tmp_path / "submission"
    for path in sorted(submission.rglob("*"), reverse=True):
        if path.is_file():
            target = backwards / path.relative_to(submission)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, target)
    assert grade_in(backwards) == grade_in(submission)


@pytest.mark.skipif(not shutil.which("taskset"), reason="only Linux has taskset")
def test_the_number_of_cores_changes_nothing(submission: Path):
    one_core = ("taskset", "-c", "0", sys.executable)
    assert grade_in(submission, one_core) == grade_in(submission)


@pytest.mark.parametrize("version", ["3.11", "3.12", "3.13", "3.14"])
def test_the_version_of_python_changes_nothing(submission: Path, tmp_path: Path, version: str):
    found = shutil.which(f"python{version}")
    if found is None or subprocess.run([found, "-c", ""], capture_output=True).returncode:
        pytest.skip(f"Python {version} is not installed")
    subprocess.run([found, "-m", "venv", tmp_path / "venv"], check=True)
    folder = "Scripts" if sys.platform == "win32" else "bin"
    python = str(tmp_path / "venv" / folder / "python")
    install = [python, "-m", "pip", "install", "--quiet", "-r", str(KIT / "requirements.txt")]
    subprocess.run(install, check=True)
    assert grade_in(submission, (python,)) == grade_in(submission)
