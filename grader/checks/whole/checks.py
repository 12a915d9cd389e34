"""The whole: the student's own programs, as they are, from the first frame to the last.

Each check holds some of what the lab sheet and the lesson promise about the scene and the step, so
that a promise broken costs a point or two, and the rest of the program keeps its points.
"""

import math
import re

from grader.checks.pacing import frames_at, want_a_proper_end
from grader.checks.whole.flights import moments, want_free_flights
from grader.checks.whole.lab_scene import (
    BOB,
    FIXED,
    HOOK,
    ROD,
    SEED,
    STACK,
    moving_parts,
    pymunk_scene,
    space_parts,
    turning_as_a_disc,
    want_parts,
    world_parts,
)
from grader.checks.whole.lesson_rules import (
    EXACT,
    IMPACTS,
    want_a_free_flight,
    want_a_rod_put_right,
    want_a_total_that_is_clamped,
    want_a_way_out_for_coincident_discs,
    want_eight_passes,
    want_fresh_contacts,
    want_gravity_then_damping,
    want_impact,
    want_one_pass,
    want_the_same_pile,
)
from grader.judge.lab import STEP, Lab, Moment
from grader.protocol import BodyValue, Event, Played, Rng, SpaceBody

WIDTH = 900.0  # px
LEDGE_TOP, FLOOR_TOP = 250.0, 560.0  # px
LEDGE_LEFT, LEDGE_RIGHT = 50.0, 350.0  # px
BOB_RADIUS = 24.0  # px; the balls are smaller
MAX_BALLS = 40
RESTING = 3.0  # px, for what lies on something
LANDING = 9.0  # px: how deep a ball at 1000 px/s gets within one step
WITHIN_A_ROUNDING = 0.0051  # px, of a number printed with two digits
TIPPED = 0.2  # rad


def run(lab: Lab, seconds: float, rate: int | None = None) -> Played:
    """Play the program and insist that it ran its steps, in which free bodies fly as they must."""
    rate = rate or lab.whole(20, 2)
    lab.ran(f"the program as it is for {seconds:g} s, at {rate} frames a second")
    frames = frames_at(rate, seconds)
    played = lab.play(frames, trail_every=1)
    want_a_proper_end(lab, played, len(frames))
    steps, owed = sum(played.steps), played.clock[len(frames)] / 1000 / STEP
    least = played.clock[len(frames) - 1] / 1000 / STEP  # it may leave out the last frame
    lab.want(
        least - 2 - 1 / rate / STEP <= steps <= owed + 2,  # guess the first, or be one behind
        f"{owed:.0f} fixed steps",
        f"{steps}",
    )
    lab.want(
        all(math.isfinite(number) for row in played.trail for number in row),
        "finite numbers in every body",
        "NaN or infinity",
    )
    want_free_flights(lab, played.trail)
    return played


TENTH = 12  # steps in a tenth of a second


class Mover:
    """A ball or the bob of the mini engine, and its trail."""

    def __init__(self, radius: float, trail: list[Moment]) -> None:
        self.radius, self.trail = radius, trail
        self.tenths = trail[TENTH - 1 :: TENTH]

    def bottom(self, moment: Moment) -> float:
        return moment.y + self.radius

    def rests_at(self, top: float) -> bool:
        return abs(self.bottom(self.trail[-1]) - top) <= RESTING


def movers(played: Played) -> list[Mover]:
    """The balls and the bob of the mini engine."""
    bodies = [body for body in played.bodies if isinstance(body, BodyValue) and body.inv_mass]
    trails = zip(*map(moments, played.trail), strict=True)
    return [Mover(b.radius, list(trail)) for b, trail in zip(bodies, trails, strict=True)]


# ---------------------------------------------------------------- the mini engine


def the_scene_is_that_of_the_lesson(lab: Lab) -> None:
    """The scene holds what the lesson says, and the program begins with it"""
    seed = lab.whole(SEED, SEED)
    lab.ran(f"make_world(random.Random({seed}))")
    parts = [turning_as_a_disc(part) for part in [*FIXED, BOB]]
    want_parts(lab, world_parts(lab, seed), parts, seed)
    lab.ran("the program without running its steps, and what there is in its world")
    frames = frames_at(60, 0.2 + abs(lab.whole(0, 9)) / 60)
    played = lab.play(frames, physics=False)
    want_a_proper_end(lab, played, len(frames))
    want_the_first_scene(lab, played, "at the start")


