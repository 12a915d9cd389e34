"""Test the worker without processes: it grades as the usual one does, and bounds each child."""

import math
import os
import random
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pygame
import pytest
from conftest import KIT, HandIn
from whole_bank import bank, member_named

from grader.bank.verify import shared_worker
from grader.judge.grade import grade
from grader.judge.result import CheckResult, Result
from grader.judge.submission import CannotGrade
from grader.judge.task import Options
from grader.judge.wall.inline import InlineWorker
from grader.judge.wall.isolation import ONE_PROCESS, find_refusal
from grader.source.regions import read_source
from grader.worker.tab import TabChannel

pytestmark = pytest.mark.skipif(
    not hasattr(signal, "setitimer"), reason="ends an endless loop by a timer that Windows lacks"
)
SOAK = pytest.mark.soak
PACE = 0.1  # so that an endless loop ends after half a second instead of five
SAMPLE = 200  # members that the long run compares
INTEGRATORS = read_source(KIT / "solution" / "integrators.py")


def watch(seconds: float | None) -> None:
    """Interrupt a request that takes longer, as the page does; processor seconds."""
    signal.setitimer(signal.ITIMER_PROF, seconds or 0, 0.1 if seconds else 0)


@pytest.fixture
def tab() -> Iterator[InlineWorker]:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGPROF, interrupt)
    yield InlineWorker(lambda setup: TabChannel(setup, watch))
    signal.signal(signal.SIGPROF, before)


def grade_tab(folder: Path, worker: InlineWorker, *todos: str) -> Result:
    return grade(folder, Options(only=frozenset(todos), trusted=True), worker)


def checks(result: Result) -> list[CheckResult]:
    return [check for todo in result.todos for check in todo.checks]


def assert_same(folder: Path, tab: InlineWorker, *todos: str) -> Result:
    """Assert that both workers give the same result, but for the name of the isolation."""
    options = Options(only=frozenset(todos), trusted=True)
    here = grade(folder, options, tab)
    usual = grade(folder, options, shared_worker())
    assert here.isolation == [ONE_PROCESS]
    for one, other in zip(checks(here), checks(usual), strict=True):
        assert one == other
    assert msgspec.structs.replace(here, isolation=usual.isolation) == usual
    return here


def test_the_starter_gets_the_same(tab: InlineWorker):
    assert assert_same(KIT / "starter", tab).points == 0


@pytest.mark.parametrize("todo", ["5", *(pytest.param(t, marks=SOAK) for t in ("1", "7a", "8a"))])
def test_the_solution_gets_the_same(todo: str, tab: InlineWorker):
    result = assert_same(KIT / "solution", tab, todo)
    assert result.points == result.max_points


@pytest.mark.parametrize(
    "name", ["2-masses-forgotten", pytest.param("1-apart-is-not-noticed", marks=SOAK)]
)
def test_members_get_the_same(name: str, tab: InlineWorker, tmp_path: Path):
    member = member_named(name)
    member.build(tmp_path / name)
    assert_same(tmp_path / name, tab, *(member.todos or {"1"}))


@SOAK
def test_a_sample_of_the_bank_gets_the_same(tab: InlineWorker, tmp_path: Path):
    own = [each for each in bank() if each.kind in ("wrong", "right") and each.form == "package"]
    for member in random.Random(1).sample(own, SAMPLE):
        folder = tmp_path / f"{member.kind}-{member.name}"
        member.build(folder)
        assert_same(folder, tab, *(member.todos if member.kind == "wrong" else ()))


# ---------------------------------------------------------------- ends


def test_an_endless_loop_ends(tab: InlineWorker, hand_in: HandIn):
    tab.connect = lambda setup: TabChannel(setup, watch, PACE)
    loop = "\n\ndef semi_implicit_euler(x, v, dt, accel):\n    while True:\n        pass\n"
    result = grade_tab(hand_in(integrators_py=INTEGRATORS + loop), tab, "8a")
    assert "a loop that never ends?" in checks(result)[0].got


ODD_CODE = """


def semi_implicit_euler(x, v, dt, accel):
    print("x" * 10**6)
    return 0


def velocity_verlet(x, v, dt, accel):
    os._exit(3)


import os

os.environ["LAB_FRAMES"] = "1"
os.environ.pop("PATH", None)
"""


def test_odd_code_gets_the_same(tab: InlineWorker, hand_in: HandIn):
    before = dict(os.environ)
    result = assert_same(hand_in(integrators_py=INTEGRATORS + ODD_CODE), tab, "8a", "8b")
    printing, ending = (todo.checks[0] for todo in result.todos)
    assert "bytes and then" in printing.printed and "exit status 3" in ending.got
    assert dict(os.environ) == before


def test_a_library_of_the_grader_is_refused_the_same(tab: InlineWorker, hand_in: HandIn):
    assert_same(hand_in(integrators_py=INTEGRATORS + "\n\nimport pytest\n"), tab, "8a")


# ---------------------------------------------------------------- separation


CHANGES = """
import math, os, random, sys, time
import pygame
math.sqrt = pygame.Vector2 = time.time = None
pygame.extra = 1
random.seed(1)
sys.argv[:] = ["changed"]
sys.path.insert(0, "changed")
sys.setrecursionlimit(321)
os.chdir("/")
sys.stdout = None
"""


def test_nothing_that_a_submission_changes_stays(tab: InlineWorker, hand_in: HandIn):
    def state() -> list[object]:
        own = [sys.argv[:], sys.path[:], sys.getrecursionlimit(), os.getcwd(), sys.stdout]
        return [*own, math.sqrt, pygame.Vector2, set(sys.modules), vars(pygame).keys() - set()]

    grade_tab(KIT / "starter", tab, "8a")  # loads what checks need
    before = state()
    result = grade_tab(hand_in(integrators_py=CHANGES + INTEGRATORS), tab, "8a")
    assert result.points == result.max_points, checks(result)[0].got
    assert state() == before


# ---------------------------------------------------------------- a student's own work only


def test_the_tab_refuses_work_of_others(tab: InlineWorker):
    with pytest.raises(CannotGrade, match="may not run inside the grader's own process"):
        grade(KIT / "starter", Options(), tab)
    assert find_refusal("none", [ONE_PROCESS], trusted=False)
    assert not find_refusal("none", [ONE_PROCESS], trusted=True)
