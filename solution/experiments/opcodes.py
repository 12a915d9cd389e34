"""Count what runs, from outside: the engines have no code for it, so it costs them nothing.

An opcode is one instruction of Python's machine. Unlike time, the number of opcodes is the same in
every run. Compare counts within one version of Python only.
"""

import gc
import sys
from collections import Counter, defaultdict
from pathlib import Path


def count_opcodes(call):
    """Count the opcodes that call() runs, by the name of their file."""
    counts = defaultdict(int)

    def trace(frame, event, _):
        if event == "opcode":
            counts[frame.f_code.co_filename] += 1
        elif event == "call":
            frame.f_trace_opcodes = True
            frame.f_trace_lines = False
        return trace

    before, collecting = sys.gettrace(), gc.isenabled()
    gc.disable()  # functions that others run at garbage collections would count
    sys._getframe().f_trace_opcodes = True  # otherwise Python 3.12 reports no opcode
    sys.settrace(trace)
    try:
        call()
    finally:
        sys.settrace(before)
        if collecting:
            gc.enable()
    named = Counter()
    for path, count in counts.items():
        named[Path(path).name] += count
    return named


def files_run(call):
    """Return the names of the files whose functions call() runs."""
    paths = set()
    profiled(call, lambda frame: paths.add(frame.f_code.co_filename))
    return {Path(path).name for path in paths}


def count_calls(call, watched):
    """Count the calls of watched functions while call() runs.

    `watched` has rows of (name, function, amount). Each call adds `amount` to the count of `name`,
    or amount(first argument) if that is a function.
    """
    counts = Counter({name: 0 for name, _, _ in watched})
    rows = defaultdict(list)
    for name, function, amount in watched:
        rows[function.__code__].append((name, amount))

    def look(frame):
        code = frame.f_code
        if code in rows:
            first = frame.f_locals[code.co_varnames[0]]
            for name, amount in rows[code]:
                counts[name] += amount(first) if callable(amount) else amount

    profiled(call, look)
    return counts


def profiled(call, look):
    """Run call(), and call look(frame) for every Python function that starts."""
    before = sys.getprofile()
    sys.setprofile(lambda frame, event, _: look(frame) if event == "call" else None)
    try:
        call()
    finally:
        sys.setprofile(before)
