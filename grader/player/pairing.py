"""Two runs compared frame by frame, and the first frame in which they differ."""

import math
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import NamedTuple

from grader.player.film import Both, Line, Parting, Replay, Scene, Take, numbers, thinned
from grader.protocol import BodyLook, BodyRow, Shot
from grader.text import about

VISIBLE = 0.5  # px, and px/s where nothing has moved yet
A_SHARE = 0.01  # of the fastest speed, where all are slow, and of a mass
ROUNDING = 1e-6  # of the fastest speed, and of a mass; px

COUNTED = "Nothing is off to be seen: what is asked here is how much work it takes."

Moment = tuple[Shot, Shot | None]  # yours, and what should be


class Tolerance(NamedTuple):
    """How far two runs may differ and still count as equal."""

    place: float  # px
    speed: float  # px/s
    share: float  # of a mass


class PairedRequest(NamedTuple):
    """A request in both runs; the other is None where the right run is not known."""

    line: Line
    other: Line | None
    moments: list[Moment]

    @property
    def answers(self) -> tuple[str, str]:
        pair = (self.line.answer, self.other.answer if self.other else "")
        return ("", "") if pair == ("None", "None") else pair


def replay(yours: Sequence[Take], expected: Sequence[Take], exact: bool = True) -> Replay:
    """Both runs; `expected` may be empty or end early, and has few digits where not `exact`."""
    takes = [
        (mine, right or Take("")) for mine, right in zip_longest(yours, expected[: len(yours)])
    ]
    rows = [list(paired_requests(mine, right)) for mine, right in takes]
    scenes = [scene(*pair, each) for pair, each in zip(takes, rows, strict=True)]
    tolerances = (
        (visible, visible_or_heavier, beyond_rounding) if exact else (visible, visible_or_heavier)
    )
    parting = None
    for tolerance_for in tolerances:
        found = (
            first_difference(number, pair, each, tolerance_for(max(map(fastest, pair))))
            for number, (pair, each) in enumerate(zip(takes, rows, strict=True))
        )
        parting = parting or next(filter(None, found), None)
    counted = any(line.counted for mine in yours for line in mine.lines)
    told = COUNTED if counted and parting is None else ""
    return Replay(scenes, parting, any(each.expected for each in scenes), told)


def paired_requests(mine: Take, right: Take) -> Iterator[PairedRequest]:
    """Each request beside its counterpart, until the two runs ask something different."""
    known = True
    for line, other in zip_longest(mine.lines, right.lines[: len(mine.lines)]):
        known = known and other is not None and other.sign == line.sign
        beside = other if known else None
        count = max(len(line.shots), len(beside.shots) if beside and line.shots else 0)
        moments = [(shot_at(line, n), shot_at(beside, n) if beside else None) for n in range(count)]
        yield PairedRequest(line, beside, [(shot, right) for shot, right in moments if shot])


def shot_at(line: Line, number: int) -> Shot | None:
    """A shot of a line; the last one stays when there are no more."""
    return line.shots[min(number, len(line.shots) - 1)] if line.shots else None


def scene(mine: Take, right: Take, rows: Sequence[PairedRequest]) -> Scene:
    lines: list[Both] = []
    moments: list[Moment] = []
    for row in rows:
        place = len(moments), len(row.moments)
        lines.append(Both(row.line.code, *row.answers, *place, row.line.marks))
        moments += row.moments
    return Scene(
        mine.said,
        mine.curve,
        mine.names,
        mine.looks,
        right.looks,
        lines,
        list(thinned(shot for shot, _ in moments)),
        list(thinned(shot for _, shot in moments if shot is not None)),
    )


# ---------------------------------------------------------------- where they part


def visible(speed: float) -> Tolerance:
    """A person sees no smaller difference where `speed` (px/s) is the fastest."""
    return Tolerance(VISIBLE, min(VISIBLE, A_SHARE * speed), math.inf)


def visible_or_heavier(speed: float) -> Tolerance:
    """The same, and a difference in mass, which shows only later."""
    return visible(speed)._replace(share=A_SHARE)


