"""Test flush bodies: they are one flat face. Test that no face goes on past its end."""

import math
import random

import pytest
from worlds_for_tests import add_ideal_ball, make

from stable_engine import Body, Box, Circle, Rod, Segment, Spring, World

pytestmark = pytest.mark.filterwarnings("ignore:This scene calls for Bullets")
R, DT = 10.0, 1 / 60
KINDS = ["box", "segment"]
LEFT, RIGHT = -400.0, 1200.0  # px, the ends of each floor


def lay_floor(world, kind, count, restitution):
    """Add a smooth floor at y = 0: so many flush bodies, one of whose seams is at x = 0."""
    length = (RIGHT - LEFT) / count
    for i in range(count):
        start = LEFT + length * i
        if kind == "box":
            box = Box((length / 2, 50))
            world.add(Body(box, (start + length / 2, 50), 0, restitution, 0))
        else:
            segment = Segment((start, 0), (start + length, 0))
            world.add(Body(segment, restitution=restitution, friction=0))


def run(world, seconds):
    for _ in range(round(seconds / DT)):
        world.step(DT)


def throw(world, pos, vel, restitution, seconds, r=R):
    ball = world.add(Body(Circle(r), pos, 1, restitution, 0))
    ball.vel = vel
    run(world, seconds)
    return tuple(ball.pos), tuple(ball.vel)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("restitution", "speed", "height", "x"),
    [(1, 200, 20, -42), (1, 600, 20, -129), (0.5, 300, 50, -99), (0, 400, 50, -141)],
)
@pytest.mark.parametrize("count", [4, 40])
def test_a_ball_thrown_at_a_seam_goes_as_on_one_body(kind, restitution, speed, height, x, count):
    ends = []
    for parts in (1, count):
        world = World(effects=make(["Contacts", "Bounce"] if restitution else ["Contacts"]))
        lay_floor(world, kind, parts, restitution)
        ends.append(throw(world, (x, -R - height), (speed, 0), restitution, 2 / 3))
    (pos, vel), found = ends
    assert vel[0] == pytest.approx(speed, rel=1e-9)
    assert found[0] == pytest.approx(pos, abs=0.01)
    assert found[1][0] == pytest.approx(vel[0], abs=0.01)
    half_substep = DT / 4 / 2  # s: a new contact bears nothing yet, so gravity counts
    assert found[1][1] == pytest.approx(vel[1], abs=980 * half_substep + 0.01)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("restitution", [0, 0.5])
