"""Test fixed steps with frames of any length, for TODO 6 and TODO 7d.

A program may read the time in any way, and simulate a frame's time in that frame or the next.
Frames are whole milliseconds, as pygame's are.
"""

import math
from dataclasses import dataclass
from itertools import accumulate, pairwise

from grader.checks.exact import MAX_STEPS
from grader.judge.lab import STEP, Lab, Thing
from grader.protocol import RUNAWAY, Played

STEP_MS = 1000 * STEP
ROUNDING = 1e-6  # ms
TINY = 1e-5  # s: allows programs that count in microseconds or add a margin for rounding
DRIFT = 1e-4  # share of the time: STEP is 8333 or 8334 whole microseconds
OFF_BEAT = [2]  # ms: no later sum is a whole number of steps, where rounding would decide
BELOW_ZERO = (
    "The accumulator falls below 0: the frame's time is added to it, and a step takes STEP from it "
    "only while it holds as much."
)
ENDLESS = "The loop of steps does not end: each step must take STEP from the accumulator."
SETTLE = [1, 1]  # ms: time for a program that is a frame behind
LONGEST_FRAME = 58  # ms: of the frames that stay below the cap
STEP_TAKES = 2.5  # ms, where steps are slow; they fit into every frame
LONGEST_UNCUT, LONGEST_WAIT = 66, 50  # ms: below the cap of 66.7, and with room between them


def frames_at(rate: int, seconds: float) -> list[int]:
    """Return the frames (ms) of these seconds at a frame rate: at 144, mostly 7 and some 6."""
    ends = [round(1000 * number / rate) for number in range(round(rate * seconds) + 1)]
    return [end - begin for begin, end in pairwise(ends)]


def ever_longer_frames() -> list[int]:
    """Return 6 frames of each length below the cap, to expose a wrong length."""
    return [length for length in range(1, LONGEST_FRAME + 1) for _ in range(6)]


@dataclass
class Pace:
    """Holds the steps that a program ran in each frame."""

    lengths: list[float]  # ms, as scripted, or longer if the program slept longer
    steps: list[int]  # that ran after this frame and before the end of the next
    sizes: list[float]  # s, the different step sizes
    waiting: float  # ms that had passed before the first of these frames and were not simulated
    by_advance: bool  # every step ran in `advance`, as on the lab sheet

    @property
    def time(self) -> float:
        """Return the time that has passed, ms."""
        return sum(self.lengths)

    @property
    def step(self) -> float:
        """Return the time that a step simulates, ms; the longest where they differ."""
        return 1000 * max(self.sizes, default=STEP)

    @property
    def simulated(self) -> float:
        """Return the simulated time, ms."""
        return sum(self.steps) * self.step

    @property
    def slack(self) -> float:
        """Return the time that a program may not know yet if it is one frame behind, ms."""
        return sum(self.lengths[-len(SETTLE) :])

    def out_of_step(self, frames: int | None = None) -> int | None:
        """Return the first frame with too much simulated time, or over a step too little; or None.

        With `frames`, only that many count.
        """
        done = list(accumulate(self.steps[:frames]))
        ends = [0.0, *accumulate(self.lengths[:frames])]
        for frame, (end_before, end) in enumerate(pairwise(ends)):
            earliest = end_before * (1 - DRIFT) - STEP_MS
            latest = end * (1 + DRIFT) + self.waiting + ROUNDING
            if not earliest <= done[frame] * self.step <= latest:
                return frame
        return None


def pace(lab: Lab, frames: list[int], step_ms: float = 0.0) -> Pace:
    """Play the program with these frames and count its steps without running them.

    Each step takes `step_ms` of its frame, as on a slow computer.

    A program that waits makes short frames longer. If it always waits for the same
    number of steps, it needs no accumulator. So it is run again with frames that are longer than
    its wait.
    """
    paced, waits = play_at(lab, frames, step_ms)
    if not waits:
        return paced
    lab.want(
        waits <= LONGEST_WAIT,
        f"frames of {min(frames)} to {max(frames)} ms, or of up to {LONGEST_WAIT} ms where the "
        "program waits by itself",
        f"one of {waits:.0f} ms",
    )
    paced, waits = play_at(lab, [beyond(waits, each) for each in frames], step_ms)
    lab.want(
        not waits,
        "a program that waits for no longer where its frames are longer",
        f"a frame of {waits:.0f} ms",
    )
    return paced


def beyond(waits: float, frame: int) -> int:
    """Return a frame's length (ms), made longer than the program's own wait.

    Frames below the cap stay below it, and the order of lengths is preserved.
    """
    least = math.floor(min(waits, LONGEST_WAIT)) + 1
    room = LONGEST_UNCUT - least
    return max(least + math.ceil(room * min(frame / LONGEST_FRAME, 1.0)), frame)


