"""Cases of time: the steps that run in frames, and the damping of a speed."""

import math
from collections.abc import Sequence
from fractions import Fraction

from grader.checks import exact
from grader.judge.decode import Thing
from grader.judge.lab import STEP, Lab
from grader.questions.numbers import Case, Draw, Unsuited, maker
from grader.questions.program import Program
from grader.text import digits

CAP = Fraction(200, 3)  # ms, the maximum that a frame adds
STEP_MS = Fraction(25, 3)  # of a step
FRAMES = {
    "start": range(0, 8),  # ms in the accumulator
    "count": range(4, 9),  # of short frames
    "short": range(9, 60),  # ms
    "long": range(110, 400),  # ms, of the last one
}


def run_frames(lab: Lab, world: Thing, start: int, frames: Sequence[int]) -> int:
    """Return the steps that a program's own `advance` runs in frames (ms)."""
    rest, steps = start / 1000, 0
    for each in frames:
        advance = lab.advance(world, rest, each / 1000)
        rest, steps = advance.rest, steps + advance.steps
    return steps


def make_steps_case(draw: Draw, where: str, lab: Lab, world: Thing) -> Case:
    start, count, short, long = (draw[name] for name in FRAMES)
    frames = [short] * count + [long]
    paid = [min(Fraction(each), CAP) for each in frames]
    sums = [(start + sum(paid[:number])) / STEP_MS for number in range(1, len(paid) + 1)]
    if any(not Fraction(1, 10) < each % 1 < Fraction(9, 10) for each in sums):
        raise Unsuited  # rounding could decide a step
    owed = sums[-1]
    return Case(
        f"The accumulator holds {start} ms. Then {count} frames of {short} ms each go by, and a "
        f"long one of {long} ms. Steps last 1/120 s, and a frame may add 8 of them at most.\n"
        f"How many steps has `advance` of your {where} run in all?",
        math.floor(owed),
        run_frames(lab, world, start, frames),
        "steps",
        f"{start} + {count} · {short} + 66.67 ms are {digits(float(owed))} steps; the part that is "
        "no whole step stays for later.",
        [
            (
                math.floor((start + sum(frames)) / STEP_MS),
                "forgot that a frame adds 8 steps at most",
            ),
            (
                sum(math.floor(each / STEP_MS) for each in paid),
                "dropped what is left after each frame instead of keeping it",
            ),
            (math.ceil(owed), "ran a step that is not fully paid for"),
            (len(frames), "ran one step per frame"),
        ],
        whole=True,
    )


@maker(3, "6", **FRAMES)
def steps(program: Program, draw: Draw) -> Case:
    with program.own.lab("mini_engine") as lab:
        return make_steps_case(draw, "engine", lab, lab.world())


@maker(3, "7d", **FRAMES)
def pymunk_steps(program: Program, draw: Draw) -> Case:
    with program.own.lab("pymunk_scene") as lab:
        return make_steps_case(draw, "pymunk scene", lab, lab.thing(lab.call("empty_space")))


@maker(4, "5", rate=range(2, 10), halves=range(1, 6), speed=range(150, 900))
def damping(program: Program, draw: Draw) -> Case:
    """Predict the speed that remains after a damped free flight."""
    rate, seconds, speed = draw["rate"] / 10, draw["halves"] / 2, float(draw["speed"])
    with program.own.lab("mini_engine") as lab:
        ball = lab.circle((0.0, 0.0), vel=(speed, 0.0))
        world = lab.world(ball, linear_damping=rate)
        run = lab.simulate(world, [ball], round(seconds / STEP), every=round(seconds / STEP))
        measured = run.body(0)[-1].speed
    return Case(
        f"A ball flies freely at {speed:g} px/s in a `World` without gravity, with "
        f"`linear_damping={rate:g}`.\nHow fast is it after {seconds:g} s?",
        speed * exact.compute_share(rate, seconds),
        measured,
        "px/s",
        f"Each second keeps the share exp(-{rate:g}): v exp(-{rate:g} · {seconds:g}), whatever "
        "the step.",
        [
            (speed * (1 - rate * seconds), "took the same speed away each second, not a share"),
            (speed * (1 - rate) ** seconds, "kept 1 - rate of each second instead of exp(-rate)"),
            (speed * (1 - rate * STEP), "damped one step alone"),
            (speed * exact.compute_share(rate, 1.0), "damped for one second, whatever the time")
            if seconds != 1
            else (speed * (1 - exact.compute_share(rate, 1.0)), "gave what is lost"),
        ],
    )


MAKERS = (steps, pymunk_steps, damping)
