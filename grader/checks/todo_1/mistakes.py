"""Known mistakes in TODO 1, as models of what circle_box then returns."""

import math
from collections.abc import Callable, Iterable
from functools import partial

from grader.checks import exact
from grader.checks.exact import Disc, Rect, Touch
from grader.checks.mistakes import Models, register
from grader.judge.explain.misconceptions import Kind, Undecided, kinds, mistake

Answer = Touch | str | None  # a str is the name of an exception
Right = Touch | None
Model = Callable[[Disc, Rect], Answer]
Case = Callable[[Disc, Rect], bool]
Change = Callable[[Touch, Disc, Rect], Touch]

FAR = 65536.0  # px, beyond every distance that a check asks about


def find_contact(disc: Disc, rect: Rect) -> Right:
    answers = exact.circle_box(disc, rect)
    if len(answers) > 1:
        raise Undecided
    return answers[0]


def is_inside(disc: Disc, rect: Rect) -> bool:
    return abs(disc.x - rect.x) <= rect.hx and abs(disc.y - rect.y) <= rect.hy


def is_outside(disc: Disc, rect: Rect) -> bool:
    return not is_inside(disc, rect)


def is_on_the_edge(disc: Disc, rect: Rect) -> bool:
    return max(abs(disc.x - rect.x) - rect.hx, abs(disc.y - rect.y) - rect.hy) == 0


def describe_place(disc: Disc, rect: Rect) -> dict[str, str]:
    """Describe the position of the circle."""
    across, down = abs(disc.x - rect.x) - rect.hx, abs(disc.y - rect.y) - rect.hy
    inside, corner = is_inside(disc, rect), across > 0 and down > 0
    side = "left" if disc.x < rect.x else "right"
    end = "top" if disc.y < rect.y else "bottom"
    face = side if across > down else end
    near = "a corner is nearest" if corner else f"the {face} face is nearest"
    words = {"place": "the two are apart or only touch"}
    if find_contact(disc, rect) is not None:
        words["place"] = f"the centre is {'inside' if inside else 'outside'} the box"
    words |= {"face": near, "_way": f"the circle is at the {end} {side}"}
    words["axis"] = "a corner is nearest"
    if not corner:
        words["axis"] = f"a face {'at the side' if across > down else 'above or below'} is nearest"
    words["_box"] = f"the box is {'' if rect.x == rect.y == 0 else 'not '}at (0, 0)"
    words["_radius"] = f"the radius is {disc.r:g} px"
    words["_edge"] = f"the centre is {'' if is_on_the_edge(disc, rect) else 'not '}on the edge"
    return words


PARTS = {"the normal": [0, 1], "the depth": [2], "the point": [3, 4]}

kinds["circle_box"] = Kind(find_contact, describe_place, PARTS)
kinds["order"] = Kind(lambda disc, rect: (True, True), describe_place)  # A is the circle, B the box


# ---------------------------------------------------------------- right but in one case


def except_if(case: Case, answer: Model) -> Model:
    """Return the right model with another answer in one case."""
    return lambda disc, rect: (answer if case(disc, rect) else find_contact)(disc, rect)


def change_if(case: Case, change: Change) -> Model:
    """Return the right model with its contacts changed in one case."""

    def model(disc: Disc, rect: Rect) -> Answer:
        touch = find_contact(disc, rect)
        return change(touch, disc, rect) if touch and case(disc, rect) else touch

    return model


if_inside, if_on_edge = partial(except_if, is_inside), partial(except_if, is_on_the_edge)
change_inside, change_outside = partial(change_if, is_inside), partial(change_if, is_outside)


def raise_error(error: str) -> Model:
    return lambda disc, rect: error


def turn_normal(touch: Touch, disc: Disc, rect: Rect) -> Touch:
    return touch._replace(nx=-touch.nx, ny=-touch.ny)


def centre_with_normal(nx: float, ny: float) -> Change:
    return lambda touch, disc, rect: Touch(nx, ny, disc.r, disc.x, disc.y)


def nearest(ways: Iterable[Touch], measure: Callable[[Touch], float]) -> Touch:
    """Return the contact with the smallest measure; undecided if there are several."""
    first, second = sorted(ways, key=measure)[:2]
    if math.isclose(measure(first), measure(second), abs_tol=1e-9):
        raise Undecided
    return first


def find_farthest_face(disc: Disc, rect: Rect) -> Touch:
    return nearest(exact.ways_out(disc, rect), lambda touch: -touch.depth)


