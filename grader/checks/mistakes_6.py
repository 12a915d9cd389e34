"""Known mistakes in TODO 6 and TODO 7d, as models of the steps that run in each frame.

Time is counted in thirds of a millisecond: there a step, the cap and every frame are whole numbers.
"""

from collections.abc import Callable

from grader.judge.lab import STEP as STEP_SECONDS
from grader.judge.misconceptions import Model, Undecided, mistake, truth
from grader.protocol import RUNAWAY

STEP, CAP = 25, 200

Frames = tuple[int, ...]  # ms
Answer = tuple[list[int], list[float]]  # steps after each frame but the last, step sizes in s


def fixed_step_mistake(name: str, meaning: str) -> Callable[[Model], Model]:
    """Register a model for both programs."""

    def register(model: Model) -> Model:
        for todo in ("6", "7d"):
            mistake(todo, name, meaning, about="frames")(model)
        return model

    return register


def counted(steps: list[int]) -> Answer:
    return steps, [STEP_SECONDS] if any(steps) else []


def capped(frame: int) -> int:
    return min(3 * frame, CAP)


def uncapped(frame: int) -> int:
    return 3 * frame


def accumulated(
    frames: Frames,
    added: Callable[[int], int],
    most: int = RUNAWAY,
    keeps_the_rest: bool = True,
    step: int = STEP,
) -> list[int]:
    """The steps of a loop that adds `added(frame)` and runs whole steps, `most` of them."""
    steps: list[int] = []
    held = 0
    for frame in frames[:-1]:
        held += added(frame)
        if held and held % step == 0:
            raise Undecided  # rounding decides whether the last step runs now or in the next frame
        steps.append(min(held // step, most))
        held = held - steps[-1] * step if keeps_the_rest else 0
    return steps


@truth("frames")
def right(frames: Frames) -> Answer:
    return counted(accumulated(frames, capped))


@fixed_step_mistake(
    "one-step-per-frame",
    "Every frame runs one step: the faster the computer draws, the faster everything moves.",
)
def one_step_per_frame(frames: Frames) -> Answer:
    return counted([1 for _ in frames[:-1]])


@fixed_step_mistake(
    "no-cap",
    "A slow frame is simulated in full, which makes the next one slower still; "
    "add min(frame_seconds, MAX_STEPS * STEP) at the most.",
)
def no_cap(frames: Frames) -> Answer:
    return counted(accumulated(frames, uncapped))


@fixed_step_mistake(
    "drops-the-remainder",
    "What is left of a frame after its whole steps is thrown away; it belongs to the next frame.",
)
def drops_the_remainder(frames: Frames) -> Answer:
    return counted(accumulated(frames, capped, keeps_the_rest=False))


@fixed_step_mistake(
    "rounds-each-frame",
    "Each frame is rounded to whole steps by itself, and the errors add up.",
)
def rounds_each_frame(frames: Frames) -> Answer:
    return counted([round(capped(frame) / STEP) for frame in frames[:-1]])


@fixed_step_mistake(
    "if-instead-of-while",
    "A frame runs one step at the most, however much time waits: repeat it while a step is left.",
)
def if_instead_of_while(frames: Frames) -> Answer:
    return counted(accumulated(frames, capped, most=1))


@fixed_step_mistake(
    "the-debt-is-kept",
    "A slow frame runs 8 steps and leaves the rest of its time waiting: "
    "the frames after it have to make up for it.",
)
def debt_is_kept(frames: Frames) -> Answer:
    return counted(accumulated(frames, uncapped, most=CAP // STEP))


@fixed_step_mistake(
    "cap-is-one-step",
    "A frame may add one STEP at the most; the cap is MAX_STEPS of them.",
)
def cap_is_one_step(frames: Frames) -> Answer:
    return counted(accumulated(frames, lambda frame: min(3 * frame, STEP)))


@fixed_step_mistake(
    "cap-counts-frames",
    "The cap is 8 frames of 1/60 s; MAX_STEPS counts steps: MAX_STEPS * STEP.",
)
def cap_counts_frames(frames: Frames) -> Answer:
    return counted(accumulated(frames, lambda frame: min(3 * frame, 2 * CAP)))


@fixed_step_mistake(
    "assumes-sixty-frames",
    "Every frame is taken to last 1/60 s; a frame lasts what the clock says.",
)
def assumes_sixty_frames(frames: Frames) -> Answer:
    return counted([2 for _ in frames[:-1]])


@fixed_step_mistake(
    "counts-milliseconds",
    "The frame is counted in milliseconds and the step in seconds: every frame reaches the cap.",
)
def counts_milliseconds(frames: Frames) -> Answer:
    return counted([CAP // STEP for _ in frames[:-1]])


@fixed_step_mistake(
    "accumulator-never-shrinks",
    "The loop of steps does not end: each step must take STEP from the accumulator.",
)
def never_shrinks(frames: Frames) -> Answer:
    steps: list[int] = []
    for number in range(1, len(frames)):
        if sum(map(capped, frames[:number])) >= STEP:
            return counted([*steps, RUNAWAY])
        steps.append(0)
    return counted(steps)


@fixed_step_mistake(
    "one-step-as-long-as-the-frame",
    "Every frame runs one step of its own length; all steps must be STEP long.",
)
def frame_long_steps(frames: Frames) -> Answer:
    sizes = dict.fromkeys(frame / 1000 for frame in frames)
    return [1 for _ in frames[:-1]], list(sizes)[:16]


@fixed_step_mistake(
    "one-step-as-long-as-the-capped-frame",
    "Every frame runs one step of its own length, up to the cap; all steps must be STEP long.",
)
def capped_frame_long_steps(frames: Frames) -> Answer:
    sizes = dict.fromkeys(min(frame / 1000, CAP / 3000) for frame in frames)
    return [1 for _ in frames[:-1]], list(sizes)[:16]


@fixed_step_mistake(
    "steps-of-a-sixtieth",
    "The steps are 1/60 s long; STEP is 1/120 s.",
)
def steps_of_a_sixtieth(frames: Frames) -> Answer:
    steps = accumulated(frames, capped, step=2 * STEP)
    return steps, [2 * STEP_SECONDS] if any(steps) else []
