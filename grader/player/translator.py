"""Translate requests to a submission into Python, a line each."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from grader.protocol import (
    Argument,
    BodyValue,
    Call,
    ContactValue,
    Get,
    Integrate,
    Items,
    MakeBody,
    MakeWorld,
    Play,
    Ref,
    Reply,
    Request,
    Returned,
    Rng,
    Set,
    Simulate,
    SpaceBody,
    SpaceValue,
    Value,
    Vec,
)

FINDERS = ("circle_box", "circle_circle", "collide")  # what returns a Contact or None


@dataclass
class Translator:
    """Translates requests into Python and remembers the names of objects."""

    module: str
    names: dict[int, str] = field(default_factory=dict)  # by the child's number

    def translate(self, request: Request, reply: Reply) -> list[str]:
        value = reply.value if isinstance(reply, Returned) else None
        match request:
            case MakeBody():
                return self._make_body(request, value)
            case MakeWorld():
                return self._make_world(request, value)
            case Call(target, args, kwargs):
                given = [*map(self.write_argument, args)]
                given += [f"{name}={self.write_argument(each)}" for name, each in kwargs.items()]
                call = f"{self._write_target(target)}({', '.join(given)})"
                return [self._assign(value, call, target)]
            case Get(ref, name):
                return [self._assign(value, f"{self.name(ref)}.{name}")] if name else []
            case Set(ref, fields):
                return [
                    f"{self.name(ref)}.{k} = {self.write_argument(v)}" for k, v in fields.items()
                ]
            case Simulate(ref, dt, steps):
                stepping = f"{self.name(ref)}.step({write_number(dt)})"
                return [f"for _ in range({steps}):", f"    {stepping}"] if steps > 1 else [stepping]
            case Integrate():
                return self._integrate(request)
            case Play(frames=frames):
                return [f"main()  # {len(frames)} frames"]
        return []

    def _integrate(self, request: Integrate) -> list[str]:
        x, v, dt = map(write_number, (request.x, request.v, request.dt))
        accel = write_polynomial(request.force)
        step = f"x, v = {self._write_target(request.target)}(x, v, {dt}, {accel})"
        start = f"x, v = {x}, {v}"
        if request.steps == 1:
            return [start, step]
        return [start, f"for _ in range({request.steps}):", f"    {step}"]

    def forget(self) -> None:
        self.names.clear()

    # ------------------------------------------------------------ names

    def name(self, ref: int) -> str:
        return self.names.get(ref, f"object_{ref}")

    def _name_new(self, ref: int, kind: str) -> str:
        taken = set(self.names.values())
        numbered = (f"{kind}{number}" if number > 1 else kind for number in range(1, 1000))
        self.names[ref] = next(name for name in numbered if name not in taken)
        return self.names[ref]

    def _assign(self, value: Value, code: str, target: str = "") -> str:
        """Keep the result of the code under a name if it is something new."""
        match value:
            case BodyValue(ref=ref) | SpaceBody(ref=ref) if ref not in self.names:
                return f"{self._name_new(ref, 'body')} = {code}"
            case ContactValue(ref=ref) if ref not in self.names:
                return f"{self._name_new(ref, 'contact')} = {code}"
            case SpaceValue(ref=ref) if ref not in self.names:
                name = self._name_new(ref, "space")
                self._name_contents(value, name)
                return f"{name} = {code}"
            case Ref(id=ref, kind=kind) if ref not in self.names:
                name = self._name_new(ref, "rod" if "joint" in kind.lower() else "thing")
                return f"{name} = {code}"
            case Items(items) if any(isinstance(each, SpaceValue) for each in items):
                parts = [self._name_part(each) for each in items]
                return f"{', '.join(parts)} = {code}"
            case SpaceValue(ref=ref):
                self._name_contents(value, self.names[ref])
        if value is None and target.rpartition(":")[2] in FINDERS:
            return f"contact = {code}"
        return code

    def _name_part(self, value: Value) -> str:
        if not isinstance(value, SpaceValue):
            return "_"
        name = self._name_new(value.ref, "space")
        self._name_contents(value, name)
        return name

    def _name_contents(self, space: SpaceValue, name: str) -> None:
        for number, body in enumerate(space.bodies):
            place = f"list({name}.bodies)[{number - 1}]" if number else f"{name}.static_body"
            self.names.setdefault(body.ref, place)

    def _write_target(self, target: str) -> str:
        if target.startswith("#"):
            ref, _, path = target[1:].partition(".")
            return f"{self.name(int(ref))}.{path}"
        module, _, path = target.partition(":")
        return f"pymunk.{path}" if module == "pymunk" else path

    # ------------------------------------------------------------ values

    def write_argument(self, value: Argument) -> str:
        match value:
            case Vec(x, y):
                return self.write_pair(x, y)
            case Ref(id=ref):
                return self.name(ref)
            case Rng(seed):
                return f"random.Random({seed})"
        return write_number(value) if isinstance(value, float) else repr(value)

    def write_pair(self, x: float, y: float) -> str:
        pair = "pymunk.Vec2d" if self.module == "pymunk_scene" else "Vector2"
        return f"{pair}({write_number(x)}, {write_number(y)})"

    def _make_body(self, request: MakeBody, value: Value) -> list[str]:
        name = "object_0"
        if isinstance(value, BodyValue | Ref):
            ref = value.ref if isinstance(value, BodyValue) else value.id
            name = self._name_new(ref, "ball" if request.shape == "Circle" else "box")
        shape = f"{request.shape}({self.write_argument(request.size)})"
        given = [shape, self.write_argument(request.pos), write_number(request.mass)]
        given += [f"{key}={write_number(each)}" for key, each in request.kwargs.items()]
        fields = [f"{name}.{k} = {self.write_argument(v)}" for k, v in request.fields.items()]
        return [f"{name} = Body({', '.join(given)})", *fields]

    def _make_world(self, request: MakeWorld, value: Value) -> list[str]:
        made = value.kind if isinstance(value, Ref) else ""
        kind = "BonusWorld" if request.bonus and made == "BonusWorld" else "World"
        name = self._name_new(value.id, "world") if isinstance(value, Ref) else "world"
        given = [
            f"gravity={self.write_argument(request.gravity)}",
            f"linear_damping={write_number(request.linear_damping)}",
            f"angular_damping={write_number(request.angular_damping)}",
        ]
        lines = [f"{name} = {kind}({', '.join(given)})"]
        if len(request.bodies) > 2:
            bodies = ", ".join(map(self.name, request.bodies))
            lines += [f"for body in ({bodies}):", f"    {name}.add(body)"]
        else:
            lines += [f"{name}.add({self.name(ref)})" for ref in request.bodies]
        return lines + [f"{name}.joints.append({self.name(ref)})" for ref in request.joints]


def write_number(value: float) -> str:
    """Write the exact number; a step size as a fraction."""
    parts = round(1 / value) if value and abs(value) < 0.1 else 0
    if parts % 10 == 0 and parts and 1 / parts == value:
        return f"1 / {parts}"
    return repr(value)


def write_polynomial(coefficients: Sequence[float]) -> str:
    """Write the force as the judge computes it: by Horner's rule."""
    terms = list(coefficients)
    while len(terms) > 1 and not terms[-1]:
        terms.pop()
    text = repr(terms.pop()) if terms else "0.0"
    for each in reversed(terms):
        text = f"({text}) * x" if "+" in text else f"{text} * x"
        text += f" + {each!r}" if each else ""
    return f"lambda x: {text}"


