"""Explain Python's errors in the lesson's programs, and what to do about them.

The message, the line and the text around it are enough: nothing here runs a submission.
"""

import ast
import builtins
import math
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache, cached_property
from itertools import islice

from grader.judge.submission import handed_out, load_given
from grader.source.cut import list_names
from grader.source.definitions import list_functions, statements
from grader.source.given import given_pieces
from grader.source.regions import find_regions
from grader.source.suspects import REBOUND
from grader.text import join_words

RAISED = re.compile(r"(?P<error>\w+(?:: .*)?) \(in (?P<file>.+?), line (?P<line>\d+): ", re.DOTALL)
DEBUGGER = re.compile(r"\bbreakpoint\(|\bset_trace\(")
LONGEST, MOST_KNOWN = 80, 500  # letters of a name, and names that it is compared with
ENGINE, SCENE = "mini_engine/", "pymunk_scene.py"
NEAR = 0.5  # minimum similarity of two names for a typing error
SHAPES = ("Circle", "Box")  # classes of body.shape
FEW = 8  # attributes of a class that are listed
IN_PLACE = ("append", "sort", "extend", "reverse", "update")  # methods that return None
OLD_HANDLERS = ("add_collision_handler", "add_wildcard_collision_handler")
SPACE = (  # attributes of a pymunk.Space that the lesson uses
    *("add", "bodies", "constraints", "damping", "gravity", "iterations", "on_collision"),
    *("shapes", "static_body", "step"),
)

Match = re.Match[str]


@dataclass(frozen=True)
class Error:
    """An error, the line of a file that raised it, and the text of that file."""

    words: str
    file: str
    line: int
    text: str
    todo: str = ""  # the TODO whose check failed

    @cached_property
    def body(self) -> list[ast.stmt]:
        return statements(self.text)

    @cached_property
    def function(self) -> ast.FunctionDef | None:
        """Return the innermost function around the line."""
        around = [
            node
            for node in ast.walk(ast.Module(self.body, []))
            if isinstance(node, ast.FunctionDef)
            and node.lineno <= self.line <= (node.end_lineno or 0)
        ]
        return max(around, key=lambda node: node.lineno, default=None)

    @cached_property
    def values(self) -> dict[str, int]:
        """Return the names that the function assigns, each with the first line that does."""
        found: dict[str, int] = {}
        for node in ast.walk(self.function) if self.function else ():
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                found[node.id] = min(node.lineno, found.get(node.id, node.lineno))
        return found

    @property
    def parameters(self) -> list[str]:
        return [each.arg for each in self.function.args.args] if self.function else []

    @property
    def around(self) -> set[str]:
        """Return the names that the file defines outside its functions."""
        return list_names(self.body)

    def nodes(self) -> Iterator[ast.AST]:
        """Yield the nodes that begin in the line."""
        for node in ast.walk(self.function) if self.function else ():
            if getattr(node, "lineno", 0) == self.line:
                yield node

    def calls(self) -> Iterator[ast.Call]:
        """Yield the calls that begin in the line."""
        return (node for node in self.nodes() if isinstance(node, ast.Call))

    @property
    def targets(self) -> set[str]:
        """Return the names that the line assigns; they have no value before it."""
        names = (node for node in self.nodes() if isinstance(node, ast.Name))
        return {node.id for node in names if isinstance(node.ctx, ast.Store)}

    def reads_self(self, name: str) -> bool:
        """Return whether the line reads self.name."""
        for node in self.nodes():
            match node:
                case ast.Attribute(ast.Name("self"), attr) if attr == name:
                    return True
        return False

    def passes_result_of(self, name: str) -> bool:
        """Return whether the line passes the result of a local function as an argument."""
        body = ast.walk(self.function) if self.function else ()
        if not any(isinstance(node, ast.FunctionDef) and node.name == name for node in body):
            return False
        for call in self.calls():
            for argument in (*call.args, *(keyword.value for keyword in call.keywords)):
                match argument:
                    case ast.Call(ast.Name(called)) if called == name:
                        return True
        return False


def explain_error(got: str, read: Callable[[str], str], todo: str) -> str:
    """Return the meaning of a failed check's error; empty if it is unknown.

    `read` returns the text of a file of the submission.
    """
    found = RAISED.match(got)
    if found:
        error = Error(found["error"], found["file"], int(found["line"]), read(found["file"]), todo)
    else:  # it was raised in no file of the submission
        error = Error(got, "", 0, "", todo)
    for pattern, explain in RULES:
        if match := re.search(pattern, error.words):
            try:
                if isinstance(explain, str):
                    return explain.format(*match.groups())
                words = explain(match, error)
            except (RecursionError, MemoryError):  # the code is nested too deeply
                return ""
            if words:
                return words
    return ""


