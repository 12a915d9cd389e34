"""Translate requests into Python: lines for the replay, and a script that a student can run."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby

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
    cut,
)
from grader.text import printable

MAX_COMMENT = 288  # characters
FINDERS = ("circle_box", "circle_circle", "collide")  # return a Contact or None
MANY = 4  # equal lines that become a loop
STATE = ("pos", "vel", "angle", "omega")
PARTS = {  # modules of names that a package without a BonusWorld does not export
    "mini_engine:between": "mini_engine.game_loop",
    "mini_engine:wake": "mini_engine.sleeping",
}

Exchange = tuple[Request, Reply]


@dataclass
class Step:
    """One request and its code in Python."""

    request: Request
    code: list[str]
    silent: bool  # nothing came back
    recalled: list[str] = field(default_factory=list)  # code that makes objects of earlier scenes
    watched: list[str] = field(default_factory=list)  # names of the bodies that it reads
    paced: bool = False  # a program whose advance() runs all steps


@dataclass
class Translator:
    """Translates requests into Python and gives new names to objects in each scene."""

    module: str
    names: dict[int, str] = field(default_factory=dict)  # by the child's number
    makers: dict[int, list[Exchange]] = field(default_factory=dict)  # made and set up each object
    imports: set[tuple[str, str]] = field(default_factory=set)
    libraries: set[str] = field(default_factory=set)
    parts: dict[str, str] = field(default_factory=dict)  # modules of names without a BonusWorld
    recalled: list[str] = field(default_factory=list)  # see Step

    def begin_scene(self) -> None:
        self.names.clear()

    def begin_child(self) -> None:
        """Forget all objects: a new child numbers its own."""
        self.names.clear()
        self.makers.clear()

    def translate(self, request: Request, reply: Reply) -> list[str]:
        """Return a request's code; set `recalled` to code that must come before it."""
        self.recalled = []
        code = self._translate(request, reply)
        made = list_refs(reply.value) if isinstance(reply, Returned) else []
        for ref in made:
            self.makers.setdefault(ref, [(request, reply)])
        if isinstance(request, Set) and request.ref in self.makers:
            maker, *settings = self.makers[request.ref]
            settings = [each for each in settings if not overrides(request, each[0])]
            self.makers[request.ref] = [maker, *settings, (request, reply)]
        return code

    def _translate(self, request: Request, reply: Reply) -> list[str]:
        value = reply.value if isinstance(reply, Returned) else None
        match request:
            case MakeBody():
                return self._make_body(request, value)
            case MakeWorld():
                return self._make_world(request, value)
            case Call(target, args, kwargs):
                function = self._write_target(target)
                given = [*map(self.write_argument, args)]
                given += [f"{name}={self.write_argument(each)}" for name, each in kwargs.items()]
                return [self._assign(value, f"{function}({', '.join(given)})", target)]
            case Get(ref, name):
                code = f"{self.name(ref)}.{name}"
                for number, each in enumerate(value.items if isinstance(value, Items) else ()):
                    for part in list_refs(each):
                        self.names.setdefault(part, f"{code}[{number}]")
                return [self._assign(value, code)] if name else []
            case Set(ref, fields):
                return self._set_fields(self.name(ref), fields)
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

    def _set_fields(self, name: str, fields: Mapping[str, Argument]) -> list[str]:
        return [f"{name}.{key} = {self.write_argument(each)}" for key, each in fields.items()]

    def watched_names(self, request: Request) -> list[str]:
        """Return the names of the bodies, or of the space, whose state a request reads."""
        match request:
            case Get(ref, ""):
                return [self.name(ref)]
            case Simulate(watch=watch):
                return [self.name(ref) for ref in watch]
        return []

    # ------------------------------------------------------------ names

    def name(self, ref: int) -> str:
        """Return the name of an object; make objects of earlier scenes again."""
        if ref not in self.names and ref in self.makers:
            exchanges = self.makers.pop(ref)  # so that it cannot ask for itself
            for request, reply in exchanges:
                self.recalled += self._translate(request, reply)
            self.makers[ref] = exchanges
        return self.names.get(ref, f"object_{ref}")

    def _name_new(self, ref: int, kind: str) -> str:
        taken = {*self.names.values(), *(name for _, name in self.imports)}
        numbered = (f"{kind}{number}" if number > 1 else kind for number in range(1, 1000))
        self.names[ref] = next(name for name in numbered if name not in taken)
        return self.names[ref]

    def _assign(self, value: Value, code: str, target: str = "") -> str:
        """Return code that names its result if that is a new object."""
        match value:
            case None if target.rpartition(":")[2] in FINDERS:
                name = "contact"
            case Items(items) if any(isinstance(each, SpaceValue) for each in items):
                name = ", ".join(
                    (isinstance(each, SpaceValue) and self._name_value(each)) or "_"
                    for each in items
                )
            case _:
                name = self._name_value(value)
        return f"{name} = {code}" if name else code

    def _name_value(self, value: Value) -> str:
        """Name an object, and the bodies in a space; return the name if it is new."""
        match value:
            case BodyValue(ref=ref) | SpaceBody(ref=ref):
                kind = "body"
            case ContactValue(ref=ref):
                kind = "contact"
            case SpaceValue(ref=ref):
                kind = "space"
            case Ref(id=ref, kind=type_name):
                kind = "rod" if "joint" in type_name.lower() else "thing"
            case _:
                return ""
        is_new = ref not in self.names
        name = self._name_new(ref, kind) if is_new else self.names[ref]
        for number, body in enumerate(value.bodies if isinstance(value, SpaceValue) else ()):
            place = f"list({name}.bodies)[{number - 1}]" if number else f"{name}.static_body"
            self.names.setdefault(body.ref, place)
        return name if is_new else ""

    def _write_target(self, target: str) -> str:
        if target.startswith("#"):
            ref, _, path = target[1:].partition(".")
            return f"{self.name(int(ref))}.{path}"
        module, _, path = target.partition(":")
        if module == "pymunk":
            self.libraries.add(module)
            return f"pymunk.{path}"
        self.imports.add((self.parts.get(target, module), path.partition(".")[0]))
        return path

    # ------------------------------------------------------------ values

    def write_argument(self, value: Argument) -> str:
        match value:
            case Vec(x, y):
                return self.write_pair(x, y)
            case Ref(id=ref):
                return self.name(ref)
            case Rng(seed):
                self.libraries.add("random")
                return f"random.Random({seed})"
        return write_number(value) if isinstance(value, float) else repr(value)

    def write_pair(self, x: float, y: float) -> str:
        if self.module == "pymunk_scene":
            self.libraries.add("pymunk")
            return f"pymunk.Vec2d({write_number(x)}, {write_number(y)})"
        self.imports.add(("pygame", "Vector2"))
        return f"Vector2({write_number(x)}, {write_number(y)})"

    def _make_body(self, request: MakeBody, value: Value) -> list[str]:
        self.imports |= {(request.module, "Body"), (request.module, request.shape)}
        name = "object_0"
        if isinstance(value, BodyValue | Ref):
            ref = value.ref if isinstance(value, BodyValue) else value.id
            name = self._name_new(ref, "ball" if request.shape == "Circle" else "box")
        shape = f"{request.shape}({self.write_argument(request.size)})"
        given = [shape, self.write_argument(request.pos), write_number(request.mass)]
        given += [f"{key}={write_number(each)}" for key, each in request.kwargs.items()]
        fields = self._set_fields(name, request.fields)
        return [f"{name} = Body({', '.join(given)})", *fields]

    def _make_world(self, request: MakeWorld, value: Value) -> list[str]:
        made = value.kind if isinstance(value, Ref) else ""
        kind = "BonusWorld" if request.bonus and made == "BonusWorld" else "World"
        if request.bonus and kind == "World":
            self.parts = PARTS
        self.imports.add((request.module, kind))
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


