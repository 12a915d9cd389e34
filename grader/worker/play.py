"""Run a program for a number of frames, or step a world without a program.

A run is the same on every machine: it counts frames and steps on a scripted clock.
"""

import inspect
import math
import os
import zlib
from collections.abc import Callable
from functools import partial
from types import FunctionType
from typing import Any, Literal

import pygame
import pymunk
from pymunk.constraints import PinJoint

from grader.protocol import (
    MAX_LINES,
    MAX_PHOTO,
    MAX_STEP_SIZES,
    MAX_TEXT,
    RUNAWAY,
    BodyValue,
    ContactRow,
    Photo,
    Play,
    Played,
    Returned,
    Simulate,
    Simulated,
    SpaceBody,
    cut,
)
from grader.worker.recorder import Recorder
from grader.worker.scripted import PlayOver
from grader.worker.session import Session
from grader.worker.standin import plain_function, replace_function
from grader.worker.start import start
from grader.worker.subject import Subject
from grader.worker.values import ContractError, field, field_number, read_ends, read_state


class Runaway(BaseException):
    """Ends a program whose frame never stops stepping."""


class StepCounter:
    """Counts the steps of a program's worlds, and runs them if `physics` is wanted.

    It replaces the function `step` itself, and that of derived classes. Checks of the game loop
    need only the number and length of steps: without physics, other TODOs do not matter.
    """

    def __init__(self, owner: type, physics: bool, trail_every: int):
        self.trail_every = trail_every
        self.in_frame = self.total = self.elsewhere = 0
        self.dts: list[float] = []
        self.trail: list[list[float]] = []
        self.last: Any = None
        self.on_step: Callable[[], None] = lambda: None  # called after each step
        self.inside = False  # a derived class may call the step that it overrides
        self.in_advance = False
        for function in steps_of(owner):
            # The step of a derived class runs in any case: it may also count.
            self.watch(function, physics or function is not plain_function(owner.step))  # type: ignore[attr-defined]

    def watch(self, function: FunctionType, runs: bool) -> None:
        """Count the calls of a step; it runs only if `runs`."""

        def step(world: Any, dt: float, *rest: Any, **more: Any) -> Any:
            def run() -> Any:
                return real(world, dt, *rest, **more) if runs else None

            return run() if self.inside else self.count(world, dt, run)

        real = replace_function(function, step)

    def watch_advance(self, function: FunctionType) -> None:
        """Count from now on which steps run outside this function."""

        def advance(*args: Any, **kwargs: Any) -> Any:
            outside, self.in_advance = self.in_advance, True
            try:
                return real(*args, **kwargs)
            finally:
                self.in_advance = outside

        real = replace_function(function, advance)

    def count(self, world: Any, dt: float, run: Callable[[], Any]) -> Any:
        """Count one step of `dt` seconds. Raises Runaway when a frame has too many."""
        self.last = world
        self.in_frame += 1
        self.total += 1
        self.elsewhere += not self.in_advance
        if len(self.dts) < MAX_STEP_SIZES and not any(math.isclose(dt, each) for each in self.dts):
            self.dts.append(float(dt))
        self.inside = True
        try:
            result = run()
        finally:
            self.inside = False
        self.on_step()
        if self.trail_every and self.total % self.trail_every == 0:
            self.trail.append(moving_states(world))
        if self.in_frame >= RUNAWAY:
            raise Runaway
        return result


def steps_of(owner: type) -> list[FunctionType]:
    """Return the `step` of a class and of those derived from it, each once."""
    classes: list[type] = [owner]
    for each in classes:
        below: list[type] = each.__subclasses__()
        classes += [derived for derived in below if derived not in classes]
    found = [plain_function(getattr(each, "step", None)) for each in classes]
    return list(dict.fromkeys(each for each in found if each is not None))


def advance_of(subject: Subject, module: str) -> FunctionType | None:
    """Return a program's `advance`, if it has the parameters of the lab sheet."""
    try:
        function = plain_function(subject.find(f"{module}:advance"))
    except ContractError:
        return None
    names = list(inspect.signature(function).parameters) if function else []
    return function if names[1:3] == ["accumulator", "frame_seconds"] else None


def call_stepping(subject: Subject, world: Any, call: Callable[[], Any]) -> Returned:
    """Return the answer of a call that steps a world, and count its steps without running them."""
    kind = type(world)
    if kind not in subject.counters:
        subject.counters[kind] = StepCounter(kind, physics=False, trail_every=0)
    counter: StepCounter = subject.counters[kind]
    counter.in_frame, counter.dts = 0, []
    try:
        value = subject.encode(call())
    except Runaway:
        raise ContractError(f"{RUNAWAY} steps in one frame, and more to come") from None
    return Returned(value, steps=counter.in_frame, dts=counter.dts)


