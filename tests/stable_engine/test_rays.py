"""Test rays: the first body hit, and the point."""

import math

import pytest

from stable_engine import Body, Box, Circle, Segment, World


def world_of(*bodies):
    world = World()
    for body in bodies:
        world.add(body)
    return world


CIRCLE = lambda: Body(Circle(10), (100, 0), mass=1)  # noqa: E731
BOX = lambda: Body(Box((10, 20)), (100, 0))  # noqa: E731
WALL = lambda: Body(Segment((100, -50), (100, 50)))  # noqa: E731
THICK = lambda: Body(Segment((100, -50), (100, 50), 5))  # noqa: E731
TILTED = lambda: Body(Segment((60, -40), (140, 40)))  # noqa: E731
HALF = math.sqrt(0.5)


@pytest.mark.parametrize(
    ("make", "start", "end", "point", "normal"),
    [
        (CIRCLE, (0, 0), (300, 0), (90, 0), (-1, 0)),
        (CIRCLE, (300, 6), (0, 6), (108, 6), (0.8, 0.6)),
        (BOX, (0, 5), (300, 5), (90, 5), (-1, 0)),
        (BOX, (105, -300), (105, 0), (105, -20), (0, -1)),
        (WALL, (0, 10), (300, 10), (100, 10), (-1, 0)),
        (WALL, (300, 10), (0, 10), (100, 10), (1, 0)),
        (THICK, (0, 10), (300, 10), (95, 10), (-1, 0)),
        (THICK, (103, 300), (103, 0), (103, 54), (0.6, 0.8)),
        (TILTED, (0, 0), (300, 0), (100, 0), (-HALF, HALF)),
        (TILTED, (300, 0), (0, 0), (100, 0), (HALF, -HALF)),
    ],
)
def test_a_ray_meets_a_body(make, start, end, point, normal):
    body = make()
    hit = world_of(body).ray_cast(start, end)
    assert hit.body is body
    assert tuple(hit.point) == pytest.approx(point)
    assert tuple(hit.normal) == pytest.approx(normal)
    assert hit.distance == pytest.approx(math.dist(start, point))


@pytest.mark.parametrize("make", [CIRCLE, BOX, WALL, THICK])
@pytest.mark.parametrize(
    ("start", "end"),
    [((0, 0), (80, 0)), ((0, 0), (0, 300)), ((0, 70), (300, 70)), ((0, 0), (-300, 0))],
)
def test_a_ray_that_ends_before_or_passes_by_meets_nothing(make, start, end):
    assert world_of(make()).ray_cast(start, end) is None


@pytest.mark.parametrize("size", [10.0, 0.1, 1 / 3])
def test_no_ray_passes_along_the_seam_of_two_boxes(size):
    """What touches leaves no gap: edges belong to bodies."""
    left, right = (Body(Box((size, 2 * size)), (7 * size + x, 0)) for x in (0, 2 * size))
    hit = world_of(left, right).ray_cast((8 * size, -50), (8 * size, 50))
    assert tuple(hit.point) == pytest.approx((8 * size, -2 * size))
    assert tuple(hit.normal) == (0, -1)


def test_a_ray_along_the_edge_of_a_box_meets_it_and_one_beside_does_not():
    world = world_of(BOX())
    hit = world.ray_cast((0, -20), (300, -20))
    assert (*hit.point, *hit.normal) == (90, -20, -1, 0)
    assert world.ray_cast((0, 0), (180, -40)).body  # through its corner
    assert world.ray_cast((0, -20.001), (300, -20.001)) is None


@pytest.mark.parametrize("make", [CIRCLE, BOX, WALL, THICK, TILTED])
@pytest.mark.parametrize("angle", [0.0, 0.1, 1.0, 3.0])
def test_a_ray_that_ends_on_an_edge_meets_it(make, angle):
    """The point of a hit belongs to the body, so a ray that ends there hits it too."""
    body = make()
    world = world_of(body)
    start = (100 + 200 * math.cos(angle), 200 * math.sin(angle))
    hit = world.ray_cast(start, (200 - start[0], 1.7 - start[1]))
    again = world.ray_cast(start, hit.point)
    assert again.body is body
    assert tuple(again.point) == pytest.approx(tuple(hit.point))
    way = hit.point - start
    assert world.ray_cast(start, start + way * (1 - 1e-9)) is None


def test_the_nearest_body_counts_and_the_one_it_starts_in_does_not():
    me, far, near = (Body(Circle(10), (x, 0), mass=1) for x in (0, 200, 100))
    world = world_of(me, far, near)
    assert world.ray_cast(me.pos, (500, 0)).body is near
    assert world.ray_cast((300, 0), me.pos).body is far
    assert world.ray_cast(me.pos, me.pos) is None


@pytest.mark.parametrize(("start", "end"), [((math.nan, 0), (1, 1)), ((0, 0), (1,))])
def test_a_bad_ray_is_refused(start, end):
    with pytest.raises(ValueError, match=r"World\.ray_cast's"):
        World().ray_cast(start, end)
