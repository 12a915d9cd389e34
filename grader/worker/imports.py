"""Limit what a submission may import: one rule, whatever is installed here.

The standard library, the libraries of the assignment and the submission's own files. Without the
rule, marks would hang on what an instructor happens to have beside the grader.
"""

import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType

LIBRARIES = {"pygame": "pygame-ce", "pymunk": "pymunk", "numpy": "numpy"}  # as installed
BENEATH = {"cffi", "_cffi_backend", "typing_extensions"}  # what those libraries load themselves
RULE = (
    "a submission may import the standard library, "
    f"{', '.join(LIBRARIES.values())} and its own files"
)
IN_C = "it works in machine code, and nobody could count what that does"  # of what is banned


ALLOWED = frozenset({"__main__", *sys.stdlib_module_names, *LIBRARIES, *BENEATH})
AWAY: dict[str, ModuleType] = {}  # kept: to free what a forked process shares costs more


class NotAllowed(ModuleNotFoundError):
    """An import that the rule does not allow; `except ImportError` catches it as any other."""


class ImportRule(MetaPathFinder):
    """Stands before all that finds modules, and lets nothing through but what is allowed."""

    def __init__(self, files: Iterable[str], bans: Iterable[str] = ()) -> None:
        """Set the rule for a submission with these files, which may not import `bans` either."""
        self.bans = frozenset(bans)
        modules = (path.removesuffix(".py").split("/") for path in files if path.endswith(".py"))
        self.own = {part for parts in modules for part in parts}

    def install(self) -> None:
        """Apply the rule from now on; what the grader has loaded is out of reach by name."""
        put_away()
        if self.bans:
            for name in [name for name in sys.modules if name.partition(".")[0] in self.bans]:
                AWAY[name] = sys.modules.pop(name)
        sys.meta_path.insert(0, self)

    def allows(self, name: str) -> bool:
        first = name.partition(".")[0]
        return first in ALLOWED or first in self.own

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Find nothing, so that the others look; raise NotAllowed where nobody may."""
        first = name.partition(".")[0]
        if first in self.bans:
            raise NotAllowed(f"{first} may not be imported here: {IN_C}", name=name)
        if not self.allows(name):
            raise NotAllowed(f"there is no {first} to import here: {RULE}", name=name)
        return None


def put_away() -> None:
    """Put what only the grader may import out of reach by name.

    Before the fork, if there is one: to go through hundreds of modules in each child would copy the
    memory of them all.
    """
    if not AWAY:
        for name in [name for name in sys.modules if name.partition(".")[0] not in ALLOWED]:
            AWAY[name] = sys.modules.pop(name)


@contextmanager
def at_hand() -> Iterator[None]:
    """Bring back what was put away, for a library of ours that looks itself up by name."""
    sys.modules.update(AWAY)
    try:
        yield
    finally:
        for name in AWAY:
            sys.modules.pop(name, None)
