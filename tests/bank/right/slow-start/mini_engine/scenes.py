"""The lab scene, with a table of colours that takes its time."""

import time

from pygame import Color, Vector2

from .body import Body
from .joints import DistanceJoint
from .shapes import Box, Circle
from .world import World

print("please wait ...")
time.sleep(3)


def mixed(number):
    """A colour for each number, by a rule that takes long to work out."""
    value = number
    for _ in range(10_000):
        value = (value * 1103515245 + 12345) % 2147483648
    return Color(80 + value % 170, 80 + value // 170 % 170, 200)


COLORS = [mixed(number) for number in range(100)]  # about 0.1 s
GREY = COLORS[0]
print("... ready")


def ball(rng, pos):
    radius = rng.randint(10, 22)
    color = COLORS[rng.randrange(len(COLORS))]
    mass = radius**2 / 100
    return Body(Circle(radius), pos, mass, restitution=0.4, friction=0.6, color=color)


def make_world(rng):
    world = World()
    for x, y, half_width, half_height in (
        (450, 580, 450, 20),
        (-20, 300, 20, 300),
        (920, 300, 20, 300),
        (200, 260, 150, 10),
    ):
        world.add(Body(Box(Vector2(half_width, half_height)), (x, y), color=COLORS[0]))
    for i in range(5):
        world.add(Body(Circle(8), (375 + 60 * i, 400), color=COLORS[1]))
    anchor = Body(Circle(6), (700, 90), color=COLORS[2])
    bob = Body(Circle(24), (840, 90), mass=6, restitution=0.2, color=COLORS[3])
    world.joints.append(DistanceJoint(world.add(anchor), world.add(bob)))
    for i in range(8):
        world.add(ball(rng, (120 + 70 * i, 60 + 40 * (i % 3))))
    return world
