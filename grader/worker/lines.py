"""Counts the lines of a submission that run: work that is the same on every machine.

What is counted runs in this process, so it can reach the count. It is noticed when it ends the
count, leaves the work to another thread or hides a function. Who finds the number itself and writes
another one there is not noticed.
"""

import sys
from collections.abc import Callable, Iterator
from types import CodeType, FrameType, FunctionType, ModuleType
from typing import Any

from grader.worker import standin
from grader.worker.values import ContractError

try:
    from resource import RUSAGE_SELF, RUSAGE_THREAD, getrusage
except ImportError:  # only Linux tells the seconds of a thread
    WHOSE: tuple[int, ...] = ()
else:
    WHOSE = (RUSAGE_SELF, RUSAGE_THREAD)

Trace = Callable[[FrameType, str, object], Any]
ENDS = {  # told by an audit hook
    "sys.settrace",
    "sys.setprofile",
    "sys.monitoring.register_callback",
    "_thread.start_new_thread",
}
IMPORTING = "_frozen_importlib"
ELSEWHERE = 0.005  # s of work in other threads, of which there are none


class LineCounter:
    """Counts while it is entered, in every function but the detours and Python's own importing.

    Lines are the same work whatever function they are in: calls of a function by name would say
    nothing about a submission that has written the same into the caller. So lines of a library
    count too, and nobody gains by the name of a file.
    """

    watched = False  # an audit hook is for good, and only for who is counted

    def __init__(self) -> None:
        self.counted = self.begun = self.over = 0
        self.trouble = ""
        self.hook: Trace = self.trace  # one object, to know it again

    def __enter__(self) -> "LineCounter":
        if not LineCounter.watched:
            sys.addaudithook(watch)
            LineCounter.watched = True
        self.elsewhere = seconds_elsewhere()
        sys.settrace(self.hook)
        counting.append(self)
        return self

    def __exit__(self, *_: object) -> None:
        held = sys.gettrace() is self.hook
        counting.clear()
        sys.settrace(None)
        if not held or self.begun != self.over:
            self.trouble = self.trouble or "its lines were hidden"
        if seconds_elsewhere() - self.elsewhere > ELSEWHERE:
            self.trouble = self.trouble or "another thread worked"

    def answer(self) -> int:
        """Return how many there were; raises ContractError where the count was interfered with."""
        if self.trouble:
            raise ContractError(
                f"while the lines that run were counted, {self.trouble}: so nobody knows how many "
                "they are"
            )
        return self.counted

    def trace(self, frame: FrameType, event: str, _: object) -> Trace | None:
        """Python calls this whenever a function begins; what it returns hears of each line."""
        if frame.f_code in UNCOUNTED:
            return None
        self.begun += 1
        return self.count_line

    def count_line(self, frame: FrameType, event: str, _: object) -> Trace:
        self.counted += event == "line"
        self.over += event == "return"
        return self.count_line


counting: list[LineCounter] = []  # one at most


def watch(event: str, _: tuple[Any, ...]) -> None:
    if event in ENDS and counting:
        counting[0].trouble = f"{event} was called"


def seconds_elsewhere() -> float:
    """Processor seconds of all threads but this one; 0 where nobody knows."""
    if not WHOSE:
        return 0.0
    whole, own = (used.ru_utime + used.ru_stime for used in map(getrusage, WHOSE))
    return whole - own


def codes_in(code: CodeType) -> Iterator[CodeType]:
    yield code
    for each in code.co_consts:
        if isinstance(each, CodeType):
            yield from codes_in(each)


def codes_of(*modules: ModuleType) -> frozenset[CodeType]:
    """Return the code of all functions and methods that these modules define."""
    things = [thing for module in modules for thing in vars(module).values()]
    things += [each for thing in things if isinstance(thing, type) for each in vars(thing).values()]
    return frozenset(
        code
        for thing in things
        if isinstance(thing, FunctionType) and thing.__module__.startswith(("grader.", IMPORTING))
        for code in codes_in(thing.__code__)
    )


# What stands in for a function of the submission, importing, and the end of the count.
UNCOUNTED = codes_of(standin, sys.modules[IMPORTING]) | {LineCounter.__exit__.__code__}
