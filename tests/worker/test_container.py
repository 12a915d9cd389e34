"""Test machines without layers: the grader refuses there, and a container grades instead."""

import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest

from grader.judge.grade import grade
from grader.judge.submission import CannotGrade
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.wall.children import WarmWorker
from grader.judge.wall.isolation import KEEPS_FILES, find_refusal
from grader.protocol import ChildSetup

BARE = ["processes", "process-group", "rlimits"]  # as on macOS
INSTRUCTIONS = (KIT / "Containerfile").read_text(encoding="utf-8")


def test_other_peoples_work_is_refused_where_files_are_open():
    assert "--isolation none" in find_refusal("auto", [*BARE, "system-calls"], trusted=False)
    assert find_refusal("auto", BARE, trusted=True) == ""
    assert find_refusal("none", ["processes"], trusted=False) == ""
    for layer in KEEPS_FILES:
        assert find_refusal("auto", [*BARE, layer], trusted=False) == ""
    assert "cannot confine files" in find_refusal("strict", [*BARE, "own-user"], trusted=True)


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
    options = Options(shipped_reference(), only=frozenset({"8a"}))
    with pytest.raises(CannotGrade, match="cannot keep somebody else's code from your files"):
        grade(KIT / "solution", options)
    with pytest.raises(CannotGrade, match="cannot confine files and network"):
        grade(KIT / "solution", replace(options, isolation="strict"))
    assert grade(KIT / "solution", replace(options, trusted=True)).has_full_marks


@pytest.mark.soak
def test_without_isolation_all_of_the_judge_is_loaded_before_a_submission_runs():
    program = (
        "import sys; from grader.judge.wall.isolation import load_everything; load_everything(); "
        "before = set(sys.modules); import grader.report.html, grader.player.replay, "
        "grader.judge.explain.reasons, grader.classroom.dashboard, grader.report.sinks.markdown; "
        "exit(any(name.startswith('grader') for name in set(sys.modules) - before))"
    )
    assert subprocess.run([sys.executable, "-c", program], cwd=KIT).returncode == 0


# ---------------------------------------------------------------- the container

posix = pytest.mark.skipif(os.name == "nt", reason="the script needs a shell")


def list_copied() -> list[str]:
    return re.findall(r"^COPY (\S+) ", INSTRUCTIONS, re.MULTILINE)


def test_copied_files_are_not_ignored():
    kept = re.findall(r"^!(\S+)$", (KIT / ".dockerignore").read_text(), re.MULTILINE)
    assert sorted(kept) == sorted(list_copied())
    assert all((KIT / name).exists() for name in list_copied())


class EngineCall:
    """The arguments that `make contained` gives to the engine; a script replaces the engine."""

    def __init__(self, folder: Path, *settings: str) -> None:
        engine = folder / "engine"
        engine.write_text(f"""#!/bin/sh\nprintf '%s\\n' "$@" '' >> '{folder}/asked'\n""")
        engine.chmod(0o755)
        command = ["make", "contained", f"ENGINE='{engine}'", *settings]
        subprocess.run(command, cwd=KIT, check=True, stdout=subprocess.DEVNULL)
        self.build, run = (each.split("\n") for each in self.read_calls(folder))
        image = run.index("physics-grader")
        self.options, self.arguments = run[:image], run[image + 1 :]
        self.read, self.written = {}, {}
        for option, volume in pairwise(self.options):
            if option == "--volume":
                outside, inside, *only = volume.split(":")
                (self.read if only else self.written)[inside] = Path(outside)

    def read_calls(self, folder: Path) -> list[str]:
        return (folder / "asked").read_text().removesuffix("\n\n").split("\n\n")


@posix
@pytest.mark.parametrize("results", ["", "marks"])
def test_one_command_grades_a_folder_in_it(tmp_path: Path, results: str):
    folder = tmp_path / "a class"
    folder.mkdir()
    settings = [f"RESULTS={tmp_path}/given back/{results}"] if results else []
    call = EngineCall(tmp_path, f"SUBMISSIONS={folder}/", "SEED=7", *settings)
    assert call.build == ["build", "--tag", "physics-grader", "--file", "Containerfile", "."]
    assert ("--network", "none") in pairwise(call.options) and "--read-only" in call.options
    assert call.read["/instructor/submissions"] == folder
    assert call.written == {"/instructor/beside": tmp_path / "given back" if results else tmp_path}
    out = f"/instructor/beside/{results or 'a class-results'}"
    assert call.arguments == ["--out", out, "--seed", "7"]


@posix
def test_a_missing_folder_is_named(tmp_path: Path):
    for more, said in ((), "needs SUBMISSIONS=folder"), (("SUBMISSIONS=none",), "is no folder of"):
        command = ["make", "contained", "ENGINE=false", *more]
        done = subprocess.run(command, cwd=KIT, capture_output=True, text=True)
        assert done.returncode != 0 and said in done.stdout + done.stderr


@posix
@pytest.mark.soak
def test_the_container_grades_a_class_and_writes_nowhere_else(tmp_path: Path):
    """Run the entry point on the container's files, in another folder."""
    kit = tmp_path / "kit"
    kit.mkdir()
    for name in list_copied():
        copy = shutil.copytree if (KIT / name).is_dir() else shutil.copyfile
        copy(KIT / name, kit / name)
    ann = tmp_path / "submissions" / "ann"
    ann.mkdir(parents=True)
    shutil.copy(KIT / "solution" / "integrators.py", ann)
    call = EngineCall(tmp_path, f"SUBMISSIONS={ann.parent}", f"RESULTS={tmp_path}/class")
    (beside,) = call.written
    (line,) = re.findall(r"^ENTRYPOINT (.+)$", INSTRUCTIONS, re.MULTILINE)
    command = [*json.loads(line), *call.arguments, "--jobs", "1", "--todo", "8a"]
    command = [each.replace("/instructor", str(tmp_path)) for each in command]
    before = set(tmp_path.rglob("*"))
    subprocess.run(
        [sys.executable, "-B", *command[1:]], cwd=kit, check=True, stdout=subprocess.DEVNULL
    )
    out = Path(beside.replace("/instructor", str(tmp_path)))
    marks = json.loads((out / "class" / "ann.json").read_text(encoding="utf-8"))
    assert marks["points"] == marks["max_points"] == 2
    assert [
        new for new in set(tmp_path.rglob("*")) - before if out not in (new, *new.parents)
    ] == []
