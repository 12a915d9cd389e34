"""Send requests to a submission: build bodies, call functions, step worlds, play programs.

A check reaches the submission only through a `Lab`. Every answer is made of plain numbers, strictly
typed and finite, or the check fails with a sentence that says what was wrong.
"""

import math
import random
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from itertools import accumulate, count
from typing import Any, Literal, NamedTuple

import msgspec

from grader.judge.asking import Asker, Judge, Noted, Observation
from grader.judge.decode import Pair, Thing
from grader.judge.failures import TRESPASS, Broke, NotYet
from grader.judge.wall.children import Child
from grader.judge.wall.connection import Connection
from grader.protocol import (
    Argument,
    BodyValue,
    Call,
    Change,
    ContactValue,
    Event,
    Get,
    Integrate,
    MakeBody,
    MakeWorld,
    Piece,
    Play,
    Played,
    Ref,
    Returned,
    Set,
    Simulate,
    Simulated,
    Value,
    Vec,
)

STEP = 1 / 120  # s
ROUNDED = 1e-6  # ms
Opening = tuple[int, Event | None]  # frames to wait, and an event to end the title
Frame = Mapping[Thing, str]  # the fields that may change, by their owner
NOTHING: Frame = {}
OURS = 1_000_000  # the judge numbers objects from here on, the child below


