"""TODO B6: heavier balls with Shift."""

from grader.checks.pacing import want_a_proper_end
from grader.judge.lab import Lab
from grader.protocol import BodyValue, Event, Played

# Keys held at each click, and the factor of the ball's mass. The last two clicks share a frame.
CLICKS = 2 * (
    ("left shift", 10),
    ("", 1),
    ("left shift", 10),
    ("left shift", 10),
    ("right shift", 10),
    ("left ctrl", 1),
    ("", 1),
    ("left shift+right shift", 10),
    ("left shift+left ctrl", 10),
    ("numlock", 1),
    ("right shift+numlock", 10),
    ("caps lock", 1),
    ("left shift+caps lock", 10),
    ("left alt", 1),
    ("right ctrl", 1),
)
PLACES = [(330 + 60 * (number % 7), 120 + 70 * (number // 7)) for number in range(len(CLICKS))]
ROUNDING = 1e-9


def shift_drops_heavier_balls(lab: Lab) -> None:
    """A ball dropped with either Shift key held is ten times as heavy"""
    lab.ran("the lab scene, clicks with no key held, one Shift or both, and other keys")
    right, down = lab.whole(0, 40), lab.whole(0, 40)
    places = [(x + right, y + down) for x, y in PLACES]
    apart = len(CLICKS) - 2
    first = abs(lab.whole(0, apart - 1))  # seeded, so that the order of clicks cannot be hard-coded
    order = [*range(first, apart), *range(first), apart, apart + 1]
    clicks = [
        Event(3 + min(number, apart), "click", places[which], held=CLICKS[which][0])
        for number, which in enumerate(order)
    ]
    played = lab.play([17] * (len(clicks) + 5), clicks, physics=False)
    want_a_proper_end(lab, played, len(clicks) + 5)
    balls = [find_dropped(lab, played, place) for place in places]
    weights = [1 / (each.inv_mass * usual_mass(each)) for each in balls]
    lab.saw("heaviness", (), weights)
    for (keys, right), found in zip(CLICKS, weights, strict=True):
        lab.want(
            abs(found - right) < ROUNDING * right,
            f"a ball {right} times as heavy as usual with {name_keys(keys)}",
            f"{found:.6g} times as heavy",
        )
    lab.want(
        all(abs(turning(each) - 1.0) < ROUNDING for each in balls),
        "moments of inertia that grow with the mass, as mass · r² / 2",
        ", ".join(f"{turning(each):.3g}" for each in balls) + " times that",
    )


def name_keys(keys: str) -> str:
    return keys.replace("numlock", "num lock").replace("+", " and ") or "no key held"


def usual_mass(ball: BodyValue) -> float:
    """Return the mass of a ball of this size in the lab scene, kg."""
    return ball.radius**2 / 100


def turning(ball: BodyValue) -> float:
    """Return its moment of inertia, as a multiple of a disc's, mass · r² / 2."""
    return ball.inv_mass / (ball.inv_inertia * ball.radius**2 / 2)


def find_dropped(lab: Lab, played: Played, place: tuple[int, int]) -> BodyValue:
    """Return the ball that was dropped at a position."""
    for body in played.bodies:
        if isinstance(body, BodyValue) and tuple(body.pos) == place and body.inv_mass:
            return body
    lab.fail(f"a ball at {place}", "none there")