def overrides(later: Set, earlier: Request) -> bool:
    """Return whether `later` sets all the fields that `earlier` has set."""
    return isinstance(earlier, Set) and earlier.fields.keys() <= later.fields.keys()


def list_refs(value: Value) -> list[int]:
    """Return the numbers of all objects in an answer."""
    match value:
        case Ref(id=ref) | BodyValue(ref=ref) | ContactValue(ref=ref) | SpaceBody(ref=ref):
            return [ref]
        case SpaceValue(ref=ref, bodies=bodies):
            return [ref, *(body.ref for body in bodies)]
        case Items(items):
            return [ref for each in items for ref in list_refs(each)]
    return []


def write_number(value: float) -> str:
    """Write the exact number, a step size as a fraction."""
    parts = round(1 / value) if value and abs(value) < 0.1 else 0
    if parts % 10 == 0 and parts and 1 / parts == value:
        return f"1 / {parts}"
    return repr(value)


def write_polynomial(coefficients: Sequence[float]) -> str:
    """Write a polynomial of x by Horner's rule, as the worker computes it."""
    terms = list(coefficients)
    while len(terms) > 1 and not terms[-1]:
        terms.pop()
    text = repr(terms.pop()) if terms else "0.0"
    for each in reversed(terms):
        text = f"({text}) * x" if "+" in text else f"{text} * x"
        text += f" + {each!r}" if each else ""
    return f"lambda x: {text}"


# ---------------------------------------------------------------- the whole script


def write_script(
    title: str,
    translator: Translator,
    steps: Sequence[Step],
    words: Sequence[str],
) -> str:
    """Write a script with the same calls; `words` become comments at its end."""
    plays = [(each.request, each.paced) for each in steps if isinstance(each.request, Play)]
    if plays:
        imports, body = write_play(translator.module, *plays[-1])
    else:
        body = list(fold_repeats(write_calls(end_with_answer(steps))))
        imports = list(write_imports(translator, "\n".join(body)))
    comments = [f"# {write_comment(each)}" for each in words if each]
    head = [f"# {write_comment(title)}", "# Run it in the folder of your own files.", "import sys"]
    begin = ['sys.path.insert(0, "")  # your own files come first', ""]
    return "\n".join([*head, *begin, *imports, "", *body, *comments, ""])


