"""TODO 1: circle_box, from outside and from inside."""

import math

from hypothesis import given
from hypothesis import strategies as st

from grader.checks import exact
from grader.checks.exact import Disc, Rect, Touch
from grader.checks.strategies import discs_near_boxes, pairs
from grader.judge.lab import NOTHING, Broke, Lab

BOX = Rect(0, 0, 40, 20)


def touch(lab: Lab, disc: Disc, rect: Rect) -> Touch | None:
    """What the submission's circle_box says of a disc and a box."""
    lab.ran(
        f"circle_box of a circle r {disc.r:g} at ({disc.x:g}, {disc.y:g}) and a box with half "
        f"extents ({rect.hx:g}, {rect.hy:g}) at ({rect.x:g}, {rect.y:g})"
    )
    circle = lab.circle((disc.x, disc.y), disc.r)
    box = lab.box((rect.x, rect.y), (rect.hx, rect.hy))
    try:
        contact = lab.contact_or_none(
            lab.call("circle_box", circle, box, changes=NOTHING, twice=True)
        )
    except Broke as failure:
        if failure.raised is not None:
            lab.saw("circle_box", (disc, rect), failure.raised.error)
        raise
    answer = None
    if contact is not None:
        normal, point = contact.normal, contact.point
        answer = Touch(normal.x, normal.y, contact.depth, point.x, point.y)
    lab.saw("circle_box", (disc, rect), answer)
    if contact is not None:
        order = contact.a == circle.ref, contact.b == box.ref
        lab.saw("order", (), order)
        lab.want(
            order == (True, True),
            "a contact with the circle as A and the box as B",
            "other bodies, or the two the other way round",
        )
    return answer


def say(answer: Touch | None) -> str:
    if answer is None:
        return "None"
    nx, ny, depth, px, py = answer
    return f"normal ({nx:.3f}, {ny:.3f}), depth {depth:.3f} px, point ({px:.2f}, {py:.2f})"


def want_exact(lab: Lab, disc: Disc, rect: Rect) -> None:
    answer, right = touch(lab, disc, rect), exact.circle_box(disc, rect)
    lab.want(any(same(answer, each) for each in right), say(right[0]), say(answer))


def same(answer: Touch | None, right: Touch | None) -> bool:
    if answer is None or right is None:
        return answer is right
    size = max(map(abs, right))
    return all(abs(a - b) <= 1e-9 * max(1.0, size) for a, b in zip(answer, right, strict=True))


def overlap_from_outside_points_into_the_box(lab: Lab) -> None:
    """A circle that overlaps from outside: normal, depth and closest point"""
    for disc in (
        Disc(10, -25, 10),  # above, on the left, below, on the right
        Disc(-46, 5, 10),
        Disc(-10, 28, 10),
        Disc(44, -5, 10),
        Disc(43, -24, 10),  # at two corners
        Disc(-46, 28, 15),
        Disc(5, -20.125, 10),  # hardly outside a face and a corner
        Disc(40.0625, 20.125, 10),
    ):
        want_exact(lab, disc, BOX)


def a_centre_inside_leaves_by_the_nearest_face(lab: Lab) -> None:
    """A centre inside the box leaves by the nearest face"""
    for disc in (Disc(5, -15, 8), Disc(-33, 4, 8), Disc(3, 12, 8), Disc(35, 1, 8)):
        want_exact(lab, disc, BOX)


def a_centre_on_the_edge_counts_as_inside(lab: Lab) -> None:
    """A centre exactly on a face or a corner"""
    for disc in (Disc(7, -20, 8), Disc(-40, 3, 8), Disc(40, 20, 8)):
        want_exact(lab, disc, BOX)


def no_contact_when_apart_or_just_touching(lab: Lab) -> None:
    """No contact when the two are apart or only touch"""
    for disc in (Disc(0, -60, 10), Disc(50, 0, 10), Disc(-10, 30, 10), Disc(47, 27, 9)):
        want_exact(lab, disc, BOX)


@given(both=discs_near_boxes())
def any_circle_and_box_agree_with_the_geometry(lab: Lab, both: tuple[Disc, Rect]) -> None:
    """Any circle and box: normal, depth and point agree with the geometry"""
    want_exact(lab, *both)


@given(both=discs_near_boxes(), shift=pairs, flip=st.sampled_from([(-1, 1), (1, -1), (-1, -1)]))
def a_mirrored_or_moved_pair_touches_alike(
    lab: Lab, both: tuple[Disc, Rect], shift: tuple[float, float], flip: tuple[int, int]
) -> None:
    """A mirrored or moved pair touches in the mirrored or moved way"""
    disc, rect = both
    if exact.equally_near(disc, rect):
        return  # either face is right, and mirroring may choose the other
    first = touch(lab, disc, rect)
    second = touch(
        lab,
        Disc(flip[0] * disc.x + shift[0], flip[1] * disc.y + shift[1], disc.r),
        Rect(flip[0] * rect.x + shift[0], flip[1] * rect.y + shift[1], rect.hx, rect.hy),
    )
    image = first and Touch(
        flip[0] * first.nx,
        flip[1] * first.ny,
        first.depth,
        flip[0] * first.px + shift[0],
        flip[1] * first.py + shift[1],
    )
    lab.want(
        (second is None and image is None)
        or (second is not None and image is not None and close(second, image)),
        f"the image of the first contact: {say(image)}",
        say(second),
    )


def close(first: Touch, second: Touch) -> bool:
    return all(math.isclose(a, b, abs_tol=1e-6) for a, b in zip(first, second, strict=True))


def a_world_finds_the_ball_on_its_floor(lab: Lab) -> None:
    """A world finds the contact of a ball with its floor, in either order"""
    lab.ran("find_contacts in a world with a floor, a ball 2 px deep in it, and a ball above")
    low, high = lab.circle((30.0, -8.0), 10.0), lab.circle((-60.0, -40.0), 10.0)
    floor = lab.box((0.0, 20.0), (200.0, 20.0))
    for bodies in ((low, high, floor), (floor, high, low)):
        world = lab.world(*bodies)
        found = lab.tell(world, "find_contacts") or lab.get(world, "contacts")
        contacts = [lab.contact_or_none(each) for each in lab.items(found, "the contacts")]
        lab.want(
            [(c.a, c.b) for c in contacts if c] == [(low.ref, floor.ref)],
            "one contact: the low ball as A and the floor as B",
            f"{len(contacts)} contacts" if len(contacts) != 1 else "a contact of others",
        )
