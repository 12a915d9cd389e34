"""Test that submissions that use all available resources end within their limits."""

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

from grader.bank.members import fill_every_todo
from grader.judge.task import KIT
from grader.protocol import Limits

GROUPS = Path("/sys/fs/cgroup")
UNIFIED = (GROUPS / "cgroup.controllers").exists()  # version 2 of control groups
PAGE = KIT / "handouts" / "instructor" / "security.md"
HOG = """
import ctypes, os, threading, time
def attempt(take):
    try:
        while True:
            held.append(take())
    except BaseException:
        return
def file():
    name = f"piece-{len(held)}"
    with open(name, "wb") as into:
        into.write(bytes(1 << 20))
def pipe():
    ends = os.pipe()
    os.set_blocking(ends[1], False)
    attempt_once(lambda: os.write(ends[1], bytes(1 << 20)))
    return ends
def attempt_once(take):
    try:
        take()
    except BaseException:
        return
def thread():
    one = threading.Thread(target=time.sleep, args=(60,), daemon=True)
    one.start()
    return one
held = []
for take in file, pipe, lambda: bytearray(b"x") * (1 << 22), lambda: bytearray(b"x") * 4096, thread:
    attempt(take)
while True:
    pass
"""


def make_greedy(folder: Path, code: str) -> None:
    """Copy the solution, with this code in every TODO."""
    shutil.copytree(KIT / "solution", folder, ignore=shutil.ignore_patterns("__pycache__"))
    fill_every_todo(folder, code)


@contextmanager
def group_with(megabytes: int) -> Iterator[Path]:
    """Make a control group with a limit of memory without swap; skip the test if that fails."""
    group = (GROUPS if UNIFIED else GROUPS / "memory") / f"physics-grader-{os.getpid()}"
    try:
        group.mkdir()
        limit = "memory.max" if UNIFIED else "memory.limit_in_bytes"
        (group / limit).write_text(str(megabytes * 1_000_000))
    except OSError as error:
        with suppress(OSError):
            group.rmdir()
        pytest.skip(f"no control group of memory can be made here: {error}")
    try:
        yield group
    finally:
        for _ in range(100):  # killed processes take a moment to leave
            with suppress(OSError):
                group.rmdir()
                break
            time.sleep(0.1)


def killed_in(group: Path) -> int:
    """Return how many processes of a group the kernel ended for lack of memory."""
    told = group / ("memory.events" if UNIFIED else "memory.oom_control")
    return int(re.search(r"^oom_kill (\d+)$", told.read_text(), re.MULTILINE)[1])


def grade_in(group: Path, tree: Path, out: Path) -> None:
    """Grade a tree by the public command, all of it in the group."""
    one = [str(tree), "--todo", "1", "--out", str(out)]
    command = [sys.executable, "-m", "grader", "grade", *one]
    enter = f'echo $$ > "{group}/cgroup.procs" && exec "$@"'
    everything = ["sh", "-c", enter, "sh", *command]
    subprocess.run(everything, cwd=KIT, capture_output=True, timeout=400, preexec_fn=take_one_core)


def take_one_core() -> None:
    """Use one core: as many checks run at a time as there are cores."""
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


@pytest.mark.soak  # half a minute: greedy children use up their time
@pytest.mark.skipif(sys.platform != "linux", reason="control groups are Linux's")
def test_a_grade_takes_no_more_memory_than_the_page_says(tmp_path: Path) -> None:
    """The page adds up the memory of a child, of the kernel for it and of the judge.

    The submission uses all of that, in a control group that kills processes at the limit.
    """
    said = float(re.search(r"a grade takes ([\d.]+) GB at most", PAGE.read_text("utf-8"))[1])
    tree = tmp_path / "greedy"
    make_greedy(tree, HOG)
    with group_with(round(said * 1000)) as group:
        grade_in(group, tree, tmp_path / "results")
        assert killed_in(group) == 0
    assert list((tmp_path / "results").iterdir())
    with group_with(round(said * 1000) // 2) as group:  # and the account is kept
        grade_in(group, tree, tmp_path / "less")
        assert killed_in(group) > 0


# ---------------------------------------------------------------- processor time

MOST_CPU = 120.0  # s, of one submission: see grader/judge/budget.py
GREEDY = {  # code of every TODO
    "fork bomb": """
import os
while True:
    try:
        os.fork()
    except OSError:
        pass
""",
    "sleeper": """
import ctypes
ctypes.CDLL(None).usleep(7_000_000)
""",
    "memory hog": """
held = []
while True:
    try:
        held.append(bytearray(1 << 24))
    except MemoryError:
        pass
""",
}
ONE = """
import sys
from pathlib import Path
from grader.judge.grade import grade
from grader.judge.task import Options, shipped_reference
print(grade(Path(sys.argv[1]), Options(shipped_reference(), trusted=True)).points)
"""


@pytest.mark.soak  # minutes: each uses up its time
@pytest.mark.skipif(not hasattr(os, "wait4"), reason="only Unix tells what all descendants used")
@pytest.mark.parametrize("name", GREEDY)
def test_a_greedy_submission_ends_within_its_limits(name: str, tmp_path: Path):
    make_greedy(tmp_path / "tree", GREEDY[name])
    command = [sys.executable, "-c", ONE, str(tmp_path / "tree")]
    process = subprocess.Popen(command, cwd=KIT, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    points = int(process.stdout.read().split()[-1])
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert points <= 5
    assert used.ru_utime + used.ru_stime <= MOST_CPU
    assert used.ru_maxrss / 1024 <= Limits(cpu_seconds=5).data_mb + 64