def play(session: Session, request: Play) -> Played:
    """Run a program on a scripted clock, and return what it did in each frame.

    It ends by the frame budget in LAB_FRAMES, which lab_runtime reads, or by the QUIT event after
    the last frame. A program that runs some frames longer is stopped. The last entry of each list
    covers the time after the last frame.
    """
    subject, clock, recorder = session.subject, session.clock, session.recorder
    in_pymunk = request.module == "pymunk_scene"
    owner = pymunk.Space if in_pymunk else subject.find(f"{request.module}:World")
    counter = StepCounter(owner, request.physics, request.trail_every)
    counter.on_step = partial(clock.pass_time, request.step_ms)
    advance = advance_of(subject, request.module)
    if advance is not None:
        counter.watch_advance(advance)
    steps: list[int] = []
    times: list[float] = []

    def frame_over() -> None:
        steps.append(counter.in_frame)
        times.append(clock.elapsed - request.step_ms * counter.in_frame)  # before its steps
        counter.in_frame = 0
        window.record(len(steps) - 1, clock.flips)
        recorder.record(clock.elapsed / 1000, counter.total)

    os.environ["LAB_FRAMES"] = str(len(request.frames))
    session.output.take()
    clock.start(request.frames, request.events, frame_over)
    window = Window(request.pictures, request.photos)
    recorder.watch_worlds(owner, len(request.frames) + 1)
    ended: Literal["returned", "stopped", "runaway"] = "returned"
    try:
        start(subject, request.module, steps, len(request.frames))
    except SystemExit:
        pass  # a normal end
    except PlayOver:
        ended = "stopped"
    except Runaway:
        ended = "runaway"
    finally:
        window.restore()
    frame_over()
    recorder.stop_watching()
    return Played(
        steps=steps,
        clock=times,
        dts=counter.dts,
        ended=ended,
        lines=[cut(each, MAX_TEXT) for each in session.output.peek().splitlines()[-MAX_LINES:]],
        bodies=all_bodies(subject, counter.last),
        rods=rod_lengths(counter.last),
        trail=counter.trail,
        pictures=window.pictures,
        photos=window.photos,
        paced=advance is not None and counter.elsewhere == 0 < counter.total,
    )


class Window:
    """The program's window, of which only one pixel is drawn unless pictures are wanted.

    Here pygame.quit() closes only the window: quitting takes long, and the process ends soon.
    """

    def __init__(self, pictures: bool, photos: list[int]) -> None:
        self.wanted, self.frames = pictures, photos
        self.pictures: list[int] = []
        self.photos: list[Photo] = []
        self.flips = 0
        self.real_quit, self.real_mode = pygame.quit, pygame.display.set_mode
        pygame.quit, pygame.display.set_mode = self._quit, self._set_mode

    def _set_mode(self, *args: Any, **kwargs: Any) -> pygame.Surface:
        """Open the window, clipped to one pixel unless pictures are wanted: drawing is slow."""
        surface = self.real_mode(*args, **kwargs)
        if not self.wanted and not self.frames:
            surface.set_clip((0, 0, 1, 1))
        return surface

    def _quit(self) -> None:
        pygame.display.quit()

    def record(self, frame: int, flips: int) -> None:
        """Store a checksum of the picture at the end of a frame, and a photo if wanted."""
        surface = pygame.display.get_surface() if pygame.display.get_init() else None
        if surface is None:
            return
        if self.wanted:
            self.pictures.append(zlib.crc32(surface.get_buffer().raw))
        if frame in self.frames and flips > self.flips:
            self._photograph(surface, frame)
        self.flips = flips

    def _photograph(self, surface: pygame.Surface, frame: int) -> None:
        colours = zlib.compress(pygame.image.tobytes(surface, "RGB"), 1)
        if len(colours) <= MAX_PHOTO:
            self.photos.append(Photo(frame, *surface.get_size(), colours))

    def restore(self) -> None:
        """Restore pygame's own functions, and close the window if it is still open."""
        pygame.quit, pygame.display.set_mode = self.real_quit, self.real_mode
        if pygame.display.get_init():
            self._quit()


def all_bodies(subject: Subject, world: Any) -> list[BodyValue | SpaceBody]:
    """Return every body of a world or space; none if the program never stepped one."""
    if isinstance(world, pymunk.Space):
        return [*subject.space(world).bodies]
    return [subject.body(body) for body in getattr(world, "bodies", [])]


def moving_states(world: Any) -> list[float]:
    """Return x, y, vx, vy, angle, omega of every body that can move."""
    bodies = field(world, "bodies")
    return [
        number
        for body in bodies
        if isinstance(body, pymunk.Body) or body.inv_mass
        for number in read_state(body)
    ]


def rod_lengths(world: Any) -> list[tuple[float, float]]:
    """Return the present and the intended length of every distance joint, px."""
    if isinstance(world, pymunk.Space):
        pins = [each for each in world.constraints if isinstance(each, PinJoint)]
        lengths = [joint.distance for joint in pins]
    else:
        pins = [each for each in getattr(world, "joints", []) if hasattr(each, "length")]
        lengths = [field_number(joint, "length") for joint in pins]
    ends = map(read_ends, pins)
    return [
        (math.dist(each[:2], each[2:]), length) for each, length in zip(ends, lengths, strict=True)
    ]


def simulate(subject: Subject, recorder: Recorder, request: Simulate) -> Simulated:
    """Step a world; record the watched bodies, and contacts if wanted, every `every` steps.

    The watched bodies are read one by one: the world's own list may be wrong.
    """
    world = subject.objects[request.ref]
    watched = [subject.objects[ref] for ref in request.watch]
    frames: list[list[float]] = []
    contacts: list[list[ContactRow]] = []
    recorder.expect(request.steps)
    for number in range(1, request.steps + 1):
        world.step(request.dt)
        recorder.record(number * request.dt, number)
        if number % request.every:
            continue
        frames.append([number for body in watched for number in read_state(body)])
        if request.contacts:
            contacts.append([subject.contact_row(each) for each in field(world, "contacts")])
    return Simulated(frames, contacts)
