"""Known mistakes in TODO 1, as models of what circle_box then returns."""

import math

from grader.checks import exact
from grader.checks.exact import Disc, Rect, Touch
from grader.judge.misconceptions import Undecided, mistake, truth

Answer = Touch | None


@truth("circle_box")
def right(disc: Disc, rect: Rect) -> Answer:
    answers = exact.circle_box(disc, rect)
    if len(answers) > 1:
        raise Undecided
    return answers[0]


def is_inside(disc: Disc, rect: Rect) -> bool:
    return abs(disc.x - rect.x) <= rect.hx and abs(disc.y - rect.y) <= rect.hy


@mistake(
    "1",
    "normal-points-out-of-the-box",
    "The normal points from the box to the circle; it must point from A, the circle, into B.",
    about="circle_box",
)
def normal_points_out(disc: Disc, rect: Rect) -> Answer:
    answer = right(disc, rect)
    return answer and answer._replace(nx=-answer.nx, ny=-answer.ny)


@mistake(
    "1",
    "inside-is-forgotten",
    "There is no answer for a centre inside the box: a fast ball that got in never comes out.",
    about="circle_box",
)
def inside_forgotten(disc: Disc, rect: Rect) -> Answer:
    return None if is_inside(disc, rect) else right(disc, rect)


@mistake(
    "1",
    "inside-normal-points-out",
    "For a centre inside, the normal is the way out; it must point the opposite way, into the box.",
    about="circle_box",
)
def inside_normal_out(disc: Disc, rect: Rect) -> Answer:
    return normal_points_out(disc, rect) if is_inside(disc, rect) else right(disc, rect)


@mistake(
    "1",
    "inside-depth-forgets-the-gap",
    "For a centre inside, the depth is radius + gap: the circle has the gap to leave as well.",
    about="circle_box",
)
def inside_depth_is_radius(disc: Disc, rect: Rect) -> Answer:
    answer = right(disc, rect)
    return answer._replace(depth=disc.r) if answer and is_inside(disc, rect) else answer


@mistake(
    "1",
    "depth-is-the-distance",
    "The depth is the distance to the closest point; it must be what is missing: radius - distance.",
    about="circle_box",
)
def depth_is_distance(disc: Disc, rect: Rect) -> Answer:
    answer = right(disc, rect)
    if answer is None or is_inside(disc, rect):
        return answer
    return answer._replace(depth=math.hypot(answer.px - disc.x, answer.py - disc.y))
