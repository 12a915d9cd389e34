"""Counts the lines of a submission that run: a measure of work that is the same on every machine.

What is counted runs in this process, so it can reach the count. It is noticed when it ends the
count, leaves the work to another thread or hides a function. Who finds the number itself and writes
another one there, or says of its code that it is a library's, is not noticed here. So a check that
must know asks for so much, too, that the processor seconds tell, which the kernel counts.
"""

import sys
import sysconfig
from collections.abc import Callable, Iterator
from types import CodeType, FrameType, FunctionType
from typing import Any

from grader.worker import standin
from grader.worker.subject import ContractError

try:
    from resource import RUSAGE_SELF, RUSAGE_THREAD, getrusage
except ImportError:  # only Linux tells the seconds of a thread
    WHOSE: tuple[int, ...] = ()
else:
    WHOSE = (RUSAGE_SELF, RUSAGE_THREAD)

Trace = Callable[[FrameType, str, object], Any]
ENDS = {"sys.settrace", "sys.setprofile", "_thread.start_new_thread"}  # told by an audit hook
ELSEWHERE = 0.005  # s of work in other threads, of which there are none


class LineCounter:
    """Counts while it is entered, in every function but the libraries' and the detours.

    Lines are the same work whatever function they are in: calls of a function by name would say
    nothing about a submission that has written the same into the caller.
    """

    watched = False  # an audit hook is for good, and only for who is counted

    def __init__(self) -> None:
        self.lines = self.begun = self.over = 0
        self.trouble = ""
        self.hook: Trace = self.trace

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
        """The lines; raises ContractError where the count was interfered with."""
        if self.trouble:
            raise ContractError(
                f"while the lines that run were counted, {self.trouble}: so nobody knows how many "
                "they are"
            )
        return self.lines

    def trace(self, frame: FrameType, event: str, _: object) -> Trace | None:
        """Python calls this whenever a function begins; what it returns hears of each line."""
        if frame.f_code in DETOURS or frame.f_code.co_filename.startswith(LIBRARIES):
            return None
        self.begun += 1
        return self.count_line

    def count_line(self, frame: FrameType, event: str, _: object) -> Trace:
        self.lines += event == "line"
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


LIBRARIES = (*(sysconfig.get_path(each) for each in ("stdlib", "purelib", "platlib")), "<frozen ")
DETOURS = {  # our own, to what stands in for a function; and the end of the count
    code
    for function in (*vars(standin).values(), LineCounter.__exit__)
    if isinstance(function, FunctionType) and function.__module__.startswith("grader.")
    for code in codes_in(function.__code__)
}
