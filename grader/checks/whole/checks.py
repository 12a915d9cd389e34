"""Check the student's own programs as a whole, from the first frame to the last.

Each check tests some of the lesson's promises about the scene and the step, so that a broken
promise costs only a point or two. A scene also requires events: a ball bounces, one is deflected,
one rolls, the bob crosses.
"""

import math
import re
from collections.abc import Sequence
from statistics import median

from grader.checks.pacing import frames_at, want_a_proper_end
from grader.checks.whole import lab_scene as lesson
from grader.checks.whole import lesson_rules as rules
from grader.checks.whole.flights import moments, want_free_flights
from grader.checks.whole.lab_scene import SEED
from grader.checks.whole.movers import BOB_RADIUS, FLOOR_TOP, LANDING, LEDGE_TOP, Mover, movers
from grader.checks.whole.pictures import want_pictures
from grader.judge.decode import Pair
from grader.judge.lab import STEP, Lab, Moment, Thing
from grader.protocol import BodyValue, Event, Played, SpaceBody

WIDTH = 900.0  # px
LEDGE_LEFT, LEDGE_RIGHT = 50.0, 350.0  # px
MAX_BALLS = 40
WITHIN_A_ROUNDING = 0.0051  # px, of a number printed with two digits
TIPPED = 0.2  # rad
CROSSED = 600.0  # px: the bob begins at x = 840 and swings over to 560
ROSE = 6.0  # px; a ball that falls 200 px and keeps 0.3 of its speed rises by 18 px
ASIDE = 20.0  # px, of a ball that met a peg
ROLLED = 40.0  # px over the floor
SMALL = 13  # px, of a ball; the first of the usual ones has 17
PHOTOGRAPHED = (4, 22, 48, 80)  # frames


