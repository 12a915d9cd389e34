"""TODO 1: circle_box, from outside and from inside."""

import math
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.digits import want_answer
from grader.checks.exact import Disc, Rect, Touch
from grader.checks.strategies import belts, circles, eighths, slow_speeds
from grader.judge.drawing import between, given
from grader.judge.lab import NOTHING, STEP, Lab, Moment, Pair, Thing
from grader.protocol import ContactValue, Value

BOX = Rect(0, 0, 40, 20)
ROUND = range(0, 1000, 50)  # px
MASSES = (1.0, 1e-3, 1e6, 0.05, 1e3)  # kg; a contact does not depend on them
# Fields that the contact does not depend on.
MOVING: dict[str, Any] = {"vel": (1.5, -300.0), "omega": 4.0, "angle": 1.0}
Fields = dict[str, Any]
SAID = "normal ({:.{n}f}, {:.{n}f}), depth {:.{n}f} px, point ({:.{n}f}, {:.{n}f})"


def make_pair(
    lab: Lab, disc: Disc, rect: Rect, circle: Fields | None = None, box: Fields | None = None
) -> tuple[Thing, Thing]:
    """Begin an experiment: return a circle and a box, each with further fields."""
    lab.ran(describe_question(disc, rect))
    return (
        lab.circle((disc.x, disc.y), disc.r, **(circle or {})),
        lab.box((rect.x, rect.y), (rect.hx, rect.hy), **(box or {})),
    )


def describe_question(disc: Disc, rect: Rect) -> str:
    return (
        f"circle_box of a circle r {disc.r:g} at ({disc.x:g}, {disc.y:g}) and a box with half "
        f"extents ({rect.hx:g}, {rect.hy:g}) at ({rect.x:g}, {rect.y:g})"
    )


def want_touch(
    lab: Lab,
    circle: Thing,
    box: Thing,
    disc: Disc,
    rect: Rect,
    twice: bool = True,
    noted: bool = True,
) -> None:
    """Insist on a right answer of circle_box for this pair, at the positions of disc and rect.

    Unless `noted`, do not compare the answer with known mistakes. Impulses mark each contact; the
    next contact must not have them.
    """
    if lab.running != describe_question(disc, rect):
        lab.ran(describe_question(disc, rect))  # both have moved since
    question = ("circle_box", (disc, rect)) if noted else None

    def judge(value: Value) -> None:
        contact = lab.contact_or_none(value)
        answer = None
        if contact is not None:
            normal, point = contact.normal, contact.point
            answer = Touch(normal.x, normal.y, contact.depth, point.x, point.y)
        if noted:
            lab.saw("circle_box", (disc, rect), answer)
        if contact is not None:
            order = contact.a == circle.ref, contact.b == box.ref
            want_new(lab, contact, order, (disc, rect) if noted else None)
        right = exact.circle_box(disc, rect)
        good = any(is_same(answer, each) for each in right)
        want_answer(lab, good, SAID, right[0], answer)

    lab.call(
        "circle_box",
        circle,
        box,
        changes=NOTHING,
        twice=twice,
        marks={"jn": 12.0, "jt": -5.0},
        noted=question,
        then=judge,
    )


def want_new(
    lab: Lab, contact: ContactValue, order: tuple[bool, bool], noted: tuple[Disc, Rect] | None
) -> None:
    """Insist on a contact of the right pair, in order, without an impulse."""
    if noted:
        lab.saw("order", noted, order)
    lab.want(
        order == (True, True),
        "a contact with the circle as A and the box as B",
        "other bodies, or the two the other way round",
    )
    lab.want(
        contact.jn == contact.jt == 0,
        "a new contact, on which no impulse has worked yet: jn = jt = 0",
        f"jn = {contact.jn:g}, jt = {contact.jt:g}",
    )


def want_exact(lab: Lab, discs: Iterable[Disc], at: Pair = (0.0, 0.0), **circle: Any) -> None:
    """Insist on the right answers for these discs, with positions relative to the box."""
    size, x, y = lab.about(1.0), lab.about(at[0], 64.0), lab.about(at[1], 64.0)
    box = Rect(x, y, size * BOX.hx, size * BOX.hy)
    for each in discs:
        disc = Disc(x + size * each.x, y + size * each.y, size * each.r)
        things = make_pair(lab, disc, box, circle)
        want_touch(lab, *things, disc, box)


def is_same(answer: Touch | None, right: Touch | None) -> bool:
    """Return whether two answers are equal up to rounding, which grows with the numbers."""
    if answer is None or right is None:
        return answer is right
    return all(
        math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9) for a, b in zip(answer, right, strict=True)
    )


