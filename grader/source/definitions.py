"""Find the function that Python would run, from a submission's source text.

A folder often holds other files too: a copy of the starter, a second try, notes. So the search
follows imports from the program's module to the definition.

A text may be written to cost much time and memory. So one file is parsed at a time, and no tree is
kept; outlines of small files are kept for the next grade. Sizes of files are limited, each and in
sum. A name is looked up once in each module. Names that are too long, or have too many aliases,
count as unknown.
"""

import ast
import textwrap
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from heapq import merge
from pathlib import Path, PurePath
from typing import TypeVar

from grader.source.flaws import find_misplaced
from grader.source.regions import parse

MAX_KEPT = 16 * 1024  # characters of a file whose outline is kept
MAX_READ = 1024 * 1024  # characters of a submission that are parsed, in all
MAX_CALLED = 200  # names followed from a function
MAX_HOPS = 50  # from module to module, or from alias to alias; real names need three
MAX_TRIED = 2000  # bindings that one search may try; usual ones try ten
MAX_NAME = 1000  # characters of a dotted name; real ones have twenty


@dataclass(frozen=True, slots=True)
class Function:
    """A function in a file."""

    name: str
    lineno: int
    end_lineno: int
    parameters: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Definition:
    """The module that defines a name, and its function there, if the module can be read."""

    module: str
    function: Function | None


@dataclass(frozen=True, slots=True)
class Alias:
    """Another name of something, as in `step = world_step` or `World.step = step`."""

    target: str
    path: str


@dataclass(frozen=True, slots=True)
class Class:
    members: dict[str, Function | Alias]
    bases: list[str]


@dataclass(frozen=True, slots=True)
class Imported:
    """A name of another module, `*` for all of its names; empty for the module itself."""

    module: str
    name: str = ""


Binding = Function | Class | Alias | Imported
Try = TypeVar("Try")


@dataclass(frozen=True)
class Module:
    """The outline of a module: the bindings of its names, and its imports."""

    empty: bool = True  # without statements, or not Python
    refused: bool = False  # it may not be Python, or have misplaced statements
    names: dict[str, list[tuple[int, Binding]]] = field(default_factory=lambda: defaultdict(list))
    stars: list[tuple[int, Binding]] = field(default_factory=list)
    imports: list[str] = field(default_factory=list)  # dotted names, of modules or in them

    def bindings(self, path: str, first: str) -> Iterator[Binding]:
        """Yield the bindings that may define this dotted name, the latest first."""
        lists = [self.names.get(first, []), self.stars]
        if path != first:
            lists.append(self.names.get(path, []))
        backwards = (reversed(each) for each in lists)  # each is in the order of the text
        yield from (each for _, each in merge(*backwards, key=lambda each: -each[0]))


