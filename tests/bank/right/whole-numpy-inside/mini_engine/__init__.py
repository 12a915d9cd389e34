"""Mini engine with numpy inside."""

from .engine import *  # noqa: F403
from .engine import STEP, cross, World  # noqa: F401
from .window import advance, ball, main, make_world  # noqa: F401
