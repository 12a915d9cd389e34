"""A small 2D physics engine of rolling balls. Every public name can be imported from here.

Read in this order: shapes, body, contacts, solver, joints, world, scenes, game_loop; then bonus/.
"""

from .body import Body
from .bonus.broad_phase import near_pairs
from .bonus.sleeping import update_sleep, wake
from .bonus.springs import SpringJoint
from .bonus.window import BonusWindow, between, heaviness, main
from .bonus.world import BonusWorld
from .constants import *
from .contacts import Contact, circle_box, circle_circle, collide
from .game_loop import Window, advance
from .joints import DistanceJoint
from .scenes import ball, make_world
from .shapes import Box, Circle, cross, spin_velocity
from .solver import apply_impulse, effective_mass
from .world import World