def end_with_answer(steps: Sequence[Step]) -> Sequence[Step]:
    """Leave out changes that a check made after its last answer, which it judged."""
    last = len(steps)
    while last and isinstance(steps[last - 1].request, Set) and steps[last - 1].silent:
        last -= 1
    return steps[:last]


def write_imports(translator: Translator, body: str) -> Iterator[str]:
    """Yield the imports that the body uses, libraries first."""
    for library in sorted(translator.libraries, reverse=True):  # random before pymunk
        if f"{library}." in body:
            yield f"import {library}"
    sources = {source for source, _ in translator.imports}
    for source in sorted(sources, key=lambda each: (each != "pygame", each)):
        names = sorted(name for each, name in translator.imports if each == source)
        used = [name for name in names if re.search(rf"\b{name}\b", body)]
        if used:
            yield f"from {source} import {', '.join(used)}"


def write_comment(text: str) -> str:
    """Return a text of a submission on one line."""
    return cut(printable(text), MAX_COMMENT)


def write_calls(steps: Sequence[Step]) -> Iterator[str]:
    """Yield the script's lines, with a `print` for each answer."""
    for step in steps:
        yield from step.recalled
        for line in step.code:
            assigned = re.match(r"[\w, ]+ = ", line)
            answers = isinstance(step.request, Call | Get) and not assigned
            is_shown = answers and (step is steps[-1] or not step.silent)
            yield f"print({print_form(line)})" if is_shown else line
        if isinstance(step.request, Integrate):
            yield "print(x, v)"
    yield from print_last_state(steps)


def fold_repeats(lines: Iterable[str]) -> Iterator[str]:
    """Turn equal lines in a row into a loop."""
    for line, group in groupby(lines):
        count = len(list(group))
        if count < MANY or line.startswith(" "):
            yield from [line] * count
        else:
            yield from (f"for _ in range({count}):", f"    {line}")


def print_form(code: str) -> str:
    if code.endswith(".find_contacts()"):
        return f"[(each.normal, each.depth, each.point) for each in {code}]"
    return code


def signature_of(request: Request) -> str:
    """Describe a request without numbers and objects, since these may differ between runs."""
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


def print_last_state(steps: Sequence[Step]) -> Iterator[str]:
    """Yield code that prints the last answers of the check."""
    last = next((step for step in reversed(steps) if step.code), None)
    if last is None:
        return
    code = last.code[-1].strip()
    if isinstance(last.request, Call) and code.startswith("contact"):
        name = code.partition(" ")[0]
        yield f"print({name} and ({name}.normal, {name}.depth, {name}.point))"
    elif isinstance(last.request, Call) and code.startswith("space"):
        yield "print(space.gravity, [(type(each), each.a, each.b) for each in space.constraints])"
    elif isinstance(last.request, Simulate) and last.request.contacts:
        world = code.partition(".")[0]
        yield f"print([(each.jn, each.jt) for each in {world}.contacts])"
    for name in dict.fromkeys(name for step in steps[steps.index(last) :] for name in step.watched):
        if name.startswith("space") and name.isidentifier():
            yield f"print([(each.mass, each.moment) for each in {name}.bodies])"
            continue
        pymunk = name.startswith(("body", "list(")) or name.endswith(".static_body")
        fields = ("position", "velocity", "angle", "angular_velocity") if pymunk else STATE
        yield f"print({', '.join(f'{name}.{each}' for each in fields)})"


def write_play(module: str, play: Play, paced: bool) -> tuple[list[str], list[str]]:
    """Write the imports and code for a program; clicks and keys become a comment."""
    if play.events or play.pictures or not paced:
        person = [
            f"{each.kind} {each.pos}{f' with {each.held}' if each.held else ''}"
            for each in play.events[:2]
        ]
        frames = f"frames of {', '.join(map(str, play.frames[:12]))} ms and so on"
        return [f"from {module} import main"], [f"main()  # {', '.join([*person, frames])}"]
    scene = "make_world(random.Random(12))"
    look = "    print(body.pos, body.vel, body.angle)"
    if module == "pymunk_scene":
        scene, look = "make_space(random.Random(12))[0]", look.replace("pos", "position")
        look = look.replace("vel", "velocity")
    count = "    print(milliseconds, 'ms:', steps, 'steps, left over:', accumulator, 's')"
    imports = ["import random", f"from {module} import advance, {scene.partition('(')[0]}"]
    same = len(set(play.frames)) == 1
    frames = f"[{play.frames[0]}] * {len(play.frames)}" if same else repr(play.frames)
    return imports, [
        f"world, accumulator = {scene}, 0.0",
        f"for milliseconds in {frames}:",
        "    accumulator, steps = advance(world, accumulator, milliseconds / 1000)",
        *(["for body in world.bodies:", look] if play.trail_every else [count]),
    ]
