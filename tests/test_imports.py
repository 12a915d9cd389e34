"""Test that imports go only to lower layers of the grader, and in no circle.

The files are read, not run, so an import inside a function counts as well. An import for type
checking alone never runs and may close a circle.
"""

import ast
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path
from typing import NamedTuple

import pytest
from conftest import KIT

GRADER = KIT / "grader"
FLOORS = [  # from the bottom up: a package imports from lower layers only
    {"errors", "protocol", "text", "source"},
    {"worker", "judge"},
    {"checks", "player", "intake"},
    {"report"},
    {"classroom", "questions", "bank"},
    {"release", "bench"},
    {"cli"},
    {"__main__"},
]


class Import(NamedTuple):
    """One file of ours that another one imports."""

    file: Path
    line: int
    source: Path
    only_for_types: bool

    def __str__(self) -> str:
        file, source = (path.relative_to(KIT).as_posix() for path in (self.file, self.source))
        return f"{file}:{self.line} imports {source}"


@cache
def imports_below(root: Path) -> list[Import]:
    """List the imports of one file below a root from another one."""
    base = root.parent if (root / "__init__.py").exists() else root  # folders on Python's path
    apart = {
        "build",
        "tab",
    }  # generated files, and programs that only run with the grader on a page
    files = [path for path in root.rglob("*.py") if apart.isdisjoint(path.relative_to(root).parts)]
    return [found for path in sorted(files) for found in imports_in(path, base)]


def imports_in(path: Path, base: Path) -> Iterator[Import]:
    tree = ast.parse(path.read_bytes())
    guards = [node for node in ast.walk(tree) if isinstance(node, ast.If) and is_for_types(node)]
    for_types = {id(node) for each in guards for part in each.body for node in ast.walk(part)}
    package = path.relative_to(base).parent.parts
    for node in ast.walk(tree):
        for module, name in names_of(node, package):
            source = file_of(f"{module}.{name}", base) or file_of(module, base)
            for each in [source, *packages_around(source, base)] if source else []:
                if each != path and (each == source or each not in packages_around(path, base)):
                    yield Import(path, node.lineno, each, id(node) in for_types)


def is_for_types(node: ast.If) -> bool:
    return ast.unparse(node.test).endswith("TYPE_CHECKING")


@cache
def packages_around(path: Path, base: Path) -> list[Path]:
    """List the packages a file is in, which Python imports before it."""
    folders = path.relative_to(base).parents
    return [each for folder in folders if (each := base / folder / "__init__.py").is_file()]


def names_of(node: ast.AST, package: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Yield the imports of a node as (module, name in it); the name of a module is empty."""
    match node:
        case ast.Import(names):
            yield from ((each.name, "") for each in names)
        case ast.ImportFrom(module, names, level):
            start = package[: len(package) + 1 - level] if level else ()
            whole = ".".join([*start, *([module] if module else [])])
            yield from ((whole, each.name) for each in names)
        case ast.Call(func, [ast.Constant(str(module)), *_]):
            if ast.unparse(func).endswith(("import_module", "__import__")):
                yield module, ""


@cache
def file_of(module: str, base: Path) -> Path | None:
    """Return the file of ours that a module is read from."""
    path = base.joinpath(*module.strip(".").split("."))
    candidates = (path / "__init__.py", path.with_name(f"{path.name}.py"))
    return next((each for each in candidates if each.is_file()), None)


def sort_files(root: Path) -> None:
    """Sort the files by their imports; raises CycleError, which names a circle."""
    graph: dict[Path, set[Path]] = {}
    for each in imports_below(root):
        if not each.only_for_types:
            graph.setdefault(each.file, set()).add(each.source)
    TopologicalSorter(graph).prepare()


@pytest.mark.parametrize("name", ["grader", "solution", "starter"])
def test_no_files_import_each_other_in_a_circle(name: str):
    sort_files(KIT / name)


def test_the_worker_imports_nothing_of_the_grader_but_the_protocol():
    worker, protocol = GRADER / "worker", GRADER / "protocol.py"
    of_the_worker = [each for each in imports_below(GRADER) if worker in each.file.parents]
    others = [each for each in of_the_worker if worker not in each.source.parents]
    assert {each.source for each in others} == {protocol}, [*map(str, others)]


def room_of(path: Path) -> str:
    """Return the subpackage of the grader that a file is in; empty for the package itself."""
    name = path.relative_to(GRADER).parts[0].removesuffix(".py")
    return "" if name == "__init__" else name


def test_rooms_import_from_lower_floors_only():
    floor = {room: number for number, rooms in enumerate(FLOORS) for room in rooms}
    wrong = []
    for each in imports_below(GRADER):
        upper, lower = room_of(each.file), room_of(each.source)
        if upper and lower and upper != lower and floor[upper] <= floor[lower]:
            wrong.append(str(each))
    assert wrong == []


@pytest.mark.parametrize(
    ("text", "is_circle"),
    [
        ("from . import b", True),
        ("import importlib\ndef later():\n    importlib.import_module('pack.b')", True),
        ("import typing\nif typing.TYPE_CHECKING:\n    from .b import B", False),
    ],
)
def test_a_circle_is_found_however_it_is_written(text: str, is_circle: bool, tmp_path: Path):
    root = tmp_path / "pack"
    root.mkdir()
    for name, content in {"__init__": "", "a": text, "b": "from pack.a import A"}.items():
        (root / f"{name}.py").write_text(content, encoding="utf-8")
    try:
        sort_files(root)
    except ValueError:  # a CycleError
        assert is_circle
    else:
        assert not is_circle
