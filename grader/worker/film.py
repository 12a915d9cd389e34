"""Shows what a request does to the bodies: for replays, made when all marks are decided."""

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
    Film,
    Filmed,
    Reply,
    ShapeLook,
    Shot,
    TouchRow,
)
from grader.worker.subject import Subject, field, field_number, field_pair, shape_order

MAX_SHAPES, MAX_CORNERS = 40, 12  # of one body, and of one shape

Ends = tuple[float, float, float, float]


def lesson_state(body: Any) -> list[float]:
    """x, y, vx, vy, angle, omega of a body of the lesson's engine."""
    pos, vel = field_pair(body, "pos"), field_pair(body, "vel")
    turning = field_number(body, "angle"), field_number(body, "omega")
    return [pos.x, pos.y, vel.x, vel.y, *turning]


class Camera:
    """Takes shots of the submission's bodies while a filmed request is answered."""

    def __init__(self, subject: Subject) -> None:
        self.subject = subject
        self.film: Film | None = None
        self.cast: dict[int, Any] = {}  # the bodies by number
        self.numbers: dict[int, int] = {}  # by id(body); the cast keeps those alive
        self.before = 0  # objects up to this number belong to an earlier scene
        self.world: Any = None  # of the program that runs, if one does
        self.owner: type | None = None
        self._new_film(None)

    # ------------------------------------------------------------ rolling

    def load(self, film: Film) -> None:
        """Get ready for one request."""
        if film.cut:
            self.before = len(self.subject.objects)
            self.cast.clear()
            self.numbers.clear()
        self._new_film(film)

    def _new_film(self, film: Film | None) -> None:
        self.film = film
        self.shots: list[Shot] = []
        self.looks: dict[int, BodyLook] = {}
        self.every = self.total = 1
        self.seen = 0

    def expect(self, moments: int) -> None:
        """Say how many moments there will be, so that not more of them are taken than wanted."""
        self.total = moments
        self.every = math.ceil(moments / self.film.most) if self.film else 1

    def look(self, time: float, steps: int) -> None:
        """A moment of a run; some are taken, the last one always."""
        self.seen += 1
        if self.film and (self.seen % self.every == 0 or self.seen == self.total):
            self._shoot(time, steps)

    def developed(self, reply: Reply) -> Filmed:
        """The reply with its shots: at least the one of how it ended."""
        if not self.shots:
            self._shoot(0.0, 0)
        filmed = Filmed(reply, self.looks, self.shots)
        self._new_film(None)
        return filmed

    # ------------------------------------------------------------ a program's world

    def follow(self, owner: type, moments: int) -> None:
        """Watch the latest World or Space that is made."""
        self.expect(moments)
        if self.film is None:
            return
        self.owner, self.real = owner, owner.__init__  # type: ignore[misc]

        def init(world: Any, *args: Any, **kwargs: Any) -> None:
            self.world = world
            self.real(world, *args, **kwargs)

        owner.__init__ = init  # type: ignore[misc]

    def unfollow(self) -> None:
        if self.owner is not None:
            self.owner.__init__ = self.real  # type: ignore[misc]
            self.owner = None

    # ------------------------------------------------------------ a shot

    def _shoot(self, time: float, steps: int) -> None:
        """What cannot be looked at is left out: a submission may have made anything of it."""
        shot = Shot(float(time), steps, [], [], [])
        with suppress(Exception):
            for thing in self._things():
                self._show(thing, shot)
        self.shots.append(shot)

    def _things(self) -> list[Any]:
        if self.world is not None:
            return [self.world]
        return [each for ref, each in self.subject.objects.items() if ref > self.before]

    def _show(self, thing: Any, shot: Shot) -> None:
        if isinstance(thing, pymunk.Space):
            for body in (thing.static_body, *thing.bodies):
                self._add(shot.bodies, MAX_BODIES, self._body, body)
            for joint in thing.constraints:
                self._add(shot.rods, MAX_RODS, pymunk_rod, joint)
        elif hasattr(thing, "bodies") and hasattr(thing, "joints"):
            for name in ("bodies", "joints", "springs", "contacts"):
                for each in islice(getattr(thing, name, ()), MAX_TOUCHES):
                    self._show_one(each, shot)
        else:
            self._show_one(thing, shot)

    def _show_one(self, thing: Any, shot: Shot) -> None:
        if isinstance(thing, pymunk.Body) or hasattr(thing, "inv_mass"):
            self._add(shot.bodies, MAX_BODIES, self._body, thing)
        elif hasattr(thing, "normal"):
            self._add(shot.touches, MAX_TOUCHES, touch, thing)
        elif hasattr(thing, "length") and hasattr(thing, "a"):
            self._add(shot.rods, MAX_RODS, lesson_rod, thing)

    def _add(self, rows: list[Any], most: int, describe: Callable[[Any], Any], thing: Any) -> None:
        with suppress(Exception):
            row = describe(thing)
            if len(rows) < most and row not in rows:
                rows.append(row)

    def _body(self, body: Any) -> BodyRow:
        number = self.numbers.get(id(body))
        if number is None:
            number = len(self.cast) + 1
            look = self._look_of(body)
            self.numbers[id(body)], self.cast[number] = number, body
            self.looks[number] = look
        if isinstance(body, pymunk.Body):
            state = [*body.position, *body.velocity, body.angle, body.angular_velocity]
        else:
            state = lesson_state(body)
        return BodyRow(number, *state)

    def _look_of(self, body: Any) -> BodyLook:
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
    if hasattr(shape, "radius"):
        return ShapeLook([(0.0, 0.0)], field_number(shape, "radius"))
    x, y = field_pair(shape, "half")
    return ShapeLook([(-x, -y), (x, -y), (x, y), (-x, y)], 0.0)


def pymunk_shape(shape: pymunk.Shape) -> ShapeLook:
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


def touch(contact: Any) -> TouchRow:
    point, normal = field_pair(contact, "point"), field_pair(contact, "normal")
    rest = (field_number(contact, name) for name in ("depth", "jn", "jt"))
    return TouchRow(point.x, point.y, normal.x, normal.y, *rest)


def lesson_rod(joint: Any) -> Ends:
    a, b = (field_pair(field(joint, end), "pos") for end in ("a", "b"))
    return a.x, a.y, b.x, b.y


def pymunk_rod(joint: Any) -> Ends:
    return *joint.a.local_to_world(joint.anchor_a), *joint.b.local_to_world(joint.anchor_b)
