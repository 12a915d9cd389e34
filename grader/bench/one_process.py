"""Grade the solution once, in children or in this very process, and print the processor seconds.

Nothing but the solution is ever graded without walls. One process compiles each module again for
every check, a fifth of its time; children find it compiled.
"""

import os
import sys
from pathlib import Path
from typing import Any

import pymunk

from grader.judge.children import Child, clean_environment, start_worker
from grader.judge.grade import KIT, Options, grading, shipped_reference
from grader.protocol import Answered, ChildSetup, Ready, Record, Request
from grader.worker.child import answer
from grader.worker.output import Output
from grader.worker.recorder import Recorder
from grader.worker.scripted import ScriptedClock
from grader.worker.subject import Subject

STEP_OF_A_SPACE = pymunk.Space.step.__code__


class InsideChild(Child):
    """A child that is no process: this process answers in its place."""

    def __init__(self, setup: ChildSetup, clock: ScriptedClock) -> None:
        self.ready, self.over = Ready(0, []), ""
        self.cpu = self.rested = 0.0
        self.heard = 0
        self.folder = setup.submission
        self.clock, self.output = clock, Output()
        self.streams = sys.stdout, sys.stderr
        self.output.install()
        self.subject = Subject(Path(setup.submission))

    def ask(self, request: Request | Record) -> Answered:
        assert not isinstance(request, Record)  # nothing is recorded here
        recorder = Recorder(self.subject)
        return Answered(0, answer(self.subject, self.clock, self.output, recorder, request))

    def end(self) -> None:
        sys.stdout, sys.stderr = self.streams
        sys.path.remove(self.folder)
        for name, module in list(sys.modules.items()):
            if str(getattr(module, "__file__", None)).startswith(self.folder):
                del sys.modules[name]
        pymunk.Space.step.__code__ = STEP_OF_A_SPACE  # a play counts its calls, and stays

    finish = end


class InsideWorker:
    """Stand in for the warm worker, without processes, pipe and limits."""

    def __init__(self) -> None:
        self.layers: list[str] = []
        self.clock = ScriptedClock()

    def open(self, setup: ChildSetup) -> Child:
        return InsideChild(setup, self.clock)

    def end(self, child: Child, gone: bool) -> int | None:
        return 0

    def close(self) -> None: ...


def main(inside: bool) -> None:
    os.environ.update(clean_environment())
    before = sum(os.times()[:4])  # processor s, of children that ended as well
    worker: Any = InsideWorker() if inside else start_worker()
    with grading(KIT / "solution", Options(shipped_reference(), trusted=True), worker) as run:
        if inside:
            worker.clock.install()  # now that the grader has read the time
        result = run.run()
    worker.close()
    if result.points != result.max_points:
        sys.exit(f"the solution got {result.points} of {result.max_points} points")
    print(sum(os.times()[:4]) - before)


main(inside="--inside" in sys.argv)
