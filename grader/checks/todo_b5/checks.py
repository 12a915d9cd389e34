"""TODO B5: drawing between steps."""

import math
from collections.abc import Callable
from itertools import pairwise

from grader.checks import exact
from grader.checks.digits import say, want_answer
from grader.checks.exact import Place
from grader.checks.pacing import frames_at, want_a_proper_end
from grader.judge.lab import NOTHING, STEP, Lab, Thing
from grader.protocol import Value

CLOSE = 1e-6  # px or rad
PLACE = "({:.{n}f}, {:.{n}f})"
STEPS = (  # x, y and angle before a step, and now, and the step's length in s
    ((0.0, 0.0, 0.0), (8.0, -4.0, 0.25), STEP),
    ((-30.0, 70.0, 1.5), (-30.0, 75.5, 1.25), STEP),
    ((400.0, 100.0, 7.0), (330.0, 160.0, 9.5), 1 / 20),  # slow motion, and far
    ((-5.0, 20.0, -8.0), (-905.0, -400.0, -7.5), STEP),
    ((2.0, 3.0, 0.1), (2.3, 2.9, 0.1), 1 / 240),
    ((50.0, 50.0, 20.0), (50.0, 50.0, 20.0), STEP),
    ((2100.28125, 650.40625, 1.53125), (2100.34375, 650.40625, 1.59375), STEP),  # far out, slow
    ((0.5, 0.25, 0.03125), (0.75, -0.25, -0.03125), STEP),
)
# Other fields of a drawn body, as after an impact; its position must not depend on them.
STATES = (  # velocity in px/s, spin in rad/s, mass in kg, restitution, friction
    ((-90.28125, 10.40625), -3.015625, 1.125, 0.1875, 0.3125),
    ((5.28125, -20.40625), 40.015625, 1 / 1024, 0.96875, 0.0),
    ((0.0, 0.0), 0.0, 900.0, 0.0, 1.53125),
    ((2000.28125, 0.40625), 0.28125, 1.0, 0.3, 0.6),
)
BY_HAND = (4.28125, 8.40625)  # px; the body's position after the last of these
SHARES = (0.625, 0.25, 1.0, 0.0, 0.53125, 0.03125)
OFF_THE_WAY = (
    "That is not between body.before and body.pos: these two places and share are all it takes."
)
RATE, FALLING = 144, 0.3  # frames a second; s, after which balls are fast enough to move visibly


def a_body_is_drawn_on_its_way_through_the_step(lab: Lab) -> None:
    """A body is drawn part of its way, and is not moved itself"""
    x, y, angle = lab.about(0.0, 64.0), lab.about(0.0, 64.0), lab.about(0.0, 1.0)
    for number, (begin, end, dt) in enumerate(STEPS):
        before = begin[0] + x, begin[1] + y, begin[2] + angle
        now = end[0] + x, end[1] + y, end[2] + angle
        vel, omega, mass, restitution, friction = STATES[number % len(STATES)]
        lab.ran(f"between(body, {SHARES[0]:g}) after a step from {before[:2]} to {now[:2]}")
        body = make_moved_body(
            lab, before, now, dt, mass, restitution=restitution, friction=friction
        )
        lab.put(body, vel=vel, omega=omega)
        want_all_shares(lab, body, before, now)
    lab.put(body, pos=BY_HAND)
    want_all_shares(lab, body, before, (*BY_HAND, now[2]))


def want_all_shares(lab: Lab, body: Thing, before: Place, now: Place) -> None:
    """Insist that `between` gives right answers for a body and does not change it."""
    asked = [share for share in SHARES for _ in range(2)]  # the window may ask twice
    answers: list[Place] = []
    for share in asked:
        ask_between(lab, body, share, answers.append)
    lab.settle()
    for share, answer in zip(asked, answers, strict=True):
        lab.saw("between", (before, now, share), answer[:2])
    was = lab.items(lab.get(body, "before"), "Body.before")
    kept = (*lab.pair(was[0], "Body.before"), lab.number(was[1], "Body.before"))
    lab.want(
        math.dist(kept, before) < CLOSE,
        f"body.before as it was, at {say(PLACE, before[:2], 3)}",
        f"it is at {say(PLACE, kept[:2], 3)}",
        "between says where to draw. body.before is for the next frame, too: compute with +, as += "
        "changes a vector in place.",
    )
    for share, answer in zip(asked, answers, strict=True):
        lab.ran(f"between(body, {share:g}) after a step from {before[:2]} to {now[:2]}")
        want_part_of_the_way(lab, answer, before, now, share)
    found = lab.state(body)
    lab.want(
        math.dist((*found.pos, found.angle), now) < CLOSE,
        f"a body that stays at ({now[0]:g}, {now[1]:g}), turned by {now[2]:g} rad",
        f"it is at ({found.pos.x:g}, {found.pos.y:g}), turned by {found.angle:g} rad",
        "between says where to draw. The body itself must stay as it is.",
    )


def want_part_of_the_way(lab: Lab, found: Place, before: Place, now: Place, share: float) -> None:
    """Insist on the right position.

    The angle may also be the old or the new one: only the spoke shows it.
    """
    right = exact.part_of_the_way(before, now, share)
    near = math.dist(found[:2], right[:2]) < CLOSE
    way = math.dist(before[:2], found[:2]) + math.dist(found[:2], now[:2])
    off = way > math.dist(before[:2], now[:2]) + CLOSE
    words, why = "the place {}", OFF_THE_WAY * off
    want_answer(lab, near, PLACE, right[:2], found[:2], expected=words, meaning=why)
    good = any(
        abs(math.remainder(found[2] - each[2], math.tau)) < CLOSE for each in (before, right, now)
    )
    want_answer(lab, good, "{:.{n}f} rad", right[2], found[2], digits=4, expected="the angle {}")


def make_moved_body(
    lab: Lab, before: Place, now: Place, dt: float, mass: float, **surface: float
) -> Thing:
    """Return a body that a step of its world has moved from one position and angle to another."""
    vx, vy, omega = ((end - begin) / dt for begin, end in zip(before, now, strict=True))
    body = lab.circle(before[:2], 10.0, mass, angle=before[2], vel=(vx, vy), omega=omega, **surface)
    lab.simulate(lab.world(body, bonus=True), [body], 1, dt)
    return body


def ask_between(lab: Lab, body: Thing, share: float, then: Callable[[Place], None]) -> None:
    """Ask `between` for a position and an angle."""

    def judge(value: Value) -> None:
        parts = lab.items(value, "what between returns")
        lab.want(len(parts) == 2, "a place and an angle", f"{len(parts)} things")
        then((*lab.pair(parts[0], "the place"), lab.number(parts[1], "the angle")))

    lab.call("between", body, share, changes=NOTHING, twice=True, then=judge)


def frames_without_a_step_show_something_new(lab: Lab) -> None:
    """Frames without a step show something new, too"""
    rate = RATE + 6 * abs(lab.whole(0, 9))
    frames = frames_at(rate, FALLING + 0.2)
    lab.ran(f"the lab scene with its {1 / STEP:.0f} steps a second, at {rate} frames a second")
    played = lab.play(frames, pictures=True)
    want_a_proper_end(lab, played, len(frames))
    pictures = played.pictures[round(FALLING * rate) : len(frames)]
    same = sum(one == other for one, other in pairwise(pictures))
    lab.want(
        len(pictures) > 1 and same == 0,
        f"{len(pictures)} pictures of falling balls, each unlike the one before",
        f"{same} of {len(pictures)} that show the same as the one before",
    )
