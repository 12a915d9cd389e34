"""Run children without processes: all in this interpreter, each while it answers a request.

It is for the page in a browser tab, which has no processes, and only for the user's own work: it
does not confine a submission. Each child has its own modules, import rule, clock, random numbers,
folder and output, which replace the judge's while it answers.
"""

import builtins
import datetime
import math
import os
import random
import sys
import tempfile
import time
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any, NoReturn

import msgspec
import pymunk

from grader.protocol import (
    Answered,
    Asked,
    ChannelClosed,
    ChildSetup,
    InnerChannel,
    Ready,
    pack_message,
)
from grader.worker import child
from grader.worker.copies import compile_all, copy_submission
from grader.worker.imports import ALLOWED, LIBRARIES
from grader.worker.scripted import ScriptedClock
from grader.worker.session import Session

# Called with the seconds of a request when it begins, and with None when it ends. It raises
# KeyboardInterrupt in a request that takes longer, repeatedly until it ends.
Watch = Callable[[float | None], None]

OUT_OF_TIME = -24  # exit status of a process that used up its processor time: SIGXCPU
LATE = 0.1  # s between the end of a child's time and the interrupt
MISSING = object()
now = time.process_time  # the real one, which a child replaces
step: Any = pymunk.Space.step

OWN: list[tuple[Any, tuple[str, ...]]] = [  # modules that each child has for itself
    (sys, ("path", "argv", "meta_path", "stdout", "stderr", "dont_write_bytecode")),
    (tempfile, ("tempdir",)),
    (os, ("_exit", "abort")),
    (random.Random, ("seed",)),
    *((owner, tuple(names)) for owner, names in ScriptedClock().replacements().items()),
    (pymunk.Space, ("__init__",)),  # watched for replays
    (step, ("__code__", "__defaults__", "__kwdefaults__")),  # replaced to count steps
]
SHARED: list[Any] = [  # modules and classes that are restored when a child ends
    *(builtins, math, random, time, datetime),
    *(each for name, each in sys.modules.items() if name.partition(".")[0] in LIBRARIES),
    *(pymunk.Space, pymunk.Body),
]
USUAL = [dict(vars(each)) for each in SHARED]


@dataclass
class Surroundings:
    """The parts of the interpreter that a child, or the judge, has for itself."""

    folder: str
    random: tuple[Any, ...]
    depth: int  # maximum of calls
    values: list[tuple[Any, str, Any]]
    environment: dict[str, str]

    @classmethod
    def current(cls) -> "Surroundings":
        values = [(owner, n, getattr(owner, n, MISSING)) for owner, names in OWN for n in names]
        depth, environment = sys.getrecursionlimit(), dict(os.environ)
        return cls(os.getcwd(), random.getstate(), depth, values, environment)

    def copy(self) -> "Surroundings":
        """Return a copy with its own lists."""
        values = [
            (owner, name, list(value) if isinstance(value, list) else value)
            for owner, name, value in self.values
        ]
        return replace(self, values=values)

    def install(self) -> None:
        for owner, name, value in self.values:
            if getattr(owner, name, MISSING) is value:
                continue
            if value is MISSING:
                delattr(owner, name)
            else:
                setattr(owner, name, value)
        with suppress(OSError):  # a submission may have removed its folder
            os.chdir(self.folder)
        if dict(os.environ) != self.environment:  # a program reads its number of frames there
            os.environ.clear()
            os.environ.update(self.environment)
        random.setstate(self.random)
        sys.setrecursionlimit(self.depth)


class Ended(BaseException):
    """Raised when a submission ends its process."""


