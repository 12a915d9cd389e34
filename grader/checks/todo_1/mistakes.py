"""Known mistakes in TODO 1, as models of what circle_box then returns."""

import math
from collections.abc import Callable

from grader.checks import exact
from grader.checks.exact import Disc, Rect, Touch
from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import Undecided, truth

Answer = Touch | str | None  # a str is the name of an exception
Right = Touch | None
Model = Callable[[Disc, Rect], Answer]
Box = tuple[float, float, float, float]  # as in Rect
Change = Callable[[Touch, Disc, Rect], Touch]

known = known_in("1", "circle_box")

FAR = 65536.0  # px, beyond every distance that a check asks about


def find_contact(disc: Disc, rect: Rect) -> Right:
    answers = exact.circle_box(disc, rect)
    if len(answers) > 1:
        raise Undecided
    return answers[0]


def is_inside(disc: Disc, rect: Rect) -> bool:
    return abs(disc.x - rect.x) <= rect.hx and abs(disc.y - rect.y) <= rect.hy


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

truth("circle_box", find_contact, describe_place, PARTS)


def change_inside(change: Change) -> Model:
    """Return the right answer, changed for a centre inside the box."""

    def model(disc: Disc, rect: Rect) -> Answer:
        answer = find_contact(disc, rect)
        return change(answer, disc, rect) if answer and is_inside(disc, rect) else answer

    return model


def change_outside(change: Change) -> Model:
    """Return the right answer, changed for a centre outside the box."""

    def model(disc: Disc, rect: Rect) -> Answer:
        answer = find_contact(disc, rect)
        return answer if answer is None or is_inside(disc, rect) else change(answer, disc, rect)

    return model


def circle_first(disc: Disc, rect: Rect) -> tuple[bool, bool]:
    """Return whether the contact's A is the circle, and its B the box."""
    return True, True


truth("order", circle_first, describe_place)


def turn_normal(touch: Touch) -> Touch:
    return touch._replace(nx=-touch.nx, ny=-touch.ny)


def with_normal(touch: Touch, nx: float, ny: float) -> Touch:
    return touch._replace(nx=nx, ny=ny)


def find_at_any_distance(disc: Disc, rect: Rect) -> Touch:
    """Return the contact even when the two are apart, with a negative depth."""
    answer = find_contact(disc._replace(r=disc.r + FAR), rect)
    assert answer is not None
    return answer._replace(depth=answer.depth - FAR)


def find_in_box(change: Callable[[float, float, float, float], Box]) -> Model:
    """Return the model that uses a wrong box, made from x, y, hx and hy of the right one."""
    return lambda disc, rect: find_contact(disc, Rect(*change(*rect)))


def find_on_edge(disc: Disc, edge: Rect) -> Answer:
    """Return the contact with an edge instead of the box."""
    if is_inside(disc, edge):
        raise Undecided  # the distance is 0
    return find_contact(disc, edge)


known_in("1", "order")("the-box-comes-first", lambda disc, rect: (False, False))


@known("normal-points-out-of-the-box")
def normal_points_out_of_the_box(disc: Disc, rect: Rect) -> Answer:
    answer = find_contact(disc, rect)
    return answer and turn_normal(answer)


known(
    "inside-is-forgotten",
    lambda disc, rect: None if is_inside(disc, rect) else find_contact(disc, rect),
)
known("inside-normal-points-out", change_inside(lambda touch, disc, rect: turn_normal(touch)))
known(
    "inside-has-no-case-of-its-own",
    change_inside(lambda touch, disc, rect: Touch(0.0, 1.0, disc.r, disc.x, disc.y)),
    change_inside(lambda touch, disc, rect: Touch(0.0, -1.0, disc.r, disc.x, disc.y)),
    change_inside(lambda touch, disc, rect: Touch(1.0, 0.0, disc.r, disc.x, disc.y)),
    change_inside(lambda touch, disc, rect: Touch(-1.0, 0.0, disc.r, disc.x, disc.y)),
)
known(
    "inside-depth-forgets-the-gap",
    change_inside(lambda touch, disc, rect: touch._replace(depth=disc.r)),
)
known(
    "inside-depth-is-the-gap",
    change_inside(lambda touch, disc, rect: touch._replace(depth=touch.depth - disc.r)),
)
known(
    "inside-point-is-the-centre",
    change_inside(lambda touch, disc, rect: touch._replace(px=disc.x, py=disc.y)),
)


