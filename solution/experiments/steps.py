"""Steps that vary, as in a game that steps by the time of each frame.

Each function yields steps (s) without end; `lasting` ends them after a time.
"""

import random
from itertools import chain, cycle, repeat


def at_random(shortest=1 / 1000, longest=1 / 50, seed=1):
    """Yield random steps between these two."""
    rng = random.Random(seed)
    while True:
        yield rng.uniform(shortest, longest)


def hiccups(step=1 / 60, count=60, pause=0.1):
    """Yield equal steps, and a pause as the last of every `count`."""
    return cycle(chain(repeat(step, count - 1), [pause]))


def in_turns(long=1 / 30, short=1 / 240, count=1):
    """Yield `count` long steps, then short steps for the same total time, and repeat."""
    return cycle(chain(repeat(long, count), repeat(short, round(count * long / short))))


def ramps(long=1 / 30, short=1 / 1000, count=60):
    """Yield steps that shrink bit by bit over `count` steps, then grow again, and repeat."""
    down = [long * (short / long) ** (i / count) for i in range(count)]
    return cycle([*down, *reversed(down)])


def remainders(step=1 / 60, rest=1e-6):
    """Yield steps, and after each a rest, as of frames cut into steps of at most that length."""
    return cycle([step, rest])


def lasting(seconds, steps):
    """Yield the first of these steps, until they last `seconds`."""
    passed = 0.0
    for dt in steps:
        if passed >= seconds:
            return
        yield dt
        passed += dt


PATTERNS = {
    "at random, 1/1000 to 1/50 s": at_random,
    "1/60 s, every 60th 0.1 s": hiccups,
    "1/30 s, then 8 of 1/240 s": in_turns,
    "1/30 s to 1/1000 s and back": ramps,
}
