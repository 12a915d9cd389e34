"""Test that invalid values are refused, with the field and the value in the message."""

import math

import pytest
from programs import SOLUTION, run_in

import integrators
from mini_engine import STEP, Body, Box, Circle, DistanceJoint, World

NAN, INF = math.nan, math.inf


def disc(**options):
    return Body(Circle(10), (3, 4), **{"mass": 1, **options})


def expect_error(field, value):
    """Expect a ValueError whose message begins with the field and the value."""
    return pytest.raises(ValueError, match=rf"^{field} is .*{value}.*, but it must be .+\.$")


@pytest.mark.parametrize("dt", [0, -STEP, NAN, INF, -INF])
def test_a_step_of_no_or_endless_or_backward_time_is_refused(dt):
    with expect_error("World.step's dt", dt):
        World().step(dt)


@pytest.mark.parametrize("dt", [0, -STEP, NAN, INF])
def test_integrators_refuse_the_same_time_steps(dt):
    with expect_error("dt", dt):
        integrators.simulate(integrators.explicit_euler, dt, 10)


@pytest.mark.parametrize("mass", [0, 1], ids=["static", "moving"])
@pytest.mark.parametrize("value", [NAN, INF, -INF])
@pytest.mark.parametrize("field", ["pos.x", "pos.y", "vel.x", "vel.y", "angle", "omega"])
def test_a_step_refuses_a_body_that_is_nowhere(field, value, mass):
    world = World()
    world.add(disc())
    body = world.add(disc(mass=mass))
    owner, _, axis = field.partition(".")
    setattr(getattr(body, owner) if axis else body, axis or owner, value)
    with expect_error(f"Body.{field}", value):
        world.step(STEP)


@pytest.mark.parametrize(
    ("field", "make", "values"),
    [
        ("Body.pos.x", lambda x: Body(Circle(10), (x, 4)), (NAN, INF, -INF)),
        ("Body.pos.y", lambda y: Body(Circle(10), (3, y)), (NAN, INF, -INF)),
        ("Body.mass", lambda mass: disc(mass=mass), (-1, -0.001, NAN, INF)),
        ("Body.mass", lambda mass: Body(Box((10, 20)), (0, 0), mass=mass), (1, 0.001)),
        ("Body.friction", lambda friction: disc(friction=friction), (-0.1, NAN, INF)),
        ("Body.restitution", lambda e: disc(restitution=e), (-0.1, 1.1, NAN, INF)),
        ("Circle.radius", Circle, (0, -1, NAN, INF)),
        ("Box.half", lambda x: Box((x, 10)), (0, -1, NAN, INF)),
        ("Box.half", lambda y: Box((10, y)), (0, -1, NAN, INF)),
        ("World.linear_damping", lambda k: World(linear_damping=k), (-0.1, NAN, INF)),
        ("World.angular_damping", lambda k: World(angular_damping=k), (-0.1, NAN, INF)),
        ("World.gravity", lambda x: World(gravity=(x, 0)), (NAN, INF)),
        ("World.gravity", lambda y: World(gravity=(0, y)), (NAN, -INF)),
    ],
)
def test_a_value_that_makes_no_sense_is_refused(field, make, values):
    for value in values:
        with expect_error(field, value):
            make(value)


def test_the_ends_of_each_range_are_welcome():
    body = disc(mass=0, friction=0, restitution=0)
    assert (body.friction, body.restitution) == (0, 0)
    assert disc(restitution=1, friction=5).restitution == 1


def test_a_body_can_be_added_only_once():
    world, body = World(), disc()
    world.add(body)
    with expect_error("World.add's body", r"\[3, 4\]"):
        world.add(body)
    assert world.bodies == [body]


def test_a_rod_from_a_body_to_itself_is_refused():
    body = disc()
    with expect_error("DistanceJoint.b", r"the same body as a, at \[3, 4\]"):
        DistanceJoint(body, body)


def test_a_rod_between_two_static_bodies_is_refused():
    with expect_error("DistanceJoint.b", r"static like a, at \[3, 4\]"):
        DistanceJoint(disc(mass=0), disc(mass=0))


@pytest.mark.parametrize(("a", "b"), [(0, 1), (1, 0), (1, 1)])
def test_a_rod_needs_one_end_that_can_move(a, b):
    assert DistanceJoint(disc(mass=a), disc(mass=b)).length == 0


@pytest.mark.parametrize("text", ["-1", "1.5", "many", " "])
def test_a_frame_count_that_is_no_whole_number_is_refused(text):
    code = "import lab_runtime\ntry: lab_runtime.frame_budget()\nexcept ValueError as e: print(e)"
    said = run_in(SOLUTION, "-c", code, LAB_FRAMES=text)
    assert said == f"LAB_FRAMES is {text!r}, but it must be a whole number of frames.\n"


@pytest.mark.parametrize(("frames", "granted"), [("0", 0), ("3", 3), ("", 1000)])
def test_frames_are_counted_down_and_for_a_person_there_is_no_limit(frames, granted):
    code = "from lab_runtime import frame_budget\nprint(sum(frame_budget() for _ in range(1000)))"
    assert run_in(SOLUTION, "-c", code, LAB_FRAMES=frames) == f"{granted}\n"
