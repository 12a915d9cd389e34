"""One builder per engine: each makes a scene, and answers to the names in builder.py.

The window and accuracy.py use ENGINES, the leaderboard the list in contestants.py. The engines of
box2d.py and npm.py must be installed.
"""

from .box2d import Box2D, Box2d
from .builder import SUBSTEPS, State, Touch
from .chipmunk import Pymunk
from .lesson import Lesson
from .stable import Stable

BUILDERS = (Lesson, Stable, Pymunk, Box2d) if Box2D else (Lesson, Stable, Pymunk)
ENGINES = {engine.name: engine for engine in BUILDERS}

__all__ = ["ENGINES", "SUBSTEPS", "Lesson", "Pymunk", "Stable", "State", "Touch"]