def overlap_from_outside_points_into_the_box(lab: Lab) -> None:
    """A circle that overlaps from outside: normal, depth and closest point"""
    discs = (
        Disc(10, -25, 10),  # above, on the left, below, on the right
        Disc(-46, 5, 10),
        Disc(-10, 28, 10),
        Disc(44, -5, 10),
        Disc(43, -24, 10),  # at two corners
        Disc(-46, 28, 15),
        Disc(5, -20.125, 10),  # just outside a face and a corner
        Disc(40.0625, 20.125, 10),
        Disc(3, -30, 90),  # larger than the box
        Disc(-5, -29.9375, 10),  # hardly at all
    )
    want_exact(lab, discs)
    want_exact(lab, discs[:4], at=(100.0, 50.0))
    for n, (disc, rect) in enumerate(near_round_numbers(lab.about(1 / 8))):
        things = make_pair(lab, disc, rect, {"mass": MASSES[n % len(MASSES)]})
        want_touch(lab, *things, disc, rect, twice=False, noted=False)


def near_round_numbers(off: float) -> Iterable[tuple[Disc, Rect]]:
    """Yield discs and boxes with faces and centres near round positions of the window.

    Code that rounds these numbers, or treats a small one as 0, gives another answer.
    """
    for n, x in enumerate(ROUND):
        y, (hx, hy) = ROUND[-n], BOX[2:]
        beside = ((x + off, y - 6), (x - off, y + hy)), ((x - off, y + 6), (x + off, y - hy))
        for (cx, cy), (px, py) in beside:
            yield Disc(cx, cy, 9), Rect(px, py + off, hx, hy)
            yield Disc(cy, cx, 9), Rect(py + off, px, hy, hx)
    for n in range(1, 21):
        across, along = (off, n + off / 2) if n % 2 else (n + off / 2, off)
        yield Disc(-BOX.hx - across, -BOX.hy - along, 23), BOX


def a_centre_inside_leaves_by_the_nearest_face(lab: Lab) -> None:
    """A centre inside the box, or on its edge, leaves by the nearest face"""
    discs = (
        Disc(5, -15, 8),
        Disc(-33, 4, 8),
        Disc(3, 12, 8),
        Disc(35, 1, 8),
        Disc(29, -10, 8),  # nearer to the top, though closer to the right by shares of the box
        Disc(-30, -6, 8),  # each slightly nearer to a face than to the next one
        Disc(30, 6, 8),
        Disc(-25, -8, 8),
        Disc(25, 8, 8),
    )
    want_exact(lab, discs)
    middle = Disc(BOX.x, BOX.y, 8)  # two faces are equally near, and either will do
    want_touch(lab, *make_pair(lab, middle, BOX), middle, BOX, noted=False)
    edges = Disc(7, -20, 8), Disc(-40, 3, 8), Disc(9, 20, 8), Disc(40, -6, 8), Disc(40, 20, 8)
    want_exact(lab, edges, **MOVING)


def no_contact_when_apart_or_just_touching(lab: Lab) -> None:
    """No contact when the two are apart or only touch"""
    discs = Disc(0, -60, 10), Disc(50, 0, 10), Disc(-10, 30, 10), Disc(47, 27, 9), Disc(48, 26, 10)
    want_exact(lab, discs, **MOVING)


# ---------------------------------------------------------------- every region


class Size(NamedTuple):
    """Half extents of a box, px, and the radius of a circle."""

    hx: float
    hy: float
    r: float


SIDES = (-1, 0), (1, 0), (0, -1), (0, 1)
CORNERS = (-1, -1), (-1, 1), (1, -1), (1, 1)
SCALES = (1.0, 1 / 8, 256.0, 1 / 4)
PLACES = (-48.0, 32.0), (500_000.0, -40_000.0)  # px, near and far away
CLOSE, HARDLY = 1 / 64, 63 / 64  # shares of a way


def regions(size: Size, share: float) -> Iterator[Pair]:
    """Yield centres in every region inside and around the box, relative to its middle.

    `share`, from 0 to 1, sets how far inside or outside they are. Shares are multiples of 1/64, so
    that sums are exact.
    """
    hx, hy, r = size
    least = min(hx, hy)
    for sx, sy in SIDES:  # inside, beyond a side, and on its edge
        along = share / 2 * (hy if sx else hx)
        for way in (-share * least / 2, share * r, CLOSE * r, HARDLY * r, 0.0, r * (1 + share)):
            yield (sx * (hx + way), along) if sx else (along, sy * (hy + way))
    for sx, sy in CORNERS:  # two inner faces are nearly as near, and then the other way round
        yield sx * (hx - 45 / 64 * least), sy * (hy - least / 2)
        yield sx * (hx - least / 2), sy * (hy - 39 / 64 * least)
        for across, down in (
            (5 / 8, 3 / 4 * share),
            (CLOSE, 1 / 2),
            (3 / 4, 3 / 4),
            (3 / 8, 5 / 8),
        ):
            yield sx * (hx + across * r), sy * (hy + down * r)
        yield sx * hx, sy * hy
    yield 0.0, 0.0


halves = between(64, 400).map(eighths)  # px