def run(
    lab: Lab,
    seconds: float,
    rate: int | None = None,
    events: Sequence[Event] = (),
    photos: Sequence[int] = (),
) -> Played:
    """Play the program; insist that it ran its steps and that free bodies fly as they must."""
    rate = rate or lab.whole(20, 2)
    lab.ran(f"the program as it is for {seconds:g} s, at {rate} frames a second")
    frames = frames_at(rate, seconds)
    played = lab.play(frames, events, trail_every=1, photos=photos)
    want_a_proper_end(lab, played, len(frames))
    steps, owed = sum(played.steps), played.clock[len(frames)] / 1000 / STEP
    least = played.clock[len(frames) - 1] / 1000 / STEP  # it may leave out the last frame
    lab.want(
        least - 2 - 1 / rate / STEP
        <= steps
        <= owed + 2,  # it may guess the first frame, or be behind
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


# ---------------------------------------------------------------- the mini engine


def the_scene_is_that_of_the_lesson(lab: Lab) -> None:
    """The scene has the lesson's bodies, and the program begins with it"""
    seed = lab.whole(SEED, SEED)
    lab.ran(f"make_world(random.Random({seed}))")
    parts = [lesson.turning_as_a_disc(part) for part in [*lesson.FIXED, lesson.BOB]]
    lesson.want_parts(lab, lesson.world_parts(lab, seed), parts, seed)
    lab.ran("the program without running its steps, and what there is in its world")
    frames = frames_at(60, 0.2 + abs(lab.whole(0, 9)) / 60)
    played = lab.play(frames, physics=False)
    want_a_proper_end(lab, played, len(frames))
    want_the_first_scene(lab, played, "at the start")


def want_the_first_scene(lab: Lab, played: Played, when: str) -> None:
    """Insist that a program of the mini engine starts with make_world's scene."""
    found = lesson.moving_discs(played)
    lab.want(
        found == lesson.first_discs(lab, SEED),
        f"{when} the moving bodies of make_world(random.Random({SEED}))",
        f"{len(found)} moving bodies, not all with the place, size and mass of those",
    )


def contacts_bounce_part_and_rub_as_the_lesson_says(lab: Lab) -> None:
    """Contacts bounce, push out and rub by the lesson's rules"""
    for impact in rules.IMPACTS:
        rules.want_impact(lab, impact)
    rules.want_pressed_and_rubbed(lab)
    rules.want_friction_after_pressure(lab)
    rules.want_a_total_that_is_clamped(lab)
    rules.want_a_way_out_for_coincident_discs(lab)


def a_step_keeps_its_stages_and_its_passes(lab: Lab) -> None:
    """A step has the lesson's stages in their order, and solves again and again"""
    rules.want_gravity_then_damping(lab)
    rules.want_a_free_flight(lab)
    rules.want_fresh_contacts(lab)
    rules.want_some_passes(lab)
    rules.want_a_rod_put_right(lab)
    rules.want_the_same_pile(lab)


def the_rod_swings_alike_at_any_frame_rate(lab: Lab) -> None:
    """The pendulum swings the same at 30, 60 and 144 frames a second, within 1 px"""
    want_the_same_motion(lab, (30, 144), 0.6 + abs(lab.whole(0, 6)) / 30)
    played = run(lab, 1.6, 60)
    bobs = [body for body in movers(played) if body.is_bob]
    lab.want(bool(bobs and played.rods), "a bob of radius 24 px on a rod", "no such bob, or no rod")
    want_a_swing(lab, bobs[0].trail)
    last = bobs[0].trail[-1]
    ends = [b.pos for b in played.bodies if isinstance(b, BodyValue) and b.radius == BOB_RADIUS]
    lab.want(
        (last.x, last.y) == (ends[0].x, ends[0].y),
        "the bob where its last step left it",
        f"moved by {math.dist((last.x, last.y), tuple(ends[0])):.2g} px after that",
    )
    distance, length = played.rods[0]
    error = abs(distance - length)
    lab.want(
        error < 1.0 and abs(length - lesson.ROD) < 1.0,
        f"a rod of {lesson.ROD:.0f} px, less than 1 px off",
        f"a rod of {length:.1f} px, {error:.2f} px off",
    )
    said = re.search(r"Pendulum length error: (\d+\.\d\d) px", "\n".join(played.lines))
    lab.want(
        said is not None and abs(float(said[1]) - error) <= WITHIN_A_ROUNDING,
        f"the line “Pendulum length error: {error:.2f} px” on exit",
        said[0] if said else "no such line",
    )


def want_a_swing(lab: Lab, trail: list[Moment]) -> None:
    """Insist that the bob swings through below its hook and over to the other side."""
    leftmost, lowest = min(each.x for each in trail), max(each.y for each in trail)
    lab.want(
        leftmost < CROSSED and lowest > lesson.HOOK[1] + 0.9 * lesson.ROD,
        "a bob that swings through below its hook and over to x = 560",
        f"its leftmost x is {leftmost:.0f}, its lowest place y = {lowest:.0f}",
    )


def balls_bounce_come_to_rest_and_roll(lab: Lab) -> None:
    """Balls bounce, are deflected by the pegs, rest on the ledge and roll on the floor"""
    place = lab.whole(200, 100), lab.whole(340, 20)  # below the ledge
    played = run(lab, 5.0, None, [Event(abs(lab.whole(3, 2)), "click", place)])
    want_all_inside(lab, played)
    *balls, dropped = [body for body in movers(played) if not body.is_bob]
    lab.want(len(balls) >= 8, "8 balls, and one more after a click", f"{len(balls) + 1}")
    want_events(lab, balls, dropped, place)
    want_rest(lab, [*balls, dropped])
    radius = deal_a_small_ball(lab)
    want_a_landing(lab, run(lab, 0.9), radius)


def deal_a_small_ball(lab: Lab) -> int:
    """Make the program draw other balls than usual; return the radius of the first one, px.

    It is much smaller than usual, so that a recording of the usual balls hovers above the ledge.
    """
    moved = abs(lab.whole(1, 1_000_000))
    while lesson.first_radius(SEED + moved) > SMALL:
        moved += 1
    lab.deal(moved)
    return lesson.first_radius(SEED + moved)


def want_a_landing(lab: Lab, played: Played, radius: int) -> None:
    """Insist that the first ball has its randomly drawn size and lands on the ledge."""
    lab.ran(f"the program as it is, with random numbers that make its first ball {radius} px large")
    first = min(movers(played), key=lambda each: math.dist(each.begin, lesson.BALLS[0]))
    lab.want(first.radius == radius, f"a first ball of {radius} px", f"one of {first.radius:g} px")
    lowest = max(map(first.bottom, first.trail))
    lab.want(
        LEDGE_TOP - 1.0 <= lowest <= LEDGE_TOP + LANDING,
        f"a first ball whose lowest point comes down to the ledge, y = {LEDGE_TOP:.0f}",
        f"it comes to y = {lowest:.1f}",
    )


def want_events(lab: Lab, balls: list[Mover], dropped: Mover, place: Pair) -> None:
    """Insist on visible events: a ball bounces, pegs deflect balls, and a ball rolls."""
    lab.want(
        dropped.rise > ROSE,
        f"a ball dropped at {place} that bounces off the floor, by about 15 px",
        f"it rises by {dropped.rise:.1f} px",
    )
    aside = [ball for ball in balls if ball.went_aside > ASIDE]
    lab.want(len(aside) >= 2, "balls that the pegs deflect", f"{len(aside)} deflected")
    farthest = max(ball.rolled_distance for ball in balls)
    lab.want(
        farthest > ROLLED,
        "a ball that rolls over the floor: its rim turns as fast as it moves",
        f"none that rolled farther than {farthest:.0f} px",
    )


def want_rest(lab: Lab, balls: list[Mover]) -> None:
    """Insist that balls lie or roll in the end, four of them on the ledge.

    A ball that rolls against a wall hops for a moment, as its rim climbs; so use the median.
    """
    restless = max(median(abs(each.vy) for each in ball.tenths[-5:]) for ball in balls)
    lab.want(
        restless < 5.0,
        "balls that lie or roll, none still bouncing or falling",
        f"one that moves up or down at {restless:.1f} px/s",
    )
    ends = [(ball, ball.trail[-1]) for ball in balls]
    on_ledge = [
        ball
        for ball, end in ends
        if ball.lies_on(LEDGE_TOP, end) and LEDGE_LEFT <= end.x <= LEDGE_RIGHT
    ]
    lab.want(len(on_ledge) >= 4, "4 balls on the ledge", f"{len(on_ledge)}")
    for ball, end in ends:
        if ball.lies_on(FLOOR_TOP, end):
            # A ball that meets another one or a wall slides for a moment.
            lab.want(
                any(ball.rolls(moment) for moment in ball.tenths[-5:]),
                "balls that roll: as fast over the floor as their rim turns",
                f"one at {end.vx:.0f} px/s with a rim at {end.omega * ball.radius:.0f} px/s",
            )


def the_picture_shows_where_the_balls_are(lab: Lab) -> None:
    """The window shows every ball where it is, with a spoke that turns"""
    radius = deal_a_small_ball(lab)
    played = run(lab, 2.8, 30, photos=PHOTOGRAPHED)
    want_a_landing(lab, played, radius)
    want_pictures(lab, played, movers(played), PHOTOGRAPHED)


def want_all_inside(lab: Lab, played: Played) -> None:
    """Insist that nothing sinks or escapes, and that static bodies do not move."""
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
    began = {part.pos for part in lesson.world_parts(lab, SEED) if not part.mass}
    still = all((*body.vel, body.angle, body.omega) == (0, 0, 0, 0) for body in static)
    lab.want(
        places == began and still,
        "all that is static exactly where make_world puts it, at rest",
        f"{len(began - places)} of them moved" if still else "one that has speed or spin",
    )


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
    """Return the first step after which the trails are not equal."""
    for number, rows in enumerate(zip(*trails, strict=False)):
        if any(row != rows[0] for row in rows):
            return number
    return None


ALIKE, REPEATED = 36, 75  # steps before any ball touches something, and until some have


def clicks_drop_balls_and_r_resets(lab: Lab) -> None:
    """A click drops a ball, MAX_BALLS at most, and R restores the scene"""
    place = lab.whole(450, 40), lab.whole(300, 20)
    lab.ran(f"40 clicks at {place}, one in each frame, and R at the end")
    clicks = [Event(frame, "click", place) for frame in range(5, 45)]
    reset = Event(48, "key", key="r")
    played = lab.play([17] * 52, [*clicks, reset], physics=False, trail_every=1)
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
    rods = len(played.rods)
    lab.want(rods < 2, "after R the one rod of the scene", f"{rods} rods")
    same = want_the_scene_again(lab, lesson.moving_discs(played))
    lab.ran("the program for 0.7 s, a click, R, and 0.7 s more")
    events = [Event(40, "click", (lab.whole(300, 40), 200)), Event(42, "key", key="r")]
    trail = lab.play([17] * 84, events, trail_every=1).trail
    again = [number for number, row in enumerate(trail) if number and row == trail[0]]
    steps = REPEATED if same else ALIKE
    lab.want(
        bool(again) and trail[again[-1] :][:steps] == trail[:steps],
        f"after R the first {steps} steps once more, bit for bit",
        "other positions and speeds",
    )


def want_the_scene_again(lab: Lab, found: list[lesson.Disc]) -> bool:
    """Insist on the bob and eight balls after R; return whether they are the first eight.

    A random generator that is not reset gives balls of other sizes.
    """
    first = lesson.first_discs(lab, SEED)
    balls = [disc for disc in found if disc != lesson.disc_of(lesson.BOB)]
    lab.want(
        len(balls) == len(lesson.BALLS)
        and len(found) == len(first)
        and all(lesson.is_a_ball(*ball) and ball[:2] in lesson.BALLS for ball in balls),
        "after R the bob, and 8 balls where they began, of 10 to 22 px and with a mass of r²/100",
        f"{len(found)} moving bodies, not all with such a place, size and mass",
    )
    return found == first


def want_a_first_ball(lab: Lab, rows: list[list[Moment]], place: tuple[int, int]) -> None:
    """Insist that the first click drops one ball, at its position, and nothing drops one before."""
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
    space, _ = lesson.pymunk_scene(lab, seed)
    lab.want(
        abs(space.damping - 0.95) < rules.EXACT,
        "damping 0.95, the share of the speed kept per second",
        f"{space.damping:.6g}",
    )
    parts = [*lesson.FIXED[:-1], lesson.BOB, *lesson.STACK]  # without the hook
    lesson.want_parts(lab, lesson.space_parts(space), parts, seed)
    played = run(lab, 5.0, 30, photos=PHOTOGRAPHED)
    discs, boxes = movers(played), boxes_of(played)
    bobs, balls = [d for d in discs if d.is_bob], [d for d in discs if not d.is_bob]
    lab.want(
        (len(bobs), len(boxes), len(balls)) == (1, 4, 8),
        "a bob, 4 boxes and 8 balls",
        f"{len(bobs)}, {len(boxes)} and {len(balls)} of them",
    )
    want_a_pymunk_swing(lab, bobs[0])
    want_a_standing_stack(lab, boxes)
    want_pymunk_events(lab, balls)
    want_pictures(lab, played, discs, PHOTOGRAPHED)
    want_the_same_motion(lab, (30, 144), 0.4 + abs(lab.whole(0, 6)) / 30)


def want_a_pymunk_swing(lab: Lab, bob: Mover) -> None:
    """Insist that the bob swings, and that the rod stretches no more than pymunk's."""
    want_a_swing(lab, bob.trail)
    length = math.dist((bob.trail[-1].x, bob.trail[-1].y), lesson.HOOK)
    # A pin joint of pymunk's gives way by about 1.2 px in this scene.
    lab.want(
        abs(length - lesson.ROD) <= 3.0,
        f"the bob {lesson.ROD:.0f} px from the hook, give or take 3 px",
        f"it is {length:.1f} px away",
    )


def want_a_standing_stack(lab: Lab, boxes: list[SpaceBody]) -> None:
    stack = sorted(boxes, key=lambda box: -box.pos.y)
    lab.want(
        all(
            tilt(box) < TIPPED and math.dist(tuple(box.pos), (760.0, 542.0 - 36 * level)) < 3.0
            for level, box in enumerate(stack)
        ),
        "the stack at x = 760, upright",
        ", ".join(f"a box at ({box.pos.x:.0f}, {box.pos.y:.0f})" for box in stack),
    )


def tilt(box: SpaceBody) -> float:
    """Return the angle of a box, modulo 2 pi, rad."""
    return abs(math.remainder(box.angle, 2 * math.pi))


def want_pymunk_events(lab: Lab, balls: list[Mover]) -> None:
    """Insist that pegs deflect balls, that a ball turns, and that all come to rest."""
    aside = [ball for ball in balls if ball.went_aside > ASIDE]
    lab.want(len(aside) >= 2, "balls that the pegs deflect", f"{len(aside)} deflected")
    most = max(ball.turned_angle for ball in balls)
    lab.want(most > 1.0, "balls that have rolled", f"none has turned by more than {most:.2f} rad")
    bouncing = max(abs(ball.trail[-1].vy) for ball in balls)
    lab.want(
        bouncing < 5.0,
        "balls that lie or roll, none still bouncing or falling",
        f"one that moves up or down at {bouncing:.1f} px/s",
    )


def the_pymunk_stack_falls_when_it_is_knocked_over(lab: Lab) -> None:
    """In pymunk the stack falls when it is knocked over, and the program says so"""
    for level in (0, 3):
        want_a_free_box(lab, level)
    lab.ran("the pymunk program, with 16 balls dropped onto the right edge of the top box")
    first = lab.whole(20, 4)
    clicks = [Event(first + number, "click", (785, 430)) for number in range(16)]
    knocked = lab.play(frames_at(20, 3.5), clicks)
    want_a_proper_end(lab, knocked, 70)
    want_tipped(lab, knocked, True)
    lab.ran("the same, and R afterwards")
    reset = lab.play(frames_at(20, 3.5), [*clicks, Event(60, "key", key="r")])
    want_a_proper_end(lab, reset, 70)
    want_tipped(lab, reset, False)
    before, after = (list(filter(VERDICT.search, each.lines)) for each in (knocked, reset))
    lab.want(
        before != after or not before,
        "if there is a line on exit about the stack, another one for the stack that fell than for "
        "the one that stands after R",
        f"both times “{after[0]}”" if after else "",
    )


VERDICT = re.compile(r"stack\b.*\b(stand|fall|fell|tip|upright|true|false|yes|no)", re.IGNORECASE)


def want_tipped(lab: Lab, played: Played, tips: bool) -> None:
    """Insist that a box tips over, or that none does."""
    most = max(map(tilt, boxes_of(played)), default=0.0)
    lab.want(
        (most >= TIPPED) == tips,
        "a box that tips over" if tips else "the stack standing again after R",
        f"none turned by more than {most:.2g} rad" if tips else f"one turned by {most:.2g} rad",
    )


def boxes_of(played: Played) -> list[SpaceBody]:
    bodies = [body for body in played.bodies if isinstance(body, SpaceBody)]
    moving = [body for body in bodies if body.kind == "dynamic" and body.shapes]
    return [body for body in moving if body.shapes[0].kind == "Poly"]


UPRIGHT = 0.5  # rad; boxes that are tied together turn by more than 1


def want_a_free_box(lab: Lab, level: int) -> None:
    """Hit one box of the stack; insist that it moves without the lowest or the top one."""
    speed = lab.about(3000.0, 400.0)
    lab.ran(f"make_space, and a ball at {speed:g} px/s against box {level} of the stack")
    space, stack = lesson.pymunk_scene(lab, SEED)
    lab.want(len(stack) == 4, "a stack of 4 boxes", f"{len(stack)}")
    thing = lab.thing(space)
    hit_by_a_ball(lab, thing, (650, 542 - 36 * level), speed)
    last = lab.simulate(thing, stack, 60, every=60)
    hit, other = last.body(level)[-1], last.body(3 - level)[-1]
    lab.want(
        hit.x - 760 > 50 and hit.x - other.x > 30,
        "the box that was hit far to the right, and the rest of the stack left behind",
        f"it moved by {hit.x - 760:.0f} px, and the other end of the stack by {other.x - 760:.0f}",
    )
    lab.want(
        abs(other.angle) < UPRIGHT,
        "boxes that are free of each other: the other end of the stack still upright",
        f"it turned by {other.angle:.2f} rad",
    )


def hit_by_a_ball(lab: Lab, space: Thing, pos: Pair, speed: float) -> None:
    """Put a ball of the lesson into a space, moving right at `speed` px/s."""
    ball = lab.make("pymunk:Body", 2.25, 253.125)
    lab.put(ball, position=pos, velocity=(speed, 0))
    disc = lab.make("pymunk:Circle", ball, 15.0)
    lab.put(disc, friction=0.6, elasticity=0.4)
    lab.let(space, "add", ball, disc)


def clicks_b_and_r_work_in_pymunk(lab: Lab) -> None:
    """In pymunk, clicks drop balls, B drops boxes, and R restores the scene"""
    lab.ran("the pymunk program: B four times, a click, B in 50 frames, R, and B once more")
    keys = [Event(frame, "key", key="b") for frame in (*range(5, 9), *range(14, 64), 72)]
    place = lab.whole(450, 40), lab.whole(300, 20)
    events = [*keys, Event(11, "click", place), Event(68, "key", key="r")]
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
    most = max(map(len, rows))  # the lesson's program has no limit here
    lab.want(most >= MAX_BALLS, f"{MAX_BALLS} moving bodies or more in the end", f"{most}")
    lab.want(
        len(rows[-1]) == begin + 1 and first <= set(rows[-1]),
        f"after R the {begin} moving bodies of the beginning, and 1 box from the B after that",
        f"{len(rows[-1])} moving bodies, not all where they began",
    )
    discs = lesson.moving_discs(played)
    balls = [disc for disc in discs if disc[2] != BOB_RADIUS]
    lab.want(
        len(balls) == len(lesson.BALLS) and all(lesson.is_a_ball(*ball) for ball in balls),
        "after R 8 balls of 10 to 22 px, with a mass of r²/100",
        "balls of other sizes or masses",
    )


def row_of(rows: list[list[Moment]], count: int) -> list[Moment]:
    """Return the first row that has `count` bodies."""
    return next((row for row in rows if len(row) == count), [])
