"""TODO 6 and TODO 7d: fixed steps for any frames."""

import re

from grader.checks.exact import MAX_STEPS
from grader.checks.pacing import (
    LONGEST_UNCUT,
    STEP_MS,
    STEP_TAKES,
    Pace,
    are_fixed,
    ever_longer_frames,
    frames_at,
    make_still_world,
    pace,
    want_a_proper_end,
    want_fixed_steps,
    want_whole_steps,
)
from grader.checks.strategies import frame_lists, frame_rates, frames_to_advance
from grader.judge.drawing import given
from grader.judge.lab import STEP, Lab

NO_CAP = "A slow frame is simulated in full: one frame may add at most MAX_STEPS * STEP."
OTHER_STEPS = "Steps are not STEP long: call step(STEP), however long the frame is."
EARLY = (
    "More is simulated than has passed: a step runs only while the accumulator holds a whole STEP."
)
LATE = (
    "Time that has passed is not simulated: what is too little for a step waits in the accumulator "
    "for the next frame."
)
CAUGHT_UP = (
    "The time of a slow frame beyond the cap is simulated later: one frame may add "
    "MAX_STEPS * STEP at the most."
)
STEADY, LEAST_IN_TURN = 30, 7.25  # frames, and steps in each of them on average
NUMBER = re.compile(r"(?:(?<!\w)-)?\d+")  # a minus is part of the number, a hyphen is not


def paced_with_a_hiccup(lab: Lab, seconds: int) -> Pace:
    # In ms, and no whole number of steps, where rounding would decide; 25 ms are 3 steps.
    hiccup = 1000 * seconds + 1 + 25 * lab.whole(0, 9)
    lab.ran(f"the lab scene at 60 frames a second, with one frame of {hiccup} ms in between")
    before, after = 0.1 + lab.whole(0, 4) / 60, 0.2 + lab.whole(0, 4) / 60  # s
    return pace(lab, [*frames_at(60, before), hiccup, *frames_at(60, after)])


def as_much_is_simulated_at_30_60_and_144_frames_a_second(lab: Lab) -> None:
    """As much is simulated at 30, 60 and 144 frames a second"""
    seconds = 0.3 + lab.whole(0, 3) / 30
    lab.ran(
        f"the lab scene for {seconds:.3g} s at 30, 60 and 144 frames a second (a frame "
        f"is {STEP_TAKES} ms longer for each step in it)"
    )
    paces = {rate: pace(lab, frames_at(rate, seconds), STEP_TAKES) for rate in (30, 60, 144)}
    # Up to one step, and up to the time that a program one frame behind has not read yet.
    lab.want(
        all(
            -STEP_MS - p.waiting <= p.time - p.simulated <= STEP_MS + p.slack
            for p in paces.values()
        ),
        ", ".join(f"{each.time / 1000:.3f} s at {rate}" for rate, each in paces.items()),
        ", ".join(f"{each.simulated / 1000:.3f} s at {rate}" for rate, each in paces.items()),
        explain_too_much(paces),
    )


def explain_too_much(paces: dict[int, Pace]) -> str:
    """Explain, at each frame rate, the effect of simulating more time than passes."""
    if any(each.sizes and not are_fixed(each.sizes) for each in paces.values()):
        return OTHER_STEPS
    shares = {rate: each.simulated / each.time for rate, each in paces.items()}
    if max(shares.values()) <= 1.05:
        return ""
    if shares[30] > 1.05 * shares[144]:
        return (
            "The longer a frame, the more is simulated in it: a step is STEP long for any "
            "frame, as many run as the accumulator holds, and each takes one STEP out of it."
        )
    return (
        f"About {shares[144]:.2g} times as much is simulated as passes: each step takes STEP out "
        "of the accumulator, and none runs besides those that it pays for."
    )


def every_step_is_one_step_long(lab: Lab) -> None:
    """Every step is STEP long, for frames of any length"""
    frames = [lab.whole(5, 2), lab.whole(40, 9), lab.whole(21, 6), lab.whole(160, 40)]
    lab.ran(f"the lab scene with frames of {', '.join(map(str, frames))} ms")
    sizes = pace(lab, frames).sizes
    lab.want(bool(sizes), f"steps of STEP = {STEP:.9f} s", "no step")
    want_fixed_steps(lab, sizes)


def the_remainder_waits_for_the_next_frame(lab: Lab) -> None:
    """Time too short for a step waits for the next frame"""
    lab.ran("the lab scene at 144 frames a second: frames of 7 ms, shorter than a step")
    paced = pace(lab, frames_at(144, 0.25 + lab.whole(0, 6) / 144))
    want_in_step(lab, paced, paced.out_of_step())


def want_in_step(lab: Lab, paced: Pace, frame: int | None) -> None:
    """Insist that no frame is out of step."""
    upto = slice(0 if frame is None else frame + 1)
    lab.want(
        frame is None,
        "steps that follow the time: none early, and none late by more than a step",
        f"steps done: {sum(paced.steps[upto])}, when {sum(paced.lengths[upto]):.0f} ms have passed",
        EARLY if sum(paced.steps[upto]) * paced.step > sum(paced.lengths[upto]) else LATE,
    )


