"""TODO B5: drawing between steps."""

import math
from itertools import pairwise

from grader.checks import exact
from grader.checks.exact import Place
from grader.checks.pacing import frames_at, want_a_proper_end
from grader.judge.lab import STEP, Lab, Thing

CLOSE = 1e-6  # px or rad
STEPS = (  # where a body was before a step, x, y and angle, and where it is now
    ((0.0, 0.0, 0.0), (8.0, -4.0, 0.25)),
    ((-30.0, 70.0, 1.5), (-30.0, 75.5, 1.25)),
)
SHARES = (0.625, 0.25, 1.0, 0.0)
RATE, FALLING = 144, 0.3  # frames a second; s, after which balls are fast enough to be seen to move


def a_body_is_drawn_on_its_way_through_the_step(lab: Lab) -> None:
    """A body is drawn part of its way, and stays where it is"""
    for before, now in STEPS:
        body = moved(lab, before, now)
        asked = [share for share in SHARES for _ in range(2)]  # the window may ask twice
        answers = [drawn(lab, body, share) for share in asked]
        for share, answer in zip(asked, answers, strict=True):
            lab.saw("between", (before, now, share), answer[:2])
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
    """The right place. The angle may also be the one before or now: only the spoke shows it."""
    right = exact.part_of_the_way(before, now, share)
    lab.want(
        math.dist(found[:2], right[:2]) < CLOSE,
        f"the place ({right[0]:.3f}, {right[1]:.3f})",
        f"({found[0]:.3f}, {found[1]:.3f})",
    )
    lab.want(
        any(abs(found[2] - each[2]) < CLOSE for each in (before, right, now)),
        f"the angle {right[2]:.4f} rad",
        f"{found[2]:.4f} rad",
    )


def moved(lab: Lab, before: Place, now: Place) -> Thing:
    """A body that a step of its world has brought from one place and angle to another."""
    vx, vy, omega = ((end - begin) / STEP for begin, end in zip(before, now, strict=True))
    body = lab.circle(before[:2], angle=before[2], vel=(vx, vy), omega=omega)
    lab.simulate(lab.world(body, bonus=True), [body], 1)
    return body


def drawn(lab: Lab, body: Thing, share: float) -> Place:
    """What between says: a place and an angle."""
    parts = lab.items(lab.call("between", body, share), "what between returns")
    lab.want(len(parts) == 2, "a place and an angle", f"{len(parts)} things")
    return *lab.pair(parts[0], "the place"), lab.number(parts[1], "the angle")


def frames_without_a_step_show_something_new(lab: Lab) -> None:
    """Frames without a step show something new, too"""
    frames = frames_at(RATE, FALLING + 0.2)
    lab.ran(f"the lab scene with its {1 / STEP:.0f} steps a second, at {RATE} frames a second")
    played = lab.play(frames, pictures=True)
    want_a_proper_end(lab, played, len(frames))
    pictures = played.pictures[round(FALLING * RATE) : len(frames)]
    same = sum(one == other for one, other in pairwise(pictures))
    lab.want(
        len(pictures) > 1 and same == 0,
        f"{len(pictures)} pictures of falling balls, each unlike the one before",
        f"{same} of {len(pictures)} that show the same as the one before",
    )
