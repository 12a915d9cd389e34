"""Test the allowed motions of a free ball, and the impossible ones."""

import pytest
from counting import count_calls

from grader.checks.whole.flights import (
    BALL,
    LARGEST,
    flew,
    is_clear,
    want_free_flights,
    want_no_jump,
)
from grader.checks.whole.lab_scene import BALLS
from grader.checks.whole.pictures import Disc
from grader.judge.decode import Decoder
from grader.judge.failures import NotYet
from grader.judge.lab import STEP, Lab, Moment

FALL = 980.0 * STEP  # px/s in a step


def ball(x: float, y: float, vx: float = 0.0, vy: float = 0.0) -> Moment:
    return Moment(x, y, vx, vy, 0.0, 0.0)


def next_to(each: Moment, vx: float, vy: float) -> Moment:
    return ball(each.x + vx * STEP, each.y + vy * STEP, vx, vy)


@pytest.mark.parametrize(("vx", "vy"), [(0, 0), (300, -400), (0, -FALL), (-20, 1000)])
def test_a_free_ball_falls_faster_in_each_step_and_may_be_damped(vx: float, vy: float):
    before = ball(450, 100, vx, vy)
    for kept in (1.0, 0.9996, 0.95):
        assert flew(before, next_to(before, kept * vx, kept * (vy + FALL)))
    explicit = ball(450 + vx * STEP, 100 + vy * STEP, vx, vy + FALL)
    assert flew(before, explicit)


@pytest.mark.parametrize(("vx", "vy"), [(0, 0), (300, -400), (-200, 100)])
def test_a_free_ball_neither_hangs_nor_turns_nor_jumps(vx: float, vy: float):
    before = ball(450, 100, vx, vy)
    assert not flew(before, next_to(before, vx, vy))
    assert not flew(before, next_to(before, -vx, vy + FALL + 2.0))
    assert not flew(before, next_to(before, vx + 20.0, vy + FALL))
    jumped = next_to(before, vx, vy + FALL)
    assert not flew(before, ball(jumped.x + 3.0, jumped.y, jumped.vx, jumped.vy))


def test_a_ball_near_something_is_not_judged():
    assert is_clear(ball(450, 100), [], [])
    assert not is_clear(ball(200, 225), [], [])  # above the ledge
    assert not is_clear(ball(450, 100), [ball(490, 100)], [BALL + LARGEST])
    assert not is_clear(ball(840, 120), [], [])  # where the bob swings


def test_a_run_begins_with_the_balls_of_the_scene_which_may_change_their_places_in_the_list():
    lab = Lab("mini_engine", lambda: pytest.fail("a child"), [])
    first = [next_to(ball(x, y), 0.0, FALL) for x, y in BALLS]
    second = [next_to(each, 0.0, 2 * FALL) for each in first]

    def row(balls: list[Moment]) -> list[float]:
        return [n for b in balls for n in (b.x, b.y, b.vx, b.vy, b.angle, b.omega)]

    want_free_flights(lab, [row(first), row(second[::-1])])
    with pytest.raises(NotYet, match="none near it"):
        want_free_flights(lab, [row(first[1:])])
    with pytest.raises(NotYet, match="one at"):
        want_free_flights(lab, [row(first), row(first)])


@pytest.mark.parametrize(
    "after",
    [
        ball(60, 240, 0, 0),  # to where it belongs
        ball(60, 240, 15_000, -2_000),  # with a speed to match
        ball(200, 226, 4_000, 0),  # faster than anything falls
    ],
)
def test_a_ball_that_touches_something_does_not_jump(after: Moment):
    lab = Lab("mini_engine", lambda: pytest.fail("a child"), [])
    before = ball(200, 230, 0, 500)  # on the ledge
    want_no_jump(lab, before, [next_to(before, 0, 0)], 2)
    want_no_jump(lab, before, [next_to(before, 200, -400), after], 2)
    want_no_jump(lab, before, [ball(200, 222, 0, 0)], 2)  # pushed out at once
    with pytest.raises(NotYet, match=r"near there|one at"):
        want_no_jump(lab, before, [after], 2)
    with pytest.raises(NotYet, match="one at"):
        want_no_jump(lab, ball(200, 230, 0, 1e9), [before], 2)  # near everything, so never clear


class NoLab(Decoder):
    """A lab that answers no request."""


def row_of(count: int) -> list[float]:
    """Return the balls of the scene, and other balls that fall far above the window."""
    places = [*BALLS, *((100.0 * number, -1e6) for number in range(count))]
    return [number for place in places for number in (*place, 0.0, 0.0, 0.0, 0.0)]


@pytest.mark.parametrize("count", [1000, 40_000])
def test_a_film_of_too_many_bodies_is_not_compared(count: int):
    film = [row_of(count)] * 3

    def judge() -> None:
        with pytest.raises(NotYet, match=f"{count + len(BALLS)} of them, in 3 steps"):
            want_free_flights(NoLab(), film)

    assert count_calls(judge) < 5 * 3 * count + 2000


def test_a_bob_far_away_hangs_on_no_endless_rod():
    """Circles every few pixels of a rod to a bob at 1e300 px would take over a day."""
    few, many = (sum(1 for _ in Disc((x, 90.0), 24.0, 0.0, True).circles()) for x in (1e5, 1e300))
    assert few == many < 1000
