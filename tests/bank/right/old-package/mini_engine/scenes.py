"""The lab scene. Nothing to do here."""

from pygame import Vector2

from .body import Body
from .joints import DistanceJoint
from .shapes import Box, Circle
from .springs import SpringJoint
from .world import World

GREY = (84, 90, 104)


def ball(rng, pos, heaviness=1):
    """A ball of random size and colour at pos; rng is a random.Random.

    heaviness: how many times as heavy it is as usual.
    """
    radius = rng.randint(10, 22)
    color = (rng.randint(90, 240), rng.randint(90, 240), rng.randint(90, 240))
    mass = heaviness * radius**2 / 100  # kg
    return Body(Circle(radius), pos, mass, restitution=0.4, friction=0.6, color=color)


def make_world(rng):
    """A floor, two walls, a ledge, five pegs, a pendulum and eight balls."""
    world = World()
    boxes = [
        ((450, 580), (450, 20)),
        ((-20, 300), (20, 300)),
        ((920, 300), (20, 300)),
        ((200, 260), (150, 10)),
    ]
    for center, half in boxes:
        world.add(Body(Box(Vector2(half)), center, color=GREY))
    for i in range(5):
        world.add(Body(Circle(8), (375 + 60 * i, 400), color=GREY))
    add_pendulum(world)
    for i in range(8):
        world.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return world


def add_pendulum(world):
    """A heavy bob on a rod, held level at first."""
    anchor = world.add(Body(Circle(6), (700, 90), color=GREY))
    bob = world.add(Body(Circle(24), (840, 90), mass=6, restitution=0.2, color=(235, 190, 80)))
    world.joints.append(DistanceJoint(anchor, bob))


def add_spring(world):
    """A ball on a spring, drawn out to the side at first."""
    hook = world.add(Body(Circle(6), (600, 60), color=GREY))
    bob = world.add(Body(Circle(16), (640, 180), mass=2, color=(120, 200, 170)))
    world.springs.append(SpringJoint(hook, bob, stiffness=80, damping=0.4, length=80))
