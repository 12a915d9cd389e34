"""Read the objects of a submission as plain numbers.

No value is trusted: a submission may return a subclass of float with false comparisons, or a body
without a field. So every value is rebuilt from the built-in types.
"""

import math
import numbers
from typing import Any

import pygame
import pymunk

from grader.protocol import MAX_NAME, Vec, cut

LARGEST_INT = 2**53

Ends = tuple[float, float, float, float]  # x, y, x, y; px


class ContractError(Exception):
    """The submission lacks something that the lab sheet asks for, or has it in another type.

    The message is for the student.
    """


def type_name(thing: Any) -> str:
    """Return the name of a thing's type; a submission may have given it any name."""
    return cut(type(thing).__name__, MAX_NAME)


def describe(value: Any) -> str:
    """Describe a value in a message; its repr() would run the submission's own code."""
    return "None" if value is None else f"of type {type_name(value)}"


def field(thing: Any, name: str) -> Any:
    """Return an attribute. Raises ContractError if it is missing."""
    try:
        return getattr(thing, name)
    except AttributeError:
        raise ContractError(f"{type_name(thing)} has no {name}") from None


def field_number(thing: Any, name: str) -> float:
    """Return an attribute as a number."""
    value = field(thing, name)
    if type(value) is float:  # the usual case, which takes most of a child's time
        return value
    return as_number(value, f"{type_name(thing)}.{name}")


def field_pair(thing: Any, name: str) -> Vec:
    """Return an attribute as a pair of numbers."""
    value = field(thing, name)
    pair = as_pair(value)
    if pair is None:
        raise ContractError(
            f"{type_name(thing)}.{name} is {describe(value)}; expected a Vector2 or a pair"
        )
    return pair


def as_number(value: Any, what: str) -> float:
    """Return a true int or float. Raises ContractError for anything else; a bool is no number.

    `int.__int__` and `float.__float__` read the value itself: a subclass may override both.
    """
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise ContractError(f"{what} is {describe(value)}; expected a number")
    if isinstance(value, int) and abs(int.__int__(value)) <= LARGEST_INT:
        return int.__int__(value)
    try:
        return float.__float__(value) if isinstance(value, float) else float(value)
    except OverflowError:
        return math.inf


def as_pair(value: Any) -> Vec | None:
    """Return a pair of numbers from any sequence of two; None for anything else."""
    if type(value) is pygame.Vector2:
        return Vec(value.x, value.y)
    try:
        if isinstance(value, str | bytes) or len(value) != 2:
            return None
        x, y = value
        return Vec(as_number(x, "x"), as_number(y, "y"))
    except Exception:
        return None


# ---------------------------------------------------------------- bodies of both engines


def read_state(body: Any) -> list[float]:
    """Return x, y, vx, vy, angle, omega of a body of the lesson's engine or of pymunk."""
    if isinstance(body, pymunk.Body):
        return [*body.position, *body.velocity, body.angle, body.angular_velocity]
    pos, vel = field_pair(body, "pos"), field_pair(body, "vel")
    return [pos.x, pos.y, vel.x, vel.y, field_number(body, "angle"), field_number(body, "omega")]


def read_ends(joint: Any) -> Ends:
    """Return the two ends of a rod or spring of either engine, px."""
    if isinstance(joint, pymunk.constraints.Constraint):
        start = joint.a.local_to_world(joint.anchor_a)
        end = joint.b.local_to_world(joint.anchor_b)
        return start.x, start.y, end.x, end.y
    a, b = field_pair(field(joint, "a"), "pos"), field_pair(field(joint, "b"), "pos")
    return a.x, a.y, b.x, b.y


def shape_order(shape: pymunk.Shape) -> tuple[float, float]:
    """Return the key that sorts shapes from left to right, then upwards."""
    box = shape.cache_bb()
    return box.left, box.bottom
