"""Test the bundle for Classroom 50 as its runner runs it: in a checkout, with its variables."""

import hashlib
import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import ci_readers
import pytest

from grader.bank.members import make_mistake
from grader.judge.task import KIT
from grader.report.sinks.classroom50 import BUNDLE, write_bundle

SHORT = str(KIT / "tests" / "courses" / "integrators.toml")  # graded in a moment
ALL_BUT_THE_DOWNLOAD = """
import sys
from pathlib import Path
sys.path.insert(0, {bundle!r})
import autograder
autograder.install = lambda folder: Path(sys.executable)
sys.exit(autograder.main())
"""


@dataclass
class Run:
    """A run of the autograder in a checkout, and the files that the runner takes."""

    checkout: Path
    status: int
    log: str
    outputs: dict[str, str]

    @property
    def marks(self) -> Any:
        """Return the marks with the fields that the runner adds."""
        marks = json.loads((self.checkout / "result.json").read_text(encoding="utf-8"))
        marks |= {"owner": "anna", "assignment_type": "individual"}
        ci_readers.classroom50_marks(marks)
        return marks

    @property
    def body(self) -> str:
        return (self.checkout / "release-body.md").read_text(encoding="utf-8")


def run_in(checkout: Path, runner: Path, *command: str, **more: str) -> Run:
    """Do as the runner does: remove old results, then start Python in the checkout."""
    for name in ("result.json", "release-body.md"):
        if (checkout / name).exists():
            (checkout / name).unlink()
    runner.mkdir()
    (runner / "output").touch()
    done = subprocess.run(
        [sys.executable, *command],
        cwd=checkout,
        env={
            **os.environ,
            "CLASSROOM": "physics",
            "ASSIGNMENT": "engine",
            "ASSIGNMENT_TYPE": "individual",
            "USERNAME": "anna",
            "OWNER": "anna",
            "SUBMISSION_TAG": "submit/2026-10-01T10-00-00Z-0a1b2c3",
            "COMMIT_URL": "https://git.example/org/physics-engine-anna/commit/0a1b2c3",
            "RELEASE_URL": "https://git.example/org/physics-engine-anna/releases/tag/submit",
            "REVIEW_URL": "https://git.example/org/physics-engine-anna/compare/1...2",
            "PAGES_BASE_URL": "https://org.example/classroom50",
            "CLASSROOM50_BUNDLE_DIR": str(BUNDLE),
            "GITHUB_ACTIONS": "true",
            "GITHUB_REPOSITORY": "org/physics-engine-anna",
            "GITHUB_WORKSPACE": str(checkout),
            "GITHUB_STEP_SUMMARY": str(runner / "summary"),
            "GITHUB_OUTPUT": str(runner / "output"),
            **more,
        },
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
    )
    assert not (runner / "summary").exists()  # the runner puts the release's text there
    outputs = ci_readers.outputs_in((runner / "output").read_text(encoding="utf-8"))
    return Run(checkout, done.returncode, done.stdout, outputs)


def without_download(checkout: Path, **more: str) -> Run:
    """Run autograder.py with the packages that are installed here."""
    script = checkout.parent / "bundle" / "started_by_the_runner.py"
    script.parent.mkdir()
    script.write_text(ALL_BUT_THE_DOWNLOAD.format(bundle=str(BUNDLE)), encoding="utf-8")
    return run_in(checkout, checkout.parent / "runner", str(script), **more)


def checkout_of(tree: str, folder: Path) -> Path:
    ignored = shutil.ignore_patterns("__pycache__", "notebooks", "experiments", "stable_engine")
    return shutil.copytree(KIT / tree, folder / "physics-engine-anna", ignore=ignored)


@pytest.mark.soak
def test_the_solution_succeeds(tmp_path: Path):
    run = without_download(checkout_of("solution", tmp_path))
    assert run.status == 0, run.log
    assert run.marks["score"] == run.marks["max-score"] == 100
    assert run.outputs == {"status": "success", "summary": "100 of 100 points"}
    assert run.body.startswith("## physics-engine-anna: 100 of 100 points")
    assert ci_readers.commands_in(run.log) == []
    assert (run.checkout / "report.html").stat().st_size > 1000


