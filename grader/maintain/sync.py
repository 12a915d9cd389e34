"""Keeping the two trees one: the solution's files everywhere, the starter's stubs in the regions.

Each tree owns what stands inside its TODO regions; everything else is written in `solution/` and
carried over. The stubs are also kept with the checks, which must know an untouched TODO.
"""

import json
from pathlib import Path

from grader.judge.rubric import CHECKS, load_rubric
from grader.judge.submission import function_named, source_of, statements
from grader.todo_regions import python_files, regions_in, replaced

SKIPPED = {
    "notebooks",  # the starter's are made by nbgrader: see classroom/nbgrader/notebooks.py
    "build",
    "__pycache__",
    ".ipynb_checkpoints",
    ".pytest_cache",
    ".mypy_cache",
    ".ruff_cache",
}


class OutOfStep(Exception):
    """The trees cannot be brought together; the message names the file and the TODO."""


def sync(solution: Path, starter: Path, write: bool) -> list[str]:
    """Carry the solution over into the starter; returns what differed, one line each."""
    wanted = {name: wanted_text(solution / name, starter / name) for name in given_files(solution)}
    changes = []
    for name, content in wanted.items():
        target = starter / name
        if not target.exists() or target.read_bytes() != content:
            changes.append(f"{name} differs from the solution outside its TODO regions")
            if write:
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(content)
    for name in given_files(starter):
        if name not in wanted:
            changes.append(f"{name} is in the starter and not in the solution")
            if write:
                (starter / name).unlink()
    stubs, kept = json.dumps(stub_sources(starter), indent=1) + "\n", CHECKS / "stubs.json"
    if not kept.exists() or kept.read_text(encoding="utf-8") != stubs:
        changes.append("the stubs that the checks know are not the starter's")
        if write:
            kept.write_text(stubs, encoding="utf-8")
    return changes


def given_files(tree: Path) -> list[str]:
    return [
        path.relative_to(tree).as_posix()
        for path in sorted(tree.rglob("*"))
        if path.is_file() and not SKIPPED & set(path.relative_to(tree).parts)
    ]


def wanted_text(source: Path, target: Path) -> bytes:
    """The solution's file with the starter's regions in place of its own."""
    if source.suffix != ".py":
        return source.read_bytes()
    text = source.read_text(encoding="utf-8")
    regions = regions_in(text)
    if not regions:
        return source.read_bytes()
    stubs = {r.id: r.lines for r in regions_in(target.read_text(encoding="utf-8"))}
    for region in regions:
        if region.id not in stubs:
            raise OutOfStep(f"{target} has no stub for TODO {region.id}: write one there first")
    return replaced(text, stubs).encode()


def stub_sources(starter: Path) -> dict[str, str]:
    """What the starter holds for each TODO: its region, and the whole function around it."""
    stubs = {}
    functions = {todo.function.partition(":")[2]: todo.id for todo in load_rubric().todos}
    for path in python_files(starter):
        text = path.read_text(encoding="utf-8")
        body, ids = statements(text), set()
        for region in regions_in(text):
            stubs[region.id] = "\n".join(region.lines)
            ids.add(region.id)
        for name, todo in functions.items():
            found = function_named(body, name) if name and todo in ids else None
            if found is not None:
                stubs[f"def {todo}"] = source_of(text, found)
    return dict(sorted(stubs.items()))
