"""Run the commands of the two CI files on a submission's repository, as GitHub does."""

import json
import os
import re
import shutil
import subprocess
import sys
import venv
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import ci_readers
import pytest
import typer
from command_line import start_grader
from ruamel.yaml import YAML

from grader.bank.members import make_mistake
from grader.cli.grade import Output, finish
from grader.judge.result import Result, is_bonus
from grader.judge.task import KIT
from grader.release.build import build
from grader.report.ci import is_free_folder
from grader.source.regions import python_files

WORKFLOW, PIPELINE = ".github/workflows/grade.yml", ".gitlab-ci.yml"
REPOSITORY = "org/cs-engine-anna"
SHORT = KIT / "tests" / "courses" / "integrators.toml"  # graded in a moment


def read(name: str) -> Any:
    return YAML(typ="safe").load(KIT / "solution" / name)


def steps() -> list[dict[str, Any]]:
    return list(read(WORKFLOW)["jobs"]["grade"]["steps"])


# ---------------------------------------------------------------- the files


def test_the_workflow_may_only_read_and_ends_and_its_latest_run_counts():
    assert read(WORKFLOW)["permissions"] == {"contents": "read"}
    assert read(WORKFLOW)["concurrency"]["cancel-in-progress"] is True
    job = read(WORKFLOW)["jobs"]["grade"]
    assert "permissions" not in job and job["timeout-minutes"] <= 30
    checkout = next(step for step in steps() if "actions/checkout@" in step.get("uses", ""))
    assert checkout["with"]["persist-credentials"] is False
    assert "secrets." not in (KIT / "solution" / WORKFLOW).read_text(encoding="utf-8")


def test_every_action_is_one_commit_with_its_version_beside_it():
    text = (KIT / "solution" / WORKFLOW).read_text(encoding="utf-8")
    pinned = re.findall(r"uses: actions/[a-z-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+$", text, re.M)
    assert len(pinned) == text.count("uses:") == 3


def test_both_files_call_the_same_commands_and_keep_the_report_whatever_the_marks():
    job = read(PIPELINE)["grade"]
    assert [step["run"] for step in steps() if "run" in step] == job["script"]
    keep = next(step for step in steps() if "upload-artifact" in step.get("uses", ""))
    assert keep["if"] == "always()" and keep["with"]["path"] == "report"
    assert job["artifacts"]["when"] == "always" and job["artifacts"]["paths"] == ["report"]
    assert job["artifacts"]["reports"]["junit"] == "report/junit.xml"


# ---------------------------------------------------------------- as GitHub runs it


@dataclass
class Run:
    """A run of the workflow's commands in a checkout, and its results on GitHub."""

    checkout: Path
    status: int
    log: str
    summary: str
    outputs: dict[str, str]

    @property
    def result(self) -> Any:
        return json.loads((self.checkout / "report" / "result.json").read_bytes())

    @property
    def annotations(self) -> list[ci_readers.Command]:
        return ci_readers.commands_in(self.log)


def run_workflow(
    checkout: Path,
    files: Path,
    python: str = sys.executable,
    course: Path = SHORT,
    installed: bool = True,
) -> Run:
    """Run each `run` step in turn, by bash as on GitHub, until one fails.

    Our own Python already has the packages, so pip installs nothing.
    """
    files.mkdir()
    environment = {
        **os.environ,
        **({"PIP_NO_INDEX": "1"} if python == sys.executable else {}),
        "PATH": os.pathsep.join([str(Path(python).parent), os.environ["PATH"]]),
        "CI": "true",
        "COURSE_FILE": str(course),
        "GITHUB_ACTIONS": "true",
        "GITHUB_REPOSITORY": REPOSITORY,
        "GITHUB_WORKSPACE": str(checkout),
        "GITHUB_OUTPUT": str(files / "output"),
        "GITHUB_STEP_SUMMARY": str(files / "summary"),
        "GITHUB_ENV": str(files / "env"),
        "GITHUB_PATH": str(files / "path"),
    }
    for name in ("output", "summary", "env", "path"):
        (files / name).touch()
    log, status = "", 0
    for step in steps():
        if "run" in step and status == 0 and not (installed and step["name"] == "Install"):
            done = subprocess.run(
                ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]],
                cwd=checkout,
                env=environment,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                encoding="utf-8",
                errors="replace",
            )
            log, status = log + done.stdout, done.returncode
    assert (files / "env").read_text() == "" and (files / "path").read_text() == ""
    summary = (files / "summary").read_text(encoding="utf-8")
    outputs = ci_readers.outputs_in((files / "output").read_text(encoding="utf-8"))
    return Run(checkout, status, log, summary, outputs)


