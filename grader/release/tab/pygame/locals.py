"""The names that `from pygame.locals import *` brings."""

from .color import Color
from .constants import *
from .constants import __all__ as names
from .rect import Rect

__all__ = ["Color", "Rect", *names]
