"""Hold the submission inside a child: its modules and objects, and both as plain values.

Coming in, values are trusted: the judge sent them. Going out, nothing is: a submission may return
a subclass of float that lies when compared, a list without end, or a world with a field missing. So
every value is rebuilt here from the built-in types, in px, px/s, rad, rad/s, kg and kg px², and
the judge decodes it strictly once more.
"""

import importlib
import math
import numbers
import os
import random
import sys
import traceback
import types
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import pygame
import pymunk
from pymunk.constraints import Constraint, SlideJoint

from grader.protocol import (
    MAX_FRAMES,
    MAX_NAME,
    MAX_TEXT,
    Argument,
    BodyValue,
    Call,
    CodeLine,
    ContactValue,
    Integrate,
    Items,
    MakeBody,
    MakeWorld,
    Piece,
    Raised,
    Ref,
    Rng,
    ShapeValue,
    SpaceBody,
    SpaceJoint,
    SpaceValue,
    Value,
    Vec,
    cut,
)
from grader.worker.memory import Memory
from grader.worker.standin import fitted, plain_function, put_in_place

MAX_ITEMS = 1000  # entries of a returned list
LARGEST_INT = 2**53
REFERENCE = "<reference>"  # the file name of functions that stand in


class ContractError(Exception):
    """The submission lacks something that the lab sheet asks for, or has it in another type.

    The message is for the student.
    """