def a_slow_frame_runs_eight_steps(lab: Lab) -> None:
    """A frame of 2 seconds is cut to MAX_STEPS steps"""
    most = max(paced_with_a_hiccup(lab, 2).steps)
    # MAX_STEPS * STEP may hold a step less once it is rounded.
    lab.want(
        MAX_STEPS - 1 <= most <= MAX_STEPS,
        f"{MAX_STEPS} steps for the slow frame, and fewer for all others",
        f"{most} in the frame with the most of them",
        NO_CAP * (most > MAX_STEPS),
    )
    want_eight_in_turn(lab)


def want_eight_in_turn(lab: Lab) -> None:
    """Insist that frames just below the cap, of nearly eight steps each, lose almost no time.

    A program that cuts its accumulator instead of the frame may lose a part of a step.
    """
    frames = [LONGEST_UNCUT - abs(lab.whole(0, 2))] * STEADY
    lab.ran(f"the lab scene with {STEADY} frames of {frames[0]} ms")
    paced = pace(lab, frames)
    lab.want(
        sum(paced.steps) >= LEAST_IN_TURN * STEADY,
        f"{paced.time / STEP_MS:.0f} steps, 8 in most frames",
        f"{sum(paced.steps)} steps, up to {max(paced.steps)} in a frame",
    )


def a_slow_frame_is_not_caught_up_later(lab: Lab) -> None:
    """Time lost in a slow frame is not simulated later"""
    paced = paced_with_a_hiccup(lab, 10)
    after = paced.lengths.index(max(paced.lengths)) + 2  # a program may be a frame behind
    owed, steps = sum(paced.lengths[after:]) / STEP_MS, sum(paced.steps[after:])
    # A step more or less at either end, and one more for a frame behind.
    lab.want(
        abs(steps - owed) <= 3,
        f"{owed:.0f} steps in the {sum(paced.lengths[after:]):.0f} ms after it, as usual",
        f"{steps} steps",
        CAUGHT_UP * (steps > owed),
    )


def the_program_says_how_many_steps_ran(lab: Lab) -> None:
    """On exit the program prints how many steps ran"""
    few = [lab.whole(each, 2) for each in (17, 17, 40, 9, 30, 3, 25, 12, 50, 21)]
    places = [places_of_the_steps(lab, frames) for frames in (few, [*few, *few[::2], *few])]
    lab.want(
        bool(places[0] & places[1]),
        "how many steps ran, in the same place of what it prints each time",
        "that number among others, once here and once there",
    )


def places_of_the_steps(lab: Lab, frames: list[int]) -> set[tuple[int, int]]:
    """Return where the count is printed: the lines, counted from the last, and indices in them.

    A list of all numbers does not count as an answer.
    """
    lab.ran(f"the lab scene with frames of {', '.join(map(str, frames))} ms")
    played = lab.play(frames, physics=False)
    want_a_proper_end(lab, played, len(frames))
    ran = sum(played.steps)
    lines = [list(map(int, NUMBER.findall(line))) for line in played.lines]
    numbers = [number for line in lines for number in line]
    said = ran if ran in numbers else next(iter(numbers), None)
    lab.saw("said", (ran,), said)
    lab.want(said == ran, f"{ran} in what it prints", f"{said}" if numbers else "no number")
    return {
        (above, index)
        for above, line in enumerate(reversed(lines))
        for index, number in enumerate(line)
        if number == ran
    }


@given(examples=1, rate=frame_rates, mixed=frame_lists, asked=frames_to_advance())
def any_frames_lose_nothing_but_what_the_cap_cuts(
    lab: Lab, rate: int, mixed: list[int], asked: list[tuple[float, float]]
) -> None:
    """Any frames: all steps are STEP long, and only the cap loses time"""
    # The single example is the simplest, under any seed.
    rate, mixed = rate + abs(lab.whole(0, 99)), [each + abs(lab.whole(0, 40)) for each in mixed]
    lab.ran(
        f"the lab scene at {rate} frames a second for 0.3 s, then with frames of 1, 2, … up to "
        f"58 ms, 6 each, then of {', '.join(map(str, mixed))} ms"
    )
    quick = [*frames_at(rate, 0.3), *ever_longer_frames()]
    paced = pace(lab, [*quick, *mixed])
    want_in_step(lab, paced, paced.out_of_step(len(quick)))
    most = MAX_STEPS * STEP_MS
    cut = sum(min(length, most) for length in paced.lengths)
    slow = sum(length > most - STEP_MS for length in paced.lengths)  # may lose a remainder as well
    lab.want(
        max(paced.steps) <= MAX_STEPS
        and -STEP_MS - paced.waiting <= cut - paced.simulated <= (1 + slow) * STEP_MS + paced.slack,
        f"{cut / STEP_MS:.0f} steps or up to {1 + slow} less, and at most {MAX_STEPS} a frame",
        f"{sum(paced.steps)} steps, and up to {max(paced.steps)} a frame",
    )
    want_fixed_steps(lab, paced.sizes)
    if paced.by_advance:
        lab.start_anew()
        world = make_still_world(lab)
        for accumulator, seconds in asked:
            want_whole_steps(lab, world, accumulator, seconds)