def want_the_first_scene(lab: Lab, played: Played, when: str) -> None:
    """Insist that a program of the mini engine shows what make_world makes."""
    expected = {(*p.pos, p.shape[0], p.mass) for p in world_parts(lab) if p.mass}
    found = moving_parts(played)
    lab.want(
        {rounded(row) for row in expected} == {rounded(row) for row in found},
        f"{when} the moving bodies of make_world(random.Random({SEED}))",
        f"{len(found)} moving bodies, not all with the place, size and mass of those",
    )


def rounded(row: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(round(number, 6) for number in row)


def contacts_bounce_part_and_rub_as_the_lesson_says(lab: Lab) -> None:
    """Contacts bounce, push out and rub by the lesson's rules"""
    for impact in IMPACTS:
        want_impact(lab, impact)
    want_one_pass(lab)
    want_a_total_that_is_clamped(lab)
    want_a_way_out_for_coincident_discs(lab)


def a_step_keeps_its_stages_and_its_passes(lab: Lab) -> None:
    """A step has the lesson's stages in their order, and eight passes"""
    want_gravity_then_damping(lab)
    want_a_free_flight(lab)
    want_fresh_contacts(lab)
    want_eight_passes(lab)
    want_a_rod_put_right(lab)
    want_the_same_pile(lab)


def the_rod_swings_and_keeps_its_length(lab: Lab) -> None:
    """The pendulum swings, and its length error on exit is below 1 px"""
    played = run(lab, 1.6)
    bobs = [body for body in movers(played) if body.radius == BOB_RADIUS]
    lab.want(bool(bobs and played.rods), "a bob of radius 24 px on a rod", "no such bob, or no rod")
    leftmost = min(moment.x for moment in bobs[0].trail)
    lab.want(
        leftmost < 600.0, "a bob that swings over to x = 560", f"its leftmost x is {leftmost:.0f}"
    )
    last = bobs[0].trail[-1]
    ends = [b.pos for b in played.bodies if isinstance(b, BodyValue) and b.radius == BOB_RADIUS]
    lab.want(
        (last.x, last.y) == (ends[0].x, ends[0].y),
        "the bob where its last step left it",
        f"moved by {math.dist((last.x, last.y), tuple(ends[0])):.2g} px after that",
    )
    distance, length = played.rods[0]
    error = abs(distance - length)
    want_line_with(lab, played, {sum(played.steps)}, "the number of fixed steps that ran")
    lab.want(
        error < 1.0 and abs(length - ROD) < 1.0,
        f"a rod of {ROD:.0f} px, less than 1 px off",
        f"a rod of {length:.1f} px, {error:.2f} px off",
    )
    said = re.search(r"Pendulum length error: (\d+\.\d\d) px", "\n".join(played.lines))
    lab.want(
        said is not None and abs(float(said[1]) - error) <= WITHIN_A_ROUNDING,
        f"the line “Pendulum length error: {error:.2f} px” on exit",
        said[0] if said else "no such line",
    )


def want_line_with(lab: Lab, played: Played, numbers: set[int], what: str) -> None:
    """Insist on a printed line with one of these numbers, in whatever words."""
    any_of = "|".join(map(str, sorted(numbers)))
    lab.want(
        any(re.search(rf"(?<![\d.])({any_of})(?![\d.]*\d)", line) for line in played.lines),
        f"a line on exit with {what}, {any_of.replace('|', ' or ')}",
        "no such line",
    )


def balls_come_to_rest_on_the_ledge_and_roll_on_the_floor(lab: Lab) -> None:
    """Balls come to rest on the ledge and roll on the floor, and nothing escapes"""
    played = run(lab, 5.0)
    want_all_inside(lab, played)
    balls = [body for body in movers(played) if body.radius != BOB_RADIUS]
    lab.want(len(balls) >= 8, "8 balls", f"{len(balls)}")
    restless = max(abs(moment.vy) for ball in balls for moment in ball.tenths[-5:])
    lab.want(
        restless < 5.0,
        "balls that lie or roll, none still bouncing or falling",
        f"one that moves up or down at {restless:.1f} px/s",
    )
    on_ledge = [
        ball
        for ball in balls
        if ball.rests_at(LEDGE_TOP) and LEDGE_LEFT <= ball.trail[-1].x <= LEDGE_RIGHT
    ]
    lab.want(len(on_ledge) >= 4, "4 balls on the ledge", f"{len(on_ledge)}")
    for ball in balls:
        if ball.rests_at(FLOOR_TOP):
            begin, end = ball.tenths[-11], ball.tenths[-1]  # the last second
            way, turned = end.x - begin.x, (end.angle - begin.angle) * ball.radius
            # Contacts lie inside the rim, and a ball that meets a wall slides for a moment.
            lab.want(
                abs(way - turned) <= 0.1 * abs(way) + 5.0,
                "balls that roll: as far along the floor as their rim turned",
                f"one that went {way:.0f} px while its rim turned {turned:.0f} px",
            )


def want_all_inside(lab: Lab, played: Played) -> None:
    """Nothing sinks or escapes, and static bodies stay where they are."""
    for body in movers(played):
        for moment in body.trail:
            lab.want(
                body.radius - LANDING <= moment.x <= WIDTH - body.radius + LANDING
                and body.bottom(moment) <= FLOOR_TOP + LANDING,
                "every ball between the walls and above the floor",
                f"one of radius {body.radius:g} px at ({moment.x:.0f}, {moment.y:.0f})",
            )
    static = [body for body in played.bodies if isinstance(body, BodyValue) and not body.inv_mass]
    places = {(body.pos.x, body.pos.y) for body in static}
    began = {part.pos for part in world_parts(lab) if not part.mass}
    still = all((*body.vel, body.angle, body.omega) == (0, 0, 0, 0) for body in static)
    lab.want(
        places == began and still,
        "all that is static exactly where make_world puts it, at rest",
        f"{len(began - places)} of them moved" if still else "one that has speed or spin",
    )


def frame_rates_do_not_change_the_motion(lab: Lab) -> None:
    """The same motion at 30, 60 and 144 frames a second, bit for bit"""
    want_the_same_motion(lab, (30, 60, 144), 0.6 + abs(lab.whole(0, 6)) / 30)


def want_the_same_motion(lab: Lab, rates: tuple[int, ...], seconds: float) -> None:
    trails = [run(lab, seconds, rate).trail for rate in rates]
    lab.ran(f"the program at {', '.join(map(str, rates))} frames a second, for {seconds:g} s")
    moving = trails[0] and trails[0][0] and trails[0][0] != trails[0][-1]
    lab.want(bool(moving), "bodies that move", "none that moves")
    parted = first_difference(trails)
    if parted is not None:
        again = first_difference([trails[0], run(lab, seconds, rates[0]).trail])
        lab.fail(
            "the same positions and speeds after the same number of steps",
            f"they differ after step {parted + 1}",
            "Not even the same run twice is the same." if again is not None else "",
        )


def first_difference(trails: list[list[list[float]]]) -> int | None:
    """The first step after which the trails are not equal."""
    for number, rows in enumerate(zip(*trails, strict=False)):
        if any(row != rows[0] for row in rows):
            return number
    return None


REPEATED = 75  # steps, fewer than before the click; by then balls have met


def clicks_drop_balls_and_r_resets(lab: Lab) -> None:
    """A click drops a ball, MAX_BALLS at most, and R brings back the same scene"""
    place = lab.whole(450, 40), lab.whole(300, 20)
    lab.ran(f"a turn of the wheel, 40 clicks at {place}, one in each frame, and R at the end")
    wheel = [Event(3, "click", (300, 100), button=4), Event(4, "click", (300, 100), button=5)]
    clicks = [Event(frame, "click", place) for frame in range(5, 45)]
    reset = Event(48, "key", key="r")
    played = lab.play([17] * 52, [*wheel, *clicks, reset], physics=False, trail_every=1)
    want_a_proper_end(lab, played, 52)
    rows = list(map(moments, played.trail))
    lab.want(bool(rows), "fixed steps", "none")
    want_a_first_ball(lab, rows, place)
    most = max(map(len, rows))
    lab.want(most == MAX_BALLS, f"{MAX_BALLS} moving bodies in the end", f"{most}")
    lab.want(
        rows[-1] == rows[0],
        f"after R the {len(rows[0])} moving bodies of the beginning",
        f"{len(rows[-1])} moving bodies, not all where they began",
    )
    want_the_first_scene(lab, played, "after R")
    lab.ran("the program for 0.7 s, a click, R, and 0.7 s more")
    events = [Event(40, "click", (lab.whole(300, 40), 200)), Event(42, "key", key="r")]
    trail = lab.play([17] * 84, events, trail_every=1).trail
    again = [number for number, row in enumerate(trail) if number and row == trail[0]]
    lab.want(
        bool(again) and trail[again[-1] :][:REPEATED] == trail[:REPEATED],
        "after R the first run once more, bit for bit",
        "other positions and speeds",
    )


def want_a_first_ball(lab: Lab, rows: list[list[Moment]], place: tuple[int, int]) -> None:
    """Insist that the first click, and nothing before it, drops one ball where it is."""
    more = next((row for row in rows if len(row) > len(rows[0])), [])
    lab.want(
        len(more) == len(rows[0]) + 1,
        "one ball more after the first click",
        f"{max(len(more) - len(rows[0]), 0)} more",
    )
    lab.want(
        any((each.x, each.y) == place for each in more),
        f"a ball at {place} after the first click",
        "no ball there",
    )


# ---------------------------------------------------------------- the pymunk scene


def the_pymunk_stack_stands_and_its_rod_holds(lab: Lab) -> None:
    """In pymunk the same scene: the stack stands, the rod holds, balls roll to rest"""
    seed = lab.whole(SEED, SEED)
    lab.ran(f"make_space(random.Random({seed}))")
    space, _ = pymunk_scene(lab, seed)
    lab.want(
        abs(space.damping - 0.95) < EXACT,
        "damping 0.95, the share of the speed kept per second",
        f"{space.damping:.6g}",
    )
    want_parts(lab, space_parts(space), [*FIXED, BOB, *STACK], seed)
    bodies = [body for body in run(lab, 5.0).bodies if isinstance(body, SpaceBody)]
    moving = [body for body in bodies if body.kind == "dynamic" and body.shapes]
    bobs = [body for body in moving if body.shapes[0].radius == BOB_RADIUS]
    boxes = [body for body in moving if body.shapes[0].kind == "Poly"]
    balls = [body for body in moving if body not in bobs and body not in boxes]
    lab.want(
        (len(bobs), len(boxes), len(balls)) == (1, 4, 8),
        "a bob, 4 boxes and 8 balls",
        f"{len(bobs)}, {len(boxes)} and {len(balls)} of them",
    )
    length = math.dist(tuple(bobs[0].pos), HOOK)
    # A pin joint of pymunk's gives way by about 1.2 px in this scene.
    lab.want(
        abs(length - ROD) <= 3.0,
        f"the bob {ROD:.0f} px from the hook, give or take 3 px",
        f"it is {length:.1f} px away",
    )
    stack = sorted(boxes, key=lambda box: -box.pos.y)
    lab.want(
        all(
            abs(box.angle) < 0.2 and math.dist(tuple(box.pos), (760.0, 542.0 - 36 * level)) < 3.0
            for level, box in enumerate(stack)
        ),
        "the stack at x = 760, upright",
        ", ".join(f"a box at ({box.pos.x:.0f}, {box.pos.y:.0f})" for box in stack),
    )
    bouncing = max(abs(ball.vel.y) for ball in balls)
    lab.want(
        bouncing < 5.0,
        "balls that lie or roll, none still bouncing or falling",
        f"one that moves up or down at {bouncing:.1f} px/s",
    )
    most = max(abs(ball.angle) for ball in balls)
    lab.want(most > 1.0, "balls that have rolled", f"none has turned by more than {most:.2f} rad")
    want_the_same_motion(lab, (30, 144), 0.4 + abs(lab.whole(0, 6)) / 30)


def the_pymunk_stack_falls_when_it_is_knocked_over(lab: Lab) -> None:
    """In pymunk the stack falls when it is knocked over, and the program says so"""
    for level in (0, 3):
        want_a_free_box(lab, level)
    lab.ran("the pymunk program, with 8 balls dropped into the right edge of the top box")
    first = lab.whole(20, 4)
    clicks = [Event(first + number, "click", (785, 430)) for number in range(8)]
    knocked = lab.play(frames_at(20, 3.5), clicks)
    want_a_proper_end(lab, knocked, 70)
    tipped = max(abs(box.angle) for box in boxes_of(knocked))
    lab.want(tipped >= TIPPED, "a box that tips over", f"none turned by more than {tipped:.2g} rad")
    lab.ran("the same, and R afterwards")
    reset = lab.play(frames_at(20, 3.5), [*clicks, Event(60, "key", key="r")])
    want_a_proper_end(lab, reset, 70)
    before, after = (
        [line for line in played.lines if "stack" in line.lower()] for played in (knocked, reset)
    )
    lab.want(bool(before and after), "a line on exit about the stack", "no such line")
    lab.want(
        before != after,
        "another line for the stack that fell than for the one that stands after R",
        f"both times “{after[0]}”",
    )
    moving = sum(isinstance(b, SpaceBody) and b.kind == "dynamic" for b in reset.bodies)
    added = len(reset.bodies) - 1  # a rod may hang on a static body of its own; not the space's
    want_line_with(lab, reset, {moving, added}, "the number of bodies")


def boxes_of(played: Played) -> list[SpaceBody]:
    bodies = [body for body in played.bodies if isinstance(body, SpaceBody)]
    moving = [body for body in bodies if body.kind == "dynamic" and body.shapes]
    return [body for body in moving if body.shapes[0].kind == "Poly"]


def want_a_free_box(lab: Lab, level: int) -> None:
    """A ball hits one box of the stack: that one moves, and leaves the lowest or the top one."""
    speed = lab.about(3000.0, 400.0)
    lab.ran(f"make_space, and a ball at {speed:g} px/s against box {level} of the stack")
    space, stack = pymunk_scene(lab)
    lab.want(len(stack) == 4, "a stack of 4 boxes", f"{len(stack)}")
    thing = lab.thing(space)
    ball = lab.thing(lab.call("add_ball", thing, Rng(1), (650, 542 - 36 * level)), "a ball")
    lab.put(ball, velocity=(speed, 0))
    last = lab.simulate(thing, stack, 60, every=60)
    hit, other = last.body(level)[-1], last.body(3 - level)[-1]
    lab.want(
        hit.x - 760 > 50 and hit.x - other.x > 30,
        "the box that was hit far to the right, and the rest of the stack left behind",
        f"it moved by {hit.x - 760:.0f} px, and the other end of the stack by {other.x - 760:.0f}",
    )


def clicks_b_and_r_work_in_pymunk(lab: Lab) -> None:
    """In pymunk clicks drop balls, B drops boxes, and R brings back the same scene"""
    lab.ran("the pymunk program: B four times, a click, B in 50 frames, R, and B once more")
    keys = [Event(frame, "key", key="b") for frame in (*range(5, 9), *range(14, 64), 72)]
    place = lab.whole(450, 40), lab.whole(300, 20)
    events = [*keys, Event(11, "click", place), Event(68, "key", key="r")]
    events += [Event(3, "click", (300, 100), button=4)]
    played = lab.play([17] * 76, events, physics=False, trail_every=1)
    want_a_proper_end(lab, played, 76)
    rows = list(map(moments, played.trail))
    lab.want(bool(rows), "fixed steps", "none")
    begin = len(rows[0])
    first = set(rows[0])
    boxes = [each for each in row_of(rows, begin + 4) if each not in first]
    lab.want(
        len(boxes) == 4 and all(420 <= box.x <= 700 for box in boxes),
        "4 boxes from x = 420 to 700 after B four times",
        ", ".join(f"one at x = {box.x:.0f}" for box in boxes) or "none, or not one at a time",
    )
    lab.want(
        len({box.x for box in boxes}) > 1,
        "boxes at a random x",
        f"all of them at x = {boxes[0].x:.0f}",
    )
    lab.want(
        any((each.x, each.y) == place for each in row_of(rows, begin + 5)),
        f"a ball at {place} after the click",
        "no ball there",
    )
    most = max(map(len, rows))
    lab.want(most == MAX_BALLS, f"{MAX_BALLS} moving bodies in the end", f"{most}")
    lab.want(
        len(rows[-1]) == begin + 1 and first <= set(rows[-1]),
        f"after R the {begin} moving bodies of the beginning, and 1 box from the B after that",
        f"{len(rows[-1])} moving bodies, not all where they began",
    )
    lab.ran(f"R in the pymunk program, and make_space(random.Random({SEED}))")
    expected = {(*p.pos, p.mass) for p in space_parts(pymunk_scene(lab)[0]) if p.mass}
    found = {(*b.pos, b.mass) for b in played.bodies if isinstance(b, SpaceBody) and b.mass}
    lab.want(
        {rounded(row) for row in expected} <= {rounded(row) for row in found},
        "after R the balls of make_space, each with its mass",
        "balls of other masses",
    )


def row_of(rows: list[list[Moment]], count: int) -> list[Moment]:
    """The bodies when there were first so many."""
    return next((row for row in rows if len(row) == count), [])
