"""Test tilted walls: balls roll and slide down them by closed forms, and never pass through."""

import math

import pytest
from worlds_for_tests import make, state

from experiments.measures import run, watch
from experiments.scenes import G
from stable_engine import Body, Box, Circle, Contacts, Friction, Segment, World

R = 10.0
SLIPPERY = [(20, 0.0), (45, 0.1), (60, 0.3)]  # degrees, and a friction that lets a disc slide


def directions(degrees):
    """Return the unit vectors along a slope that falls to the right, and up from it."""
    angle = math.radians(degrees)
    return (math.cos(angle), math.sin(angle)), (math.sin(angle), -math.cos(angle))


def on_slope(degrees, friction, effects=("Contacts", "Friction"), radius=0.0):
    """Make a ball that just touches a slope falling to the right; return its world and itself."""
    along, up = directions(degrees)
    world = World(effects=make(effects))
    far = 4000.0
    ends = [(side * far * along[0], side * far * along[1]) for side in (-1, 1)]
    world.add(Body(Segment(*ends, radius), friction=friction))
    reach = R + radius
    ball = Body(Circle(R), (reach * up[0], reach * up[1]), mass=1, friction=friction)
    return world, world.add(ball), along


@pytest.mark.parametrize("radius", [0, 4])
@pytest.mark.parametrize(("degrees", "friction"), [*((a, 1) for a in (5, 20, 45)), *SLIPPERY])
def test_a_disc_rolls_or_slides_down_a_slope(degrees, friction, radius):
    world, ball, along = on_slope(degrees, friction, radius=radius)
    run(world, 1)
    sine, cosine = along[1], along[0]
    rolls = friction == 1
    wanted = G * (sine * 2 / 3 if rolls else sine - friction * cosine)
    assert ball.vel.dot(along) == pytest.approx(wanted, rel=1e-4)
    assert not rolls or ball.w * R == pytest.approx(wanted, rel=1e-4)


@pytest.mark.parametrize("degrees", [0, 30, 90, 200])
def test_a_ball_bounces_off_by_the_law_of_reflection(degrees):
    along, up = directions(degrees)
    world = World(gravity=(0, 0), effects=make(["Contacts", "Bounce"]))
    ends = [(side * 300 * along[0], side * 300 * along[1]) for side in (-1, 1)]
    world.add(Body(Segment(*ends), restitution=1))
    ball = world.add(Body(Circle(R), (60 * up[0], 60 * up[1]), mass=1, restitution=1))
    ball.vel = [300 * (along[i] - up[i]) for i in range(2)]
    run(world, 0.5)
    assert tuple(ball.vel) == pytest.approx([300 * (along[i] + up[i]) for i in range(2)], rel=1e-9)


# ---------------------------------------------------------------- its ends


@pytest.mark.parametrize("radius", [0, 6])
def test_an_end_is_round(radius):
    """A ball that passes the end is deflected along the line of centres."""
    world = World(gravity=(0, 0), effects=make(["Contacts", "Bounce"]))
    world.add(Body(Segment((-100, 0), (0, 0), radius), restitution=1))
    reach = R + radius
    ball = world.add(Body(Circle(R), (200, reach * 0.6), mass=1, restitution=1))
    ball.vel = (-400, 0)
    run(world, 1)
    nx, ny = 0.8, 0.6  # of the centre, seen from the end
    assert tuple(ball.vel) == pytest.approx([-400 + 800 * nx * nx, 800 * nx * ny], rel=1e-6)


def test_a_ball_passes_the_end_by_a_hair():
    world = World(gravity=(0, 0), effects=make(["Contacts", "Bounce", "Bullets"]))
    world.add(Body(Segment((-100, 0), (0, 0), 3)))
    ball = world.add(Body(Circle(R), (13.01, -100), mass=1, bullet=True))
    ball.vel = (0, 30_000)
    run(world, 0.1)
    assert ball.vel == (0, 30_000)


def test_a_ball_rolls_off_the_end_of_a_ramp():
    world = World(effects=make(["Contacts", "Friction"]))
    world.add(Body(Segment((-300, -100), (0, 0))))
    ball = world.add(Body(Circle(R), (-200, -100), mass=1))
    run(world, 3)
    assert ball.x > 100
    assert ball.y > 300