def find_similar(name: str, known: Iterable[str], least: float = 0.7) -> list[str]:
    """Return the known name that is most similar, if one is similar enough."""
    return get_close_matches(name[:LONGEST], islice(known, MOST_KNOWN), 1, least)


# ---------------------------------------------------------------- names


def explain_unbound(match: Match, error: Error) -> str:
    name = match[1]
    first = error.values.get(name, error.line)
    if name in error.around or hasattr(builtins, name):
        return (
            f"Line {first} gives {name} a value. That makes it a variable of this function, which "
            f"hides the {name} from outside: use another name."
        )
    if first >= error.line:
        arguments = show_arguments(error)
        return f"{name} has no value before line {error.line}: give it one first.{arguments}"
    return (
        f"{name} has no value here: line {first}, which gives it one, did not run. Give it one "
        "above that as well."
    )


def explain_debugger(match: Match, error: Error) -> str:
    lines = error.text.splitlines()[: error.line]
    last = next((n for n in range(len(lines), 0, -1) if DEBUGGER.search(lines[n - 1])), 0)
    there = f" in line {last}" if last else ""
    return (
        f"The debugger{there} waits for a command, and a check gives none: remove breakpoint() "
        "first. It works in the program that `Run it` starts."
    )


def explain_undefined(match: Match, error: Error) -> str:
    name = match[1]
    if name in stub_names(error.todo):
        return f"The lines below the region use {name}: the region must give it a value."
    if error.parameters[:1] == ["self"] and name in own_attributes(error):
        return f"{name} belongs to the object: write self.{name}."
    if hasattr(math, name):
        return f"{name} is in the module math: write math.{name}."
    if name in PYMUNK_NAMES:
        return IN_PYMUNK.format(name)
    if error.file.startswith(ENGINE) and (file := given_home(name, error.file)):
        module = file.rpartition("/")[2].removesuffix(".py")
        return f"{name} is in {file}: add `from .{module} import {name}` to {error.file}."
    if name in SPACE and "space" in error.parameters:
        return f"{name} belongs to the space: write space.{name}."
    if name in MODULES:
        return f"{name} is a module: add `{MODULES[name]}` to {error.file}."
    if name in HOMES:
        return f"{name} is in the module {HOMES[name]}: add `from {HOMES[name]} import {name}`."
    if error.file == SCENE and (file := given_home(name, "")):
        return f"{name} is in {file}, the mini engine: {SCENE} uses pymunk instead."
    known = {*error.values, *error.parameters, *error.around} - error.targets
    near = find_similar(name, sorted(known))
    if near:
        return f"Nothing is called {name} here. Is {near[0]} meant?"
    arguments = show_arguments(error)
    return f"Nothing is called {name} here: is it misspelt, or not defined?{arguments}"


def show_arguments(error: Error) -> str:
    """Return a sentence with the function's parameters, and a space before it."""
    return f" The function is given {', '.join(error.parameters)}." * bool(error.parameters)


def explain_module(match: Match, error: Error) -> str:
    module, name = match.groups()
    if module == "pygame" and (key := re.fullmatch(r"K_(SHIFT|CTRL|ALT|META)", name)):
        left, right, both = f"K_L{key[1]}", f"K_R{key[1]}", f"KMOD_{key[1]}"
        return (
            f"pygame has no {name}: it has {left} and {right}, and get_mods() & {both} is for both."
        )
    known = {"math": dir(math), "pygame": PYGAME}.get(module, PYMUNK_NAMES)
    near = find_similar(name.replace("disc", "circle"), known, NEAR)
    return f"{module} has no {name}." + (f" Is {near[0]} meant?" if near else "")


def explain_field(match: Match, error: Error) -> str:
    arguments = given_arguments().get(f"{match[1]}.__init__")
    return f"It is {match[1]}({', '.join(arguments)}): look at {match[2]}." if arguments else ""


