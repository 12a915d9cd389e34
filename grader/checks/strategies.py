"""What hypothesis may draw: all strategies, on grids that make short counterexamples."""

from hypothesis import HealthCheck, Phase, settings
from hypothesis import strategies as st

from grader.checks.exact import STEP_SIZES, Disc, Lever, Rect, Rod, Rubbing

coordinates = st.integers(-1600, 1600).map(lambda n: n / 8)  # px
radii = st.integers(8, 320).map(lambda n: n / 8)  # px
half_extents = st.integers(8, 1600).map(lambda n: n / 8)  # px
speeds = st.integers(-4000, 4000).map(lambda n: n / 8)  # px/s
spins = st.integers(-160, 160).map(lambda n: n / 8)  # rad/s
masses = st.integers(1, 400).map(lambda n: n / 8)  # kg
masses_or_static = st.just(0.0) | masses
impulses = st.integers(0, 800).map(lambda n: n / 8)  # kg px/s
frictions = st.integers(0, 16).map(lambda n: n / 16)
rates = st.integers(0, 48).map(lambda n: n / 16)  # 1/s, as in RATES
step_sizes = st.sampled_from(STEP_SIZES)  # s

near_and_far = st.one_of(
    st.integers(-32, 32).map(lambda n: n / 8),
    st.integers(-8000, 8000).map(lambda n: n / 8),
    st.sampled_from([0.0, 1 / 64, -1 / 64]),
)
states = st.tuples(near_and_far, near_and_far)  # x in px, v in px/s
forces = st.tuples(*[st.integers(-8, 8).map(lambda n: n / 4)] * 4)  # up to the cubic term
seeds = st.integers(0, 999)  # of a random.Random
# From long ones, by which integrators are told apart, to short ones that are no round numbers.
time_steps = st.sampled_from([2.0, 1.0, 1 / 2, 1 / 4, 1 / 8, 1 / 16, 1 / 30, 1 / 120, 1 / 480])  # s

# For properties that play a program: a play takes as long as hundreds of calls, so no shrinking.
few = settings(
    max_examples=2,
    phases=[Phase.generate],
    deadline=None,
    database=None,
    derandomize=True,
    report_multiple_bugs=False,
    print_blob=False,
    suppress_health_check=list(HealthCheck),
)
frame_rates = st.integers(24, 360)  # frames per second
frame_lengths = st.integers(1, 58) | st.integers(59, 2000)  # ms; some below the cap, some above
frame_lists = st.builds(
    lambda before, slow, after: [*before, slow, *after],
    st.lists(frame_lengths, max_size=4),
    st.integers(80, 2000),
    st.lists(frame_lengths, min_size=1, max_size=4),
)
shortest_frames = st.integers(1, 2)  # ms


@st.composite
def frames_to_advance(draw: st.DrawFn) -> list[tuple[float, float]]:
    """What is in the accumulator, and frames from 1 ms to 2 s in any order; all in s.

    Up to the cap each is a tenth longer than another one, so that no range is left out.
    """
    shift = draw(st.integers(0, 15)) / 16
    numbers = draw(st.permutations([*range(45), *range(45, 80, 6)]))
    rests = draw(st.permutations(range(17)))
    return [
        (rests[place % len(rests)] / 2000, 0.001 * 1.1 ** (number + shift))
        for place, number in enumerate(numbers)
    ]


pairs = st.tuples(coordinates, coordinates)
discs = st.builds(Disc, coordinates, coordinates, radii)
rects = st.builds(Rect, coordinates, coordinates, half_extents, half_extents)
units = st.sampled_from([(1.0, 0.0), (0.0, -1.0), (0.6, 0.8), (-0.8, 0.6), (-0.28, -0.96)])
velocities = st.tuples(speeds, speeds)

arms = st.integers(-320, 320).map(lambda n: n / 8)  # px
levers = st.builds(Lever, masses, radii, arms, arms)
static_levers = st.builds(Lever, st.just(0.0), radii, arms, arms)
rods = st.builds(Rod, masses, masses, radii, pairs.filter(any), velocities, velocities, step_sizes)
rubbings = st.lists(st.builds(Rubbing, impulses, speeds, speeds), min_size=1, max_size=2)


@st.composite
def discs_near_boxes(draw: st.DrawFn) -> tuple[Disc, Rect]:
    """A box, and a disc whose centre is at most a radius outside of it."""
    rect, r = draw(rects), draw(radii)
    u, v = (draw(st.integers(-64, 64)) / 64 for _ in range(2))
    return Disc(rect.x + u * (rect.hx + r), rect.y + v * (rect.hy + r), r), rect
