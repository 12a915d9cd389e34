"""What hypothesis may draw: all strategies in one place, on grids that make short counterexamples."""

from hypothesis import strategies as st

from grader.checks.exact import Disc, Rect

coordinates = st.integers(-1600, 1600).map(lambda n: n / 8)  # px
radii = st.integers(8, 320).map(lambda n: n / 8)  # px
half_extents = st.integers(8, 1600).map(lambda n: n / 8)  # px
speeds = st.integers(-4000, 4000).map(lambda n: n / 8)  # px/s
spins = st.integers(-160, 160).map(lambda n: n / 8)  # rad/s
masses = st.integers(1, 400).map(lambda n: n / 8)  # kg
rates = st.integers(0, 48).map(lambda n: n / 16)  # 1/s
step_sizes = st.sampled_from([1 / 30, 1 / 60, 1 / 120, 1 / 240, 1 / 480])  # s

pairs = st.tuples(coordinates, coordinates)
discs = st.builds(Disc, coordinates, coordinates, radii)
rects = st.builds(Rect, coordinates, coordinates, half_extents, half_extents)


@st.composite
def discs_near_boxes(draw: st.DrawFn) -> tuple[Disc, Rect]:
    """A box, and a disc whose centre is at most a radius outside of it."""
    rect, r = draw(rects), draw(radii)
    u, v = (draw(st.integers(-64, 64)) / 64 for _ in range(2))
    return Disc(rect.x + u * (rect.hx + r), rect.y + v * (rect.hy + r), r), rect
