"""Measure the cost of a run: time, and counts that other programs cannot change."""

import gc
import time
from statistics import median

from ..opcodes import count_opcodes

SLICE = 1 / 30  # simulated s: whole steps at every rate, and short enough to miss other programs
COUNTED = 2  # steps whose opcodes are counted
FINE = 1e-6  # s: with a coarser clock, a slice has no length
PROCESSOR = time.get_clock_info("process_time").resolution <= FINE


def now():
    """Return this process's own time (s), or the time of day if that clock is too coarse.

    On an idle machine both run alike.
    """
    return time.process_time() if PROCESSOR else time.perf_counter()


def wall_times(runs, rounds):
    """Measure seconds per simulated second, one for each (engine, dt) of runs.

    Each round gives every engine a slice, so that a busy moment of the machine slows all alike.
    The fastest slice of each engine counts. The time is None where an engine raises.
    """
    best = [None] * len(runs)
    gc.disable()
    try:
        for _ in range(rounds):
            for i, (engine, dt) in enumerate(runs):
                taken = time_slice(engine, dt)
                if taken is not None:
                    best[i] = taken if best[i] is None else min(best[i], taken)
    finally:
        gc.enable()
    return best


def repeated_times(runs, repeats, rounds):
    """Measure wall_times repeatedly. Return each run's time in every repeat, or None."""
    found = zip(*[wall_times(runs, rounds) for _ in range(repeats)], strict=True)
    return [None if None in taken else list(taken) for taken in found]


def spread(values):
    """Return the least, median and largest value, such as of the repeats of a time."""
    return [min(values), median(values), max(values)]


def shares(taken, unit):
    """Return the spread of `taken` / `unit` over the repeats, or None.

    A busy moment of the machine slows both down, so their share stays.
    """
    if not taken or not unit:
        return None
    return spread([one / other for one, other in zip(taken, unit, strict=True)])


def time_slice(engine, dt):
    """Return seconds per simulated second over one slice, or None if the engine raises."""
    steps = max(1, round(SLICE / dt))
    start = now()
    try:
        for _ in range(steps):
            engine.step(dt)
    except Exception:  # NaN, or a student's code
        return None
    return (now() - start) / (steps * dt)


def opcodes_per_second(engine, dt):
    """Count opcodes per simulated second. None if the engine raises. pymunk runs few."""

    def call():
        for _ in range(COUNTED):
            engine.step(dt)

    try:
        return sum(count_opcodes(call).values()) / (COUNTED * dt)
    except Exception:
        return None