class Tenant:
    """One child: the submission, and the parts of the interpreter that it has for itself."""

    def __init__(self, setup: ChildSetup) -> None:
        self.status: int | None = None  # the exit status, if it ended itself
        self.modules: dict[str, ModuleType] = {}
        self.away = [name for name in sys.modules if is_away(name, setup.bans)]
        self.folder = Path(setup.scratch, Path(setup.submission).name)
        self.surroundings = Surroundings.current().copy()
        files = copy_submission(setup, str(self.folder))
        self.surroundings.folder = str(self.folder)
        with self.installed():
            os._exit = self.end
            os.abort = partial(self.end, -6)  # SIGABRT
            sys.dont_write_bytecode = True
            tempfile.tempdir = setup.scratch
            self.session = Session(self.folder, files, setup.bans)

    def answer(self, asked: Asked) -> Answered:
        """Answer a request as a separate process would."""
        with self.installed():
            return child.answer(self.session, asked)

    def end(self, status: int) -> NoReturn:
        """Replace os._exit, which would end the judge as well."""
        self.status = status
        raise Ended

    @contextmanager
    def installed(self) -> Iterator[None]:
        """Install the child's surroundings for a while."""
        judge = Surroundings.current()
        away = {name: sys.modules.pop(name) for name in self.away if name in sys.modules}
        shared = frozenset(sys.modules)
        sys.modules.update(self.modules)
        self.surroundings.install()
        try:
            yield
        finally:
            self.surroundings = Surroundings.current()
            judge.install()
            new = sys.modules.keys() - shared
            own = [name for name in new if name.partition(".")[0] not in LIBRARIES]
            self.modules = {name: sys.modules.pop(name) for name in own}
            sys.modules.update(away)

    def forget(self) -> None:
        """Remove the folders of an ended child from Python's cache."""
        for place in [each for each in sys.path_importer_cache if self.holds(each)]:
            del sys.path_importer_cache[place]

    def holds(self, place: str) -> bool:
        return Path(place).is_relative_to(self.folder)


def is_away(name: str, bans: Collection[str]) -> bool:
    """Return whether a loaded module must be hidden from submissions."""
    first = name.partition(".")[0]
    return first not in ALLOWED or first in bans


class TabChannel(InnerChannel):
    """A channel whose child answers in this interpreter.

    `pace`: seconds here per second of a usual processor.
    """

    def __init__(self, setup: ChildSetup, watch: Watch, pace: float = 1.0) -> None:
        self.setup, self.watch, self.pace = setup, watch, pace
        self.tenant: Tenant | None = None
        self.asked: list[Asked] = []
        self.answers = [msgspec.msgpack.encode(Ready(os.getpid(), []))]
        self.cpu = 0.0  # s of a usual processor
        self.status = 0  # the exit status of a process in its place

    # ------------------------------------------------------------ the judge's side

    def wait(self, seconds: float) -> bool:
        return bool(self.answers)

    def post(self, message: object) -> None:
        self.asked = child.decoder.decode(msgspec.msgpack.encode(message))

    def flush(self, seconds: float) -> bool:
        return True

    def complete(self, seconds: float | None = None) -> bool:
        if self.asked and not self.answers:
            self._answer(self.asked.pop(0))
        return True

    def receive(self, timeout: float | None = None) -> bytes:
        """Return the next answer; raise ChannelClosed if a process would have ended."""
        if not self.answers and self.setup.compiles:
            compile_all(self.setup)
        if not self.answers:
            raise ChannelClosed("it has ended")
        return self.answers.pop(0)

    def close(self) -> None:
        """End the child, and restore what it has changed for all."""
        if self.tenant is not None:
            self.tenant.forget()
            self.tenant = None
            for owner, usual in zip(SHARED, USUAL, strict=True):
                restore(owner, usual)

    # ------------------------------------------------------------ the child's side

    def send(self, message: object) -> None:
        self.answers.append(pack_message(message)[4:])

    def _answer(self, asked: Asked) -> None:
        """Answer; set `status` if a process would have ended."""
        most = self.setup.limits.cpu_seconds
        began = now()
        if self.tenant is None:
            self.tenant = Tenant(self.setup)
        self.watch((most - self.cpu) * self.pace + LATE)
        try:
            answered = self.tenant.answer(asked)
        finally:
            self.watch(None)
            self.cpu += (now() - began) / self.pace
        if self.tenant.status is not None:
            self.status = self.tenant.status
        elif self.cpu >= most:
            self.status = OUT_OF_TIME
        else:
            child.send(self, answered)


def restore(owner: Any, usual: dict[str, Any]) -> None:
    """Restore the attributes of a module or class; modules imported meanwhile stay."""
    if all(usual.get(name, MISSING) is value for name, value in vars(owner).items()):
        return
    for name, value in [*vars(owner).items()]:
        if name not in usual and not isinstance(value, ModuleType):
            delattr(owner, name)
    for name, value in usual.items():
        if vars(owner).get(name, MISSING) is not value:
            setattr(owner, name, value)
