"""Two runs put together, frame by frame, and where they part."""

import math
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import NamedTuple

from grader.player.film import Both, Line, Parting, Replay, Scene, Take, numbers, thinned
from grader.protocol import BodyLook, BodyRow, Shot
from grader.words import about

VISIBLE = 0.5  # px, and px/s where nothing has moved yet
A_SHARE = 0.01  # of the fastest speed, where all are slow, and of a mass
ROUNDING = 1e-6  # of the fastest speed, and of a mass; px

Moment = tuple[Shot, Shot | None]  # yours, and what should be


class Eye(NamedTuple):
    """How much it takes to be seen."""

    place: float  # px
    speed: float  # px/s
    share: float  # of a mass


class Together(NamedTuple):
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
    rows = [list(together(mine, right)) for mine, right in takes]
    scenes = [scene(*pair, each) for pair, each in zip(takes, rows, strict=True)]
    eyes = (seen, seen_and_weighed, measured) if exact else (seen, seen_and_weighed)
    parting = None
    for eye in eyes:
        found = (
            first_parting(number, pair, each, eye(max(map(fastest, pair))))
            for number, (pair, each) in enumerate(zip(takes, rows, strict=True))
        )
        parting = parting or next(filter(None, found), None)
    return Replay(scenes, parting, any(each.expected for each in scenes))


def together(mine: Take, right: Take) -> Iterator[Together]:
    """Line beside line, until one of the runs asks something else."""
    known = True
    for line, other in zip_longest(mine.lines, right.lines[: len(mine.lines)]):
        known = known and other is not None and other.sign == line.sign
        beside = other if known else None
        count = max(len(line.shots), len(beside.shots) if beside and line.shots else 0)
        moments = [(at(line, n), at(beside, n) if beside else None) for n in range(count)]
        yield Together(line, beside, [(shot, right) for shot, right in moments if shot])


def at(line: Line, number: int) -> Shot | None:
    """A shot of a line; the last one stays when there are no more."""
    return line.shots[min(number, len(line.shots) - 1)] if line.shots else None


def scene(mine: Take, right: Take, rows: Sequence[Together]) -> Scene:
    lines: list[Both] = []
    moments: list[Moment] = []
    for row in rows:
        lines.append(Both(row.line.code, *row.answers, len(moments), len(row.moments)))
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


def seen(speed: float) -> Eye:
    """What a person sees where `speed` is the fastest, px/s."""
    return Eye(VISIBLE, min(VISIBLE, A_SHARE * speed), math.inf)


def seen_and_weighed(speed: float) -> Eye:
    return seen(speed)._replace(share=A_SHARE)


def measured(speed: float) -> Eye:
    """All that rounding does not explain."""
    return Eye(ROUNDING, max(ROUNDING * speed, 1e-12), ROUNDING)


def fastest(take: Take) -> float:
    """The highest speed of a body, or of its rim, px/s."""
    speeds = [0.0]
    for row in (row for line in take.lines for shot in line.shots for row in shot.bodies):
        rim = row.omega * reach(take.looks.get(row.number))
        speeds += [each for each in (math.hypot(row.vx, row.vy), abs(rim)) if math.isfinite(each)]
    return max(speeds)


def reach(look: BodyLook | None) -> float:
    """How far from its centre a turn of a body is seen, px."""
    return max((shape.radius for shape in look.shapes), default=0.0) if look else 0.0


def first_parting(
    number: int, takes: tuple[Take, Take], rows: Sequence[Together], eye: Eye
) -> Parting | None:
    """Where two takes differ for the first time: in a body, a rod, a contact, or an answer."""
    frame = 0
    for row in rows:
        for shot, other in row.moments:
            found = difference(shot, other, takes, eye) if other else None
            if found:
                return Parting(number, frame, *found)
            frame += 1
        yours, expected = row.answers
        if row.other and yours != expected:
            return Parting(number, max(frame - 1, 0), 0, f"{row.line.code} gives another answer")
    return None


def difference(
    shot: Shot, other: Shot, takes: tuple[Take, Take], eye: Eye
) -> tuple[int, str] | None:
    """The first body that is off, by its number, and in what; 0 for what is no body."""
    mine, right = takes
    expected = {row.number: row for row in other.bodies}
    for row in shot.bodies:
        name = mine.names.get(row.number, f"body {row.number}")
        wanted = expected.pop(row.number, None)
        if wanted is None:
            return row.number, f"{name} should not be there"
        look, right_look = mine.looks.get(row.number), right.looks.get(row.number)
        words = off(row, wanted, max(reach(look), 1.0), eye)
        if not words and look and right_look and weighs_otherwise(look, right_look, eye.share):
            words = "has another mass or moment"
        if words:
            return row.number, f"{name} {words}"
    for number in expected:
        return number, f"{right.names.get(number, f'body {number}')} is missing"
    for what, here, there in (
        ("rods", shot.rods, other.rods),
        ("contacts", shot.touches, other.touches),
    ):
        if len(here) != len(there):
            return 0, f"{len(here)} {what} instead of {len(there)}"
    if any(math.dist(*pair) > eye.place for pair in zip(shot.rods, other.rods, strict=True)):
        return 0, "a rod has its ends elsewhere"
    return None


def off(row: BodyRow, right: BodyRow, radius: float, eye: Eye) -> str:
    """How a body differs from the expected one, in words; empty if that cannot be seen."""
    if not all(map(math.isfinite, numbers(row))):
        return "is nowhere: its numbers are not finite"
    away = math.dist((row.x, row.y), (right.x, right.y))
    turned, spin = abs(row.angle - right.angle), abs(row.omega - right.omega)
    faster = math.dist((row.vx, row.vy), (right.vx, right.vy))
    if away > eye.place:
        return f"is {about(away)} px off"
    if turned * radius > eye.place:
        return f"is turned by {about(turned)} rad too much or too little"
    if faster > eye.speed:
        return f"has a velocity that is {about(faster)} px/s off"
    if spin * radius > eye.speed:
        return f"has a spin that is {about(spin)} rad/s off"
    return ""


def weighs_otherwise(mine: BodyLook, right: BodyLook, share: float) -> bool:
    pairs = ((mine.mass, right.mass), (mine.moment, right.moment))
    return any(
        (a is None) != (b is None)
        or (a is not None and b is not None and not math.isclose(a, b, rel_tol=share))
        for a, b in pairs
    )