class Program:
    """The modules of a submission, and the definitions of their names.

    A file is parsed when a name leads to it. `unread` are files that were needed after the limit
    was reached.
    """

    def __init__(self, texts: Mapping[Path, str]) -> None:
        """Take the text of each file, by its path inside the submission's folder."""
        self.texts = texts
        self.paths: dict[str, Path] = {}  # by the dotted name of a module
        for path in sorted(texts, key=lambda each: each.name != "__init__.py"):
            self.paths.setdefault(name_module(path), path)  # a package hides a file of its name
        self.depth = max((name.count(".") + 1 for name in self.paths), default=0)
        self.modules: dict[str, Module] = {}  # that were needed
        self.unread: list[Path] = []
        self.read = 0  # characters that were parsed
        self.found: dict[tuple[str, str], Definition | None] = {}  # by one search
        self.tried = 0  # bindings, by one search
        self.parts: dict[str, list[str]] = {}  # modules that an import loads, by its name

    def tree(self, module: str) -> list[ast.stmt]:
        """Return the statements of a module; none if it is not Python."""
        return statements(self.texts[self.paths[module]])

    def source(self, module: str, function: Function) -> str:
        """Return the lines of a function of a module, moved to the left edge."""
        return source_of(self.texts[self.paths[module]], function)

    def definition(self, module: str, path: str) -> Definition | None:
        """Find the definition of `name` or `Class.name` in `module`."""
        self.found, self.tried = {}, 0
        found = self._bound(module, path)
        if found is not None and found.function is not None:
            return found
        # A package may not import the name itself: search all parts that it loads.
        others = (self._bound(each, path) for each in self.list_loaded(module))
        return next((each for each in others if each and each.function), found)

    def list_loaded(self, module: str) -> list[str]:
        """Return the names of the submission's modules that importing `module` loads."""
        if module not in self.parts:
            seen: set[str] = set()
            waiting = [module]
            while waiting:
                name = waiting.pop()
                if name in self.paths and name not in seen:
                    seen.add(name)
                    waiting += self._known(self._module(name).imports)
            self.parts[module] = sorted(seen)
        return self.parts[module]

    def list_files(self, programs: Iterable[str]) -> list[Path]:
        """Return the files that these programs load, each started as `python -m` does."""
        started = (name for each in programs for name in (each, f"{each}.__main__"))
        parts = dict.fromkeys(part for name in started for part in self.list_loaded(name))
        return [self.paths[part] for part in parts]

    def names_used(self, module: str, path: str) -> set[str]:
        """Return the names in a function and in the functions that it calls."""
        found: set[str] = set()
        seen: set[tuple[str, str]] = set()
        read: set[Definition] = set()  # a function may have many names
        waiting = [(module, path)]
        while waiting and len(seen) < MAX_CALLED:
            asked = waiting.pop()
            seen.add(asked)
            defined = self.definition(*asked)
            if defined is None or defined.function is None:
                continue
            found.add(asked[1].rpartition(".")[2])
            if defined in read:
                continue
            read.add(defined)
            owner = asked[1].rpartition(".")[0]
            for node in ast.walk(
                ast.Module(statements(self.source(defined.module, defined.function)), [])
            ):
                match node:
                    case ast.Name(id=name):
                        called = defined.module, name
                    case ast.Attribute(attr=name):
                        called = defined.module, f"{owner}.{name}" if owner else name
                    case ast.Constant(value=str(name)):  # from globals(), setattr and similar
                        found.add(name)
                        continue
                    case _:
                        continue
                found.add(name)
                if called not in seen:
                    seen.add(called)
                    waiting.append(called)
        return found

    # ------------------------------------------------------------ reading a module

    def _module(self, name: str) -> Module:
        if name not in self.modules:
            self.modules[name] = self._read(name)
        return self.modules[name]

    def _read(self, name: str) -> Module:
        path = self.paths[name]
        text = self.texts[path]
        if self.read + len(text) > MAX_READ:
            self.unread.append(path)
            return Module()
        self.read += len(text)
        package = name.split(".")[: None if path.name == "__init__.py" else -1]
        outline = keep_outline if len(text) <= MAX_KEPT else make_outline
        return outline(text, ".".join(package))

    def _known(self, names: Iterable[str]) -> Iterator[str]:
        """Yield the submission's modules that these imports load, with the packages around them."""
        for name in names:
            parts = name.split(".", self.depth)[: self.depth]
            paths = (".".join(parts[: number + 1]) for number in range(len(parts)))
            yield from (each for each in paths if each in self.paths)

    # ------------------------------------------------------------ following a name

    def _bound(self, module: str, path: str, hops: int = 0) -> Definition | None:
        """Follow a name of a module, or `Class.name`, to its definition."""
        if module not in self.paths or hops > MAX_HOPS or len(path) > MAX_NAME:
            return None
        if (module, path) not in self.found:
            self.found[module, path] = None  # for names that refer to each other in a circle
            self.found[module, path] = self._looked_up(module, path, hops + 1)
        return self.found[module, path]

    def _looked_up(self, module: str, path: str, hops: int) -> Definition | None:
        first, _, rest = path.partition(".")
        known = self._module(module)
        for binding in self._limit(known.bindings(path, first)):
            found: Definition | None = None
            match binding:
                case Function(name=name) if name == path:
                    return Definition(module, binding)
                case Class() if rest:
                    return self._in_class(module, binding, rest, hops)
                case Alias(target=target, path=other) if target == path:
                    return self._bound(module, other, hops)
                case Alias(target=target, path=other) if "." not in target + other:
                    return self._bound(module, f"{other}.{rest}", hops)
                case Imported(module=source, name="*"):
                    found = self._bound(source, path, hops)
                    found = found if found and found.function else None
                case Imported(module=source, name=""):
                    if rest:
                        return self._bound(source, rest, hops)
                case Imported(module=source, name=name):
                    inside = f"{source}.{name}"
                    if rest and inside in self.paths:  # a module, not a name in one
                        found = self._bound(inside, rest, hops)
                    else:
                        found = self._bound(source, ".".join(filter(None, [name, rest])), hops)
            if found is not None:
                return found
        return Definition(module, None) if known.empty else None

    def _in_class(self, module: str, owner: Class, name: str, hops: int) -> Definition | None:
        """Return a method of a class, which it defines or inherits."""
        match owner.members.get(name):
            case Function() as function:
                return Definition(module, function)
            case Alias(path=other):
                return self._bound(module, other, hops)
        bases = self._limit(owner.bases)
        inherited = (self._bound(module, f"{base}.{name}", hops) for base in bases)
        return next((found for found in inherited if found is not None), None)

    def _limit(self, tries: Iterable[Try]) -> Iterator[Try]:
        """Yield `tries` up to a search's limit."""
        for each in tries:
            self.tried += 1
            if self.tried > MAX_TRIED:
                return
            yield each