class Lab(Asker):
    """One check's view of the submission; `open_child` starts a fresh process when first needed."""

    def __init__(
        self,
        module: str,  # the program that the check imports
        open_child: Callable[[], Child],
        pieces: list[Piece],
        secret: str | None = None,  # of the instructor, if there is one
    ) -> None:
        super().__init__(Connection(module, open_child, pieces))
        self.drawn = None if secret is None else random.Random(secret)
        self.factor = self.about(1.0)  # for all numbers of one kind in a check, such as masses
        self.module = module
        # The first forbidden change. It fails a check that would otherwise pass: a wrong answer
        # comes first.
        self.overstepped: NotYet | None = None
        self.trespass = ""  # the message about it, if an answer is also wrong
        self.unforeseen = False  # the check itself raised an error
        self.numbers = count(OURS)  # for objects that the judge makes
        self.remembers: list[str] = []  # names that kept a value; see Remembered
        self.played = False  # whether the child has run a program
        self.notes: list[str] = []  # sentences for the report of a check that passes
        self.opening: Opening | None = None  # opening of a program that begins with a title

    @property
    def ended(self) -> bool:
        """Return whether the submission's process ended before the check did."""
        return isinstance(self.failure, Broke) and self.failure.raised is None

    @property
    def late(self) -> bool:
        """Return whether the process was ended because its time was over."""
        return isinstance(self.failure, Broke) and self.failure.late

    @contextmanager
    def opened(self) -> Iterator["Lab"]:
        """Use the lab, and end its child afterwards."""
        try:
            yield self
        finally:
            self.connection.end()

    def about(self, number: float, within: float | None = None) -> float:
        """Return the number or, under an instructor's secret seed, a number near it.

        So students cannot hard-code the answers. The number changes by eighths of `within`, by
        default a quarter of the number: sums and products of round numbers stay exact. Properties
        draw their numbers, and do not need this.
        """
        if self.drawn is None:
            return number
        most = number / 4 if within is None else within
        return number + self.drawn.choice([-1, 1]) * self.drawn.randint(1, 8) / 8 * most

    def whole(self, number: int, within: int) -> int:
        """Return a whole number or, under a secret seed, one that differs by 1 to `within`."""
        if self.drawn is None:
            return number
        return number + self.drawn.choice([-1, 1]) * self.drawn.randint(1, within)

    # ------------------------------------------------------------ asking

    def probe(self) -> None:
        """Import the submission."""
        self.connection.begin(self.running)

    def call(
        self,
        name: str,
        *args: Any,
        changes: Frame | None = None,
        twice: bool = False,
        sees: Iterable[Thing] = (),
        marks: dict[str, float] | None = None,
        noted: Noted | None = None,
        then: Judge | None = None,
        **kwargs: Any,
    ) -> Value:
        """Call `name` of the TODO's module, or `module:name`.

        `changes` names the fields that the call may change, as in {a: "vel"}; NOTHING is for a
        function that changes none. Without `changes` nothing is compared. `twice`: a second call
        must give the same answer. See `overstepped`. The answer brings the state of the things in
        `changes` and `sees`. `marks` are fields to set in the returned contact. An exception
        becomes an observation of `noted`.
        """
        request = make_call(
            self._target(name),
            args,
            kwargs={key: plain(value) for key, value in kwargs.items()},
            framed=changes is not None,
            twice=twice,
            states=list_refs(changes or (), sees),
            marks=marks or {},
        )
        return self._ask(request, partial(self._compare, name, request, changes), noted, then)

    def make(self, name: str, *args: Any) -> Thing:
        """Return a new object of a class, named as in `call`, such as a rod between two bodies."""
        made = self._new(f"the {name.rpartition(':')[2]}")
        self._value(make_call(self._target(name), args, ref=made.ref, quiet=True))
        return made

    def _target(self, name: str) -> str:
        return name if ":" in name else f"{self.module}:{name}"

    def tell(
        self,
        thing: Thing,
        method: str,
        *args: Any,
        changes: Frame | None = None,
        sees: Iterable[Thing] = (),
        noted: Noted | None = None,
        then: Judge | None = None,
    ) -> Value:
        """Call a method of an object in the child; the arguments are those of `call`."""
        framed, states = changes is not None, list_refs(changes or (), sees)
        request = make_call(f"#{thing.ref}.{method}", args, framed=framed, states=states)
        return self._ask(request, partial(self._compare, method, request, changes), noted, then)

    def let(self, thing: Thing, method: str, *args: Any) -> None:
        """Call a method whose answer is not needed."""
        self._value(make_call(f"#{thing.ref}.{method}", args, quiet=True))

    def _compare(
        self, name: str, request: Call | Integrate, changes: Frame | None, returned: Returned
    ) -> Value:
        """Return the answer, and remember a forbidden change until the check ends."""
        if changes is not None and self.overstepped is None:
            beyond = [
                each
                for each in returned.changed
                if each.name not in changes.get(Thing(each.ref), "").split()
            ]
            self.overstepped = self._trespass(name, changes, beyond)
        if (
            request.twice
            and self.overstepped is None
            and not are_same(returned.value, returned.again)
        ):
            self.overstepped = NotYet(
                self.running,
                "the same answer when the same question is asked again",
                f"first {self.describe(returned.value)}, then {self.describe(returned.again)}",
                f"{name} must depend on its arguments alone.",
            )
        return returned.value

    def _trespass(self, name: str, changes: Frame, beyond: list[Change]) -> NotYet | None:
        """Return the failure of a function that made forbidden changes, or None."""
        if not beyond:
            return None
        allowed = ", ".join(
            f"{name_fields(fields)} of {self.names.get(thing.ref, 'an object')}"
            for thing, fields in changes.items()
        )
        return NotYet(
            self.running,
            f"nothing changed but the {allowed}" if allowed else "nothing changed",
            f"{name} changed {', '.join(dict.fromkeys(map(self._place, beyond)))}",
            TRESPASS.format(name=name),
        )

    def _place(self, change: Change) -> str:
        if change.ref < 0:
            return f"its argument number {-change.ref}"
        if change.ref == 0:
            return f"the constant {change.name}"
        return f"the {name_fields(change.name)} of {self.names.get(change.ref, 'another object')}"

    def advance(self, world: Thing, accumulator: float, seconds: float) -> "Advance":
        """Call the program's `advance`; count its steps without running them.

        The call must change nothing.
        """
        args = (world, accumulator, seconds)
        request = make_call(self._target("advance"), args, framed=True, stepping=True)
        returned = self._returned(request)
        self._compare("advance", request, NOTHING, returned)
        answer = self.items(returned.value, "what advance returns")
        self.want(len(answer) == 2, "(accumulator, steps)", self.describe(returned.value))
        rest = self.number(answer[0], "the accumulator")
        said = self.number(answer[1], "the number of steps")
        return Advance(rest, returned.steps, returned.dts, said)

    def work(self, thing: Thing, method: str, *args: Any) -> int:
        """Count the submission's lines that run in a call of a method."""
        return self._returned(make_call(f"#{thing.ref}.{method}", args, work=True)).lines

    def get(self, thing: Thing, name: str, then: Judge | None = None) -> Value:
        """Return an attribute of an object, such as a rod's `length`."""
        if then is None:
            return self._value(Get(thing.ref, name))
        return self._ask(Get(thing.ref, name), lambda returned: returned.value, then=then)

    def gets(self, wanted: Iterable[tuple[Thing, str]]) -> list[Value]:
        """Return attributes of objects, by their names; an empty name is the object itself."""
        found: list[Value] = []
        for thing, name in wanted:
            self.get(thing, name, then=found.append)
        self.settle()
        return found

    def put(self, thing: Thing, **fields: Any) -> None:
        """Set attributes of an object; a tuple becomes a pair."""
        self._value(Set(thing.ref, {name: plain(value) for name, value in fields.items()}))

    # ------------------------------------------------------------ the lesson's engine

    def circle(self, pos: Pair, radius: float = 10.0, mass: float = 1.0, **fields: Any) -> Thing:
        """Return a disc, static with mass 0. `fields`: vel, omega, angle, friction, restitution."""
        return self._body("Circle", float(radius), pos, mass, fields)

    def box(self, pos: Pair, half: Pair, **fields: Any) -> Thing:
        """Return a static box with half extents `half`."""
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
        name, place = f"the {shape.lower()} at ({pos[0]:g}, {pos[1]:g})", Vec(*pos)
        made = self._new(name)
        request = MakeBody(made.ref, self.module, shape, size, place, float(mass), surface, rest)
        self._value(request)
        return made

    def _new(self, name: str) -> Thing:
        """Return an object that the child makes before its next answer."""
        thing = Thing(next(self.numbers))
        self.names[thing.ref] = name
        return thing

    def state(self, body: Thing) -> BodyValue:
        """Return a body's numbers, all finite."""
        return self.body(self._value(Get(body.ref)))

    def world(
        self,
        *bodies: Thing,
        gravity: Pair = (0.0, 0.0),
        linear_damping: float = 0.0,
        angular_damping: float = 0.0,
        joints: Sequence[Thing] = (),
        bonus: bool = False,
    ) -> Thing:
        """Return a World with these bodies, by default without gravity and damping.

        `bonus`: the world of the bonus tasks. Older submissions have one World for everything.
        """
        made = self._new("the world")
        request = MakeWorld(
            made.ref,
            self.module,
            Vec(*gravity),
            linear_damping,
            angular_damping,
            [body.ref for body in bodies],
            [joint.ref for joint in joints],
            bonus,
        )
        self._value(request)
        return made

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
        watched = [body.ref for body in watch]
        request = Simulate(world.ref, dt, steps, watched, every, contacts)
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

    def integrate(
        self,
        method: str,
        start: Pair,
        dt: float,
        force: Sequence[float],
        steps: int = 1,
        twice: bool = False,
        then: Callable[[list[Pair]], None] | None = None,
    ) -> list[Pair]:
        """Return the states (x, v) after each step of an integrator under a polynomial force of x.

        `twice`: the same question must get the same answer, and nothing else may change.
        """
        request = Integrate(self._target(method), *start, dt, list(force), steps, twice)
        compare = partial(self._compare, method, request, NOTHING if twice else None)

        def read(value: Value) -> list[Pair]:
            answers = self.items(value, f"what {method} returns")
            states = [self.pair(each, f"what {method} returns") for each in answers]
            self.want(len(states) == steps, f"{steps} states", f"{len(states)}")
            return states

        if then is None:
            return read(self._ask(request, compare))
        judge = then
        self._ask(request, compare, then=lambda value: judge(read(value)))
        return []

    def places(self, method: str, start: Pair, dt: float, force: Sequence[float]) -> list[float]:
        """Return the positions at which one step of an integrator asks for the acceleration."""
        request = Integrate(self._target(method), *start, dt, list(force), places=True)
        places = self.items(self._value(request), "the places")
        return [self.number(each, "what accel is asked about") for each in places]

    def play(
        self,
        frames: list[int],
        events: Sequence[Event] = (),
        *,
        physics: bool = True,
        trail_every: int = 0,
        pictures: bool = False,
        photos: Sequence[int] = (),
        step_ms: float = 0.0,
    ) -> Played:
        """Run the program as `python -m` starts it, one entry of `frames` (ms) per frame.

        A second run gets a process of its own. A run begins after a title or a loading picture.
        """
        request = Play(
            self.module,
            frames,
            list(events),
            physics,
            trail_every,
            pictures,
            list(photos),
            step_ms,
        )
        if self.opening is not None:
            return self._opened(request, self.opening)
        reply = self._played(request)
        may_begin_later = reply.ended == "returned" or first_step(reply) is None
        if starts_at_once(reply) or not may_begin_later:
            return reply
        return next(self._openings(request, reply), reply)

    def _openings(self, request: Play, reply: Played) -> Iterator[Played]:
        """Try to open a program that starts late, by waiting, keys and clicks."""
        known = first_step(reply) is not None
        for event in (None, *TRIES):
            again = event is not None or not known
            tried = self._played(with_lead(request, LEAD, event)) if again else reply
            first = first_step(tried)
            if first is not None and starts_at_once(
                played := self._opened(request, (opening := (first - 1, event)))
            ):
                self.opening = opening
                yield played

    def _opened(self, request: Play, opening: Opening) -> Played:
        """Run the program, and drop the frames of its opening."""
        return without_lead(self._played(with_lead(request, *opening)), opening[0])

    def _played(self, request: Play) -> Played:
        """Run the program once."""
        if self.played:
            self.start_anew()
        self.played = True
        reply = self._reply(request)
        if not isinstance(reply, Played):
            self.fail("a run of the program", "something else")
        asked = zip(reply.clock, accumulate(request.frames, initial=0), strict=False)
        self.want(
            all(told >= ms - ROUNDED for told, ms in asked),
            "frames that take as long as they are asked to",
            "shorter ones",
        )
        if any(len(row) % 6 for row in reply.trail):
            self.fail("six numbers for each moving body", "another count of them")
        return reply

    def deal(self, number: int) -> None:
        """Add `number` to the seeds of the submission's random generators from now on."""
        self.connection.deal = number
        self.start_anew()

    def start_anew(self) -> None:
        """Use a new process from now on, in which no program has run."""
        self.connection.restart()
        self.played = False


