"""TODO B4: counting the hits of pegs with pymunk's collision callbacks."""

import math
from dataclasses import dataclass
from itertools import pairwise

from grader.checks.todo_7.checks import BOB, is_near, pair, scene
from grader.judge.lab import NOTHING, Lab, Moment, Pair, Thing
from grader.protocol import ShapeValue

PEGS = ((375.0, 400.0), (435.0, 400.0))  # px, the first two
LEDGE = (200.0, 270.0)  # px, in the middle of its lower side
FREE = (820.0, 250.0)  # px, above nothing but the floor
SPEED = 600.0  # px/s
TOUCHING = 17.0  # px from a peg's middle, which the smallest ball overlaps, as all do
STEPS = 30  # for a throw: enough for 100 px and part of the way back


@dataclass
class Course:
    """The lab scene without gravity: bodies move only when thrown."""

    space: Thing
    balls: list[Thing]
    radii: list[float]  # px, of the balls
    box: Thing
    data: Thing  # the result of count_hits
    elasticity: float  # of a ball and a peg, multiplied as pymunk does
    speed: float  # px/s, of what is thrown


def course(lab: Lab) -> Course:
    found = scene(lab)
    space = lab.thing(found)
    lab.put(space, gravity=(0.0, 0.0), damping=1.0)
    moving = [body for body in found.bodies if body.kind == "dynamic" and body.shapes]
    moving = [body for body in moving if not is_near(pair(body.pos), BOB, 1.0)]
    balls = [each for each in moving if each.shapes[0].kind == "Circle"]
    boxes = [each for each in moving if each.shapes[0].kind == "Poly"]
    lab.want(len(balls) > 1 and bool(boxes), "balls and boxes in the scene", "none")
    data = lab.thing(lab.get(space, "counter"), "a dictionary from count_hits")
    static = [shape for body in found.bodies if body.kind == "static" for shape in body.shapes]
    pegs = [shape for shape in static if shape.kind == "Circle"]
    peg = min(pegs, key=lambda each: math.dist(find_middle(each), PEGS[0]))
    product = peg.elasticity * balls[0].shapes[0].elasticity
    return Course(
        space,
        [lab.thing(each) for each in balls],
        [each.shapes[0].radius for each in balls],
        lab.thing(boxes[0]),
        data,
        product,
        lab.about(SPEED, 60.0),
    )


def find_middle(shape: ShapeValue) -> Pair:
    left, bottom, right, top = shape.box
    return (left + right) / 2, (bottom + top) / 2


def hits(lab: Lab, course: Course) -> int:
    return round(lab.number(lab.tell(course.data, "get", "hits"), "the hits"))


def step_on(lab: Lab, course: Course, body: Thing) -> Moment:
    """Run some steps; return a body's last motion."""
    return lab.simulate(course.space, [body], STEPS, every=STEPS).body(0)[-1]


def throw(lab: Lab, course: Course, body: Thing, target: Pair, way: int = 1) -> Moment:
    """Throw a body from 100 px away straight down (way 1) or up (-1); return its last motion."""
    x, y = target
    lab.put(body, position=(x, y - 100.0 * way), velocity=(0.0, course.speed * way))
    return step_on(lab, course, body)


def want_hits(lab: Lab, found: list[int], right: list[int]) -> None:
    """Insist on the number of hits after these events."""
    lab.want(
        found == right,
        f"hits {', '.join(map(str, right))} in turn",
        f"hits {', '.join(map(str, found))} in turn",
    )