def make_outline(text: str, package: str) -> Module:
    """Return the outline of a file of `package`, empty for one at the top."""
    tree = statements(text)
    refused = not tree or any(find_misplaced(ast.Module(tree, [])))
    imports = dict.fromkeys(list_imports(package, tree))
    module = Module(not tree, refused, imports=list(imports))
    for number, node in enumerate(top_level(tree)):
        match node:
            case ast.FunctionDef():
                module.names[node.name].append((number, function_at(node)))
            case ast.ClassDef():
                module.names[node.name].append((number, class_at(node)))
            case ast.Assign(targets=[target], value=value):
                left, right = dotted_name(target), dotted_name(value)
                if left and right:
                    module.names[left].append((number, Alias(left, right)))
            case ast.ImportFrom():
                source = source_module(package, node)
                for each in node.names:
                    star = each.name == "*"
                    bound = module.stars if star else module.names[each.asname or each.name]
                    bound.append((number, Imported(source, each.name)))
            case ast.Import():
                for each in node.names:
                    bound = module.names[each.asname or each.name]
                    bound.append((number, Imported(each.name)))
    return module


keep_outline = lru_cache(maxsize=64)(make_outline)


def list_imports(package: str, tree: list[ast.stmt]) -> Iterator[str]:
    """Yield the dotted names of modules that a file may import, and of names in them."""
    for node in every_statement(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            source = source_module(package, node)
            yield source
            yield from (f"{source}.{each.name}" for each in node.names)


def source_module(package: str, node: ast.ImportFrom) -> str:
    """Return the module of a `from ... import` in a package."""
    if not node.level:
        return node.module or ""
    parts = package.split(".")
    parts = parts[: len(parts) - node.level + 1]
    return ".".join(filter(None, [*parts, node.module]))


def function_at(node: ast.FunctionDef) -> Function:
    parameters = tuple(each.arg for each in node.args.args)
    return Function(node.name, node.lineno, node.end_lineno or node.lineno, parameters)


def class_at(node: ast.ClassDef) -> Class:
    members: dict[str, Function | Alias] = {}
    for each in top_level(node.body):
        match each:
            case ast.FunctionDef():
                members[each.name] = function_at(each)
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Name(id=other)):
                members[name] = Alias(name, other)
    return Class(members, list(filter(None, map(dotted_name, node.bases))))


def dotted_name(node: ast.expr) -> str:
    """Return a name with its dots, as `a.b.c`; empty for other expressions."""
    parts = []
    while isinstance(node, ast.Attribute):
        parts.append(node.attr)
        node = node.value
    return ".".join([node.id, *reversed(parts)]) if isinstance(node, ast.Name) else ""


def name_module(path: PurePath) -> str:
    """Return the name by which a file is imported, from the submission's folder."""
    parts = path.with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def top_level(body: Sequence[ast.stmt]) -> Iterator[ast.stmt]:
    """Yield the statements that run when a module or class is made, also under `if` and `try`.

    It does not recurse, since there may be thousands of `elif`.
    """
    waiting = list(reversed(body))
    while waiting:
        node = waiting.pop()
        yield node
        inside: list[ast.stmt] = []
        match node:
            case ast.If():
                inside = [*node.body, *node.orelse]
            case ast.Try():
                handled = [each for handler in node.handlers for each in handler.body]
                inside = [*node.body, *handled, *node.orelse, *node.finalbody]
            case ast.With():
                inside = node.body
        waiting += reversed(inside)


def every_statement(body: Iterable[ast.stmt]) -> Iterator[ast.AST]:
    """Yield all statements, also those inside others, and the blocks of `try` and `match`."""
    waiting: list[ast.AST] = list(body)
    while waiting:
        node = waiting.pop()
        yield node
        waiting += (each for each in ast.iter_child_nodes(node) if not isinstance(each, ast.expr))


def statements(text: str) -> list[ast.stmt]:
    """Return the statements of a source text; none if it is not Python."""
    tree = parse(text)
    return tree.body if tree else []


def list_functions(body: list[ast.stmt]) -> Iterator[tuple[str, ast.FunctionDef]]:
    """Yield the functions among the statements of a file, and methods as `Class.name`."""
    for node in body:
        inside, owner = (
            (node.body, f"{node.name}.") if isinstance(node, ast.ClassDef) else ([node], "")
        )
        for each in inside:
            if isinstance(each, ast.FunctionDef):
                yield owner + each.name, each


def find_function(body: list[ast.stmt], path: str) -> ast.FunctionDef | None:
    """Return the last definition of `name` or `Class.name` among the statements of a file."""
    return dict(list_functions(body)).get(path)


def source_of(text: str, function: Function | ast.FunctionDef) -> str:
    """Return the lines of a function, moved to the left edge."""
    lines = text.splitlines()[function.lineno - 1 : function.end_lineno]
    return textwrap.dedent("\n".join(lines))