def find_face_by_share(disc: Disc, rect: Rect) -> Touch:
    return nearest(
        exact.ways_out(disc, rect),
        lambda touch: (touch.depth - disc.r) / (rect.hx if touch.nx else rect.hy),
    )


def find_face_by_offset(disc: Disc, rect: Rect) -> Touch:
    x, y = abs(disc.x - rect.x), abs(disc.y - rect.y)
    if math.isclose(x, y, abs_tol=1e-9):
        raise Undecided
    ways = (touch for touch in exact.ways_out(disc, rect) if (touch.nx != 0) == (x > y))
    return nearest(ways, gap)


def find_farther_way(disc: Disc, rect: Rect) -> Touch:
    left, right, top, bottom = exact.ways_out(disc, rect)
    level, upright = min(left, right, key=gap), min(top, bottom, key=gap)
    if math.isclose(level.depth, upright.depth) or left.depth == right.depth:
        raise Undecided
    return max(level, upright, key=gap)


def gap(touch: Touch) -> float:
    return touch.depth


def point_at_the_middle(touch: Touch, disc: Disc, rect: Rect) -> Touch:
    dx, dy = rect.x - disc.x, rect.y - disc.y
    return touch._replace(nx=dx / math.hypot(dx, dy), ny=dy / math.hypot(dx, dy))


def point_along_an_axis(touch: Touch, disc: Disc, rect: Rect) -> Touch:
    if abs(touch.nx) == abs(touch.ny):
        raise Undecided
    if abs(touch.nx) > abs(touch.ny):
        return touch._replace(nx=math.copysign(1.0, touch.nx), ny=0.0)
    return touch._replace(nx=0.0, ny=math.copysign(1.0, touch.ny))


def measure_from_the_middle(touch: Touch, disc: Disc, rect: Rect) -> Touch:
    return touch._replace(px=touch.px - rect.x, py=touch.py - rect.y)


# ---------------------------------------------------------------- another box, another test


def find_in_box(change: Callable[[float, float, float, float], tuple[float, ...]]) -> Model:
    """Return the model that uses a wrong box, computed from x, y, hx and hy of the right one."""
    return lambda disc, rect: find_contact(disc, Rect(*change(*rect)))


def find_on_edge(change: Callable[[Rect], Rect]) -> Model:
    """Return the model that uses an edge instead of the box."""

    def model(disc: Disc, rect: Rect) -> Answer:
        if is_inside(disc, change(rect)):
            raise Undecided  # the distance is 0
        return find_contact(disc, change(rect))

    return model


def find_at_any_distance(disc: Disc, rect: Rect) -> Touch:
    """Return the contact even when the two are apart, with a negative depth."""
    answer = find_contact(disc._replace(r=disc.r + FAR), rect)
    assert answer is not None
    return answer._replace(depth=answer.depth - FAR)


def find_outside(disc: Disc, rect: Rect) -> Touch:
    """Return the contact at any distance; undecided for a centre inside."""
    if is_inside(disc, rect):
        raise Undecided
    return find_at_any_distance(disc, rect)


def count_touching(disc: Disc, rect: Rect) -> Answer:
    touch = find_at_any_distance(disc, rect)
    return touch if touch.depth >= 0 else None


def turn_test_round(disc: Disc, rect: Rect) -> Answer:
    answer = find_outside(disc, rect)
    if math.isclose(answer.depth, 0.0, abs_tol=1e-9):
        raise Undecided  # either way
    return None if answer.depth > 0 else answer


def compare_square(disc: Disc, rect: Rect) -> Right:
    answer = find_outside(disc, rect)
    return None if (disc.r - answer.depth) ** 2 >= disc.r else answer


def use_square(disc: Disc, rect: Rect) -> Right:
    touch = compare_square(disc, rect)
    return touch and touch._replace(depth=disc.r - (disc.r - touch.depth) ** 2)


def divide_by_square(disc: Disc, rect: Rect) -> Right:
    """Return the contact with its offset divided by the square as well."""
    touch = use_square(disc, rect)
    if touch is None:
        return None
    distance = math.sqrt(disc.r - touch.depth)
    return touch._replace(nx=touch.nx / distance, ny=touch.ny / distance)


# ---------------------------------------------------------------- the mistakes