def every_hit_of_a_peg_counts_once(lab: Lab) -> None:
    """Every hit of a peg counts, and counts once"""
    lab.ran(
        f"no gravity: a ball thrown at pegs again and again, then {STEPS} steps against one, "
        "and then far from it"
    )
    here = course(lab)
    ball = here.balls[0]
    step_on(lab, here, ball)
    counts = [hits(lab, here)]
    times = 3 + abs(lab.whole(0, 3))  # seeded, so that the times of hits cannot be hard-coded
    for peg in (*[PEGS[0]] * (times - 1), PEGS[1]):
        last = throw(lab, here, ball, peg)
        counts.append(hits(lab, here))
        lab.saw("hits", ("throw", STEPS), counts[-1] - counts[-2])
    lab.put(ball, position=(PEGS[0][0], PEGS[0][1] - TOUCHING), velocity=(0.0, 0.0))
    step_on(lab, here, ball)
    counts.append(hits(lab, here))
    lab.saw("hits", ("touch", STEPS), counts[-1] - counts[-2])
    lab.put(ball, position=FREE)
    step_on(lab, here, ball)
    counts.append(hits(lab, here))
    lab.saw("hits", ("leave", STEPS), counts[-1] - counts[-2])
    want_hits(lab, counts, [*range(times + 2), times + 1])
    lab.want(last.vy < 0, "a ball that bounces off the peg", f"its speed is {last.vy:.0f} px/s")
    bounce = here.elasticity * here.speed  # both surfaces count, as a product
    lab.want(
        abs(last.vy + bounce) < 0.05 * here.speed,
        f"a ball that bounces off the peg at {bounce:.0f} px/s, counted or not",
        f"at {-last.vy:.0f} px/s",
        "count_hits only counts: what bounces must bounce as it would without it.",
    )
    two_balls_hit_two_pegs_at_once(lab, here)


def two_balls_hit_two_pegs_at_once(lab: Lab, here: Course) -> None:
    lab.ran("no gravity: two balls thrown at two pegs, which they hit in the same step")
    before = hits(lab, here)
    # No whole number of steps ends exactly at a touch, where rounding would decide.
    for ball, radius, (x, y) in zip(here.balls, here.radii, PEGS, strict=False):
        lab.put(ball, position=(x, y - 59.3 - radius), velocity=(0.0, here.speed))
    step_on(lab, here, here.balls[0])
    want_hits(lab, [hits(lab, here) - before], [2])


def only_balls_on_pegs_count_in_each_space_apart(lab: Lab) -> None:
    """Only balls that hit pegs count, and every space has its own count"""
    lab.ran("no gravity: a ball thrown at a ball, one at the ledge, a box at a peg")
    here = course(lab)
    ball, other = here.balls[:2]
    lab.put(other, position=FREE)
    step_on(lab, here, other)
    counts = [hits(lab, here)]
    for body, target, way in ((ball, FREE, 1), (ball, LEDGE, -1), (here.box, PEGS[1], 1)):
        throw(lab, here, body, target, way)
        lab.put(other, velocity=(0.0, 0.0))
        counts.append(hits(lab, here))
    lab.saw("others", (), [after - before for before, after in pairwise(counts)])
    want_hits(lab, counts, [0, 0, 0, 0])
    lab.ran("no gravity: a ball thrown at a peg; then make_space, as R does, and the same again")
    here = course(lab)
    throw(lab, here, here.balls[0], PEGS[0])
    for _ in range(4):
        afresh = course(lab)
    counts = [hits(lab, here), hits(lab, afresh)]
    lab.saw("afresh", (counts[0],), counts[1])
    throw(lab, afresh, afresh.balls[0], PEGS[0])
    want_hits(lab, [*counts, hits(lab, afresh)], [1, 0, 1])
    lab.ran("count_hits in a space of its own")
    space = lab.make("pymunk:Space")
    lab.put(space, gravity=(3.5, 700.25), damping=0.8125, iterations=7)
    body = lab.make("pymunk:Body", 1.0, 100.0)
    lab.put(body, velocity=(lab.about(40.0), -30.0), angular_velocity=0.5)
    lab.let(space, "add", body)
    disc = lab.make("pymunk:Circle", body, 8.0)
    lab.put(disc, elasticity=0.28125, friction=0.40625)
    lab.let(space, "add", disc)
    lab.call("count_hits", space, changes=NOTHING)
    surface = lab.get(disc, "elasticity"), lab.get(disc, "friction")
    lab.want(
        surface == (0.28125, 0.40625),
        "a disc of elasticity 0.28125 and friction 0.40625, as it was given",
        f"one of {surface[0]} and {surface[1]}",
    )
