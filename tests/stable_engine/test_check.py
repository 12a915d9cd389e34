"""Test that a scene that needs an undeclared effect gets one warning, at no later cost."""

import warnings

import pytest
from worlds_for_tests import make

from experiments.opcodes import count_opcodes, files_run
from experiments.scenes import DT
from stable_engine import Body, Box, Circle, Rod, Rods, Spring, Springs, World


def world_with(*names, floor=True, **surface):
    """Make a ball of this surface above a floor, in a world with these effects."""
    world = World(effects=make(names))
    if floor:
        world.add(Body(Box((100, 10)), (0, 10)))
    world.add(Body(Circle(10), (0, -10), mass=1, **surface))
    return world


def read_effects(sentences):
    """Return the effects named in the sentences, and whether each is needed."""
    return {s.partition("()")[0].rpartition(" ")[2]: "calls for" in s for s in sentences}


@pytest.mark.parametrize(
    ("effects", "surface", "told"),
    [
        ([], {}, {"Contacts": True}),
        (["Contacts"], {}, {}),
        (["Contacts"], {"friction": 0.5}, {"Friction": True}),
        (["Contacts"], {"friction": 0}, {}),
        (["Contacts"], {"restitution": 0.5}, {"Bounce": True}),
        (["Contacts"], {"restitution": 0}, {}),
        (
            [],
            {"restitution": 1, "friction": 1},
            dict.fromkeys(("Contacts", "Friction", "Bounce"), 1),
        ),
        (["Contacts", "Friction", "Bounce"], {"restitution": 1, "friction": 1}, {}),
        (["Contacts", "Friction", "Bounce"], {}, {}),
        (
            ["Contacts", "Rods", "Springs", "Bullets"],
            {},
            dict.fromkeys(("Rods", "Springs", "Bullets"), 0),
        ),
        (["Contacts", "Sleep", "Damping"], {}, {}),
    ],
)
def test_needed_and_unused_effects_are_named(effects, surface, told):
    assert read_effects(world_with(*effects, **surface).check()) == told


def test_friction_and_bounce_without_a_surface_for_them_are_not_used():
    world = world_with("Contacts", "Friction", "Bounce", friction=0, restitution=0)
    world.bodies[0].friction = world.bodies[0].restitution = 0
    assert read_effects(world.check()) == {"Friction": False, "Bounce": False}


def test_a_peg_that_something_hangs_on_calls_for_no_contacts():
    for effect, tie in ((Rods, Rod), (Springs, lambda a, b: Spring(a, b, 1.0))):
        world = World(effects=[effect()])
        peg = world.add(Body(Circle(5), (0, 0)))
        world.add(tie(peg, world.add(Body(Circle(5), (50, 0), mass=1))))
        assert world.check() == []


def test_nothing_that_can_move_calls_for_nothing():
    world = World()
    world.add(Body(Box((9, 9)), (0, 0), friction=1))
    assert world.check() == []


def test_the_first_step_warns_with_body_value_and_remedy():
    world = world_with("Contacts", friction=0.5)
    with pytest.warns(UserWarning) as told:
        world.step(DT)
    (sentence,) = [str(warning.message) for warning in told]
    assert "calls for Friction()" in sentence
    assert repr(world.bodies[1])[:20] in sentence
    assert "0.5" in sentence
    assert sentence.endswith("Declare it: World(effects=[..., Friction()]).")
    assert told[0].filename == __file__


def test_only_the_first_step_warns_and_none_after_a_check():
    asked, warned = world_with(), world_with()
    asked.check()
    with pytest.warns(UserWarning):
        warned.step(DT)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        asked.step(DT)
        warned.step(DT)


def test_an_unused_effect_causes_no_warning():
    world = world_with("Contacts", "Rods", "Bullets")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        world.step(DT)


def test_after_the_first_step_the_check_costs_no_opcode_and_runs_no_line():
    warned, never = (world_with("Contacts") for _ in range(2))
    never.unchecked = []  # so that nothing is checked
    assert "check.py" in files_run(lambda: warned.step(DT))
    never.step(DT)
    for _ in range(3):
        with_check, without = (count_opcodes(lambda w=w: w.step(DT)) for w in (warned, never))
        assert with_check == without
        assert "check.py" not in with_check