class Subject:
    """Imports the submission and hands out numbered references to its objects.

    Objects stay in this process; the judge sees numbers only. They are kept as long as the child
    lives, so that an id() belongs to one object.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.objects: dict[int, Any] = {}  # by reference number, in the order they came up
        self.refs: dict[int, int] = {}  # reference numbers by id() of the object
        self.memory: Memory | None = None  # of how it was after the import
        self.counters: dict[type, Any] = {}  # of the steps of worlds that are not to be run
        # What the submission's functions take for a pair of numbers.
        self.pair_type: Callable[[float, float], Any] = pygame.Vector2
        sys.path.insert(0, str(folder))
        sys.argv[:] = [""]

    # ------------------------------------------------------------ names

    def load(self, module: str, pieces: list[Piece]) -> None:
        """Import `module`, and swap in the pieces of the reference."""
        package = (self.folder / module).is_dir()
        if not package and not (self.folder / f"{module}.py").exists():
            raise ContractError(f"there is no {module}.py, and no folder {module}")
        sys.argv[0] = str(self.folder / (f"{module}/__main__.py" if package else f"{module}.py"))
        importlib.import_module(module)
        if module == "pymunk_scene":
            self.pair_type = pymunk.Vec2d
        for piece in pieces:
            self.swap(piece)

    def find(self, target: str) -> Any:
        """Return what a target names: module:path, or #ref.path for an object.

        Raises ContractError.
        """
        if target.startswith("#"):
            ref, _, path = target[1:].partition(".")
            thing, label = self.objects[int(ref)], f"{type(self.objects[int(ref)]).__name__}.{path}"
        else:
            module, _, path = target.partition(":")
            thing, label = self.module_with(path.partition(".")[0], module), f"{path} in {module}"
        for name in path.split("."):
            try:
                thing = getattr(thing, name)
            except AttributeError:
                raise ContractError(f"there is no {label}") from None
        return thing

    def module_with(self, name: str, module: str) -> types.ModuleType:
        """Return the module; of a package that does not export the name, the submodule that has it.

        The lab sheet fixes names, and leaves students free to move them between files.
        """
        whole = sys.modules.get(module)
        if whole is None:
            whole = importlib.import_module(module)
        if name in vars(whole):
            return whole
        parts = [part for key, part in sys.modules.items() if key.startswith(f"{module}.")]
        return next((each for each in parts if name in vars(each)), whole)

    def swap(self, piece: Piece) -> None:
        """Put the reference's function in the place of the submission's, for all who hold it.

        So an unfinished TODO costs no points in another one. Left alone when the submission has no
        such function, or one that is called otherwise.
        """
        try:
            original = plain_function(self.find(piece.target))
            if original is None or self._is_asked(piece, original):
                return
            wanted = fitted(self._build(piece, original), piece.parameters, original)
        except (ContractError, KeyError, ImportError):
            return
        if wanted is not None:
            put_in_place(original, wanted)

    def _is_asked(self, piece: Piece, original: types.FunctionType) -> bool:
        """Return whether one function of the submission is both: the other TODO's, and the one
        asked.
        """
        try:
            return bool(piece.asked) and plain_function(self.find(piece.asked)) is original
        except ContractError:
            return False

    def _build(self, piece: Piece, original: types.FunctionType) -> Callable[..., Any]:
        """Return the reference's function, compiled to use the submission's names."""
        namespace: dict[str, Any] = {"__name__": "reference"}
        exec(compile(piece.imports, REFERENCE, "exec"), namespace)
        exec(compile(piece.source, REFERENCE, "exec"), namespace)
        wanted = namespace[piece.target.rpartition(":")[2].rpartition(".")[2]]
        package = importlib.import_module(piece.target.partition(":")[0])
        names = set(piece.names) - set(namespace)
        for source in piece.given.values():
            exec(compile(source, REFERENCE, "exec"), namespace)
        for place in (vars(package), original.__globals__):
            namespace |= {name: place[name] for name in names if name in place}
        if not names <= set(namespace):
            raise ContractError(f"there is no {', '.join(names - set(namespace))}")
        return wanted  # type: ignore[no-any-return]

    # ------------------------------------------------------------ values in

    def decode(self, argument: Argument) -> Any:
        """Return an argument from the judge, as the submission's functions take it."""
        match argument:
            case Vec(x, y):
                return self.pair_type(x, y)
            case Ref(id=ref):
                return self.objects[ref]
            case Rng(seed):
                return random.Random(seed)
        return argument

    def integrate(self, request: Integrate) -> Items:
        """Return what the integrator answers, step by step, as far as each is a state to go on
        from.
        """
        method, accel = self.find(request.target), polynomial(request.force)
        places: list[Value] = []
        if request.places:
            accel = noting(accel, places)
        x, v = request.x, request.v
        answers: list[Value] = []
        for _ in range(request.steps):
            answer = self.encode(method(x, v, request.dt, accel))
            answers.append(answer)
            if not isinstance(answer, Vec) or not all(map(math.isfinite, answer)):
                break
            x, v = map(float, answer)
        return Items(places if request.places else answers)

    def make_body(self, request: MakeBody) -> Any:
        """Return a body of the lesson's engine in one request: most checks make many."""
        module = request.module
        shape = self.find(f"{module}:{request.shape}")(self.decode(request.size))
        body = self.find(f"{module}:Body")(
            shape, self.decode(request.pos), request.mass, **request.kwargs
        )
        set_inverses(body, request)
        for name, value in request.fields.items():
            setattr(body, name, self.decode(value))
        return body

    def make_world(self, request: MakeWorld) -> Any:
        known = vars(self.module_with("BonusWorld", request.module))
        kind = "BonusWorld" if request.bonus and "BonusWorld" in known else "World"
        world = self.find(f"{request.module}:{kind}")(
            gravity=self.decode(request.gravity),
            linear_damping=request.linear_damping,
            angular_damping=request.angular_damping,
        )
        for ref in request.bodies:
            world.add(self.objects[ref])
        for ref in request.joints:
            field(world, "joints").append(self.objects[ref])
        return world

    # ------------------------------------------------------------ values out

    def ref(self, thing: Any) -> int:
        """Return the number of an object, a new one at first sight."""
        number = self.refs.get(id(thing))
        if number is None:
            number = self.refs[id(thing)] = len(self.objects) + 1
            self.objects[number] = thing
        return number

    def called(self, ref: int, thing: Any) -> Any:
        """Return the same thing, which goes by a number that the judge has given it."""
        self.objects[ref], self.refs[id(thing)] = thing, ref
        return thing

    def encode(self, thing: Any) -> Value:
        """Return what the submission returned, as a plain value; what is none of these becomes a
        Ref.

        Raises ContractError where a body or contact lacks a field or has it in another type.
        """
        if thing is None or isinstance(thing, bool):
            return thing
        if isinstance(thing, str):
            return cut(str.__str__(thing), MAX_TEXT)
        if isinstance(thing, numbers.Real):
            return as_number(thing, "the returned value")
        if isinstance(thing, pymunk.Space):
            return self.space(thing)
        if isinstance(thing, pymunk.Body):
            return self.space_body(thing)
        if hasattr(thing, "normal") and hasattr(thing, "depth"):
            return self.contact(thing)
        if hasattr(thing, "inv_mass") and hasattr(thing, "pos"):
            return self.body(thing)
        pair = as_pair(thing)
        if pair is not None:
            return pair
        if isinstance(thing, list | tuple):
            return Items([self.encode(item) for item in thing[:MAX_ITEMS]])
        return Ref(self.ref(thing), type_name(thing))

    def state(self, ref: int) -> Value:
        """Return an object as a plain value; None if it has none: the caller must check."""
        try:
            return self.encode(self.objects[ref])
        except Exception:
            return None

    def body(self, body: Any) -> BodyValue:
        """Return a body of the lesson's engine, as numbers."""
        radius = getattr(getattr(body, "shape", None), "radius", 0.0)
        return BodyValue(
            self.ref(body),
            field_pair(body, "pos"),
            field_pair(body, "vel"),
            field_number(body, "angle"),
            field_number(body, "omega"),
            field_number(body, "inv_mass"),
            field_number(body, "inv_inertia"),
            as_number(radius, "the radius"),
        )

    def contact(self, contact: Any) -> ContactValue:
        """Return a contact of the lesson's engine, as numbers and the refs of its bodies."""
        return ContactValue(
            self.ref(contact),
            self.ref(field(contact, "a")),
            self.ref(field(contact, "b")),
            field_pair(contact, "normal"),
            field_number(contact, "depth"),
            field_pair(contact, "point"),
            field_number(contact, "jn"),
            field_number(contact, "jt"),
        )

    def space(self, space: pymunk.Space) -> SpaceValue:
        """Return all that stands in a pymunk space, the static body first."""
        return SpaceValue(
            self.ref(space),
            Vec(*space.gravity),
            space.damping,
            [self.space_body(body) for body in [space.static_body, *space.bodies]],
            [self._joint(joint) for joint in space.constraints],
        )

    def space_body(self, body: pymunk.Body) -> SpaceBody:
        """Return a pymunk body with its shapes, from left to right: pymunk's own order varies."""
        kinds = {pymunk.Body.DYNAMIC: "dynamic", pymunk.Body.KINEMATIC: "kinematic"}
        kind: Any = kinds.get(body.body_type, "static")
        return SpaceBody(
            self.ref(body),
            kind,
            Vec(*body.position),
            Vec(*body.velocity),
            body.angle,
            body.angular_velocity,
            body.mass if kind == "dynamic" else 0.0,
            body.moment if kind == "dynamic" and math.isfinite(body.moment) else None,
            [self._shape(shape) for shape in sorted(body.shapes, key=shape_order)],
        )

    def _shape(self, shape: pymunk.Shape) -> ShapeValue:
        box = shape.cache_bb()
        return ShapeValue(
            type_name(shape),
            float(getattr(shape, "radius", 0.0)),
            (box.left, box.bottom, box.right, box.top),
            shape.friction,
            shape.elasticity,
            not shape.sensor and shape.filter == pymunk.ShapeFilter(),
        )

    def _joint(self, joint: Constraint) -> SpaceJoint:
        """Return a pymunk constraint; anchors in world coordinates, where it has any."""
        anchor_a, anchor_b = (
            Vec(*body.local_to_world(getattr(joint, name))) if hasattr(joint, name) else None
            for body, name in ((joint.a, "anchor_a"), (joint.b, "anchor_b"))
        )
        return SpaceJoint(
            type_name(joint),
            self.ref(joint.a),
            self.ref(joint.b),
            anchor_a,
            anchor_b,
            getattr(joint, "distance", None),
            (joint.min, joint.max) if isinstance(joint, SlideJoint) else None,
        )

    # ------------------------------------------------------------ what went wrong

    def raised(self, error: BaseException) -> Raised:
        """Return an exception as data, with the submission's own frames only; the reference's stay
        hidden.

        The text is untrusted: its __str__ may fail or be long, and it may quote anything.
        """
        root = str(self.folder)
        frames = [
            CodeLine(
                cut(Path(frame.filename).relative_to(root).as_posix(), MAX_TEXT),
                frame.lineno or 0,
                cut(frame.name, MAX_NAME),
                cut(frame.line or "", MAX_NAME),
            )
            for frame in traceback.extract_tb(error.__traceback__)
            if frame.filename.startswith(root)
        ]
        if isinstance(error, SyntaxError) and str(error.filename or "").startswith(root):
            file = Path(str(error.filename)).relative_to(root).as_posix()
            text = cut((error.text or "").strip(), MAX_NAME)
            frames.append(CodeLine(cut(file, MAX_TEXT), error.lineno or 0, "", text))
            error.filename = error.lineno = None  # or its text would name the line once more
        try:
            message = cut(str(error).replace(root + os.sep, ""), MAX_TEXT)
        except Exception:
            message = ""
        return Raised(type_name(error), message, frames[-MAX_FRAMES:])


