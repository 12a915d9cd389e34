"""My own tests; one of them fails, I have yet to find out why."""

from mini_engine import Body, Circle


def test_a_body_has_a_mass():
    assert Body(Circle(5), (0, 0), 2).inv_mass == 0.5


def test_that_fails(world):
    assert world.bodies == ["a ball"]
