"""Known mistakes in TODO 6 and TODO 7d, as models of the steps that run in each frame.

Time is counted in thirds of a millisecond: there a step, the cap and every frame are whole numbers.
"""

from collections.abc import Callable, Iterator
from fractions import Fraction

from grader.checks.mistakes import Models, register
from grader.judge.explain.misconceptions import Kind, Undecided, kinds
from grader.judge.lab import STEP as STEP_SECONDS
from grader.protocol import MAX_STEP_SIZES, RUNAWAY

STEP, CAP, SECOND = 25, 200, 3000

Frames = tuple[int, ...]  # ms
Held = int | Fraction
Answer = tuple[list[int], list[float]]  # steps after each frame but the last, step sizes in s


def answer_with(steps: list[int]) -> Answer:
    """Return the answer with steps of the right size."""
    return steps, [STEP_SECONDS] if any(steps) else []


def list_sizes(sizes: list[int]) -> list[float]:
    """Return each size once, in seconds."""
    return [size / SECOND for size in dict.fromkeys(sizes)][:MAX_STEP_SIZES]


def cap_frame(frame: int) -> int:
    return min(3 * frame, CAP)


def count_thirds(frame: int) -> int:
    return 3 * frame


def count_whole_steps(held: Held) -> int:
    """Return how many steps are due; undecided if rounding may delay the last one."""
    steps, rest = divmod(held, STEP)
    if steps and not rest and held != CAP:  # 8 * STEP does hold 8 steps
        raise Undecided
    return int(steps)


def take_steps(held: Held, count: int) -> Held:
    return held - count * STEP


def run_loop(
    frames: Frames,
    added: Callable[[int], Held],
    due: Callable[[Held], int] = count_whole_steps,
    rest: Callable[[Held, int], Held] = take_steps,
) -> Iterator[tuple[Held, int]]:
    """Yield the accumulator and the steps of each frame but the last.

    `due` counts the steps, and `rest` returns what is left after them. A runaway ends the loop.
    """
    held: Held = 0
    for frame in frames[:-1]:
        held += added(frame)
        count = due(held)
        yield held, min(max(count, 0), RUNAWAY)
        if count >= RUNAWAY:
            return
        held = rest(held, count)


def accumulate(
    added: Callable[[int], Held] = cap_frame,
    due: Callable[[Held], int] = count_whole_steps,
    rest: Callable[[Held, int], Held] = take_steps,
) -> Callable[[Frames], Answer]:
    """Return the model of a loop whose steps have the right size."""
    return lambda frames: answer_with([count for _, count in run_loop(frames, added, due, rest)])


def in_each_frame(count: Callable[[int], int]) -> Callable[[Frames], Answer]:
    """Return the model of a loop that forgets all earlier frames."""
    return lambda frames: answer_with([count(frame) for frame in frames[:-1]])


def at_most(most: int) -> Callable[[Held], int]:
    return lambda held: min(count_whole_steps(held), most)


kinds["frames"] = Kind(accumulate())


# ---------------------------------------------------------------- loops of another kind


def one_step_of(size: Callable[[int], int]) -> Callable[[Frames], Answer]:
    """Return the model with one step of `size(frame)` in each frame."""
    return lambda frames: ([1 for _ in frames[:-1]], list_sizes([size(each) for each in frames]))


