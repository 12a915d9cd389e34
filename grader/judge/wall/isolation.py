"""Decide whether the layers of isolation around a submission are enough, by their names."""

import importlib
from contextlib import suppress
from pathlib import Path
from typing import Literal

Isolation = Literal["auto", "strict", "none"]

LAYERS = {  # layers by what they confine; one of each is enough
    "files": {"own-root", "landlock-files"},
    "network": {"system-calls", "network-namespace", "landlock-tcp"},
    "other processes": {"system-calls", "pid-namespace", "landlock-scope", "own-user"},
}
STRICT = ("files", "network")  # required by --isolation=strict

# These keep a submission from writing foreign files. A separate user can still read what every
# account can, which is not enough for `strict`.
KEEPS_FILES = LAYERS["files"] | {"own-user"}
ONE_PROCESS = "one-process"  # without layers: submission and grader share a process


def find_refusal(isolation: Isolation, layers: list[str], trusted: bool) -> str:
    """Return the reason why these layers are not enough to grade, or an empty text.

    `trusted`: the submission is the user's own work, which may run without a grader as well.
    """
    if ONE_PROCESS in layers and not trusted:
        return (
            "another person's code may not run inside the grader's own process, where it could "
            "change its marks. Grade it with `grade`, on a machine that can start processes."
        )
    has = f"(it has {', '.join(layers)})"
    open_to_it = [what for what in list_unconfined(layers) if what in STRICT]
    if isolation == "strict" and open_to_it:
        return (
            f"--isolation=strict: this machine cannot confine {' and '.join(open_to_it)} {has}. "
            "Use a Linux with Landlock, or a virtual machine with one."
        )
    if isolation == "auto" and not trusted and not KEEPS_FILES & set(layers):
        return (
            f"this machine cannot keep somebody else's code from your files {has}. Grade in a "
            "container with `make contained`, or on a Linux with Landlock; or, if you trust what "
            "you grade as your own code, say --isolation none."
        )
    return ""


def list_unconfined(layers: list[str]) -> list[str]:
    """Return the things that a submission can still reach."""
    return [what for what, any_of in LAYERS.items() if not any_of & set(layers)]


def load_everything() -> None:
    """Import all of the grader before a submission runs and could rewrite its files.

    Modules whose packages are not installed, such as Dask, are skipped.
    """
    import pkgutil  # imported here, since it is slow

    for found in pkgutil.walk_packages([str(Path(__file__).parents[2])], "grader."):
        if not found.name.startswith("grader.worker") and not found.name.endswith("__main__"):
            with suppress(ImportError):
                importlib.import_module(found.name)
