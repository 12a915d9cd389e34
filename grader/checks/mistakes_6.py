"""Known mistakes in TODO 6 and TODO 7d, as models of the steps that run in each frame.

Time is counted in thirds of a millisecond: there a step, the cap and every frame are whole numbers.
"""

from collections.abc import Callable
from fractions import Fraction

from grader.judge.lab import STEP as STEP_SECONDS
from grader.judge.misconceptions import Model, Undecided, mistake, truth
from grader.protocol import RUNAWAY

STEP, CAP, SECOND = 25, 200, 3000
MAX_SIZES = 16  # that a play reports

Frames = tuple[int, ...]  # ms
Answer = tuple[list[int], list[float]]  # steps after each frame but the last, step sizes in s


def fixed_step_mistake(name: str, meaning: str, about: str = "frames") -> Callable[[Model], Model]:
    """Register a model for both programs."""

    def register(model: Model) -> Model:
        for todo in ("6", "7d"):
            mistake(todo, name, meaning, about=about)(model)
        return model

    return register


def counted(steps: list[int]) -> Answer:
    """Steps of the right size."""
    return steps, [STEP_SECONDS] if any(steps) else []


def capped(frame: int) -> int:
    return min(3 * frame, CAP)


def uncapped(frame: int) -> int:
    return 3 * frame


def whole_steps(held: int | Fraction) -> int:
    """How many steps are due; undecided where rounding may put the last one off."""
    steps, rest = divmod(held, STEP)
    if steps and not rest and held != CAP:  # 8 * STEP does hold 8 steps
        raise Undecided
    return int(steps)


def accumulated(
    frames: Frames, added: Callable[[int], int | Fraction], most: int = RUNAWAY
) -> list[int]:
    """The steps of a loop that adds `added(frame)` and runs whole steps, `most` of them."""
    steps: list[int] = []
    held: int | Fraction = 0
    for frame in frames[:-1]:
        held += added(frame)
        steps.append(min(whole_steps(held), most))
        held -= steps[-1] * STEP
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
    "one-step-per-frame-at-most",
    "A frame runs one step at the most, however much time waits: repeat it while a step is left.",
)
def if_instead_of_while(frames: Frames) -> Answer:
    return counted(accumulated(frames, capped, most=1))


@fixed_step_mistake(
    "assumes-sixty-frames",
    "Every frame is taken to last 1/60 s; a frame lasts what the clock says.",
)
def assumes_sixty_frames(frames: Frames) -> Answer:
    return counted([2 for _ in frames[:-1]])


@fixed_step_mistake(
    "drops-the-remainder",
    "What is left of a frame after its whole steps is thrown away; it belongs to the next frame.",
)
def drops_the_remainder(frames: Frames) -> Answer:
    return counted([whole_steps(capped(frame)) for frame in frames[:-1]])


@fixed_step_mistake(
    "rounds-each-frame",
    "Each frame is rounded to whole steps by itself, and the errors add up.",
)
def rounds_each_frame(frames: Frames) -> Answer:
    return counted([round(capped(frame) / STEP) for frame in frames[:-1]])


