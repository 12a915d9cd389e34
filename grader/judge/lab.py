"""What a check may ask of a submission: build bodies, call functions, step worlds, play programs.

A check speaks to the submission only through a `Lab`. Every answer comes back as plain numbers,
strictly typed and finite, or the check fails with a sentence that says what was wrong.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Literal, NoReturn

from grader.judge.children import Child, ChildEnded
from grader.protocol import (
    Answered,
    Argument,
    BodyValue,
    Call,
    ContactValue,
    Event,
    Get,
    Import,
    Integrate,
    Items,
    MakeBody,
    MakeWorld,
    Missing,
    Piece,
    Play,
    Played,
    Raised,
    Ref,
    Request,
    Returned,
    Set,
    Simulate,
    Simulated,
    SpaceBody,
    SpaceJoint,
    SpaceValue,
    Value,
    Vec,
)

STEP = 1 / 120  # s
MAX_OUTPUT = 65536  # characters kept of what a submission prints during one check
MAX_OBSERVATIONS = 400  # a shrinking counterexample makes many; the first ones are enough

Pair = tuple[float, float]


class NotYet(Exception):
    """The submission gave an answer, and it is not the right one."""

    def __init__(self, ran: str, expected: str, got: str, meaning: str = "") -> None:
        super().__init__(got)
        self.ran, self.expected, self.got, self.meaning = ran, expected, got, meaning
        self.quotes = False  # whether it repeats words of the submission


class Broke(Exception):
    """The submission's own code raised, or its process ended without an answer."""

    def __init__(self, ran: str, got: str, raised: Raised | None = None) -> None:
        super().__init__(got)
        self.ran, self.got, self.raised = ran, got, raised
        self.quotes = raised is not None


@dataclass(frozen=True)
class Thing:
    """An object that lives in the child: a body, a contact, a joint, a world or a space."""

    ref: int


@dataclass(frozen=True)
class Observation:
    """One question put to the submission and its answer, for telling known mistakes apart."""

    about: str
    inputs: tuple[Any, ...]
    answer: Any


