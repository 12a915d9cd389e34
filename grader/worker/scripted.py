"""Script the clock, keyboard and mouse of a program that runs without a person.

Every way of reading time agrees: `Clock.tick`, `get_ticks`, `time.*`. Time passes only when the
program ends a frame, sleeps, or reads the time over and over, as a busy wait does. A frame ends at
`Clock.tick`, or when the picture is shown if no Clock ticks. Frames take whole milliseconds, as
pygame's do.

So slow and fast machines give the same marks, and a check of seconds takes milliseconds.
"""

import datetime
import os
import random
import time
from collections.abc import Callable, Sequence
from typing import Any

import pygame

from grader.protocol import Event

START_MS = 1000.0  # time at the start: a program may not rely on 0
GRACE_FRAMES = 5  # frames that a program may run after QUIT
BUSY_READS = 500  # readings of the time in one frame before time moves by itself
MODIFIERS = {
    "left shift": pygame.KMOD_LSHIFT,
    "right shift": pygame.KMOD_RSHIFT,
    "left ctrl": pygame.KMOD_LCTRL,
    "right ctrl": pygame.KMOD_RCTRL,
    "left alt": pygame.KMOD_LALT,
    "caps lock": pygame.KMOD_CAPS,
    "numlock": pygame.KMOD_NUM,
}


class PlayOver(BaseException):
    """Raised to end a program that runs on."""


class ScriptedClock:
    """Replaces pygame's and Python's clocks; all times inside are ms.

    It is installed before the submission is imported, because `from time import perf_counter` keeps
    the function that it finds.
    """

    def __init__(self) -> None:
        self.now = START_MS  # ms
        self.reads = 0  # readings of the time since the last frame or sleep
        self.clocks = 0  # Clocks that the program has made
        self.held = ""  # the keys that are down
        self.start([], [], lambda: None)

    def start(
        self, frames: Sequence[int], events: Sequence[Event], frame_over: Callable[[], None]
    ) -> None:
        """Script a run of `frames`, each in ms; `frame_over` is called at the end of each frame."""
        self.frames, self.events, self.frame_over = frames, events, frame_over
        self.frame = 0
        self.frame_began = self.began = self.now
        self.ticks = self.flips = 0

    def install(self) -> None:
        """Replace every function and class that reads time, waits or shows the picture."""
        for module, names in self.replacements().items():
            for name, replacement in names.items():
                setattr(module, name, replacement)

    def replacements(self) -> dict[Any, dict[str, Any]]:
        """Return what to put in place of the real functions and classes, by module and name."""
        clock = type("Clock", (FrameClock,), {"script": self})
        found: dict[Any, dict[str, Any]] = {
            pygame: {"Clock": clock},
            pygame.time: {
                "Clock": clock,
                "get_ticks": lambda: int(self.read()),
                "wait": self._wait,
                "delay": self._wait,
            },
            pygame.key: {"get_pressed": self._pressed_keys(pygame.key.get_pressed)},
            pygame.display: {
                "flip": self._ending_frames(pygame.display.flip),
                "update": self._ending_frames(pygame.display.update),
            },
            datetime: {"datetime": type("datetime", (ScriptedDatetime,), {"script": self})},
            pygame.event: {"wait": self._wait_for_event},
            time: {"sleep": lambda seconds: self.sleep(seconds * 1000)},
        }
        for name in ("time", "monotonic", "perf_counter", "process_time"):
            found[time][name] = lambda: self.read() / 1000
            found[time][name + "_ns"] = lambda: int(self.read() * 1_000_000)
        return found

    # ------------------------------------------------------------ time

    @property
    def elapsed(self) -> float:
        """Return the running time of the program, in ms."""
        return self.now - self.began

    def read(self) -> float:
        """Return the time now, in ms; after BUSY_READS readings, each adds 0.1 ms.

        Otherwise a busy wait would never end.
        """
        self.reads += 1
        if self.reads > BUSY_READS:
            self.now += 0.1
        return self.now

    def pass_time(self, milliseconds: float) -> None:
        """Let the program's work take some time."""
        self.now += milliseconds

    def sleep(self, milliseconds: float) -> None:
        """Let time pass; a negative length counts as 0."""
        self.now += max(0.0, float(milliseconds))
        self.reads = 0

    def end_frame(self) -> None:
        """End a frame, which takes its scripted time, or longer if the program slept longer.

        Raises PlayOver when the program runs on for GRACE_FRAMES after QUIT. The process of a
        program that catches this is ended, so the program has no answer.
        """
        self.frame_over()
        if self.frame < len(self.frames):
            self.now = max(self.now, self.frame_began + self.frames[self.frame])
        self.frame_began = self.now
        self.reads = 0
        self.frame += 1
        if self.frame >= len(self.frames) + GRACE_FRAMES:
            if self.frame >= len(self.frames) + 4 * GRACE_FRAMES:
                os._exit(1)  # it caught the exception
            raise PlayOver("the program runs on after its window was closed")
        self._post_input(self.frame)

    def tick(self) -> None:
        """End a frame because a Clock ticks."""
        self.ticks += 1
        self.end_frame()

    def _wait(self, milliseconds: float) -> int:
        """Replace pygame.time.wait and delay."""
        self.sleep(milliseconds)
        return int(milliseconds)

    def _wait_for_event(self, timeout: float = 0) -> pygame.event.Event:
        """Replace pygame.event.wait: end frames until there is an event."""
        began = self.now
        while not pygame.event.peek():
            if timeout and self.now - began >= timeout:
                return pygame.event.Event(pygame.NOEVENT)
            self.end_frame()
        return pygame.event.poll()

    def _ending_frames(self, show: Callable[..., Any]) -> Callable[..., Any]:
        """Return a `show` that ends a frame if no Clock ends it.

        Whether a Clock ends frames is known in the second frame only: the Clock may tick after the
        first picture, or never.
        """

        def show_and_count(*args: Any) -> Any:
            result = show(*args)
            self.flips += 1
            if not self.ticks and (not self.clocks or self.flips > 1):
                self.end_frame()
            return result

        return show_and_count

    # ------------------------------------------------------------ keyboard and mouse

    def _post_input(self, frame: int) -> None:
        """Post the events at the end of a frame: QUIT after the last, clicks, keys."""
        if not pygame.display.get_init():
            return
        if frame >= len(self.frames):
            pygame.event.post(pygame.event.Event(pygame.QUIT))
        events = [event for event in self.events if event.frame == frame]
        self._hold_keys(next((event.held for event in events), ""))
        for event in events:
            if event.kind == "click":
                pygame.mouse.set_pos(event.pos)
                for kind in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP):
                    pygame.event.post(pygame.event.Event(kind, pos=event.pos, button=event.button))
            else:
                for kind in (pygame.KEYDOWN, pygame.KEYUP):
                    self._post_key(kind, event.key, event.key)

    def _hold_keys(self, keys: str) -> None:
        """Hold these keys down from now on and release all others."""
        if keys == self.held:
            return
        before, now = keys_in(self.held), keys_in(keys)
        self.held = keys
        pygame.key.set_mods(sum(MODIFIERS.get(key, pygame.KMOD_NONE) for key in now))
        for key in before:
            if key not in now:
                self._post_key(pygame.KEYUP, key)
        for key in now:
            if key not in before:
                self._post_key(pygame.KEYDOWN, key)

    def _post_key(self, kind: int, name: str, unicode: str = "") -> None:
        """Post one event of a key, with the modifiers held now."""
        key, mod = pygame.key.key_code(name), pygame.key.get_mods()
        pygame.event.post(pygame.event.Event(kind, key=key, mod=mod, unicode=unicode, scancode=0))

    def _pressed_keys(self, real: Callable[[], Any]) -> Callable[[], Any]:
        """Return a get_pressed() that includes the keys held by the script."""
        return lambda: Pressed(real(), self.held)


