"""What the grader costs: a student's wait, a full grade, and the wall around it.

What is compared comes from one run, taken in turns; the least of the rounds counts, and the ratio
is what to look at. Only the shipped solution is run without the wall: nothing else ever is. What
runs in one process compiles each module anew for each check, a fifth of its time, where children
find it compiled: the ratio says what a grade costs as it is, not what a wall alone would.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from time import perf_counter  # kept: the scripted clock replaces the one in the module
from typing import Any

import pymunk
from rich.console import Console
from rich.table import Table

from grader.judge.children import Child, clean_environment, start_worker
from grader.judge.grade import KIT, Options, grading, shipped_reference
from grader.judge.workplace import work_folder
from grader.protocol import Answered, ChildSetup, Film, Play, Ready, Request, Simulate
from grader.worker.child import answer
from grader.worker.film import Camera
from grader.worker.output import Output
from grader.worker.scripted import ScriptedClock
from grader.worker.subject import Subject

STEP_OF_A_SPACE = pymunk.Space.step.__code__


@dataclass
class Times:
    total: float = 0.0  # s
    simulating: float = 0.0  # s of it inside World.step, Space.step and main()


class OpenChild(Child):
    """A child that is no process at all: the same answers from this very one."""

    def __init__(self, setup: ChildSetup, clock: ScriptedClock, times: Times) -> None:
        self.ready, self.times, self.over = Ready(0, []), times, ""
        self.cpu = self.rested = 0.0
        self.heard = 0
        self.folder = setup.submission
        self.clock, self.output = clock, Output()
        self.streams = sys.stdout, sys.stderr
        self.output.install()
        self.subject = Subject(Path(setup.submission))

    def ask(self, request: Request | Film) -> Answered:
        assert not isinstance(request, Film)  # no replays are made here
        start = perf_counter()
        camera = Camera(self.subject)
        reply = answer(self.subject, self.clock, self.output, camera, request)
        if isinstance(request, Simulate | Play):
            self.times.simulating += perf_counter() - start
        return Answered(0, reply)

    def end(self) -> None:
        sys.stdout, sys.stderr = self.streams
        sys.path.remove(self.folder)
        forget_modules(self.folder)
        pymunk.Space.step.__code__ = STEP_OF_A_SPACE  # which a play counts, for good

    def finish(self) -> None:
        self.end()


class OpenWorker:
    """Stands in for the warm worker, without processes, pipe and limits."""

    def __init__(self, times: Times) -> None:
        self.layers: list[str] = []
        self.times = times
        self.clock = ScriptedClock()

    def open(self, setup: ChildSetup) -> Child:
        return OpenChild(setup, self.clock, self.times)

    def end(self, child: Child, gone: bool) -> int | None:
        return 0

    def close(self) -> None:
        pass


def forget_modules(folder: str) -> None:
    for name, module in list(sys.modules.items()):
        if str(getattr(module, "__file__", None)).startswith(folder):
            del sys.modules[name]


@contextmanager
def replaced_clocks(clock: ScriptedClock) -> Iterator[None]:
    """The scripted clock for as long as the submission's code runs."""
    import datetime
    import time

    import pygame

    before: list[tuple[Any, dict[str, Any]]] = [
        (module, dict(vars(module)))
        for module in (datetime, time, pygame, pygame.time, pygame.display)
    ]
    clock.install()
    try:
        yield
    finally:
        for module, names in before:
            vars(module).update(names)


def run_once(isolated: bool) -> Times:
    """One full grade of the solution."""
    times, options = Times(), Options(shipped_reference(), trusted=True)
    start = perf_counter()
    worker: Any = start_worker() if isolated else OpenWorker(times)
    clocks = nullcontext() if isolated else replaced_clocks(worker.clock)
    try:
        with grading(KIT / "solution", options, worker) as run, clocks:
            result = run.run()
    finally:
        worker.close()
    times.total = perf_counter() - start
    if result.points != result.max_points:
        raise RuntimeError(f"the solution got {result.points} of {result.max_points} points")
    return times


@contextmanager
def watching(tree: Path, todo: str) -> Iterator["subprocess.Popen[str]"]:
    """A `check --watch` that has shown its first result."""
    command = [sys.executable, "-m", "grader", "check", "--todo", todo, "--watch"]
    with subprocess.Popen(command, cwd=tree, stdout=subprocess.PIPE, text=True) as process:
        read_until(process, "Watching")
        try:
            yield process
        finally:
            process.terminate()


def read_until(process: "subprocess.Popen[str]", start: str) -> None:
    assert process.stdout is not None
    if not any(line.startswith(start) for line in process.stdout):
        raise RuntimeError(f"check --watch ended before it said: {start}")


def seconds_to_answer(tree: Path, name: str) -> float:
    """How long a student's command takes, from the shell's prompt to the next one."""
    start = perf_counter()
    command = [sys.executable, "-m", "grader", name, "--todo", "4"]
    subprocess.run(command, cwd=tree, stdout=subprocess.DEVNULL, check=True)
    return perf_counter() - start


def seconds_after_save(tree: Path, process: "subprocess.Popen[str]") -> float:
    """How long a watch takes, from a save inside TODO 4 to its points."""
    path = tree / "mini_engine" / "solver.py"
    text = path.read_text(encoding="utf-8").replace("    # END TODO 4", "    #\n    # END TODO 4")
    start = perf_counter()
    path.write_text(text, encoding="utf-8")
    read_until(process, "TODO 4:")
    return perf_counter() - start


def bench_check(rounds: int, console: Console) -> None:
    """Print how long a student waits for TODO 4."""
    cold, hint, warm = [], [], []
    with work_folder() as work:
        tree = work / "tree"
        shutil.copytree(KIT / "solution", tree, ignore=shutil.ignore_patterns("__pycache__"))
        with watching(tree, "4") as process:
            for _ in range(rounds):
                cold.append(seconds_to_answer(tree, "check"))
                hint.append(seconds_to_answer(tree, "hint"))
                warm.append(seconds_after_save(tree, process))
    table = Table("a student waits for TODO 4", "best, s", "median, s", "ratio")
    table.title = f"all cores, {rounds} rounds"
    for name, times in (
        ("check --todo 4", cold),
        ("hint --todo 4: Python and the command line alone", hint),
        ("check --watch, after a save", warm),
    ):
        ratio = f"{min(times) / min(cold):.2f}"
        table.add_row(name, f"{min(times):.2f}", f"{median(times):.2f}", ratio)
    console.print(table)


def bench(rounds: int, console: Console) -> None:
    """Print how long a student waits, and then the price of a grade on one core."""
    bench_check(rounds, console)
    os.environ.update(clean_environment())
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    run_once(True), run_once(False)  # everything is imported and compiled after this
    walled, plain = [], []
    for _ in range(rounds):
        walled.append(run_once(True))
        plain.append(run_once(False))
    best, open_best = (min(each, key=lambda times: times.total) for each in (walled, plain))
    table = Table("one full grade of the solution", "s", "ratio")
    table.title = f"one core, best of {rounds} rounds"
    table.add_row(
        "with processes, pipe and limits",
        f"{best.total:.2f}",
        f"{best.total / open_best.total:.2f}",
    )
    table.add_row("the same checks in one process", f"{open_best.total:.2f}", "1.00")
    table.add_row(
        "of that, the simulation alone",
        f"{open_best.simulating:.2f}",
        f"{open_best.simulating / open_best.total:.2f}",
    )
    console.print(table)
