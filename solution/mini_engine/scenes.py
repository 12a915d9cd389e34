"""The lab scene. Nothing to do here."""

from .body import Body
from .joints import DistanceJoint
from .shapes import Box, Circle
from .world import World

GREY = (84, 90, 104)


def ball(rng, pos):
    """A ball of random size and colour at pos; rng is a random.Random."""
    radius = rng.randint(10, 22)
    color = (rng.randint(90, 255), rng.randint(90, 255), rng.randint(90, 255))
    mass = radius**2 / 100  # kg
    return Body(Circle(radius), pos, mass, restitution=0.4, friction=0.6, color=color)


def make_world(rng):
    """A floor, two walls, a ledge, five pegs, a pendulum held level, and eight balls."""
    world = World()
    for center, half in (
        ((450, 580), (450, 20)),
        ((-20, 300), (20, 300)),
        ((920, 300), (20, 300)),
        ((200, 260), (150, 10)),
    ):
        world.add(Body(Box(half), center, color=GREY))
    for i in range(5):
        world.add(Body(Circle(8), (375 + 60 * i, 400), color=GREY))
    anchor = world.add(Body(Circle(6), (700, 90), color=GREY))
    bob = world.add(Body(Circle(24), (840, 90), mass=6, restitution=0.2, color=(235, 190, 80)))
    world.joints.append(DistanceJoint(anchor, bob))
    for i in range(8):
        world.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return world
