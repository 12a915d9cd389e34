"""Limit a submission's imports by one rule, for any installed packages.

It may import the standard library, the libraries of the assignment and its own files. Without the
rule, marks would depend on the packages that an instructor has installed.
"""

import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType

LIBRARIES = {"pygame": "pygame-ce", "pymunk": "pymunk", "numpy": "numpy"}  # by package
NEEDED_BY_THEM = {"cffi", "_cffi_backend", "typing_extensions"}
RULE = (
    "a submission may import the standard library, "
    f"{', '.join(LIBRARIES.values())} and its own files"
)
IN_C = "it works in machine code, whose work cannot be counted"  # of a banned module


ALLOWED = frozenset({"__main__", *sys.stdlib_module_names, *LIBRARIES, *NEEDED_BY_THEM})
HIDDEN: dict[str, ModuleType] = {}  # kept, because freeing shared memory after a fork is slow


class NotAllowed(ModuleNotFoundError):
    """An import that the rule does not allow; `except ImportError` catches it as any other."""


class ImportRule(MetaPathFinder):
    """Stands before all finders of modules and lets only allowed imports through."""

    def __init__(self, files: Iterable[str], bans: Iterable[str] = ()) -> None:
        """Make the rule for a submission with these files; `bans` are forbidden in any case."""
        self.bans = frozenset(bans)
        modules = (path.removesuffix(".py").split("/") for path in files if path.endswith(".py"))
        self.own = {part for parts in modules for part in parts}

    def install(self) -> None:
        """Apply the rule from now on, and hide the modules that the grader has loaded."""
        hide_modules()
        if self.bans:
            for name in [name for name in sys.modules if name.partition(".")[0] in self.bans]:
                HIDDEN[name] = sys.modules.pop(name)
        sys.meta_path.insert(0, self)

    def allows(self, name: str) -> bool:
        first = name.partition(".")[0]
        return first in ALLOWED or first in self.own

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Find nothing, so that other finders look; raise NotAllowed if the rule forbids it."""
        first = name.partition(".")[0]
        if first in self.bans:
            raise NotAllowed(f"{first} may not be imported here: {IN_C}", name=name)
        if not self.allows(name):
            raise NotAllowed(f"there is no {first} to import here: {RULE}", name=name)
        return None


def hide_modules() -> None:
    """Hide the modules that only the grader may import.

    The warm process does this before it forks: each child would copy the memory of hundreds of
    modules.
    """
    if not HIDDEN:
        for name in [name for name in sys.modules if name.partition(".")[0] not in ALLOWED]:
            HIDDEN[name] = sys.modules.pop(name)


@contextmanager
def unhidden_modules() -> Iterator[None]:
    """Bring hidden modules back for a while: psutil looks itself up by name."""
    sys.modules.update(HIDDEN)
    try:
        yield
    finally:
        for name in HIDDEN:
            sys.modules.pop(name, None)
