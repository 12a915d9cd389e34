"""Mini engine with floats."""

from . import core, window
from .core import *  # noqa
from .window import advance, ball, main, make_world