def checkout_of(tree: str, folder: Path) -> Path:
    ignored = shutil.ignore_patterns("__pycache__", "notebooks", "experiments", "stable_engine")
    return shutil.copytree(KIT / tree, folder / "work", ignore=ignored)


def with_integrators(checkout: Path) -> Path:
    """Make a starter in which TODOs 8a to 8c are done."""
    shutil.copyfile(KIT / "solution" / "integrators.py", checkout / "integrators.py")
    return checkout


def in_agreement(run: Run) -> Run:
    """Check that every form has the same points."""
    points, most = run.result["points"], run.result["max_points"]
    assert run.result["submission"] == "cs-engine-anna"
    assert (run.outputs["points"], run.outputs["max-points"]) == (str(points), str(most))
    reported = ci_readers.read_report(run.outputs["result"])
    assert sum(test["score"] for test in reported["tests"]) == points
    assert reported["max_score"] == most
    bonus = f", and {run.result['bonus']} bonus" if run.result["bonus"] else ""
    assert run.summary.startswith(f"## cs-engine-anna: {points} of {most} points{bonus}\n")
    assert (run.checkout / "report" / "summary.md").read_text(encoding="utf-8") == run.summary
    cases = ci_readers.junit_cases((run.checkout / "report" / "junit.xml").read_bytes())
    todos = [todo for todo in run.result["todos"] if not unbegun_bonus(todo)]
    checks = [check for todo in todos for check in todo["checks"]]
    passed = [check["state"] == "passed" for check in checks]
    assert [len(case) == 0 for case in cases] == passed
    return run


def unbegun_bonus(todo: dict[str, Any]) -> bool:
    """Return whether a TODO is an unstarted bonus task."""
    return is_bonus(todo["id"]) and todo["state"] == "not started"


@pytest.mark.soak
def test_a_mistake_is_annotated_on_its_line(tmp_path: Path):
    checkout = with_integrators(checkout_of("starter", tmp_path))
    make_mistake("8c-equal-weights", checkout)
    run = in_agreement(run_workflow(checkout, tmp_path / "runner"))
    assert run.status == 1
    ((kind, held, message),) = run.annotations
    assert kind == "error" and held["title"].startswith("TODO 8c: ")
    assert held["file"] == "integrators.py" and "Expected" in message
    line = (checkout / held["file"]).read_text(encoding="utf-8").splitlines()[int(held["line"]) - 1]
    assert "accel(x)" in line  # the first line of code in the region, and not its marker
    assert "TODO 8c" in run.summary.partition("```text")[2]


@pytest.mark.soak
def test_the_release_runs_its_own_workflow(tmp_path: Path):
    """In a new environment; packages are downloaded."""
    built = build(tmp_path / "release", wrong=())
    for archive in (*built.glob("*.zip"), *built.glob("*-extra/ci.zip")):
        shutil.unpack_archive(archive, tmp_path / "unpacked")
    (tree,) = (tmp_path / "unpacked").iterdir()
    venv.create(tmp_path / "python", with_pip=True)
    python = str(tmp_path / "python" / "bin" / "python")
    starter = in_agreement(run_workflow(tree, tmp_path / "starter", python, installed=False))
    assert starter.status == 1 and starter.outputs["points"] == "0"
    shutil.rmtree(tree / "report")
    for path in python_files(KIT / "starter"):
        name = path.relative_to(KIT / "starter")
        shutil.copyfile(KIT / "solution" / name, tree / name)
    solution = in_agreement(run_workflow(tree, tmp_path / "solution", python))
    assert solution.status == 0 and solution.outputs["points"] == starter.outputs["max-points"]
    shutil.rmtree(tree / "report")
    make_mistake("8c-equal-weights", tree)
    wrong = in_agreement(run_workflow(tree, tmp_path / "wrong", python))
    assert wrong.status == 1 and len(wrong.annotations) == 1


# ---------------------------------------------------------------- hostile submissions