def count_at_once(held: Held) -> int:
    if held % STEP == 0:
        raise Undecided
    return int(-(-held // STEP))


def count_towards_zero(held: Held) -> int:
    if held % STEP == 0:
        raise Undecided
    return int(held / STEP)


def count_seconds(held: Held) -> int:
    """Count steps that each take 1 s from the accumulator."""
    count = 0
    while held > 0 and count_whole_steps(held):
        count, held = count + 1, held - SECOND
    return count


def take_seconds(held: Held, count: int) -> Held:
    return held - count * SECOND


def step_by_all_left(frames: Frames) -> Answer:
    ran = list(run_loop(frames, cap_frame, at_most(1), lambda held, count: 0 if count else held))
    return [count for _, count in ran], list_sizes([int(held) for held, count in ran if count])


def step_by_accumulator(frames: Frames) -> Answer:
    ran = list(run_loop(frames, cap_frame))
    sizes = [int(held) - n * STEP for held, count in ran for n in range(count)]
    return [count for _, count in ran], list_sizes(sizes)


def step_by_frames(frames: Frames) -> Answer:
    steps, _ = accumulate()(frames)
    pairs = zip(steps, frames, strict=False)
    return steps, list_sizes([count_thirds(frame) for count, frame in pairs if count])


def double_sizes(frames: Frames) -> Answer:
    steps, sizes = accumulate()(frames)
    return steps, [2 * size for size in sizes]


def run_sixtieths(frames: Frames) -> Answer:
    """Run steps of 1/60 s, each as long as two right ones."""

    def due(held: Held) -> int:
        if held and held % (2 * STEP) == 0 and held != CAP:
            raise Undecided
        return int(held // (2 * STEP))

    steps, _ = accumulate(cap_frame, due, lambda held, count: held - count * 2 * STEP)(frames)
    return steps, [2 * STEP_SECONDS] if any(steps) else []


def add_a_step(frames: Frames) -> Answer:
    if max(frames) <= 34:
        raise Undecided  # steps may be slow there, so more steps make the last frames longer
    return answer_with([1 + count for count in accumulate()(frames)[0]])


def skip_a_step(frames: Frames) -> Answer:
    return answer_with([max(count - 1, 0) for count in accumulate()(frames)[0]])


def count_forever(held: Held) -> int:
    """Return the steps of an accumulator that never shrinks, so the loop never ends."""
    return RUNAWAY if count_whole_steps(held) else 0


def swap_pair(frames: Frames) -> Answer:
    """Return the number of steps as the accumulator: the mistake swaps the two."""
    return accumulate(cap_frame, count_whole_steps, lambda held, count: SECOND * count)(frames)


MODELS: Models = (
    ("one-step-per-frame", in_each_frame(lambda frame: 1)),
    ("one-step-per-frame-at-most", accumulate(due=at_most(1))),
    ("assumes-sixty-frames", in_each_frame(lambda frame: 2)),
    ("drops-the-remainder", in_each_frame(lambda frame: count_whole_steps(cap_frame(frame)))),
    ("rounds-each-frame", in_each_frame(lambda frame: round(cap_frame(frame) / STEP))),
    ("steps-before-it-is-due", accumulate(due=count_at_once)),
    ("no-cap", accumulate(count_thirds)),
    ("cap-is-in-seconds", accumulate(lambda frame: min(3 * frame, 8 * SECOND))),
    ("cap-is-a-quarter-second", accumulate(lambda frame: min(3 * frame, SECOND // 4))),
    ("cap-counts-frames", accumulate(lambda frame: min(3 * frame, 2 * CAP))),
    ("cap-is-one-step", accumulate(lambda frame: min(3 * frame, STEP))),
    ("cap-is-turned-round", accumulate(lambda frame: max(3 * frame, CAP))),
    ("keeps-the-backlog", accumulate(count_thirds, at_most(CAP // STEP))),
    ("counts-milliseconds", in_each_frame(lambda frame: CAP // STEP)),
    (
        "takes-seconds-for-milliseconds",
        accumulate(lambda frame: min(Fraction(3 * frame, 1000), Fraction(CAP))),
    ),
    ("accumulator-never-shrinks", accumulate(due=count_forever)),
    ("steps-of-another-size", double_sizes),
    ("steps-with-the-frame-time", one_step_of(cap_frame)),
    ("steps-with-all-of-the-frame-time", one_step_of(count_thirds)),
    ("steps-with-all-that-is-left", step_by_all_left),
    ("emptied-by-a-step", accumulate(due=at_most(1), rest=lambda held, count: held * (not count))),
    ("drops-the-remainder+no-cap", in_each_frame(lambda frame: count_whole_steps(3 * frame))),
    ("sixtieths-for-steps", run_sixtieths),
    ("steps-with-the-accumulator", step_by_accumulator),
    ("steps-with-the-frame-in-the-loop", step_by_frames),
    ("pair-the-wrong-way-round", swap_pair),
    ("a-step-more-each-frame", add_a_step),
    ("a-step-less-each-frame", skip_a_step),
    ("count-taken-out", accumulate(due=count_towards_zero, rest=take_seconds)),
    ("count-taken-out", accumulate(due=count_seconds, rest=take_seconds)),
    ("no-step-runs", in_each_frame(lambda frame: 0)),
)
register("6 7d", "frames", MODELS)  # of both programs

kinds["said"] = Kind(lambda ran: ran)
SAID: Models = (
    ("steps-are-not-counted", lambda ran: 0),
    ("steps-are-counted-down", lambda ran: -ran),
)
register("6 7d", "said", SAID)