def play_at(lab: Lab, asked: list[int], step_ms: float) -> tuple[Pace, float]:
    """Return the steps in these frames, and the longest frame (ms) that was lengthened, or 0."""
    frames = [*OFF_BEAT, *asked, *SETTLE]
    played = lab.play(frames, physics=False, step_ms=step_ms)
    count = len(frames)
    # Ignore steps before the first frame has a length, and a last frame that the program may omit.
    steps = played.steps[1:count]
    sizes = [size for size in played.dts if size] if any(steps) else []
    lab.saw("frames", (tuple(frames),), (steps, sizes))
    want_a_proper_end(lab, played, count)
    lengths = [end - begin for begin, end in pairwise(played.clock[: count + 1])]
    both = zip(lengths[len(OFF_BEAT) :], asked, strict=False)
    work = step_ms * max(steps, default=0)  # in a frame that is shorter than its steps
    longer = (length for length, frame in both if length > max(frame, work) + ROUNDING)
    # A program that sleeps before its first steps may have all of that left.
    waiting = min(max(played.clock[0] - STEP_MS * played.steps[0], 0.0), LONGEST_WAIT)
    if lab.opening is not None:  # earlier frames may have left a part of a step
        waiting = max(waiting, STEP_MS)
    paced = Pace(lengths, played.steps[1 : count + 1], played.dts, waiting, played.paced)
    return paced, max(longer, default=0.0)


def are_fixed(sizes: list[float]) -> bool:
    """Return whether all steps are STEP long."""
    return all(math.isclose(size, STEP, rel_tol=1e-9) for size in sizes)


def want_fixed_steps(lab: Lab, sizes: list[float]) -> None:
    """Insist that all steps are STEP long."""
    lab.want(
        are_fixed(sizes),
        f"steps of STEP = {STEP:.9f} s, and no others",
        f"steps of {', '.join(f'{size:.9f}' for size in sizes[:4])} s",
    )


def make_still_world(lab: Lab) -> Thing:
    """Return a world or space during a run, with a body far below the window."""
    if lab.module == "pymunk_scene":
        space = lab.make("pymunk:Space")
        for pos, spin in (
            ((450.28125, 300.40625), 0.005),
            ((100.0, 9000.0), 0.0),
            ((460.0, 90.0), -3.0),
        ):
            body = lab.make("pymunk:Body", 1.0, 100.0)
            lab.put(body, position=pos, velocity=(0.25, -2.0), angular_velocity=spin, angle=0.53125)
            lab.let(space, "add", body)
        lab.put(space, gravity=(3.265625, -700.25))
        return space
    walls = [lab.box((-900.0, 50.0 * number), (20, 20)) for number in range(16)]
    hook, bob = lab.circle((700, 90), 6, 0.0), lab.circle((840, 95), 24, vel=(3.0, 1.0))
    more = lab.circle((840, 190), 12)
    ends = (hook, bob), (bob, more)
    rods = [lab.make("DistanceJoint", *each) for each in ends]
    world = lab.world(
        lab.circle((450, 300), 10, vel=(0.25, -2.0), omega=0.005),
        lab.circle((100, 9000), 20),
        lab.circle((460, 310), 10, vel=(30.0, 5.0), omega=-3.0),
        lab.circle((440, 310), 10, vel=(-3.0, 5.0)),
        *walls,
        lab.box((450, 580), (450, 20)),
        hook,
        bob,
        more,
        joints=rods,
        gravity=(3.265625, -700.25),
        linear_damping=0.515625,
        angular_damping=0.296875,
    )
    lab.tell(world, "step", STEP)  # so that there is a contact
    return world


def want_whole_steps(lab: Lab, world: Thing, accumulator: float, seconds: float) -> None:
    """Insist that `advance` spends its time on whole steps and returns the rest."""
    lab.ran(
        f"advance with {1000 * accumulator:g} ms in the accumulator "
        f"and a frame of {1000 * seconds:.6g} ms"
    )
    rest, steps, sizes, said = lab.advance(world, accumulator, seconds)
    want_fixed_steps(lab, sizes)
    wrong = "1 too many" if said == steps + 1 else "too small" if said < steps else "too large"
    lab.want(
        said == steps,
        f"{steps} as the number of steps that ran",
        f"{said:g}",
        f"The count is {wrong}: begin it at 0, and raise it by 1 in each step.",
    )
    owed, most = accumulator + seconds, MAX_STEPS * STEP
    due = min(owed, most)
    beyond = steps * STEP + rest - due
    # A capped frame may keep or lose the accumulator. Above MAX_STEPS steps, only main may cap.
    right = abs(beyond) <= TINY if owed <= most else beyond >= -TINY or steps > MAX_STEPS
    lab.want(
        right and -TINY <= rest <= STEP + TINY,
        f"{1000 * due:.6g} ms, in whole steps and a rest shorter than a step",
        f"{steps} steps and a rest of {1000 * rest:.6g} ms: "
        f"{abs(1000 * beyond):.3g} ms too {'much' if beyond > 0 else 'little'}",
        BELOW_ZERO * (rest < -TINY),
    )


def want_a_proper_end(lab: Lab, played: Played, frames: int) -> None:
    """Insist that the program stops when its window is closed after `frames`, and not before."""
    lab.want(
        played.ended != "runaway",
        "a few steps in each frame",
        f"{RUNAWAY} steps in one frame, and more to come",
        "" if any(played.steps[:-1]) else ENDLESS,
    )
    lab.want(
        played.ended == "returned",
        "a program that ends when its window is closed",
        "it ran on",
    )
    lab.want(
        len(played.clock) > frames,
        f"{frames} frames, until its window is closed",
        f"it ended by itself after {len(played.clock) - 1}",
    )
