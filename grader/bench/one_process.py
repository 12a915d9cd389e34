"""Grade the solution once, in children or in this very process, and print the processor seconds.

Nothing but one's own work is ever graded without walls.
"""

import os
import sys

from grader.judge.children import Worker, clean_environment, start_worker
from grader.judge.grade import KIT, Options, grading, shipped_reference
from grader.judge.inline import InlineWorker
from grader.protocol import ChildSetup
from grader.worker.tab import TabChannel


def main(inside: bool) -> None:
    usual = clean_environment()
    os.environ.clear()  # it is put in place anew for each request in one process
    os.environ.update(usual)
    before = sum(os.times()[:4])  # processor s, of children that ended as well
    worker: Worker = InlineWorker(connect) if inside else start_worker()
    with grading(KIT / "solution", Options(shipped_reference(), trusted=True), worker) as run:
        result = run.run()
    worker.close()
    if result.points != result.max_points:
        sys.exit(f"the solution got {result.points} of {result.max_points} points")
    print(sum(os.times()[:4]) - before)


def connect(setup: ChildSetup) -> TabChannel:
    """Open a channel to a child in this process, which nothing interrupts."""
    return TabChannel(setup, watch=lambda seconds: None)


main(inside="--inside" in sys.argv)
