"""Find data that a submission keeps between calls, in its modules, functions and classes.

A call may leave data in a global name, an attribute of a function or class, or a default argument,
and the next answer may depend on it. The judge decides whether that is a mistake.
"""

import sys
from types import FunctionType, ModuleType
from typing import Any

import pygame
import pymunk

PLAIN = {float, int, bool, type(None)}
PAIRS = {pygame.Vector2, pymunk.Vec2d}
MAX_DEPTH = 3  # levels, such as lists in dicts in modules
MAX_ENTRIES = 40  # items of one list or dict


class Memory:
    """The data of a folder's modules now, to compare with their data later."""

    def __init__(self, folder: str) -> None:
        self.modules = {
            name: module
            for name, module in sys.modules.items()
            if type(module) is ModuleType and str(vars(module).get("__file__")).startswith(folder)
        }
        self.before = self.state()

    def state(self) -> dict[str, Any]:
        """Return the data of each name; functions and classes belong to their own file."""
        found: dict[str, Any] = {}
        for module in self.modules.values():
            for name, value in vars(module).items():
                if name.startswith("__") or type(value) is ModuleType:
                    continue
                if getattr(value, "__module__", module.__name__) == module.__name__:
                    found[f"{module.__name__}.{name}"] = content(value, MAX_DEPTH)
        return found

    def changed(self) -> list[str]:
        """Return the names with other data than before, and new names."""
        after = self.state()
        missing = object()
        return [name for name, value in after.items() if self.before.get(name, missing) != value]


def content(value: Any, depth: int) -> Any:
    """Return a value as plain data, `depth` levels deep.

    Looks at exact types alone, so that no code of the submission runs.
    """
    kind = type(value)
    if kind in PLAIN or kind is str:
        return value
    if kind in PAIRS:
        return tuple(value)
    if not depth:
        return kind.__name__
    if kind is FunctionType:
        return content([value.__defaults__, value.__kwdefaults__, vars(value)], depth)
    if kind is dict:
        value, kind = [*value.keys(), *value.values()], list
    if kind in (list, tuple, set, frozenset):
        return len(value), [content(each, depth - 1) for each in list(value)[:MAX_ENTRIES]]
    if isinstance(value, type):
        own = {name: each for name, each in vars(value).items() if not name.startswith("__")}
        return content(own, depth)
    return kind.__name__
