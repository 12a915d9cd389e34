"""Record the bodies while a request is answered: for replays, made after all marks are decided.

A moment is one recorded state of the bodies. Lengths are px, speeds px/s, angles rad, in the
coordinates of the screen (y down).
"""

import math
from collections.abc import Callable
from contextlib import suppress
from itertools import islice
from typing import Any

import pymunk

from grader.protocol import (
    MAX_BODIES,
    MAX_RODS,
    MAX_TOUCHES,
    BodyLook,
    BodyRow,
    Call,
    Moment,
    Record,
    Reply,
    Request,
    Set,
    ShapeLook,
    Simulate,
    WithMoments,
)
from grader.worker.subject import Subject, refs_in
from grader.worker.values import (
    field,
    field_number,
    field_pair,
    read_ends,
    read_state,
    shape_order,
)

MAX_SHAPES, MAX_CORNERS = 40, 12  # of one body, and of one shape


class Recorder:
    """Records moments of the submission's bodies while it answers a request.

    A submission may have broken its objects: objects that cannot be described are left out, and
    every list has an upper bound.
    """

    def __init__(self, subject: Subject) -> None:
        self.subject = subject
        self.recording: Record | None = None
        self.bodies: dict[int, Any] = {}  # by number
        self.numbers: dict[int, int] = {}  # by id(body); self.bodies keeps these alive
        self.hidden = 0  # objects of earlier scenes
        self.given: list[int] = []  # numbers of the objects in this scene's requests
        self.world: Any = None  # of the running program, if any
        self.owner: type | None = None
        self._reset(None)

    # ------------------------------------------------------------ one request

    def start(self, recording: Record) -> None:
        """Get ready to record one request."""
        if recording.cut:
            self.hidden = len(self.subject.objects)
            self.given.clear()
            self.bodies.clear()
            self.numbers.clear()
        self.given += [ref for ref in list_named(recording.request) if ref not in self.given]
        self._reset(recording)

    def _reset(self, recording: Record | None) -> None:
        """Forget the moments; bodies keep their numbers as long as the scene goes on."""
        self.recording = recording
        self.moments: list[Moment] = []
        self.looks: dict[int, BodyLook] = {}
        self.every = self.total = 1
        self.states = 0

    def expect(self, states: int) -> None:
        """Set a run's number of states, so that the moments cover all of it."""
        self.total = states
        self.every = math.ceil(states / self.recording.most) if self.recording else 1

    def record(self, time: float, steps: int) -> None:
        """Record a state of a run, at `time` in s; every nth state, and the last, is a moment."""
        self.states += 1
        if self.recording and (self.states % self.every == 0 or self.states == self.total):
            self._add_moment(time, steps)

    def finish(self, reply: Reply) -> WithMoments:
        """Return the reply with its moments: at least the one at the end."""
        if not self.moments:
            self._add_moment(0.0, 0)
        answer = WithMoments(reply, self.looks, self.moments)
        self._reset(None)
        return answer

    # ------------------------------------------------------------ a program's world

    def watch_worlds(self, owner: type, states: int) -> None:
        """Record the latest World or Space that the program makes.

        A program may keep its world in a local variable, so we watch the making of worlds.
        """
        self.expect(states)
        if self.recording is None:
            return
        self.owner, self.real = owner, owner.__init__  # type: ignore[misc]

        def init(world: Any, *args: Any, **kwargs: Any) -> None:
            self.world = world
            self.real(world, *args, **kwargs)

        owner.__init__ = init  # type: ignore[misc]

    def stop_watching(self) -> None:
        """Restore the class's own __init__."""
        if self.owner is not None:
            self.owner.__init__ = self.real  # type: ignore[misc]
            self.owner = None

    # ------------------------------------------------------------ a moment

    def _add_moment(self, time: float, steps: int) -> None:
        """Add a moment; if describing a thing fails, the moment ends there."""
        moment = Moment(float(time), steps, [], [], [])
        with suppress(Exception):
            for thing in self._visible():
                self._add_visible(thing, moment)
        self.moments.append(moment)

    def _visible(self) -> list[Any]:
        """Return the program's world, or the objects that this scene has made or been given."""
        if self.world is not None:
            return [self.world]
        given = [self.subject.objects[ref] for ref in self.given if ref in self.subject.objects]
        return [*given, *list(self.subject.objects.values())[self.hidden :]]

    def _add_visible(self, thing: Any, moment: Moment) -> None:
        """Add a world or space with its contents, or one thing."""
        if isinstance(thing, pymunk.Space):
            for body in (thing.static_body, *thing.bodies):
                self._append(moment.bodies, MAX_BODIES, self._body, body)
            for joint in thing.constraints:
                self._append(moment.rods, MAX_RODS, read_ends, joint)
        elif hasattr(thing, "bodies") and hasattr(thing, "joints"):
            for name in ("bodies", "joints", "springs", "contacts"):
                for each in islice(getattr(thing, name, ()), MAX_TOUCHES):
                    self._add_thing(each, moment)
        else:
            self._add_thing(thing, moment)

    def _add_thing(self, thing: Any, moment: Moment) -> None:
        """Add a body, contact, rod or spring, recognised by its attributes."""
        if isinstance(thing, pymunk.Body) or hasattr(thing, "inv_mass"):
            self._append(moment.bodies, MAX_BODIES, self._body, thing)
        elif hasattr(thing, "normal"):
            self._append(moment.touches, MAX_TOUCHES, self.subject.contact_row, thing)
        elif hasattr(thing, "length") and hasattr(thing, "a"):
            self._append(moment.rods, MAX_RODS, read_ends, thing)

    def _append(
        self, rows: list[Any], most: int, describe: Callable[[Any], Any], thing: Any
    ) -> None:
        """Add a row; skip it if `rows` is full or has it, or if describing it fails."""
        with suppress(Exception):
            row = describe(thing)
            if len(rows) < most and row not in rows:
                rows.append(row)

    def _body(self, body: Any) -> BodyRow:
        """Return the state of a body; a new body gets a number and a look."""
        number = self.numbers.get(id(body))
        if number is None:
            number = len(self.bodies) + 1
            look = self._look_of(body)
            self.numbers[id(body)], self.bodies[number] = number, body
            self.looks[number] = look
        return BodyRow(number, *read_state(body))

    def _look_of(self, body: Any) -> BodyLook:
        """Return the fixed properties of a body: shapes, mass (kg) and moment (kg px²)."""
        ref = self.subject.refs.get(id(body), 0)
        if isinstance(body, pymunk.Body):
            shapes = sorted(body.shapes, key=shape_order)[:MAX_SHAPES]
            moves = body.body_type == pymunk.Body.DYNAMIC
            weight = (body.mass, body.moment) if moves else (None, None)
            return BodyLook(ref, [pymunk_shape(each) for each in shapes], *weight)
        weights = (field_number(body, name) for name in ("inv_mass", "inv_inertia"))
        return BodyLook(
            ref, [lesson_shape(field(body, "shape"))], *(1 / w if w else None for w in weights)
        )


def lesson_shape(shape: Any) -> ShapeLook:
    """Return a circle or box of the lesson's engine."""
    if hasattr(shape, "radius"):
        return ShapeLook([(0.0, 0.0)], field_number(shape, "radius"))
    x, y = field_pair(shape, "half")
    return ShapeLook([(-x, -y), (x, -y), (x, y), (-x, y)], 0.0)


def list_named(request: Request) -> list[int]:
    """Return the numbers of the objects in a request, also those of earlier scenes."""
    match request:
        case Call():
            return refs_in(request)
        case Set(ref=ref):
            return [ref]
        case Simulate(ref=ref, watch=watch):
            return [ref, *watch]
    return []


def pymunk_shape(shape: pymunk.Shape) -> ShapeLook:
    """Return a shape of pymunk's, in the coordinates of its body; no points for an unknown kind."""
    match shape:
        case pymunk.Circle():
            points = [shape.offset]
        case pymunk.Segment():
            points = [shape.a, shape.b]
        case pymunk.Poly():
            points = shape.get_vertices()[:MAX_CORNERS]
        case _:
            points = []
    return ShapeLook([(x, y) for x, y in points], float(getattr(shape, "radius", 0.0)))
