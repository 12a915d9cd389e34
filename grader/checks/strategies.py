"""What hypothesis may draw: all strategies, on grids that make short counterexamples."""

import math

from hypothesis import HealthCheck, Phase, settings
from hypothesis import strategies as st

from grader.checks.exact import (
    DAMPED_STEPS,
    RATES,
    STEP_SIZES,
    Disc,
    Discs,
    Lever,
    Rect,
    Rod,
    Rubbing,
)
from grader.judge.lab import STEP

MAX_STEPS = 8  # in a frame

coordinates = st.integers(-1600, 1600).map(lambda n: n / 8)  # px
places_around = st.integers(-800, 8000).map(lambda n: n / 8)  # px, in the window or beside it
radii = st.integers(8, 320).map(lambda n: n / 8)  # px
half_extents = st.integers(8, 1600).map(lambda n: n / 8)  # px
speeds = st.integers(-4000, 4000).map(lambda n: n / 8)  # px/s
spins = st.integers(-160, 160).map(lambda n: n * 129 / 1024)  # rad/s; none is round but 0
masses = st.integers(1, 400).map(lambda n: n / 8)  # kg
masses_or_static = st.just(0.0) | masses
impulses = st.integers(0, 800).map(lambda n: n / 8)  # kg px/s
frictions = st.integers(0, 16).map(lambda n: n / 16)
rates = st.sampled_from(RATES) | st.sampled_from(RATES[:4])  # 1/s; often small ones
step_sizes = st.sampled_from(STEP_SIZES)  # s
damped_steps = st.sampled_from(DAMPED_STEPS)  # s

# The simplest is not 0, so that the very first answer says something.
near_and_far = st.one_of(
    st.integers(-32, 32).map(lambda n: (n + 5) / 8),
    st.integers(-8000, 8000).map(lambda n: n / 8),
    st.sampled_from([0.0, 1 / 64, -1 / 64]),
)
states = st.tuples(near_and_far, near_and_far)  # x in px, v in px/s
gentle_forces = st.tuples(
    *[st.integers(-8, 8).map(lambda n: (n + 1) / 4)] * 4
)  # up to the cubic term
falls = st.integers(3918, 3922).map(lambda n: (n / 4, 0.0, 0.0, 0.0))  # px/s²; gravity, or nearly
forces = gentle_forces | falls
seeds = st.integers(0, 999)  # of a random.Random
# From long ones, by which integrators are told apart, to short ones that are no round numbers.
time_steps = st.sampled_from([2.0, 1.0, 1 / 2, 1 / 4, 1 / 8, 1 / 16, 1 / 30, 1 / 120, 1 / 480])  # s

# For a property that plays a program: a play takes as long as hundreds of calls, so no shrinking.
once = settings(
    max_examples=1,
    phases=[Phase.generate],
    deadline=None,
    database=None,
    derandomize=True,
    report_multiple_bugs=False,
    print_blob=False,
    suppress_health_check=list(HealthCheck),  # pyright: ignore[reportArgumentType]
)
frame_rates = st.integers(24, 360)  # frames per second
frame_lengths = st.integers(1, 58) | st.integers(59, 2000)  # ms; some below the cap, some above
frame_lists = st.builds(
    lambda before, slow, after: [*before, slow, *after],
    st.lists(frame_lengths, max_size=4),
    st.integers(80, 2000),
    st.lists(frame_lengths, min_size=1, max_size=4),
)


