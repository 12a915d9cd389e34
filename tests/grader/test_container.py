"""Where a machine has no walls: it refuses, and a container grades instead."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from grader.judge.children import WarmWorker
from grader.judge.grade import KIT, Options, grade, shipped_reference
from grader.judge.isolation import KEEPS_FILES, refusal
from grader.judge.submission import CannotGrade
from grader.protocol import ChildSetup

BARE = ["processes", "process-group", "rlimits"]  # as on macOS
INSTRUCTIONS = (KIT / "Containerfile").read_text(encoding="utf-8")


def test_somebody_elses_work_is_refused_where_files_are_open():
    assert "--isolation none" in refusal("auto", [*BARE, "system-calls"], trusted=False)
    assert refusal("auto", BARE, trusted=True) == ""
    assert refusal("none", ["processes"], trusted=False) == ""
    for layer in KEEPS_FILES:
        assert refusal("auto", [*BARE, layer], trusted=False) == ""
    assert "cannot confine files" in refusal("strict", [*BARE, "own-user"], trusted=True)


def without_walls(usual):
    def open_child(self: WarmWorker, setup: ChildSetup):
        child = usual(self, setup)
        child.ready.layers[:] = BARE
        self.layers = []
        return child

    return open_child


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no warm process")
def test_the_refusal_comes_before_a_line_of_it_runs(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(WarmWorker, "open", without_walls(WarmWorker.open))
    with pytest.raises(CannotGrade, match="cannot keep somebody else's code from your files"):
        grade(KIT / "solution", Options(shipped_reference(), only=frozenset({"8a"})))
    own = Options(shipped_reference(), only=frozenset({"8a"}), trusted=True)
    assert grade(KIT / "solution", own).complete


@pytest.mark.soak
def test_without_isolation_all_of_the_judge_is_loaded_before_a_submission_runs():
    program = (
        "import sys; from grader.judge.isolation import load_everything; load_everything(); "
        "before = set(sys.modules); import grader.report.html, grader.judge.replay, "
        "grader.judge.plugin, grader.classroom.dashboard, grader.report.sinks.markdown; "
        "exit(any(name.startswith('grader') for name in set(sys.modules) - before))"
    )
    assert subprocess.run([sys.executable, "-c", program], cwd=KIT).returncode == 0


# ---------------------------------------------------------------- the container


def copied() -> list[str]:
    return re.findall(r"^COPY (\S+) ", INSTRUCTIONS, re.MULTILINE)


def test_what_is_copied_is_not_ignored():
    kept = re.findall(r"^!(\S+)$", (KIT / ".dockerignore").read_text(), re.MULTILINE)
    assert sorted(kept) == sorted(copied())
    assert all((KIT / name).exists() for name in copied())


@pytest.mark.skipif(os.name == "nt", reason="the stand-in is a script for a shell")
def test_one_command_grades_a_folder_in_it(tmp_path: Path):
    """The engine is stood in for by a script that writes down what it is asked."""
    engine = tmp_path / "engine"
    engine.write_text(f'#!/bin/sh\nprintf "%s\\n" "$*" >> {tmp_path}/asked\n')
    engine.chmod(0o755)
    folder = tmp_path / "class"
    folder.mkdir()
    command = ["make", "contained", f"ENGINE={engine}", f"SUBMISSIONS={folder}", "SEED=7"]
    subprocess.run(command, cwd=KIT, check=True, stdout=subprocess.DEVNULL)
    build, run = (tmp_path / "asked").read_text().splitlines()
    assert build == "build --tag physics-grader --file Containerfile ."
    assert "--network none" in run and f"{folder}:/instructor/submissions:ro" in run
    assert f"{folder}-results:/instructor/results" in run
    assert run.endswith("physics-grader --seed 7")
    assert (tmp_path / "class-results").is_dir()


@pytest.mark.soak
def test_what_is_copied_grades_a_class(tmp_path: Path):
    """The entry point as it stands, on what the container holds, in another folder."""
    kit = tmp_path / "kit"
    kit.mkdir()
    for name in copied():
        copy = shutil.copytree if (KIT / name).is_dir() else shutil.copyfile
        copy(KIT / name, kit / name)
    ann = tmp_path / "submissions" / "ann"
    ann.mkdir(parents=True)
    shutil.copy(KIT / "solution" / "integrators.py", ann)
    (line,) = re.findall(r"^ENTRYPOINT (.+)$", INSTRUCTIONS, re.MULTILINE)
    entry = [each.replace("/instructor", str(tmp_path)) for each in json.loads(line)]
    subprocess.run(
        [sys.executable, *entry[1:], "--jobs", "1"], cwd=kit, check=True, stdout=subprocess.DEVNULL
    )
    marks = json.loads((tmp_path / "results" / "ann.json").read_text(encoding="utf-8"))
    assert marks["points"] == 6
