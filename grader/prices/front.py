"""The front that nobody beats, and what an engine's error is for a given number of opcodes."""

import math
from collections.abc import Iterable

from grader.prices.measure import Curve, Point

Owned = tuple[str, Point]  # whose point it is


def front(points: Iterable[Owned]) -> list[Owned]:
    """Those that no other beats, the cheapest first.

    One beats another that costs no more and errs no more, and does better in one of both. Of equal
    ones all stand there.
    """
    kept: list[Owned] = []
    for each in sorted(points, key=lambda each: (each[1].opcodes, each[1].error, each[0])):
        last = kept[-1][1] if kept else None
        alike = last and (last.opcodes, last.error) == (each[1].opcodes, each[1].error)
        if last is None or alike or each[1].error < last.error:
            kept.append(each)
    return kept


def error_for(curve: Curve, opcodes: int) -> float | None:
    """The error (px) that so many opcodes buy, between two settings on a straight line in logs.

    None where the engine cannot do with so few; more than its dearest setting help it no more.
    """
    before: Point | None = None
    for point in sorted(curve.points, key=lambda each: each.opcodes):
        if point.opcodes >= opcodes:
            return point.error if point.opcodes == opcodes else between(before, point, opcodes)
        before = point
    return before.error if before else None


def between(low: Point | None, high: Point, opcodes: int) -> float | None:
    if low is None:
        return None
    share = math.log(opcodes / low.opcodes) / math.log(high.opcodes / low.opcodes)
    return math.exp((1 - share) * math.log(low.error) + share * math.log(high.error))
