"""Define hypothesis strategies, on grids that give short counterexamples."""

import math

from hypothesis import strategies as st

from grader.checks.exact import DAMPED_STEPS, MAX_STEPS, RATES, Disc, Rect
from grader.judge.drawing import between
from grader.judge.lab import STEP


def eighths(number: int) -> float:
    return number / 8


coordinates = between(-1600, 1600).map(eighths)  # px
places_around = between(-800, 8000).map(eighths)  # px, in the window or beside it
radii = between(8, 320).map(eighths)  # px
half_extents = between(8, 1600).map(eighths)  # px
speeds = between(-4000, 4000).map(eighths)  # px/s
spins = between(-160, 160).map(lambda n: n * 129 / 1024)  # rad/s; none is round but 0
masses = between(1, 400).map(eighths)  # kg
frictions = st.integers(0, 16).map(lambda n: n / 16)
rates = st.sampled_from(RATES) | st.sampled_from(RATES[:4])  # 1/s; often small ones
damped_steps = st.sampled_from(DAMPED_STEPS)  # s

# The simplest is not 0, so that the very first answer says something.
near_and_far = st.one_of(
    st.integers(-32, 32).map(lambda n: (n + 5) / 8),
    between(-4000, 4000).map(lambda n: n / 4),
    st.sampled_from([0.0, 1 / 64, -1 / 64]),
)
starts = st.tuples(  # x in px, v in px/s: a moving body and one at rest
    st.tuples(near_and_far, near_and_far), st.tuples(near_and_far, st.just(0.0))
)
forces = st.tuples(*[st.integers(-8, 8).map(lambda n: (n + 1) / 4)] * 4)  # up to the cubic term
seeds = between(0, 999)  # of a random.Random
frame_rates = between(24, 360)  # frames per second
frame_lengths = st.integers(1, 58) | between(59, 2000)  # ms; some below the cap, some above
frame_lists = st.builds(
    lambda before, slow, after: [*before, slow, *after],
    st.lists(frame_lengths, max_size=4),
    between(80, 2000),
    st.lists(frame_lengths, min_size=1, max_size=4),
)


@st.composite
def frames_to_advance(draw: st.DrawFn) -> list[tuple[float, float]]:
    """Return the accumulator, and frames from 1 ms to 2 s in any order; all in s.

    Up to the cap each is a tenth longer than another, so that no range is left out. Some last
    exactly 0, a step or MAX_STEPS steps, and some a little more or less.
    """
    shift = draw(st.integers(0, 15)) / 16
    numbers = draw(st.permutations([*range(45), *range(45, 80, 6)]))
    rests = draw(st.permutations(range(17)))
    lengths = (0.001 * 1.1 ** (number + shift) for number in numbers)
    most = MAX_STEPS * STEP
    exact = [0.0, STEP, most, most + 0.0004, 0.1, 2.0]
    nearly = [number * STEP + off for number in (1, 2, 4) for off in (-0.0003, 0.0003)]
    drawn = [(rests[n % len(rests)] / 2000, each) for n, each in enumerate(lengths)]
    return [*drawn, *((0.0, each) for each in exact), *((0.003, each) for each in nearly)]


pairs = st.tuples(coordinates, coordinates)
velocities = st.tuples(speeds, speeds)

# TODO 4 and 5: from very slow to very fast, and from very light to very heavy.
low_speeds = st.integers(-64, 64).map(lambda n: n / 128)  # px/s
crawls = st.integers(1, 64).map(lambda n: n / 128)  # px/s or rad/s, never at rest
any_speeds = speeds | low_speeds | st.sampled_from([-2e4, 2e4])
wide_velocities = st.tuples(any_speeds, any_speeds) | st.tuples(low_speeds, low_speeds)
some_frictions = st.integers(1, 16).map(lambda n: n / 16)


# For a broad phase: bodies in and around the window, most of them small.
crowd_radii = radii | between(40, 400).map(float)  # px
crowd_discs = st.builds(Disc, coordinates, coordinates, crowd_radii)
crowd_rects = st.builds(Rect, coordinates, coordinates, half_extents, half_extents)

# Bodies of any size, position and motion. Scales and positions are whole or powers of 2, so that
# their sums and differences are exact.
any_masses = masses | st.sampled_from([1 / 1024, 1e6])  # kg
any_masses_or_static = st.just(0.0) | any_masses
slow_speeds = st.integers(-64, 64).map(lambda n: n / 64)  # px/s
very_fast = st.sampled_from([(20_000.0, 0.0), (-12_000.0, -16_000.0)])  # px/s
any_velocities = velocities | st.tuples(slow_speeds, slow_speeds) | very_fast
slow_spins = st.integers(-64, 64).map(lambda n: n / 1024)  # rad/s
any_spins = st.just(0.0) | spins | slow_spins | st.sampled_from([-300.0, 300.0])
surfaces = st.sampled_from([0.0, 1.0]) | frictions
SURFACE = {"friction": surfaces, "restitution": surfaces}
any_surface = st.fixed_dictionaries(SURFACE)
MOTION = {"vel": any_velocities, "omega": any_spins, "angle": any_spins}
# Positions that must not matter: in the window, left of it, above it, and far away.
anywhere = st.sampled_from([-1600.25, 40.5, 3200.75]) | places_around  # px
PLACE = {"pos": st.tuples(anywhere, anywhere)}
wherever = st.fixed_dictionaries({**PLACE, **MOTION, **SURFACE})
belts = st.fixed_dictionaries({"vel": any_velocities, "omega": any_spins, **SURFACE})  # static
circles = st.fixed_dictionaries({"mass": any_masses_or_static, **MOTION, **SURFACE})


@st.composite
def directions(draw: st.DrawFn) -> tuple[float, float]:
    """Return a unit vector, often a nearly horizontal or vertical one."""
    off = draw(st.integers(-64, 64)) * draw(st.sampled_from([1 / 64, 1 / 65536]))  # rad
    angle = draw(st.integers(0, 3)) * math.pi / 2 + off
    return math.cos(angle), math.sin(angle)


lengths = between(8, 2400).map(eighths)  # px
