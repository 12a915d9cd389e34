"""Run a process of the pool: load what each grade needs, then answer calls.

Loading begins before the first submission is read.
"""

import gc
import signal
from importlib import import_module

from grader.judge.wall.starting import start_ahead

JOB = "grader.classroom.job"
SIDE_BY_SIDE = 2  # checks at a time, while another process would be idle

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.set_threshold(10_000)  # as in `grader/__main__.py`
    start_ahead(SIDE_BY_SIDE)  # the worker loads while this process does
    import_module("grader.judge.grade")
    import_module("grader.judge.loop")
    from grader.judge.wall.outer import serve

    serve()
