"""Hold the data of a replay: recorded runs, and two runs side by side as the page reads them."""

import math
from collections.abc import Iterable, Iterator
from typing import Any

from msgspec import Struct

from grader.protocol import (
    BodyLook,
    ContactValue,
    Items,
    Missing,
    Moment,
    Played,
    Raised,
    Reply,
    Returned,
    SpaceBody,
    SpaceValue,
    Value,
    Vec,
    cut,
)
from grader.text import digits, printable

MAX_ANSWER = 160  # characters
DRAWN = 8  # numbers of a contact on a page: all but its bodies

# A moment on a page: time, steps, changed bodies, contacts, rods, numbers of removed bodies.
PageMoment = list[Any]


class Mark(Struct, frozen=True, array_like=True):
    """An arm of a body, px from its centre, and the axis of an impulse at its end."""

    body: int  # its number
    x: float
    y: float
    axis_x: float
    axis_y: float


class Line(Struct, omit_defaults=True):
    """One request, its answer, and its recorded moments."""

    signature: str  # the request without numbers; two runs are compared while these are equal
    answer: str
    moments: list[Moment]
    is_setup: bool = False
    code: str = ""
    marks: list[Mark] = []
    counts_work: bool = False  # the check counts lines that run


class Run(Struct, omit_defaults=True):
    experiment: str
    lines: list[Line] = []
    looks: dict[int, BodyLook] = {}  # of the bodies by number
    names: dict[int, str] = {}
    curve: bool = False  # x over the time, without bodies


class LinePair(Struct, frozen=True):
    """One request in both runs, and its moments on the page."""

    code: str
    yours: str
    expected: str
    at: int  # its first moment
    marks: list[Mark] = []


class Scene(Struct, frozen=True):
    """A run and its counterpart, moment by moment."""

    experiment: str
    curve: bool
    names: dict[int, str]
    looks: dict[int, BodyLook]
    expected_looks: dict[int, BodyLook]
    lines: list[LinePair]
    yours: list[PageMoment]
    expected: list[PageMoment]  # shorter if the right run is not known


class Parting(Struct, frozen=True):
    """The first moment in which the runs differ, and the difference in words."""

    scene: int
    moment: int
    body: int  # its number, or 0
    words: str


class Replay(Struct, frozen=True):
    scenes: list[Scene]
    parting: Parting | None
    compared: bool  # the right run is known
    note: str = ""  # shown if the runs do not differ


def encode_moments(moments: Iterable[Moment]) -> Iterator[PageMoment]:
    """Yield each moment with its changes since the moment before."""
    bodies: dict[int, list[float]] = {}
    touches: Any = []
    rods: Any = []
    for moment in moments:
        rows = {
            row.number: [row.number, *map(round_number, numbers_of(row)[1:])]
            for row in moment.bodies
        }
        changed = [row for number, row in rows.items() if bodies.get(number) != row]
        gone = [number for number in bodies if number not in rows]
        new_touches = [
            [round_number(each) for each in numbers_of(row)[:DRAWN]] for row in moment.touches
        ]
        new_rods = [[round_number(each) for each in ends] for ends in moment.rods]
        yield [
            round_number(moment.time),
            moment.steps,
            changed,
            None if new_touches == touches else new_touches,
            None if new_rods == rods else new_rods,
            gone,
        ]
        bodies, touches, rods = rows, new_touches, new_rods


def numbers_of(row: Struct) -> list[float]:
    return [getattr(row, name) for name in row.__struct_fields__]


def round_number(value: float) -> float:
    """Round to six digits; infinity and NaN stay (JSON has null for them)."""
    return float(f"{value:.6g}") + 0.0 if math.isfinite(value) else value


def describe_body(look: BodyLook, number: str) -> str:
    """Name a body on the page: its kind, a number if any, and its mass."""
    corners = [len(shape.points) for shape in look.shapes]
    kind = "ball" if corners == [1] else "box" if corners == [4] else "body"
    weight = "static" if look.mass is None else f"{digits(look.mass)} kg"
    return f"{f'{kind} {number}'.strip()}, {weight}"


def describe_reply(reply: Reply) -> str:
    """Return an answer on one line, with the submission's words cut and cleaned."""
    match reply:
        case Returned(value):
            text = describe_value(value)
        case Raised(error, message):
            text = f"{error}: {message}"
        case Missing(what):
            text = what
        case Played(steps=steps, pictures=pictures):
            seen = f", {len(set(pictures))} different pictures" if pictures else ""
            text = f"{sum(steps)} steps{seen}"
        case _:
            text = ""
    return cut(printable(text[: 4 * MAX_ANSWER]), MAX_ANSWER)


def describe_value(value: Value) -> str:
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
                f"normal {describe_value(normal)}, depth {digits(depth)}, "
                f"point {describe_value(point)}"
            )
        case Items(items):
            return "[" + ", ".join(describe_value(each) for each in items[:4]) + "]"
        case SpaceValue(gravity=gravity):
            return f"a space with gravity {describe_value(gravity)}"
        case SpaceBody(mass=mass, moment=moment):
            turning = "infinite" if moment is None else digits(moment)
            return f"a body of mass {digits(mass)}, moment {turning}"
    return ""
