"""Test that a fork bomb, a sleeper and a memory hog end within the limits of a submission."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from greedy import make_greedy

from grader.judge.task import KIT
from grader.protocol import Limits

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
