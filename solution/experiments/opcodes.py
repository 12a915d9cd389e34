"""Counting what runs, from outside: the engines hold no code for it, so it costs them nothing.

An opcode is one instruction of Python's machine. How many run is the same from run to run, unlike
time; compare counts within one version of Python only.
"""

import gc
import sys
from collections import Counter, defaultdict
from pathlib import Path


def count_opcodes(call):
    """How many opcodes call() runs, by the name of the file they are in."""
    counts = defaultdict(int)

    def trace(frame, event, _):
        if event == "opcode":
            counts[frame.f_code.co_filename] += 1
        elif event == "call":
            frame.f_trace_opcodes = True
            frame.f_trace_lines = False
        return trace

    before, collecting = sys.gettrace(), gc.isenabled()
    gc.disable()  # others may have asked to be called when garbage is collected
    sys._getframe().f_trace_opcodes = True  # or Python 3.12 tells of no opcode at all
    sys.settrace(trace)
    try:
        call()
    finally:
        sys.settrace(before)
        if collecting:
            gc.enable()
    return by_name(counts)


def by_name(counts):
    """Counts by a file's whole path, added up by its name."""
    named = Counter()
    for path, count in counts.items():
        named[Path(path).name] += count
    return named


def files_run(call):
    """The names of the files whose functions call() runs."""
    paths = set()
    profiled(call, lambda frame: paths.add(frame.f_code.co_filename))
    return {Path(path).name for path in paths}


def count_calls(call, watched):
    """How often call() does what is watched.

    watched has rows of (name, function, how much): each time the function starts, the count of
    that name grows by how_much(its first argument).
    """
    counts = Counter({name: 0 for name, _, _ in watched})
    rows = defaultdict(list)
    for name, function, how_much in watched:
        rows[function.__code__].append((name, how_much))

    def look(frame):
        code = frame.f_code
        if code in rows:
            first = frame.f_locals[code.co_varnames[0]]
            for name, how_much in rows[code]:
                counts[name] += how_much(first)

    profiled(call, look)
    return counts


def profiled(call, look):
    """Run call() and show look() the frame of every Python function that starts."""
    before = sys.getprofile()
    sys.setprofile(lambda frame, event, _: look(frame) if event == "call" else None)
    try:
        call()
    finally:
        sys.setprofile(before)
