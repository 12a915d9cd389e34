"""Count the lines of a submission that run: the same measure of work on every machine.

The submission runs in this process, so it can reach the count. We notice if it ends the count,
works in another thread or hides a function. We do not notice if it overwrites the number.
"""

import _thread
import sys
from collections.abc import Callable, Iterator
from types import CodeType, FrameType, FunctionType, ModuleType
from typing import Any

from grader.worker import standin
from grader.worker.values import ContractError

try:
    from resource import RUSAGE_SELF, RUSAGE_THREAD, getrusage
except ImportError:  # only Linux counts the seconds of a thread
    WHOSE: tuple[int, ...] = ()
else:
    WHOSE = (RUSAGE_SELF, RUSAGE_THREAD)

Trace = Callable[[FrameType, str, object], Any]
ENDS = {  # events of an audit hook
    "sys.settrace",
    "sys.setprofile",
    "sys.monitoring.register_callback",
}
THREAD_STARTS = (_thread.start_new_thread, _thread.start_new)
IMPORTING = "_frozen_importlib"
ELSEWHERE = 0.005  # s of work in other threads that count as interference


class LineCounter:
    """Counts lines inside a `with`, in every function but replacements and Python's importing.

    Lines of a library count too, or a submission could hide its work in a file of that name.
    """

    has_hook = False  # an audit hook cannot be removed, so it is added when first needed

    def __init__(self) -> None:
        self.counted = self.begun = self.over = 0
        self.trouble = ""
        self.hook: Trace = self.trace  # one object, to recognise it later

    def __enter__(self) -> "LineCounter":
        if not LineCounter.has_hook:
            sys.addaudithook(watch)
            LineCounter.has_hook = True
        self.elsewhere = seconds_elsewhere()
        sys.setprofile(watch_calls)
        sys.settrace(self.hook)
        counting.append(self)
        return self

    def __exit__(self, *_: object) -> None:
        held = sys.gettrace() is self.hook and sys.getprofile() is watch_calls
        counting.clear()
        sys.settrace(None)
        sys.setprofile(None)
        if not held or self.begun != self.over:
            self.trouble = self.trouble or "its lines were hidden"
        if seconds_elsewhere() - self.elsewhere > ELSEWHERE:
            self.trouble = self.trouble or "another thread worked"

    def answer(self) -> int:
        """Return the count. Raises ContractError if the submission interfered with it."""
        if self.trouble:
            raise ContractError(
                f"while the lines that run were counted, {self.trouble}: so their number is unknown"
            )
        return self.counted

    def trace(self, frame: FrameType, event: str, _: object) -> Trace | None:
        """Return the trace of a function that begins; Python calls it for each line."""
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


def watch_calls(_: FrameType, event: str, called: object) -> None:
    """Notice the start of a thread: Python 3.11 has no audit event for it."""
    if event == "c_call" and any(called is each for each in THREAD_STARTS) and counting:
        counting[0].trouble = "a thread was started"


def seconds_elsewhere() -> float:
    """Return the processor seconds of all other threads; 0 if the system does not count."""
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


# Replacements of functions, importing, and the end of the count.
UNCOUNTED = codes_of(standin, sys.modules[IMPORTING]) | {LineCounter.__exit__.__code__}