@known("inside-leaves-by-the-farthest-face")
def inside_leaves_by_the_farthest_face(disc: Disc, rect: Rect) -> Answer:
    if not is_inside(disc, rect):
        return find_contact(disc, rect)
    deepest = sorted(exact.ways_out(disc, rect), key=lambda touch: -touch.depth)
    if deepest[0].depth == deepest[1].depth:
        raise Undecided
    return deepest[0]


@known("inside-always-leaves-by-the-top")
def inside_always_leaves_by_the_top(disc: Disc, rect: Rect) -> Answer:
    if not is_inside(disc, rect):
        return find_contact(disc, rect)
    return exact.ways_out(disc, rect)[2]


def face_by_share(disc: Disc, rect: Rect) -> Answer:
    if not is_inside(disc, rect):
        return find_contact(disc, rect)
    shares = [
        (touch.depth - disc.r) / (rect.hx if touch.nx else rect.hy)
        for touch in exact.ways_out(disc, rect)
    ]
    first, second = sorted(range(4), key=lambda each: shares[each])[:2]
    if math.isclose(shares[first], shares[second], abs_tol=1e-9):
        raise Undecided
    return exact.ways_out(disc, rect)[first]


def face_by_offset(disc: Disc, rect: Rect) -> Answer:
    if not is_inside(disc, rect):
        return find_contact(disc, rect)
    x, y = abs(disc.x - rect.x), abs(disc.y - rect.y)
    ways = [touch for touch in exact.ways_out(disc, rect) if (touch.nx != 0) == (x > y)]
    if math.isclose(x, y, abs_tol=1e-9) or math.isclose(ways[0].depth, ways[1].depth, abs_tol=1e-9):
        raise Undecided
    return min(ways, key=lambda touch: touch.depth)


for error in ("ZeroDivisionError", "ValueError"):
    known(
        "edge-counts-as-outside",
        lambda disc, rect, error=error: (
            error if is_on_the_edge(disc, rect) else find_contact(disc, rect)
        ),
    )
known("face-by-the-distance-from-the-middle", face_by_offset)
known("face-by-share-of-the-half", face_by_share)
known(
    "depth-is-the-distance",
    change_outside(lambda touch, disc, rect: touch._replace(depth=disc.r - touch.depth)),
)
known(
    "normal-is-not-a-unit-vector",
    change_outside(
        lambda touch, disc, rect: with_normal(touch, touch.px - disc.x, touch.py - disc.y)
    ),
)


@known("normal-points-at-the-centre-of-the-box")
@change_outside
def normal_points_at_the_centre_of_the_box(touch: Touch, disc: Disc, rect: Rect) -> Touch:
    dx, dy = rect.x - disc.x, rect.y - disc.y
    return with_normal(touch, dx / math.hypot(dx, dy), dy / math.hypot(dx, dy))


@known("corner-normal-along-an-axis")
@change_outside
def corner_normal_along_an_axis(touch: Touch, disc: Disc, rect: Rect) -> Touch:
    if abs(touch.nx) == abs(touch.ny):
        raise Undecided
    if abs(touch.nx) > abs(touch.ny):
        return with_normal(touch, math.copysign(1.0, touch.nx), 0.0)
    return with_normal(touch, 0.0, math.copysign(1.0, touch.ny))


known(
    "point-lies-on-the-circle",
    change_outside(
        lambda touch, disc, rect: touch._replace(
            px=disc.x + touch.nx * disc.r, py=disc.y + touch.ny * disc.r
        )
    ),
)


def fail_inside(error: str) -> Model:
    return lambda disc, rect: error if is_inside(disc, rect) else find_contact(disc, rect)


known(
    "inside-normalises-zero",
    fail_inside("ValueError"),  # of normalize()
    fail_inside("ZeroDivisionError"),
)
known("apart-is-not-noticed", lambda disc, rect: find_at_any_distance(disc, rect))


