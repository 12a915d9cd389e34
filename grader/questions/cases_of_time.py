"""Cases of time: the accumulator, frames, and damping of a speed."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from grader.checks import exact
from grader.judge.decode import Thing
from grader.judge.lab import STEP, Lab
from grader.questions.numbers import Case, Draw, Unsuited, maker
from grader.questions.program import Program
from grader.text import digits

CAP = Fraction(200, 3)  # ms, the most that a frame adds
STEP_MS = Fraction(25, 3)  # of a step
FORGOT_THE_CAP = "forgot that a frame adds 8 steps at most"


def count_paid(start: int, frames: Sequence[int], cap: Fraction | None = CAP) -> Fraction:
    """Return all that frames (ms) add to the accumulator, in steps."""
    total = sum((Fraction(each) if cap is None else min(Fraction(each), cap)) for each in frames)
    return (start + total) / STEP_MS


@dataclass(frozen=True)
class Purse:
    """Some frames, one of them long, and the accumulator before them."""

    start: int  # ms
    count: int
    length: int
    long: int

    @property
    def frames(self) -> list[int]:
        return [self.length] * self.count + [self.long]

    @property
    def owed(self) -> Fraction:
        """Return the time in steps; raises Unsuited where rounding could decide the last one."""
        sums = [
            count_paid(self.start, self.frames[: count + 1]) for count in range(len(self.frames))
        ]
        if any(not Fraction(1, 10) < each - math.floor(each) < Fraction(9, 10) for each in sums):
            raise Unsuited
        return sums[-1]

    @property
    def words(self) -> str:
        return (
            f"The accumulator holds {self.start} ms. Then {self.count} frames of {self.length} ms "
            f"each go by, and a long one of {self.long} ms. Steps last 1/120 s, and a frame may "
            "add 8 of them at most."
        )

    def run(self, lab: Lab, world: Thing) -> tuple[int, float]:
        """Return the steps that a program's own `advance` runs, and what it leaves, in ms."""
        rest, steps = self.start / 1000, 0
        for each in self.frames:
            advance = lab.advance(world, rest, each / 1000)
            rest, steps = advance.rest, steps + advance.steps
        return steps, rest * 1000


PURSE = {
    "start": range(0, 8),
    "count": range(4, 9),
    "length": range(9, 60),
    "long": range(110, 400),
}


def make_steps_case(purse: Purse, owed: Fraction, where: str, measured: int) -> Case:
    steps, step = math.floor(owed), STEP_MS
    each_alone = sum(math.floor(min(Fraction(each), CAP) / step) for each in purse.frames)
    return Case(
        f"{purse.words}\nHow many steps has `advance`{where} run in all?",
        steps,
        measured,
        "steps",
        f"{purse.start} + {purse.count} · {purse.length} + 66.67 ms are "
        f"{digits(float(owed))} steps; the part that is no whole step stays for later.",
        [
            (math.floor(count_paid(purse.start, purse.frames, None)), FORGOT_THE_CAP),
            (each_alone, "dropped what is left after each frame instead of keeping it"),
            (math.ceil(owed), "ran a step that is not fully paid for"),
            (purse.count + 1, "ran one step per frame"),
        ],
        whole=True,
    )


@maker(3, "6", **PURSE)
def steps(program: Program, draw: Draw) -> Case:
    case = Purse(**draw)
    owed = case.owed
    with program.own.lab("mini_engine") as lab:
        measured, _ = case.run(lab, lab.world())
    return make_steps_case(case, owed, " of your engine", measured)


@maker(3, "7d", **PURSE)
def pymunk_steps(program: Program, draw: Draw) -> Case:
    case = Purse(**draw)
    owed = case.owed
    with program.own.lab("pymunk_scene") as lab:
        measured, _ = case.run(lab, lab.thing(lab.call("empty_space")))
    return make_steps_case(case, owed, " of your pymunk scene", measured)


@maker(4, "6", **PURSE)
def purse(program: Program, draw: Draw) -> Case:
    """Predict what is left in the accumulator."""
    case = Purse(**draw)
    owed = case.owed
    with program.own.lab("mini_engine") as lab:
        _, measured = case.run(lab, lab.world())
    left = float((owed - math.floor(owed)) * STEP_MS)
    uncapped = count_paid(case.start, case.frames, None)
    return Case(
        f"{case.words}\nHow many ms are left in the accumulator of your engine then?",
        left,
        measured,
        "ms",
        f"{digits(float(owed))} steps are owed, {math.floor(owed)} of them run; the rest of one "
        "step, of 8.333 ms, is left.",
        [
            (float((uncapped - math.floor(uncapped)) * STEP_MS), FORGOT_THE_CAP),
            (0.0, "emptied the accumulator with each frame"),
            (float(left - STEP_MS), "ran a step that is not fully paid for"),
        ],
        share=0.05,
    )


@maker(4, "5", rate=range(2, 10), halves=range(1, 6), speed=range(150, 900))
def damping(program: Program, draw: Draw) -> Case:
    """Predict the speed that damping leaves of a free flight."""
    rate, seconds, speed = draw["rate"] / 10, draw["halves"] / 2, float(draw["speed"])
    with program.own.lab("mini_engine") as lab:
        ball = lab.circle((0.0, 0.0), vel=(speed, 0.0))
        world = lab.world(ball, linear_damping=rate)
        run = lab.simulate(world, [ball], round(seconds / STEP), every=round(seconds / STEP))
        measured = run.body(0)[-1].speed
    return Case(
        f"A ball flies freely at {speed:g} px/s in a `World` without gravity, with "
        f"`linear_damping={rate:g}`.\nHow fast is it after {seconds:g} s?",
        speed * exact.damped(rate, seconds),
        measured,
        "px/s",
        f"Each second keeps the share exp(-{rate:g}): v exp(-{rate:g} · {seconds:g}), whatever "
        "the step.",
        [
            (speed * (1 - rate * seconds), "took the same speed away each second, not a share"),
            (speed * (1 - rate) ** seconds, "kept 1 - rate of each second instead of exp(-rate)"),
            (speed * (1 - rate * STEP), "damped one step alone"),
            (speed * exact.damped(rate, 1.0), "damped for one second, whatever the time")
            if seconds != 1
            else (speed * (1 - exact.damped(rate, 1.0)), "gave what is lost"),
        ],
    )


MAKERS = (steps, pymunk_steps, purse, damping)