register("1", "order", [("the-box-comes-first", lambda disc, rect: (False, False))])
MODELS: Models = (
    ("normal-points-out-of-the-box", change_if(lambda d, box: True, turn_normal)),
    ("inside-is-forgotten", if_inside(lambda d, box: None)),
    ("inside-normal-points-out", change_inside(turn_normal)),
    ("inside-has-no-case-of-its-own", change_inside(centre_with_normal(0.0, 1.0))),
    ("inside-has-no-case-of-its-own", change_inside(centre_with_normal(0.0, -1.0))),
    ("inside-has-no-case-of-its-own", change_inside(centre_with_normal(1.0, 0.0))),
    ("inside-has-no-case-of-its-own", change_inside(centre_with_normal(-1.0, 0.0))),
    ("inside-depth-forgets-the-gap", change_inside(lambda t, d, box: t._replace(depth=d.r))),
    ("inside-depth-is-the-gap", change_inside(lambda t, d, box: t._replace(depth=t.depth - d.r))),
    ("inside-point-is-the-centre", change_inside(lambda t, d, box: t._replace(px=d.x, py=d.y))),
    ("inside-leaves-by-the-farthest-face", if_inside(find_farthest_face)),
    ("inside-always-leaves-by-the-top", if_inside(lambda d, box: exact.ways_out(d, box)[2])),
    ("edge-counts-as-outside", if_on_edge(raise_error("ZeroDivisionError"))),
    ("edge-counts-as-outside", if_on_edge(raise_error("ValueError"))),
    ("face-by-the-distance-from-the-middle", if_inside(find_face_by_offset)),
    ("face-by-share-of-the-half", if_inside(find_face_by_share)),
    ("depth-is-the-distance", change_outside(lambda t, d, box: t._replace(depth=d.r - t.depth))),
    (
        "normal-is-not-a-unit-vector",
        change_outside(lambda t, d, box: t._replace(nx=t.px - d.x, ny=t.py - d.y)),
    ),
    ("normal-points-at-the-centre-of-the-box", change_outside(point_at_the_middle)),
    ("corner-normal-along-an-axis", change_outside(point_along_an_axis)),
    (
        "point-lies-on-the-circle",
        change_outside(lambda t, d, box: t._replace(px=d.x + t.nx * d.r, py=d.y + t.ny * d.r)),
    ),
    ("inside-normalises-zero", if_inside(raise_error("ValueError"))),  # of normalize()
    ("inside-normalises-zero", if_inside(raise_error("ZeroDivisionError"))),
    ("apart-is-not-noticed", find_at_any_distance),
    ("touching-counts-as-overlap", count_touching),
    ("half-is-taken-for-the-full-size", find_in_box(lambda x, y, hx, hy: (x, y, hx / 2, hy / 2))),
    ("half-is-taken-for-the-full-width", find_in_box(lambda x, y, hx, hy: (x, y, hx / 2, hy))),
    ("half-is-taken-for-the-full-height", find_in_box(lambda x, y, hx, hy: (x, y, hx, hy / 2))),
    ("half-is-doubled", find_in_box(lambda x, y, hx, hy: (x, y, 2 * hx, 2 * hy))),
    ("width-for-height", find_in_box(lambda x, y, hx, hy: (x, y, hx, hx))),
    ("height-for-width", find_in_box(lambda x, y, hx, hy: (x, y, hy, hy))),
    ("box-at-the-origin", find_in_box(lambda x, y, hx, hy: (0.0, 0.0, hx, hy))),
    ("point-from-the-middle-of-the-box", change_outside(measure_from_the_middle)),
    ("point-from-the-middle-of-the-box", change_inside(measure_from_the_middle)),
    ("top-and-bottom-swapped", find_on_edge(lambda box: box._replace(y=box.y + box.hy, hy=0.0))),
    ("left-and-right-swapped", find_on_edge(lambda box: box._replace(x=box.x + box.hx, hx=0.0))),
    ("position-is-taken-for-a-corner", find_in_box(lambda x, y, hx, hy: (x + hx, y + hy, hx, hy))),
    ("clamp-is-turned-round", find_in_box(lambda x, y, hx, hy: (x - hx, y - hy, 0.0, 0.0))),
)
register("1", "circle_box", MODELS)
mistake(
    "1",
    "circle_box",
    "clamp-is-turned-round",
    "The closest point is always the bottom right corner: min and max have changed places.",
    find_in_box(lambda x, y, hx, hy: (x + hx, y + hy, 0.0, 0.0)),
)
SQUARES: Models = (
    ("test-is-turned-round", turn_test_round),
    ("distance-is-squared", divide_by_square),
    ("distance-is-squared", use_square),
    ("distance-is-squared", compare_square),
)
register("1", "circle_box", SQUARES)
mistake(
    "1",
    "circle_box",
    "inside-leaves-by-the-farthest-face",
    "A centre inside leaves to the side where up or down is nearer, and the other way round: "
    "compare the two gaps once more.",
    if_inside(find_farther_way),
)