def test_a_ball_that_flies_over_tiles_in_a_step_is_not_thrown_up(kind, restitution):
    for x in (-300.0, -297.0, -293.0, -290.0):
        world = World(effects=make(["Contacts", "Bounce"]))
        lay_floor(world, kind, 80, restitution)
        (_, y), (vx, vy) = throw(world, (x, -R - 30), (2000, 0), restitution, 0.5)
        assert vx == pytest.approx(2000, rel=1e-9)
        speed = math.sqrt(2 * 980 * 30)  # px/s, with which it lands
        assert abs(vy) <= restitution * speed + 980 * DT
        assert -R - y <= restitution**2 * 30 + 1e-3


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("restitution", [0, 0.5])
def test_a_ball_dropped_beside_a_seam_gets_no_speed_sideways(kind, restitution):
    for x in (-9, -6, -3, -0.4, 0.2, 2, 5, 8):
        world = World(effects=make(["Contacts", "Bounce"] if restitution else ["Contacts"]))
        lay_floor(world, kind, 4, restitution)
        pos, vel = throw(world, (x, -R - 90 - 9 * x), (0, 0), restitution, 1)
        assert vel[0] == pytest.approx(0, abs=1e-9)
        assert pos[0] == pytest.approx(x, abs=1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_a_bullet_that_slides_over_seams_loses_no_time(kind):
    world = World(effects=make(["Contacts", "Bounce", "Bullets"]))
    lay_floor(world, kind, 40, 0)
    ball = world.add(Body(Circle(R), (-300, -R), 1, 0, 0, bullet=True))
    ball.vel = (700, 0)
    run(world, 0.1)  # it lands
    start = ball.x
    run(world, 1)
    assert ball.x == pytest.approx(start + 700, abs=0.01)


@pytest.mark.parametrize("seed", [14, 80, 221, 276])
def test_a_ball_pressed_into_a_thin_wall_stays_on_its_side_at_a_seam(seed):
    """A spring as stiff as tens of thousands of weights pulls it towards the other side."""
    rng = random.Random(seed)
    world = World((0, 980), 1, make(["Contacts", "Friction", "Springs", "Bullets"]))
    half = rng.uniform(1, 3)
    for y in (-5000, 5000):
        world.add(Body(Box((half, 5000)), (0, y), friction=0.3))
    at = -half - 2.7 + rng.uniform(0, 0.1), rng.uniform(5, 60)
    ball = world.add(Body(Circle(5.4), at, 0.37, friction=0.3))
    anchor = world.add(Body(Box((2, 2)), (200, rng.uniform(0, 100))))
    world.add(Spring(ball, anchor, 7e4 * rng.uniform(0.3, 2), 0.05, 24))
    ball.vel = (rng.uniform(0, 3000), -rng.uniform(500, 4000))
    for _ in range(40):
        world.step(1 / 120)
        assert ball.x < 0


@pytest.mark.parametrize("kind", KINDS)
def test_a_dumbbell_bounces_off_tiles_as_off_one_body(kind):
    for x in (-45.0, -35.0, -25.0, -15.0, -5.0):
        ends = []
        for parts in (1, 40):
            world = World(effects=make(["Contacts", "Bounce", "Rods"]))
            lay_floor(world, kind, parts, 1)
            balls = [add_ideal_ball(world, (x + 30 * i, -R - 60), (500, 200)) for i in (0, 1)]
            world.add(Rod(*balls))
            run(world, 0.25)
            ends.append([tuple(ball.vel) for ball in balls])
        for found, wanted in zip(*ends, strict=True):
            assert found == pytest.approx(wanted, abs=0.1)


@pytest.mark.parametrize("kind", KINDS)
def test_a_ball_bounces_off_the_body_that_it_touches_first(kind):
    for side in (-1, 1):  # it meets the left or the right body, and flies on over the other
        for x in (1.0, 3.0, 6.0):
            world = World(gravity=(0, 0), effects=make(["Contacts", "Bounce"]))
            lay_floor(world, kind, 4, 1)
            for body in world.bodies:
                body.restitution = 1 if side * body.x > 0 else 0
            _, vel = throw(world, (side * (x + 54), -R - 36), (-side * 600, 400), 1, 0.2)
            assert vel == pytest.approx((-side * 600, -400), abs=1e-6)


@pytest.mark.parametrize("degrees", [3, 8, 20])
def test_a_ball_is_reflected_by_the_face_that_it_meets_beside_a_bend(degrees):
    angle = math.radians(degrees)
    far = (400 * math.cos(angle), 400 * math.sin(angle))
    for x in (-1.0, -3.0, -6.0):  # where it meets the level face
        for start in (30.0, 35.0, 40.0, 45.0):
            world = World(gravity=(0, 0), effects=make(["Contacts", "Bounce"]))
            for ends in (((-400, 0), (0, 0)), ((0, 0), far)):
                world.add(Body(Segment(*ends), restitution=1, friction=0))
            ball = add_ideal_ball(world, (x - start, -R - start), (400, 400))
            run(world, 0.2)
            assert tuple(ball.vel) == pytest.approx((400, -400), abs=1e-6)


@pytest.mark.parametrize("bullet", [False, True])
@pytest.mark.parametrize(
    ("r", "pos", "vel"),
    [
        (1, (4.15, 50.09), (-4436, -4040)),
        (3, (6.1, 50.09), (-4436, -4040)),
        (3, (9.35, 46.75), (-2898, -775)),
    ],
)
def test_a_ball_flies_past_the_end_of_a_segment_after_a_wall(r, pos, vel, bullet):
    effects = ["Contacts", "Bounce", "Bullets"] if bullet else ["Contacts", "Bounce"]
    world = World(gravity=(0, 0), effects=make(effects))
    world.add(Body(Segment((40, 40), (80, 60)), restitution=1, friction=0))
    world.add(Body(Segment((0, -3000), (0, 3000)), restitution=1, friction=0))
    ball = add_ideal_ball(world, pos, vel, r, bullet=bullet)
    world.step(DT)
    assert tuple(ball.vel) == pytest.approx((-vel[0], vel[1]), rel=1e-9)
    reflected = 2 * r - pos[0] - vel[0] * DT, pos[1] + vel[1] * DT
    assert tuple(ball.pos) == pytest.approx(reflected, abs=1e-6)
