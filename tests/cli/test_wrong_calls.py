"""Test that each wrong call ends with a message before any work, without traceback or files."""

import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import classes
import packed
import pytest
from command_line import run_grader
from conftest import KIT
from points_pool import Inline
from rich.console import Console
from samples import sample

from grader.bank import mutants, verify
from grader.classroom import executor, grading
from grader.classroom.grading import ClassOptions, run_class
from grader.judge import grade
from grader.judge.task import Options
from grader.questions import making

WRONG = """
grade nosuch
grade --class
grade --class nosuch
grade --class empty
grade --class list.csv
grade class
grade empty
grade list.csv
grade class/ann class/ben
grade submission=class/ann
grade class/ann --class
grade class/ann --jobs -3
grade --class class --jobs -3
grade --class class --jobs many
grade --class class --out class/results
grade --class class --out class
grade --class class --out list.csv
grade --class class --out list.csv/results
grade --class class --at-least 5
grade --class class --json x.json
grade --class class --ci x
grade class/ann --at-least 200
grade class/ann --at-least 41 --course course.toml
grade class/ann --at-least -1
grade class/ann --todo 99
grade class/ann --todo 4 --course course.toml
grade class/ann --course nosuch.toml
grade class/ann --course bad.toml
grade class/ann --course empty
grade class/ann --isolation nosuch
grade class/ann --seed abc
grade class/ann --reference nosuch
grade class/ann --reference empty
grade class/ann --json class
grade class/ann --json list.csv/x.json
grade class/ann --out list.csv
grade class/ann --ci class
grade class/ann --ci new --json class
grade --out new
grade --nosuchoption
verify --only nosuch
verify --jobs -1
verify --course bad.toml
release --jobs -1
release --out list.csv
release --course nosuch.toml
mutants --todo 99
mutants --count -1
mutants --jobs -2
bench --rounds 0
sync now
dashboard nosuch
dashboard class
gradescope --out class
gradescope --seed x
course-check --course bad.toml
questions
questions nosuch
questions class/ann --seed x
class new list.csv
class new class --roster nosuch.csv
class grade nosuch
class grade class
class marks nosuch
class feedback nosuch
class upload nosuch
class questions nosuch
questions class/ann --out list.csv
nbgrader course list.csv --without-checks
nbgrader course new --release list.csv
nbgrader collect class --folder nosuch
nbgrader bridge --folder nosuch
nbgrader bridge --course class
nbgrader bridge results --jobs 2
export nosuch list.csv
export html nosuch.json
export html results
export csv empty
export junit list.csv
export html results/ann.json --out class
check --todo 99
check class/ann class/ben
check --course bad.toml
hand-in --out class
hint
hint --todo 99
hint --todo 1 --course bad.toml
hint --todo 4 --level 9
nosuchcommand
"""


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Make a folder with two classes, the results of one, and useless files."""
    folder = tmp_path_factory.mktemp("calls")
    for name in ("class/ann", "class/ben", "other/zoe"):
        classes.put(folder / f"{name}.zip", packed.as_zip(classes.work(3)))
        shutil.unpack_archive(folder / f"{name}.zip", folder / name)
        (folder / f"{name}.zip").unlink()
    (folder / "empty").mkdir()
    (folder / "list.csv").write_text("Email address\nann\nben\n", encoding="utf-8")
    (folder / "course.toml").write_text('todos = ["8c"]\n', encoding="utf-8")
    (folder / "bad.toml").write_text("todos = [\n", encoding="utf-8")
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(grading, "open_executor", lambda wanted: Inline())
        wanted = ClassOptions(Options(), out=folder / "results")
        run_class(folder / "class", wanted, Console(quiet=True))
    return folder


needs_make = pytest.mark.skipif(shutil.which("make") is None, reason="there is no make here")


class Begun(Exception):
    """Raised when work begins."""


@pytest.fixture(autouse=True)
def without_work(monkeypatch: pytest.MonkeyPatch, place: Path) -> None:
    def begin(*_: object, **__: object) -> None:
        raise Begun

    monkeypatch.chdir(place)
    for module in (grade, executor, making, verify):
        monkeypatch.setattr(module, "start_worker", begin)
    for module in (verify, mutants):
        monkeypatch.setattr(module, "run_in_processes", begin)
    monkeypatch.setattr(executor.Pool, "__enter__", begin)


def list_all(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("call", sample(WRONG.strip().splitlines(), 3))
def test_a_wrong_call_ends_in_a_sentence_before_any_work(call: str, place: Path):
    before = list_all(place)
    done = run_grader(*shlex.split(call))
    assert isinstance(done.exception, SystemExit), done.exception
    assert done.exit_code == (1 if call.startswith("course-check --") else 2)
    said = " ".join(done.output.split())
    assert 20 < len(said) < 900 and "Traceback" not in said and "Errno" not in said
    assert list_all(place) == before


@needs_make
@pytest.mark.parametrize(
    "call, words",
    [
        ("grade submission=x", "make knows no submission="),
        ("grade SUBMISION=x", "make knows no SUBMISION="),
        ("grade SUBMISSION=a SUBMISSIONS=b", "name one of the two"),
        ("dashboard", "make dashboard needs RESULTS=folder"),
        ("course", "make course needs COURSE=folder"),
        ("contained", "make contained needs SUBMISSIONS=folder"),
    ],
)
def test_make_does_not_pass_over_what_it_does_not_know(call: str, words: str):
    done = call_make(KIT, call)
    assert done.returncode == 2 and words in done.stderr and not done.stdout


def call_make(folder: Path, call: str) -> "subprocess.CompletedProcess[str]":
    command = ["make", "--dry-run", *call.split()]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True)


@needs_make
@pytest.mark.parametrize("call", ["check TOD=3", "check al=1", "hint TODO=3 LEVL=2"])
def test_make_of_students_does_not_pass_over_what_it_does_not_know(call: str):
    done = call_make(KIT / "starter", call)
    assert done.returncode == 2 and "; it knows PYTHON TODO ALL" in done.stderr
    assert call_make(KIT / "starter", "check TODO=3 ALL=1 PYTHON=python3").returncode == 0
    assert call_make(KIT / "starter", "check todo=3").returncode == 0


def test_a_missing_package_is_a_sentence():
    command = [sys.executable, "-S", "-m", "grader", "class", "grade", "lab3"]
    done = subprocess.run(command, cwd=KIT, capture_output=True, text=True)
    assert done.returncode == 2 and "is not installed for" in done.stderr
    assert "make setup" in done.stderr and "Traceback" not in done.stderr


@needs_make
def test_less_than_full_marks_is_no_error_of_make():
    command = ["make", "--dry-run", "grade", "SUBMISSION=x"]
    done = subprocess.run(command, cwd=KIT, capture_output=True, text=True)
    assert done.stdout.rstrip().endswith('"x" || test $? -eq 1')