LEAD = 20  # frames, for a program that shows a title or loads something
IDLE = 100.0  # ms
TRIES = (  # events by which a person ends a title
    Event(2, "key", key="return"),
    Event(2, "click", (450, 300)),
    Event(2, "key", key="space"),
)


def first_step(played: Played) -> int | None:
    """Return the first frame in which a step ran, or None."""
    return next((number for number, steps in enumerate(played.steps) if steps), None)


def starts_at_once(played: Played) -> bool:
    """Return whether the first step runs before a person would notice a delay."""
    first = first_step(played)
    return first is not None and (first == 0 or played.clock[first - 1] <= IDLE)


def with_lead(request: Play, lead: int, event: Event | None) -> Play:
    """Return the request with `lead` frames before all others, and an event in them."""
    later = [msgspec.structs.replace(each, frame=each.frame + lead) for each in request.events]
    return msgspec.structs.replace(
        request,
        frames=[17] * lead + request.frames,
        events=[event, *later] if event else later,
        photos=[frame + lead for frame in request.photos],
    )


def without_lead(played: Played, lead: int) -> Played:
    """Return a run without its first `lead` frames."""
    if len(played.steps) <= lead:
        return played
    return msgspec.structs.replace(
        played,
        steps=[sum(played.steps[: lead + 1]), *played.steps[lead + 1 :]],
        clock=[each - played.clock[lead] for each in played.clock[lead:]],
        pictures=played.pictures[lead:],
        photos=[msgspec.structs.replace(p, frame=p.frame - lead) for p in played.photos],
    )


