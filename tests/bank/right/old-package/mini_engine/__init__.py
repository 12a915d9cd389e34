"""A small 2D physics engine of rolling balls. Every public name can be imported from here.

Read in this order: shapes, body, contacts, solver, joints, world, scenes, game_loop. The rest is
for bonus tasks: sleeping, springs, broad_phase. A world that does not ask for it leaves it out.
"""

from .body import Body
from .broad_phase import near_pairs
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
from .sleeping import update_sleep
from .solver import apply_impulse, effective_mass
from .springs import SpringJoint
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
    "SpringJoint",
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
    "near_pairs",
    "spin_velocity",
    "update_sleep",
]