# ---------------------------------------------------------------- new warnings


def read_warnings_of_step(world):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        world.step(DT)
    return read_effects([str(warning.message) for warning in told])


def test_balls_that_fly_at_each_other_call_for_contacts():
    world = World(gravity=(0, 0))
    a, b = (world.add(Body(Circle(10), (x, 0), mass=1)) for x in (0, 500))
    assert world.check() == []
    a.vel = (100, 0)
    assert read_warnings_of_step(world) == {"Contacts": True}
    assert read_warnings_of_step(world) == {}
    b.vel = (200, 5)
    assert read_warnings_of_step(world) == {}


@pytest.mark.parametrize("field", ["vel", "omega"])
def test_a_belt_and_a_spinning_ball_call_for_friction(field):
    world = world_with("Contacts")
    assert world.check() == []
    if field == "vel":
        world.bodies[0].vel = (50, 0)
    else:
        world.bodies[1].omega = 5
    assert read_warnings_of_step(world) == {"Friction": True}


def test_a_ball_too_fast_for_contacts_calls_for_bullets():
    world = world_with("Contacts")
    world.bodies[1].vel = (1e6, 0)
    (sentence,) = world.check()
    assert read_effects([sentence]) == {"Bullets": True}
    assert "by more than 20 radii" in sentence


def test_later_bodies_and_values_are_checked_in_the_next_step():
    world = world_with("Contacts")
    assert read_warnings_of_step(world) == {}
    ball = world.add(Body(Circle(10), (50, -200), mass=1, restitution=0.5))
    assert read_warnings_of_step(world) == {"Bounce": True}
    ball.friction = 0.5
    assert read_warnings_of_step(world) == {"Friction": True}
    world.add(Body(Circle(10), (90, -200), mass=1, restitution=0.5))
    assert read_warnings_of_step(world) == {}
    assert "check.py" not in files_run(lambda: world.step(DT))


def test_a_scene_in_metres_needs_its_unit():
    for gravity, unit, asked in ((9.8, 1.0, 1), (9.8, 0.01, 0), (980, 1.0, 0), (0, 1.0, 0)):
        assert len(World((0, gravity), unit=unit).check()) == asked


@pytest.mark.parametrize(("ratio", "told"), [(100, 0), (1e5, 1)])
def test_a_load_too_heavy_for_the_rods_of_a_chain_is_told_of(ratio, told):
    world = World(effects=make(["Rods", "Contacts"]))
    last = world.add(Body(Circle(5), (0, 0)))
    for i in range(1, 5):
        link = world.add(Body(Circle(5), (0, 50 * i), mass=ratio if i == 4 else 1))
        world.add(Rod(last, link))
        last = link
    assert len([sentence for sentence in world.check() if "masses closer" in sentence]) == told


@pytest.mark.parametrize(("ratio", "told"), [(10, 0), (1000, 1)])
def test_all_the_heavy_balls_of_a_chain_count(ratio, told):
    """Each second ball is heavy. At 1 : 1000, with 60 steps a second, rods would tear."""
    world = World(effects=make(["Rods"]))
    last = world.add(Body(Circle(5), (0, 0)))
    for i in range(1, 11):
        link = world.add(Body(Circle(5), (15 * (i % 2), 26 * i), mass=1 if i % 2 else ratio))
        world.add(Rod(last, link))
        last = link
    assert len([sentence for sentence in world.check() if "masses closer" in sentence]) == told


@pytest.mark.parametrize(("ratio", "told"), [(1.0, 0), (1e5, 1)])
def test_a_whirled_chain_that_rods_cannot_follow_is_told_of(ratio, told):
    """Without gravity, a bob that flies round at 30 rad/s pulls by 30² times its distance."""
    world = World((0, 0), effects=make(["Rods"]))
    before = world.add(Body(Circle(2), (0, 0)))
    for i in range(1, 11):
        ball = world.add(Body(Circle(3), (20 * i, 0), ratio if i == 10 else 1.0))
        ball.vel = 0, 30 * 20 * i
        world.add(Rod(before, ball))
        before = ball
    assert len(world.check()) == told
