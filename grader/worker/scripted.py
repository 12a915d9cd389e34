"""A clock and a pair of hands for a program that runs without a person.

Every way of reading time agrees: `Clock.tick`, `get_ticks`, `time.*`. Time stands still unless the
program ends a frame (`Clock.tick`, or showing the picture where no Clock ticks), sleeps, or reads
the time over and over, as a busy wait does. A frame takes whole milliseconds, as pygame's do.
"""

import datetime
import os
import time
from collections.abc import Callable, Sequence
from typing import Any

import pygame

from grader.protocol import Event

BEGIN = 1000.0  # ms: no program starts at time 0
PATIENCE = 5  # frames a program may run on after it was told to quit
BUSY_READS = 500  # readings of the time without a frame in between, before time moves by itself
MODIFIERS = {
    "left shift": pygame.KMOD_LSHIFT,
    "right shift": pygame.KMOD_RSHIFT,
    "left ctrl": pygame.KMOD_LCTRL,
}


class PlayOver(BaseException):
    """Ends a program that does not end by itself."""


class ScriptedClock:
    """Stands in for pygame's and Python's clocks; installed before the submission is imported."""

    def __init__(self) -> None:
        self.now = BEGIN  # ms
        self.reads = 0  # of the time, since the last frame or sleep
        self.clocks = 0  # that the program made, when it was imported or later
        self.held = ""  # the key that is down
        self.start([], [], lambda: None)

    def start(
        self, frames: Sequence[int], events: Sequence[Event], over: Callable[[], None]
    ) -> None:
        """Script a run: `frames` in ms each; `over` is called once all is done in a frame."""
        self.frames, self.events, self.over = frames, events, over
        self.frame = 0
        self.frame_began = self.began = self.now
        self.ticks = self.shows = 0

    def install(self) -> None:
        replacements: dict[Any, dict[str, Any]] = {
            pygame: {"Clock": self._clock_type()},
            pygame.time: {
                "Clock": self._clock_type(),
                "get_ticks": lambda: int(self.read()),
                "wait": self._wait,
                "delay": self._wait,
            },
            pygame.key: {"get_pressed": self._pressing(pygame.key.get_pressed)},
            pygame.display: {
                "flip": self._showing(pygame.display.flip),
                "update": self._showing(pygame.display.update),
            },
            datetime: {"datetime": self._datetime_type()},
            time: {"sleep": lambda seconds: self.sleep(seconds * 1000)},
        }
        for name in ("time", "monotonic", "perf_counter", "process_time"):
            replacements[time][name] = lambda: self.read() / 1000
            replacements[time][name + "_ns"] = lambda: int(self.read() * 1_000_000)
        for module, names in replacements.items():
            for name, stand_in in names.items():
                setattr(module, name, stand_in)

    def _datetime_type(self) -> type[datetime.datetime]:
        clock = self

        class ScriptedDatetime(datetime.datetime):
            """The real one, but for what it calls now."""

            @classmethod
            def now(cls, tz: datetime.tzinfo | None = None) -> "ScriptedDatetime":
                return cls.fromtimestamp(clock.read() / 1000, tz)

            today = utcnow = now

        return ScriptedDatetime

    # ------------------------------------------------------------ time

    @property
    def elapsed(self) -> float:
        """How long the program has been running, in ms."""
        return self.now - self.began

    def read(self) -> float:
        self.reads += 1
        if self.reads > BUSY_READS:
            self.now += 0.1
        return self.now

    def sleep(self, milliseconds: float) -> None:
        self.now += max(0.0, float(milliseconds))
        self.reads = 0

    def end_frame(self) -> None:
        """Let the frame take its time, or longer where the program slept longer."""
        self.over()
        if self.frame < len(self.frames):
            self.now = max(self.now, self.frame_began + self.frames[self.frame])
        self.frame_began = self.now
        self.reads = 0
        self.frame += 1
        if self.frame >= len(self.frames) + PATIENCE:
            if self.frame >= len(self.frames) + 4 * PATIENCE:
                os._exit(1)  # it swallowed the exception as well
            raise PlayOver("the program runs on after its window was closed")
        self._post(self.frame)

    def tick(self) -> None:
        self.ticks += 1
        self.end_frame()

    def _wait(self, milliseconds: float) -> int:
        self.sleep(milliseconds)
        return int(milliseconds)

    def _clock_type(self) -> type:
        script = self

        class Clock(FrameClock):
            def __init__(self) -> None:
                super().__init__(script)

        return Clock

    def _showing(self, show: Callable[..., Any]) -> Callable[..., Any]:
        """Showing the picture ends a frame, unless a Clock does or may be about to."""

        def shown(*args: Any) -> Any:
            result = show(*args)
            self.shows += 1
            if not self.ticks and (not self.clocks or self.shows > 1):
                self.end_frame()
            return result

        return shown

    # ------------------------------------------------------------ hands

    def _post(self, frame: int) -> None:
        """What the person does at the end of a frame."""
        if not pygame.display.get_init():
            return
        if frame >= len(self.frames):
            pygame.event.post(pygame.event.Event(pygame.QUIT))
        events = [event for event in self.events if event.frame == frame]
        self._hold(next((event.held for event in events), ""))
        for event in events:
            if event.kind == "click":
                pygame.mouse.set_pos(event.pos)
                for kind in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP):
                    pygame.event.post(pygame.event.Event(kind, pos=event.pos, button=1))
            else:
                for kind in (pygame.KEYDOWN, pygame.KEYUP):
                    self._post_key(kind, event.key, event.key)

    def _hold(self, key: str) -> None:
        """Hold this key down from now on, and no other; an empty name for none."""
        if key == self.held:
            return
        released, self.held = self.held, key
        pygame.key.set_mods(MODIFIERS.get(key, pygame.KMOD_NONE))
        if released:
            self._post_key(pygame.KEYUP, released)
        if key:
            self._post_key(pygame.KEYDOWN, key)

    def _post_key(self, kind: int, name: str, unicode: str = "") -> None:
        key, mod = pygame.key.key_code(name), pygame.key.get_mods()
        pygame.event.post(pygame.event.Event(kind, key=key, mod=mod, unicode=unicode, scancode=0))

    def _pressing(self, real: Callable[[], Any]) -> Callable[[], Any]:
        return lambda: Pressed(real(), self.held)


class Pressed:
    """What `pygame.key.get_pressed()` gives a program here."""

    def __init__(self, real: Any, held: str) -> None:
        self.real, self.held = real, held

    def __getitem__(self, key: int) -> bool:
        return bool(self.real[key]) or (self.held != "" and key == pygame.key.key_code(self.held))


class FrameClock:
    """What `pygame.time.Clock()` gives a program here."""

    def __init__(self, script: ScriptedClock) -> None:
        self.script = script
        self.last = script.now
        self.length = 0
        script.clocks += 1

    def tick(self, framerate: float = 0) -> int:
        self.script.tick()
        self.length = int(self.script.now) - int(self.last)
        self.last = self.script.now
        return self.length

    tick_busy_loop = tick

    def get_time(self) -> int:
        return self.length

    def get_rawtime(self) -> int:
        return self.length

    def get_fps(self) -> float:
        return 1000 / self.length if self.length else 0.0
