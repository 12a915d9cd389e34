"""Limit a submission and the judge that reads it, measured from outside."""

import os
import stat
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from grader.intake import packing
from grader.intake.found import CannotTake, Work
from grader.judge.task import KIT
from grader.judge.wall import outer
from grader.judge.wall.outer import Allowance, Exceeded, Failed, Lost, call_within

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="forks are watched where the system tells of all processes"
)
LITTLE = Allowance("reading it", cpu=0.5, memory=200)


def loop() -> int:
    while True:
        pass


def loop_elsewhere() -> int:
    if os.fork():
        os.wait()
    return loop()


def eat() -> int:
    held = []
    while True:
        held.append(bytearray(b"x") * (1 << 20))
        time.sleep(0.002)


def gulp() -> int:
    return len(bytes(1 << 40))


def sleep() -> int:
    time.sleep(1000)
    return 0


@pytest.mark.parametrize(
    ("work", "limit"),
    [
        (loop, "0.5 s of processor time"),
        (loop_elsewhere, "0.5 s of processor time"),
        (eat, "200 MB of memory"),
        (gulp, "200 MB of memory"),
        (sleep, "1 s"),
    ],
)
def test_a_limit_ends_the_work_with_a_sentence(work: Callable[[], int], limit: str):
    allowance = replace(LITTLE, seconds=1) if work is sleep else LITTLE
    with pytest.raises(Exceeded) as raised:
        call_within(allowance, int, work)
    assert str(raised.value) == f"needs manual review: reading it takes more than {limit}"


def test_a_value_comes_back_and_an_exception_as_what_it_was():
    def refuse() -> int:
        raise CannotTake("broken")

    assert call_within(LITTLE, tuple[int, bytes], lambda: (os.getppid(), b"x")) == (
        os.getpid(),
        b"x",
    )
    with pytest.raises(CannotTake, match="broken"):
        call_within(LITTLE, int, refuse, (CannotTake,))
    with pytest.raises(Failed, match="CannotTake: broken"):
        call_within(LITTLE, int, refuse)
    with pytest.raises(Lost):
        call_within(LITTLE, int, lambda: os._exit(3))


def test_nothing_is_left_of_work_that_was_ended(tmp_path: Path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))

    def write() -> int:
        with packing.work_folder() as place:
            (place / "file").write_bytes(b"x")
            return loop()

    with pytest.raises(Exceeded):
        call_within(LITTLE, int, write)
    assert list(tmp_path.iterdir()) == []


def test_children_with_users_of_their_own_can_enter_the_folder_of_a_call():
    """Otherwise nothing is graded as root where there are no namespaces and no Landlock."""
    assert call_within(LITTLE, int, read_mode) == 0o711
    with closing(outer.WatchedProcess()) as process:
        assert process.call(Allowance("it", 10), int, read_mode) == 0o711


def read_mode() -> int:
    return stat.S_IMODE(os.stat(tempfile.gettempdir()).st_mode)


def test_a_submission_that_takes_too_long_to_read_cannot_be_taken(tmp_path: Path, monkeypatch):
    (tmp_path / "integrators.py").write_text("x = 1\n", encoding="utf-8")
    monkeypatch.setattr(packing, "READING", LITTLE)
    monkeypatch.setattr(packing, "read_package", lambda found, asked: loop())
    with pytest.raises(CannotTake, match="manual review: reading it takes more than"):
        packing.pack(Work("ann", (tmp_path,)))


def test_time_of_ended_children_counts():
    def work() -> float:
        child = os.fork()
        if not child:
            until = time.process_time() + 0.3
            while time.process_time() < until:
                pass
            os._exit(0)
        os.waitpid(child, 0)
        return sum(cpu for cpu, _ in outer.measure_family(os.getpid()).values())

    assert call_within(Allowance("it", 10), float, work) >= 0.25


def test_other_systems_are_measured_too(monkeypatch):
    told = outer.measure_family(os.getpid())
    monkeypatch.setattr(outer, "LISTS_CHILDREN", False)
    assert outer.measure_family(os.getpid()).keys() >= {os.getpid()}
    assert told.keys() >= {os.getpid()}


WHOLE = """
import os, sys, time
from grader.judge.wall import outer
from grader.errors import Stop
try:
    outer.go_on_within(outer.Allowance("grading it", cpu=0.5, memory=200, seconds=30))
except Stop as error:
    print(error)
    sys.exit(2)
print("works", flush=True)
while sys.argv[1] == "loops":
    pass
time.sleep(1000 if sys.argv[1] == "waits" else 0)
sys.exit(7)
"""


def run_whole(kind: str, program: str = WHOLE) -> "subprocess.Popen[str]":
    command = [sys.executable, "-c", program, kind]
    return subprocess.Popen(command, cwd=KIT, stdout=subprocess.PIPE, text=True)


@pytest.mark.parametrize(
    ("kind", "said", "status"),
    [
        ("ends", "works\n", 7),
        ("loops", "works\nneeds manual review: grading it takes more than 0.5 s of proc", 2),
    ],
)
def test_a_command_goes_on_within_the_limits(kind: str, said: str, status: int):
    process = run_whole(kind)
    assert process.communicate()[0].startswith(said)
    assert process.returncode == status


def test_a_command_that_is_ended_ends_what_it_watches():
    process = run_whole("waits")
    assert process.stdout is not None
    assert process.stdout.readline() == "works\n"
    process.terminate()
    assert process.wait() == 128 + 15
    process = run_whole("waits")
    assert process.stdout is not None
    assert process.stdout.readline() == "works\n"
    process.kill()
    assert process.stdout.read() == ""  # also the watched process is gone, whose output this is
    process.wait()


def test_a_signal_that_comes_at_once_is_forwarded():
    early = """
import signal
fork = os.fork
def fork_and_be_ended():
    parent = os.getpid()
    if pid := fork():
        os.kill(parent, signal.SIGTERM)
    return pid
os.fork = fork_and_be_ended
"""
    imports, rest = WHOLE.split("try:", 1)
    process = run_whole("waits", f"{imports}{early}try:{rest}")
    process.communicate()
    assert process.returncode == 128 + 15
