"""Compare the bodies, contacts, joints, worlds and constants before and after a call.

A function may change only what its docstring names. The child lists the changes; the
judge decides which are allowed.
"""

import math
import sys
from collections.abc import Iterable
from functools import cache
from types import ModuleType
from typing import Any

from grader.protocol import Change
from grader.worker.memory import PAIRS, PLAIN
from grader.worker.subject import Subject

LATEST = 12  # newest objects that are compared besides the arguments of a call
CONSTANTS = (  # of the lesson
    *("WIDTH", "HEIGHT", "STEP", "MAX_STEPS", "ITERATIONS"),
    *("BETA", "SLOP", "RESTING_SPEED", "MAX_BALLS", "MAX_FRAME"),
    *("SLOW", "SLEEP_AFTER", "WAKING", "CELL"),
    *("OMEGA", "X0", "DT", "SECONDS"),
)
FIELDS = {  # of pymunk's and the lesson's objects, by the attribute that identifies the type
    "angular_velocity": (
        *("position", "velocity", "angle", "angular_velocity"),
        *("mass", "moment", "force", "torque", "body_type"),
    ),
    "collision_slop": (
        *("gravity", "damping", "iterations", "sleep_time_threshold", "idle_speed_threshold"),
        *("collision_slop", "collision_bias", "bodies", "shapes", "constraints"),
    ),
    "inv_mass": (
        *("pos", "vel", "angle", "omega", "inv_mass", "inv_inertia"),
        *("restitution", "friction", "shape"),
    ),
    "normal": ("a", "b", "normal", "depth", "point", "jn", "jt", "target"),
    "bias": ("a", "b", "length", "axis", "bias", "k"),
    "length": ("a", "b", "length", "stiffness", "damping"),
    "bodies": (
        *("gravity", "linear_damping", "angular_damping", "iterations"),
        *("bodies", "joints", "contacts", "springs", "sleeping", "grid"),
    ),
}
Numbers = tuple[Any, ...]


class Frame:
    """The state around a call, recorded before it."""

    def __init__(self, subject: Subject, refs: Iterable[int], arguments: list[Any]) -> None:
        self.subject = subject
        self.refs = list(dict.fromkeys([*refs, *list(subject.objects)[-LATEST:]]))
        self.arguments = arguments
        self.constants = own_constants(str(subject.folder), len(sys.modules))
        self.before = self.state()

    def state(self) -> dict[tuple[int, str], Numbers]:
        found: dict[tuple[int, str], Numbers] = {}
        for ref in self.refs:
            thing = self.subject.objects[ref]
            for name in fields_of(thing):
                value = getattr(thing, name, None)
                found[ref, name] = size_of(value) if name == "shape" else numbers_in(value)
        for number, argument in enumerate(self.arguments, 1):
            if not isinstance(argument, int | float | str | None):
                found[-number, ""] = numbers_in(argument)
        for name, places in self.constants:
            found[0, name] = tuple([names.get(name) for names in places])
        return found

    def changes(self) -> list[Change]:
        """Return changes since `before`."""
        after = self.state()
        if after == self.before:  # the usual case
            return []
        return [
            Change(ref, name)
            for (ref, name), before in self.before.items()
            if not is_close(before, after.get((ref, name), ()))
        ]


@cache
def own_constants(folder: str, loaded: int) -> list[tuple[str, list[dict[str, Any]]]]:
    """Return the constants of a folder's modules, each with the namespaces that hold it.

    `loaded`, the number of modules, renews the cache when a module was imported.
    """
    found = (vars(module) for module in list(sys.modules.values()) if type(module) is ModuleType)
    own = [names for names in found if str(names.get("__file__")).startswith(folder)]
    places = ((name, [names for names in own if name in names]) for name in CONSTANTS)
    return [(name, modules) for name, modules in places if modules]


def fields_of(thing: Any) -> tuple[str, ...]:
    """Return the names of the fields to compare in an object; none for an unknown type."""
    for mark, fields in FIELDS.items():
        if hasattr(thing, mark):
            return fields
    return ()


def size_of(shape: Any) -> Numbers:
    return *numbers_in(getattr(shape, "radius", 0)), *numbers_in(getattr(shape, "half", 0))


def numbers_in(value: Any) -> Numbers:
    """Return a field as numbers; objects as their identities."""
    if type(value) in PLAIN:
        return (value,)
    if type(value) in PAIRS:
        return tuple(value)
    for meaning in (float, id):  # a pair of numbers, a list or view of bodies
        try:
            return tuple(map(meaning, value))
        except (TypeError, ValueError):
            continue
    return (id(value),)


def is_close(before: Numbers, after: Numbers) -> bool:
    """Return whether both are equal up to rounding: a function may normalise a normal again."""
    return before == after or (
        len(before) == len(after)
        and all(
            isinstance(a, float)
            and isinstance(b, float)
            and math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9)
            for a, b in zip(before, after, strict=True)
        )
    )
