"""Imports go one way: no circle in the grader or a tree, and the worker knows the protocol alone.

The files are read, not run, so that an import inside a function counts as well: put there, it would
hide a circle instead of ending it. What is imported for type checking alone never runs, so it
may close a circle.
"""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest
from conftest import KIT
from samples import sample

ROOTS = {"grader": KIT / "grader", "solution": KIT / "solution", "starter": KIT / "starter"}


@dataclass(frozen=True)
class Import:
    """One name that a file of ours takes from another one."""

    file: Path
    line: int
    source: Path  # the file it comes from
    name: str
    only_for_types: bool


@cache
def imports_below(root: Path) -> list[Import]:
    """All imports of one file below a root from another one."""
    base = root.parent if (root / "__init__.py").exists() else root  # what is on Python's path
    apart = {"build", "tab"}  # what is made, and programs of a page that meet the grader there only
    files = [path for path in root.rglob("*.py") if apart.isdisjoint(path.relative_to(root).parts)]
    return [found for path in sorted(files) for found in imports_in(path, base)]


def imports_in(path: Path, base: Path) -> Iterator[Import]:
    tree = ast.parse(path.read_bytes())
    for_types = {id(node) for guard in type_guards(tree) for node in below(guard.body)}
    package = package_of(path, base)
    for node in ast.walk(tree):
        for module, name in names_of(node, package):
            source = file_of(f"{module}.{name}", base) or file_of(module, base)
            for each in [source, *packages_around(source, base)] if source else []:
                if each != path and (each == source or each not in packages_around(path, base)):
                    yield Import(path, node.lineno, each, name or module, id(node) in for_types)


@cache
def packages_around(path: Path, base: Path) -> list[Path]:
    """The packages a file is in, which Python imports before it."""
    folders = path.relative_to(base).parents
    return [each for folder in folders if (each := base / folder / "__init__.py").is_file()]


def type_guards(tree: ast.Module) -> Iterator[ast.If]:
    """Every `if TYPE_CHECKING:`."""
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and last_name(node.test) == "TYPE_CHECKING":
            yield node


def last_name(expression: ast.expr) -> str:
    """The name, or what stands behind its last dot; empty for anything else."""
    match expression:
        case ast.Name(name) | ast.Attribute(attr=name):
            return name
    return ""


def below(statements: list[ast.stmt]) -> Iterator[ast.AST]:
    for statement in statements:
        yield from ast.walk(statement)


def package_of(path: Path, base: Path) -> list[str]:
    """The names of the packages a file is in, from the outside in."""
    return list(path.relative_to(base).parent.parts)


def names_of(node: ast.AST, package: list[str]) -> Iterator[tuple[str, str]]:
    """What a node imports, as (module, name in it); no name where the module itself is meant."""
    match node:
        case ast.Import(names):
            yield from ((each.name, "") for each in names)
        case ast.ImportFrom(module, names, level):
            start = package[: len(package) + 1 - level] if level else []
            whole = ".".join([*start, *([module] if module else [])])
            yield from ((whole, each.name) for each in names)
        case ast.Call(func, [ast.Constant(str(module)), *_]) if is_import_call(func):
            yield module, ""


def is_import_call(function: ast.expr) -> bool:
    """Whether it is import_module or __import__: here a name in quotes is an import as well."""
    return last_name(function) in ("import_module", "__import__")


@cache
def file_of(module: str, base: Path) -> Path | None:
    """The file of ours that a module is read from."""
    place = base.joinpath(*module.strip(".").split("."))
    candidates = (place / "__init__.py", place.with_name(f"{place.name}.py"))
    return next((each for each in candidates if each.is_file()), None)


def circles(imports: list[Import]) -> list[list[Import]]:
    """Circles that share no import: each is found, taken out, and the rest searched again."""
    left, found = [each for each in imports if not each.only_for_types], []
    while circle := a_circle(left):
        found.append(circle)
        links = {(each.file, each.source) for each in circle}
        left = [each for each in left if (each.file, each.source) not in links]
    return found


def a_circle(imports: list[Import]) -> list[Import]:
    """The imports of one circle, or none."""
    graph: dict[Path, set[Path]] = {}
    for each in imports:
        graph.setdefault(each.file, set()).add(each.source)
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        way = error.args[1]  # every file of it is imported by the next, and the first stands last
        links = set(zip(way[1:], way, strict=False))
        return [each for each in imports if (each.file, each.source) in links]
    return []


