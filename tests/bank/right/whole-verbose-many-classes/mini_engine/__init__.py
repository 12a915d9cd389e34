"""The engine's public face."""

from .application import GameApplication, main
from .collision.contact import Contact
from .collision.detector import ContactDetector, circle_box, circle_circle, collide
from .dynamics.body import Body
from .dynamics.constraint import DistanceJoint
from .dynamics.impulse import apply_impulse, effective_mass
from .geometry import Box, Circle, cross, spin_velocity
from .scene import SceneBuilder, ball, make_world
from .settings import BETA, HEIGHT, ITERATIONS, MAX_BALLS, MAX_STEPS, RESTING_SPEED, SLOP, STEP, WIDTH
from .timing import FixedStepClock, advance
from .world import World