@given(
    examples=2,
    long=halves,
    short=halves,
    r=between(32, 240).map(eighths),
    share=st.integers(8, 56).map(lambda n: n / 64),
    circle=circles,
    box=belts,
    slow=st.tuples(slow_speeds, slow_speeds),
)
def any_circle_and_box_agree_with_the_geometry(
    lab: Lab,
    long: float,
    short: float,
    r: float,
    share: float,
    circle: Fields,
    box: Fields,
    slow: Pair,
) -> None:
    """A circle anywhere in and around any box, also where both have been moved"""
    moving = circle, {**circle, "vel": slow}
    wide, tall = (long + 40.0, short / 2, r), (short / 2, long + 40.0, r)
    speck = short / 4, short / 8, short + 4 * r  # inside the circle
    shapes = wide, tall, speck, (4 * r + long, 4 * r + long - 1.0, r)  # last, a large square
    for n, scale in enumerate(SCALES):
        size = Size(*(scale * each for each in shapes[n]))
        one = make_pair(
            lab, Disc(0, 0, size.r), Rect(*PLACES[0], size.hx, size.hy), moving[n % 2], box
        )
        for number, (dx, dy) in enumerate(regions(size, share)):
            x, y = PLACES[number % 2]
            disc, rect = Disc(x + dx, y + dy, size.r), Rect(x, y, size.hx, size.hy)
            lab.put(one[0], pos=(disc.x, disc.y))
            lab.put(one[1], pos=(rect.x, rect.y))
            want_touch(lab, *one, disc, rect)


# ---------------------------------------------------------------- what a player sees

APART = 1000.0  # px, between the boxes of one scene


def balls_bounce_off_every_side_of_a_box(lab: Lab) -> None:
    """Balls bounce off every side of a box"""
    speed = lab.about(200.0)
    lab.ran(f"balls thrown straight at a side of a box each, at {speed:g} px/s, half a second")
    boxes = [lab.box((APART * number, 0.0), (60.0, 30.0)) for number in range(4)]
    balls = [
        lab.circle((APART * number + 90.0 * x, 60.0 * y), 10.0, vel=(-speed * x, -speed * y))
        for number, (x, y) in enumerate(SIDES)
    ]
    run = lab.simulate(lab.world(*balls, *boxes), balls, 60)
    for number, (x, y) in enumerate(SIDES):
        last = run.body(number)[-1]
        away, aside = x * last.vx + y * last.vy, abs(y * last.vx) + abs(x * last.vy)
        lab.want(
            0.25 * speed < away < 0.35 * speed and aside < 1.0,
            f"a ball that comes straight back from each side, at {0.3 * speed:g} px/s",
            f"one at ({last.vx:.0f}, {last.vy:.0f}) px/s, thrown at ({-speed * x:g}, "
            f"{-speed * y:g}) px/s",
        )


def balls_land_on_a_floor_and_lie_there(lab: Lab) -> None:
    """Balls fall on a floor and come to rest on it"""
    high = lab.about(80.0)
    lab.ran(f"balls dropped from {high:g} px above a floor and from a little above, 2 seconds")
    floor = lab.box((300.0, 400.0), (300.0, 20.0))
    balls = [lab.circle((x, 370.0 - drop), 10.0) for x, drop in ((80.0, high), (420.0, 3.0))]
    world = lab.world(*balls, floor, gravity=(0.0, 980.0))
    run = lab.simulate(world, balls, round(2 / STEP))
    for number, x in enumerate((80.0, 420.0)):
        want_at_rest(lab, run.body(number), x)


def want_at_rest(lab: Lab, moments: list[Moment], x: float) -> None:
    """Insist that a ball lies on the floor, sunk in by at most SLOP and one step's fall."""
    last = moments[-30:]
    lab.want(
        all(abs(each.y - 370.0) < 1.5 and abs(each.x - x) < 1.0 for each in last),
        f"a ball at rest on the floor, its centre at ({x:g}, 370)",
        f"one at ({last[-1].x:.1f}, {last[-1].y:.1f}), {last[-1].vy:.0f} px/s down",
    )


def a_ball_inside_a_box_comes_out_at_the_nearest_side(lab: Lab) -> None:
    """A ball that got inside a box comes out at the nearest side"""
    inside = lab.about(12.0)
    lab.ran(f"balls at rest {inside:g} px inside each side of a box, for a quarter of a second")
    box = lab.box((300.0, 200.0), (90.0, 60.0))
    balls = [
        lab.circle((300.0 + (90.0 - inside) * x + 15.0 * abs(y), 200.0 + (60.0 - inside) * y), 6.0)
        for x, y in SIDES
    ]
    run = lab.simulate(lab.world(*balls, box), balls, 30, every=30)
    for number, (x, y) in enumerate(SIDES):
        last = run.body(number)[-1]
        out = x * (last.x - 300.0) - 90.0 if x else y * (last.y - 200.0) - 60.0
        lab.want(
            out >= 5.0 and abs(last.y - 200.0 if x else last.x - 315.0) < 1.0,
            "each ball outside, straight before the side that it was nearest to",
            f"one at ({last.x - 300.0:.1f}, {last.y - 200.0:.1f}) from the middle of the box",
        )