class Advance(NamedTuple):
    """The outcome of one frame of `advance`."""

    rest: float  # s, the accumulator that it returned
    steps: int  # that ran
    sizes: list[float]  # s, the different step sizes
    said: float  # the number of steps that it returned


class Run:
    """The recorded steps of a simulation."""

    def __init__(self, simulated: Simulated, seconds_per_frame: float) -> None:
        self.frames = simulated.frames
        self.contacts = simulated.contacts
        self.seconds_per_frame = seconds_per_frame

    def body(self, number: int) -> list["Moment"]:
        """Return the states of the watched body with this number, one per recorded step."""
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
        """Return the speed, px/s."""
        return math.hypot(self.vx, self.vy)


def are_same(first: Value, second: Value) -> bool:
    """Return whether two answers are equal, apart from the identity of new objects."""
    if isinstance(first, ContactValue) and isinstance(second, ContactValue):
        return msgspec.structs.replace(first, ref=second.ref) == second
    if isinstance(first, Ref) and isinstance(second, Ref):
        return first.kind == second.kind
    return first == second


FIELDS = {"pos": "position", "vel": "velocity", "omega": "spin", "inv_mass": "mass"}


def list_refs(*groups: Iterable[Thing]) -> list[int]:
    return list(dict.fromkeys(thing.ref for group in groups for thing in group))


def name_fields(fields: str) -> str:
    """Return the names of fields in the lesson's words."""
    return ", ".join(FIELDS.get(each, each) for each in fields.split())


def make_call(target: str, args: Iterable[Any], **more: Any) -> Call:
    """Return the request to call `module:name`, or `#number.method` of an object."""
    return Call(target, [plain(each) for each in args], **more)


def plain(value: Any) -> Argument:
    """Return an argument as the protocol sends it."""
    if isinstance(value, Thing):
        return Ref(value.ref)
    if isinstance(value, tuple):
        return Vec(*value)
    return value  # type: ignore[no-any-return]


__all__ = ["NOTHING", "Broke", "Lab", "Moment", "NotYet", "Observation", "Pair", "Run", "Thing"]
