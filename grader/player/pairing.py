"""Compare two runs moment by moment, and find the first one in which they differ."""

import math
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import NamedTuple

from grader.player.runs import (
    Line,
    LinePair,
    Parting,
    Replay,
    Run,
    Scene,
    encode_moments,
    numbers_of,
)
from grader.protocol import BodyLook, BodyRow, Moment
from grader.text import format_rough

VISIBLE = 0.5  # px or px/s
A_SHARE = 0.01  # share of the highest speed, if smaller, and of a mass
ROUNDING = 1e-6  # px; share of the highest speed, and of a mass

COUNTED = "There is no visible difference: this check counts work."

MomentPair = tuple[Moment, Moment | None]  # yours and expected


class Tolerance(NamedTuple):
    """The largest differences at which two runs still count as equal."""

    distance: float  # px
    speed: float  # px/s
    share: float  # of a mass


class PairedRequest(NamedTuple):
    """A request in both runs; the right run's is None if that run is not known."""

    line: Line
    other: Line | None
    pairs: list[MomentPair]

    @property
    def answers(self) -> tuple[str, str]:
        pair = (self.line.answer, self.other.answer if self.other else "")
        return ("", "") if pair == ("None", "None") else pair


def pair_runs(yours: Sequence[Run], expected: Sequence[Run], exact: bool = True) -> Replay:
    """Return the replay of both runs; `expected` may be shorter, and is rounded if not `exact`."""
    runs = [(one, other or Run("")) for one, other in zip_longest(yours, expected[: len(yours)])]
    rows = [list(pair_requests(*pair)) for pair in runs]
    scenes = [make_scene(*pair, each) for pair, each in zip(runs, rows, strict=True)]
    fastest = [max(map(find_fastest, pair)) for pair in runs]
    parting = None
    for level in range(3 if exact else 2):
        found = (
            find_difference(number, pair, each, list_tolerances(speed)[level])
            for number, (pair, each, speed) in enumerate(zip(runs, rows, fastest, strict=True))
        )
        parting = parting or next(filter(None, found), None)
    counted = any(line.counts_work for run in yours for line in run.lines)
    note = COUNTED if counted and parting is None else ""
    return Replay(scenes, parting, any(each.expected for each in scenes), note)


def pair_requests(run: Run, other_run: Run) -> Iterator[PairedRequest]:
    """Yield each request beside its counterpart, as long as both runs make the same requests."""
    known = True
    for line, other in zip_longest(run.lines, other_run.lines[: len(run.lines)]):
        known = known and other is not None and other.signature == line.signature
        beside = other if known else None
        count = max(len(line.moments), len(beside.moments) if beside and line.moments else 0)
        pairs = [
            (moment_at(line, n), moment_at(beside, n) if beside else None) for n in range(count)
        ]
        yield PairedRequest(line, beside, [(moment, right) for moment, right in pairs if moment])


def moment_at(line: Line, number: int) -> Moment | None:
    """Return a line's nth moment, or its last."""
    return line.moments[min(number, len(line.moments) - 1)] if line.moments else None


def make_scene(yours: Run, expected: Run, rows: Sequence[PairedRequest]) -> Scene:
    lines: list[LinePair] = []
    pairs: list[MomentPair] = []
    for row in rows:
        lines.append(LinePair(row.line.code, *row.answers, len(pairs), row.line.marks))
        pairs += row.pairs
    return Scene(
        yours.experiment,
        yours.curve,
        yours.names,
        yours.looks,
        expected.looks,
        lines,
        list(encode_moments(moment for moment, _ in pairs)),
        list(encode_moments(moment for _, moment in pairs if moment is not None)),
    )


# ---------------------------------------------------------------- the first difference


def list_tolerances(speed: float) -> list[Tolerance]:
    """Return tolerances: for visible differences, for masses as well, and for rounding.

    The effect of another mass is visible only later. `speed` is the highest of both runs, px/s.
    """
    visible = Tolerance(VISIBLE, min(VISIBLE, A_SHARE * speed), math.inf)
    rounding = Tolerance(ROUNDING, max(ROUNDING * speed, 1e-12), ROUNDING)
    return [visible, visible._replace(share=A_SHARE), rounding]


