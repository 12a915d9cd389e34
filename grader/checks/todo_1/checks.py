"""TODO 1: circle_box, from outside and from inside."""

import math
from collections.abc import Iterable
from typing import Any

from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.exact import Disc, Rect, Touch
from grader.checks.strategies import any_velocities, belts, circles, discs_near_boxes, pairs
from grader.checks.telling import want_told
from grader.judge.drawing import given
from grader.judge.lab import NOTHING, Broke, Lab, Thing
from grader.protocol import ContactValue

BOX = Rect(0, 0, 40, 20)
ROUND = range(0, 1000, 50)  # px
MASSES = (1.0, 1e-3, 1e6, 0.05, 1e3)  # kg; a contact does not hang on them
MOVING = {"vel": (1.5, -300.0), "omega": 4.0, "angle": 1.0}  # what the contact does not hang on
Fields = dict[str, Any]


def pair(
    lab: Lab, disc: Disc, rect: Rect, circle: Fields | None = None, box: Fields | None = None
) -> tuple[Thing, Thing]:
    """A circle and a box, each with further fields, for the experiment that begins here."""
    lab.ran(asked(disc, rect))
    return (
        lab.circle((disc.x, disc.y), disc.r, **(circle or {})),
        lab.box((rect.x, rect.y), (rect.hx, rect.hy), **(box or {})),
    )


def asked(disc: Disc, rect: Rect) -> str:
    return (
        f"circle_box of a circle r {disc.r:g} at ({disc.x:g}, {disc.y:g}) and a box with half "
        f"extents ({rect.hx:g}, {rect.hy:g}) at ({rect.x:g}, {rect.y:g})"
    )


def touch(
    lab: Lab,
    circle: Thing,
    box: Thing,
    disc: Disc,
    rect: Rect,
    twice: bool = True,
    noted: bool = True,
) -> Touch | None:
    """What the submission's circle_box says of these two, where disc and rect say they are.

    An answer that is not `noted` is not held against the known mistakes.
    """
    if lab.running != asked(disc, rect):
        lab.ran(asked(disc, rect))  # the two are elsewhere now
    try:
        contact = lab.contact_or_none(
            lab.call("circle_box", circle, box, changes=NOTHING, twice=twice)
        )
    except Broke as failure:
        if failure.raised is not None and noted:
            lab.saw("circle_box", (disc, rect), failure.raised.error)
        raise
    answer = None
    if contact is not None:
        normal, point = contact.normal, contact.point
        answer = Touch(normal.x, normal.y, contact.depth, point.x, point.y)
    if noted:
        lab.saw("circle_box", (disc, rect), answer)
    if contact is not None:
        want_new(lab, contact, circle, box, (disc, rect) if noted else None)
    return answer


def want_new(
    lab: Lab,
    contact: ContactValue,
    circle: Thing,
    box: Thing,
    noted: tuple[Disc, Rect] | None,
) -> None:
    """Of these two, and with no impulse yet; then it gets some, which are no other contact's."""
    order = contact.a == circle.ref, contact.b == box.ref
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
    lab.put(Thing(contact.ref), jn=12.0, jt=-5.0)


def say(answer: Touch | None, digits: int = 3) -> str:
    if answer is None:
        return "None"
    nx, ny, depth, px, py = answer  # plain numbers, where the answer was recorded
    normal = f"({nx:.{digits}f}, {ny:.{digits}f})"
    point = f"({px:.{digits - 1}f}, {py:.{digits - 1}f})"
    return f"normal {normal}, depth {depth:.{digits}f} px, point {point}"


def want(lab: Lab, answer: Touch | None, right: list[Touch | None], of: str = "") -> None:
    """One of the right answers."""
    good = any(same(answer, each) for each in right)
    want_told(lab, good, say, right[0], answer, expected=of + "{}")


def want_exact(lab: Lab, discs: Iterable[Disc], **circle: Any) -> None:
    """The right answers about these discs and the box, all of them as large and where they are."""
    size, x, y = lab.about(1.0), lab.about(0.0, 64.0), lab.about(0.0, 64.0)
    box = Rect(x, y, size * BOX.hx, size * BOX.hy)
    for each in discs:
        disc = Disc(x + size * each.x, y + size * each.y, size * each.r)
        things = pair(lab, disc, box, circle)
        want(lab, touch(lab, *things, disc, box), exact.circle_box(disc, box))


def same(answer: Touch | None, right: Touch | None) -> bool:
    """Alike but for rounding, which grows with the numbers."""
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
        Disc(5, -20.125, 10),  # hardly outside a face and a corner
        Disc(40.0625, 20.125, 10),
        Disc(3, -30, 90),  # larger than the box
        Disc(-5, -29.9375, 10),  # hardly at all
    )
    want_exact(lab, discs)
    for n, (disc, rect) in enumerate(near_round_numbers(lab.about(1 / 8))):
        things = pair(lab, disc, rect, {"mass": MASSES[n % len(MASSES)]})
        answer = touch(lab, *things, disc, rect, twice=False, noted=False)
        want(lab, answer, exact.circle_box(disc, rect))


