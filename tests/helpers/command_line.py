"""Run commands of the grader in this process, as the command line runs them."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from grader.classroom import folder
from grader.cli.main import make_app


def run_grader(*words: object, **options: object):
    """Run one command; the result has its output and exit status."""
    return CliRunner().invoke(make_app(), [str(each) for each in words], **options)


def call_class(*words: object) -> str:
    """Run a command of a class; return what it says, on one line."""
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
