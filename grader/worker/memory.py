"""Find what a submission keeps between calls: data in its modules, functions and classes.

A global name, a function's own attribute, a default argument that is a list, an attribute of a
class: what a call leaves there can decide on the answer to the next. Whether that is a mistake is
not told from here.
"""

import sys
from types import FunctionType, ModuleType
from typing import Any

import pygame
import pymunk

PLAIN = {float, int, bool, type(None)}
PAIRS = {pygame.Vector2, pymunk.Vec2d}
DEEP = 3  # lists in dicts in modules
LONG = 40  # entries of one of them


class Memory:
    """The data of a folder's modules as it is now, to be compared with what it is later."""

    def __init__(self, folder: str) -> None:
        self.modules = {
            name: module
            for name, module in sys.modules.items()
            if type(module) is ModuleType and str(vars(module).get("__file__")).startswith(folder)
        }
        self.before = self.state()

    def state(self) -> dict[str, Any]:
        """Return what each name holds; functions and classes count under the file they are written
        in.
        """
        found: dict[str, Any] = {}
        for module in self.modules.values():
            for name, value in vars(module).items():
                if name.startswith("__") or type(value) is ModuleType:
                    continue
                if getattr(value, "__module__", module.__name__) == module.__name__:
                    found[f"{module.__name__}.{name}"] = content(value, DEEP)
        return found

    def changed(self) -> list[str]:
        """Return the names that hold something else by now, or are new."""
        after = self.state()
        missing = object()
        return [name for name, value in after.items() if self.before.get(name, missing) != value]


def content(value: Any, deep: int) -> Any:
    """Return a value as plain data: numbers and texts as they are, and what holds some by what it
    holds.

    Exact types alone: nothing of the submission is to run meanwhile.
    """
    kind = type(value)
    if kind in PLAIN or kind is str:
        return value
    if kind in PAIRS:
        return tuple(value)
    if not deep:
        return kind.__name__
    if kind is FunctionType:
        return content([value.__defaults__, value.__kwdefaults__, vars(value)], deep)
    if kind is dict:
        value, kind = [*value.keys(), *value.values()], list
    if kind in (list, tuple, set, frozenset):
        return len(value), [content(each, deep - 1) for each in list(value)[:LONG]]
    if isinstance(value, type):
        own = {name: each for name, each in vars(value).items() if not name.startswith("__")}
        return content(own, deep)
    return kind.__name__
