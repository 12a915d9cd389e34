"""TODO B6: heavier balls with Shift."""

from grader.checks.pacing import want_a_proper_end
from grader.judge.lab import Lab
from grader.protocol import BodyValue, Event, Played

HELD = ("", "left shift", "right shift", "left ctrl")  # in the order of the clicks
PLACES = ((450, 120), (450, 190), (450, 260), (450, 330))  # px
HEAVIER = 2.0  # times, at the least


def shift_drops_heavier_balls(lab: Lab) -> None:
    """A ball that is dropped with Shift held is heavier, whichever Shift"""
    lab.ran("the lab scene, clicks with no key held, left Shift, right Shift and Ctrl")
    clicks = [
        Event(3 + number, "click", place, held=key)
        for number, (place, key) in enumerate(zip(PLACES, HELD, strict=True))
    ]
    played = lab.play([17] * 9, clicks, physics=False)
    want_a_proper_end(lab, played, 9)
    weights = [weight(lab, played, place) for place in PLACES]
    lab.saw("heaviness", (), weights)
    plain, left, right, other = weights
    lab.want(
        max(abs(plain - 1.0), abs(other - 1.0)) < 1e-9 and min(left, right) >= HEAVIER,
        f"with either Shift a ball {HEAVIER:g} times as heavy as usual or more, else a usual one",
        ", ".join(f"{each:.3g}" for each in weights) + " times as heavy as usual",
    )


def weight(lab: Lab, played: Played, place: tuple[int, int]) -> float:
    """How many times as heavy as usual, r² / 100, the ball is that was dropped at a place."""
    for body in played.bodies:
        if isinstance(body, BodyValue) and tuple(body.pos) == place and body.inv_mass:
            return 100.0 / (body.inv_mass * body.radius**2)
    lab.fail(f"a ball at {place}", "none there")
