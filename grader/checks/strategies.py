"""What hypothesis may draw: all strategies, on grids that make short counterexamples."""

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

coordinates = st.integers(-1600, 1600).map(lambda n: n / 8)  # px
radii = st.integers(8, 320).map(lambda n: n / 8)  # px
half_extents = st.integers(8, 1600).map(lambda n: n / 8)  # px
speeds = st.integers(-4000, 4000).map(lambda n: n / 8)  # px/s
spins = st.integers(-160, 160).map(lambda n: n / 8)  # rad/s
masses = st.integers(1, 400).map(lambda n: n / 8)  # kg
masses_or_static = st.just(0.0) | masses
impulses = st.integers(0, 800).map(lambda n: n / 8)  # kg px/s
frictions = st.integers(0, 16).map(lambda n: n / 16)
rates = st.sampled_from(RATES)  # 1/s
step_sizes = st.sampled_from(STEP_SIZES)  # s
damped_steps = st.sampled_from(DAMPED_STEPS)  # s

states = st.tuples(*[st.integers(-32, 32).map(lambda n: n / 8)] * 2)  # x in px, v in px/s
forces = st.tuples(*[st.integers(-8, 8).map(lambda n: n / 4)] * 4)  # up to the cubic term
seeds = st.integers(0, 999)  # of a random.Random
long_steps = st.sampled_from([1 / 2, 1 / 4, 1 / 8, 1 / 16])  # s, to tell integrators apart

# For properties that play a program: a play takes as long as hundreds of calls, so no shrinking.
few = settings(
    max_examples=5,
    phases=[Phase.generate],
    deadline=None,
    database=None,
    derandomize=True,
    report_multiple_bugs=False,
    print_blob=False,
    suppress_health_check=list(HealthCheck),
)
# Up to 58 ms stay below the cap whatever waits; from 500 ms on they are far above.
frame_lengths = st.integers(1, 64).map(lambda n: n if n <= 58 else 500 * (n - 58))  # ms
frame_lists = st.lists(frame_lengths, min_size=1, max_size=8)

pairs = st.tuples(coordinates, coordinates)
discs = st.builds(Disc, coordinates, coordinates, radii)
rects = st.builds(Rect, coordinates, coordinates, half_extents, half_extents)
units = st.sampled_from([(1.0, 0.0), (0.0, -1.0), (0.6, 0.8), (-0.8, 0.6), (-0.28, -0.96)])
velocities = st.tuples(speeds, speeds)

arms = st.integers(-320, 320).map(lambda n: n / 8)  # px
levers = st.builds(Lever, masses, radii, arms, arms)
static_levers = st.builds(Lever, st.just(0.0), radii, arms, arms)
rods = st.builds(Rod, masses, masses, radii, pairs.filter(any), velocities, velocities, step_sizes)

# TODO 4 and 5: from hardly moving to very fast, from a feather to a ship.
low_speeds = st.integers(-64, 64).map(lambda n: n / 128)  # px/s
any_speeds = speeds | low_speeds | st.sampled_from([-2e4, 2e4])
any_velocities = st.tuples(any_speeds, any_speeds) | st.tuples(low_speeds, low_speeds)
any_masses = masses | st.sampled_from([1e-3, 0.05, 1e3, 1e6])
any_radii = radii | st.sampled_from([0.5, 1e4])
any_frictions = frictions | st.sampled_from([1.5, 3.0])
any_impulses = impulses | st.sampled_from([3e3, 5e4])
mass_pairs = (
    st.tuples(any_masses, any_masses)
    | st.tuples(st.just(0.0), any_masses)
    | st.tuples(any_masses, st.just(0.0))
)
touching = st.builds(
    Discs,
    mu=st.tuples(any_frictions, any_frictions),
    mass=mass_pairs,
    normal=units,
    radius=st.tuples(any_radii, any_radii),
    drift=velocities,
    spin=st.tuples(spins, spins),
    turning=st.booleans(),
)
rubbings = st.lists(st.builds(Rubbing, any_impulses, any_speeds, speeds), min_size=1, max_size=3)
pulls = st.sampled_from([(0.0, 0.0), (0.0, 980.0), (-120.0, 35.5)])  # px/s², gravity


@st.composite
def discs_near_boxes(draw: st.DrawFn) -> tuple[Disc, Rect]:
    """A box, and a disc whose centre is at most a radius outside of it."""
    rect, r = draw(rects), draw(radii)
    u, v = (draw(st.integers(-64, 64)) / 64 for _ in range(2))
    return Disc(rect.x + u * (rect.hx + r), rect.y + v * (rect.hy + r), r), rect