def explain_attribute(match: Match, error: Error) -> str:
    kind, name = match[1].rpartition(".")[2], match[2]
    if kind in ("tuple", "list"):
        if name == "_body":
            return "pymunk.PinJoint takes two bodies first, and then the anchor on each."
        return f"A {kind} of two numbers has no {name}. A vector has: write Vector2(x, y)."
    if kind in ("int", "float"):
        for node in error.nodes():
            match node:
                case ast.Attribute(ast.Name(id=thing), attr) if (
                    attr == name and thing in error.values and thing in error.parameters
                ):
                    return REBOUND.format(line=error.values[thing], name=thing)
        if name == "clamp":
            return f"A number has no clamp: {CLAMP}."
        return f"What stands before .{name} is a number, not a vector or a body."
    if kind.endswith("Vector2") and name == "clamp":
        return f"A vector has no clamp: {CLAMP}, of x and y apart."
    if kind == "Space" and name in OLD_HANDLERS:
        return f"pymunk 7 has no {name}: write space.on_collision(BALL, PEG, begin=begin)."
    if name in error.values and error.reads_self(name):
        return f"{name} is a variable here: write {name}, without self."
    home = next((owner for owner, names in given_attributes().items() if name in names), "")
    if kind == "Body" and home in SHAPES:
        return f"{name} belongs to the body's shape: write .shape.{name}."
    if kind == "Body" and name in ("x", "y"):
        return f"A Body has no {name}: write .pos.{name}, or .vel.{name}."
    if given_home(name, ""):
        return f"{name} is a function, not part of a {kind}: write {name}(...)."
    known = SPACE if kind == "Space" else sorted(given_attributes().get(kind, ()))
    starts = [each for each in known if each.startswith(name) or name.startswith(each)]
    near = starts or find_similar(name, known, NEAR)
    if near:
        return f"A {kind} has no {name}. Is {near[0]} meant?"
    if home:
        return f"{name} belongs to a {home}, not to a {kind}."
    fields = [each for each in known if not each.startswith("_")]
    return f"A {kind} has no {name}. It has {join_words(fields)}." if 0 < len(fields) <= FEW else ""


def explain_not_callable(match: Match, error: Error) -> str:
    """Explain brackets after a value, which may have replaced a function of the same name."""
    for call in error.calls():
        called = ast.unparse(call.func)
        if isinstance(call.func, ast.Name) and called in error.values:
            return (
                f"Line {error.values[called]} gives {called} a value, so {called} is no function "
                "here any more: use another name for the value."
            )
        if isinstance(call.func, ast.Attribute) and match[1].rpartition(".")[2] != "function":
            return (
                f"{called} is a value and no function: leave out the brackets behind it, or give "
                "it a new value with =."
            )
    return "A value stands before brackets as if it were a function. Is a * missing there?"


def explain_zero(match: Match, error: Error) -> str:
    """Explain a division by a 0 that the TODO gave to code outside its region."""
    region = find_regions(error.text).get(error.todo)
    if region is not None and region.start < error.line - 1 < region.stop:
        return ""  # wrong answers show more
    for node in error.nodes():
        match node:
            case ast.AugAssign(op=ast.Div(), value=ast.Name(name)):
                return f"{name} is 0 there: line {error.line} divides by it."
    return ""


def explain_key(match: Match, error: Error) -> str:
    """Explain a missing dictionary key by the way the line uses the key's value."""
    for node in error.nodes():
        match node:
            case ast.Attribute(ast.Subscript(ast.Name(name)), "append" | "add" | "extend"):
                return (
                    f"{name} has no list for this key yet: {name}.setdefault(key, []) begins one "
                    "and returns it."
                )
            case ast.Subscript(ast.Name(name), ctx=ast.Load()):
                return f"{name} has no such key: {name}.get(key, []) is empty there, with no error."
    return "The dictionary has no such key: ask `if key in ...` first."


def explain_arguments(match: Match, error: Error) -> str:
    """Show a function that was called with too few or too many arguments."""
    owner, _, name = match[1].rpartition(".")
    called = owner.rpartition(".")[2] if name == "__init__" else name
    is_lessons = f"{called}.__init__" in given_arguments() and error.file != SCENE
    if called in PYMUNK and not is_lessons:
        return f"It is {PYMUNK[called]}."
    if error.passes_result_of(name):
        return f"{name}() calls it at once: hand over {name}, without brackets."
    usual = None if name == "__init__" else given_arguments().get(name)
    arguments = given_arguments().get(f"{owner}.{name}", usual)
    return f"It is {called}({', '.join(arguments)})." if arguments is not None else ""


def explain_none(match: Match, error: Error) -> str:
    """Name a method whose result is used, though it returns None and works in place."""
    for node in ast.walk(error.function) if error.function else ():
        match node:
            case ast.Assign(value=ast.Call(func=ast.Attribute(attr=name))) if (
                name.endswith("_ip") or name in IN_PLACE
            ):
                instead = f": use {name.removesuffix('_ip')}()" if name.endswith("_ip") else ""
                return f"{name}() changes the thing before the dot and returns None{instead}."
    return NONE_BEFORE_DOT if "before" in match.re.groupindex else NONE_AMONG


