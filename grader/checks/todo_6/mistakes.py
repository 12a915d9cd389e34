"""Known mistakes in TODO 6 and TODO 7d, as models of the steps that run in each frame.

Time is counted in thirds of a millisecond: there a step, the cap and every frame are whole numbers.
"""

from collections.abc import Callable
from fractions import Fraction

from grader.checks.mistakes import known_in
from grader.judge.explain.misconceptions import Undecided, truth
from grader.judge.lab import STEP as STEP_SECONDS
from grader.protocol import MAX_STEP_SIZES, RUNAWAY

STEP, CAP, SECOND = 25, 200, 3000

Frames = tuple[int, ...]  # ms
Answer = tuple[list[int], list[float]]  # steps after each frame but the last, step sizes in s

known = known_in("6 7d", "frames")  # of both programs


def answer_with(steps: list[int]) -> Answer:
    """Return the answer with steps of the right size."""
    return steps, [STEP_SECONDS] if any(steps) else []


def cap_frame(frame: int) -> int:
    return min(3 * frame, CAP)


def count_thirds(frame: int) -> int:
    return 3 * frame


def count_whole_steps(held: int | Fraction) -> int:
    """Return how many steps are due; undecided if rounding may delay the last one."""
    steps, rest = divmod(held, STEP)
    if steps and not rest and held != CAP:  # 8 * STEP does hold 8 steps
        raise Undecided
    return int(steps)


def run_accumulator(
    frames: Frames, added: Callable[[int], int | Fraction], most: int = RUNAWAY
) -> list[int]:
    """Return the steps of a loop that adds `added(frame)` and runs whole steps, `most` of them."""
    steps: list[int] = []
    held: int | Fraction = 0
    for frame in frames[:-1]:
        held += added(frame)
        steps.append(min(count_whole_steps(held), most))
        held -= steps[-1] * STEP
    return steps


def run_frames(frames: Frames) -> Answer:
    return answer_with(run_accumulator(frames, cap_frame))


truth("frames", run_frames)
known("one-step-per-frame", lambda frames: answer_with([1 for _ in frames[:-1]]))
known(
    "one-step-per-frame-at-most",
    lambda frames: answer_with(run_accumulator(frames, cap_frame, most=1)),
)
known("assumes-sixty-frames", lambda frames: answer_with([2 for _ in frames[:-1]]))
known(
    "drops-the-remainder",
    lambda frames: answer_with([count_whole_steps(cap_frame(frame)) for frame in frames[:-1]]),
)
known(
    "rounds-each-frame",
    lambda frames: answer_with([round(cap_frame(frame) / STEP) for frame in frames[:-1]]),
)


def run_at_price(frames: Frames, due: Callable[[int], int], price: int) -> Answer:
    """Return the steps of a loop that runs due(held) steps and subtracts `price` for each."""
    steps: list[int] = []
    held = 0
    for frame in frames[:-1]:
        held += cap_frame(frame)
        if held % STEP == 0:
            raise Undecided
        count = due(held)
        steps.append(min(max(count, 0), RUNAWAY))
        if steps[-1] == RUNAWAY:
            break
        held -= count * price
    return answer_with(steps)