# ---------------------------------------------------------------- names

KINDS = ("ball", "box", "body", "contact", "world", "rod", "space", "thing")
NAME = re.compile(rf"(?<![\w.'\"])({'|'.join(KINDS)})(\d*)\b(?![=(])")


class Names:
    """New names for what some lines make, counted from the first of them.

    A child numbers what it makes from its start on. Its last lines alone would begin with the sixth
    ball.
    """

    def __init__(self, lines: Sequence[str]) -> None:
        text = "\n".join(lines)
        self.new: dict[str, str] = {}
        counts = dict.fromkeys(KINDS, 0) | {
            kind: 1 for kind in KINDS if re.search(rf"(?<![\w.]){kind}\(", text)
        }  # a function has that name
        for found in NAME.finditer(text):
            if found[0] not in self.new:
                counts[found[1]] += 1
                number = counts[found[1]]
                self.new[found[0]] = f"{found[1]}{number if number > 1 else ''}"

    def in_code(self, text: str) -> str:
        return NAME.sub(lambda found: self.new.get(found[0], found[0]), text)


def signature_of(request: Request) -> str:
    """Return the kind of a request without its numbers and objects: runs may differ in both."""
    match request:
        case Integrate(target):
            return f"integrate {target}"
        case Call(target):
            return f"call {target.partition('.')[2] if target.startswith('#') else target}"
        case Get(name=name):
            return f"get {name}"
        case Set(fields=fields):
            return f"set {' '.join(fields)}"
    return type(request).__name__