def explain_not_iterable(match: Match, error: Error) -> str:
    for call in error.calls():
        name = ast.unparse(call.func)
        if name in ("min", "max") and len(call.args) == 1:
            return f"{name}() gets one number here and needs two: is a bracket in the wrong place?"
    return ""


def explain_tuple(match: Match, error: Error) -> str:
    return TUPLE if "Vector2" in error.text else NUMBERS


def explain_pair(match: Match, error: Error) -> str:
    """Explain an error of pymunk, which needs two numbers and got something else."""
    if "cpVect" in match[0]:
        return "pymunk does not accept a Vector2 here: write the two numbers as a pair, (x, y)."
    lines = error.text.splitlines()
    for call in error.calls():
        for joint in (call, *call.args):
            match joint:
                case ast.Call(ast.Attribute(attr="PinJoint"), [ast.Name(a), ast.Name(b), *_]) if (
                    a == b
                ):
                    return f"Both ends are {a}: the first body is space.static_body."
    line = "".join(lines[error.line - 1 : error.line]) if error.line else ""
    target = line.partition("=")[0].strip()
    return f"{target} needs two numbers, (x, y)." if target.endswith(".gravity") else ""


# ---------------------------------------------------------------- given code


@cache
def stub_names(todo: str) -> frozenset[str]:
    """Return the variables that the stub of a TODO sets, for the lines below it."""
    body = statements("\n".join(map(str.strip, handed_out().stubs.get(todo, "").splitlines())))
    return frozenset(list_names(body))


def own_attributes(error: Error) -> set[str]:
    """Return the attributes and methods of the class around the line."""
    for node in error.body:
        if isinstance(node, ast.ClassDef) and node.lineno <= error.line <= (node.end_lineno or 0):
            return attributes_of(node)
    return set()


def attributes_of(node: ast.ClassDef) -> set[str]:
    found = list_names(node.body)
    for each in ast.walk(node):
        match each:
            case ast.Attribute(value=ast.Name(id="self"), attr=name, ctx=ast.Store()):
                found.add(name)
    return found


@cache
def given_attributes() -> dict[str, set[str]]:
    """Return the attributes of each handed-out class."""
    return {
        node.name: attributes_of(node)
        for text in load_given().values()
        for node in statements(text)
        if isinstance(node, ast.ClassDef)
    }


@cache
def given_arguments() -> dict[str, list[str]]:
    """Return the arguments of each handed-out function and method, by name and by class."""
    found: dict[str, list[str]] = {}
    for text in load_given().values():
        for path, node in list_functions(statements(text)):
            names = [arg.arg for arg in node.args.args if arg.arg != "self"]
            found.setdefault(node.name, names)
            found.setdefault(path, names)
    return found


def given_home(name: str, but: str) -> str:
    """Return the engine's file that defines this name, unless that is the file `but`."""
    for file, text in load_given().items():
        if file != but and file.startswith(ENGINE) and name in given_pieces(text):
            return "" if given_pieces(text)[name].owner else file
    return ""


PYMUNK = {  # functions and classes that the lesson calls, with their arguments
    "moment_for_circle": "moment_for_circle(mass, inner_radius, outer_radius)",
    "moment_for_box": "moment_for_box(mass, size)",
    "PinJoint": "PinJoint(a, b, anchor_a, anchor_b)",
    "Body": "Body(mass, moment)",
}
PYMUNK_NAMES = (*PYMUNK, "Circle", "Poly", "Space", "Vec2d")
PYGAME = ("K_LSHIFT", "K_RSHIFT", "KMOD_SHIFT", "KMOD_CTRL", "Vector2", "key", "event", "math")
MODULES = {  # modules that a submission may import, and how
    **{n: f"import {n}" for n in ("collections", "functools", "itertools", "math", "random")},
    **{n: f"import {n}" for n in ("numpy", "pygame", "pymunk")},
    "np": "import numpy as np",
}
HOMES = {  # functions and classes that students use, with their modules
    **dict.fromkeys(("combinations", "product", "pairwise", "permutations"), "itertools"),
    **dict.fromkeys(("defaultdict", "Counter", "deque"), "collections"),
    "Vector2": "pygame",
    "partial": "functools",
}


# ---------------------------------------------------------------- the errors

