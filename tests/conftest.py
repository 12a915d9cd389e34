"""Shared by the tests: where the kit is, and how to hand in a changed copy of a tree."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

KIT = Path(__file__).parents[1]

HandIn = Callable[..., Path]


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
