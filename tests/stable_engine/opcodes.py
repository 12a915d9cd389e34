"""Counting the bytecode that runs: the same from run to run, unlike time.

Run as a program with the name of an effect, it prints how many opcodes 6 steps of the playground
cost without that effect; with "unavailable" behind it, the effect's module cannot be had at all.
"""

import sys
from collections import Counter
from pathlib import Path
from types import ModuleType


def count_opcodes(call):
    """How many opcodes call() runs, by the name of the file they are in."""
    counts = Counter()

    def trace(frame, event, _):
        if event == "call":
            frame.f_trace_opcodes = True
            frame.f_trace_lines = False
        elif event == "opcode":
            counts[Path(frame.f_code.co_filename).name] += 1
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        call()
    finally:
        sys.settrace(before)
    return counts


def files_run(call):
    """The names of the files whose functions call() runs."""
    files = set()
    before = sys.getprofile()
    sys.setprofile(lambda frame, *_: files.add(Path(frame.f_code.co_filename).name))
    try:
        call()
    finally:
        sys.setprofile(before)
    return files


class Unavailable(ModuleType):
    """A module in which every name is an empty class."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return type(name, (), {})


def main(effect, *unavailable):
    if unavailable:
        module = f"stable_engine.{effect.lower()}"
        sys.modules[module] = Unavailable(module)
    from measures import run
    from scenes import DT, all_but, build_playground

    world = build_playground(all_but(effect))
    run(world, 0.3)
    print(sum(count_opcodes(lambda: run(world, 6 * DT)).values()))


if __name__ == "__main__":
    main(*sys.argv[1:])