@known("touching-counts-as-overlap")
def touching_counts_as_overlap(disc: Disc, rect: Rect) -> Answer:
    touch = find_at_any_distance(disc, rect)
    return touch if touch.depth >= 0 else None


known("half-is-taken-for-the-full-size", find_in_box(lambda x, y, hx, hy: (x, y, hx / 2, hy / 2)))
known("half-is-taken-for-the-full-width", find_in_box(lambda x, y, hx, hy: (x, y, hx / 2, hy)))
known("half-is-taken-for-the-full-height", find_in_box(lambda x, y, hx, hy: (x, y, hx, hy / 2)))
known("half-is-doubled", find_in_box(lambda x, y, hx, hy: (x, y, 2 * hx, 2 * hy)))
known("width-for-height", find_in_box(lambda x, y, hx, hy: (x, y, hx, hx)))
known("height-for-width", find_in_box(lambda x, y, hx, hy: (x, y, hy, hy)))
known("box-at-the-origin", find_in_box(lambda x, y, hx, hy: (0.0, 0.0, hx, hy)))
known(
    "point-from-the-middle-of-the-box",
    change_outside(lambda t, disc, rect: t._replace(px=t.px - rect.x, py=t.py - rect.y)),
    change_inside(lambda t, disc, rect: t._replace(px=t.px - rect.x, py=t.py - rect.y)),
)
known(
    "top-and-bottom-swapped",
    lambda disc, rect: find_on_edge(disc, rect._replace(y=rect.y + rect.hy, hy=0.0)),
)
known(
    "left-and-right-swapped",
    lambda disc, rect: find_on_edge(disc, rect._replace(x=rect.x + rect.hx, hx=0.0)),
)
known("position-is-taken-for-a-corner", find_in_box(lambda x, y, hx, hy: (x + hx, y + hy, hx, hy)))
known("clamp-is-turned-round", find_in_box(lambda x, y, hx, hy: (x - hx, y - hy, 0.0, 0.0)))
known(
    "clamp-is-turned-round",
    find_in_box(lambda x, y, hx, hy: (x + hx, y + hy, 0.0, 0.0)),
    meaning="The closest point is always the bottom right corner: min and max have changed places.",
)


@known("test-is-turned-round")
def overlap_is_turned_round(disc: Disc, rect: Rect) -> Answer:
    answer = find_at_any_distance(disc, rect)
    if is_inside(disc, rect) or math.isclose(answer.depth, 0.0, abs_tol=1e-9):
        raise Undecided  # either way
    return None if answer.depth > 0 else answer


def distance_squared(disc: Disc, rect: Rect) -> Answer:
    answer = find_at_any_distance(disc, rect)
    if is_inside(disc, rect):
        raise Undecided
    squared = (disc.r - answer.depth) ** 2
    return None if squared >= disc.r else answer._replace(depth=disc.r - squared)


def compared_as_a_square(disc: Disc, rect: Rect) -> Answer:
    answer = find_at_any_distance(disc, rect)
    if is_inside(disc, rect):
        raise Undecided
    return None if (disc.r - answer.depth) ** 2 >= disc.r else answer


def shortened(disc: Disc, rect: Rect) -> Answer:
    """Return the contact with its offset divided by the square as well."""
    touch = distance_squared(disc, rect)
    if not isinstance(touch, Touch):
        return touch
    distance = math.sqrt(disc.r - touch.depth)
    return with_normal(touch, touch.nx / distance, touch.ny / distance)


known("distance-is-squared", shortened, distance_squared, compared_as_a_square)


def farther_way(disc: Disc, rect: Rect) -> Answer:
    if not is_inside(disc, rect):
        return find_contact(disc, rect)
    left, other, top, bottom = exact.ways_out(disc, rect)
    level, upright = min(left, other, key=gap), min(top, bottom, key=gap)
    if math.isclose(level.depth, upright.depth) or left.depth == other.depth:
        raise Undecided
    return max(level, upright, key=gap)


def gap(touch: Touch) -> float:
    return touch.depth


known(
    "inside-leaves-by-the-farthest-face",
    farther_way,
    meaning=(
        "A centre inside leaves to the side where up or down is nearer, and the other way round: "
        "compare the two gaps once more."
    ),
)
