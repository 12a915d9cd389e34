"""Stop or kill the judge, or fill its disk."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from grader.intake.listing import open_class
from grader.judge.task import KIT
from grader.judge.wall import children
from grader.judge.wall.children import ChildEnded, WarmWorker, start_worker
from grader.judge.wall.workplace import PREFIX, lock_folder, remove_leftovers, work_folder
from grader.protocol import Call, ChildSetup, Import, Limits, Returned

soak = pytest.mark.soak
posix = pytest.mark.skipif(os.name == "nt", reason="signals and locks of POSIX")


def hear_all_signals() -> None:
    """Undo that background processes and nohup ignore some signals."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def start_grade(place: Path, *arguments: str) -> "subprocess.Popen[str]":
    """Start a grade with its own temporary folder, and wait until a child has been opened."""
    place.mkdir(exist_ok=True)
    process = subprocess.Popen(
        [sys.executable, "-m", "grader", "grade", *(arguments or ("solution",))],
        cwd=KIT,
        env=os.environ | {"TMPDIR": str(place)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=hear_all_signals,
    )
    for _ in range(60_000):
        work = f"{PREFIX}*/tmp*"  # a child has been asked for; of a class, one folder deeper
        if any(place.glob(work)) or any(place.glob(f"{PREFIX}*/{work}")):
            return process
        if process.poll() is not None:
            break
        time.sleep(0.01)
    process.kill()
    raise AssertionError("it did not begin to grade")


@posix
@pytest.mark.parametrize(
    "name", ["SIGTERM", pytest.param("SIGHUP", marks=soak), pytest.param("SIGINT", marks=soak)]
)
def test_a_stopped_grade_says_so_and_leaves_nothing(tmp_path: Path, name: str):
    process = start_grade(tmp_path / "place")
    process.send_signal(getattr(signal, name))
    _, said = process.communicate(timeout=600)
    assert process.returncode == 2 and "stopped before the end" in said
    assert list((tmp_path / "place").iterdir()) == []


@soak
@posix
def test_a_stopped_class_leaves_nothing(tmp_path: Path):
    for name in ("ann", "ben"):
        (tmp_path / "class" / name).mkdir(parents=True)
        program = (KIT / "solution" / "integrators.py").read_bytes()
        (tmp_path / "class" / name / "integrators.py").write_bytes(program)
    process = start_grade(tmp_path / "place", "--class", str(tmp_path / "class"), "--jobs", "1")
    process.terminate()
    _, said = process.communicate(timeout=600)
    assert process.returncode == 2 and "what is graded stays" in said
    assert wait_until_empty(tmp_path / "place")  # by the class's own process, which ends by itself


def wait_until_empty(folder: Path) -> bool:
    for _ in range(60_000):
        if not any(folder.iterdir()):
            return True
        time.sleep(0.01)
    return False


@posix
@pytest.mark.parametrize("killed", [False, pytest.param(True, marks=soak)])
def test_the_next_grade_removes_what_a_killed_one_left(tmp_path: Path, killed: bool):
    place = tmp_path / "place"
    if killed:
        process = start_grade(place)
        helpers = psutil.Process(process.pid).children(recursive=True)
        process.kill()
        process.communicate()
        psutil.wait_procs(helpers, timeout=600)  # its children end by themselves
    else:
        (place / f"{PREFIX}1" / "tmp1").mkdir(parents=True)
    left = [*place.iterdir()]
    assert left
    for each in left:
        os.utime(each, (1, 1))  # long ago
    living = place / f"{PREFIX}living"
    living.mkdir()
    os.utime(living, (1, 1))
    stranger = place / "notes"
    stranger.mkdir()
    lock = lock_folder(living)
    remove_leftovers(str(place))
    assert sorted(place.iterdir()) == [stranger, living]
    assert lock is not None
    os.close(lock)


@posix
def test_a_folder_in_use_is_locked_and_then_removed():
    with work_folder() as work:
        assert lock_folder(work) is None
    assert not work.exists()


@soak
@posix
def test_a_full_disk_is_a_sentence_and_status_2(tmp_path: Path):
    """Files of over 100 kB are refused, as on a full disk, so the copy of a submission fails."""
    ann = tmp_path / "ann"
    ann.mkdir()
    (ann / "integrators.py").write_bytes((KIT / "solution" / "integrators.py").read_bytes())
    (ann / "film.bin").write_bytes(bytes(200_000))
    program = (
        "import resource, signal, sys; signal.signal(signal.SIGXFSZ, signal.SIG_IGN); "
        "resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000)); "
        "from grader.cli.main import main; sys.argv[1:] = ['grade', sys.argv[1]]; main()"
    )
    command = [sys.executable, "-c", program, str(ann)]
    done = subprocess.run(command, cwd=KIT, capture_output=True, text=True)
    assert done.returncode == 2 and "cannot go on" in done.stderr, done.stderr
    assert "Traceback" not in done.stderr


# ---------------------------------------------------------------- the warm process

STOPS = """
import os, signal
def stop_the_parent():
    os.kill(os.getppid(), signal.SIGSTOP)
    return True
def add(a, b): return a + b
"""


@posix
def test_a_warm_process_that_was_stopped_is_replaced(tmp_path: Path, monkeypatch):
    """A child could stop it if no layer forbids that."""
    monkeypatch.setattr(children, "STOPPED_SECONDS", 1)
    for name in ("submission", "bytecode", "first", "second"):
        (tmp_path / name).mkdir()
    (tmp_path / "submission" / "stops.py").write_text(STOPS, encoding="utf-8")
    everything = {"landlock-files", "own-user", "system-calls", "user-namespace"}
    worker = start_worker(without={*everything, "pid-namespace", "network-namespace"})
    assert isinstance(worker, WarmWorker)

    def open_child(scratch: str):
        submission, bytecode = str(tmp_path / "submission"), str(tmp_path / "bytecode")
        place = str(tmp_path / scratch)
        return worker.open(ChildSetup(submission, place, Limits(10), True, [], bytecode, False))

    first = open_child("first")
    first.ask(Import("stops"))
    assert first.ask(Call("stops:stop_the_parent")).reply == Returned(True)
    stopped = worker.process.pid
    first.end()
    second = open_child("second")
    assert worker.process.pid != stopped and not psutil.pid_exists(stopped)
    second.ask(Import("stops"))
    assert second.ask(Call("stops:add", [1, 2])).reply == Returned(3)
    second.end()
    worker.close()
    with pytest.raises(ChildEnded):
        second.ask(Import("stops"))


# ---------------------------------------------------------------- a class of one

METADATA = "work: {':submitters': [{':email': 'bob@school.edu'}]}\n"


@pytest.mark.parametrize("inside", ["", "work/"])
def test_a_list_inside_of_a_students_work_is_not_gradescopes(tmp_path: Path, inside: str):
    ann = tmp_path / "class" / "ann"
    (ann / "work").mkdir(parents=True)
    (ann / "submission_metadata.yml").write_text(METADATA, encoding="utf-8")
    program = (KIT / "solution" / "integrators.py").read_bytes()
    (ann / inside / "integrators.py").write_bytes(program)
    with open_class(tmp_path / "class") as taken:
        assert [each.name for each in taken.found] == ["ann"] and not taken.troubles