def beyond_rounding(speed: float) -> Tolerance:
    """Rounding explains no larger difference."""
    return Tolerance(ROUNDING, max(ROUNDING * speed, 1e-12), ROUNDING)


def fastest(take: Take) -> float:
    """The highest speed of a body, or of its rim, px/s."""
    speeds = [0.0]
    for row in (row for line in take.lines for shot in line.shots for row in shot.bodies):
        rim = row.omega * reach(take.looks.get(row.number))
        speeds += [each for each in (math.hypot(row.vx, row.vy), abs(rim)) if math.isfinite(each)]
    return max(speeds)


def reach(look: BodyLook | None) -> float:
    """The largest radius of a body's shapes, px: a turn moves that point the most."""
    return max((shape.radius for shape in look.shapes), default=0.0) if look else 0.0


def first_difference(
    number: int, takes: tuple[Take, Take], rows: Sequence[PairedRequest], tolerance: Tolerance
) -> Parting | None:
    """Where two takes differ for the first time: in a body, a rod, a contact, or an answer."""
    frame = 0
    for row in rows:
        for shot, other in row.moments:
            found = shot_difference(shot, other, takes, tolerance) if other else None
            if found:
                return Parting(number, frame, *found)
            frame += 1
        yours, expected = row.answers
        if row.other and yours != expected:
            return Parting(number, max(frame - 1, 0), 0, f"{row.line.code} gives another answer")
    return None


def shot_difference(
    shot: Shot, other: Shot, takes: tuple[Take, Take], tolerance: Tolerance
) -> tuple[int, str] | None:
    """The number of the first body that differs, and how; 0 for a rod or contact."""
    mine, right = takes
    expected = {row.number: row for row in other.bodies}
    for row in shot.bodies:
        name = name_of(row.number, takes)
        wanted = expected.pop(row.number, None)
        if wanted is None:
            return row.number, f"{name} should not be there"
        look, right_look = mine.looks.get(row.number), right.looks.get(row.number)
        words = body_difference(row, wanted, max(reach(look), 1.0), tolerance)
        if not words and look and right_look and mass_differs(look, right_look, tolerance.share):
            words = "has another mass or moment"
        if words:
            return row.number, f"{name} {words}"
    for number in expected:
        return number, f"{name_of(number, takes)} is missing"
    for what, here, there in (
        ("rods", shot.rods, other.rods),
        ("contacts", shot.touches, other.touches),
    ):
        if len(here) != len(there):
            return 0, f"{len(here)} {what} instead of {len(there)}"
    if any(math.dist(*pair) > tolerance.place for pair in zip(shot.rods, other.rods, strict=True)):
        return 0, "a rod has its ends elsewhere"
    return None


def name_of(number: int, takes: tuple[Take, Take]) -> str:
    """What a body is called: on the page, the names of your run are those of its script."""
    mine, right = takes
    return mine.names.get(number) or right.names.get(number, f"body {number}")


def body_difference(row: BodyRow, right: BodyRow, radius: float, tolerance: Tolerance) -> str:
    """How a body differs from the expected one, in words; empty if it does not."""
    if not all(map(math.isfinite, numbers(row))):
        return "is nowhere: its numbers are not finite"
    away = math.dist((row.x, row.y), (right.x, right.y))
    turned, spin = abs(row.angle - right.angle), abs(row.omega - right.omega)
    faster = math.dist((row.vx, row.vy), (right.vx, right.vy))
    if away > tolerance.place:
        return f"is {about(away)} px off"
    if turned * radius > tolerance.place:
        return f"is turned by {about(turned)} rad too much or too little"
    if faster > tolerance.speed:
        return f"has a velocity that is {about(faster)} px/s off"
    if spin * radius > tolerance.speed:
        return f"has a spin that is {about(spin)} rad/s off"
    return ""


def mass_differs(mine: BodyLook, right: BodyLook, share: float) -> bool:
    pairs = ((mine.mass, right.mass), (mine.moment, right.moment))
    return any(
        (a is None) != (b is None)
        or (a is not None and b is not None and not math.isclose(a, b, rel_tol=share))
        for a, b in pairs
    )
