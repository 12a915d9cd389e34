"""Prepare processes that grade in parallel, and end processes with all that they started."""

import gc
import os
import signal
import threading
from contextlib import suppress
from typing import NoReturn

SELDOM = 10_000  # new objects before it collects garbage; by default, a tenth of its time


def end_family(pid: int) -> None:
    """Kill a process and all that it started."""
    import psutil  # imported here, since it is slow

    with suppress(psutil.NoSuchProcess):
        top = psutil.Process(pid)
        for each in [top, *top.children(recursive=True)]:
            with suppress(psutil.NoSuchProcess):
                each.kill()


def stop_grading(number: int, _: object) -> NoReturn:
    signal.signal(number, signal.SIG_IGN)
    raise SystemExit(1)


def begin_process() -> None:
    """Make a process of the pool ignore Ctrl-C, end with its parent and seldom collect garbage."""
    import multiprocessing  # imported here: only a pool needs it

    gc.set_threshold(SELDOM)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, stop_grading)
    parent = multiprocessing.parent_process()

    def follow() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=follow, daemon=True).start()