def keys_in(held: str) -> list[str]:
    """Return the keys in a text such as "left shift+left ctrl"."""
    return held.split("+") if held else []


class Pressed:
    """The keys held down, as `pygame.key.get_pressed()` returns them here."""

    def __init__(self, real: Any, held: str) -> None:
        self.real, self.held = real, held

    def __getitem__(self, key: int) -> bool:
        return bool(self.real[key]) or key in map(pygame.key.key_code, keys_in(self.held))


class FrameClock:
    """A `pygame.time.Clock` that ignores the frame rate; programs may derive from it."""

    script: ScriptedClock  # set in the class that a program sees

    def __init__(self) -> None:
        self.last = self.script.now
        self.length = 0
        self.script.clocks += 1

    def tick(self, framerate: float = 0) -> int:
        """End the frame; return its length in whole ms."""
        self.script.tick()
        self.length = int(self.script.now) - int(self.last)
        self.last = self.script.now
        return self.length

    tick_busy_loop = tick

    def get_time(self) -> int:
        """Return the ms between the last two ticks."""
        return self.length

    get_rawtime = get_time  # no frame waits here

    def get_fps(self) -> float:
        """Return the frames per second of the last frame; 0 before the first."""
        return 1000 / self.length if self.length else 0.0


class ScriptedDatetime(datetime.datetime):
    """The real datetime, but its present is the scripted time."""

    script: ScriptedClock  # set in the class that a program sees

    @classmethod
    def now(cls, tz: datetime.tzinfo | None = None) -> "ScriptedDatetime":
        return cls.fromtimestamp(cls.script.read() / 1000, tz)

    @classmethod
    def today(cls) -> "ScriptedDatetime":
        return cls.now()

    @classmethod
    def utcnow(cls) -> "ScriptedDatetime":
        return cls.now()


def shift_seeds(number: int) -> None:
    """Add `number` to each int seed of a random.Random from now on."""
    draw = random.Random.seed

    def seed(self: random.Random, a: Any = None, version: int = 2) -> None:
        draw(self, a + number if type(a) is int else a, version)

    random.Random.seed = seed  # type: ignore[method-assign]