def listed(imports: list[Import]) -> str:
    """One line for each pair of files, with the names that one takes from the other."""
    names: dict[tuple[Path, Path], list[str]] = {}
    for each in imports:
        names.setdefault((each.file, each.source), []).append(f"{each.name} (line {each.line})")
    return "\n".join(
        f"  {file.relative_to(KIT)} imports {', '.join(taken)} from {source.relative_to(KIT)}"
        for (file, source), taken in names.items()
    )


@pytest.mark.parametrize("root", sample(ROOTS.values(), 2), ids=ROOTS)
def test_no_files_import_each_other_in_a_circle(root: Path):
    found = circles(imports_below(root))
    assert not found, "\n".join(f"a circle:\n{listed(each)}" for each in found)


def test_the_worker_imports_nothing_of_the_grader_but_the_protocol():
    worker, protocol = KIT / "grader" / "worker", KIT / "grader" / "protocol.py"
    of_the_worker = [each for each in imports_below(KIT / "grader") if worker in each.file.parents]
    wrong = [
        each
        for each in of_the_worker
        if each.source != protocol and worker not in each.source.parents
    ]
    assert any(each.source == protocol for each in of_the_worker)
    assert not wrong, f"the worker meets submissions, so it may not know this:\n{listed(wrong)}"


FLOORS = [  # from the ground up: a room imports from lower floors only
    {"errors", "protocol", "text", "source"},
    {"worker", "judge"},
    {"checks", "player", "intake"},
    {"report"},
    {"classroom", "questions", "bank"},
    {"release", "bench"},
    {"cli"},
    {"__main__"},
]


def room_of(path: Path) -> str:
    """Return the room of the grader that a file is in; the package itself is none."""
    name = path.relative_to(KIT / "grader").parts[0].removesuffix(".py")
    return "" if name == "__init__" else name


def test_rooms_import_from_lower_floors_only():
    floor = {room: number for number, rooms in enumerate(FLOORS) for room in rooms}
    between = [
        (each, room_of(each.file), room_of(each.source)) for each in imports_below(KIT / "grader")
    ]
    wrong = [
        each
        for each, upper, lower in between
        if upper and lower and upper != lower and floor[upper] <= floor[lower]
    ]
    assert not wrong, f"these imports do not run down:\n{listed(wrong)}"


# ---------------------------------------------------------------- what the reading finds


@pytest.mark.parametrize(
    "text",
    [
        "from .b import B",
        "from . import b",
        "from pack import b",
        "from pack.b import *",
        "import pack.b",
        "def later():\n    from .b import B",
        "import importlib\nimportlib.import_module('pack.b')",
        "if TYPE_CHECKING:\n    pass\nelse:\n    from .b import B",
    ],
)
def test_a_circle_is_found_however_it_is_written(text: str, tmp_path: Path):
    root = package(tmp_path, a=text, b="from .c import C", c="class C:\n    from .a import A")
    (circle,) = circles(imports_below(root))
    assert {each.file.stem for each in circle} == {"a", "b", "c"}


@pytest.mark.parametrize(
    "text",
    [
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from .b import B",
        "import typing\nif typing.TYPE_CHECKING:\n    from .b import B",
        "import b",
        "from .d import B",
    ],
)
def test_what_no_circle_runs_through_is_left_alone(text: str, tmp_path: Path):
    root = package(tmp_path, a=text, b="from .a import A", c="from .a import A\nfrom .b import B")
    assert circles(imports_below(root)) == []


def test_a_package_is_imported_with_each_of_its_modules(tmp_path: Path):
    root = package(tmp_path, a="from pack.inner.b import B")
    package(root, "inner", __init__="from pack.a import A", b="")
    (circle,) = circles(imports_below(root))
    assert {each.file.parent.name for each in circle} == {"pack", "inner"}


def package(folder: Path, named: str = "pack", **files: str) -> Path:
    """A package with these modules."""
    root = folder / named
    root.mkdir()
    for name, text in {"__init__": "", **files}.items():
        (root / f"{name}.py").write_text(text, encoding="utf-8")
    return root
