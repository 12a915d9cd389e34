"""Check a recorded run: free bodies fall, and no body jumps.

A submission runs in one process with the recorder and can fake a recording. So a recording is
compared with values computed without the program: the balls' first positions, and each step of a
free ball. A body in contact must stay near its last position, at a speed that a fall can give. A
fake that passes is a simulation.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from grader.checks.whole.lab_scene import BALLS, FIXED, HOOK, ROD, Part
from grader.judge.decode import Pair
from grader.judge.lab import STEP, Lab, Moment

GRAVITY = 980.0  # px/s²
BALL, LARGEST = 22.0, 32.0  # px: how far a ball, and anything that moves, reaches from its middle
CLEAR = 3.0  # px
LOST = 0.1  # share of a speed: no damping takes more in a step
ASIDE = 0.5  # px/s
NEAR = 1.0  # px
PUSHED = 10.0  # px: the move allowed in a step to a body in contact, at any speed
FASTEST = 3000.0  # px/s: three times what a fall through the whole window gives
MAX_PAIRS = 2_000_000  # bodies compared in a run; the scene has a tenth of it


def outline(part: Part) -> tuple[float, float, float, float, float]:
    """Return half the width and height of a static part, its middle (x, y) and its radius, px.

    A disc has width and height 0, and a box has radius 0.
    """
    width, height, radius = (0.0, 0.0, *part.shape) if len(part.shape) == 1 else (*part.shape, 0.0)
    return width, height, *part.pos, radius


OUTLINES = [outline(part) for part in FIXED]


def moments(row: Sequence[float]) -> list[Moment]:
    """Return the bodies that can move, from one row of a trail."""
    return [Moment(*row[start : start + 6]) for start in range(0, len(row), 6)]


def want_free_flights(lab: Lab, trail: Sequence[Sequence[float]]) -> None:
    """Insist, step by step, that the scene's balls fall freely until they touch something."""
    rows = [moments(row) for row in trail]
    if not rows:
        return
    if sum(len(row) ** 2 for row in rows) > MAX_PAIRS:
        most = max(map(len, rows))
        lab.fail("the moving bodies of the scene", f"{most} of them, in {len(rows)} steps")
    for place in BALLS:
        lab.want(
            any(may_have_been(each, place) for each in rows[0]),
            f"a ball that began at ({place[0]:g}, {place[1]:g}), after the first step",
            "none near it",
        )
    for number, (before, after) in enumerate(pairwise(rows), 2):
        reaches = [BALL + LARGEST + 2 * STEP * each.speed for each in before]
        for which, each in enumerate(before):
            likeliest_first = [*after[which:], *after[:which]]
            if is_clear(each, before, reaches):
                want_a_flight(lab, each, likeliest_first, number)
            else:
                want_no_jump(lab, each, likeliest_first, number)


def want_a_flight(lab: Lab, each: Moment, after: Sequence[Moment], number: int) -> None:
    """Insist that some ball flew to this position; the program may have sorted the bodies."""
    if not any(flew(each, other) for other in find_near(each, after)):
        lab.want(
            False,
            f"a ball at ({each.x:.1f}, {each.y:.1f}) that touches nothing to fall: at "
            f"({each.vx:.1f}, {each.vy + GRAVITY * STEP:.1f}) px/s after step {number}",
            next(map(say, find_near(each, after)), "no ball near there"),
        )


def want_no_jump(lab: Lab, each: Moment, after: Sequence[Moment], number: int) -> None:
    """Insist that a body was near this position a step ago, at a possible speed."""
    slow = (other for other in find_near(each, after, PUSHED) if other.speed <= FASTEST)
    if each.speed > FASTEST or not any(slow):
        lab.want(
            False,
            f"the body at ({each.x:.1f}, {each.y:.1f}) near there after step {number}, and no body "
            f"faster than {FASTEST:g} px/s",
            next(map(say, find_near(each, after, PUSHED)), "no body near there"),
        )


def say(each: Moment) -> str:
    return f"one at ({each.x:.1f}, {each.y:.1f}), at ({each.vx:.1f}, {each.vy:.1f}) px/s"


def find_near(each: Moment, after: Sequence[Moment], within: float = NEAR) -> Iterator[Moment]:
    """Yield the bodies of the step before that may be this one."""
    return (other for other in after if may_have_been(other, (each.x, each.y), within))


def may_have_been(each: Moment, place: Pair, near: float = NEAR) -> bool:
    """Return whether a body can have been at this position a step ago."""
    return math.dist((each.x, each.y), place) <= (each.speed + GRAVITY * STEP) * STEP + near


def flew(before: Moment, after: Moment) -> bool:
    """Return whether only gravity, and damping at any rate, acted on a body."""
    vx, vy = before.vx, before.vy + GRAVITY * STEP
    kept = (after.vx * vx + after.vy * vy) / (vx**2 + vy**2 or 1.0)
    kept = min(max(kept, 1 - LOST), 1 + LOST / 10)
    aside = math.hypot(after.vx - kept * vx, after.vy - kept * vy)
    mean = (before.vx + after.vx) / 2, (before.vy + after.vy) / 2  # others are near
    moved = after.x - before.x - mean[0] * STEP, after.y - before.y - mean[1] * STEP
    return aside <= ASIDE and math.hypot(*moved) <= (LOST * before.speed + GRAVITY * STEP) * STEP


def is_clear(each: Moment, row: Sequence[Moment], reaches: Sequence[float]) -> bool:
    """Return whether a body is a ball that can touch nothing in this step or the next.

    The bob and balls near it never count. `reaches` holds, for each body in `row`, from what
    distance it can get at a ball at rest, px.
    """
    x, y = each.x, each.y
    way = 2 * STEP * (each.speed + GRAVITY * STEP) + CLEAR
    if math.dist((x, y), HOOK) <= ROD + BALL + LARGEST + way:
        return False
    for half_width, half_height, middle_x, middle_y, radius in OUTLINES:
        reach = BALL + way + radius
        aside, along = abs(x - middle_x) - half_width, abs(y - middle_y) - half_height
        if aside > reach or along > reach:  # the usual case
            continue
        if math.hypot(max(aside, 0.0), max(along, 0.0)) <= reach:
            return False
    for other, reach in zip(row, reaches, strict=True):
        if abs(other.x - x) > reach + way or other is each:  # the usual case
            continue
        if math.dist((x, y), (other.x, other.y)) <= reach + way:
            return False
    return True
