"""Tell whether a program leaves more behind than modules, when it is imported or checked.

If not, a fork of the process that imported it is like a child that imports it itself.
"""

import os
import random
import threading
from collections.abc import Iterator
from pathlib import Path

import pygame

MOST_SECONDS = 0.2  # of processor time, for an import: a child with its own would count it


class Surroundings:
    """What a program could change outside of its modules, as it is now."""

    def __init__(self, folder: Path) -> None:
        """Look at this process, and at a folder with all files that it may write."""
        self.folder = folder
        self.files, self.state = self._list_files(), read_state()
        self.began = seconds_used()

    def survive_import(self) -> bool:
        """Return whether an import since then was quick and changed nothing.

        A fork has no threads but its own, and shares descriptors; its random numbers are others.
        """
        quick = seconds_used() - self.began < MOST_SECONDS
        return quick and read_state() == self.state and self.have_same_files()

    def have_same_files(self) -> bool:
        return self._list_files() == self.files

    def _list_files(self) -> list[tuple[str, int, int]]:
        return [*list_files(str(self.folder))]


def list_files(folder: str) -> Iterator[tuple[str, int, int]]:
    """Yield the path, time of change (ns) and size (bytes) of all that a folder holds."""
    with os.scandir(folder) as entries:
        for entry in entries:
            about = entry.stat(follow_symlinks=False)
            yield entry.path, about.st_mtime_ns, about.st_size
            if entry.is_dir(follow_symlinks=False):
                yield from list_files(entry.path)


def read_state() -> tuple[object, ...]:
    """Return the state of this process beside its modules."""
    free = os.dup(0)  # the lowest number without a descriptor
    os.close(free)
    started = pygame.get_init(), pygame.display.get_init(), pygame.mixer.get_init()
    threads = threading.active_count()
    return free, started, threads, random.getstate(), os.getcwd(), dict(os.environ)


def seconds_used() -> float:
    return sum(os.times()[:2])