known(
    "steps-before-it-is-due",
    lambda frames: run_at_price(frames, lambda held: max(0, -(-held // STEP)), STEP),
)
known("no-cap", lambda frames: answer_with(run_accumulator(frames, count_thirds)))
known(
    "cap-is-in-seconds",
    lambda frames: answer_with(run_accumulator(frames, lambda frame: min(3 * frame, 8 * SECOND))),
)
known(
    "cap-is-a-quarter-second",
    lambda frames: answer_with(run_accumulator(frames, lambda frame: min(3 * frame, SECOND // 4))),
)
known(
    "cap-counts-frames",
    lambda frames: answer_with(run_accumulator(frames, lambda frame: min(3 * frame, 2 * CAP))),
)
known(
    "cap-is-one-step",
    lambda frames: answer_with(run_accumulator(frames, lambda frame: min(3 * frame, STEP))),
)
known(
    "cap-is-turned-round",
    lambda frames: answer_with(run_accumulator(frames, lambda frame: max(3 * frame, CAP))),
)
known(
    "keeps-the-backlog",
    lambda frames: answer_with(run_accumulator(frames, count_thirds, most=CAP // STEP)),
)
known("counts-milliseconds", lambda frames: answer_with([CAP // STEP for _ in frames[:-1]]))
known(
    "takes-seconds-for-milliseconds",
    lambda frames: answer_with(
        run_accumulator(frames, lambda frame: min(Fraction(3 * frame, 1000), Fraction(CAP)))
    ),
)


@known("accumulator-never-shrinks")
def accumulator_never_shrinks(frames: Frames) -> Answer:
    steps: list[int] = []
    for number in range(1, len(frames)):
        if count_whole_steps(sum(map(cap_frame, frames[:number]))):
            return answer_with([*steps, RUNAWAY])
        steps.append(0)
    return answer_with(steps)


@known("steps-of-another-size")
def steps_of_another_size(frames: Frames) -> Answer:
    steps, sizes = run_frames(frames)
    return steps, [2 * size for size in sizes]


known(
    "steps-with-the-frame-time",
    lambda frames: ([1 for _ in frames[:-1]], list_sizes([cap_frame(frame) for frame in frames])),
)
known(
    "steps-with-all-of-the-frame-time",
    lambda frames: (
        [1 for _ in frames[:-1]],
        list_sizes([count_thirds(frame) for frame in frames]),
    ),
)


@known("steps-with-all-that-is-left")
def steps_with_all_that_is_left(frames: Frames) -> Answer:
    steps: list[int] = []
    sizes: list[int] = []
    held = 0
    for frame in frames[:-1]:
        held += cap_frame(frame)
        steps.append(min(count_whole_steps(held), 1))
        if steps[-1]:
            sizes.append(held)
            held = 0
    return steps, list_sizes(sizes)


def list_sizes(sizes: list[int]) -> list[float]:
    """Return each size once, in seconds."""
    return [size / SECOND for size in dict.fromkeys(sizes)][:MAX_STEP_SIZES]


@known("emptied-by-a-step")
def emptied_by_a_step(frames: Frames) -> Answer:
    steps, held = [], 0
    for frame in frames[:-1]:
        held += cap_frame(frame)
        steps.append(min(count_whole_steps(held), 1))
        held *= not steps[-1]
    return answer_with(steps)


known(
    "drops-the-remainder+no-cap",
    lambda frames: answer_with([count_whole_steps(count_thirds(frame)) for frame in frames[:-1]]),
)


@known("sixtieths-for-steps")
def sixtieths_for_steps(frames: Frames) -> Answer:
    """Run steps of 1/60 s, each as long as two right ones."""
    steps, held = [], 0
    for frame in frames[:-1]:
        held += cap_frame(frame)
        if held and held % (2 * STEP) == 0 and held != CAP:
            raise Undecided
        steps.append(held // (2 * STEP))
        held -= steps[-1] * 2 * STEP
    return steps, [2 * STEP_SECONDS] if any(steps) else []


@known("steps-with-the-accumulator")
def steps_with_the_accumulator(frames: Frames) -> Answer:
    steps, sizes, held = [], [], 0
    for frame in frames[:-1]:
        held += cap_frame(frame)
        steps.append(count_whole_steps(held))
        for _ in range(steps[-1]):
            sizes.append(held)
            held -= STEP
    return steps, list_sizes(sizes)


@known("steps-with-the-frame-in-the-loop")
def steps_with_the_frame_in_the_loop(frames: Frames) -> Answer:
    steps, _ = run_frames(frames)
    pairs = zip(steps, frames, strict=False)
    return steps, list_sizes([count_thirds(frame) for count, frame in pairs if count])


@known("pair-the-wrong-way-round")
def pair_the_wrong_way_round(frames: Frames) -> Answer:
    """Return the number of steps as the accumulator: the mistake swaps the two."""
    steps = [0]
    for frame in frames[:-1]:
        steps.append(min(count_whole_steps(cap_frame(frame) + SECOND * steps[-1]), RUNAWAY))
        if steps[-1] == RUNAWAY:
            break
    return answer_with(steps[1:])


@known("a-step-more-each-frame")
def a_step_more_each_frame(frames: Frames) -> Answer:
    if max(frames) <= 34:
        raise Undecided  # steps may be slow there, so more steps make the last frames longer
    return answer_with([1 + steps for steps in run_accumulator(frames, cap_frame)])


known(
    "a-step-less-each-frame",
    lambda frames: answer_with([max(steps - 1, 0) for steps in run_accumulator(frames, cap_frame)]),
)


def second_taken_out(frames: Frames) -> Answer:
    """Take 1 s out of the accumulator for each step."""
    steps: list[int] = []
    held = 0
    for frame in frames[:-1]:
        held += cap_frame(frame)
        steps.append(0)
        while held > 0 and count_whole_steps(held):
            steps[-1] += 1
            held -= SECOND
    return answer_with(steps)


known(
    "count-taken-out",
    lambda frames: run_at_price(frames, lambda held: int(held / STEP), SECOND),  # towards 0
    second_taken_out,
)
known("no-step-runs", lambda frames: answer_with([0 for _ in frames[:-1]]))
truth("said", lambda ran: ran)
known_in("6 7d", "said")("steps-are-not-counted", lambda ran: 0)
known_in("6 7d", "said")("steps-are-counted-down", lambda ran: -ran)