ATTACK = """
import importlib.util, os, sys
from pathlib import Path

WORDS = (
    "::error title=Well done::100 of 100 points\\n::set-output name=points::100\\n"
    "##[add-mask]1 ]]></failure><testcase/> ```\\n# 100 of 100 points <script>alert(1)</script>"
)
for stream in (sys.stdout, sys.stderr, sys.__stdout__, sys.__stderr__):
    try:
        print("\\n" + WORDS + "\\n::stop-commands::mine\\n::warning::x", file=stream, flush=True)
    except Exception:
        pass
for number in (1, 2):
    os.write(number, b"\\n::error::written\\n")
told = [name for name in os.environ if name.startswith(("GITHUB", "CI", "PIP", "RUNNER"))]
for file in (os.environ.get("GITHUB_OUTPUT"), os.environ.get("GITHUB_STEP_SUMMARY"), *FOUND):
    try:
        with open(file, "a") as stream:
            stream.write("\\npoints=100\\nforged=1\\n")
        told.append("wrote " + file)
    except (OSError, TypeError):
        pass

def fails(*arguments):
    raise RuntimeError(f"told {told} " + WORDS)

semi_implicit_euler = velocity_verlet = fails
odd = Path(__file__).parent / "a,line=1::b]]>`.py"
spec = importlib.util.spec_from_file_location("odd", odd)
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
rk4 = module.rk4
"""


@pytest.fixture
def attack_run(tmp_path: Path) -> Run:
    """Run a submission that forges streams, files of the runner, names and messages."""
    checkout, runner = checkout_of("starter", tmp_path), tmp_path / "runner"
    found = [str(runner / name) for name in ("output", "summary", "env", "path")]
    found += [str(checkout / "report" / name) for name in ("result.json", "junit.xml")]
    (checkout / "integrators.py").write_text(f"FOUND = {found!r}\n{ATTACK}", encoding="utf-8")
    (checkout / "a,line=1::b]]>`.py").write_text(
        "def rk4(*arguments):\n    raise ValueError('##[error]100 of 100 points')\n"
    )
    package = checkout / "grader"
    package.mkdir()
    for name in ("__init__.py", "__main__.py"):
        (package / name).write_text("print('::error::taken over')\nraise SystemExit(0)\n")
    (checkout / "json.py").write_text("print('::error::taken over')\nraise SystemExit(0)\n")
    return run_workflow(checkout, runner)


def test_nothing_can_be_forged(attack_run: Run):
    run = in_agreement(attack_run)
    assert run.status == 1 and run.outputs["points"] == "0"
    assert set(run.outputs) == {"points", "max-points", "result"}
    assert [(name, held["title"][:8]) for name, held, _ in run.annotations] == [
        ("error", f"TODO {each}:") for each in ("8a", "8b", "8c")
    ]
    files = {held["file"] for _, held, _ in run.annotations}
    assert files == {"integrators.py", "a,line=1::b]]>`.py"}
    assert all("told []" in message for _, _, message in run.annotations[:2])
    assert (
        ci_readers.commands_in(
            ci_readers.reporter_log(ci_readers.read_report(run.outputs["result"]))
        )
        == []
    )
    tokens = ci_readers.markdown_tokens(run.summary)
    assert not [each for each in tokens if each.type in ("html_block", "html_inline", "image")]
    headings = [each for each in tokens if each.type == "heading_open" and each.tag == "h2"]
    assert len(headings) == 1


def test_reports_go_into_a_folder_and_through_no_link(tmp_path: Path):
    assert is_free_folder(tmp_path / "new")
    (tmp_path / "empty").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "empty")
    (tmp_path / "file").touch()
    assert is_free_folder(tmp_path / "empty")
    assert not is_free_folder(tmp_path / "link") and not is_free_folder(tmp_path / "file")


# ---------------------------------------------------------------- elsewhere, and the policy


@pytest.mark.soak
def test_gitlab_gets_the_files_and_no_command_of_github(tmp_path: Path):
    checkout = checkout_of("starter", tmp_path)
    done = start_grader(
        *("grade", checkout, "--ci", tmp_path / "report", "--todo", "8c"),
        CI_PROJECT_PATH="group/sub/ben",
    )
    assert done.returncode == 1 and "::" not in done.stdout
    assert (tmp_path / "report" / "summary.md").read_text().startswith("## ben: 0 of 2 points")
    assert ci_readers.junit_cases((tmp_path / "report" / "junit.xml").read_bytes())


@pytest.mark.parametrize(
    ("points", "at_least", "status"),
    [(100, None, 0), (99, None, 1), (60, 60, 0), (59, 60, 1), (0, 0, 0)],
)
def test_the_course_says_from_how_many_points_on_a_run_is_green(
    points: int, at_least: int | None, status: int
):
    with pytest.raises(typer.Exit) as ended:
        finish(Result(1, "ann", points, 100, 0, [], []), Output(at_least=at_least))
    assert ended.value.exit_code == status
