"""TODO B3: near_pairs, which leaves out pairs that are far apart.

Any method and any order is accepted: the contacts must equal those of all pairs.
"""

from collections import Counter
from collections.abc import Sequence
from itertools import zip_longest
from random import Random
from typing import Any

from hypothesis import strategies as st

from grader.checks.exact import Disc, Rect
from grader.checks.strategies import crowd_discs, crowd_rects, pairs, seeds
from grader.judge.drawing import given
from grader.judge.lab import Lab, Pair, Thing

Contacts = Counter[tuple[int, ...]]  # number of contacts of each pair, by the bodies' numbers

BALLS = 200
PLACES = [(0.0, 0.0), (900.0, 600.0), (-40_000.0, 500_000.0)]  # px; where a scene is
WHOLE_CELLS = 4800.0  # px: many cells of each size that AT_THE_RIM asks about
A_HAIR = 1 / 64  # px
GROWTH = 3.0  # work with twice the balls: times 4 for all pairs, else a little over 2


def crowd(
    lab: Lab, balls: list[Disc], boxes: list[Rect], states: Sequence[dict[str, Any]] = ()
) -> tuple[Thing, list[Thing]]:
    """Return a world and its bodies; `states` may set the motion of the first balls."""
    bodies = [
        lab.circle((ball.x, ball.y), ball.r, **(state or {}))
        for ball, state in zip_longest(balls, states)
    ]
    bodies += [lab.box((box.x, box.y), (box.hx, box.hy)) for box in boxes]
    return lab.world(*bodies, bonus=True), bodies


def count_contacts(lab: Lab, world: Thing, bodies: list[Thing], grid: bool) -> Contacts:
    """Return the number of contacts of each pair; -1 is a body of another world."""
    numbers = {body.ref: number for number, body in enumerate(bodies)}
    lab.put(world, grid=grid)
    answer = lab.tell(world, "find_contacts", changes={world: "contacts"})
    found = lab.items(answer, "what find_contacts returns")
    contacts = [lab.contact_or_none(each) for each in found]
    ends = [(each.a, each.b) for each in contacts if each]
    return Counter(tuple(sorted(numbers.get(ref, -1) for ref in both)) for both in ends)


def want_the_same_contacts(lab: Lab, balls: list[Disc], boxes: list[Rect]) -> None:
    """Compare with all pairs, after a shift left by multiples of many cell sizes."""
    left = -WHOLE_CELLS * abs(lab.whole(0, 9))
    balls = [each._replace(x=each.x + left) for each in balls]
    boxes = [each._replace(x=each.x + left) for each in boxes]
    want_no_other(lab, *crowd(lab, balls, boxes), (balls, boxes))