@fixed_step_mistake(
    "steps-before-it-is-due",
    "A step runs while any time is left, so the accumulator falls below 0; wait for a whole STEP.",
)
def steps_early(frames: Frames) -> Answer:
    steps: list[int] = []
    held = 0
    for frame in frames[:-1]:
        held += capped(frame)
        if held % STEP == 0:
            raise Undecided
        steps.append(max(0, -(-held // STEP)))
        held -= steps[-1] * STEP
    return counted(steps)


@fixed_step_mistake(
    "no-cap",
    "A slow frame is simulated in full, which makes the next one slower still: "
    "add MAX_STEPS * STEP at the most.",
)
def no_cap(frames: Frames) -> Answer:
    return counted(accumulated(frames, uncapped))


@fixed_step_mistake(
    "cap-is-in-seconds",
    "The cap is 8 seconds; MAX_STEPS counts steps, so it is MAX_STEPS * STEP.",
)
def cap_in_seconds(frames: Frames) -> Answer:
    return counted(accumulated(frames, lambda frame: min(3 * frame, 8 * SECOND)))


@fixed_step_mistake(
    "cap-counts-frames",
    "The cap is 8 frames of 1/60 s; MAX_STEPS counts steps, so it is MAX_STEPS * STEP.",
)
def cap_counts_frames(frames: Frames) -> Answer:
    return counted(accumulated(frames, lambda frame: min(3 * frame, 2 * CAP)))


@fixed_step_mistake(
    "cap-is-one-step",
    "A frame may add one STEP at the most; the cap is MAX_STEPS of them.",
)
def cap_is_one_step(frames: Frames) -> Answer:
    return counted(accumulated(frames, lambda frame: min(3 * frame, STEP)))


@fixed_step_mistake(
    "cap-is-turned-round",
    "Every frame adds MAX_STEPS * STEP or more: the cap is the larger of the two, not the smaller.",
)
def cap_turned_round(frames: Frames) -> Answer:
    return counted(accumulated(frames, lambda frame: max(3 * frame, CAP)))


@fixed_step_mistake(
    "keeps-the-backlog",
    "A slow frame runs 8 steps and leaves the rest of its time waiting: "
    "the frames after it have to make up for it.",
)
def keeps_the_backlog(frames: Frames) -> Answer:
    return counted(accumulated(frames, uncapped, most=CAP // STEP))


@fixed_step_mistake(
    "counts-milliseconds",
    "The frame is counted in milliseconds and the step in seconds: every frame reaches the cap.",
)
def counts_milliseconds(frames: Frames) -> Answer:
    return counted([CAP // STEP for _ in frames[:-1]])


@fixed_step_mistake(
    "takes-seconds-for-milliseconds",
    "The frame is divided by 1000, but it is in seconds already: almost nothing moves.",
)
def takes_seconds_for_milliseconds(frames: Frames) -> Answer:
    return counted(accumulated(frames, lambda frame: min(Fraction(3 * frame, 1000), Fraction(CAP))))


@fixed_step_mistake(
    "accumulator-never-shrinks",
    "The loop of steps does not end: each step must take STEP from the accumulator.",
)
def never_shrinks(frames: Frames) -> Answer:
    steps: list[int] = []
    for number in range(1, len(frames)):
        if whole_steps(sum(map(capped, frames[:number]))):
            return counted([*steps, RUNAWAY])
        steps.append(0)
    return counted(steps)


@fixed_step_mistake(
    "steps-of-another-size",
    "The steps are 1/60 s long, and each is paid for with 1/120 s; every step must be STEP long.",
)
def steps_of_a_sixtieth(frames: Frames) -> Answer:
    steps, sizes = right(frames)
    return steps, [2 * size for size in sizes]


@fixed_step_mistake(
    "steps-with-the-frame-time",
    "Every frame runs one step of its own length, up to the cap; every step must be STEP long.",
)
def steps_with_the_frame_time(frames: Frames) -> Answer:
    return [1 for _ in frames[:-1]], different([capped(frame) for frame in frames])


@fixed_step_mistake(
    "steps-with-all-of-the-frame-time",
    "Every frame runs one step of its own length; every step must be STEP long.",
)
def steps_with_all_of_the_frame_time(frames: Frames) -> Answer:
    return [1 for _ in frames[:-1]], different([uncapped(frame) for frame in frames])


@fixed_step_mistake(
    "steps-with-all-that-is-left",
    "A step gets all the time that has gathered; every step must be STEP long.",
)
def steps_with_all_that_is_left(frames: Frames) -> Answer:
    steps: list[int] = []
    sizes: list[int] = []
    held = 0
    for frame in frames[:-1]:
        held += capped(frame)
        steps.append(min(whole_steps(held), 1))
        if steps[-1]:
            sizes.append(held)
            held = 0
    return steps, different(sizes)


def different(sizes: list[int]) -> list[float]:
    """Each size once, in seconds."""
    return [size / SECOND for size in dict.fromkeys(sizes)][:MAX_SIZES]


@truth("said")
def says_what_ran(ran: int) -> int:
    return ran


@fixed_step_mistake(
    "steps-are-not-counted",
    "The steps run, but they are not counted: steps must be the number of them.",
    about="said",
)
def not_counted(ran: int) -> int:
    return 0


@fixed_step_mistake(
    "steps-are-counted-down",
    "Every step takes one from the count; it must add one.",
    about="said",
)
def counted_down(ran: int) -> int:
    return -ran
