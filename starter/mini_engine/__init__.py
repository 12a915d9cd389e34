"""A small 2D physics engine of rolling balls. Every public name can be imported from here.

Read in this order: shapes, body, contacts, solver, joints, world, scenes, game_loop.
"""

from .body import Body
from .constants import (
    BETA,
    HEIGHT,
    ITERATIONS,
    MAX_BALLS,
    MAX_STEPS,
    RESTING_SPEED,
    SLOP,
    STEP,
    WIDTH,
)
from .contacts import Contact, circle_box, circle_circle, collide
from .game_loop import advance, main
from .joints import DistanceJoint
from .scenes import ball, make_world
from .shapes import Box, Circle, cross, spin_velocity
from .solver import apply_impulse, effective_mass
from .world import World

__all__ = [
    "BETA",
    "HEIGHT",
    "ITERATIONS",
    "MAX_BALLS",
    "MAX_STEPS",
    "RESTING_SPEED",
    "SLOP",
    "STEP",
    "WIDTH",
    "Body",
    "Box",
    "Circle",
    "Contact",
    "DistanceJoint",
    "World",
    "advance",
    "apply_impulse",
    "ball",
    "circle_box",
    "circle_circle",
    "collide",
    "cross",
    "effective_mass",
    "main",
    "make_world",
    "spin_velocity",
]