@dataclass
class Lab:
    """One check's view of the submission; `open_child` starts a fresh process when first needed."""

    module: str  # what the check imports
    open_child: Callable[[], Child]
    pieces: list[Piece]
    observations: list[Observation] = field(default_factory=list)
    swapped: list[str] = field(default_factory=list)
    output: str = ""
    running: str = ""
    failure: NotYet | Broke | None = None  # the first one, or the one the check ended with
    again: Callable[..., None] | None = None  # what ran last; takes a lab to run in once more
    _child: Child | None = None
    _played: bool = False  # whether the child has run a program
    _over: NotYet | Broke | None = None  # why nothing more can be asked

    @property
    def ended(self) -> bool:
        """Whether the submission's process ended, or had to be ended, before the check did."""
        return isinstance(self.failure, Broke) and self.failure.raised is None

    # ------------------------------------------------------------ saying what a check does

    def ran(self, text: str) -> None:
        """Name the experiment, for the line *We ran*."""
        self.running = text

    def want(self, holds: bool, expected: str, got: str, meaning: str = "") -> None:
        """Fail the check unless `holds`, with what was expected and what came out."""
        if not holds:
            self.fail(expected, got, meaning)

    def fail(self, expected: str, got: str, meaning: str = "") -> NoReturn:
        raise self._remember(NotYet(self.running, expected, got, meaning))

    def _remember(self, failure: NotYet | Broke) -> NotYet | Broke:
        self.failure = self.failure or failure
        return failure

    def saw(self, about: str, inputs: tuple[Any, ...], answer: Any) -> None:
        """Remember an answer, so that a known mistake can be told by its numbers."""
        if len(self.observations) < MAX_OBSERVATIONS:
            self.observations.append(Observation(about, inputs, answer))

    # ------------------------------------------------------------ asking

    def probe(self) -> None:
        """Import the submission and nothing more."""
        self._begin()

    def call(self, name: str, *args: Any, **kwargs: Any) -> Value:
        """Call `name` of the TODO's module, or `module:name`."""
        target = name if ":" in name else f"{self.module}:{name}"
        return self._value(
            Call(target, [plain(each) for each in args], {k: plain(v) for k, v in kwargs.items()})
        )

    def tell(self, thing: Thing, method: str, *args: Any) -> Value:
        """Call a method of an object that lives in the child."""
        return self._value(Call(f"#{thing.ref}.{method}", [plain(each) for each in args]))

    def count(self, functions: Sequence[str], thing: Thing, method: str, *args: Any) -> int:
        """How many calls of these functions of the TODO's module a method of an object makes."""
        counting = [f"{self.module}:{each}" for each in functions]
        arguments = [plain(each) for each in args]
        return self._returned(Call(f"#{thing.ref}.{method}", arguments, counting=counting)).counted

    def get(self, thing: Thing, name: str) -> Value:
        return self._value(Get(thing.ref, name))

    def put(self, thing: Thing, **fields: Any) -> None:
        self._value(Set(thing.ref, {name: plain(value) for name, value in fields.items()}))

    def number(self, value: Value, what: str) -> float:
        """The value as a finite number."""
        if isinstance(value, bool) or not isinstance(value, int | float):
            self.fail(f"a number as {what}", self.describe(value))
        if not math.isfinite(value):
            self.fail(f"a finite number as {what}", f"{value}")
        return float(value)

    def pair(self, value: Value, what: str) -> Pair:
        """The value as two finite numbers."""
        if not isinstance(value, Vec):
            self.fail(f"a pair of numbers as {what}", self.describe(value))
        return self.number(value.x, what), self.number(value.y, what)

    def items(self, value: Value, what: str) -> list[Value]:
        """The value as a list; a pair of numbers counts as one of two."""
        if isinstance(value, Vec):
            return [value.x, value.y]
        if not isinstance(value, Items):
            self.fail(f"a list or tuple as {what}", self.describe(value))
        return value.items

    def describe(self, value: Value) -> str:
        match value:
            case None:
                return "None (is there a return missing?)"
            case Ref(kind=kind):
                return "an object" if self.pieces else f"an object of type {kind}"
            case Items():
                return f"a list or tuple of {len(value.items)}"
            case str() if self.pieces:
                return "a text"
            case bool() | int() | float() | str():
                return f"{value!r}"[:200]
            case Vec(x, y):
                return f"the pair ({x:.6g}, {y:.6g})"
        return f"a {type(value).__name__.removesuffix('Value').lower()}"

    # ------------------------------------------------------------ the lesson's engine

    def circle(self, pos: Pair, radius: float = 10.0, mass: float = 1.0, **fields: Any) -> Thing:
        """A disc, static with mass 0. `fields`: vel, omega, angle, friction, restitution."""
        return self._body("Circle", float(radius), pos, mass, fields)

    def box(self, pos: Pair, half: Pair, **fields: Any) -> Thing:
        """A static box with half extents `half`."""
        return self._body("Box", Vec(*half), pos, 0.0, fields)

    def _body(
        self,
        shape: Literal["Circle", "Box"],
        size: float | Vec,
        pos: Pair,
        mass: float,
        fields: dict[str, Any],
    ) -> Thing:
        surface: dict[str, float] = {
            name: float(fields.pop(name)) for name in ("restitution", "friction") if name in fields
        }
        rest = {name: plain(value) for name, value in fields.items()}
        request = MakeBody(self.module, shape, size, Vec(*pos), float(mass), surface, rest)
        return self.thing(self._value(request), "a Body")

    def thing(self, value: Value, what: str = "an object") -> Thing:
        """The value as an object that lives in the child."""
        if isinstance(value, Ref):
            return Thing(value.id)
        if isinstance(value, BodyValue | ContactValue | SpaceValue | SpaceBody):
            return Thing(value.ref)
        self.fail(what, self.describe(value))

    def state(self, body: Thing) -> BodyValue:
        """A body's numbers, all finite."""
        value = self._value(Get(body.ref))
        if not isinstance(value, BodyValue):
            self.fail("a Body", self.describe(value))
        numbers = (*value.pos, *value.vel, value.angle, value.omega)
        if not all(map(math.isfinite, numbers)):
            self.fail("finite numbers in every body", f"{numbers}")
        return value

    def contact_or_none(self, value: Value) -> ContactValue | None:
        """The value as a Contact or None, with finite numbers."""
        if value is None or isinstance(value, ContactValue):
            if value is not None:
                self.pair(value.normal, "the normal")
                self.pair(value.point, "the point")
                self.number(value.depth, "the depth")
            return value
        self.fail("a Contact or None", self.describe(value))

    def world(
        self,
        *bodies: Thing,
        gravity: Pair = (0.0, 0.0),
        linear_damping: float = 0.0,
        angular_damping: float = 0.0,
        joints: Sequence[Thing] = (),
        bonus: bool = False,
    ) -> Thing:
        """A World with these bodies; without gravity and damping unless asked for.

        `bonus`: the world of the bonus tasks. Older submissions have one World for everything.
        """
        request = MakeWorld(
            self.module,
            Vec(*gravity),
            linear_damping,
            angular_damping,
            [body.ref for body in bodies],
            [joint.ref for joint in joints],
            bonus,
        )
        return self.thing(self._value(request), "a World")

    def simulate(
        self,
        world: Thing,
        watch: Sequence[Thing],
        steps: int,
        dt: float = STEP,
        every: int = 1,
        contacts: bool = False,
    ) -> "Run":
        """Step the world and record the watched bodies after each `every` steps."""
        request = Simulate(world.ref, dt, steps, [b.ref for b in watch], every, contacts)
        reply = self._reply(request)
        if not isinstance(reply, Simulated):
            self.fail("a run of the simulation", "something else")
        width = 6 * len(watch)
        if len(reply.frames) != steps // every or any(len(f) != width for f in reply.frames):
            self.fail(f"{steps // every} recorded steps", f"{len(reply.frames)}")
        for number, frame in enumerate(reply.frames):
            if not all(map(math.isfinite, frame)):
                self.fail("finite numbers in every body", f"NaN or infinity in step {number + 1}")
        return Run(reply, every * dt)

    # ------------------------------------------------------------ pymunk, forces, programs

    def space(self, value: Value) -> SpaceValue:
        """The value as a pymunk Space, described."""
        if not isinstance(value, SpaceValue):
            self.fail("a pymunk Space", self.describe(value))
        return value

    def integrate(
        self, method: str, start: Pair, dt: float, force: Sequence[float], steps: int = 1
    ) -> list[Pair]:
        """The states (x, v) after each step of an integrator under `force`, a polynomial in x."""
        target = f"{self.module}:{method}"
        request = Integrate(target, *start, dt, list(force), steps)
        answers = self.items(self._value(request), f"what {method} returns")
        states = [self.pair(each, f"what {method} returns") for each in answers]
        self.want(len(states) == steps, f"{steps} states", f"{len(states)}")
        return states

    def play(
        self,
        frames: list[int],
        events: Sequence[Event] = (),
        *,
        physics: bool = True,
        trail_every: int = 0,
        pictures: bool = False,
        module: str = "",
    ) -> Played:
        """Run the program's real main(), one entry of `frames` (ms) per frame.

        A second run has a process of its own: main() may count on being run once.
        """
        if self._played and self._child is not None and self._over is None:
            self._child.end()
            self._child = None
        self._played = True
        request = Play(module or self.module, frames, list(events), physics, trail_every, pictures)
        reply = self._reply(request)
        if not isinstance(reply, Played):
            self.fail("a run of the program", "something else")
        return reply

    # ------------------------------------------------------------ the wire

    def _value(self, request: Request) -> Value:
        return self._returned(request).value

    def _returned(self, request: Request) -> Returned:
        reply = self._reply(request)
        if not isinstance(reply, Returned):
            self.fail("a value", "something else")
        return reply

    def _reply(self, request: Request) -> Any:
        if self._child is None:
            self._begin()
        return self._ask(request)

    def _begin(self) -> None:
        try:
            self._child = self.open_child()
        except ChildEnded as error:
            self._stop(str(error))
        try:
            reply = self._ask(Import(self.module, self.pieces))
        except (Broke, NotYet) as failure:
            self._over = failure
            raise
        if isinstance(reply, Returned) and isinstance(reply.value, str):
            self.swapped = reply.value.split(",") if reply.value else []

    def _ask(self, request: Request) -> Any:
        if self._over is not None:
            raise self._over
        try:
            answered = self._send(request)
        except ChildEnded as error:
            self._stop(str(error))
        self.output += answered.output[: MAX_OUTPUT - len(self.output)]
        match answered.reply:
            case Raised() as raised:
                text = f"{raised.error}: {raised.message}"
                raise self._remember(Broke(self.running, text, raised))
            case Missing(what):
                missing = NotYet(self.running, "the names and types of the lesson", what)
                missing.quotes = True
                raise self._remember(missing)
        return answered.reply

    def _send(self, request: Request) -> Answered:
        assert self._child is not None
        return self._child.ask(request)

    def _stop(self, why: str) -> NoReturn:
        """The child is gone: this check has its outcome, whatever else it would have asked."""
        self._over = Broke(self.running, why)
        raise self._remember(self._over)

    @contextmanager
    def opened(self) -> Iterator["Lab"]:
        """End the child afterwards, whatever happened."""
        try:
            yield self
        finally:
            if self._child is not None:
                self._child.end()


class Run:
    """The recorded steps of a simulation."""

    def __init__(self, simulated: Simulated, seconds_per_frame: float) -> None:
        self.frames = simulated.frames
        self.contacts = simulated.contacts
        self.seconds_per_frame = seconds_per_frame

    def body(self, number: int) -> list["Moment"]:
        """The states of the watched body with this number, one per recorded step."""
        return [Moment(*frame[6 * number : 6 * number + 6]) for frame in self.frames]


@dataclass(frozen=True, slots=True)
class Moment:
    """A body at one moment: px, px/s, rad, rad/s."""

    x: float
    y: float
    vx: float
    vy: float
    angle: float
    omega: float

    @property
    def speed(self) -> float:
        return math.hypot(self.vx, self.vy)


def plain(value: Any) -> Argument:
    """An argument in the form that crosses the pipe."""
    if isinstance(value, Thing):
        return Ref(value.ref)
    if isinstance(value, tuple):
        return Vec(*value)
    return value  # type: ignore[no-any-return]


__all__ = ["Broke", "Lab", "Moment", "NotYet", "Observation", "Pair", "Run", "SpaceJoint", "Thing"]
