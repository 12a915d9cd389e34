"""Run programs of the two trees, in their folder and in their own process."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from grader.judge.rubric import load_rubric
from grader.source.regions import python_files, regions_in

HERE = Path(__file__).parent
SOLUTION, STARTER = (HERE.parents[1] / name for name in ("solution", "starter"))
TODOS = [todo.id for todo in load_rubric().main_todos if todo.function]
BONUS = [todo.id for todo in load_rubric().todos if todo.bonus]
MINI, PYMUNK, INTEGRATORS = ["-m", "mini_engine"], ["pymunk_scene.py"], ["integrators.py"]


def run_in(tree: Path, *arguments: str, **environment: str) -> str:
    """Return what a Python program prints in the tree; it must not fail."""
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=tree,
        env={
            **os.environ,
            "SDL_VIDEODRIVER": "dummy",
            "SDL_AUDIODRIVER": "dummy",
            "PYGAME_HIDE_SUPPORT_PROMPT": "1",
            "PYTHONDONTWRITEBYTECODE": "1",
            **environment,
        },
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def probe(tree: Path, name: str, *arguments: Any) -> Any:
    """Return the result of a function of probes.py, run in the tree."""
    values = map(json.dumps, arguments)
    return json.loads(run_in(tree, "-m", "probes", name, *values, PYTHONPATH=str(HERE)))


def regions(tree: Path) -> dict[str, tuple[str, Any]]:
    """Return the file and the region of every TODO of a tree."""
    return {
        region.id: (path.relative_to(tree).as_posix(), region)
        for path in python_files(tree)
        for region in regions_in(path.read_text(encoding="utf-8"))
    }


def copy_of(tree: Path, folder: Path) -> Path:
    return shutil.copytree(tree, folder / tree.name, ignore=shutil.ignore_patterns("__pycache__"))


def edit(path: Path, old: str, new: str) -> None:
    """Replace the only occurrence of `old` in a file."""
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {path.name}"
    path.write_text(text.replace(old, new), encoding="utf-8", newline="\n")