@pytest.mark.parametrize("speed", [50, 500])
def test_nothing_hops_at_a_seam(speed):
    world = World(effects=make(["Contacts", "Friction"]))
    for i in range(10):
        world.add(Body(Segment((60 * i, 0), (60 * i + 60, 0))))
    ball = world.add(Body(Circle(R), (30, -R), mass=1))
    ball.vel, ball.omega = (speed, 0), speed / R
    highest = max(watch(world, 500 / speed, lambda: -R - ball.y))
    assert highest < 0.01
    assert ball.vx == pytest.approx(speed, rel=0.01)


# ---------------------------------------------------------------- nothing gets through


@pytest.mark.parametrize(
    ("speed", "effects"),
    [
        *((v, ("Contacts", *more)) for v in (500, 1200, 2400) for more in ((), ("Bounce",))),
        *((v, ("Contacts", "Bullets")) for v in (500, 2400, 20_000, 200_000)),
    ],
)
@pytest.mark.parametrize("degrees", [0, 37])
def test_fast_balls_do_not_tunnel(speed, degrees, effects):
    along, up = directions(degrees)
    for far in (60.0, 63.7, 68.1, 71.3):
        world = World(gravity=(0, 0), effects=make(effects))
        ends = [(side * 9000 * along[0], side * 9000 * along[1]) for side in (-1, 1)]
        world.add(Body(Segment(*ends)))
        start = (far * up[0], far * up[1])
        ball = world.add(Body(Circle(R), start, mass=1, bullet="Bullets" in effects))
        ball.vel = (-speed * up[0], -speed * up[1])
        heights = watch(world, 0.3, lambda: ball.x * up[0] + ball.y * up[1])  # noqa: B023
        assert min(heights) > 0


def test_a_heavy_load_does_not_press_a_ball_through():
    world = World(effects=make(["Contacts", "Friction"]))
    for ends in (((-200, -100), (0, 0)), ((0, 0), (200, -100))):
        world.add(Body(Segment(*ends)))
    ball = world.add(Body(Circle(R), (0, -R - 2), mass=1))
    load = world.add(Body(Circle(60), (0, -95), mass=1000))
    load.vel = (0, 900)
    run(world, 3)
    assert ball.y < 0
    assert load.y < 0


def test_a_funnel_of_segments_keeps_a_heap():
    world = World(effects=make(["Contacts", "Friction", "Bounce", "Sleep"]))
    for ends in (((-300, -400), (-40, 0)), ((-40, 0), (40, 0)), ((40, 0), (300, -400))):
        world.add(Body(Segment(*ends)))
    heap = [
        world.add(Body(Circle(R), (25 * (i % 8) - 90, -150 - 25 * (i // 8)), mass=1))
        for i in range(48)
    ]
    run(world, 8)
    assert all(ball.y < 0 for ball in heap)
    assert max(math.hypot(ball.vx, ball.vy) for ball in heap) < 1


# ---------------------------------------------------------------- what it is


def test_a_segment_stays_where_it_was_drawn_unless_it_is_moved():
    wall = Segment((10, 20), (50, 80), 5)
    assert (wall.start, wall.end, wall.radius) == ((10, 20), (50, 80), 5)
    assert repr(wall) == "Segment((10, 20), (50, 80), 5)"
    body = Body(wall)
    assert body.pos == (30, 50)
    assert Body(wall, (0, 0)).pos == (0, 0)
    assert body.is_static
    assert body.contains((10, 16))
    assert not body.contains((10, 14))


def test_a_level_segment_does_to_a_ball_what_a_box_does():
    states = []
    for ground in (Body(Box((500, 5)), (0, 5)), Body(Segment((-500, 5), (500, 5), 5))):
        world = World(effects=[Contacts(), Friction()])
        world.add(ground)
        world.add(Body(Circle(R), (0, -60), mass=1)).vel = (100, 0)
        run(world, 2)
        states.append(state(world)[6:])
    assert states[0] == states[1]