def find_fastest(run: Run) -> float:
    """Return the highest speed of a body or its rim, px/s."""
    speeds = [0.0]
    for row in (row for line in run.lines for moment in line.moments for row in moment.bodies):
        rim = row.omega * find_reach(run.looks.get(row.number))
        speeds += [each for each in (math.hypot(row.vx, row.vy), abs(rim)) if math.isfinite(each)]
    return max(speeds)


def find_reach(look: BodyLook | None) -> float:
    """Return the largest radius of a body's shapes, px."""
    return max((shape.radius for shape in look.shapes), default=0.0) if look else 0.0


def find_difference(
    number: int, runs: tuple[Run, Run], rows: Sequence[PairedRequest], tolerance: Tolerance
) -> Parting | None:
    """Return the first difference of two runs: in a body, a rod, a contact, or an answer."""
    at = 0
    for row in rows:
        for moment, other in row.pairs:
            found = compare_moments(moment, other, runs, tolerance) if other else None
            if found:
                return Parting(number, at, *found)
            at += 1
        yours, expected = row.answers
        if row.other and yours != expected:
            return Parting(number, max(at - 1, 0), 0, f"{row.line.code} gives another answer")
    return None


def compare_moments(
    moment: Moment, other: Moment, runs: tuple[Run, Run], tolerance: Tolerance
) -> tuple[int, str] | None:
    """Return the number of the first body that differs, and how; 0 for a rod or contact."""
    yours, right = runs
    expected = {row.number: row for row in other.bodies}
    for row in moment.bodies:
        name = name_of(row.number, runs)
        wanted = expected.pop(row.number, None)
        if wanted is None:
            return row.number, f"{name} should not be there"
        look, right_look = yours.looks.get(row.number), right.looks.get(row.number)
        words = compare_bodies(row, wanted, max(find_reach(look), 1.0), tolerance)
        if not words and look and right_look and mass_differs(look, right_look, tolerance.share):
            words = "has another mass or moment"
        if words:
            return row.number, f"{name} {words}"
    for number in expected:
        return number, f"{name_of(number, runs)} is missing"
    for what, here, there in (
        ("rods", moment.rods, other.rods),
        ("contacts", moment.touches, other.touches),
    ):
        if len(here) != len(there):
            return 0, f"{len(here)} {what} instead of {len(there)}"
    if any(
        math.dist(*pair) > tolerance.distance for pair in zip(moment.rods, other.rods, strict=True)
    ):
        return 0, "a rod has other ends"
    depths = zip(list_depths(moment), list_depths(other), strict=True)
    if any(abs(depth - right_depth) > tolerance.distance for depth, right_depth in depths):
        return 0, "a contact has another depth"
    return None


def list_depths(moment: Moment) -> list[float]:
    """Return the depths of all contacts, px, in the order of their points."""
    return [each.depth for each in sorted(moment.touches, key=lambda each: (each.x, each.y))]


def name_of(number: int, runs: tuple[Run, Run]) -> str:
    """Return a body's name in the student's run, as in its script."""
    yours, expected = runs
    return yours.names.get(number) or expected.names.get(number, f"body {number}")


def compare_bodies(row: BodyRow, right: BodyRow, radius: float, tolerance: Tolerance) -> str:
    """Describe how a body differs from the expected one; empty if it does not."""
    if not all(map(math.isfinite, numbers_of(row))):
        return "has numbers that are not finite"
    away = math.dist((row.x, row.y), (right.x, right.y))
    turned, spin = abs(row.angle - right.angle), abs(row.omega - right.omega)
    faster = math.dist((row.vx, row.vy), (right.vx, right.vy))
    if away > tolerance.distance:
        return f"is {format_rough(away)} px off"
    if turned * radius > tolerance.distance:
        return f"is turned by {format_rough(turned)} rad too much or too little"
    if faster > tolerance.speed:
        return f"has a velocity that is {format_rough(faster)} px/s off"
    if spin * radius > tolerance.speed:
        return f"has a spin that is {format_rough(spin)} rad/s off"
    return ""


def mass_differs(yours: BodyLook, right: BodyLook, share: float) -> bool:
    pairs = ((yours.mass, right.mass), (yours.moment, right.moment))
    return any(
        (a is None) != (b is None)
        or (a is not None and b is not None and not math.isclose(a, b, rel_tol=share))
        for a, b in pairs
    )