def near_round_numbers(off: float) -> Iterable[tuple[Disc, Rect]]:
    """Faces and centres that are nearly at each round place of the window, and distances alike.

    Whoever takes such a number for the round one (or a small one for 0) gives another answer.
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
    """A centre inside the box leaves by the nearest face"""
    discs = (
        Disc(5, -15, 8),
        Disc(-33, 4, 8),
        Disc(3, 12, 8),
        Disc(35, 1, 8),
        Disc(29, -10, 8),  # nearer to the top, though closer to the right by shares of the box
        Disc(-30, -6, 8),  # each nearer to a face than to the next one, by a little
        Disc(30, 6, 8),
        Disc(-25, -8, 8),
        Disc(25, 8, 8),
    )
    want_exact(lab, discs)
    middle = Disc(BOX.x, BOX.y, 8)  # two faces are equally near, and either will do
    answer = touch(lab, *pair(lab, middle, BOX), middle, BOX, noted=False)
    want(lab, answer, exact.circle_box(middle, BOX))


def a_centre_on_the_edge_counts_as_inside(lab: Lab) -> None:
    """A centre exactly on a face or a corner"""
    discs = Disc(7, -20, 8), Disc(-40, 3, 8), Disc(9, 20, 8), Disc(40, -6, 8), Disc(40, 20, 8)
    want_exact(lab, discs, **MOVING)


def no_contact_when_apart_or_just_touching(lab: Lab) -> None:
    """No contact when the two are apart or only touch"""
    discs = Disc(0, -60, 10), Disc(50, 0, 10), Disc(-10, 30, 10), Disc(47, 27, 9), Disc(48, 26, 10)
    want_exact(lab, discs, **MOVING)


@given(both=discs_near_boxes(), circle=circles, box=belts)
def any_circle_and_box_agree_with_the_geometry(
    lab: Lab, both: tuple[Disc, Rect], circle: Fields, box: Fields
) -> None:
    """Any circle and box: normal, depth and point agree with the geometry"""
    want(lab, touch(lab, *pair(lab, *both, circle, box), *both), exact.circle_box(*both))


@given(
    both=discs_near_boxes(),
    shift=pairs,
    flip=st.sampled_from([(-1, 1), (1, -1), (-1, -1)]),
    circle=circles,
    vel=any_velocities,
)
def a_mirrored_or_moved_pair_touches_alike(
    lab: Lab,
    both: tuple[Disc, Rect],
    shift: tuple[float, float],
    flip: tuple[int, int],
    circle: Fields,
    vel: tuple[float, float],
) -> None:
    """A mirrored or moved pair touches in the mirrored or moved way"""
    disc, rect = both
    if exact.equally_near(disc, rect):
        return  # either face is right, and mirroring may choose the other
    disc_there = disc._replace(x=flip[0] * disc.x + shift[0], y=flip[1] * disc.y + shift[1])
    rect_there = rect._replace(x=flip[0] * rect.x + shift[0], y=flip[1] * rect.y + shift[1])
    things = pair(lab, disc, rect, circle)
    first = touch(lab, *things, disc, rect, twice=False)
    image = first and Touch(
        flip[0] * first.nx,
        flip[1] * first.ny,
        first.depth,
        flip[0] * first.px + shift[0],
        flip[1] * first.py + shift[1],
    )
    lab.put(things[0], pos=(disc_there.x, disc_there.y), vel=vel)
    lab.put(things[1], pos=(rect_there.x, rect_there.y))
    there = touch(lab, *things, disc_there, rect_there, twice=False)
    want(lab, there, [image], "the image of the first contact: ")
    lab.put(things[0], pos=(disc.x, disc.y))
    lab.put(things[1], pos=(rect.x, rect.y))
    back = touch(lab, *things, disc, rect, twice=False)
    want(lab, back, [first], "back in place, the first contact again: ")


def a_world_finds_the_ball_on_its_floor(lab: Lab) -> None:
    """A world finds the contacts of balls with their floor, in any order"""
    lab.ran("find_contacts in a world with a floor, two balls 2 px deep in it, and a ball above")
    x, y = lab.about(0.0, 64.0), lab.about(0.0, 64.0)
    first, second = (
        lab.circle((x + left, y - 8.0), 10.0, vel=(0.0, vy))
        for left, vy in ((30.0, 50.0), (-90.0, -50.0))
    )
    high = lab.circle((x - 60.0, y - 40.0), 10.0)
    floor = lab.box((x, y + 20.0), (200.0, 20.0))
    for bodies in ((first, second, high, floor), (floor, high, second, first)):
        world = lab.world(*bodies)
        found = lab.tell(world, "find_contacts") or lab.get(world, "contacts")
        contacts = [lab.contact_or_none(each) for each in lab.items(found, "the contacts")]
        lab.want(
            sorted((c.a, c.b) for c in contacts if c)
            == sorted((ball.ref, floor.ref) for ball in (first, second)),
            "two contacts: each low ball as A with the floor as B",
            f"{len(contacts)} contacts" if len(contacts) != 2 else "contacts of others",
        )
