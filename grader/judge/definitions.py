"""Where a submission defines a function: the definition that Python would run, told from the text.

A folder often holds more than runs: a kept copy of the starter, a second try, a file of notes. So
the names of imports are followed from the program's module to the one definition that counts.
"""

import ast
import textwrap
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath


@dataclass(frozen=True)
class Definition:
    """The module in which a name ends up, and its function there, if the module can be read."""

    module: str
    function: ast.FunctionDef | None


class Program:
    """The modules of a submission, and what their names stand for.

    A file is parsed when a name leads to it: most of what lies about never is.
    """

    def __init__(self, texts: Mapping[Path, str]) -> None:
        """`texts`: the text of each file, by its path inside the submission's folder."""
        self.texts = texts
        self.paths: dict[str, Path] = {}  # by the dotted name of a module
        for path in sorted(texts, key=lambda each: each.name != "__init__.py"):
            self.paths.setdefault(dotted(path), path)  # a package hides a file of its name
        self.parsed: dict[str, list[ast.stmt]] = {}
        self.imports: dict[str, list[str]] = {}  # the modules that each imports, as far as known

    def tree(self, module: str) -> list[ast.stmt]:
        """The statements of a module; none where it is no Python."""
        if module not in self.parsed:
            self.parsed[module] = statements(self.texts[self.paths[module]])
        return self.parsed[module]

    def source(self, module: str, function: ast.FunctionDef) -> str:
        """The lines of a function of a module, moved to the left edge."""
        return source_of(self.texts[self.paths[module]], function)

    def definition(self, module: str, path: str) -> Definition | None:
        """Where `module` gets `name` or `Class.name` from."""
        found = self._bound(module, path, frozenset())
        if found is not None and found.function is not None:
            return found
        # A package need not pass the name on: any part of it that runs may have it.
        others = (self._bound(each, path, frozenset()) for each in self.loaded(module))
        return next((each for each in others if each and each.function), found)

    def loaded(self, module: str) -> list[str]:
        """The submission's modules that importing `module` loads, by name."""
        seen: set[str] = set()
        waiting = [module]
        while waiting:
            name = waiting.pop()
            if name in self.paths and name not in seen:
                seen.add(name)
                if name not in self.imports:
                    self.imports[name] = list(dict.fromkeys(self._imports(name)))
                waiting += self.imports[name]
        return sorted(seen)

    def _imports(self, module: str) -> Iterator[str]:
        for node in ast.walk(ast.Module(self.tree(module), [])):
            if isinstance(node, ast.Import):
                for alias in node.names:
                    yield from ancestors(alias.name)
            elif isinstance(node, ast.ImportFrom):
                source = self._source(module, node)
                yield from ancestors(source)
                yield from (f"{source}.{alias.name}" for alias in node.names)

    def _source(self, module: str, node: ast.ImportFrom) -> str:
        """The module that a `from ... import` takes its names from."""
        if not node.level:
            return node.module or ""
        package = module.split(".")
        inside = self.paths[module].name == "__init__.py"
        package = package[: len(package) - node.level + inside]
        return ".".join([*package, *filter(None, [node.module])])

    def _bound(self, module: str, path: str, seen: frozenset[tuple[str, str]]) -> Definition | None:
        """What a name of a module, or `Class.name`, is bound to at last."""
        if module not in self.paths or (module, path) in seen:
            return None
        seen |= {(module, path)}
        first, _, rest = path.partition(".")
        tree = self.tree(module)
        for node in reversed(list(top_level(tree))):
            match node:
                case ast.FunctionDef(name=name) if name == path:
                    return Definition(module, node)
                case ast.ClassDef(name=name) if name == first and rest:
                    return self._in_class(module, node, rest, seen)
                case ast.Assign(targets=[target], value=value) if ast.unparse(target) == path:
                    if isinstance(value, ast.Name | ast.Attribute):
                        return self._bound(module, ast.unparse(value), seen)
                case ast.Assign(targets=[ast.Name(id=name)], value=ast.Name(id=other)):
                    if name == first and rest:
                        return self._bound(module, f"{other}.{rest}", seen)
                case ast.ImportFrom():
                    found = self._imported(module, node, first, rest, seen)
                    if found is not None:
                        return found
                case ast.Import(names=aliases) if rest:
                    for alias in aliases:
                        if (alias.asname or alias.name) == first:
                            return self._bound(alias.name, rest, seen)
        return None if tree else Definition(module, None)  # empty, or no Python: nothing to tell

    def _imported(
        self,
        module: str,
        node: ast.ImportFrom,
        first: str,
        rest: str,
        seen: frozenset[tuple[str, str]],
    ) -> Definition | None:
        source = self._source(module, node)
        for alias in node.names:
            if (alias.asname or alias.name) == first:
                if f"{source}.{alias.name}" in self.paths and rest:  # a module, not a name in one
                    return self._bound(f"{source}.{alias.name}", rest, seen)
                return self._bound(source, ".".join(filter(None, [alias.name, rest])), seen)
            if alias.name == "*":
                found = self._bound(source, ".".join(filter(None, [first, rest])), seen)
                if found is not None and found.function is not None:
                    return found
        return None

    def _in_class(
        self, module: str, owner: ast.ClassDef, name: str, seen: frozenset[tuple[str, str]]
    ) -> Definition | None:
        """A method of a class, its own or one that it inherits."""
        for node in reversed(list(top_level(owner.body))):
            match node:
                case ast.FunctionDef(name=here) if here == name:
                    return Definition(module, node)
                case ast.Assign(targets=[ast.Name(id=here)], value=ast.Name(id=other)):
                    if here == name:
                        return self._bound(module, other, seen)
        for base in owner.bases:
            if isinstance(base, ast.Name | ast.Attribute):
                found = self._bound(module, f"{ast.unparse(base)}.{name}", seen)
                if found is not None:
                    return found
        return None


def dotted(path: PurePath) -> str:
    """The name by which a file is imported, from the submission's folder."""
    parts = path.with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def ancestors(name: str) -> Iterator[str]:
    """A module and the packages around it, all of which its import loads."""
    parts = name.split(".")
    return (".".join(parts[: number + 1]) for number in range(len(parts)))


def top_level(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    """The statements that run when a module or class is made, those under `if` and `try` too."""
    for node in body:
        yield node
        match node:
            case ast.If() | ast.Try():
                for part in (node.body, *(h.body for h in getattr(node, "handlers", []))):
                    yield from top_level(part)
                yield from top_level(node.orelse)
                yield from top_level(getattr(node, "finalbody", []))
            case ast.With():
                yield from top_level(node.body)


def statements(text: str) -> list[ast.stmt]:
    """The statements of a source text; none where it is no Python."""
    try:
        with warnings.catch_warnings(action="ignore"):
            return ast.parse(text).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []


def function_named(body: list[ast.stmt], path: str) -> ast.FunctionDef | None:
    """The definition of `name` or `Class.name` among the statements of a file."""
    owner, _, name = path.rpartition(".")
    if owner:
        body = [
            each
            for node in body
            if isinstance(node, ast.ClassDef) and node.name == owner
            for each in node.body
        ]
    found = [node for node in body if isinstance(node, ast.FunctionDef) and node.name == name]
    return found[-1] if found else None


def source_of(text: str, function: ast.FunctionDef) -> str:
    """The lines of a function, moved to the left edge."""
    lines = text.splitlines()[function.lineno - 1 : function.end_lineno]
    return textwrap.dedent("\n".join(lines))
