"""Hold the submission inside a child: import it, make and find its objects, describe them.

Values from the judge are trusted. values.py rebuilds values of the submission, in px, px/s, rad,
rad/s, kg and kg px², and the judge decodes them strictly once more.
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
    ContactRow,
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
from grader.worker.standin import adapt, plain_function, replace_function
from grader.worker.values import (
    ContractError,
    as_number,
    as_pair,
    field,
    field_number,
    field_pair,
    shape_order,
    type_name,
)

MAX_ITEMS = 1000  # maximum of entries in a returned list
REFERENCE = "<reference>"  # the file name of replacements


class Subject:
    """The submission's modules and objects; the judge knows an object by its number.

    Objects live as long as the child, so that an id() belongs to one object.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.objects: dict[int, Any] = {}  # objects by number, in order
        self.refs: dict[int, int] = {}  # numbers by id() of the object
        self.memory: Memory | None = None  # the state after the import
        self.counters: dict[type, Any] = {}  # count steps of worlds that must not run
        # The type of a pair of numbers in calls of the submission's functions.
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
        """Find a target: module:path, or #ref.path for an object. Raises ContractError."""
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
        """Return the module, or the submodule with this name if the package does not export it.

        The lab sheet fixes names; students may move them between files.
        """
        whole = sys.modules.get(module)
        if whole is None:
            whole = importlib.import_module(module)
        if name in vars(whole):
            return whole
        parts = [part for key, part in sys.modules.items() if key.startswith(f"{module}.")]
        return next((each for each in parts if name in vars(each)), whole)

    def swap(self, piece: Piece) -> None:
        """Replace a function of the submission by the reference's, so that only one TODO counts.

        Does nothing if the submission has no such function, or one with other parameters.
        """
        try:
            original = plain_function(self.find(piece.target))
            if original is None or self._is_asked(piece, original):
                return
            wanted = adapt(self._build(piece, original), piece.parameters, original)
        except (ContractError, KeyError, ImportError):
            return
        if wanted is not None:
            replace_function(original, wanted)

    def _is_asked(self, piece: Piece, original: types.FunctionType) -> bool:
        """Return whether `original` is the function that the check tests."""
        try:
            return bool(piece.asked) and plain_function(self.find(piece.asked)) is original
        except ContractError:
            return False

    def _build(self, piece: Piece, original: types.FunctionType) -> Callable[..., Any]:
        """Compile the reference's function so that it uses the submission's names."""
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
        """Call an integrator step by step, as long as it returns finite pairs."""
        method, accel = self.find(request.target), polynomial(request.force)
        positions: list[Value] = []
        if request.places:
            accel = record_positions(accel, positions)
        x, v = request.x, request.v
        answers: list[Value] = []
        for _ in range(request.steps):
            answer = self.encode(method(x, v, request.dt, accel))
            answers.append(answer)
            if not isinstance(answer, Vec) or not all(map(math.isfinite, answer)):
                break
            x, v = map(float, answer)
        return Items(positions if request.places else answers)

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
        names = vars(self.module_with("BonusWorld", request.module))
        kind = "BonusWorld" if request.bonus and "BonusWorld" in names else "World"
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
        """Return the number of an object; a new object gets one."""
        number = self.refs.get(id(thing))
        if number is None:
            number = self.refs[id(thing)] = len(self.objects) + 1
            self.objects[number] = thing
        return number

    def number(self, ref: int, thing: Any) -> Value:
        """Give an object the number that the judge chose, and describe it."""
        self.objects[ref], self.refs[id(thing)] = thing, ref
        return self.encode(thing)

    def encode(self, thing: Any) -> Value:
        """Return an object of the submission as a plain value; of an unknown type, as a Ref.

        Raises ContractError if a body or contact lacks a field or has it in another type.
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
        """Return an object as a plain value; None if it cannot be described."""
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

    def contact_row(self, contact: Any) -> ContactRow:
        """Return a contact of the lesson's engine in short, with the limit of its friction."""
        a, b = field(contact, "a"), field(contact, "b")
        friction = field_number(a, "friction") * field_number(b, "friction")
        point, normal = field_pair(contact, "point"), field_pair(contact, "normal")
        jn = field_number(contact, "jn")
        return ContactRow(
            point.x,
            point.y,
            normal.x,
            normal.y,
            field_number(contact, "depth"),
            jn,
            field_number(contact, "jt"),
            math.sqrt(max(friction, 0.0)) * jn,
            self.ref(a),
            self.ref(b),
        )

    def space(self, space: pymunk.Space) -> SpaceValue:
        """Return the bodies and joints of a pymunk space, the static body first."""
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
        """Return a pymunk constraint; anchors in world coordinates, if it has any."""
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

    # ------------------------------------------------------------ errors

    def raised(self, error: BaseException) -> Raised:
        """Return an exception as data, with the frames of the submission alone.

        Its __str__ is the submission's: it may fail, be long, or quote anything.
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
            error.filename = error.lineno = None  # otherwise its text would repeat the line
        try:
            message = cut(str(error).replace(root + os.sep, ""), MAX_TEXT)
        except Exception:
            message = ""
        return Raised(type_name(error), message, frames[-MAX_FRAMES:])


def set_inverses(body: Any, request: MakeBody) -> None:
    """Set the inverse mass and inertia of a full disc; both 0 for a box or mass 0.

    Checks are not about the constructor. A value that is right but for rounding stays.
    """
    right = {"inv_mass": 0.0, "inv_inertia": 0.0}
    if request.mass and not isinstance(request.size, Vec):
        right = {"inv_mass": 1 / request.mass, "inv_inertia": 2 / (request.mass * request.size**2)}
    for name, value in right.items():
        own = getattr(body, name, value)
        if isinstance(own, numbers.Real) and not math.isclose(own, value, rel_tol=1e-9):
            with suppress(AttributeError):  # a property, computed each time
                setattr(body, name, value)


def polynomial(coefficients: list[float]) -> Callable[..., float]:
    """Return accel(x) for an integrator, from its coefficients, lowest power first."""

    def accel(x: float) -> float:
        total = 0.0
        for coefficient in reversed(coefficients):
            total = total * x + coefficient
        return total

    return accel


def record_positions(accel: Callable[..., float], positions: list[Value]) -> Callable[..., float]:
    """Return accel(x) that also appends the first positions at which it is called."""

    def recorded(x: float, *others: Any) -> float:
        if len(positions) < MAX_ITEMS:
            positions.append(as_number(x, "what accel is asked about"))
        return accel(x, *others)

    return recorded


def refs_in(request: Call) -> list[int]:
    """Return the numbers of the objects among a call's arguments, and of the method's object."""
    arguments = (*request.args, *request.kwargs.values())
    refs = [each.id for each in arguments if isinstance(each, Ref)]
    own = request.target[1:].partition(".")[0] if request.target.startswith("#") else ""
    return [*refs, *([int(own)] if own else [])]