def set_inverses(body: Any, request: MakeBody) -> None:
    """Give a body the inverse mass and inertia of a full disc, or of a static one with mass 0.

    Checks are not about the constructor. What is right by rounding stays as the submission has it.
    """
    right = {"inv_mass": 0.0, "inv_inertia": 0.0}
    if request.mass and not isinstance(request.size, Vec):
        right = {"inv_mass": 1 / request.mass, "inv_inertia": 2 / (request.mass * request.size**2)}
    for name, value in right.items():
        own = getattr(body, name, value)
        if isinstance(own, numbers.Real) and not math.isclose(own, value, rel_tol=1e-9):
            with suppress(AttributeError):  # it is worked out each time
                setattr(body, name, value)


def type_name(thing: Any) -> str:
    """Return what a thing calls its type; a submission may have given it any name."""
    return cut(type(thing).__name__, MAX_NAME)


def polynomial(coefficients: list[float]) -> Callable[..., float]:
    """accel(x) for an integrator, from its coefficients, lowest power first."""

    def accel(x: float) -> float:
        total = 0.0
        for coefficient in reversed(coefficients):
            total = total * x + coefficient
        return total

    return accel


def noting(accel: Callable[..., float], places: list[Value]) -> Callable[..., float]:
    """Return the same, and the first places at which it is asked are noted."""

    def noted(x: float, *others: Any) -> float:
        if len(places) < MAX_ITEMS:
            places.append(as_number(x, "what accel is asked about"))
        return accel(x, *others)

    return noted


