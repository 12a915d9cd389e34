"""Shared by the tests: the kit, what students get of it, and changed copies of a tree handed in."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from grader.maintain.sync import students_files

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

KIT = Path(__file__).parents[1]

HandIn = Callable[..., Path]


@pytest.fixture(scope="session")
def handed_out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A student's folder in which nothing is done yet: the starter, and what is laid in."""
    folder = tmp_path_factory.mktemp("handed-out")
    for name, path in students_files(KIT).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, folder / name)
    return folder


@pytest.fixture
def hand_in(tmp_path: Path) -> HandIn:
    """Make a submission: a tree (or nothing), with files put in or, given None, left out."""

    def make(base: str | None = None, **files: str | None) -> Path:
        folder = tmp_path / "handed-in"
        if base:
            shutil.copytree(KIT / base, folder, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            folder.mkdir()
        for name, text in files.items():
            path = folder / name.replace("__", "/").replace("_py", ".py")
            if text is None:
                path.unlink()
            else:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
        return folder

    return make
