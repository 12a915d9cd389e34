"""Time in ms since the page has loaded pygame, and the Clock of game loops."""

import time

from .math import to_float
from .naming import Named
from .state import State

START = time.perf_counter()
LAST = 10  # ticks that get_fps counts


class Clock(metaclass=Named):
    """A clock that ends frames and measures them.

    The page sets `wait_hook(fps, last)`, which rests until 1/fps seconds after `last` (a time
    of perf_counter) and posts new events.
    """

    wait_hook = None

    def __init__(self):
        self._last, self._length = time.perf_counter(), 0
        self._lengths = []

    def tick(self, framerate=0):
        """End a frame after at least 1/framerate seconds; return its length in ms."""
        framerate = to_float(framerate)
        rest(framerate, self._last)
        State.ticked = True
        now = time.perf_counter()
        self._length, self._last = int((now - self._last) * 1000), now
        self._lengths = [*self._lengths[1 - LAST :], self._length]
        return self._length

    tick_busy_loop = tick

    def get_time(self):
        """Return the length of the last frame in ms."""
        return self._length

    def get_fps(self):
        """Return the frames per second of the last ten; 0 before there are ten."""
        whole = sum(self._lengths)
        return 1000 * LAST / whole if whole and len(self._lengths) == LAST else 0.0

    def __repr__(self):
        return f"<Clock(fps={self.get_fps():.2f})>"


def rest(framerate, last):
    """Rest until 1/framerate seconds after `last`; the page posts events meanwhile."""
    if Clock.wait_hook:
        Clock.wait_hook(framerate, last)
    elif framerate > 0:
        time.sleep(max(last + 1 / framerate - time.perf_counter(), 0.0))


def get_ticks():
    """Return the time since the start in ms."""
    return int((time.perf_counter() - START) * 1000) if State.on else 0


def wait(milliseconds):
    """Rest; return the time rested, in ms."""
    if not isinstance(milliseconds, int):
        raise TypeError("wait requires one integer argument")
    began = time.perf_counter()
    if milliseconds > 0:
        rest(1000 / milliseconds, began)
    return int((time.perf_counter() - began) * 1000)


def delay(milliseconds):
    """Rest; return the time rested, in ms."""
    if not isinstance(milliseconds, int):
        raise TypeError("delay requires one integer argument")
    return wait(milliseconds)