def refs_in(request: Call) -> list[int]:
    """Return the objects that a call is given, its own among them."""
    given = [each.id for each in (*request.args, *request.kwargs.values()) if isinstance(each, Ref)]
    own = request.target[1:].partition(".")[0] if request.target.startswith("#") else ""
    return [*given, *([int(own)] if own else [])]


def shape_order(shape: pymunk.Shape) -> tuple[float, float]:
    """Return the key that sorts shapes from left to right, then upwards."""
    box = shape.cache_bb()
    return box.left, box.bottom


def field(thing: Any, name: str) -> Any:
    """Return an attribute. Raises ContractError, so that a missing one is told in words."""
    try:
        return getattr(thing, name)
    except AttributeError:
        raise ContractError(f"{type_name(thing)} has no {name}") from None


def field_number(thing: Any, name: str) -> float:
    """Return an attribute as a number."""
    value = field(thing, name)
    if type(value) is float:  # most are, and most of what a child does is this
        return value
    return as_number(value, f"{type_name(thing)}.{name}")


def field_pair(thing: Any, name: str) -> Vec:
    """Return an attribute as a pair of numbers."""
    value = field(thing, name)
    pair = as_pair(value)
    if pair is None:
        raise ContractError(
            f"{type_name(thing)}.{name} is {describe(value)}; expected a Vector2 or a pair"
        )
    return pair


def as_number(value: Any, what: str) -> float:
    """Return a true int or float, rebuilt from whatever number-like thing the submission made of
    it.

    `int.__int__` and `float.__float__` read the value itself: a subclass may override both.
    Raises ContractError for anything but a number; a bool is none.
    """
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise ContractError(f"{what} is {describe(value)}; expected a number")
    if isinstance(value, int) and abs(int.__int__(value)) <= LARGEST_INT:
        return int.__int__(value)
    try:
        return float.__float__(value) if isinstance(value, float) else float(value)
    except OverflowError:
        return math.inf


def as_pair(value: Any) -> Vec | None:
    """Return a pair of numbers from any sequence of two; None if it is not one."""
    if type(value) is pygame.Vector2:
        return Vec(value.x, value.y)
    try:
        if isinstance(value, str | bytes) or len(value) != 2:
            return None
        x, y = value
        return Vec(as_number(x, "x"), as_number(y, "y"))
    except Exception:
        return None


def describe(value: Any) -> str:
    """Return what a value is, for a message; its repr() would be the submission's own code."""
    return "None" if value is None else f"of type {type_name(value)}"
