"""Keep the two trees in step: the solution's files everywhere, the starter's stubs in the regions.

Each tree owns the inside of its TODO regions; everything else is written in `solution/` and copied.
Files that students use and do not edit are in `solution/` alone, and are added wherever students
get the starter. The checks keep the stubs too, to recognize an untouched TODO, and the given code,
to supply what a submission lacks.
"""

import json
import re
from pathlib import Path

from grader.errors import Stop
from grader.judge.rubric import CHECKS, load_rubric
from grader.source.definitions import find_function, source_of, statements
from grader.source.regions import regions_in, replace_regions

LAID_IN = {"accuracy.py", "experiments", "stable_engine"}
SKIPPED = {
    "notebooks",  # the starter's are made by nbgrader: see release/nbgrader_notebooks.py
    "build",
    "__pycache__",
    ".ipynb_checkpoints",
    ".pytest_cache",
    ".mypy_cache",
    ".ruff_cache",
}


class OutOfStep(Stop):
    """The trees cannot be brought together; the message names the file and the TODO."""


def sync(solution: Path, starter: Path, write: bool, course: Path | None = None) -> list[str]:
    """Copy the solution into the starter; return one line per change.

    Without `write`, only report the differences. New TODOs are named in the course file.
    """
    wanted = {
        name: merge_regions(solution / name, starter / name)
        for name in list_given_files(solution)
        if not is_laid_in(name)
    }
    lines = mark_check_folders(write)
    for name, content in wanted.items():
        if renew(starter / name, content, write):
            differs = f"{name} differs from the solution outside its TODO regions"
            lines.append(f"carried {name} over" if write else differs)
    for name in list_given_files(starter):
        if name not in wanted:
            differs = f"{name} does not belong in the starter"
            lines.append(f"removed {name} from the starter" if write else differs)
            if write:
                (starter / name).unlink()
    texts = {name: content.decode() for name, content in wanted.items() if name.endswith(".py")}
    for name, sources in (
        ("stubs", read_stub_sources(texts)),
        ("given", read_given_sources(texts)),
    ):
        text = json.dumps(sources, indent=1) + "\n"
        known = CHECKS / f"{name}.json"
        before = known.read_bytes() if known.exists() else b"{}"
        if renew(CHECKS / f"{name}.json", text.encode(), write):
            differs = f"{name}.json, by which the checks know the starter, is not up to date"
            lines.append(f"renewed {name}.json for the checks" if write else differs)
            lines += list_new_todos(before, sources, course) if write and name == "stubs" else []
    return lines


def mark_check_folders(write: bool) -> list[str]:
    """Make each folder of checks a package; return a line for each new one."""
    lines = []
    for folder in dict.fromkeys(todo.folder for todo in load_rubric().todos):
        path = CHECKS / folder / "__init__.py"
        titles = [todo.title for todo in load_rubric().todos if todo.folder == folder]
        if not path.exists():
            renew(path, f'"""Checks: {"; ".join(titles)}."""\n'.encode(), write)
            name = f"grader/checks/{folder}/__init__.py"
            lines.append(f"made {name}" if write else f"there is no {name}")
    return lines


def list_new_todos(before: bytes, stubs: dict[str, str], course: Path | None) -> list[str]:
    """Add new TODOs to the course file; return a line for each TODO that is new or gone."""
    known = {id for id in json.loads(before) if not id.startswith("def ")}
    now = {id for id in stubs if not id.startswith("def ")}
    lines = [f"TODO {id} is new" for id in sorted(now - known)]
    if course and name_in_course(course, sorted(now - known)):
        lines.append(f"{course.name} names what is new")
    return lines + [f"TODO {id} is gone" for id in sorted(known - now)]


def name_in_course(course: Path, todos: list[str]) -> bool:
    """Add TODOs to a course's list if it spans several lines; return whether it changed."""
    names = "".join(f'  "{id}",\n' for id in todos)
    text = course.read_text(encoding="utf-8")
    named = re.sub(r"(?ms)^(todos = \[\n.*?)^\]", rf"\g<1>{names}]", text, count=1)
    return renew(course, named.encode(), write=True)


def renew(path: Path, content: bytes, write: bool) -> bool:
    """Return whether a file differs from `content`; with `write`, write it."""
    if path.exists() and path.read_bytes() == content:
        return False
    if write:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return True


def list_given_files(tree: Path) -> list[str]:
    return [
        path.relative_to(tree).as_posix()
        for path in sorted(tree.rglob("*"))
        if path.is_file() and not SKIPPED & set(path.relative_to(tree).parts)
    ]


def is_laid_in(name: str) -> bool:
    return name.partition("/")[0] in LAID_IN


def list_students_files(kit: Path) -> dict[str, Path]:
    """Return the path of each file that students get, by their name for it, without notebooks."""
    solution, starter = kit / "solution", kit / "starter"
    extra = {name: solution / name for name in list_given_files(solution) if is_laid_in(name)}
    return extra | {name: starter / name for name in list_given_files(starter)}


def merge_regions(source: Path, target: Path) -> bytes:
    """Return the solution's file with the starter's regions in place of its own."""
    if source.suffix != ".py":
        return source.read_bytes()
    text = source.read_text(encoding="utf-8")
    regions = regions_in(text, str(source))
    if not regions:
        return source.read_bytes()
    stubs = {r.id: r.lines for r in regions_in(target.read_text(encoding="utf-8"), str(target))}
    for region in regions:
        if region.id not in stubs:
            raise OutOfStep(f"{target} has no stub for TODO {region.id}: write one there first")
    return replace_regions(text, stubs).encode()


def read_stub_sources(starter: dict[str, str]) -> dict[str, str]:
    """Return the starter's stub of each TODO: its region, and the whole function around it."""
    stubs = {}
    functions = {todo.id: todo.function.partition(":")[2] for todo in load_rubric().todos}
    for text in starter.values():
        body, ids = statements(text), set()
        for region in regions_in(text):
            stubs[region.id] = "\n".join(region.lines)
            ids.add(region.id)
        for todo, name in functions.items():
            found = find_function(body, name) if name and todo in ids else None
            if found is not None:
                stubs[f"def {todo}"] = source_of(text, found)
    return dict(sorted(stubs.items()))


def read_given_sources(starter: dict[str, str]) -> dict[str, str]:
    """Return the given files, to supply missing ones and to find changes."""
    programs = load_rubric().modules
    return {
        name: text
        for name, text in starter.items()
        if name.partition("/")[0] in programs or "/" not in name
    }
