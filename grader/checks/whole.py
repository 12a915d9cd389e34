"""The whole: the student's own programs, as they are, from the first frame to the last."""

import math
import re
from collections.abc import Sequence

from grader.checks.pacing import frames_at, want_a_proper_end
from grader.judge.lab import STEP, Lab, Moment
from grader.protocol import BodyValue, Event, Played, SpaceBody

WIDTH = 900.0  # px
LEDGE_TOP, FLOOR_TOP = 250.0, 560.0  # px
LEDGE_LEFT, LEDGE_RIGHT = 50.0, 350.0  # px
BOB_RADIUS = 24.0  # px; the balls are smaller
ROD = 140.0  # px
MAX_BALLS = 40
HOOK = (700.0, 90.0)  # px
STATIC = {  # where the bodies stand that never move
    *((450.0, 580.0), (-20.0, 300.0), (920.0, 300.0), (200.0, 260.0), HOOK),
    *((375.0 + 60 * number, 400.0) for number in range(5)),
}
RESTING = 3.0  # px, for what lies on something
LANDING = 9.0  # px: how deep a ball at 1000 px/s gets within one step
WITHIN_A_ROUNDING = 0.0051  # px, of a number printed with two digits


def run(lab: Lab, seconds: float, rate: int = 20, every: int = 12) -> Played:
    """Play the program and insist that it ran its steps, with finite numbers."""
    lab.ran(f"the program as it is for {seconds:g} s, at {rate} frames a second")
    frames = frames_at(rate, seconds)
    played = lab.play(frames, trail_every=every)
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
    return played


def moments(row: Sequence[float]) -> list[Moment]:
    """The bodies that can move, from one row of a trail."""
    return [Moment(*row[start : start + 6]) for start in range(0, len(row), 6)]


class Mover:
    """A ball or the bob of the mini engine, and its trail."""

    def __init__(self, radius: float, trail: list[Moment]) -> None:
        self.radius, self.trail = radius, trail

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


def the_rod_swings_and_keeps_its_length(lab: Lab) -> None:
    """The pendulum swings, and its length error on exit is below 1 px"""
    played = run(lab, 1.6)
    bobs = [body for body in movers(played) if body.radius == BOB_RADIUS]
    lab.want(bool(bobs and played.rods), "a bob of radius 24 px on a rod", "no such bob, or no rod")
    leftmost = min(moment.x for moment in bobs[0].trail)
    lab.want(
        leftmost < 600.0, "a bob that swings over to x = 560", f"its leftmost x is {leftmost:.0f}"
    )
    distance, length = played.rods[0]
    error = abs(distance - length)
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


def balls_come_to_rest_on_the_ledge_and_roll_on_the_floor(lab: Lab) -> None:
    """Balls come to rest on the ledge and roll on the floor"""
    balls = [body for body in movers(run(lab, 5.0)) if body.radius != BOB_RADIUS]
    lab.want(len(balls) >= 8, "8 balls", f"{len(balls)}")
    restless = max(abs(moment.vy) for ball in balls for moment in ball.trail[-5:])
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
            begin, end = ball.trail[-11], ball.trail[-1]  # the last second
            way, turned = end.x - begin.x, (end.angle - begin.angle) * ball.radius
            # Contacts lie inside the rim, and a ball that meets a wall slides for a moment.
            lab.want(
                abs(way - turned) <= 0.1 * abs(way) + 5.0,
                "balls that roll: as far along the floor as their rim turned",
                f"one that went {way:.0f} px while its rim turned {turned:.0f} px",
            )


def nothing_escapes_and_nothing_static_moves(lab: Lab) -> None:
    """Nothing sinks or escapes, and static bodies stay where they are"""
    played = run(lab, 1.6, every=6)
    for body in movers(played):
        for moment in body.trail:
            lab.want(
                body.radius - LANDING <= moment.x <= WIDTH - body.radius + LANDING
                and body.bottom(moment) <= FLOOR_TOP + LANDING,
                "every ball between the walls and above the floor",
                f"one of radius {body.radius:g} px at ({moment.x:.0f}, {moment.y:.0f})",
            )
    static = [body for body in played.bodies if isinstance(body, BodyValue) and not body.inv_mass]
    places = {tuple(body.pos) for body in static}
    still = all((*body.vel, body.angle, body.omega) == (0, 0, 0, 0) for body in static)
    lab.want(
        places >= STATIC and still,
        "floor, walls, ledge, pegs and the pendulum's hook exactly where they were, at rest",
        f"{len(STATIC - places)} of them moved" if still else "one that has speed or spin",
    )


def frame_rates_do_not_change_the_motion(lab: Lab) -> None:
    """The same motion at 30, 60 and 144 frames a second, bit for bit"""
    want_the_same_motion(lab, (30, 60, 144))


def want_the_same_motion(lab: Lab, rates: tuple[int, ...]) -> None:
    trails = [run(lab, 0.6, rate, every=1).trail for rate in rates]
    lab.ran(f"the program at {', '.join(map(str, rates))} frames a second, for 0.6 s")
    moving = trails[0] and trails[0][0] and trails[0][0] != trails[0][-1]
    lab.want(bool(moving), "bodies that move", "none that moves")
    parted = first_difference(trails)
    if parted is not None:
        again = first_difference([trails[0], run(lab, 0.6, rates[0], every=1).trail])
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


def clicks_drop_balls_and_r_resets(lab: Lab) -> None:
    """A click drops a ball, never more than MAX_BALLS, and R starts anew"""
    lab.ran("the program with 40 clicks at (450, 300), one in each frame, and R at the end")
    clicks = [Event(frame, "click", (450, 300)) for frame in range(5, 45)]
    reset = Event(48, "key", key="r")
    played = lab.play([17] * 52, [*clicks, reset], physics=False, trail_every=1)
    want_a_proper_end(lab, played, 52)
    rows = list(map(moments, played.trail))
    lab.want(bool(rows), "fixed steps", "none")
    more = next((row for row in rows if len(row) > len(rows[0])), [])
    lab.want(
        any((each.x, each.y) == (450.0, 300.0) for each in more),
        "a ball at (450, 300) after the first click",
        "no ball there",
    )
    most = max(map(len, rows))
    lab.want(most == MAX_BALLS, f"{MAX_BALLS} moving bodies in the end", f"{most}")
    lab.want(
        rows[-1] == rows[0],
        f"after R the {len(rows[0])} moving bodies of the beginning",
        f"{len(rows[-1])} moving bodies, not all where they began",
    )


# ---------------------------------------------------------------- the pymunk scene


def the_pymunk_stack_stands_and_its_rod_holds(lab: Lab) -> None:
    """In pymunk the stack stands, the rod holds and the balls roll to rest"""
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


def frame_rates_do_not_change_the_pymunk_motion(lab: Lab) -> None:
    """In pymunk the same motion at 30 and 144 frames a second"""
    want_the_same_motion(lab, (30, 144))