TUPLE = "A tuple (x, y) is no vector and cannot be computed with: write Vector2(x, y)."
NUMBERS = "A tuple cannot be computed with: compute with each of its numbers."
NONE_BEFORE_DOT = "The value before the dot is None: a function without return returns None."
NONE_AMONG = "There is a None among the values: a function without return returns None."
IN_PYMUNK = "{0} is in the module pymunk: write pymunk.{0}."
PARTS = "The parts of this vector cannot be changed: give the whole a new pair, (x, y)."
CLAMP = "write max(low, min(number, high))"

# A text may name the groups of its pattern.
RULES: tuple[tuple[str, str | Callable[[Match, Error], str]], ...] = (
    (r"^EOFError", "input() waits for a line, and a check types none: use the arguments."),
    (r"^(\w+)\.(\w+) is of type \w+; expected", explain_field),
    (r"^ImportError: .*partially initialized", "Two files import each other: drop one import."),
    (
        r"^ImportError: cannot import name '(\w+)' from '[\w.]+' \((.+?)\)",
        "{1} defines no {0}: it was renamed or removed there.",
    ),
    (r"^BdbQuit", explain_debugger),
    (r"^SystemExit", "This ends the whole program. A function ends with return."),
    (r"^RecursionError", "A function calls itself, without an end."),
    (
        r"^TypeError: .*'(function|method|builtin_function_or_method)'",
        "A function's name without brackets is the function itself, not what it returns: call it.",
    ),
    (r"^UnboundLocalError: .*variable '(\w+)'", explain_unbound),
    (r"^NameError: name '(\w+)'", explain_undefined),
    (r"^(?P<before>AttributeError): 'NoneType'", explain_none),
    (
        r"^AttributeError: 'dict_keys' object has no attribute 'append'",
        "The lists of a space are only to be read: write space.add(...).",
    ),
    (r"^AttributeError: '([\w.]+)' object has no attribute '(\w+)'", explain_attribute),
    (r"^AttributeError: module '(math|pymunk|pygame)' has no attribute '(\w+)'", explain_module),
    (rf"^AttributeError: type object .* has no attribute '({'|'.join(PYMUNK_NAMES)})'", IN_PYMUNK),
    (r"^AttributeError: can't set attribute", PARTS),
    (
        r"^Exception: Unsupported type",
        "space.add is for bodies, shapes and joints. A setting gets its value with =.",
    ),
    (r"^TypeError: 'Vec2d' object does not support item assignment", PARTS),
    (r"^TypeError: '([\w.]+)' object is not callable", explain_not_callable),
    (r"^TypeError: .*(NoneType|\bNone\b)", explain_none),
    (r"^TypeError: '(float|int)' object is not iterable", explain_not_iterable),
    (r"^TypeError: ([\w.<>]+)\(\) (missing|takes|got)", explain_arguments),
    (r"^KeyError", explain_key),
    (r"^ZeroDivisionError", explain_zero),
    (r"^(TypeError: .*(has no len|cpVect.*Vector2)|AssertionError)", explain_pair),
    (
        r"^TypeError: 'float' object cannot be interpreted as an integer",
        "A whole number is needed here, and // of two floats is a float: put int(...) around it.",
    ),
    (r"^TypeError: (can't multiply sequence|can only concatenate tuple)", explain_tuple),
    (r"^TypeError: unsupported operand type.*'(tuple|list)'", explain_tuple),
    (r"^TypeError: unsupported operand type\(s\) for \^", "^ is no power in Python: write **."),
    (r"^AssertionError: .*already added", "The space has this already: add each thing once."),
    (
        r"^TypeError: .*for \*\*.*Vector2'",
        "A vector has no power: square a number, such as a length or a cross product.",
    ),
    (
        r"^TypeError: .*Vector2' and '(float|int)'",
        "A vector and a number cannot be added or compared: multiply the number by a vector that "
        "gives it a direction, or take a coordinate or a length.",
    ),
    (
        r"^TypeError: .*'(float|int)' and 'pygame.math.Vector2'",
        "A number and a vector do not go together here: a number is needed, which is a coordinate, "
        "a length or a dot product.",
    ),
    (
        r"^TypeError: This operation is not supported by vectors",
        "Vectors have no < and no >. Where min, max or sorted find two equal first numbers they go "
        "on to what stands behind: compare numbers alone, key=lambda each: each[0].",
    ),
    (
        r"^ValueError: Can't normalize",
        "A vector of length 0 has no direction: treat that case before this line.",
    ),
)
