"""Run commands of the grader in this process, as the command line runs them."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from grader.classroom import folder
from grader.cli.main import make_app
from grader.judge.task import KIT

OTHERS = ("MAKELEVEL", "NO_COLOR", "FORCE_COLOR", "PYTHONIOENCODING", "GITHUB_")  # of this process


def run_grader(*words: object, **options: object):
    """Run one command; the result has its output and exit status."""
    return CliRunner().invoke(make_app(), [str(each) for each in words], **options)


def start_grader(*words: object, cwd: Path = KIT, **variables: str):
    """Run a command in its own process, in a folder, with these additional variables."""
    kept = {name: each for name, each in os.environ.items() if not name.startswith(OTHERS)}
    return subprocess.run(
        [sys.executable, "-m", "grader", *map(str, words)],
        cwd=cwd,
        env=kept | {"PYTHONPATH": str(KIT), "COLUMNS": "80"} | variables,
        capture_output=True,
        encoding="utf-8",
    )


def call_class(*words: object) -> str:
    """Run a command of a class; return its output on one line."""
    done = run_grader("class", *words)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return " ".join(done.output.split())


def run_in_class(place: Path, command: str, *words: object, **lines: object):
    """Run a command in a class folder with these lines; its results may be of any course."""
    place.mkdir(exist_ok=True)
    rows = [f"{name} = {json.dumps(str(value))}\n" for name, value in lines.items()]
    (place / folder.FILE).write_text("".join(rows), encoding="utf-8")
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(folder, "find_difference", lambda *_: "")
        return run_grader("class", command, place, *words)