@pytest.mark.soak
def test_a_mistake_costs_its_todo_and_is_told(tmp_path: Path):
    checkout = checkout_of("starter", tmp_path)
    shutil.copyfile(KIT / "solution" / "integrators.py", checkout / "integrators.py")
    make_mistake("8c-equal-weights", checkout)
    run = without_download(checkout, COURSE_FILE=SHORT)
    assert run.status == 0
    passed = {test["test-name"][:7] for test in run.marks["tests"] if test["passed"]}
    assert passed == {"TODO 8a", "TODO 8b"}
    assert run.marks["score"] == sum(test["score"] for test in run.marks["tests"])
    assert 0 < run.marks["score"] < run.marks["max-score"]
    assert "TODO 8c" in run.body and "integrators.py:" in run.body
    told = {held["title"][:7]: held for _, held, _ in ci_readers.commands_in(run.log)}
    assert told["TODO 8c"]["file"] == "integrators.py"


# ---------------------------------------------------------------- hostile submissions

ATTACK = """
import os, subprocess, sys, time
from pathlib import Path

FORGED = '{"schema": "classroom50/result/v1", "score": 100, "max-score": 100, "tests": []}'
PLACES = [Path(each) for each in %r]

def forge():
    for place in PLACES:
        for name in ("result.json", "release-body.md", "marks.json", "output"):
            try:
                (place / name).write_text(FORGED)
            except OSError:
                pass

forge()
print("\\n::error::forged\\n##[set-output name=status]success")
sys.__stdout__.write("\\n::set-output name=status::success\\n")
if os.fork() == 0:
    os.setsid()
    for number in range(600):
        forge()
        time.sleep(0.1)
    os._exit(0)
"""


def test_marks_cannot_be_written_by_who_gets_them(tmp_path: Path):
    checkout, outside = checkout_of("starter", tmp_path), tmp_path / "outside"
    outside.mkdir()
    (checkout / "result.json").symlink_to(outside / "result.json")
    (checkout / "release-body.md").symlink_to(outside / "release-body.md")
    (checkout / "report.html").mkdir()
    (checkout / "report.html" / "inside.txt").write_text("mine", encoding="utf-8")
    places = [str(checkout), str(tmp_path / "runner")]
    (checkout / "integrators.py").write_text(ATTACK % places, encoding="utf-8")
    for name in ("grader", "pip", "venv", "json", "subprocess", "tempfile", "sitecustomize"):
        (checkout / f"{name}.py").write_text("print('::error::taken over')\nraise SystemExit(0)\n")
    run = without_download(checkout)
    assert run.status == 0, run.log
    assert run.marks["score"] == 0 and run.marks["max-score"] == 100
    assert run.outputs == {"status": "failure", "summary": "0 of 100 points"}
    assert run.body.startswith("## physics-engine-anna: 0 of 100 points")
    for name, held, _ in ci_readers.commands_in(run.log):
        assert name == "error" and held["title"].startswith("TODO 8")
    assert list(outside.iterdir()) == []
    assert not (checkout / "result.json").is_symlink()


# ---------------------------------------------------------------- the bundle


def test_the_bundle_has_what_it_needs_and_nothing_else(tmp_path: Path):
    (tmp_path / "physics_grader-1-py3-none-any.whl").write_bytes(b"wheel")
    (tmp_path / "requirements.txt").write_text("rich\n")
    folder = tmp_path / "CLASSROOM" / "autograders" / "ASSIGNMENT"
    for _ in range(2):  # once more changes nothing
        write_bundle(
            *(folder, tmp_path / "physics_grader-1-py3-none-any.whl"),
            tmp_path / "requirements.txt",
        )
    assert {path.name for path in folder.iterdir()} == {
        *("autograder.py", "requirements.txt", "physics_grader-1-py3-none-any.whl")
    }
    assert (folder / "autograder.py").read_bytes() == (BUNDLE / "autograder.py").read_bytes()


@pytest.mark.soak
def test_the_bundle_installs_itself_and_grades(tmp_path: Path):
    """Download the locked packages."""
    source = shutil.copytree(
        KIT, tmp_path / "kit", ignore=shutil.ignore_patterns(".*", "build", "tests", "solution")
    )
    pip = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation"]
    assert subprocess.run([*pip, "."], cwd=source).returncode == 0
    (wheel,) = source.glob("*.whl")
    with open(source / "requirements.txt", "a", encoding="utf-8") as requirements:
        hashed = hashlib.sha256(wheel.read_bytes()).hexdigest()
        requirements.write(f"./{wheel.name} --hash=sha256:{hashed}\n")
    write_bundle(tmp_path / "bundle", wheel, source / "requirements.txt")
    run = run_in(
        *(checkout_of("starter", tmp_path), tmp_path / "runner"),
        str(tmp_path / "bundle" / "autograder.py"),
    )
    assert run.status == 0, run.log
    assert run.marks["score"] == 0 and run.outputs["status"] == "failure"