@st.composite
def frames_to_advance(draw: st.DrawFn) -> list[tuple[float, float]]:
    """What is in the accumulator, and frames from 1 ms to 2 s in any order; all in s.

    Up to the cap each is a tenth longer than another one, so that no range is left out. Some are
    exactly as long as nothing, a step, or as many steps as may run, and some hardly longer.
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
discs = st.builds(Disc, coordinates, coordinates, radii)
rects = st.builds(Rect, coordinates, coordinates, half_extents, half_extents)
units = st.sampled_from([(1.0, 0.0), (0.0, -1.0), (0.6, 0.8), (-0.8, 0.6), (-0.28, -0.96)])
velocities = st.tuples(speeds, speeds)

arms = st.integers(-320, 320).map(lambda n: n / 8)  # px

# TODO 4 and 5: from hardly moving to very fast, from a feather to a ship.
low_speeds = st.integers(-64, 64).map(lambda n: n / 128)  # px/s
any_speeds = speeds | low_speeds | st.sampled_from([-2e4, 2e4])
wide_velocities = st.tuples(any_speeds, any_speeds) | st.tuples(low_speeds, low_speeds)
wide_masses = masses | st.sampled_from([1e-3, 0.05, 1e3, 1e6])
any_radii = radii | st.sampled_from([0.5, 1e4])
any_frictions = frictions | st.sampled_from([1.5, 3.0])
any_impulses = impulses | st.sampled_from([3e3, 5e4])
wide_spins = spins | st.sampled_from([-60.0078125, 45.015625])  # rad/s
mass_pairs = (
    st.tuples(wide_masses, wide_masses)
    | st.tuples(st.just(0.0), wide_masses)
    | st.tuples(wide_masses, st.just(0.0))
)
touching = st.builds(
    Discs,
    mu=st.tuples(any_frictions, any_frictions),
    mass=mass_pairs,
    normal=units,
    radius=st.tuples(any_radii, any_radii),
    drift=velocities,
    spin=st.tuples(wide_spins, wide_spins),
    turning=st.booleans(),
)
rubbings = st.lists(st.builds(Rubbing, any_impulses, any_speeds, speeds), min_size=1, max_size=3)
pulls = st.sampled_from([(0.0, 0.0), (0.0, 980.0), (-120.375, 35.5), (0.125, -980.25)])  # px/s²


# For a broad phase: bodies in and around the window, most of them small.
crowd_radii = radii | st.integers(40, 400).map(float)  # px
crowd_discs = st.builds(Disc, coordinates, coordinates, crowd_radii)
crowd_rects = st.builds(Rect, coordinates, coordinates, half_extents, half_extents)

# Of every size, anywhere and however moved. Scales and places are whole or powers of 2, so that
# sums and differences of what was drawn are exact.
scales = st.sampled_from([1.0, 1 / 8, 256.0])
places = st.sampled_from([0.0, -40_000.0, 500_000.0])  # px
any_masses = masses | st.sampled_from([1 / 1024, 1e6])  # kg
any_masses_or_static = st.just(0.0) | any_masses
slow_speeds = st.integers(-64, 64).map(lambda n: n / 64)  # px/s
very_fast = st.sampled_from([(20_000.0, 0.0), (-12_000.0, -16_000.0)])  # px/s
any_velocities = velocities | st.tuples(slow_speeds, slow_speeds) | very_fast
slow_spins = st.integers(-64, 64).map(lambda n: n / 1024)  # rad/s
any_spins = st.just(0.0) | spins | slow_spins | st.sampled_from([-300.0, 300.0])
any_step_sizes = step_sizes | st.sampled_from([1 / 1000, 1 / 24, 1.0])  # s
surfaces = st.sampled_from([0.0, 1.0]) | frictions
SURFACE = {"friction": surfaces, "restitution": surfaces}
any_surface = st.fixed_dictionaries(SURFACE)
MOTION = {"vel": any_velocities, "omega": any_spins, "angle": any_spins}
# Where it does not matter where a body is: in the window, left of it, above it, and far away.
anywhere = st.sampled_from([-1600.25, 40.5, 3200.75]) | places_around  # px
PLACE = {"pos": st.tuples(anywhere, anywhere)}
wherever = st.fixed_dictionaries({**PLACE, **MOTION, **SURFACE})
belts = st.fixed_dictionaries({"vel": any_velocities, "omega": any_spins, **SURFACE})  # static
circles = st.fixed_dictionaries({"mass": any_masses_or_static, **MOTION, **SURFACE})


@st.composite
def directions(draw: st.DrawFn) -> tuple[float, float]:
    """A unit vector; often one that is hardly off level or upright."""
    off = draw(st.integers(-64, 64)) * draw(st.sampled_from([1 / 64, 1 / 65536]))  # rad
    angle = draw(st.integers(0, 3)) * math.pi / 2 + off
    return math.cos(angle), math.sin(angle)


@st.composite
def levers(draw: st.DrawFn, masses: st.SearchStrategy[float] = any_masses) -> Lever:
    """A disc of any size, and an arm that is as long as discs of this size have them, or short."""
    scale, part = draw(scales), draw(st.sampled_from([1.0, 1.0, 1 / 64]))
    return Lever(draw(masses), scale * draw(radii), *(scale * part * draw(arms) for _ in "xy"))


static_levers = levers(st.just(0.0))
lengths = st.integers(8, 2400).map(lambda n: n / 8)  # px
strains = st.just(0.0) | st.integers(-64, 64).map(lambda n: n / 64) | coordinates  # px


@st.composite
def rods(
    draw: st.DrawFn,
    masses_a: st.SearchStrategy[float] = any_masses,
    masses_b: st.SearchStrategy[float] = any_masses,
) -> Rod:
    """A rod of any length in any direction, as long as it is meant to be or not; statics rest."""
    a, b = draw(masses_a), draw(masses_b)
    vel_a, vel_b = (draw(any_velocities) if mass else (0.0, 0.0) for mass in (a, b))
    length = draw(scales) * draw(lengths)
    distance = max(length + draw(strains), length / 4)
    x, y = draw(directions())
    return Rod(a, b, length, (distance * x, distance * y), vel_a, vel_b, draw(any_step_sizes))


@st.composite
def discs_near_boxes(draw: st.DrawFn) -> tuple[Disc, Rect]:
    """A box of any size anywhere, and a disc whose centre is at most a radius beyond its faces.

    Inside, beside a face and at a corner come up alike, however large the one and small the other.
    """
    scale, x, y = draw(scales), draw(places), draw(places)
    rect, r = draw(rects), scale * draw(radii)
    rect = Rect(x + scale * rect.x, y + scale * rect.y, scale * rect.hx, scale * rect.hy)
    return Disc(rect.x + draw(ways(rect.hx, r)), rect.y + draw(ways(rect.hy, r)), r), rect


@st.composite
def ways(draw: st.DrawFn, half: float, r: float) -> float:
    """How far a centre is from the middle of a box along one axis, px."""
    share = draw(st.sampled_from([-1.0, 0.0, 1.0]) | st.integers(-64, 64).map(lambda n: n / 64))
    return math.copysign(half + abs(share) * r, share) if draw(st.booleans()) else share * half
