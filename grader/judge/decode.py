"""Decode answers: a check gets values of the right type, and finite ones, or it fails."""

import math
from dataclasses import dataclass
from typing import NoReturn

from grader.judge.failures import Broke, NotYet
from grader.protocol import BodyValue, ContactValue, Items, Ref, SpaceBody, SpaceValue, Value, Vec

Pair = tuple[float, float]
SHOWN = 4  # a list or tuple of up to so many items is listed in full


@dataclass(frozen=True)
class Thing:
    """An object that lives in the child: a body, a contact, a joint, a world or a space."""

    ref: int


class Decoder:
    """Turns answers into numbers and objects, or fails the check.

    `what` is a name of the answer, for the student.
    """

    def __init__(self) -> None:
        self.running = ""  # the experiment, for the line *We ran*
        self.failure: NotYet | Broke | None = None  # the first one, or the one that ended the check
        self.names: dict[int, str] = {}  # names of things, for the student
        self.surveys = False  # whether the check continues after a failure, to ask everything

    def ran(self, text: str) -> None:
        """Name the experiment, for the line *We ran*."""
        self.running = text

    def want(self, holds: bool, expected: str, got: str, meaning: str = "") -> None:
        """Fail the check unless `holds`, with the expected and the actual value."""
        if holds:
            return
        if self.surveys:
            self.remember(NotYet(self.running, expected, got, meaning))
        else:
            self.fail(expected, got, meaning)

    def fail(self, expected: str, got: str, meaning: str = "") -> NoReturn:
        """Fail the check at once, with the same arguments as `want`."""
        raise self.remember(NotYet(self.running, expected, got, meaning))

    def refuse(self, wanted: str, what: str, value: Value) -> NoReturn:
        """Fail the check because the answer is of the wrong kind."""
        got = self.describe(value)
        expected = wanted if what == "the answer" else f"{wanted} as {what}"
        self.fail(expected, got, f"{what[:1].upper()}{what[1:]} must be {wanted}; it is {got}.")

    def remember(self, failure: NotYet | Broke) -> NotYet | Broke:
        """Remember the first failure: hypothesis may run a check again and find others."""
        self.failure = self.failure or failure
        return failure

    # ------------------------------------------------------------ numbers

    def number(self, value: Value, what: str) -> float:
        """Return the value as a finite number."""
        if isinstance(value, bool) or not isinstance(value, int | float):
            self.refuse("a number", what, value)
        if not math.isfinite(value):
            self.fail(f"a finite number as {what}", f"{value}")
        return float(value)

    def pair(self, value: Value, what: str) -> Pair:
        """Return the value as two finite numbers."""
        if not isinstance(value, Vec):
            self.refuse("a pair of numbers", what, value)
        return self.number(value.x, what), self.number(value.y, what)

    def items(self, value: Value, what: str) -> list[Value]:
        """Return the value as a list; a pair of numbers counts as one of two."""
        if isinstance(value, Vec):
            return [value.x, value.y]
        if not isinstance(value, Items):
            self.refuse("a list or tuple", what, value)
        return value.items

    # ------------------------------------------------------------ objects

    def thing(self, value: Value, what: str = "an object") -> Thing:
        """Return the value as an object that lives in the child."""
        match value:
            case Ref(id=ref) | BodyValue(ref=ref) | ContactValue(ref=ref):
                pass
            case SpaceValue(ref=ref) | SpaceBody(ref=ref):
                pass
            case _:
                self.fail(what, self.describe(value))
        self.names[ref] = f"the {what.partition(' ')[2]}"
        return Thing(ref)

    def body(self, value: Value) -> BodyValue:
        """Return the value as a body with finite numbers."""
        if not isinstance(value, BodyValue):
            self.fail("a Body", self.describe(value))
        numbers = (*value.pos, *value.vel, value.angle, value.omega)
        if not all(map(math.isfinite, numbers)):
            self.fail("finite numbers in every body", f"{numbers}")
        return value

    def contact_or_none(self, value: Value) -> ContactValue | None:
        """Return the value as a Contact or None, with finite numbers."""
        if value is None or isinstance(value, ContactValue):
            if value is not None:
                self.pair(value.normal, "the normal")
                self.pair(value.point, "the point")
                self.number(value.depth, "the depth")
            return value
        self.refuse("a Contact or None", "the answer", value)

    def space(self, value: Value) -> SpaceValue:
        """Return the value as a pymunk Space, described."""
        if not isinstance(value, SpaceValue):
            self.fail("a pymunk Space", self.describe(value))
        return value

    def describe(self, value: Value) -> str:
        """Return an answer of the wrong kind in words, for the line *Got*."""
        match value:
            case None:
                return "None (is there a return missing?)"
            case Ref(kind=kind):
                return f"an object of type {kind}"
            case Items(items) if 0 < len(items) <= SHOWN:
                return f"({', '.join(map(in_brief, items))}){which_is_none(items)}"
            case Items():
                return f"a list or tuple of {len(value.items)}"
            case bool() | int() | float() | str():
                return f"{value!r}"[:200]
            case Vec(x, y):
                return f"the pair ({x:.6g}, {y:.6g})"
        return f"a {type(value).__name__.removesuffix('Value').lower()}"


def which_is_none(items: list[Value]) -> str:
    """Name the item that is None: `, of which the second is None`; empty if there is none."""
    names = ("first", "second", "third", "fourth")
    none = [name for name, each in zip(names, items, strict=False) if each is None]
    return f", of which the {none[0]} is None" if none else ""


def in_brief(value: Value) -> str:
    """Return an item of a list or tuple in words."""
    match value:
        case None:
            return "None"
        case bool() | int() | str():
            return f"{value!r}"[:40]
        case float():
            return f"{value:.6g}"
        case Vec(x, y):
            return f"({x:.6g}, {y:.6g})"
        case Ref(kind=kind):
            return f"a {kind}"[:40]
    return f"a {type(value).__name__.removesuffix('Value').lower()}"
