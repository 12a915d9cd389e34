"""TODO B3: near_pairs, which leaves out the pairs that are far apart.

Whatever finds the pairs, in whatever order: the contacts must be those of all pairs.
"""

from collections import Counter

from hypothesis import given
from hypothesis import strategies as st

from grader.checks.exact import Disc, Rect
from grader.checks.strategies import discs, rects
from grader.judge.lab import Lab, Pair, Thing

Contacts = Counter[tuple[int, ...]]  # how many each two bodies have, by their numbers

BALLS = 200
SHARE = 10  # at most one pair in so many may be looked at


def crowd(lab: Lab, balls: list[Disc], boxes: list[Rect]) -> tuple[Thing, list[Thing]]:
    """A world, and the bodies in it."""
    bodies = [lab.circle((ball.x, ball.y), ball.r) for ball in balls]
    bodies += [lab.box((box.x, box.y), (box.hx, box.hy)) for box in boxes]
    return lab.world(*bodies, bonus=True), bodies


def touching(lab: Lab, world: Thing, bodies: list[Thing], grid: bool) -> Contacts:
    """How many contacts each two bodies have; -1 is a body of another world."""
    numbers = {body.ref: number for number, body in enumerate(bodies)}
    lab.put(world, grid=grid)
    found = lab.items(lab.tell(world, "find_contacts"), "what find_contacts returns")
    contacts = [lab.contact_or_none(each) for each in found]
    ends = [(each.a, each.b) for each in contacts if each]
    return Counter(tuple(sorted(numbers.get(ref, -1) for ref in both)) for both in ends)


def want_the_same_contacts(lab: Lab, balls: list[Disc], boxes: list[Rect]) -> None:
    """Compare with all pairs."""
    world, bodies = crowd(lab, balls, boxes)
    right, found = without_and_with(lab, world, bodies)
    lab.saw("contacts", (balls, boxes, sorted(right)), sorted(found.elements()))
    want_no_other(lab, right, found)


def without_and_with(lab: Lab, world: Thing, bodies: list[Thing]) -> tuple[Contacts, Contacts]:
    """The contacts of all pairs, and those that the grid leaves."""
    return touching(lab, world, bodies, grid=False), touching(lab, world, bodies, grid=True)


def want_no_other(lab: Lab, right: Contacts, found: Contacts) -> None:
    lost, more = (right - found).total(), (found - right).total()
    wanted = f"as many contacts as from all pairs: {right.total()}"
    lab.want(not lost, wanted, f"{lost} of them missing")
    lab.want(
        not more,
        wanted,
        f"{more} more",
        "A pair that shares several cells counts once all the same.",
    )


def large_bodies_touch_whatever_lies_on_them(lab: Lab) -> None:
    """A floor much larger than a cell touches every ball on it, left of 0 as well"""
    lab.ran("find_contacts with 41 balls on a floor 2000 px long, half of it left of x = 0")
    balls = [Disc(48.0 * number, -9.5, 10.0) for number in range(-20, 21)]
    want_the_same_contacts(lab, balls, [Rect(0.0, 300.0, 1000.0, 300.0)])
    lab.ran("find_contacts with a ball of radius 300 px that touches 12 balls of 10 px at its rim")
    rim = [(x * 309.0, y * 309.0) for x, y in ROUND]
    small = [Disc(x - 50.0, y - 50.0, 10.0) for x, y in rim]
    want_the_same_contacts(lab, [Disc(-50.0, -50.0, 300.0), *small], [])


ROUND = [
    *((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)),
    *((x * 0.6, y * 0.8) for x in (-1, 1) for y in (-1, 1)),
    *((x * 0.8, y * 0.6) for x in (-1, 1) for y in (-1, 1)),
]


@given(balls=st.lists(discs, min_size=1, max_size=6), boxes=st.lists(rects, max_size=2))
def any_scene_has_the_contacts_of_all_pairs(lab: Lab, balls: list[Disc], boxes: list[Rect]) -> None:
    """Any scene has the contacts that all pairs have, each once"""
    shapes = [f"a ball r {ball.r:g} at ({ball.x:g}, {ball.y:g})" for ball in balls]
    shapes += [f"a box of half ({b.hx:g}, {b.hy:g}) at ({b.x:g}, {b.y:g})" for b in boxes]
    lab.ran(f"find_contacts with {', '.join(shapes)}")
    want_the_same_contacts(lab, balls, boxes)


def contacts_follow_the_bodies(lab: Lab) -> None:
    """What moved since the last step is looked for where it is now"""
    lab.ran("find_contacts with two balls far apart, and again after one moved to the other")
    world, bodies = crowd(lab, [Disc(0.0, 0.0, 10.0), Disc(500.0, 0.0, 10.0)], [])
    want_no_other(lab, *without_and_with(lab, world, bodies))
    lab.put(bodies[1], pos=(15.0, 0.0))
    want_no_other(lab, *without_and_with(lab, world, bodies))


def two_hundred_balls_are_not_compared_pair_by_pair(lab: Lab) -> None:
    """Of 200 balls only those near each other are looked at"""
    lab.ran(f"find_contacts with {BALLS} balls, two and two, in a room of 1000 by 600 px")
    balls = [Disc(*place, 8.0 + number % 4) for number, place in enumerate(room())]
    world, bodies = crowd(lab, balls, [])
    contacts = BALLS // 2
    found = touching(lab, world, bodies, grid=True).total()
    lab.want(found == contacts, f"{contacts} contacts, one for each pair", f"{found}")
    pairs = BALLS * (BALLS - 1) // 2
    most = pairs // SHARE
    calls = lab.count(["collide"], world, "find_contacts")
    lab.saw("comparison of all", (BALLS,), calls == pairs)
    lab.want(
        contacts <= calls <= most,
        f"collide called for each of the contacts, and {most} times at the most",
        f"{calls} calls",
    )


def room() -> list[Pair]:
    """Places all over the room, for pairs of balls that touch; no two pairs are level."""
    return [
        (45.0 + 90.0 * column + 9.0 * row + 15.0 * which, 15.0 + 60.0 * row + 6.0 * column)
        for row in range(10)
        for column in range(10)
        for which in range(2)
    ]
