"""Explain Python's errors by their message and the text around the line."""

import pytest

from grader.judge.explain.error_words import explain_error

TEXT = """import math

from .shapes import cross

LIMIT = 8


class DistanceJoint:
    def __init__(self):
        self.k = 0.0

    def solve(self, other):
        total = other.k
        cross = cross(total, total)
        number = 0.5(total)
        max = 3
        least = max(1, 2)
        self.k()
        return Vector2(other)
"""


def explain(error: str, line: int, todo: str = "3") -> str:
    got = f"{error} (in mini_engine/joints.py, line {line}: {TEXT.splitlines()[line - 1].strip()})"
    return explain_error(got, lambda file: TEXT, todo)


@pytest.mark.parametrize(
    ("error", "line", "says"),
    [
        ("NameError: name 'k' is not defined", 13, "write self.k"),
        ("NameError: name 'totl' is not defined", 14, "Is total meant?"),
        ("UnboundLocalError: cannot access local variable 'cross' where", 14, "another name"),
        ("UnboundLocalError: cannot access local variable 'total' where", 13, "no value before"),
        ("UnboundLocalError: cannot access local variable 'total' where", 15, "line 13"),
        ("TypeError: 'float' object is not callable", 15, "Is a * missing"),
        ("TypeError: 'int' object is not callable", 17, "Line 16 gives max a value"),
        ("TypeError: 'float' object is not callable", 18, "self.k is a value"),
        ("AttributeError: 'tuple' object has no attribute 'x'", 13, "Vector2(x, y)"),
        ("AttributeError: 'Body' object has no attribute 'velocity'", 13, "Is vel meant?"),
        ("AttributeError: 'Body' object has no attribute 'cross'", 13, "cross(...)"),
        ("AttributeError: 'World' object has no attribute 'depth'", 13, "belongs to a Contact"),
        ("AttributeError: 'float' object has no attribute 'dot'", 13, "is a number"),
        ("TypeError: can't multiply sequence by non-int of type 'float'", 13, "Vector2(x, y)"),
        (
            "TypeError: unsupported operand type(s) for +: 'pygame.math.Vector2' and 'float'",
            13,
            "a",
        ),
        ("TypeError: 'float' object cannot be interpreted as an integer", 13, "int(...)"),
        ("AttributeError: module 'math' has no attribute 'exq'", 13, "Is exp meant?"),
        ("SystemExit: ", 13, "return"),
        ("ValueError: nobody knows this one", 13, ""),
    ],
)
def test_an_error_is_explained(error: str, line: int, says: str):
    words = explain(error, line)
    assert says in words and bool(says) == bool(words)


def test_a_name_that_the_stub_set_must_get_a_value():
    assert "must give it a value" in explain("NameError: name 'keep_vel' is not defined", 13, "5")
    assert "must give it a value" not in explain(
        "NameError: name 'keep_vel' is not defined", 13, "3"
    )


def test_an_error_outside_of_their_files_is_read_by_its_message_alone():
    assert explain_error("EOFError: EOF when reading a line", lambda file: "", "3").startswith("in")
    assert explain_error("a sentence of ours", lambda file: "", "3") == ""


SPACE = """import pymunk


def add_pendulum(space):
    axis = pymunk.Vec2d(1, 0)
    self.axis = 3
    total = axis.normalize_ip()
    a_new = a_nw + 1
    best = min(total)
    joint = pymunk.PinJoint(space)

    def begin(arbiter, space, data):
        return True

    space.on_collision(1, 2, begin=begin())
    total.clamp(1)
    print(self.axis)
    best /= total
    cells[total].append(best)
    found = cells[best]
    return None ** 2 + total
"""


NO_PAIR = "TypeError: initializer for ctype 'struct cpVect' must be a list, not pygame.math.Vector2"
UNSUPPORTED = "TypeError: unsupported operand type(s) for"


@pytest.mark.parametrize(
    ("error", "line", "says"),
    [
        ("NameError: name 'static_body' is not defined", 5, "write space.static_body"),
        ("NameError: name 'a_nw' is not defined", 8, "misspelt"),
        ("AttributeError: 'Space' object has no attribute 'static'", 5, "Is static_body meant?"),
        ("AttributeError: 'Space' object has no attribute 'add_constraint'", 5, "Is add meant?"),
        ("AttributeError: 'Space' object has no attribute 'add_collision_handler'", 5, "pymunk 7"),
        ("AttributeError: module 'pymunk' has no attribute 'moment_for_disc'", 5, "for_circle"),
        ("AttributeError: 'SpringJoint' object has no attribute 'axis'", 17, "without self"),
        ("AttributeError: 'Box' object has no attribute 'width'", 5, "It has half"),
        ("AttributeError: 'float' object has no attribute 'clamp'", 16, "write max(low, min("),
        ("AttributeError: 'pygame.math.Vector2' object has no attribute 'clamp'", 16, "of x and y"),
        ("AttributeError: type object 'Body' has no attribute 'moment_for_box'", 5, "pymunk.m"),
        ("NameError: name 'pygame' is not defined", 5, "add `import pygame` to pymunk_scene.py"),
        ("NameError: name 'np' is not defined", 5, "add `import numpy as np`"),
        ("NameError: name 'defaultdict' is not defined", 5, "from collections import defaultdict"),
        ("NameError: name 'World' is not defined", 5, "World is in mini_engine/world.py"),
        ("KeyError: (0, 1)", 19, "cells.setdefault(key, [])"),
        ("KeyError: 3", 20, "cells.get(key, [])"),
        ("KeyError: 3", 5, "if key in"),
        ("ZeroDivisionError: float division by zero", 18, "total is 0 there: line 18"),
        (NO_PAIR, 5, "as a pair"),
        ("AttributeError: can't set attribute", 5, "give the whole a new pair"),
        ("AttributeError: 'NoneType' object has no attribute 'x'", 7, "use normalize()"),
        ("TypeError: 'float' object is not iterable", 9, "min() gets one number"),
        ("TypeError: PinJoint.__init__() missing 3 required", 10, "PinJoint(a, b, anchor_a"),
        ("TypeError: add_pendulum.<locals>.begin() missing 3 required", 15, "without brackets"),
        (f"{UNSUPPORTED} -: 'float' and 'pygame.math.Vector2'", 5, "a number is needed"),
        (f"{UNSUPPORTED} -=: 'pygame.math.Vector2' and 'float'", 5, "the number by a vector"),
        (f"{UNSUPPORTED} ** or pow(): 'pygame.math.Vector2' and 'int'", 5, "square a number"),
    ],
)
def test_an_error_names_what_it_is_due_to(error: str, line: int, says: str):
    got = f"{error} (in pymunk_scene.py, line {line}: {SPACE.splitlines()[line - 1].strip()})"
    assert says in explain_error(got, lambda file: SPACE, "7c")
