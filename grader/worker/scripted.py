"""A clock and a pair of hands for a program that runs without a person.

Every way of reading time agrees: `Clock.tick`, `get_ticks`, `time.*`. Time stands still unless the
program ends a frame (`Clock.tick`, or showing the picture where it has no Clock), sleeps, or reads
the time over and over, as a busy wait does. Time is counted in whole milliseconds, as pygame's is.
"""

import time
from collections.abc import Callable
from typing import Any

import pygame

from grader.protocol import Event

PATIENCE = 5  # frames a program may run on after it was told to quit
BUSY_READS = 500  # readings of the time without a frame in between, before time moves by itself


class PlayOver(BaseException):
    """Ends a program that does not end by itself."""


class ScriptedClock:
    """Stands in for pygame's and Python's clocks; installed before the submission is imported."""

    def __init__(self) -> None:
        self.now = 0.0  # ms
        self.reads = 0
        self.start([], [], lambda: None)

    def start(self, frames: list[int], events: list[Event], after: Callable[[], None]) -> None:
        """Script a run: `frames` in ms each; `after` is called at the end of every frame."""
        self.ends: list[float] = []
        end = self.now
        for length in frames:
            end += length
            self.ends.append(end)
        self.events, self.after = events, after
        self.frame = 0
        self.has_clock = False
        self.ticked = True  # since the picture was last shown
        if frames:
            self._post(0)

    def install(self) -> None:
        replacements: dict[Any, dict[str, Any]] = {
            pygame.time: {
                "Clock": self._make_clock,
                "get_ticks": lambda: int(self.read()),
                "wait": self._wait,
                "delay": self._wait,
            },
            pygame.display: {
                "flip": self._showing(pygame.display.flip),
                "update": self._showing(pygame.display.update),
            },
            time: {"sleep": lambda seconds: self.sleep(seconds * 1000)},
        }
        for name in ("time", "monotonic", "perf_counter", "process_time"):
            replacements[time][name] = lambda: self.read() / 1000
            replacements[time][name + "_ns"] = lambda: int(self.read() * 1_000_000)
        for module, names in replacements.items():
            for name, stand_in in names.items():
                setattr(module, name, stand_in)

    # ------------------------------------------------------------ time

    def read(self) -> float:
        self.reads += 1
        if self.reads > BUSY_READS:
            self.now += 0.1
        return self.now

    def sleep(self, milliseconds: float) -> None:
        self.now += max(0.0, float(milliseconds))
        self.reads = 0

    def end_frame(self) -> None:
        self.reads = 0
        if self.frame < len(self.ends):
            self.now = max(self.now, self.ends[self.frame])
        self.frame += 1
        self.after()
        if self.frame >= len(self.ends) + PATIENCE:
            raise PlayOver
        self._post(self.frame)

    def _wait(self, milliseconds: float) -> int:
        self.sleep(milliseconds)
        return int(milliseconds)

    def _make_clock(self) -> "FrameClock":
        self.has_clock = True
        return FrameClock(self)

    def _showing(self, show: Callable[..., Any]) -> Callable[..., Any]:
        def shown(*args: Any) -> Any:
            result = show(*args)
            if not self.ticked or not self.has_clock:
                self.end_frame()
            self.ticked = False
            return result

        return shown

    # ------------------------------------------------------------ hands

    def _post(self, frame: int) -> None:
        if not pygame.display.get_init():
            return
        if frame >= len(self.ends):
            pygame.event.post(pygame.event.Event(pygame.QUIT))
        for event in self.events:
            if event.frame != frame:
                continue
            if event.kind == "click":
                for kind in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP):
                    pygame.event.post(pygame.event.Event(kind, pos=event.pos, button=1))
            else:
                key = pygame.key.key_code(event.key)
                for kind in (pygame.KEYDOWN, pygame.KEYUP):
                    pygame.event.post(
                        pygame.event.Event(kind, key=key, mod=0, unicode=event.key, scancode=0)
                    )


class FrameClock:
    """What `pygame.time.Clock()` gives a program here."""

    def __init__(self, clock: ScriptedClock) -> None:
        self.clock = clock
        self.last = clock.now
        self.length = 0

    def tick(self, framerate: float = 0) -> int:
        self.clock.ticked = True
        self.clock.end_frame()
        self.length = int(self.clock.now) - int(self.last)
        self.last = self.clock.now
        return self.length

    tick_busy_loop = tick

    def get_time(self) -> int:
        return self.length

    def get_rawtime(self) -> int:
        return self.length

    def get_fps(self) -> float:
        return 1000 / self.length if self.length else 0.0
