"""What a replay is made of: takes, and the frames of two runs as its page reads them."""

import math
from collections.abc import Iterable, Iterator
from typing import Any

from msgspec import Struct

from grader.protocol import (
    BodyLook,
    BodyRow,
    ContactValue,
    Items,
    Missing,
    Played,
    Raised,
    Reply,
    Returned,
    Shot,
    SpaceBody,
    SpaceValue,
    Value,
    Vec,
)
from grader.text import digits, printable

MAX_ANSWER = 160  # characters

Frame = list[Any]  # as the page reads it: time, steps, bodies that changed, touches, rods, gone


class Mark(Struct, frozen=True, array_like=True):
    """An arm of a body and the axis along which an impulse acts at its end; px from its centre."""

    body: int  # its number
    x: float
    y: float
    axis_x: float
    axis_y: float


class Line(Struct, frozen=True, omit_defaults=True):
    """One request: what it was, what came back, and what was to be seen then."""

    sign: str  # its numbers aside; the two runs go together as far as these are equal
    answer: str
    shots: list[Shot]
    sets_up: bool = False  # puts something in its place
    code: str = ""
    marks: list[Mark] = []
    counted: bool = False  # what was asked is how many lines run


class Take(Struct, omit_defaults=True):
    """What ran from one scene, or one process, to the next."""

    said: str
    lines: list[Line] = []
    looks: dict[int, BodyLook] = {}  # of the bodies by number
    names: dict[int, str] = {}
    curve: bool = False  # no bodies, but an x over the time


class Both(Struct, frozen=True):
    """One request in both runs, and the frames in which it is on the screen."""

    code: str
    yours: str
    expected: str
    at: int  # its first frame
    count: int
    marks: list[Mark] = []


class Scene(Struct, frozen=True):
    """A take and its counterpart, frame by frame."""

    said: str
    curve: bool
    names: dict[int, str]
    looks: dict[int, BodyLook]
    expected_looks: dict[int, BodyLook]
    lines: list[Both]
    yours: list[Frame]
    expected: list[Frame]  # shorter where the right run is not known


class Parting(Struct, frozen=True):
    """The first frame in which the runs differ visibly, and in what."""

    scene: int
    frame: int
    body: int  # its number, or 0
    words: str


class Replay(Struct, frozen=True):
    scenes: list[Scene]
    parting: Parting | None
    compared: bool  # whether any of it is held against the right run
    told: str = ""  # in place of what is said of the right run


# ---------------------------------------------------------------- frames


def thinned(shots: Iterable[Shot]) -> Iterator[Frame]:
    """Each frame with what changed since the one before, and who left."""
    bodies: dict[int, list[float]] = {}
    touches: Any = []
    rods: Any = []
    for shot in shots:
        rows = {row.number: rounded(row) for row in shot.bodies}
        changed = [row for number, row in rows.items() if bodies.get(number) != row]
        gone = [number for number in bodies if number not in rows]
        new_touches = [[short(each) for each in numbers(row)] for row in shot.touches]
        new_rods = [[short(each) for each in ends] for ends in shot.rods]
        yield [
            short(shot.time),
            shot.steps,
            changed,
            None if new_touches == touches else new_touches,
            None if new_rods == rods else new_rods,
            gone,
        ]
        bodies, touches, rods = rows, new_touches, new_rods


def rounded(row: BodyRow) -> list[float]:
    return [row.number, *(short(each) for each in numbers(row)[1:])]


def numbers(row: Struct) -> list[float]:
    return [getattr(row, name) for name in row.__struct_fields__]


def short(value: float) -> float:
    """Six digits; what is no number stays none (JSON has null for it)."""
    return float(f"{value:.6g}") + 0.0 if math.isfinite(value) else value


# ---------------------------------------------------------------- in words


def called(look: BodyLook, number: str) -> str:
    """What a body is called on the page: what it is, a number if any, and what it weighs."""
    corners = [len(shape.points) for shape in look.shapes]
    kind = "ball" if corners == [1] else "box" if corners == [4] else "body"
    weight = "static" if look.mass is None else f"{digits(look.mass)} kg"
    return f"{f'{kind} {number}'.strip()}, {weight}"


def in_words(reply: Reply) -> str:
    """An answer on one line; a submission's words in it are cut and lose what is unprintable."""
    match reply:
        case Returned(value):
            text = value_in_words(value)
        case Raised(error, message):
            text = f"{error}: {message}"
        case Missing(what):
            text = what
        case Played(steps=steps, pictures=pictures):
            seen = f", {len(set(pictures))} different pictures" if pictures else ""
            text = f"{sum(steps)} steps{seen}"
        case _:
            text = ""
    line = printable(text[: 4 * MAX_ANSWER])
    return line if len(line) <= MAX_ANSWER else line[: MAX_ANSWER - 1] + "…"


def value_in_words(value: Value) -> str:
    match value:
        case bool() | None:
            return str(value)
        case int() | float():
            return digits(value)
        case str():
            return repr(value)
        case Vec(x, y):
            return f"({digits(x)}, {digits(y)})"
        case ContactValue(normal=normal, depth=depth, point=point):
            return (
                f"normal {value_in_words(normal)}, depth {digits(depth)}, "
                f"point {value_in_words(point)}"
            )
        case Items(items):
            return "[" + ", ".join(value_in_words(each) for each in items[:4]) + "]"
        case SpaceValue(gravity=gravity):
            return f"a space with gravity {value_in_words(gravity)}"
        case SpaceBody(mass=mass, moment=moment):
            turning = "infinite" if moment is None else digits(moment)
            return f"a body of mass {digits(mass)}, moment {turning}"
    return ""