def want_no_other(
    lab: Lab, world: Thing, bodies: list[Thing], shapes: tuple[list[Disc], list[Rect]] | None = None
) -> None:
    """Insist on the contacts of all pairs; with `shapes`, note the answer for known mistakes."""
    right, found = (count_contacts(lab, world, bodies, grid) for grid in (False, True))
    if shapes:
        lab.saw("contacts", (*shapes, sorted(right)), sorted(found.elements()))
    lost, more = (right - found).total(), (found - right).total()
    wanted = f"as many contacts as from all pairs: {right.total()}"
    lab.want(not lost, wanted, f"{lost} of them missing")
    lab.want(
        not more,
        wanted,
        f"{more} more",
        "Each pair comes once, however many cells it shares, and no body with itself.",
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
    lab.ran("find_contacts with 61 balls on a floor 12 000 px long, and 61 at a wall as high")
    floor, wall = Rect(300.0, 20.0, 6000.0, 20.0), Rect(-6100.0, 0.0, 20.0, 6000.0)
    level = [Disc(200.0 * number, -9.5, 10.0) for number in range(-28, 33)]
    upright = [Disc(-6070.5, 190.0 * number, 10.0) for number in range(-30, 31)]
    want_the_same_contacts(lab, [*level, *upright], [floor, wall])
    lab.ran("find_contacts with balls that overlap by half a pixel, left of 0 and above it")
    want_the_same_contacts(lab, AT_THE_RIM, [])
    lab.ran("find_contacts with 100 balls of 1 px so close together that a cell holds them all")
    crowded = [Disc(10 + 1.75 * (n % 10), 10 + 1.75 * (n // 10), 1.0) for n in range(100)]
    want_the_same_contacts(lab, crowded, [])
    lab.ran("find_contacts with balls that overlap just left of 0, above it, at 640 and at 928 px")
    at_0 = [Disc(each, 300.0, 10.0) for each in (-8.0, -25.0)]
    at_0 += [Disc(600.0, each, 10.0) for each in (-8.0, -25.0)]
    want_the_same_contacts(lab, [*at_0, *two_at(640.0), *two_at(928.0)], [])


def two_at(line: float, before: float = -10.25, behind: float = 9.25) -> list[Disc]:
    """Return balls on both sides of a line: two side by side, two above each other.

    By default they overlap by half a pixel.
    """
    places = line + before, line + behind
    side_by_side = [Disc(each, 40.0 * line, 10.0) for each in places]
    return side_by_side + [Disc(40.0 * line + 500.0, each, 10.0) for each in places]


SIZES = (32.0, 40.0, 48.0, 50.0, 64.0, 96.0, 100.0)  # px, of cells
# The balls barely share a cell, for many cell sizes; rounding towards 0 puts them in two.
AT_THE_RIM = [ball for size in SIZES for ball in two_at(-size)]
# Here they barely share none, as they do not touch.
ON_BOTH_SIDES = [ball for size in SIZES for ball in two_at(-size, -10.0 - A_HAIR, 10.0 + A_HAIR)]


ROUND = [
    *((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)),
    *((x * 0.6, y * 0.8) for x in (-1, 1) for y in (-1, 1)),
    *((x * 0.8, y * 0.6) for x in (-1, 1) for y in (-1, 1)),
]


def make_states(seed: int, count: int) -> list[dict[str, Any]]:
    """Return masses, motions and surfaces that must not matter.

    They come from one number: a report names none of them, so none has to become simpler.
    """
    random = Random(seed)
    speeds = (0.0, 1 / 64, -37.5, 500.0, -20_000.0)  # px/s, and for spins a hundredth
    return [
        {
            "mass": random.choice((0.0, 1 / 1024, 2.0, 50.0, 1e6)),
            "vel": (random.choice(speeds), random.choice(speeds)),
            "omega": random.choice(speeds) / 100,
            "angle": random.choice(speeds) / 100,
            "friction": random.choice((0.0, 0.5, 1.0)),
            "restitution": random.choice((0.0, 0.5, 1.0)),
        }
        for _ in range(count)
    ]


@given(
    balls=st.lists(crowd_discs, min_size=1, max_size=8),
    boxes=st.lists(crowd_rects, max_size=2),
    seed=seeds,
    sleepers=st.sets(st.integers(0, 7)),
    shift=pairs,
    place=st.sampled_from(PLACES),
)
def any_scene_has_the_contacts_of_all_pairs(
    lab: Lab,
    balls: list[Disc],
    boxes: list[Rect],
    seed: int,
    sleepers: set[int],
    shift: Pair,
    place: Pair,
) -> None:
    """Any scene has the contacts that all pairs have, each once"""
    x, y = place
    balls = [ball._replace(x=ball.x + x, y=ball.y + y) for ball in balls]
    boxes = [box._replace(x=box.x + x, y=box.y + y) for box in boxes]
    shapes = [f"a ball r {ball.r:g} at ({ball.x:g}, {ball.y:g})" for ball in balls]
    shapes += [f"a box of half ({b.hx:g}, {b.hy:g}) at ({b.x:g}, {b.y:g})" for b in boxes]
    lab.ran(f"find_contacts with {', '.join(shapes)}")
    world, bodies = crowd(lab, balls, boxes, make_states(seed, len(balls)))
    want_no_other(lab, world, bodies, (balls, boxes))
    for number in sleepers & set(range(len(balls))):
        lab.put(bodies[number], asleep=True)
    lab.ran(f"{lab.running}, the first one moved by {shift} and some asleep")
    balls = [Disc(balls[0].x + shift[0], balls[0].y + shift[1], balls[0].r), *balls[1:]]
    lab.put(bodies[0], pos=balls[0][:2])
    want_no_other(lab, world, bodies, (balls, boxes))


def contacts_follow_the_bodies(lab: Lab) -> None:
    """Bodies that moved since the last step are found at their new positions"""
    lab.ran("find_contacts with two balls far apart, and again after one moved to the other")
    x, y = lab.about(0.0, 256.0), lab.about(0.0, 256.0)
    world, bodies = crowd(lab, [Disc(x, y, 10.0), Disc(x + 500.0, y, 10.0)], [])
    want_no_other(lab, world, bodies)
    lab.put(bodies[1], pos=(x + 15.0, y))
    want_no_other(lab, world, bodies)
    lab.ran(f"{lab.running}, and a third time when that one is asleep")
    lab.put(bodies[1], asleep=True)
    want_no_other(lab, world, bodies)
    creep = 4 * A_HAIR
    lab.ran(f"find_contacts with balls nearly touching, and again after half crept {creep:g} px")
    world, bodies = crowd(lab, ON_BOTH_SIDES, [])
    want_no_other(lab, world, bodies)
    for number, (body, each) in enumerate(zip(bodies, ON_BOTH_SIDES, strict=True)):
        if number % 2:
            lab.put(body, pos=(each.x - creep, each.y - creep))
    want_no_other(lab, world, bodies)


def two_hundred_balls_are_not_compared_pair_by_pair(lab: Lab) -> None:
    """Of 200 balls only those near each other are compared"""
    growths = []
    x = lab.about(0.0, 256.0)
    for down in (45.0, 0.0):  # px; some methods are fastest in one scene or the other
        lab.ran(f"find_contacts with {BALLS // 2} balls, two and two in a long row, and {BALLS}")
        few, many = (work(lab, row(balls, down, x)) for balls in (BALLS // 2, BALLS))
        growths.append(many / few)
        if growths[-1] <= GROWTH:
            break
    lab.saw("comparison of all", (BALLS,), min(growths) > GROWTH)
    lab.want(
        min(growths) <= GROWTH,
        f"about twice as much work for twice the balls, at most {GROWTH:g} times",
        f"{min(growths):.2f} times as many lines of your code that ran",
    )


def work(lab: Lab, balls: list[Disc]) -> int:
    """Return the number of lines that run to find the contacts.

    The call must find half of them, so doing nothing does not pass.
    """
    few = crowd(lab, balls[:2], [])[0]
    lab.put(few, grid=True)
    for _ in range(101):  # as in a scene that has run for a while
        lab.let(few, "find_contacts")
    world, bodies = crowd(lab, balls, [])
    found = count_contacts(lab, world, bodies, grid=True)
    touched, right = len(found), len(balls) // 2
    lab.want(2 * touched >= right, f"contacts of {right} pairs of balls", f"of {touched}")
    return lab.work(world, "find_contacts")


def row(balls: int, down: float, x: float) -> list[Disc]:
    """Return pairs of balls, each 60 px right of the pair before, and one more ball."""
    pairs = [
        Disc(x + 60.0 * pair + 15.0 * which, down * pair + 6.0 * which, 8.5 + (pair + which) % 3)
        for pair in range(-balls // 4, balls // 4)
        for which in range(2)
    ]
    return [*pairs, Disc(0.0, -500.0, 8.0)]
