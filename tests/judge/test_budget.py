"""Limit the time of a submission: the budget of each check shrinks as it is spent, down to none."""

import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

import pytest

from grader.judge.budget import (
    END_CPU,
    END_REST,
    LITTLE_CPU,
    LITTLE_REST,
    SUBMISSION_CPU,
    SUBMISSION_REST,
    TODO_CPU,
    TODO_REST,
    WORDS_CPU,
    WORDS_REST,
    Budget,
)
from grader.judge.rubric import load_rubric
from grader.judge.task import KIT, Options, shipped_reference
from grader.judge.wall import children
from grader.judge.wall.children import REST_SECONDS, busy_seconds
from grader.player.graded import grade_with_replays

LINUX = pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells of queues")


@dataclass
class Used:
    """The costs of a connection that has ended."""

    cpu: float = 0.0
    rested: float = 0.0
    heard: int = 0


def test_a_submission_that_used_little_has_the_usual_budget():
    budget = Budget()
    budget.charge("1", Used(0.3, 0.1))
    assert (budget.cpu_for("1", 20), budget.rest_for("1")) == (20, REST_SECONDS)
    assert not budget.cut and not budget.why_little("1")


def test_a_todo_that_used_much_has_little_left_and_the_others_all():
    budget = Budget()
    budget.charge("1", Used(cpu=TODO_CPU))
    assert budget.cpu_for("1", 20) == LITTLE_CPU and budget.cpu_for("2", 20) == 20
    budget.charge("2", Used(rested=TODO_REST))
    assert budget.rest_for("2") == LITTLE_REST and budget.rest_for("3") == REST_SECONDS
    assert "this TODO" in budget.why_little("1") and not budget.why_little("3")


@pytest.mark.parametrize(
    ("much", "more", "words"),
    [
        (Used(cpu=SUBMISSION_CPU), Used(cpu=END_CPU - SUBMISSION_CPU), "90 s of processor time"),
        (Used(rested=SUBMISSION_REST), Used(rested=END_REST - SUBMISSION_REST), "rested for 32 s"),
    ],
)
def test_a_submission_that_used_much_has_little_left_and_then_nothing(
    much: Used, more: Used, words: str
):
    budget = Budget()
    budget.charge("1", much)
    little = budget.cpu_for("8a", 5) == LITTLE_CPU, budget.rest_for("8a") == LITTLE_REST
    assert little == (bool(much.cpu), bool(much.rested)) and not budget.cut
    budget.charge("2", more)
    assert words in budget.cut


def test_all_together_ends_within_two_minutes_of_work_and_one_of_rest():
    checks = [check for todo in load_rubric().todos for check in todo.checks]
    judge = 10  # s; it needs two
    assert END_CPU + max(check.cpu_seconds for check in checks) + judge <= 120
    rest = min(END_REST, SUBMISSION_REST + len(checks) * LITTLE_REST)
    assert rest + REST_SECONDS + judge <= 60


@LINUX
def test_a_process_that_waits_for_a_processor_is_busy():
    """Two loops share a processor: both have worked or queued all the time. A sleeper has not."""
    loop, sleep = "while True: pass", "time.sleep(600)"
    started = [start_loop(code) for code in (loop, loop, sleep)]
    try:
        before, began = [busy_seconds(each.pid) for each in started], time.monotonic()
        time.sleep(0.5)
        after = [busy_seconds(each.pid) for each in started]
        seconds = time.monotonic() - began
        first, second, slept = (b - a for a, b in zip(before, after, strict=True))
        assert first + second > 1.2 * seconds  # without the queue it would be at most 1 time
        assert slept < 0.1
    finally:
        for each in started:
            each.kill()
            each.communicate()


def start_loop(code: str) -> "subprocess.Popen[str]":
    """Run this code on the first processor, and return once it has begun."""
    first = min(os.sched_getaffinity(0))
    begin = f"import os, time; os.sched_setaffinity(0, [{first}]); print(flush=True); {code}"
    process = subprocess.Popen(
        [sys.executable, "-c", begin.replace("; while", "\nwhile")],
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None and process.stdout.readline() == "\n"
    return process


def test_time_in_which_the_judge_queues_is_not_rest_of_the_child(
    monkeypatch: pytest.MonkeyPatch,
):
    """On a busy machine, an answer waits until the judge runs again."""
    queued = {os.getpid(): 2.0}
    monkeypatch.setattr(children, "seconds_in_queue", lambda pid: queued[pid])
    monkeypatch.setattr(children, "busy_seconds", lambda pid: 1.0)
    child = object.__new__(children.Child)
    child.worker = SimpleNamespace(pid_of=lambda child: 1)
    child.began, child.waited, child.rested, child.looked = 2.0, 10.0, 0.0, 0.0
    queued[os.getpid()] = 9.5
    child._look()
    assert child.rested == pytest.approx(1.5)


@LINUX
def test_a_thread_that_ends_while_it_is_measured_is_skipped(monkeypatch: pytest.MonkeyPatch):
    usual = os.listdir
    monkeypatch.setattr(os, "listdir", lambda path: ["999999999", *usual(path)])
    assert children.seconds_in_queue(os.getpid()) >= 0
    with pytest.raises(OSError):
        children.seconds_in_queue(999_999_999)


@LINUX
def test_many_threads_that_wait_at_once_wait_once(monkeypatch: pytest.MonkeyPatch):
    """Otherwise a hundred threads that queue for a second would count as a hundred seconds."""
    monkeypatch.setattr(children, "list_waits", lambda pid: [1.0] * 100)
    assert children.seconds_in_queue(os.getpid()) == 1.0
    monkeypatch.setattr(children, "list_waits", lambda pid: [])
    assert children.seconds_in_queue(os.getpid()) == 0.0


def test_words_and_pictures_have_a_budget_of_their_own():
    for much in (Used(cpu=WORDS_CPU), Used(rested=WORDS_REST)):
        budget = Budget()
        budget.charge_for_words(Used(much.cpu / 2, much.rested / 2))
        assert budget.has_more
        budget.charge_for_words(much)
        assert not budget.has_more and not budget.cut
        assert (budget.cpu_for("1", 20), budget.rest_for("1")) == (20, REST_SECONDS)


SLOW = """
    import sys, time, ctypes
    frame = sys._getframe()
    while frame is not None:
        recorder = frame.f_locals.get("recorder")
        if {where} and not getattr(sys, "rested", False):
            sys.rested = True
            ctypes.CDLL(None).usleep(1_900_000)
        frame = frame.f_back
    return x + 1, v
"""


@pytest.mark.soak
@LINUX
def test_rest_in_replays_is_limited(tmp_path: Path):
    """The marks are final by then, so pictures are charged to no TODO."""
    text = (KIT / "solution" / "integrators.py").read_text(encoding="utf-8")
    for todo in ("8a", "8b", "8c"):
        begin, end = text.index(f"    # TODO {todo}"), text.index(f"    # END TODO {todo}")
        text = (
            text[:begin]
            + f"    # TODO {todo}: x"
            + SLOW.format(where="getattr(recorder, 'recording', None)")
            + text[end:]
        )
    tree = tmp_path / "tree"
    tree.mkdir()
    (tree / "integrators.py").write_text(text, encoding="utf-8")
    only = frozenset({"8a", "8b", "8c"})
    result = grade_with_replays(tree, Options(shipped_reference(), only=only), tmp_path / "pages")
    replays = [check.replay for todo in result.todos for check in todo.checks]
    assert result.points == 0 and None in replays and any(replays)
