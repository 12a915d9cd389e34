"""Let the kernel check that a grade uses no more memory than the security page says.

The page adds up the memory of a child, of the kernel for it and of the judge. Here a submission
uses all of that, in a control group that kills processes at the limit.
"""

import os
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from greedy import make_greedy

from grader.judge.task import KIT

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
