"""Simulate rolling balls, and stay stable. A scene declares its effects.

Read in this order: shapes, body, effect, world (lags, check), contact, detection, order, contacts,
friction, bounce, then any other effect. Effects with more than one file:

- Contacts finds in detection, by broad_phase (bounds), contact and landings, and tells events. It
  solves in contacts, by order and piles (pile, unload). It keeps balls out of walls in cores
  (sweep, stop), and parts bodies that a program puts into each other in crowd.
- Bounce: bounce, impacts, impact_queue, time_of_impact, flight, faces, hit.
- Rods and Springs: rods (frame, frame_parts, cluster) and springs, by joint; molecule for both.
- Rods, springs, piles and hits are rows (row), solved together in network and limits.

Below all of these: validate for arguments, reading for positions and velocities that programs read,
and soft for constraints that give way.
"""

from .body import Body
from .bounce import Bounce
from .bullets import Bullets
from .contact import Contact
from .contacts import Contacts
from .damping import Damping
from .effect import Effect
from .friction import Friction
from .kinematics import Kinematics
from .rays import RayHit
from .rods import Rod, Rods
from .shapes import Box, Circle, Segment
from .sleep import Sleep
from .springs import Spring, Springs
from .world import World

__all__ = [
    "Body",
    "Bounce",
    "Box",
    "Bullets",
    "Circle",
    "Contact",
    "Contacts",
    "Damping",
    "Effect",
    "Friction",
    "Kinematics",
    "RayHit",
    "Rod",
    "Rods",
    "Segment",
    "Sleep",
    "Spring",
    "Springs",
    "World",
]
